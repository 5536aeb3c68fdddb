//! Attractors at one frequency by few motions, each followed no longer than it takes to see where it goes:
//! for looking at many frequencies.
//!
//! Motions begin from the linear response, from states about it and from those of large amplitude that a
//! backbone suggests. Each is looked at now and then: where it has come to an orbit that is known
//! by then, or has repeated, it ends. One that nearly repeats at last, as it does where there is little
//! damping, is taken to its orbit by Newton's method.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, Response, SurveyEffort, backbone::backbone_states,
    catalogue::Catalogue, cut::search_cut, start::starting_states, state_scale::StateScale,
    survey::repeats_after,
};

/// Excitation periods between two looks, besides the largest multiple.
const BETWEEN_LOOKS: usize = 16;
/// Distance from an orbit, relative to it, at which a motion has come to it.
const ARRIVED: f64 = 1e-5;
/// Distance over a period below which a motion is on its way to an orbit when it has had its time.
const NEARLY: f64 = 1e-2;

/// How many motions begin where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProbeStarts {
    /// About the linear response, besides the one from it.
    pub about_linear: usize,
    /// On backbones.
    pub on_backbones: usize,
}

/// Finds stable orbits at a frequency whose minimal periods are among `multiples`. A start from which no
/// motion can be computed makes the search incomplete.
///
/// * `effort`: its settling and observed periods are the most of each motion; its starts are not used.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn probe(
    system: &System,
    response: &Response,
    (frequency_hz, multiples): (f64, &[u32]),
    (starts, effort): (ProbeStarts, &SurveyEffort),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<FoundOrbits, OrbitError> {
    let mut states = starting_states(system, response, frequency_hz, starts.about_linear, settings)?;
    states.extend(backbone_states(system, frequency_hz, multiples, &states[0], starts.on_backbones));
    let largest = multiples.iter().copied().max().unwrap_or(1) as usize;
    let most = effort.settling + effort.observed.max(3 * largest);
    let catalogue = Catalogue::new(system, response, settings, frequency_hz)?;
    let mut probe = Probe { catalogue, multiples, largest, most };
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

struct Probe<'a> {
    catalogue: Catalogue<'a>,
    multiples: &'a [u32],
    largest: usize,
    most: usize,
}

impl Probe<'_> {
    /// Follows a motion until it is seen where it goes.
    fn follow(&mut self, state: Vec<f64>, interrupted: Interruption<'_>) -> Result<(), OrbitError> {
        let mut states = vec![state];
        let mut periods = 0;
        while periods < self.most {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            let more = (BETWEEN_LOOKS + self.largest).min(self.most - periods);
            self.advance(&mut states, more)?;
            periods += more;
            let last = &states[states.len() - 1];
            if self.catalogue.is_at_stable_orbit(last, ARRIVED) {
                return Ok(());
            }
            let scale = self.catalogue.scale_of_motion(last)?;
            if let Some(period) = repeats_after(&states, &scale, self.largest) {
                return self.settle(&states[states.len() - 1], period as u32);
            }
        }
        let scale = self.catalogue.scale_of_motion(&states[states.len() - 1])?;
        match nearly_repeats_after(&states, &scale, self.largest) {
            Some(period) => self.settle(&states[states.len() - 1], period as u32),
            None => Ok(()),
        }
    }

    /// Goes on by some periods and keeps the last states, one more than the largest multiple.
    fn advance(&mut self, states: &mut Vec<Vec<f64>>, periods: usize) -> Result<(), OrbitError> {
        let stretch = Stretch { frequency_hz: self.catalogue.frequency_hz, start: 0.0, end: 1.0 };
        for _ in 0..periods {
            let next = self.catalogue.integrator().advance(&stretch, &states[states.len() - 1])?;
            states.push(next);
        }
        let surplus = states.len().saturating_sub(self.largest + 1);
        states.drain(..surplus);
        Ok(())
    }

    /// The orbit to which a motion has come.
    fn settle(&mut self, state: &[f64], period_multiple: u32) -> Result<(), OrbitError> {
        let orbit = (self.catalogue.frequency_hz, period_multiple);
        let (begin, _) = search_cut(self.catalogue.integrator(), state, orbit)?;
        self.catalogue.probe((begin.phase, &[begin.state]), period_multiple)?;
        Ok(())
    }

    fn found(self) -> Vec<crate::PeriodicSolution> {
        let multiples = self.multiples;
        let known = self.catalogue.known.into_iter().map(|known| known.solution);
        known.filter(|orbit| orbit.stable() && multiples.contains(&orbit.period_multiple)).collect()
    }
}

/// The number of periods, up to `largest`, after which the last state has come back most closely, if it
/// nearly has.
fn nearly_repeats_after(states: &[Vec<f64>], scale: &StateScale, largest: usize) -> Option<usize> {
    let last = states.len() - 1;
    let distance = |period: usize| scale.distance(&states[last], &states[last - period]);
    let closest = (1..=largest.min(last)).map(|period| (distance(period), period));
    // A motion that comes back after one period comes back after two as well: a longer one has to be much
    // closer.
    let (off, period) = closest.reduce(|best, other| if other.0 < 0.1 * best.0 { other } else { best })?;
    (off < NEARLY).then_some(period)
}
