//! What every integrator takes and gives: a stretch of motion and the flow over it.

use faer::Mat;

/// A stretch of motion between two phases of the excitation.
///
/// Phases are counted in excitation periods ("cycles"): the time is `t = cycles / frequency`, and the
/// excitation of order m goes with `cos(2 pi m cycles + phase)`. Keeping phases fixed while the frequency
/// varies is what a path of periodic solutions needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Excitation frequency [Hz], > 0. Without excitation it only sets the scale of time.
    pub frequency_hz: f64,
    /// Phase at which the stretch starts [cycles].
    pub start: f64,
    /// Phase at which it ends [cycles], >= `start`.
    pub end: f64,
}

impl Stretch {
    /// Duration of the stretch [s].
    #[must_use]
    pub fn duration(&self) -> f64 {
        (self.end - self.start) / self.frequency_hz
    }
}

/// Final state of a stretch and its sensitivities.
///
/// States are `z = [q; q']` in the modal coordinates of the model, displacement first, length 2n.
#[derive(Debug, Clone)]
pub struct Flow {
    /// State at the end of the stretch.
    pub state: Vec<f64>,
    /// Derivative of the final state by the initial one, 2n x 2n (the fundamental matrix).
    pub by_state: Mat<f64>,
    /// Derivative of the final state by the frequency [1/Hz] at fixed phases: it holds both the change of the
    /// load and the change of the duration.
    pub by_frequency: Vec<f64>,
    /// Derivative of the final state by the parameter that the integrator was told
    /// ([`ExactIntegrator::differentiate_by`](crate::exact::ExactIntegrator::differentiate_by)), at fixed
    /// phases; empty without one.
    pub by_parameter: Vec<f64>,
}
