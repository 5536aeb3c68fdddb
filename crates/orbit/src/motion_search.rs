//! Orbits at one frequency by motions from many states, each followed no longer than it takes to see where it
//! goes.
//!
//! A motion ends where it has come to a stable orbit that is known by then, or has repeated: then Newton's
//! method takes it to the orbit that it is on. One that has done neither when its time is over is chaotic or
//! still settling. The states that came back closest after N periods are near orbits of that period, stable
//! or not (Auerbach and others, Phys. Rev. Lett. 58 (1987), 2387), to which Newton's method takes them.
//!
//! A chaotic motion shows within some periods where it wanders. Others that come there need not settle any
//! more: they go on for as many periods as are kept. Once some of them have shown no orbit that was not
//! known, further ones end as soon as they come there.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response,
    arrival::{Approach, StableOrbits},
    catalogue::{Arrived, Catalogue},
    cut::search_cut,
    matching::nearest_returns,
    repetition::{nearly_repeats_after, repeats_after},
    solve::Wanted,
    state_scale::StateScale,
};

/// Excitation periods between two looks, besides the largest multiple.
const BETWEEN_LOOKS: usize = 16;
/// Distance, relative to the motion, from a state of a motion that has not settled, at which another one is
/// where that was.
const SAME_PLACE: f64 = 2e-2;
/// States in such places, of those between two looks, by which a motion has come to where another wandered:
/// one that passes by on its way to an orbit leaves again within a few periods.
const AMONG_WANDERED: usize = 6;

/// How far motions are followed, and for what.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extent {
    /// Excitation periods of a motion at most.
    pub most: usize,
    /// The last of them, whose states are kept.
    pub kept: usize,
    /// Near-returns from which Newton's method begins, of each multiple.
    pub near_returns: usize,
    /// Motions in a row that did not settle and showed no new orbit, after which others that come to where
    /// one wandered end there.
    pub fruitless: usize,
    pub wanted: Wanted,
}

/// A motion that is followed.
struct Motion {
    /// Its last states at successive excitation periods.
    states: Vec<Vec<f64>>,
    /// The state after those, if it is known.
    next: Option<Vec<f64>>,
    approach: Approach,
}

/// What a motion has come to after some periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Advanced {
    ToKnownOrbit,
    SoFar,
}

/// Where Newton's method has led.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Led {
    Nowhere,
    ToStable,
    ToUnstable,
}

pub(crate) struct MotionSearch<'a> {
    catalogue: Catalogue<'a>,
    reached: StableOrbits,
    /// States of motions that have not settled in their time, nor come near a stable orbit.
    pub wandered: Vec<Vec<f64>>,
    /// Motions in a row that have not settled and showed no new orbit.
    fruitless: usize,
    multiples: &'a [u32],
    largest: usize,
    extent: Extent,
}

