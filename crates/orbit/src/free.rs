//! Free periodic motion of an undamped system: amplitude given, frequency unknown.
//!
//! The flow `Z(z, f)` over one cycle of the unknown frequency f must close, `Z(z, f) = z`, with the response
//! point at rest at its amplitude a: `y(z) = a`, `y'(z) = 0`. These are 2n + 2 equations for 2n + 1 unknowns,
//! one of them redundant since the energy is conserved; they are solved by Gauss-Newton.

use faer::{Mat, linalg::solvers::SolveLstsq};
use hammerbeam_motion::{Stretch, System, exact::ExactIntegrator};

use crate::{OrbitError, OrbitSettings, Response, solve::integrator, state_scale::state_scale};

/// A free periodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeOrbit {
    /// Frequency of the motion [Hz].
    pub frequency_hz: f64,
    /// State `[q; q']` at the amplitude, length 2n.
    pub state: Vec<f64>,
    /// Newton's correction that is still due, in the relative energy norm.
    pub error_estimate: f64,
}

const MAX_ITERATIONS: u32 = 30;
/// Steps per period of the lowest mode when the first guess of the period is looked for.
const STEPS: f64 = 256.0;

/// Free motion in which the response point reaches `amplitude` [m], in the neighbourhood of the lowest
/// elastic mode.
///
/// # Errors
/// [`OrbitError::NotConverged`] if there is no such motion (the system is damped or loaded, or the mode does
/// not move the point).
pub fn free_orbit(
    system: &System,
    response: &Response,
    amplitude: f64,
    settings: &OrbitSettings,
) -> Result<FreeOrbit, OrbitError> {
    let mut integrator = integrator(system, response, settings)?;
    let (mut state, mut frequency_hz) = first_guess(&mut integrator, response, amplitude)?;
    let scale = state_scale(system, &state, frequency_hz);
    let mut correction = f64::INFINITY;
    for _ in 0..MAX_ITERATIONS {
        let (matrix, right) =
            equations(&mut integrator, response, (&state, frequency_hz), amplitude, scale.values())?;
        let update = matrix.col_piv_qr().solve_lstsq(&right);
        correction = update.col(0).norm_l2();
        if !correction.is_finite() {
            break;
        }
        if correction <= settings.tolerance {
            return Ok(FreeOrbit { frequency_hz, state, error_estimate: correction });
        }
        for (i, value) in state.iter_mut().enumerate() {
            *value += update[(i, 0)] * scale.values()[i];
        }
        frequency_hz *= 1.0 + update[(2 * system.dof(), 0)].clamp(-0.3, 0.3);
    }
    Err(OrbitError::NotConverged { frequency_hz, correction, iterations: MAX_ITERATIONS })
}

/// Matrix and right-hand side of one Gauss-Newton step, for scaled states and the logarithm of the frequency.
fn equations(
    integrator: &mut ExactIntegrator,
    response: &Response,
    (state, frequency_hz): (&[f64], f64),
    amplitude: f64,
    scales: &[f64],
) -> Result<(Mat<f64>, Mat<f64>), OrbitError> {
    let flow = integrator.flow(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, state)?;
    let (size, n) = (state.len(), state.len() / 2);
    let mut matrix = Mat::zeros(size + 2, size + 1);
    let mut right = Mat::zeros(size + 2, 1);
    for i in 0..size {
        for j in 0..size {
            let identity = if i == j { 1.0 } else { 0.0 };
            matrix[(i, j)] = flow.by_state[(i, j)] * scales[j] / scales[i] - identity;
        }
        matrix[(i, size)] = flow.by_frequency[i] * frequency_hz / scales[i];
        right[(i, 0)] = (state[i] - flow.state[i]) / scales[i];
    }
    let read = |values: &[f64]| response.shape.iter().zip(values).map(|(phi, q)| phi * q).sum::<f64>();
    let speed = std::f64::consts::TAU * frequency_hz * amplitude;
    for i in 0..n {
        matrix[(size, i)] = response.shape[i] * scales[i] / amplitude;
        matrix[(size + 1, n + i)] = response.shape[i] * scales[n + i] / speed;
    }
    right[(size, 0)] = 1.0 - read(&state[..n]) / amplitude;
    right[(size + 1, 0)] = -read(&state[n..]) / speed;
    Ok((matrix, right))
}

