//! A condition of a curve, linearised.

/// Values of a condition, their gradients by `[nodes; f; p]` (at grazing `[nodes; f; p; x]`), and what its
/// test functions are made of.
#[derive(Debug, Clone, Default)]
pub(super) struct Linear {
    pub values: Vec<f64>,
    pub rows: Vec<Vec<f64>>,
    pub tests: Vec<f64>,
}
