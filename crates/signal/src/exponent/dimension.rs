//! The embedding dimension by false nearest neighbours.
//!
//! A coinciding state does not count as a neighbour: in a record that repeats every state recurs, in any
//! dimension.

use super::{states::DelayStates, tree::NeighbourTree};

/// Largest dimension that is tried.
const LARGEST: usize = 10;
/// Permitted fraction of false neighbours.
const FALSE: f64 = 0.01;
/// Growth of the distance, and distance in standard deviations, above which a neighbour is false.
const GROWTH: f64 = 15.0;
const FAR: f64 = 2.0;
/// Distance in standard deviations up to which two states coincide.
const SAME: f64 = 1e-4;
/// Approximate number of states that are examined.
const STATES: usize = 2000;

/// The smallest dimension with few false neighbours.
///
/// * `window`: Theiler window in samples.
pub(super) fn choose(series: &[f64], delay: usize, window: usize) -> usize {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let deviation =
        (series.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / series.len() as f64).sqrt();
    for dimension in 1..LARGEST {
        let states = DelayStates::new(series, delay, dimension);
        // The next coordinate must exist, too.
        let count = DelayStates::new(series, delay, dimension + 1).len();
        if count < 2 * window + 20 {
            return dimension;
        }
        let tree = NeighbourTree::new(&states, count);
        let (mut all, mut wrong) = (0, 0);
        for state in (0..count).step_by((count / STATES).max(1)) {
            let Some((neighbour, square)) = tree.nearest(&states, state, window, SAME * deviation) else {
                continue;
            };
            let next = (series[state + dimension * delay] - series[neighbour + dimension * delay]).abs();
            let distance = square.sqrt();
            all += 1;
            let far = square + next * next > (FAR * deviation).powi(2);
            wrong += usize::from(far || next > GROWTH * distance);
        }
        if f64::from(wrong as u32) <= FALSE * f64::from(all as u32) {
            return dimension;
        }
    }
    LARGEST
}