/// The lowest elastic mode at the amplitude, and the time until its point is at rest on that side again.
fn first_guess(
    integrator: &mut ExactIntegrator,
    response: &Response,
    amplitude: f64,
) -> Result<(Vec<f64>, f64), OrbitError> {
    let frequencies = integrator.system().model().natural_frequencies.clone();
    let n = frequencies.len();
    let mode = (0..n).find(|&i| frequencies[i] > 0.0 && response.shape[i] != 0.0);
    let missing = OrbitError::NotConverged { frequency_hz: 0.0, correction: f64::INFINITY, iterations: 0 };
    let mode = mode.ok_or(missing.clone())?;
    let frequency_hz = frequencies[mode] / std::f64::consts::TAU;
    let mut start = vec![0.0; 2 * n];
    start[mode] = amplitude / response.shape[mode];
    let speed = |state: &[f64]| response.shape.iter().zip(&state[n..]).map(|(phi, v)| phi * v).sum::<f64>();
    let mut state = start.clone();
    let (mut before, mut turned) = (0.0, false);
    for k in 0..(64.0 * STEPS) as usize {
        let stretch = Stretch { frequency_hz, start: k as f64 / STEPS, end: (k + 1) as f64 / STEPS };
        state = integrator.advance(&stretch, &state)?;
        let now = speed(&state) * amplitude.signum();
        if turned && before > 0.0 && now <= 0.0 {
            let cycles = (k as f64 + before / (before - now)) / STEPS;
            return Ok((start, frequency_hz / cycles));
        }
        turned |= now > 0.0;
        before = now;
    }
    Err(missing)
}

#[cfg(test)]
mod tests {
    use faer::Mat;
    use hammerbeam_motion::{
        Law, Load, LocalElement,
        law::{LinearStop, PowerSpring},
    };
    use hammerbeam_structure::{PointOutput, ReducedModel};

    use super::*;

    /// Unit mass on 1 N/m with one more element.
    fn oscillator(law: Law) -> (System, Response) {
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
            supports: vec![],
            uniform_acceleration: vec![1.0],
        };
        let element = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
        let system = System::new(model, &Load::default(), vec![element]).unwrap();
        (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
    }

    /// Unit mass on 1 N/m one way and 2 N/m the other: `T = pi + pi/sqrt 2`.
    #[test]
    fn bilinear_oscillator_frequency_is_1_1716_at_stiffness_ratio_2() {
        let (system, response) = oscillator(Law::Linear(LinearStop::with_gap(1.0, 0.0).unwrap()));
        let orbit = free_orbit(&system, &response, -1e-2, &OrbitSettings::default()).unwrap();
        let exact = 2.0 * 2f64.sqrt() / (1.0 + 2f64.sqrt()) / std::f64::consts::TAU;
        assert!((orbit.frequency_hz / exact - 1.0).abs() < 1e-10, "{} {exact}", orbit.frequency_hz);
    }

    /// `x'' + x + x^3 = 0`: `T = 4 K(m)/sqrt(1 + a^2)`, `m = a^2/(2 (1 + a^2))`, with `K` by the
    /// arithmetic-geometric mean.
    #[test]
    fn frequency_of_the_undamped_duffing_oscillator_is_the_elliptic_integral() {
        let (system, response) = oscillator(Law::Power(PowerSpring::cubic(1.0).unwrap()));
        for amplitude in [0.1, 1.0, 3.0] {
            let orbit = free_orbit(&system, &response, amplitude, &OrbitSettings::default()).unwrap();
            let square = amplitude * amplitude;
            let modulus = square / (2.0 * (1.0 + square));
            let (mut a, mut b) = (1.0, (1.0_f64 - modulus).sqrt());
            for _ in 0..8 {
                (a, b) = (0.5 * (a + b), (a * b).sqrt());
            }
            let period = 4.0 * std::f64::consts::FRAC_PI_2 / a / (1.0 + square).sqrt();
            assert!(
                (orbit.frequency_hz * period - 1.0).abs() < 1e-9,
                "{amplitude}: {}",
                orbit.frequency_hz * period
            );
        }
    }
}
