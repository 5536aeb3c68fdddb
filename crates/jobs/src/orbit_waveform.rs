//! The motion of a periodic solution over its period: every point of the structure, every local element and
//! the modal state, at equally spaced phases.

use hammerbeam_attractor::AttractorError;
use hammerbeam_motion::{
    PointMotion,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::Model;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use crate::orbit_history::{OrbitInstant, orbit_history};

/// The motion of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct PointWaveform {
    /// Name of the point.
    pub point: String,
    /// Displacements [m].
    pub displacement: Vec<f64>,
    /// Velocities [m/s].
    pub velocity: Vec<f64>,
    /// Accelerations [m/s^2].
    pub acceleration: Vec<f64>,
}

/// A periodic solution over its period, from phase 0 of the excitation on.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitWaveform {
    /// Times [s].
    pub time: Vec<f64>,
    /// Phases of the excitation, from 0 to the orbit's multiple of the period [cycles].
    pub phase_cycles: Vec<f64>,
    /// All points of the structure.
    pub points: Vec<PointWaveform>,
    /// Names of the local elements with their forces [N].
    pub forces: Vec<(String, Vec<f64>)>,
    /// Modal states `[q; q']`.
    pub states: Vec<Vec<f64>>,
}

/// Samples of an excitation period that may be asked for.
const MOST_SAMPLES: usize = 1_000_000;

/// Goes over the period of a solution: from each of its nodes to the next one, so that also an orbit that is
/// left fast is followed, and one that begins at another phase since a contact is closed at phase 0.
///
/// * `samples`: in each excitation period, at most a million.
///
/// # Errors
/// [`AttractorError`]: the motion cannot be computed again, or there are too many samples.
pub fn orbit_waveform(
    model: &Model,
    orbit: &PeriodicSolution,
    samples: usize,
) -> Result<OrbitWaveform, AttractorError> {
    if samples > MOST_SAMPLES {
        let (what, found) = ("samples per period", samples as f64);
        return Err(AttractorError::Input { what, found, allowed: "at most a million" });
    }
    let (system, frequency_hz) = (&model.system, orbit.frequency_hz);
    let motions: Vec<PointMotion> = system
        .model()
        .points
        .iter()
        .map(|point| PointMotion::of(system, frequency_hz, &point.shape, &point.support_ratios))
        .collect();
    let mut found = empty(model);
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default())?;
    for OrbitInstant { cycles, state, forces, .. } in
        orbit_history(&mut integrator, orbit, (samples, 0))?.instants
    {
        found.time.push(cycles / frequency_hz);
        found.phase_cycles.push(cycles);
        for (point, motion) in found.points.iter_mut().zip(&motions) {
            let [displacement, velocity, acceleration] = motion.at(cycles.fract(), &state, &forces);
            point.displacement.push(displacement);
            point.velocity.push(velocity);
            point.acceleration.push(acceleration);
        }
        for ((_, of_element), force) in found.forces.iter_mut().zip(&forces) {
            of_element.push(*force);
        }
        found.states.push(state);
    }
    Ok(found)
}

fn empty(model: &Model) -> OrbitWaveform {
    let point = |name: &str| PointWaveform {
        point: name.to_owned(),
        displacement: Vec::new(),
        velocity: Vec::new(),
        acceleration: Vec::new(),
    };
    OrbitWaveform {
        time: Vec::new(),
        phase_cycles: Vec::new(),
        points: model.point_names().into_iter().map(point).collect(),
        forces: model.system.elements().iter().map(|element| (element.name.clone(), Vec::new())).collect(),
        states: Vec::new(),
    }
}

/// Times, phases and states, the motion of each point and the force of each local element by their names.
impl Serialize for OrbitWaveform {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let point = |point: &PointWaveform| {
            let motion = json!({
                "displacement_m": point.displacement,
                "velocity_m_s": point.velocity,
                "acceleration_m_s2": point.acceleration,
            });
            (point.point.clone(), motion)
        };
        let force = |(name, forces): &(String, Vec<f64>)| (name.clone(), json!(forces));
        let document = json!({
            "time_s": self.time,
            "phase_cycles": self.phase_cycles,
            "points": self.points.iter().map(point).collect::<Map<String, Value>>(),
            "forces_n": self.forces.iter().map(force).collect::<Map<String, Value>>(),
            "states": self.states,
        });
        document.serialize(serializer)
    }
}
