//! Dense output: the state anywhere within a step, to order 7.
//!
//! With `x` from 0 to 1 over the step and `y = 1 - x`,
//! `z(x) = z_0 + x (d_1 + y (d_2 + x (d_3 + y (d_4 + x (d_5 + y (d_6 + x d_7))))))`.
//!
//! # Source
//! Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I* (1993), section II.6.

use super::{
    stepper::Stepper,
    tableau::{DENSE_TERMS, END},
};

/// The polynomial of one step.
pub(super) struct Dense {
    dimension: usize,
    /// `z_0, d_1, ..., d_7`, one after another.
    terms: Vec<f64>,
}

impl Dense {
    pub(super) fn new(dimension: usize) -> Self {
        Self { dimension, terms: vec![0.0; 8 * dimension] }
    }

    /// Takes over the step of a stepper whose dense slopes are there.
    pub(super) fn load(&mut self, stepper: &Stepper, step: f64) {
        let d = self.dimension;
        let (start, end) = (stepper.state(), stepper.end_state());
        let (first, last) = (stepper.slope(0), stepper.slope(END));
        for i in 0..d {
            let difference = end[i] - start[i];
            self.terms[i] = start[i];
            self.terms[d + i] = difference;
            self.terms[2 * d + i] = step * first[i] - difference;
            self.terms[3 * d + i] = 2.0 * difference - step * (first[i] + last[i]);
        }
        for (k, terms) in DENSE_TERMS.iter().enumerate() {
            let sum = &mut self.terms[(4 + k) * d..][..d];
            stepper.combination(terms, sum);
            sum.iter_mut().for_each(|value| *value *= step);
        }
    }

    /// Writes `z` at the fraction `x` of the step.
    pub(super) fn state(&self, x: f64, state: &mut [f64]) {
        let d = self.dimension;
        let y = 1.0 - x;
        for i in 0..d {
            let term = |k: usize| self.terms[k * d + i];
            let inner = term(4) + x * (term(5) + y * (term(6) + x * term(7)));
            state[i] = term(0) + x * (term(1) + y * (term(2) + x * (term(3) + y * inner)));
        }
    }
}
