//! Collocation of the contact force over a step: nodes, and the constants of its exact convolution with the modes.
//!
//! Over a step of length h the force is a polynomial of degree `NODES - 1` in a variable `s` in [0, 1] that is mapped to the time
//! `t = h c(s)`. A Hertz force starts like `t^1.5`, hence like `s^3` under `c = s^2`: with the map graded at the touch or at the release
//! it is smooth in `s`, and no small steps are needed. The nodes are those of Gauss for the weight `c'(s)`, so integrals of the
//! force against smooth functions of time converge twice as fast as the force itself.
//!
//! With the Lagrange polynomials `l_j`, the convolution with a mode follows from its power series:
//! `int_0^{h c_k} exp(A (h c_k - t)) l_j dt = sum_m A^m h^{m+1} w_mkj`, `w_mkj = int_0^{c_k} (c_k - c)^m/m! l_j dc`,
//! and the same up to the end of the step. The constants `w` depend on the map only.

use std::sync::OnceLock;

use faer::{Mat, Side, linalg::solvers::DenseSolveCore};

use super::lanes::dot;

/// Force nodes in a step.
pub(crate) const NODES: usize = 12;
/// Terms of the power series; with [`REACH`] they reach rounding.
pub(crate) const TERMS: usize = 50;
/// Largest `h max(sqrt(k) + c)` for which the power series serve.
pub(crate) const REACH: f64 = 8.0;

/// A matrix over the nodes, row by row.
pub(crate) type NodeMatrix = [[f64; NODES]; NODES];

/// How the force behaves at the ends of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Grading {
    /// Smooth at both ends: `c = s`.
    Smooth,
    /// Sets in at the start with a half-integer power: `c = s^2`.
    Touch,
    /// Ends at the end with a half-integer power: `c = 1 - (1 - s)^2`.
    Release,
}

impl Grading {
    const ALL: [Self; 3] = [Self::Smooth, Self::Touch, Self::Release];

    /// `c(s)` and `c'(s)`.
    pub fn map(self, s: f64) -> (f64, f64) {
        match self {
            Self::Smooth => (s, 1.0),
            Self::Touch => (s * s, 2.0 * s),
            Self::Release => (s * (2.0 - s), 2.0 * (1.0 - s)),
        }
    }

    /// `s` at `c`.
    pub fn inverse(self, c: f64) -> f64 {
        match self {
            Self::Smooth => c,
            Self::Touch => c.max(0.0).sqrt(),
            Self::Release => c / (1.0 + (1.0 - c).max(0.0).sqrt()),
        }
    }

    /// The constants of this grading.
    pub fn rule(self) -> &'static Rule {
        static RULES: OnceLock<[Rule; 3]> = OnceLock::new();
        let rules = RULES.get_or_init(|| Self::ALL.map(Rule::new));
        match self {
            Self::Smooth => &rules[0],
            Self::Touch => &rules[1],
            Self::Release => &rules[2],
        }
    }
}

/// Constants of the collocation with one grading.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    /// `s_k`, ascending.
    pub s: [f64; NODES],
    /// `c_k = c(s_k)`.
    pub c: [f64; NODES],
    /// `w_mkj`, indexed `[m][j][k]`.
    pub at_nodes: Vec<NodeMatrix>,
    /// `c_k^m/m!`, indexed `[m][k]`.
    pub powers: Vec<[f64; NODES]>,
    /// `int_0^1 (1 - c)^m/m! l_j dc`, indexed `[m][j]`.
    pub at_end: Vec<[f64; NODES]>,
    /// Coefficients of a force in the orthonormal polynomials from its nodal values, indexed `[degree][node]`.
    pub coefficients: [[f64; NODES]; NODES],
    /// Lagrange polynomials at [`FINE`]` + 1` equal steps of the variable, indexed `[place][node]`.
    pub fine: Vec<[f64; NODES]>,
    /// `c_k/c'(s_k)`: how far s moves at node k if the step becomes longer by a small part of itself.
    pub lag: [f64; NODES],
    /// `d l_j/ds` at `s_k`, indexed `[k][j]`.
    derivative: [[f64; NODES]; NODES],
    /// Bernstein coefficients from nodal values, indexed `[coefficient][node]`, from the first node to the end of the step.
    to_bernstein: [[f64; NODES]; NODES],
    /// The same over all of the step.
    to_whole: [[f64; NODES]; NODES],
    /// Largest magnitude of the two highest orthonormal polynomials in the step.
    pub highest: f64,
    recurrence: Recurrence,
}

