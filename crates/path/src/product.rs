//! The weighted inner product of points, `⟨a, b⟩ = Σ w_i a_i b_i`, and its small relatives.

pub(crate) fn product(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    weights.iter().zip(a).zip(b).map(|((w, x), y)| w * x * y).sum()
}

/// `‖a‖`, the norm of a vector with the weights of its problem.
#[must_use]
pub fn norm(weights: &[f64], a: &[f64]) -> f64 {
    product(weights, a, a).sqrt()
}

/// `‖a − b‖`, the distance of two points with the weights of their problem.
#[must_use]
pub fn distance(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    weights.iter().zip(a).zip(b).map(|((w, x), y)| w * (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// `⟨t, a − b⟩`.
pub(crate) fn progress(weights: &[f64], t: &[f64], a: &[f64], b: &[f64]) -> f64 {
    weights.iter().zip(t).zip(a.iter().zip(b)).map(|((w, t), (x, y))| w * t * (x - y)).sum()
}

/// `a ← a + factor b`.
pub(crate) fn add_scaled(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += factor * y;
    }
}

pub(crate) fn scale(a: &mut [f64], factor: f64) {
    for x in a {
        *x *= factor;
    }
}

/// `W t`, the row with which `row · a = ⟨t, a⟩`.
#[must_use]
pub fn weighed(weights: &[f64], t: &[f64]) -> Vec<f64> {
    weights.iter().zip(t).map(|(w, x)| w * x).collect()
}

/// `row ← W t`.
pub(crate) fn weigh(weights: &[f64], t: &[f64], row: &mut [f64]) {
    for ((r, w), x) in row.iter_mut().zip(weights).zip(t) {
        *r = w * x;
    }
}
