//! Orthonormal polynomials of a weight on [0, 1], and the rules of Gauss that go with them.

use std::sync::OnceLock;

use faer::{Mat, Side};

use super::collocation::NODES;

/// Three-term recurrence of the orthonormal polynomials of a weight on [0, 1].
#[derive(Debug, Clone)]
pub(super) struct Recurrence {
    alpha: [f64; NODES],
    /// Square roots of the beta coefficients; the first is the root of the total weight.
    beta: [f64; NODES],
}

impl Recurrence {
    /// Stieltjes' procedure on a fine quadrature.
    pub fn stieltjes(weight: impl Fn(f64) -> f64, fine: &[(f64, f64)]) -> Self {
        let measure: Vec<f64> = fine.iter().map(|&(s, w)| w * weight(s)).collect();
        let (mut alpha, mut beta) = ([0.0; NODES], [0.0; NODES]);
        let mut previous = vec![0.0; fine.len()];
        let mut current = vec![1.0; fine.len()];
        for degree in 0..NODES {
            let norm = current.iter().zip(&measure).map(|(p, w)| p * p * w).sum::<f64>().sqrt();
            beta[degree] = norm;
            current.iter_mut().for_each(|p| *p /= norm);
            alpha[degree] = (0..fine.len()).map(|i| fine[i].0 * current[i] * current[i] * measure[i]).sum();
            let next = (0..fine.len())
                .map(|i| {
                    (fine[i].0 - alpha[degree]) * current[i]
                        - if degree > 0 { norm * previous[i] } else { 0.0 }
                })
                .collect();
            previous = std::mem::replace(&mut current, next);
        }
        Self { alpha, beta }
    }

    /// Orthonormal polynomials of degree 0 to `NODES - 1` at `s`.
    pub fn values(&self, s: f64) -> [f64; NODES] {
        let mut values = [0.0; NODES];
        values[0] = 1.0 / self.beta[0];
        for degree in 0..NODES - 1 {
            let before = if degree > 0 { self.beta[degree] * values[degree - 1] } else { 0.0 };
            values[degree + 1] = ((s - self.alpha[degree]) * values[degree] - before) / self.beta[degree + 1];
        }
        values
    }

    /// Sums of an expansion in the orthonormal polynomials at several places.
    #[inline(always)]
    pub fn sums<const N: usize>(&self, expansion: &[f64; NODES], places: &[f64; N]) -> [f64; N] {
        let (mut before, mut current) = ([0.0; N], [1.0 / self.beta[0]; N]);
        let mut sums = current.map(|first| expansion[0] * first);
        for degree in 0..NODES - 1 {
            let inverse = 1.0 / self.beta[degree + 1];
            for i in 0..N {
                let next = (places[i] - self.alpha[degree]) * current[i] - self.beta[degree] * before[i];
                (before[i], current[i]) = (current[i], next * inverse);
                sums[i] += expansion[degree + 1] * current[i];
            }
        }
        sums
    }

    /// Largest magnitude of the two polynomials of highest degree: like all Jacobi polynomials with weights
    /// that do not grow beyond the ends faster than a root, they have it at an end.
    pub fn highest(&self) -> f64 {
        let ends = [self.values(0.0), self.values(1.0)];
        ends.iter()
            .flat_map(|values| &values[NODES - 2..])
            .fold(0.0, |largest, value| value.abs().max(largest))
    }

    /// Nodes and weights of Gauss, from the eigenvalues of the Jacobi matrix (Golub and Welsch 1969).
    pub fn gauss(&self) -> ([f64; NODES], [f64; NODES]) {
        let jacobi = Mat::from_fn(NODES, NODES, |i, j| match i.abs_diff(j) {
            0 => self.alpha[i],
            1 => self.beta[i.max(j)],
            _ => 0.0,
        });
        let nodes =
            jacobi.self_adjoint_eigenvalues(Side::Lower).expect("a small symmetric matrix has eigenvalues");
        let nodes: [f64; NODES] = std::array::from_fn(|i| nodes[i]);
        let weights = nodes.map(|s| 1.0 / self.values(s).iter().map(|p| p * p).sum::<f64>());
        (nodes, weights)
    }
}

/// Sixteen nodes and weights of Gauss-Legendre on [0, 1], made once.
pub(crate) fn gauss_sixteen() -> &'static [(f64, f64); 16] {
    static SIXTEEN: OnceLock<[(f64, f64); 16]> = OnceLock::new();
    SIXTEEN.get_or_init(|| {
        let rule = gauss_legendre(16);
        std::array::from_fn(|k| rule[k])
    })
}

/// Nodes and weights of Gauss-Legendre on [0, 1], by Newton's method on the Legendre polynomial.
pub(crate) fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut previous, mut current) = (1.0, x);
            for degree in 2..=count {
                let d = degree as f64;
                (previous, current) = (current, ((2.0 * d - 1.0) * x * current - (d - 1.0) * previous) / d);
            }
            slope = count as f64 * (x * current - previous) / (x * x - 1.0);
            let correction = current / slope;
            x -= correction;
            if correction.abs() < 1e-16 {
                break;
            }
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_legendre_integrates_a_polynomial_of_high_degree() {
        let sum: f64 = gauss_legendre(20).iter().map(|(x, w)| w * x.powi(39)).sum();
        assert!((sum - 1.0 / 40.0).abs() < 1e-15);
    }
}
