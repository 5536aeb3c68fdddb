//! Wolf's method with a fixed evolution time.
//!
//! One pair of states is followed: a state of the record and a neighbour. After an evolution time of `E`
//! samples their distance has grown from `d` to `d'`, and `ln(d'/d)` is added to a sum. Then the neighbour is
//! replaced by a state not farther away than `largest` whose direction differs least from that of the old
//! one. If none is within 0.3 rad, the distance may be up to five times larger, then the angle twice as
//! large, and so on. If there is none at all, the old neighbour is kept. `l = sum / (number of evolutions * E
//! / f_s)`.
//!
//! Distances below `smallest` do not count: there noise determines the direction.

use super::{
    embedding::Embedding,
    scatter::{ExponentEstimate, GROUPS, LEAST_FLOW_PERIOD, standard_error},
    states::DelayStates,
    tree::NeighbourTree,
};
use crate::error::{SignalError, ensure};

/// Minimum number of evolutions.
const MIN_EVOLUTIONS: usize = 20;
/// Largest angle of a replacement at first [rad].
const ANGLE: f64 = 0.3;
/// Multiples of the largest distance that are tried, and doublings of the angle.
const MULTIPLES: u32 = 5;
const DOUBLINGS: u32 = 3;

/// How the pair is followed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WolfSettings {
    /// Samples of an evolution; `None`: an eighth of the mean period of a flow, 1 for a map.
    pub evolution: Option<usize>,
    /// Largest distance of a new neighbour; `None`: 3 % of the range of the series.
    pub largest: Option<f64>,
    /// Smallest distance of a new neighbour; `None`: 1/1000 of that range.
    pub smallest: Option<f64>,
}

/// An exponent by following a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WolfExponent {
    /// The exponent [1/s].
    pub exponent: ExponentEstimate,
    /// Number of evolutions.
    pub evolutions: usize,
    /// Evolutions that start with a neighbour that could not be replaced.
    pub kept: usize,
    /// Samples of an evolution.
    pub evolution: usize,
}

/// The exponent by following a pair of states.
///
/// # Errors
/// [`SignalError::TooFewNeighbours`] if fewer than 20 evolutions can be followed, [`SignalError::Input`].
pub fn wolf(
    series: &[f64],
    sampling_rate_hz: f64,
    embedding: &Embedding,
    settings: &WolfSettings,
) -> Result<WolfExponent, SignalError> {
    let states = DelayStates::new(series, embedding.delay, embedding.dimension);
    let ends = series.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let range = ends.1 - ends.0;
    let usual = if embedding.mean_period > LEAST_FLOW_PERIOD {
        (embedding.mean_period / 8.0).round() as usize
    } else {
        1
    };
    let evolution = settings.evolution.unwrap_or(usual.max(1));
    let largest = settings.largest.unwrap_or(0.03 * range);
    let smallest = settings.smallest.unwrap_or(1e-3 * range);
    ensure("the evolution time", evolution as f64, "at least 1 sample", evolution >= 1)?;
    ensure(
        "the largest distance",
        largest,
        format!("more than the smallest, {smallest}"),
        largest > smallest,
    )?;
    let tree = NeighbourTree::new(&states, states.len().saturating_sub(evolution));
    let pair = Pair { states, tree, window: embedding.theiler_window, evolution, largest, smallest };
    let (rates, kept) = pair.follow();
    if rates.len() < MIN_EVOLUTIONS {
        return Err(SignalError::TooFewNeighbours { found: rates.len(), asked: series.len() / evolution });
    }
    let scale = sampling_rate_hz / evolution as f64;
    let length = rates.len().div_ceil(GROUPS);
    let groups: Vec<f64> =
        rates.chunks(length).map(|chunk| chunk.iter().sum::<f64>() / chunk.len() as f64 * scale).collect();
    let value = scale * rates.iter().sum::<f64>() / rates.len() as f64;
    let exponent = ExponentEstimate { value, scatter: standard_error(&groups) };
    Ok(WolfExponent { exponent, evolutions: rates.len(), kept, evolution })
}

/// The pair of states that is followed.
struct Pair<'a> {
    states: DelayStates<'a>,
    /// The states that can be followed for an evolution time.
    tree: NeighbourTree,
    window: usize,
    evolution: usize,
    largest: f64,
    smallest: f64,
}

impl Pair<'_> {
    /// Logarithmic growth of each evolution, and the number of evolutions without replacement.
    fn follow(&self) -> (Vec<f64>, usize) {
        let end = self.states.len().saturating_sub(self.evolution);
        let (mut rates, mut kept) = (Vec::new(), 0);
        let mut state = 0;
        let mut neighbour = self.nearest(state);
        while state < end {
            let Some(other) = neighbour.filter(|other| *other < end) else {
                // Without a neighbour, continue along the record until there is one.
                state += self.evolution;
                neighbour = if state < end { self.nearest(state) } else { None };
                continue;
            };
            let before = self.states.square(state, other);
            let (next, moved) = (state + self.evolution, other + self.evolution);
            let after = self.states.square(next, moved);
            if before > 0.0 && after > 0.0 {
                rates.push(0.5 * (after / before).ln());
            }
            state = next;
            let replaced = self.replacement(next, moved);
            kept += usize::from(replaced.is_none());
            neighbour = replaced.or(Some(moved));
        }
        (rates, kept)
    }

    /// The nearest state that is not too near, within a radius that grows until there is one.
    fn nearest(&self, state: usize) -> Option<usize> {
        (1..=MULTIPLES).find_map(|multiple| {
            let near = self.candidates(state, self.largest * f64::from(multiple));
            near.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(other, _)| other)
        })
    }

    /// States within a radius, and their squared distances.
    fn candidates(&self, state: usize, radius: f64) -> Vec<(usize, f64)> {
        let found = self.tree.within(&self.states, state, self.window, radius);
        let distances = found.into_iter().map(|other| (other, self.states.square(state, other)));
        distances.filter(|(_, square)| *square >= self.smallest * self.smallest).collect()
    }

    /// The state whose direction differs least from that of the old neighbour, within the smallest bounds
    /// that hold any state.
    fn replacement(&self, state: usize, old: usize) -> Option<usize> {
        let difference =
            |other: usize, c: usize| self.states.coordinate(other, c) - self.states.coordinate(state, c);
        let old_length = self.states.square(state, old).sqrt();
        let far = self.largest * f64::from(MULTIPLES);
        let near: Vec<(usize, f64, f64)> = self
            .candidates(state, far)
            .into_iter()
            .map(|(other, square)| {
                let product: f64 =
                    (0..self.states.dimension).map(|c| difference(other, c) * difference(old, c)).sum();
                (other, square.sqrt(), (product / (square.sqrt() * old_length)).clamp(-1.0, 1.0).acos())
            })
            .collect();
        for doubling in 0..=DOUBLINGS {
            let angle = ANGLE * f64::from(1 << doubling);
            for multiple in 1..=MULTIPLES {
                let reach = self.largest * f64::from(multiple);
                let best = near
                    .iter()
                    .filter(|(_, distance, turn)| *distance <= reach && *turn < angle)
                    .min_by(|a, b| a.2.total_cmp(&b.2));
                if let Some((other, ..)) = best {
                    return Some(*other);
                }
            }
        }
        None
    }
}
