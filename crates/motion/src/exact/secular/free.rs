//! A constant load on a block without stiffness: a free body under its weight or a torque, with or without a
//! damper to the ground.
//!
//! From `p' = s + beta`, `s' = -c s + phi` and rest, with the divided differences of `divided.rs`,
//!
//! `s = phi t e_1(-c t)`, `p = beta t + phi t^2 e_2(-c t)`, `s' = phi exp(-c t)`,
//!
//! and every further derivative is `p^(j+1) = s^(j)`, `s^(j+1) = -c s^(j)`. Of a block without damping that
//! is the parabola `beta t + phi t^2/2`.
//!
//! **Bounds.** With `c >= 0` the integrals `t e_1(-c t)` and `t^2 e_2(-c t)` grow with t, and `exp(-c t) <=
//! 1`: so the same sums of magnitudes at the end of a time bound p and s all over it, and `|s'| <= |phi|`.
//! Of what a row reads, the derivatives from the second on fall like powers of c.

use super::{
    super::{majorant::Majorant, output::Output},
    divided::divided,
};

/// The load and its block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Free {
    damping: f64,
    /// `[beta, phi]`.
    input: [f64; 2],
    input_by_frequency: [f64; 2],
}

impl Free {
    pub fn new(damping: f64, input: [f64; 2], input_by_frequency: [f64; 2]) -> Self {
        Self { damping, input, input_by_frequency }
    }

    /// `[p, s]` at `time` after the start, and its derivatives by the time.
    pub fn derivatives<const N: usize>(&self, time: f64) -> [[f64; 2]; N] {
        let decay = (-self.damping * time).exp();
        self.sums(self.input, (time, decay), -self.damping)
    }

    /// Derivatives of `[p, s]` and of its rate by the frequency.
    pub fn by_frequency(&self, time: f64) -> [[f64; 2]; 2] {
        let decay = (-self.damping * time).exp();
        self.sums(self.input_by_frequency, (time, decay), -self.damping)
    }

    /// Bounds on what `output` reads of the block, until `until`, and on its derivatives.
    ///
    /// * `block`: the place of the block.
    pub fn bounds<const N: usize>(&self, block: usize, output: &Output, until: f64) -> [f64; N] {
        let [p, s] = rows(block, output);
        let all: [[f64; 2]; N] = self.sums(self.input.map(f64::abs), (until, 1.0), self.damping);
        all.map(|[of_p, of_s]| p * of_p + s * of_s)
    }

    /// The same of all derivatives.
    pub fn majorant(&self, block: usize, output: &Output, until: f64) -> Majorant {
        let [_, speed] = self.bounds(block, output, until);
        let ([p, s], bend) = (rows(block, output), self.input[1].abs());
        Majorant { speed, rate: self.damping, acceleration: (p + s * self.damping) * bend }
    }

    /// The motion by its integrals, with what is left of `s'` and the factor of further derivatives of s.
    fn sums<const N: usize>(
        &self,
        [beta, phi]: [f64; 2],
        (time, left): (f64, f64),
        factor: f64,
    ) -> [[f64; 2]; N] {
        let [first, second] = divided(-self.damping * time);
        let mut state = [time * (beta + phi * time * second), phi * time * first];
        let (mut inflow, mut rate) = (beta, phi * left);
        std::array::from_fn(|_| {
            let here = state;
            state = [here[1] + inflow, rate];
            (inflow, rate) = (0.0, factor * rate);
            here
        })
    }
}

fn rows(block: usize, output: &Output) -> [f64; 2] {
    [block, output.row.len() / 2 + block].map(|place| output.row[place].abs())
}
