//! What is read off an orbit: extrema, mean, root mean square and harmonics of motions and of contact forces.
//!
//! An orbit of n excitation periods `T = n/f` is gone over in panels over which everything is smooth (see
//! [`MotionPanel`]). With the weights `w_k` of their nodes at the phases `x_k` [cycles of the excitation]
//!
//! `mean = 1/T sum_k w_k y_k`, `rms^2 = 1/T sum_k w_k y_k^2`,
//! `c_j = 2/T sum_k w_k y_k exp(-i 2 pi (j/n) x_k)`
//!
//! so that `y = mean + Re sum_j c_j exp(i 2 pi (j/n) x)`: `c_j` belongs to the order `j/n` of the excitation.
//! Extrema are taken of the polynomials of the panels, ends included (`output/extremum.rs`). Flights are
//! known to rounding and force steps to their tolerance, so the numbers are as good as the orbit.
//!
//! **Impacts on rigid stops** change velocities at once. The acceleration and the contact force have impulses
//! `J` there, which count in mean and harmonics as `J` at their phase; without them the mean acceleration of
//! a periodic motion would not vanish. Extrema and root mean square are taken of the motion between impacts.

mod extremum;
mod numbers;
mod statistics;

use hammerbeam_motion::{
    PointMotion, Stretch, System,
    exact::{ContactPiece, ExactIntegrator, MotionError, MotionPanel, PANEL_NODES},
};

pub use numbers::SignalStatistics;

use crate::PeriodicSolution;
use statistics::{Kernel, Sums};

/// A derivative of a displacement by time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeDerivative {
    /// The displacement itself [m].
    Displacement,
    /// Its rate [m/s].
    Velocity,
    /// The rate of that [m/s^2].
    Acceleration,
}

/// What is read off a motion.
#[derive(Debug, Clone, PartialEq)]
pub enum OrbitSignal {
    /// A displacement `shape . q + support_ratios . u` of a point or between points, or a derivative of it.
    Motion {
        /// Over the modes, length n.
        shape: Vec<f64>,
        /// Over the displacements of the supports.
        support_ratios: Vec<f64>,
        /// Which derivative.
        derivative: TimeDerivative,
    },
    /// What the structure presses on local elements with, `- sum sign F_e` with their forces `F_e` on the
    /// structure along their relative displacements [N].
    Pressing {
        /// Numbers of the elements with their signs.
        elements: Vec<(usize, f64)>,
    },
    /// Magnitude of the force on a round hole [N].
    PressingAround {
        /// Number of the element of its first direction.
        first: usize,
    },
}

/// Reads signals off an orbit.
///
/// * `orders`: whole orders of the excitation frequency up to which there are harmonics.
///
/// # Errors
/// [`MotionError`]: the motion cannot be computed again.
pub fn read_orbit(
    integrator: &mut ExactIntegrator,
    solution: &PeriodicSolution,
    signals: &[OrbitSignal],
    orders: u32,
) -> Result<Vec<SignalStatistics>, MotionError> {
    let (frequency_hz, multiple) = (solution.frequency_hz, solution.period_multiple);
    let readers: Vec<Reader> =
        signals.iter().map(|signal| Reader::of(integrator.system(), frequency_hz, signal)).collect();
    let mut sums = vec![Sums::new((orders * multiple) as usize); signals.len()];
    let segments = solution.nodes.len() as f64;
    let at = |segment: usize| solution.phase + f64::from(multiple) * segment as f64 / segments;
    for (segment, node) in solution.nodes.iter().enumerate() {
        let stretch = Stretch { frequency_hz, start: at(segment), end: at(segment + 1) };
        let motion = integrator.panelled(&stretch, node)?;
        let cycles = |time: f64| stretch.start + frequency_hz * time;
        for panel in &motion.panels {
            let kernel = Kernel::new(&panel.times.map(cycles), multiple, (orders * multiple) as usize);
            for (reader, sums) in readers.iter().zip(&mut sums) {
                sums.add(&panel.weights, &reader.values(panel, cycles), &kernel);
            }
        }
        for contact in &motion.contacts {
            let Some(time) =
                contact.begin.as_ref().filter(|_| contact.jump.is_some()).map(|touch| touch.time)
            else {
                continue;
            };
            for (reader, sums) in readers.iter().zip(&mut sums) {
                sums.add_impulse(reader.impulse(contact), cycles(time), multiple);
            }
        }
    }
    let period = f64::from(multiple) / frequency_hz;
    Ok(sums.into_iter().map(|sums| sums.over(period)).collect())
}

/// A signal at one frequency.
enum Reader<'a> {
    Motion { motion: PointMotion, shape: &'a [f64], derivative: TimeDerivative },
    Pressing(&'a [(usize, f64)]),
    PressingAround(usize),
}

impl<'a> Reader<'a> {
    fn of(system: &System, frequency_hz: f64, signal: &'a OrbitSignal) -> Self {
        match signal {
            OrbitSignal::Motion { shape, support_ratios, derivative } => Self::Motion {
                motion: PointMotion::of(system, frequency_hz, shape, support_ratios),
                shape,
                derivative: *derivative,
            },
            OrbitSignal::Pressing { elements } => Self::Pressing(elements),
            OrbitSignal::PressingAround { first } => Self::PressingAround(*first),
        }
    }

    /// Values at the nodes of a panel.
    fn values(&self, panel: &MotionPanel, cycles: impl Fn(f64) -> f64) -> [f64; PANEL_NODES] {
        std::array::from_fn(|k| match self {
            Self::Motion { motion, derivative, .. } => {
                let [displacement, velocity, acceleration] =
                    motion.at(cycles(panel.times[k]), &panel.states[k], &panel.forces[k]);
                match derivative {
                    TimeDerivative::Displacement => displacement,
                    TimeDerivative::Velocity => velocity,
                    TimeDerivative::Acceleration => acceleration,
                }
            }
            Self::Pressing(elements) => {
                elements.iter().map(|(element, sign)| -sign * panel.forces[k][*element]).sum()
            }
            Self::PressingAround(first) => panel.forces[k][*first].hypot(panel.forces[k][first + 1]),
        })
    }

    /// Impulse of the signal at an impact on a rigid stop.
    fn impulse(&self, contact: &ContactPiece) -> f64 {
        let (Some(touch), Some(jump)) = (&contact.begin, &contact.jump) else { return 0.0 };
        match self {
            Self::Motion { shape, derivative: TimeDerivative::Acceleration, .. } => {
                let n = shape.len();
                let change = |i: usize| jump.state[n + i] - touch.state[n + i];
                shape.iter().enumerate().map(|(i, p)| p * change(i)).sum()
            }
            Self::Motion { .. } | Self::PressingAround(_) => 0.0,
            Self::Pressing(elements) => {
                let own = elements.iter().filter(|(element, _)| *element == contact.element);
                own.map(|(_, sign)| sign * jump.impulse).sum()
            }
        }
    }
}
