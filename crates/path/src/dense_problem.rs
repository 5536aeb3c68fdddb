//! A path problem given by one function: for tests, examples, and small systems.

use crate::{
    dense_lu::DenseLu,
    judge::Judge,
    problem::{Determinant, EvaluationError, PathProblem, SingularJacobian, TestValue},
};

/// A [`PathProblem`] from a function `f(z, R, J) -> signature` and dense LU.
///
/// The function fills `R` (length `n`) and `J = [R_x R_λ]` (`n` rows of `n + 1` entries, one after the other)
/// and returns the signature of the point (zero if there is but one kind).
#[derive(Debug, Clone)]
pub struct DenseProblem<F> {
    function: F,
    weights: Vec<f64>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
    signature: u64,
    lu: DenseLu,
    tests: Vec<fn(&[f64]) -> TestValue>,
    point: Vec<f64>,
    has_root_corners: bool,
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64]) -> u64> DenseProblem<F> {
    /// A problem with all weights one.
    pub fn new(unknowns: usize, function: F) -> Self {
        Self::weighted(vec![1.0; unknowns + 1], function)
    }

    /// A problem with the given weights, `n + 1` of them, all positive.
    pub fn weighted(weights: Vec<f64>, function: F) -> Self {
        assert!(weights.len() >= 2, "at least one unknown and the parameter");
        assert!(weights.iter().all(|&w| w > 0.0 && w.is_finite()), "weights are positive");
        let n = weights.len() - 1;
        let (residual, jacobian) = (vec![0.0; n], vec![0.0; n * (n + 1)]);
        Self {
            function,
            weights,
            residual,
            jacobian,
            signature: 0,
            lu: DenseLu::new(),
            tests: Vec::new(),
            point: Vec::new(),
            has_root_corners: false,
        }
    }

    /// The same problem with these test functions of the point.
    #[must_use]
    pub fn with_tests(mut self, tests: Vec<fn(&[f64]) -> TestValue>) -> Self {
        self.tests = tests;
        self
    }

    /// The same problem, whose `R` changes like a square root behind changes of signature.
    #[must_use]
    pub fn with_root_corners(mut self) -> Self {
        self.has_root_corners = true;
        self
    }

    /// `[R_x R_λ]` at the last evaluated point, row by row.
    #[must_use]
    pub fn jacobian(&self) -> &[f64] {
        &self.jacobian
    }
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64]) -> u64> PathProblem for DenseProblem<F> {
    fn unknowns(&self) -> usize {
        self.residual.len()
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.point.clear();
        self.point.extend_from_slice(point);
        self.signature = (self.function)(point, &mut self.residual, &mut self.jacobian);
        let finite = self.residual.iter().chain(&self.jacobian).all(|value| value.is_finite());
        if finite { Ok(()) } else { Err(EvaluationError::NotFinite) }
    }

    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn factorise(&mut self, row: &[f64]) -> Result<Determinant, SingularJacobian> {
        self.lu.factorise_bordered(&self.jacobian, row)
    }

    fn solve(&self, right_hand_side: &mut [f64]) {
        self.lu.solve(right_hand_side);
    }

    fn tests(&mut self, _: &[u32], values: &mut Vec<TestValue>) {
        values.clear();
        values.extend(self.tests.iter().map(|test| test(&self.point)));
    }

    fn judge(&mut self) -> &mut dyn Judge {
        self
    }
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64]) -> u64> Judge for DenseProblem<F> {
    fn has_root_corners(&self) -> bool {
        self.has_root_corners
    }

    fn signature(&self) -> u64 {
        self.signature
    }
}