/// Intervals of the table on which extrema in a step are looked for.
pub(crate) const FINE: usize = 32;

impl Rule {
    fn new(grading: Grading) -> Self {
        let fine = gauss_legendre(60);
        let recurrence = Recurrence::stieltjes(|s| grading.map(s).1, &fine);
        let (s, weights) = recurrence.gauss();
        let c = s.map(|s| grading.map(s).0);
        let mut coefficients = [[0.0; NODES]; NODES];
        for node in 0..NODES {
            let values = recurrence.values(s[node]);
            (0..NODES).for_each(|degree| coefficients[degree][node] = weights[node] * values[degree]);
        }
        let mut rule = Self {
            s,
            c,
            at_nodes: Vec::new(),
            powers: powers(c),
            at_end: Vec::new(),
            coefficients,
            fine: Vec::new(),
            lag: s.map(|s| grading.map(s).0 / grading.map(s).1),
            derivative: derivative(&s),
            to_bernstein: to_bernstein(&s, s[0]),
            to_whole: to_bernstein(&s, 0.0),
            highest: recurrence.highest(),
            recurrence,
        };
        rule.fine = (0..=FINE).map(|i| rule.lagrange(i as f64 / FINE as f64)).collect();
        let moments = |end: f64| rule.moments(grading, end, &fine);
        let node_moments: Vec<Vec<[f64; NODES]>> = s.iter().map(|&s| moments(s)).collect();
        rule.at_end = moments(1.0);
        rule.at_nodes = (0..TERMS)
            .map(|m| std::array::from_fn(|j| std::array::from_fn(|k| node_moments[k][m][j])))
            .collect();
        rule
    }

    /// `int_0^{c(end)} (c(end) - c)^m/m! l_j dc` for all m and j.
    fn moments(&self, grading: Grading, end: f64, fine: &[(f64, f64)]) -> Vec<[f64; NODES]> {
        let mut moments = vec![[0.0; NODES]; TERMS];
        let upper = grading.map(end).0;
        for &(x, weight) in fine {
            let (c, slope) = grading.map(end * x);
            let lagrange = self.lagrange(end * x);
            let mut power = weight * end * slope;
            for (m, row) in moments.iter_mut().enumerate() {
                (0..NODES).for_each(|j| row[j] += power * lagrange[j]);
                power *= (upper - c) / (m + 1) as f64;
            }
        }
        moments
    }

    /// Derivative by s of a polynomial at the nodes, from its values there.
    pub fn derivative(&self, values: &[f64; NODES]) -> [f64; NODES] {
        self.derivative.map(|row| dot(&row, values))
    }

    /// Bernstein coefficients of a polynomial from the first node to the end of the step, from its values at the nodes.
    pub fn bernstein(&self, values: &[f64; NODES]) -> [f64; NODES] {
        self.to_bernstein.map(|row| dot(&row, values))
    }

    /// Bernstein coefficients of a polynomial over all of the step, from its values at the nodes.
    pub fn bernstein_of_whole(&self, values: &[f64; NODES]) -> [f64; NODES] {
        self.to_whole.map(|row| dot(&row, values))
    }

    /// Lagrange polynomials at `s`.
    pub fn lagrange(&self, s: f64) -> [f64; NODES] {
        let values = self.recurrence.values(s);
        std::array::from_fn(|node| (0..NODES).map(|d| self.coefficients[d][node] * values[d]).sum())
    }
}

/// `c_k^m/m!`.
fn powers(c: [f64; NODES]) -> Vec<[f64; NODES]> {
    let next = |(m, power): &(usize, [f64; NODES])| {
        Some((m + 1, std::array::from_fn(|k| power[k] * c[k] / (m + 1) as f64)))
    };
    std::iter::successors(Some((0, [1.0; NODES])), next).take(TERMS).map(|(_, power)| power).collect()
}

