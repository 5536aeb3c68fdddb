//! Displacement, velocity and acceleration of a point, read off states of one excitation frequency.
//!
//! With the shape `p` of the point (its displacement is `y = p . q + s . u` with the displacements u of the
//! supports), eigenfrequencies `w_i`, damping `D`, loads `b_m`, and the forces `F_e` of the local elements
//! with shapes `h_e`:
//!
//! `y'' = - sum p_i w_i^2 q_i - p . D q' + Re sum_m (p . b_m + s . U_m'') exp(i 2 pi m x) + sum_e (p . h_e)
//! F_e`
//!
//! The forces are those that a motion tells: a state alone knows neither what a rigid stop presses with nor
//! how a contact began whose law remembers that. What does not depend on the state is added up once.

use std::f64::consts::TAU;

use faer::c64;

use crate::{System, vectors::dot};

/// How a point moves at a frequency.
#[derive(Debug, Clone)]
pub struct PointMotion {
    shape: Vec<f64>,
    /// `- p_i w_i^2` and `- (p . D)_i`, by which `q` and `q'` become accelerations.
    rows: [Vec<f64>; 2],
    drives: Vec<Drive>,
    /// `p . h_e` of each element.
    mobilities: Vec<f64>,
}

/// What an order of the excitation gives to a point directly.
#[derive(Debug, Clone)]
struct Drive {
    order: f64,
    /// Amplitudes of its displacement [m], velocity [m/s] and acceleration [m/s^2].
    amplitudes: [c64; 3],
}

impl PointMotion {
    /// Of a system, to be read off states at a frequency.
    ///
    /// * `shape`, `support_ratios`: the displacement of the point is `shape . q + support_ratios . u`;
    ///   `shape` of length n.
    #[must_use]
    pub fn of(system: &System, frequency_hz: f64, shape: &[f64], support_ratios: &[f64]) -> Self {
        let (n, model) = (system.dof(), system.model());
        let stiffness =
            shape.iter().zip(&model.natural_frequencies).map(|(p, w)| -p * w * w).collect::<Vec<f64>>();
        let damping = (0..n).map(|j| -(0..n).map(|i| shape[i] * model.damping[(i, j)]).sum::<f64>());
        let drive = |(index, &order): (usize, &u32)| {
            let order = f64::from(order);
            let moved = system.support_amplitudes(index, TAU * frequency_hz);
            let support: c64 = moved.iter().zip(support_ratios).map(|((u, _), ratio)| *u * *ratio).sum();
            let rate = c64::new(0.0, TAU * order * frequency_hz);
            let load = system.modal_load(index, TAU * frequency_hz).amplitude;
            let loaded: c64 = load.iter().zip(shape).map(|(load, p)| load * *p).sum();
            Drive { order, amplitudes: [support, support * rate, support * rate * rate + loaded] }
        };
        Self {
            shape: shape.to_vec(),
            rows: [stiffness, damping.collect()],
            drives: system.orders().iter().enumerate().map(drive).collect(),
            mobilities: system.elements().iter().map(|element| dot(&element.shape, shape)).collect(),
        }
    }

    /// Displacement [m], velocity [m/s] and acceleration [m/s^2] at a phase.
    ///
    /// * `phase`: [cycles]; `state`: `[q; q']`, length 2n.
    /// * `forces`: of all local elements along their relative displacements [N]; without them the
    ///   acceleration is that of the free structure.
    #[must_use]
    pub fn at(&self, phase: f64, state: &[f64], forces: &[f64]) -> [f64; 3] {
        let (q, v) = state.split_at(self.shape.len());
        let [stiffness, damping] = &self.rows;
        let forced = dot(&self.mobilities, forces);
        let mut motion =
            [dot(&self.shape, q), dot(&self.shape, v), dot(stiffness, q) + dot(damping, v) + forced];
        for drive in &self.drives {
            let (sin, cos) = (TAU * drive.order * (phase - phase.floor())).sin_cos();
            for (value, amplitude) in motion.iter_mut().zip(drive.amplitudes) {
                *value += amplitude.re * cos - amplitude.im * sin;
            }
        }
        motion
    }
}
