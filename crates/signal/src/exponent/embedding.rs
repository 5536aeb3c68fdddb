//! The choice of an embedding: delay, dimension, Theiler window.

use super::{delay, dimension, repeat, scatter::LEAST_FLOW_PERIOD};
use crate::error::{SignalError, ensure, ensure_series};

/// Minimum number of samples.
const MIN_SAMPLES: usize = 100;

/// How states are reconstructed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Embedding {
    /// Delay between coordinates, in samples.
    pub delay: usize,
    /// Number of coordinates.
    pub dimension: usize,
    /// Minimum distance of neighbours in time, in samples.
    pub theiler_window: usize,
    /// Mean period in samples.
    pub mean_period: f64,
}

/// Parts of an embedding that the user specifies; the others are chosen automatically.
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
/// for a motion that is periodic; [`SignalError::Input`] for a choice outside its range.
pub fn embedding(series: &[f64], choice: &EmbeddingChoice) -> Result<Embedding, SignalError> {
    ensure_series("an exponent", series, MIN_SAMPLES)?;
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
    let window = if mean_period > LEAST_FLOW_PERIOD { mean_period.ceil() as usize } else { 1 };
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
