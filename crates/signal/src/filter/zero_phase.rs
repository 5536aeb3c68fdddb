//! Filtering forwards and backwards.

use super::Sections;
use crate::error::{SignalError, ensure_series};

impl Sections {
    /// Samples by which a series is continued at each end: three times the order of the whole chain plus one.
    fn padding(&self) -> usize {
        let first_order = self.sections().iter().filter(|section| section.single).count();
        3 * (2 * self.sections().len() + 1 - first_order)
    }

    /// Filters forwards and backwards: no delay, the gain squared.
    ///
    /// The series is continued at both ends by `2 x_end - x_mirrored`, and each run begins in the steady
    /// state of its first value.
    ///
    /// # Errors
    /// [`SignalError::TooShort`] if the series is not longer than what it is continued by;
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
