//! Filtering forwards and backwards.

use super::sections::DigitalFilter;
use crate::error::{SignalError, ensure_series};

impl DigitalFilter {
    /// Samples by which a series is extended at each end: three times the order of the filter plus one.
    fn padding(&self) -> usize {
        let first_order = self.sections().iter().filter(|section| section.is_first_order).count();
        3 * (2 * self.sections().len() + 1 - first_order)
    }

    /// Filters forwards and backwards: no delay, the gain squared.
    ///
    /// The series is extended at both ends by `2 x_end - x_mirrored`, and each run starts in the steady state
    /// of its first value.
    ///
    /// # Errors
    /// [`SignalError::TooShort`] if the series is not longer than its extension;
    /// [`SignalError::NotFinite`].
    pub fn zero_phase(&self, series: &[f64]) -> Result<Vec<f64>, SignalError> {
        let padding = self.padding();
        ensure_series("filtering forwards and backwards", series, padding + 1)?;
        let (first, last) = (series[0], series[series.len() - 1]);
        let mut long = Vec::with_capacity(series.len() + 2 * padding);
        long.extend(series[1..=padding].iter().rev().map(|value| 2.0 * first - value));
        long.extend_from_slice(series);
        long.extend(
            series[series.len() - 1 - padding..series.len() - 1].iter().rev().map(|value| 2.0 * last - value),
        );
        for _ in 0..2 {
            let memory = self.steady(long[0]);
            self.run(&mut long, memory);
            long.reverse();
        }
        long.truncate(padding + series.len());
        long.drain(..padding);
        Ok(long)
    }
}
