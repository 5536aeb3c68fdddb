//! Attractors at one frequency by few motions, each followed no longer than it takes to see where it goes:
//! for looking at many frequencies.
//!
//! Motions begin from the linear response, from states about it and from those of large amplitude that a
//! backbone suggests. A motion ends where it has come to a stable orbit that is known by then, or has
//! repeated. Where there is little damping it has done neither at last: then Newton's method begins where it
//! has come back most closely after each of the multiples. What that finds is kept if it is stable. A motion
//! that will not settle, a chaotic one, comes back near unstable orbits: there Newton's method ends as soon
//! as that is seen, which is before it has converged. Further motions that come to where it wanders end
//! there: where they would go from there is what it was followed for.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response, SurveyEffort,
    arrival::{Approach, StableOrbits},
    backbone::backbone_states,
    catalogue::{Arrived, Catalogue},
    cut::search_cut,
    matching::nearest_returns,
    repetition::{nearly_repeats_after, repeats_after},
    solve::Wanted,
    start::starting_states,
    state_scale::StateScale,
};

/// Excitation periods between two looks, besides the largest multiple.
const BETWEEN_LOOKS: usize = 16;
/// Least number of states that are kept, at successive excitation periods.
const KEPT: usize = 48;
/// Near-returns from which Newton's method begins, of each multiple.
const NEAR_RETURNS: usize = 2;
/// Distance, relative to the motion, from a state of a motion that has not settled, at which another one is
/// where that was.
const SAME_PLACE: f64 = 2e-2;
/// States in such places, of those between two looks, by which a motion has come to where another wandered:
/// one that passes by on its way to an orbit leaves again within a few periods.
const AMONG_WANDERED: usize = 6;

/// How many motions begin where, and what is known before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeStarts<'a> {
    /// From the linear response and states about it.
    pub about_linear: usize,
    /// On backbones.
    pub on_backbones: usize,
    /// Orbits at this frequency; motions that come to a stable one of them end.
    pub known: &'a [PeriodicSolution],
    /// States at this frequency where others wander that do not settle; motions that come there end.
    pub unsettled: &'a [Vec<f64>],
}

/// Finds further stable orbits at a frequency whose minimal periods are among `multiples`. A start from which
/// no motion can be computed makes the search incomplete.
///
/// * `effort`: a motion has its settling periods, and as many as are kept behind them; no more of it is used.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn probe(
    system: &System,
    response: &Response,
    (frequency_hz, multiples): (f64, &[u32]),
    (starts, effort): (ProbeStarts<'_>, &SurveyEffort),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<FoundOrbits, OrbitError> {
    let about_linear = starts.about_linear.saturating_sub(1);
    let mut states = starting_states(system, response, frequency_hz, about_linear, settings)?;
    states.extend(backbone_states(system, frequency_hz, multiples, &states[0], starts.on_backbones));
    if starts.about_linear == 0 {
        states.remove(0);
    }
    let largest = multiples.iter().copied().max().unwrap_or(1) as usize;
    let most = effort.settling + KEPT.max(3 * largest);
    let mut catalogue = Catalogue::new(system, response, settings, frequency_hz)?;
    let mut reached = StableOrbits::default();
    for orbit in starts.known {
        reached.add(catalogue.integrator(), orbit)?;
    }
    let wandered = starts.unsettled.to_vec();
    let mut probe = Probe { catalogue, reached, wandered, multiples, largest, most };
    let (mut failure, mut computed) = (None, false);
    for state in states {
        match probe.follow(state, &mut *interrupted) {
            Ok(()) => computed = true,
            Err(error @ (OrbitError::Motion(_) | OrbitError::NeverOpens { .. })) => failure = Some(error),
            Err(error) => return Err(error),
        }
    }
    match failure {
        Some(error) if !computed => Err(error),
        incomplete => Ok(FoundOrbits { orbits: probe.found(), incomplete }),
    }
}

/// What a motion has come to after some periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Advanced {
    ToKnownOrbit,
    SoFar,
}

struct Probe<'a> {
    catalogue: Catalogue<'a>,
    reached: StableOrbits,
    /// States of motions that have not settled in their time, nor come near a stable orbit.
    wandered: Vec<Vec<f64>>,
    multiples: &'a [u32],
    largest: usize,
    most: usize,
}

