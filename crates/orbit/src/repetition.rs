//! Whether a motion repeats, from its states at successive excitation periods.

use crate::state_scale::StateScale;

/// Distance, relative to the orbit, at which a motion counts as having repeated.
const REPEATED: f64 = 1e-6;
/// Distance over a period below which a motion is on its way to an orbit when it has had its time.
const NEARLY: f64 = 1e-2;

/// The smallest number of periods, up to `largest`, after which the last state has come back.
pub(crate) fn repeats_after(states: &[Vec<f64>], scale: &StateScale, largest: usize) -> Option<usize> {
    let last = states.len() - 1;
    (1..=largest.min(last)).find(|&period| scale.distance(&states[last], &states[last - period]) < REPEATED)
}

/// The number of periods, up to `largest`, after which the last state has come back most closely, if it
/// nearly has.
pub(crate) fn nearly_repeats_after(states: &[Vec<f64>], scale: &StateScale, largest: usize) -> Option<usize> {
    let last = states.len() - 1;
    let distance = |period: usize| scale.distance(&states[last], &states[last - period]);
    let closest = (1..=largest.min(last)).map(|period| (distance(period), period));
    // A motion that comes back after one period comes back after two as well: a longer one has to be much
    // closer.
    let (off, period) = closest.reduce(|best, other| if other.0 < 0.1 * best.0 { other } else { best })?;
    (off < NEARLY).then_some(period)
}