impl<'a> MotionSearch<'a> {
    /// A search for orbits whose minimal periods are among `multiples`.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if no integrator can be made for the system.
    pub fn new(
        (system, response): (&'a System, &'a Response),
        (frequency_hz, multiples): (f64, &'a [u32]),
        extent: Extent,
        settings: &'a OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let largest = multiples.iter().copied().max().unwrap_or(1) as usize;
        let catalogue = Catalogue::new(system, response, settings, frequency_hz)?;
        let reached = StableOrbits::default();
        Ok(Self { catalogue, reached, wandered: Vec::new(), fruitless: 0, multiples, largest, extent })
    }

    /// Orbits at which motions end from now on, those that are stable.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if their motion cannot be computed.
    pub fn end_at(&mut self, orbits: &[PeriodicSolution]) -> Result<(), OrbitError> {
        orbits.iter().try_for_each(|orbit| Ok(self.reached.add(self.catalogue.integrator(), orbit)?))
    }

    /// Follows the motions from these states. One that cannot be computed makes the search incomplete.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if no motion can be computed, [`OrbitError::Interrupted`].
    pub fn follow_all(
        &mut self,
        states: Vec<Vec<f64>>,
        interrupted: Interruption<'_>,
    ) -> Result<Option<OrbitError>, OrbitError> {
        let (mut failure, mut computed) = (None, false);
        for state in states {
            match self.follow(state, &mut *interrupted) {
                Ok(()) => computed = true,
                Err(error @ (OrbitError::Motion(_) | OrbitError::NeverOpens { .. })) => failure = Some(error),
                Err(error) => return Err(error),
            }
        }
        match failure {
            Some(error) if !computed => Err(error),
            failure => Ok(failure),
        }
    }

    /// The orbits of the wanted periods, in the order in which they were met.
    pub fn found(self, incomplete: Option<OrbitError>) -> FoundOrbits {
        let (multiples, wanted) = (self.multiples, self.extent.wanted);
        let is_wanted = |orbit: &PeriodicSolution| {
            multiples.contains(&orbit.period_multiple) && (wanted == Wanted::Any || orbit.may_be_stable())
        };
        self.catalogue.into_found(is_wanted, incomplete)
    }

    /// Follows a motion until it is seen where it goes.
    fn follow(&mut self, state: Vec<f64>, interrupted: Interruption<'_>) -> Result<(), OrbitError> {
        let mut motion = Motion { states: vec![state], next: None, approach: self.reached.approached() };
        let (mut left, mut joined, mut has_repeated) = (self.extent.most, false, false);
        let (mut states, scale) = loop {
            let more = (BETWEEN_LOOKS + self.largest).min(left);
            if self.advance(&mut motion, more, &mut *interrupted)? == Advanced::ToKnownOrbit {
                return Ok(());
            }
            left -= more;
            let Motion { states, next, .. } = &mut motion;
            let last = &states[states.len() - 1];
            let (scale, after) = self.catalogue.scale_and_next(last)?;
            *next = after;
            // From an unstable orbit, where symmetry holds it, rounding takes it away in time.
            if !has_repeated && let Some(period) = repeats_after(states, &scale, self.largest) {
                has_repeated = true;
                if self.settle(last, period as u32)? == Led::ToStable {
                    return Ok(());
                }
            }
            if !joined && self.has_joined(&states[states.len().saturating_sub(more)..], &scale) {
                if self.fruitless >= self.extent.fruitless {
                    return Ok(());
                }
                joined = true;
                left = left.min(self.extent.kept);
            }
            if left == 0 {
                break (motion.states, scale);
            }
        };
        if let Some(period) = nearly_repeats_after(&states, &scale, self.largest)
            && self.settle(&states[states.len() - 1], period as u32)? != Led::Nowhere
        {
            return Ok(());
        }
        let known = self.catalogue.known.len();
        if !self.look_near_returns(&states, &scale, interrupted)? {
            self.wandered.append(&mut states);
        }
        self.fruitless = if self.catalogue.known.len() > known { 0 } else { self.fruitless + 1 };
        Ok(())
    }

    /// Whether the latest states of a motion are where another one wandered.
    fn has_joined(&self, latest: &[Vec<f64>], scale: &StateScale) -> bool {
        let is_there =
            |state: &Vec<f64>| self.wandered.iter().any(|other| scale.are_within(state, other, SAME_PLACE));
        latest.iter().filter(|state| is_there(state)).count() >= AMONG_WANDERED
    }

    /// Orbits near which a motion is that has not settled; whether one of them is stable.
    fn look_near_returns(
        &mut self,
        states: &[Vec<f64>],
        scale: &StateScale,
        interrupted: Interruption<'_>,
    ) -> Result<bool, OrbitError> {
        let mut is_near_stable = false;
        for &multiple in self.multiples {
            for nodes in nearest_returns(states, scale, multiple as usize, self.extent.near_returns) {
                is_near_stable |= self.look_from(nodes, multiple, &mut *interrupted)? == Led::ToStable;
                // From all states and from the first one alone Newton's method goes different ways; either
                // may arrive.
                if multiple > 1 {
                    let led = self.look_from(&nodes[..1], multiple, &mut *interrupted)?;
                    is_near_stable |= led == Led::ToStable;
                }
            }
        }
        Ok(is_near_stable)
    }

    /// Newton's method from these nodes.
    fn look_from(
        &mut self,
        nodes: &[Vec<f64>],
        multiple: u32,
        interrupted: Interruption<'_>,
    ) -> Result<Led, OrbitError> {
        if interrupted() {
            return Err(OrbitError::Interrupted);
        }
        let arrived = self.catalogue.probe_for(self.extent.wanted, (0.0, nodes), multiple)?;
        self.note(arrived)
    }

    /// Goes on by some periods and keeps the last states.
    fn advance(
        &mut self,
        motion: &mut Motion,
        periods: usize,
        interrupted: Interruption<'_>,
    ) -> Result<Advanced, OrbitError> {
        let Motion { states, next, approach } = motion;
        let stretch = Stretch { frequency_hz: self.catalogue.frequency_hz, start: 0.0, end: 1.0 };
        for _ in 0..periods {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            let next = match next.take() {
                Some(next) => next,
                None => self.catalogue.integrator().advance(&stretch, &states[states.len() - 1])?,
            };
            if approach.has_arrived(&self.reached, &next) {
                return Ok(Advanced::ToKnownOrbit);
            }
            states.push(next);
        }
        let surplus = states.len().saturating_sub(self.extent.kept);
        states.drain(..surplus);
        Ok(Advanced::SoFar)
    }

    /// The orbit to which a motion has come.
    fn settle(&mut self, state: &[f64], period_multiple: u32) -> Result<Led, OrbitError> {
        let orbit = (self.catalogue.frequency_hz, period_multiple);
        let (start, _) = search_cut(self.catalogue.integrator(), state, orbit)?;
        let arrived = self.catalogue.probe((start.phase, &[start.state]), period_multiple)?;
        self.note(arrived)
    }

    /// Motions that come to a new orbit end from now on, if it is stable.
    fn note(&mut self, arrived: Option<Arrived>) -> Result<Led, OrbitError> {
        let Some(Arrived { place, is_new }) = arrived else { return Ok(Led::Nowhere) };
        let orbit = self.catalogue.known[place].solution.clone();
        if is_new {
            self.reached.add(self.catalogue.integrator(), &orbit)?;
        }
        Ok(if orbit.stable() { Led::ToStable } else { Led::ToUnstable })
    }
}
