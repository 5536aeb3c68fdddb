//! An exponent with its scatter over parts of the record, which all methods share.

/// Least mean period of a series from a flow, in samples; a series with a shorter one is taken as a map.
pub const LEAST_FLOW_PERIOD: f64 = 6.0;
/// Groups of states whose scatter is the uncertainty.
pub(super) const GROUPS: usize = 10;

/// An exponent and its scatter over parts of the record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExponentEstimate {
    /// The exponent [1/s].
    pub value: f64,
    /// Standard error of the mean of ten parts of the record [1/s]. It does not include the error of the
    /// method, which is often larger.
    pub scatter: f64,
}

/// Standard error of the mean of groups.
pub(super) fn standard_error(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    (variance / n).sqrt()
}
