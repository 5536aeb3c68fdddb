//! Figures of an orbit. Its samples are computed here, from its stored state on; the figures take them as they are.

use std::path::Path;

use hammerbeam_attractor::Simulation;
use hammerbeam_figure::{FilteredAcceleration, OrbitDiagram, OrbitSample, Style, plain_number};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings, MotionError};
use hammerbeam_orbit::{PeriodicSolution, states_at_phase};
use hammerbeam_signal::filter::periodic_low_pass;
use hammerbeam_study::{Model, StoredBranches, StudyFile, file::DrawnOrbit};

use super::{Album, Drawn, unless_damaged};
use crate::{failure::Failure, initial};

/// Samples in an excitation period.
const SAMPLES: usize = 2048;
/// Order of the low-pass filter.
const ORDER: usize = 4;

/// Draws each orbit over its period, in the phase plane, and its spectrum.
///
/// * `low_pass_hz`: cut-off of the filter behind which accelerations are drawn as well.
pub fn draw(
    (model, title): (&Model, &str),
    orbits: &[PeriodicSolution],
    low_pass_hz: Option<f64>,
    drawn: &mut Drawn<'_>,
) -> Result<(), Failure> {
    for (number, orbit) in (1..).zip(orbits) {
        let diagram = diagram((model, title), orbit, low_pass_hz)?;
        add(drawn, &format!("orbit-{number}"), &diagram);
    }
    Ok(())
}

/// Refuses an orbit that the user asks for where no stored branch has one.
pub fn refuse_unknown(folder: &Path, file: &StudyFile, orbits: &[DrawnOrbit]) -> Result<(), Failure> {
    if orbits.is_empty() {
        return Ok(());
    }
    let branches = StoredBranches::open(folder, file)?;
    for &DrawnOrbit { frequency_hz, period_multiple } in orbits {
        let ranges = branches.ranges(|record| record.period_multiple == period_multiple);
        if !ranges.iter().any(|(low, high)| (*low..=*high).contains(&frequency_hz)) {
            let low = ranges.iter().map(|range| range.0).fold(f64::INFINITY, f64::min);
            let high = ranges.iter().map(|range| range.1).fold(0.0, f64::max);
            let there = match ranges.len() {
                0 => "there is no such branch".to_owned(),
                _ => format!("they lie between {} and {} Hz", plain_number(low), plain_number(high)),
            };
            return Err(Failure::BadInput(format!(
                "--orbit: no stored branch of {period_multiple} excitation period(s) crosses {frequency_hz} Hz; {there}"
            )));
        }
    }
    Ok(())
}

/// Draws the orbits in which stored branches cross frequencies.
pub fn draw_stored(
    folder: &Path,
    (file, model): (&StudyFile, &Model),
    (orbits, low_pass_hz): (&[DrawnOrbit], Option<f64>),
    drawn: &mut Drawn<'_>,
) -> Result<(), Failure> {
    if orbits.is_empty() {
        return Ok(());
    }
    let branches = StoredBranches::open(folder, file)?;
    for &DrawnOrbit { frequency_hz, period_multiple } in orbits {
        if drawn.is_stopped() {
            break;
        }
        let name = format!("orbit_{frequency_hz}Hz_period{period_multiple}");
        let crossings =
            branches.crossings(model, frequency_hz, |record| record.period_multiple == period_multiple);
        let Some(crossings) = unless_damaged(crossings, &name, drawn)? else { continue };
        let mut found: Vec<PeriodicSolution> = crossings.into_iter().map(|(_, orbit)| orbit).collect();
        found.sort_by(|a, b| {
            let size = |orbit: &PeriodicSolution| orbit.maxima.displacement;
            b.stable().cmp(&a.stable()).then(size(b).total_cmp(&size(a)))
        });
        match found.first() {
            Some(orbit) => add(drawn, &name, &diagram((model, &file.study.title), orbit, low_pass_hz)?),
            None => drawn.refuse(
                &name,
                format!(
                    "no stored branch of {period_multiple} excitation period(s) crosses {frequency_hz} Hz"
                ),
            ),
        }
    }
    Ok(())
}

fn add(drawn: &mut Drawn<'_>, name: &str, diagram: &OrbitDiagram) {
    let (wide, narrow) = (Style::double_column(), Style::single_column());
    drawn.add(&format!("{name}-history"), diagram.draw_history(&wide));
    drawn.add(&format!("{name}-phase"), diagram.draw_phase(&narrow));
    drawn.add(&format!("{name}-spectrum"), diagram.draw_spectrum(&wide));
}

fn diagram(
    (model, title): (&Model, &str),
    orbit: &PeriodicSolution,
    low_pass_hz: Option<f64>,
) -> Result<OrbitDiagram, Failure> {
    let frequency_hz = orbit.frequency_hz;
    let stability = if orbit.stable() { "stable" } else { "unstable" };
    let (hz, multiple) = (plain_number(frequency_hz), orbit.period_multiple);
    let title = format!("{title}, {hz} Hz, period {multiple}, {stability}");
    let eigenfrequencies_hz =
        model.system.model().natural_frequencies.iter().map(|rate| rate / std::f64::consts::TAU).collect();
    let samples = samples(model, orbit)?;
    let duration_s = f64::from(orbit.period_multiple) / frequency_hz;
    let filtered = match low_pass_hz {
        Some(cut_off_hz) => {
            let values: Vec<f64> = samples.iter().map(|sample| sample.acceleration_m_s2).collect();
            let values_m_s2 = periodic_low_pass(&values, duration_s, (ORDER, cut_off_hz))?;
            Some(FilteredAcceleration { cut_off_hz, values_m_s2 })
        }
        None => None,
    };
    let period_multiple = orbit.period_multiple;
    Ok(OrbitDiagram { title, frequency_hz, period_multiple, samples, filtered, eigenfrequencies_hz })
}

fn samples(model: &Model, orbit: &PeriodicSolution) -> Result<Vec<OrbitSample>, Failure> {
    let frequency_hz = orbit.frequency_hz;
    let refused = |error: MotionError| Failure::NoResult(error.to_string());
    let settings = ExactSettings::default();
    let mut integrator = ExactIntegrator::new(model.system.clone(), settings).map_err(refused)?;
    // The first node of an orbit need not be at phase 0, where a simulation begins.
    let states = states_at_phase(&mut integrator, orbit, 0.0).map_err(refused)?;
    let first = states.first().map_or(&[][..], Vec::as_slice);
    let mut simulation = Simulation::new(model.system.clone(), frequency_hz, first, settings)?;
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
    Ok(samples)
}
