//! Loads without a steady response, and the motion that they drive from rest.
//!
//! A load `Re(u exp(i w t))`, `u = [beta; phi]`, on a block `p' = s + beta`, `s' = -k p - c s + phi` has no
//! steady response where `i w` is an eigenvalue of the block, and one that loses its digits nearby. There are
//! three kinds of such *secular* loads, by what `drive.rs` takes for near:
//!
//! - *free* (`free.rs`): a constant load on a block without stiffness, as gravity or a torque on a rigid
//!   mode, damped or not;
//! - *resonant* (`resonance.rs`): a harmonic load on a block of nearly that eigenfrequency and with hardly
//!   any damping;
//! - *slow* (`resonance.rs` with `w = 0`): a constant load on a block that a period hardly moves. Its sag may
//!   be a million times what moves, and rounding of it more than is known of that.
//!
//! For all of them the particular solution is the motion from rest at the start of the stretch. Of it this
//! module tells, in closed form and without cancellation,
//!
//! - the state with its derivatives by the time, [`SecularLoad::derivatives`];
//! - the derivative of state and rate by the frequency, [`SecularLoad::by_frequency`];
//! - bounds on each derivative of what an output reads, [`SecularLoad::bounds`], and one on all of them,
//!   [`SecularLoad::majorant`] (`majorant.rs`);
//! - what it does to another block where the damping changes, [`SecularLoad::change`] (`secular/change.rs`).
//!
//! Free and slow loads are constant: their motion from rest is the same whatever the phase at which a stretch
//! begins.

mod change;
mod divided;
mod free;
mod resonance;

#[cfg(test)]
mod tests;

use faer::c64;

use super::{majorant::Majorant, output::Output};
pub(crate) use change::SecularChange;
use change::Source;
use free::Free;
use resonance::Resonant;

/// A load on one block without a steady response.
#[derive(Debug, Clone)]
pub(crate) struct SecularLoad {
    pub block: usize,
    source: Source,
    kind: Kind,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Free(Free),
    Resonant(Resonant),
}

impl SecularLoad {
    /// A load of order 0 acts on a block without stiffness or on a slow one, any other near the resonance of
    /// one with hardly any damping.
    ///
    /// * `(k, c)`: the block; `input`: `[beta, phi]`; `input_by_frequency` [1/Hz].
    /// * `(w, rate)`: circular frequency and its derivative by the excitation frequency.
    /// * `angle`: phase of the load at the start of the stretch.
    pub fn new(
        block: usize,
        (stiffness, damping): (f64, f64),
        input: [c64; 2],
        input_by_frequency: [c64; 2],
        (frequency, rate): (f64, f64),
        angle: f64,
    ) -> Self {
        let turned = c64::new(angle.cos(), angle.sin());
        let [input, by_frequency] = [input, input_by_frequency].map(|input| input.map(|u| u * turned));
        let kind = if frequency == 0.0 && stiffness == 0.0 {
            Kind::Free(Free::new(damping, input.map(|u| u.re), by_frequency.map(|u| u.re)))
        } else {
            Kind::Resonant(Resonant::new((stiffness, damping), input, by_frequency, (frequency, rate)))
        };
        Self { block, source: Source { block: (stiffness, damping), input, frequency }, kind }
    }

    /// Whether the load is of order 0.
    pub fn is_constant(&self) -> bool {
        self.source.frequency == 0.0
    }

    /// `[p, s]` at `time` after the start, and its derivatives by the time.
    pub fn derivatives<const N: usize>(&self, time: f64) -> [[f64; 2]; N] {
        match &self.kind {
            Kind::Free(free) => free.derivatives(time),
            Kind::Resonant(resonant) => resonant.derivatives(time),
        }
    }

    /// Derivatives of `[p, s]` and of its rate by the frequency at `time` after the start.
    pub fn by_frequency(&self, time: f64) -> [[f64; 2]; 2] {
        match &self.kind {
            Kind::Free(free) => free.by_frequency(time),
            Kind::Resonant(resonant) => resonant.by_frequency(time),
        }
    }

    /// Bounds on the part that `output` reads and on its derivatives by the time, until `until`.
    pub fn bounds<const N: usize>(&self, output: &Output, until: f64) -> [f64; N] {
        match &self.kind {
            Kind::Free(free) => free.bounds(self.block, output, until),
            Kind::Resonant(resonant) => resonant.bounds(self.block, output, until),
        }
    }

    /// Bound on all derivatives of the part that `output` reads, until `until`.
    pub fn majorant(&self, output: &Output, until: f64) -> Majorant {
        match &self.kind {
            Kind::Free(free) => free.majorant(self.block, output, until),
            Kind::Resonant(resonant) => resonant.majorant(self.block, output, until),
        }
    }

    /// The change `y' = A y + K x` from rest of another block, or of the same, by what this load does, x.
    ///
    /// * `block`, `(k, c)`: the block that changes; `coupling`: `K`.
    pub fn change(&self, block: usize, of: (f64, f64), coupling: &[[f64; 2]; 2]) -> SecularChange {
        SecularChange::new(block, of, coupling, &self.source)
    }
}
