//! Where a polynomial over a step falls below zero.
//!
//! A polynomial lies in the convex hull of its Bernstein coefficients: if none is negative the polynomial has
//! no zero, and halving the interval sharpens the statement until the first zero is enclosed. Unlike a look
//! at nodal values it misses no zero between nodes.

use super::collocation::NODES;

/// Halvings after which the first zero is located well enough to start Newton's method from.
const HALVINGS: u32 = 24;

/// The first place in [start, 1] where a polynomial falls below `-margin`, from its Bernstein coefficients
/// over that interval.
pub(crate) fn first_below(coefficients: &[f64; NODES], start: f64, margin: f64) -> Option<f64> {
    search(coefficients, margin, (start, 1.0), HALVINGS)
}

fn search(coefficients: &[f64; NODES], margin: f64, (low, high): (f64, f64), halvings: u32) -> Option<f64> {
    if coefficients.iter().all(|&b| b >= -margin) {
        return None;
    }
    if halvings == 0 || coefficients[0] < -margin {
        return Some(low);
    }
    let (left, right) = halves(coefficients);
    let middle = 0.5 * (low + high);
    search(&left, margin, (low, middle), halvings - 1)
        .or_else(|| search(&right, margin, (middle, high), halvings - 1))
}

/// Bernstein coefficients over both halves of the interval, by de Casteljau's scheme.
fn halves(coefficients: &[f64; NODES]) -> ([f64; NODES], [f64; NODES]) {
    let (mut left, mut right) = (*coefficients, *coefficients);
    for level in 1..NODES {
        for i in 0..NODES - level {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
        left[level] = right[0];
    }
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::collocation::Grading;

    fn first_zero(of: impl Fn(f64) -> f64) -> Option<f64> {
        let rule = Grading::Smooth.rule();
        first_below(&rule.bernstein(&rule.s.map(of)), rule.s[0], 1e-13)
    }

    #[test]
    fn a_dip_between_two_nodes_is_found() {
        let rule = Grading::Smooth.rule();
        let dip = 0.5 * (rule.s[3] + rule.s[4]);
        let polynomial = |depth: f64| move |s: f64| (s - dip).powi(2) - depth;
        assert!(rule.s.iter().all(|&s| polynomial(1e-4)(s) > 0.0));
        let found = first_zero(polynomial(1e-4)).unwrap();
        assert!((found - (dip - 1e-2)).abs() < 1e-6, "{found}");
        assert_eq!(first_zero(polynomial(-1e-6)), None);
    }

    #[test]
    fn the_first_of_several_zeros_is_found() {
        let found = first_zero(|s| (s - 0.3) * (s - 0.5) * (s - 0.9) * -10.0).unwrap();
        assert!((found - 0.3).abs() < 1e-6, "{found}");
    }
}