impl Probe<'_> {
    /// Follows a motion until it is seen where it goes.
    fn follow(&mut self, state: Vec<f64>, interrupted: Interruption<'_>) -> Result<(), OrbitError> {
        let mut states = vec![state];
        let mut approach = self.reached.approached();
        let mut periods = 0;
        while periods < self.most {
            let more = (BETWEEN_LOOKS + self.largest).min(self.most - periods);
            if self.advance((&mut states, &mut approach), more, &mut *interrupted)? == Advanced::ToKnownOrbit
            {
                return Ok(());
            }
            periods += more;
            let scale = self.catalogue.scale_of_motion(&states[states.len() - 1])?;
            if let Some(period) = repeats_after(&states, &scale, self.largest) {
                return self.settle(&states[states.len() - 1], period as u32);
            }
            if self.has_joined(&states[states.len() - more..], &scale) {
                return Ok(());
            }
        }
        let scale = self.catalogue.scale_of_motion(&states[states.len() - 1])?;
        match nearly_repeats_after(&states, &scale, self.largest) {
            Some(period) => self.settle(&states[states.len() - 1], period as u32),
            None => {
                if !self.approach(&states, &scale, interrupted)? {
                    self.wandered.append(&mut states);
                }
                Ok(())
            }
        }
    }

    /// Whether the latest states of a motion are where another one wandered.
    fn has_joined(&self, latest: &[Vec<f64>], scale: &StateScale) -> bool {
        let is_there =
            |state: &Vec<f64>| self.wandered.iter().any(|other| scale.distance(state, other) < SAME_PLACE);
        latest.iter().filter(|state| is_there(state)).count() >= AMONG_WANDERED
    }

    /// Orbits near which a motion is that has not settled; whether one of them is stable.
    fn approach(
        &mut self,
        states: &[Vec<f64>],
        scale: &StateScale,
        interrupted: Interruption<'_>,
    ) -> Result<bool, OrbitError> {
        let mut is_near_stable = false;
        for &multiple in self.multiples {
            for nodes in nearest_returns(states, scale, multiple as usize, NEAR_RETURNS) {
                if interrupted() {
                    return Err(OrbitError::Interrupted);
                }
                let arrived = self.catalogue.probe_for(Wanted::StableNearby, (0.0, nodes), multiple)?;
                is_near_stable |= arrived.as_ref().is_some_and(|arrived| self.is_stable(arrived));
                self.note(arrived)?;
            }
        }
        Ok(is_near_stable)
    }

    fn is_stable(&self, arrived: &Arrived) -> bool {
        self.catalogue.known[arrived.place].solution.stable()
    }

    /// Goes on by some periods and keeps the last states.
    fn advance(
        &mut self,
        (states, approach): (&mut Vec<Vec<f64>>, &mut Approach),
        periods: usize,
        interrupted: Interruption<'_>,
    ) -> Result<Advanced, OrbitError> {
        let stretch = Stretch { frequency_hz: self.catalogue.frequency_hz, start: 0.0, end: 1.0 };
        for _ in 0..periods {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            let next = self.catalogue.integrator().advance(&stretch, &states[states.len() - 1])?;
            if approach.has_arrived(&self.reached, &next) {
                return Ok(Advanced::ToKnownOrbit);
            }
            states.push(next);
        }
        let surplus = states.len().saturating_sub(KEPT.max(3 * self.largest));
        states.drain(..surplus);
        Ok(Advanced::SoFar)
    }

    /// The orbit to which a motion has come.
    fn settle(&mut self, state: &[f64], period_multiple: u32) -> Result<(), OrbitError> {
        let orbit = (self.catalogue.frequency_hz, period_multiple);
        let (begin, _) = search_cut(self.catalogue.integrator(), state, orbit)?;
        let arrived = self.catalogue.probe((begin.phase, &[begin.state]), period_multiple)?;
        self.note(arrived)
    }

    /// Motions that come to a new orbit end from now on, if it is stable.
    fn note(&mut self, arrived: Option<Arrived>) -> Result<(), OrbitError> {
        if let Some(place) = arrived.filter(|arrived| arrived.is_new).map(|arrived| arrived.place) {
            let orbit = self.catalogue.known[place].solution.clone();
            self.reached.add(self.catalogue.integrator(), &orbit)?;
        }
        Ok(())
    }

    fn found(self) -> Vec<PeriodicSolution> {
        let multiples = self.multiples;
        let known = self.catalogue.known.into_iter().map(|known| known.solution);
        known.filter(|orbit| orbit.stable() && multiples.contains(&orbit.period_multiple)).collect()
    }
}
