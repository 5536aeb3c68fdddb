//! Wolf's method with a fixed evolution time.
//!
//! One pair of states is followed: the record itself and a neighbour. After `E` samples their distance has
//! grown from `d` to `d'`, and `ln(d'/d)` is summed up. Then the neighbour is replaced by a state not farther
//! than `largest` whose direction from the record differs least from the old one's; if none is within 0.3 rad
//! the distance is allowed to be up to five times larger, then the angle twice as large, and so on; if there
//! is none at all the old neighbour stays. `l = sum / (number of stretches E / f_s)`.
//!
//! Distances below `smallest` do not count: there noise decides on the direction.

use super::{Embedding, FLOW, GROUPS, Scattered, embedding::States, scatter, tree::Tree};
use crate::error::{SignalError, ensure};

/// Fewest stretches.
const FEWEST: usize = 20;
const ANGLE: f64 = 0.3;
/// Multiples of the largest distance that are tried, and doublings of the angle.
const MULTIPLES: u32 = 5;
const DOUBLINGS: u32 = 3;

/// How the pair is followed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WolfSettings {
    /// Samples of a stretch; `None`: an eighth of the mean period of a flow, 1 for a map.
    pub evolution: Option<usize>,
    /// Largest distance of a new neighbour; `None`: 3 % of the range of the series.
    pub largest: Option<f64>,
    /// Smallest distance; `None`: 1/1000 of that range.
    pub smallest: Option<f64>,
}

/// What came out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WolfExponent {
    /// The exponent [1/s].
    pub exponent: Scattered,
    /// Stretches that were followed.
    pub stretches: usize,
    /// Of these, how many begin with a neighbour that could not be replaced.
    pub kept: usize,
    /// Samples of a stretch.
    pub evolution: usize,
}

/// The exponent by following a pair of states.
///
/// # Errors
/// [`SignalError::TooFewNeighbours`] if fewer than 20 stretches can be followed, [`SignalError::Input`].
pub fn wolf(
    series: &[f64],
    sampling_rate_hz: f64,
    embedding: &Embedding,
    settings: &WolfSettings,
) -> Result<WolfExponent, SignalError> {
    let states = States::new(series, embedding.delay, embedding.dimension);
    let ends = series.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let range = ends.1 - ends.0;
    let usual = if embedding.mean_period > FLOW { (embedding.mean_period / 8.0).round() as usize } else { 1 };
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
    let tree = Tree::new(&states, states.len().saturating_sub(evolution));
    let pair = Pair { states, tree, window: embedding.theiler_window, evolution, largest, smallest };
    let (rates, kept) = pair.follow();
    if rates.len() < FEWEST {
        return Err(SignalError::TooFewNeighbours { found: rates.len(), asked: series.len() / evolution });
    }
    let scale = sampling_rate_hz / evolution as f64;
    let length = rates.len().div_ceil(GROUPS);
    let groups: Vec<f64> =
        rates.chunks(length).map(|chunk| chunk.iter().sum::<f64>() / chunk.len() as f64 * scale).collect();
    let value = scale * rates.iter().sum::<f64>() / rates.len() as f64;
    let exponent = Scattered { value, scatter: scatter(&groups) };
    Ok(WolfExponent { exponent, stretches: rates.len(), kept, evolution })
}

struct Pair<'a> {
    states: States<'a>,
    /// Those that can be followed for a stretch.
    tree: Tree,
    window: usize,
    evolution: usize,
    largest: f64,
    smallest: f64,
}

impl Pair<'_> {
    /// Logarithmic growth over each stretch, and in how many the neighbour stayed.
    fn follow(&self) -> (Vec<f64>, usize) {
        let end = self.states.len().saturating_sub(self.evolution);
        let (mut rates, mut kept) = (Vec::new(), 0);
        let mut state = 0;
        let mut neighbour = self.nearest(state);
        while state < end {
            let Some(other) = neighbour.filter(|other| *other < end) else {
                // Without a neighbour the record goes on to where there is one.
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

    /// The nearest state that is not too near: within a radius that grows until there is one.
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
    /// that leave any.
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