/// Derivatives of the Lagrange polynomials at their nodes: `(w_j/w_k)/(s_k - s_j)` with the barycentric weights w.
fn derivative(s: &[f64; NODES]) -> [[f64; NODES]; NODES] {
    let weight = |j: usize| (0..NODES).filter(|&i| i != j).map(|i| 1.0 / (s[j] - s[i])).product::<f64>();
    let weights: [f64; NODES] = std::array::from_fn(weight);
    let mut matrix = [[0.0; NODES]; NODES];
    for k in 0..NODES {
        for j in (0..NODES).filter(|&j| j != k) {
            matrix[k][j] = weights[j] / weights[k] / (s[k] - s[j]);
            matrix[k][k] -= matrix[k][j];
        }
    }
    matrix
}

/// The inverse of `binomial(n, i) x_k^i (1 - x_k)^(n - i)`, `n = NODES - 1`, where x runs from 0 at `start` to 1 at the end of the step.
fn to_bernstein(s: &[f64; NODES], start: f64) -> [[f64; NODES]; NODES] {
    let degree = NODES - 1;
    let binomial = |i: usize| (0..i).map(|m| (degree - m) as f64 / (m + 1) as f64).product::<f64>();
    let x = s.map(|s_k| (s_k - start) / (1.0 - start));
    let values = Mat::from_fn(NODES, NODES, |k, i| {
        binomial(i) * x[k].powi(i as i32) * (1.0 - x[k]).powi((degree - i) as i32)
    });
    let inverse = values.partial_piv_lu().inverse();
    std::array::from_fn(|i| std::array::from_fn(|k| inverse[(i, k)]))
}

/// Three-term recurrence of the orthonormal polynomials of a weight on [0, 1].
#[derive(Debug, Clone)]
struct Recurrence {
    alpha: [f64; NODES],
    /// Square roots of the beta coefficients; the first is the root of the total weight.
    beta: [f64; NODES],
}

impl Recurrence {
    /// Stieltjes' procedure on a fine quadrature.
    fn stieltjes(weight: impl Fn(f64) -> f64, fine: &[(f64, f64)]) -> Self {
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
    fn values(&self, s: f64) -> [f64; NODES] {
        let mut values = [0.0; NODES];
        values[0] = 1.0 / self.beta[0];
        for degree in 0..NODES - 1 {
            let before = if degree > 0 { self.beta[degree] * values[degree - 1] } else { 0.0 };
            values[degree + 1] = ((s - self.alpha[degree]) * values[degree] - before) / self.beta[degree + 1];
        }
        values
    }

    /// Largest magnitude of the two polynomials of highest degree: like all Jacobi polynomials with weights that do not grow beyond
    /// the ends faster than a root, they have it at an end.
    fn highest(&self) -> f64 {
        let ends = [self.values(0.0), self.values(1.0)];
        ends.iter()
            .flat_map(|values| &values[NODES - 2..])
            .fold(0.0, |largest, value| value.abs().max(largest))
    }

    /// Nodes and weights of Gauss, from the eigenvalues of the Jacobi matrix (Golub and Welsch 1969).
    fn gauss(&self) -> ([f64; NODES], [f64; NODES]) {
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
pub(crate) fn gauss_sixteen() -> &'static [(f64, f64)] {
    static SIXTEEN: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
    SIXTEEN.get_or_init(|| gauss_legendre(16))
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

    #[test]
    fn every_grading_integrates_powers_of_its_variable_exactly() {
        for grading in Grading::ALL {
            let rule = grading.rule();
            for degree in 0..NODES {
                let values = rule.s.map(|s| s.powi(degree as i32));
                for m in [0, 1, 5] {
                    let ours: f64 = (0..NODES).map(|j| rule.at_end[m][j] * values[j]).sum();
                    let factorial: f64 = (1..=m).map(|v| v as f64).product();
                    let exact: f64 = gauss_legendre(40)
                        .iter()
                        .map(|&(s, w)| {
                            let (c, slope) = grading.map(s);
                            w * slope * (1.0 - c).powi(m as i32) / factorial * s.powi(degree as i32)
                        })
                        .sum();
                    assert!((ours - exact).abs() < 1e-14, "{grading:?} {degree} {m}");
                }
            }
        }
    }

    #[test]
    fn maps_and_their_inverses_agree() {
        for grading in Grading::ALL {
            for s in [0.0, 0.1, 0.6, 1.0] {
                assert!((grading.inverse(grading.map(s).0) - s).abs() < 1e-15);
            }
        }
    }
}
