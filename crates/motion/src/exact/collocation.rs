//! Collocation of the contact force over a step: nodes, and the constants of its exact convolution with
//! the modes. Equations (S1) and (S5) of the book, `docs/theory`.
//!
//! Over a step of length h the force is a polynomial of degree `NODES - 1` in a variable `s` in [0, 1] that
//! is mapped to the time `t = h c(s)`. A Hertz force starts like `t^1.5`, hence like `s^3` under `c = s^2`:
//! with the map graded at the touch or at the release it is smooth in `s`, and no small steps are needed. The
//! nodes are those of Gauss for the weight `c'(s)`, so integrals of the force against smooth functions of
//! time converge twice as fast as the force itself.
//!
//! With the Lagrange polynomials `l_j`, the convolution with a mode follows from its power series: `int_0^{h
//! c_k} exp(A (h c_k - t)) l_j dt = sum_m A^m h^{m+1} w_mkj`, `w_mkj = int_0^{c_k} (c_k - c)^m/m! l_j dc`,
//! and the same up to the end of the step. The constants `w` depend on the map only.

use std::sync::OnceLock;

use faer::{Mat, linalg::solvers::DenseSolveCore};

use super::{
    lanes::{dot, fixed_dot, vectorised},
    recurrence::{Recurrence, gauss_legendre},
};

/// Force nodes in a step, a multiple of four.
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
    /// Coefficients of a force in the orthonormal polynomials from its nodal values, indexed
    /// `[degree][node]`.
    pub coefficients: [[f64; NODES]; NODES],
    /// Lagrange polynomials at [`FINE`]` + 1` equal steps of the variable, indexed `[node][place]`, zero
    /// behind.
    pub fine: [[f64; PLACES]; NODES],
    /// `c_k/c'(s_k)`: how far s moves at node k if the step becomes longer by a small part of itself.
    pub lag: [f64; NODES],
    /// `d l_j/ds` at `s_k`, indexed `[k][j]`.
    derivative: [[f64; NODES]; NODES],
    /// Bernstein coefficients from nodal values, indexed `[coefficient][node]`, from the first node to the
    /// end of the step.
    to_bernstein: [[f64; NODES]; NODES],
    /// The same over all of the step.
    to_whole: [[f64; NODES]; NODES],
    /// Largest magnitude of the two highest orthonormal polynomials in the step.
    pub highest: f64,
    recurrence: Recurrence,
}

/// Intervals of the table on which extrema in a step are looked for.
pub(crate) const FINE: usize = 32;
/// Its places, and as many behind them as make a multiple of four.
pub(crate) const PLACES: usize = 36;

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
            fine: [[0.0; PLACES]; NODES],
            lag: s.map(|s| grading.map(s).0 / grading.map(s).1),
            derivative: derivative(&s),
            to_bernstein: to_bernstein(&s, s[0]),
            to_whole: to_bernstein(&s, 0.0),
            highest: recurrence.highest(),
            recurrence,
        };
        for place in 0..=FINE {
            let lagrange = rule.lagrange(place as f64 / FINE as f64);
            (0..NODES).for_each(|node| rule.fine[node][place] = lagrange[node]);
        }
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
        products(&self.derivative, values)
    }

    /// Bernstein coefficients of a polynomial from the first node to the end of the step, from its values at
    /// the nodes.
    pub fn bernstein(&self, values: &[f64; NODES]) -> [f64; NODES] {
        products(&self.to_bernstein, values)
    }

    /// Bernstein coefficients of a polynomial over all of the step, from its values at the nodes.
    pub fn bernstein_of_whole(&self, values: &[f64; NODES]) -> [f64; NODES] {
        products(&self.to_whole, values)
    }

    /// Expansion of a polynomial in the orthonormal polynomials, from its values at the nodes.
    #[inline(always)]
    pub fn expansion(&self, values: &[f64]) -> [f64; NODES] {
        let mut expansion = [0.0; NODES];
        (0..NODES).for_each(|degree| expansion[degree] = dot(&self.coefficients[degree], values));
        expansion
    }

    /// Values of a polynomial at several places, from its expansion.
    #[inline(always)]
    pub fn sums<const N: usize>(&self, expansion: &[f64; NODES], places: &[f64; N]) -> [f64; N] {
        self.recurrence.sums(expansion, places)
    }

    /// Lagrange polynomials at `s`.
    pub fn lagrange(&self, s: f64) -> [f64; NODES] {
        let values = self.recurrence.values(s);
        std::array::from_fn(|node| (0..NODES).map(|d| self.coefficients[d][node] * values[d]).sum())
    }
}

/// A matrix over the nodes times values at them.
fn products(matrix: &NodeMatrix, values: &[f64; NODES]) -> [f64; NODES] {
    vectorised(
        #[inline(always)]
        || {
            let mut products = [0.0; NODES];
            products.iter_mut().zip(matrix).for_each(|(product, row)| *product = fixed_dot(row, values));
            products
        },
    )
}

/// `c_k^m/m!`.
fn powers(c: [f64; NODES]) -> Vec<[f64; NODES]> {
    let next = |(m, power): &(usize, [f64; NODES])| {
        Some((m + 1, std::array::from_fn(|k| power[k] * c[k] / (m + 1) as f64)))
    };
    std::iter::successors(Some((0, [1.0; NODES])), next).take(TERMS).map(|(_, power)| power).collect()
}

/// Derivatives of the Lagrange polynomials at their nodes: `(w_j/w_k)/(s_k - s_j)` with the barycentric
/// weights w.
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

/// The inverse of `binomial(n, i) x_k^i (1 - x_k)^(n - i)`, `n = NODES - 1`, where x runs from 0 at `start`
/// to 1 at the end of the step.
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

#[cfg(test)]
mod tests {
    use super::*;

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
