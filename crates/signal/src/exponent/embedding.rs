//! States out of one series.

use super::{delay, dimension, repeat};
use crate::error::{SignalError, ensure, ensure_series};

/// Fewest samples.
const FEWEST: usize = 100;

/// How states are built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Embedding {
    /// Delay between coordinates, in samples.
    pub delay: usize,
    /// Number of coordinates.
    pub dimension: usize,
    /// Neighbours have to be further apart in time than this, in samples.
    pub theiler_window: usize,
    /// Mean period in samples.
    pub mean_period: f64,
}

/// What the user says about it; the rest is found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct EmbeddingChoice {
    /// Delay in samples.
    pub delay: Option<usize>,
    /// Number of coordinates.
    pub dimension: Option<usize>,
    /// Theiler window in samples.
    pub theiler_window: Option<usize>,
}

/// Chooses an embedding for a series.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`], [`SignalError::Constant`]; [`SignalError::Repeats`]
/// for a motion that is periodic; [`SignalError::Input`] for a choice that makes no sense.
pub fn embedding(series: &[f64], choice: &EmbeddingChoice) -> Result<Embedding, SignalError> {
    ensure_series("an exponent", series, FEWEST)?;
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    if series.iter().all(|value| *value == series[0]) {
        return Err(SignalError::Constant);
    }
    if let Some(samples) = repeat::repeats_after(series) {
        return Err(SignalError::Repeats { samples, percent: 100.0 * repeat::SAME });
    }
    let crossings = series.windows(2).filter(|pair| (pair[0] < mean) != (pair[1] < mean)).count();
    let mean_period = 2.0 * series.len() as f64 / crossings.max(1) as f64;
    let delay = choice.delay.unwrap_or_else(|| delay::choose(series));
    let window = if mean_period > super::FLOW { mean_period.ceil() as usize } else { 1 };
    let theiler_window = choice.theiler_window.unwrap_or(window);
    ensure("the delay", delay as f64, "at least 1 sample", delay >= 1)?;
    let dimension = match choice.dimension {
        Some(dimension) => dimension,
        None => dimension::choose(series, delay, theiler_window),
    };
    ensure("the embedding dimension", dimension as f64, "from 1 to 20", (1..=20).contains(&dimension))?;
    let embedding = Embedding { delay, dimension, theiler_window, mean_period };
    let needed = (dimension - 1) * delay + 2 * theiler_window + 10;
    ensure_series("an exponent with this delay, dimension and Theiler window", series, needed)?;
    Ok(embedding)
}

/// States of a series.
pub(super) struct States<'a> {
    series: &'a [f64],
    delay: usize,
    pub dimension: usize,
}

impl<'a> States<'a> {
    pub(super) const fn new(series: &'a [f64], delay: usize, dimension: usize) -> Self {
        Self { series, delay, dimension }
    }

    /// Number of states.
    pub(super) const fn len(&self) -> usize {
        self.series.len().saturating_sub((self.dimension - 1) * self.delay)
    }

    /// A coordinate of a state.
    pub(super) fn coordinate(&self, state: usize, index: usize) -> f64 {
        self.series[state + index * self.delay]
    }

    /// Squared distance of two states.
    pub(super) fn square(&self, one: usize, other: usize) -> f64 {
        (0..self.dimension).map(|c| (self.coordinate(one, c) - self.coordinate(other, c)).powi(2)).sum()
    }
}
