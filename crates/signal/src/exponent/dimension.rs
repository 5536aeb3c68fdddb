//! The embedding dimension by false nearest neighbours.
//!
//! A neighbour on the same spot is none: in a record that repeats each state comes again, whatever the
//! dimension.

use super::{embedding::States, tree::Tree};

/// Largest dimension that is looked at.
const LARGEST: usize = 10;
/// Part of false neighbours that is allowed.
const FALSE: f64 = 0.01;
/// Growth of the distance, and distance in standard deviations, beyond which a neighbour is false.
const GROWTH: f64 = 15.0;
const FAR: f64 = 2.0;
/// Distance in standard deviations up to which two states are the same.
const SAME: f64 = 1e-4;
/// States that are looked at, about.
const STATES: usize = 2000;

pub(super) fn choose(series: &[f64], delay: usize, window: usize) -> usize {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let deviation =
        (series.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / series.len() as f64).sqrt();
    for dimension in 1..LARGEST {
        let states = States::new(series, delay, dimension);
        // The next coordinate has to be there too.
        let count = States::new(series, delay, dimension + 1).len();
        if count < 2 * window + 20 {
            return dimension;
        }
        let tree = Tree::new(&states, count);
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
