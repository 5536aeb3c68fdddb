//! Newton's method from many states, until nothing new comes.
//!
//! The states are those that motions have passed through, transients included: they lie where the system
//! moves, and near its unstable orbits, which a motion may pass but not settle on. Each trial begins in one
//! of four ways, since each of them arrives where others do not:
//!
//! - from the states of one motion at all excitation periods, or from its first one alone;
//! - from states of different motions, one for each excitation period: in chaotic motion an orbit exists for
//!   nearly every such order of events, and the corrections are shared between the periods;
//! - from a state at a random distance from one that was passed.
//!
//! Nothing new for long is not enough to end: as many orbits are still to be expected as were arrived at once
//! only (Good, Biometrika 40 (1953), 237-264: the share of trials that would arrive at something unseen
//! equals the share that arrived where no other did). So trials can be asked to go on until each orbit that
//! they found was arrived at twice.
//!
//! They are states at phase 0; one within a contact of an impact-speed-dependent law is no guess that counts.

use std::collections::HashMap;

use crate::{
    Interruption, OrbitError,
    catalogue::{Arrived, Catalogue},
    noise::Noise,
    solve::{Wanted, nodes_from},
};

/// Force steps of all trials, times the entries of a state and two: they measure what a trial costs where
/// contacts are many. Where modes are many, matrices do: a trial counts like the third power of the entries
/// over [`DENSE`].
const MOST_WORK: u64 = 2_000_000;

/// Multiplications of matrices that cost like the rest for an entry, for the ten evaluations of a trial.
const DENSE: u64 = 1000;

/// Ways to start that take states of one motion only, of eight that take turns.
const OF_ONE_MOTION: [usize; 6] = [0, 1, 3, 4, 5, 7];

/// States that motions have passed through, one motion after the other.
#[derive(Debug, Default)]
pub(crate) struct Passed {
    pub motions: Vec<Vec<Vec<f64>>>,
}

impl Passed {
    fn any<'s>(&'s self, noise: &mut Noise) -> &'s [f64] {
        let motion = &self.motions[noise.below(self.motions.len())];
        // Motion that gains or loses energy over many periods passes the orbits near its start in a few:
        // every other state is from a period that is uniform in its logarithm.
        let place = if noise.share() < 0.5 {
            noise.below(motion.len())
        } else {
            ((motion.len() as f64).powf(noise.share()) as usize - 1).min(motion.len() - 1)
        };
        &motion[place]
    }
}

/// How often trials arrived at each orbit that they found.
#[derive(Debug, Default)]
struct Arrivals(HashMap<usize, usize>);

impl Arrivals {
    fn note(&mut self, arrived: Option<Arrived>) {
        let Some(Arrived { place, is_new, .. }) = arrived else { return };
        if is_new {
            self.0.insert(place, 1);
        } else if let Some(count) = self.0.get_mut(&place) {
            *count += 1;
        }
    }

    fn any_is_alone(&self) -> bool {
        self.0.values().any(|count| *count == 1)
    }
}

/// What trials look for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sought {
    pub period_multiple: u32,
    wanted: Wanted,
    /// Of the random numbers that choose states.
    seed: u64,
}

impl Sought {
    /// All orbits of this period, in all four ways.
    pub fn all(period_multiple: u32) -> Self {
        Self { period_multiple, wanted: Wanted::Any, seed: 1 }
    }

    /// Those that few trials can find: near states of one motion, other ones with each seed.
    pub fn nearby(period_multiple: u32, seed: u64) -> Self {
        Self { period_multiple, wanted: Wanted::Nearby, seed }
    }

    /// The number that says in which way a trial begins.
    fn way(self, trial: usize) -> usize {
        if self.wanted == Wanted::Any { trial } else { OF_ONE_MOTION[trial % OF_ONE_MOTION.len()] }
    }
}

/// How long to go on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Patience {
    /// Trials without a new orbit after which the search ends,
    pub trials: usize,
    /// and more for each orbit that is known,
    pub for_each: usize,
    /// and, if so, until each orbit that trials found was arrived at twice,
    pub asks_for_two_arrivals: bool,
    /// but no more trials than these.
    pub most: usize,
}

/// Looks for orbits from states that were passed.
///
/// # Returns
/// Whether the patience has ended; else its bound or the bound of the work did, and there may be more orbits.
pub(crate) fn sample(
    catalogue: &mut Catalogue<'_>,
    passed: &Passed,
    sought: Sought,
    patience: Patience,
    interrupted: Interruption<'_>,
) -> Result<bool, OrbitError> {
    if passed.motions.is_empty() {
        return Ok(true);
    }
    let Sought { period_multiple, wanted, seed } = sought;
    let mut noise = Noise::new(seed);
    let (mut since, mut work) = (0, 0);
    let mut arrivals = Arrivals::default();
    for trial in 0..patience.most {
        if interrupted() {
            return Err(OrbitError::Interrupted);
        }
        let before = catalogue.steps();
        let nodes = guess(catalogue, passed, (sought.way(trial), period_multiple), &mut noise);
        let arrived = match nodes {
            Some(nodes) => catalogue.probe_for(wanted, (0.0, &nodes), period_multiple)?,
            None => None,
        };
        let states = 2 * catalogue.system.dof() as u64;
        work += (catalogue.steps() - before) * (2 + states) + states.pow(3) / DENSE;
        let is_wanted = |a: &Arrived| catalogue.known[a.place].solution.period_multiple == period_multiple;
        let arrived = arrived.filter(is_wanted);
        since = if arrived.as_ref().is_some_and(|a| a.is_new) { 0 } else { since + 1 };
        arrivals.note(arrived);
        let patience_ends = patience.trials + patience.for_each * catalogue.count(period_multiple);
        if since >= patience_ends && !(patience.asks_for_two_arrivals && arrivals.any_is_alone()) {
            return Ok(true);
        }
        if work > MOST_WORK {
            break;
        }
    }
    Ok(false)
}

/// Nodes of a trial; `None` where no motion can be computed.
fn guess(
    catalogue: &mut Catalogue<'_>,
    passed: &Passed,
    (way, period_multiple): (usize, u32),
    noise: &mut Noise,
) -> Option<Vec<Vec<f64>>> {
    let frequency_hz = catalogue.frequency_hz;
    let state = passed.any(noise).to_vec();
    let mut along = |state: &[f64], segments: usize| {
        nodes_from(catalogue.integrator(), (0.0, state), frequency_hz, period_multiple, segments).ok()
    };
    let count = period_multiple as usize;
    match way % 4 {
        0 => along(&state, count),
        1 => Some(vec![state]),
        2 if count == 1 => {
            // Half a period later another motion.
            let other = along(passed.any(noise), 2)?.swap_remove(1);
            Some(vec![state, other])
        }
        2 => Some((0..count).map(|_| passed.any(noise).to_vec()).collect()),
        _ => {
            let reach = 10f64.powf(-3.0 * noise.share());
            let scale = catalogue.scale(passed.any(noise));
            let moved: Vec<f64> =
                state.iter().zip(scale.values()).map(|(z, s)| z + reach * s * noise.signed()).collect();
            if way % 8 == 3 {
                Some(vec![moved])
            } else {
                nodes_from(catalogue.integrator(), (0.0, &moved), frequency_hz, period_multiple, count).ok()
            }
        }
    }
}
