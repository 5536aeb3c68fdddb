//! Figures of an orbit. Its samples are computed here, from its first node on; the figures take them as they are.

use std::path::Path;

use hammerbeam_attractor::{AttractorError, Simulation};
use hammerbeam_figure::{OrbitDiagram, OrbitSample, Style};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::Model;

use super::Drawn;
use crate::{failure::Failure, initial};

/// Samples in an excitation period.
const SAMPLES: usize = 2048;

/// Draws each orbit over its period, in the phase plane, and its spectrum, into a folder.
///
/// # Returns
/// What was drawn, and what could not be.
pub fn draw<'a>(
    folder: &'a Path,
    model: &Model,
    title: &str,
    orbits: &[PeriodicSolution],
) -> Result<Drawn<'a>, Failure> {
    let mut drawn = Drawn::into(folder)?;
    for (number, orbit) in (1..).zip(orbits) {
        let diagram = diagram(model, title, orbit)?;
        let (wide, narrow) = (Style::double_column(), Style::single_column());
        drawn.add(&format!("orbit-{number}-history"), diagram.draw_history(&wide))?;
        drawn.add(&format!("orbit-{number}-phase"), diagram.draw_phase(&narrow))?;
        drawn.add(&format!("orbit-{number}-spectrum"), diagram.draw_spectrum(&wide))?;
    }
    Ok(drawn)
}

fn diagram(model: &Model, title: &str, orbit: &PeriodicSolution) -> Result<OrbitDiagram, AttractorError> {
    let frequency_hz = orbit.frequency_hz;
    let stability = if orbit.stable() { "stable" } else { "unstable" };
    let title = format!("{title}, {frequency_hz} Hz, period {}, {stability}", orbit.period_multiple);
    let eigenfrequencies_hz =
        model.system.model().natural_frequencies.iter().map(|rate| rate / std::f64::consts::TAU).collect();
    let mut simulation = Simulation::new(
        model.system.clone(),
        frequency_hz,
        orbit.nodes.first().map_or(&[][..], Vec::as_slice),
        ExactSettings::default(),
    )?;
    let is_moved = model.system.model().support.is_some();
    let mut samples = Vec::new();
    for _ in 0..orbit.period_multiple {
        for sample in simulation.period(SAMPLES)?.0 {
            let [displacement_m, velocity_m_s, acceleration_m_s2] =
                initial::response(model, frequency_hz, sample.phase, &sample.state);
            let support = model.system.support_motion(frequency_hz, sample.phase)[0];
            samples.push(OrbitSample {
                displacement_m,
                velocity_m_s,
                acceleration_m_s2,
                forces_n: sample.forces,
                support_m: is_moved.then_some(support),
            });
        }
    }
    let period_multiple = orbit.period_multiple;
    Ok(OrbitDiagram { title, frequency_hz, period_multiple, samples, eigenfrequencies_hz })
}
