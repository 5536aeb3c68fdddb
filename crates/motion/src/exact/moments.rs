//! What a force over part of a step makes of outputs and states: the power series of `series.rs` on the
//! moments of the force.
//!
//! `int exp(A (T - t)) B F dt = sum_m A^m B mu_m`, `mu_m = int (T - t)^m/m! F dt`: the moments are those of
//! all outputs and of all their derivatives.

use super::{collocation::TERMS, drive::Jet, lanes::add_multiple, series::Series};

/// Moments of a force, see [`Series::moments`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments {
    moments: [f64; TERMS],
    terms: usize,
}

impl Series {
    /// Moments `int (rate (T - t))^m/m! F dt` of a force up to a time T within the reach, from sixteen times
    /// `t`.
    ///
    /// * `delays`: `T - t` [s]; `impulses`: forces times the weights of a quadrature [N s]; `duration`: the
    ///   longest delay.
    #[inline(always)]
    pub fn moments(&self, delays: &[f64; 16], impulses: [f64; 16], duration: f64) -> Moments {
        let (mut moments, mut powers) = ([0.0; TERMS], impulses);
        let z = delays.map(|delay| delay * self.rate);
        let terms = Self::terms(duration * self.rate).min(TERMS);
        for (m, moment) in moments[..terms].iter_mut().enumerate() {
            let mut lanes = [0.0; 4];
            for quad in powers.as_chunks::<4>().0 {
                (0..4).for_each(|lane| lanes[lane] += quad[lane]);
            }
            *moment = (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
            let share = 1.0 / (m + 1) as f64;
            (0..16).for_each(|k| powers[k] *= z[k] * share);
        }
        Moments { moments, terms }
    }

    /// What an element's force makes of an output and its derivatives, apart from the direct part.
    pub fn response(&self, output: usize, element: usize, moments: &Moments) -> Jet {
        let markov = &self.markov[output * self.columns.len() + element];
        let mut sums = [0.0; 3];
        for (m, moment) in moments.moments[..moments.terms.min(TERMS - 1)].iter().enumerate() {
            (0..3).for_each(|d| sums[d] += markov[m + d] * moment);
        }
        Jet { value: sums[0], slope: sums[1] * self.rate, curvature: sums[2] * self.rate * self.rate }
    }

    /// Adds what an element's force makes of a state.
    pub fn add_response(&self, element: usize, moments: &Moments, state: &mut [f64]) {
        let powers = self.columns[element].iter().zip(&moments.moments[..moments.terms]);
        powers.for_each(|(column, moment)| add_multiple(state, *moment, column));
    }
}
