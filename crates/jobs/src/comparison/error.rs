//! Why there is no comparison.

use crate::counted;

/// Why there is no comparison.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ComparisonError {
    /// The quantity was not measured.
    #[error("no point has a measured {quantity}")]
    NothingMeasured { quantity: &'static str },
    /// Too few points for what is to be fitted.
    #[error(
        "a fit of {} to {quantity} was asked for, but of {}, at the \
        best shift and factor that were tried, {met} meet a stable branch of their period and only {near} \
        of them lie within a factor of {} of it; are frequency and unit right? Give --frequency-factor or \
        --frequency-offset and --amplitude-factor, or measure more",
        counted(*fitted as u64, "number"),
        counted(*measured as u64, "periodic point"),
        to_digits(*ratio)
    )]
    TooFewPoints {
        quantity: &'static str,
        fitted: usize,
        measured: usize,
        met: usize,
        near: usize,
        ratio: f64,
    },
    /// A number that makes no sense.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: &'static str },
}

/// A number rounded to six significant digits.
fn to_digits(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}
