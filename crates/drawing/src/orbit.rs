//! Figures of an orbit. Its samples are computed here, from its stored state on; the figures take them as
//! they are.

mod history;

use std::path::Path;

use hammerbeam_figure::{
    FilteredAcceleration, FrequencyUnit, HoleDiagram, OrbitDiagram, OrbitImpulse, OrbitSample,
};
use hammerbeam_jobs::{StoredBranches, counted};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_signal::filter::periodic_low_pass;
use hammerbeam_study::{
    Model, StudyFile,
    file::{DrawnOrbit, Excitation, Place},
};

use crate::{Album, DrawingError, Drawn};
use history::{History, SAMPLES, history};

/// Order of the low-pass filter.
const ORDER: usize = 4;

/// Draws each orbit over its period, in the phase plane, its spectrum, and its path in each round hole.
///
/// * `low_pass_hz`: cut-off of the filter behind which accelerations are drawn as well.
pub fn draw(
    (file, model): (&StudyFile, &Model),
    orbits: &[PeriodicSolution],
    low_pass_hz: Option<f64>,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    for (number, orbit) in (1..).zip(orbits) {
        let diagrams = diagrams((file, model), orbit, (low_pass_hz, drawn.frequency_unit()))?;
        add(drawn, &format!("orbit-{number}"), &diagrams);
    }
    Ok(())
}

/// Draws the orbits in which stored branches cross frequencies.
pub fn draw_stored(
    folder: &Path,
    (file, model): (&StudyFile, &Model),
    (orbits, low_pass_hz): (&[DrawnOrbit], Option<f64>),
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
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
        let Some(crossings) = drawn.unless_damaged(crossings, &name)? else { continue };
        let mut found: Vec<PeriodicSolution> = crossings.into_iter().map(|(_, orbit)| orbit).collect();
        found.sort_by(|a, b| {
            let size = |orbit: &PeriodicSolution| orbit.maxima.displacement;
            b.may_be_stable().cmp(&a.may_be_stable()).then(size(b).total_cmp(&size(a)))
        });
        match found.first() {
            Some(orbit) => {
                let shown = (low_pass_hz, drawn.frequency_unit());
                add(drawn, &name, &diagrams((file, model), orbit, shown)?);
            }
            None => drawn.refuse(&name, no_branch_crosses(period_multiple, frequency_hz)),
        }
    }
    Ok(())
}

/// What is said where an orbit is asked for that no stored branch has.
#[must_use]
pub fn no_branch_crosses(period_multiple: u32, frequency_hz: f64) -> String {
    let periods = counted(period_multiple.into(), "excitation period");
    format!("no stored branch of {periods} crosses {frequency_hz} Hz")
}

fn add(drawn: &mut Drawn<'_>, name: &str, (diagram, holes): &(OrbitDiagram, Vec<HoleDiagram>)) {
    let (wide, narrow) = (drawn.wide(), drawn.narrow());
    drawn.add(&format!("{name}-history"), diagram.draw_history(&wide));
    drawn.add(&format!("{name}-phase"), diagram.draw_phase(&narrow));
    drawn.add(&format!("{name}-spectrum"), diagram.draw_spectrum(&wide));
    for (number, hole) in (1..).zip(holes) {
        let which = if holes.len() == 1 { String::new() } else { format!("-{number}") };
        drawn.add(&format!("{name}-hole{which}"), hole.draw(&narrow));
    }
}

fn diagrams(
    (file, model): (&StudyFile, &Model),
    orbit: &PeriodicSolution,
    (low_pass_hz, unit): (Option<f64>, FrequencyUnit),
) -> Result<(OrbitDiagram, Vec<HoleDiagram>), DrawingError> {
    let frequency_hz = orbit.frequency_hz;
    let stability = orbit.stability().word();
    let (frequency, multiple) = (unit.words(frequency_hz), orbit.period_multiple);
    let title = format!("{}, {frequency}, period {multiple}, {stability}", file.study.title);
    let eigenfrequencies_hz =
        model.system.model().natural_frequencies.iter().map(|rate| rate / std::f64::consts::TAU).collect();
    let History { samples, impulses, paths } = history(model, orbit)?;
    let holes = holes((file, model), (frequency_hz, multiple), paths, &title);
    let duration_s = f64::from(orbit.period_multiple) / frequency_hz;
    let filtered = match low_pass_hz {
        Some(cut_off_hz) => {
            let values = with_impulses(&samples, &impulses, duration_s);
            let values_m_s2 = periodic_low_pass(&values, duration_s, (ORDER, cut_off_hz))?;
            Some(FilteredAcceleration { cut_off_hz, values_m_s2 })
        }
        None => None,
    };
    let diagram = OrbitDiagram {
        title,
        frequency_hz,
        period_multiple: multiple,
        samples,
        impulses,
        filtered,
        element_names: model.system.elements().iter().map(|element| element.name.clone()).collect(),
        eigenfrequencies_hz,
        support_names: support_names(&file.study.excitation),
    };
    Ok((diagram, holes))
}

/// The paths in round holes, each under the name of its hole.
fn holes(
    (file, model): (&StudyFile, &Model),
    (frequency_hz, period_multiple): (f64, u32),
    paths: Vec<(usize, Vec<[f64; 2]>)>,
    title: &str,
) -> Vec<HoleDiagram> {
    let of_holes = file.study.stops.iter().filter_map(|stop| match &stop.place {
        Place::Around { first, second, .. } => Some([first.clone(), second.clone()]),
        Place::At { .. } | Place::Between { .. } => None,
    });
    let diagram = |((element, path_m), names): ((usize, Vec<[f64; 2]>), [String; 2])| {
        let element = &model.system.elements()[element];
        let clearance_m = element.law.round_hole()?.clearance();
        let title = format!("{}: {title}", element.name);
        Some(HoleDiagram { title, frequency_hz, period_multiple, clearance_m, names, path_m })
    };
    paths.into_iter().zip(of_holes).filter_map(diagram).collect()
}

/// Names of the supports that move, where there are several.
fn support_names(excitation: &Excitation) -> Vec<String> {
    let supports = excitation.supports();
    let several = supports.len() > 1;
    supports.into_iter().filter(|_| several).map(|places| format!("support {}", places.join(", "))).collect()
}

/// The accelerations, each jump of the velocity among them as the acceleration that makes it within the step
/// in which it lies.
///
/// * `duration_s`: of the orbit.
fn with_impulses(samples: &[OrbitSample], impulses: &[OrbitImpulse], duration_s: f64) -> Vec<f64> {
    let mut values: Vec<f64> = samples.iter().map(|sample| sample.acceleration_m_s2).collect();
    let count = values.len();
    for impulse in impulses {
        let place = impulse.cycles * SAMPLES as f64;
        let [before, after] = impulse.velocity_m_s;
        let acceleration = (after - before) * count as f64 / duration_s;
        // Shared so that the impulse keeps its time.
        values[place as usize % count] += (1.0 - place.fract()) * acceleration;
        values[(place as usize + 1) % count] += place.fract() * acceleration;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sum and first moment of the accelerations are those of the jumps.
    #[test]
    fn accelerations_have_the_impulses_at_their_times() {
        let samples = vec![OrbitSample::default(); 2 * SAMPLES];
        let impulse = |cycles: f64, speed: f64| OrbitImpulse {
            cycles,
            velocity_m_s: [speed, -0.5 * speed],
            ..OrbitImpulse::default()
        };
        let (duration_s, times) = (4.0, [0.3, 1.234_567]);
        let values = with_impulses(&samples, &[impulse(times[0], 2.0), impulse(times[1], 4.0)], duration_s);
        let step_s = duration_s / values.len() as f64;
        let sum: f64 = values.iter().map(|value| value * step_s).sum();
        let moment: f64 = (0..).zip(&values).map(|(k, value)| f64::from(k) * step_s * value * step_s).sum();
        assert!((sum + 9.0).abs() < 1e-12, "{sum}");
        assert!((moment + 2.0 * (3.0 * times[0] + 6.0 * times[1])).abs() < 1e-11, "{moment}");
        // At the very end of the orbit it reaches into its beginning.
        let last = with_impulses(&samples, &[impulse(2.0 - 0.5 / SAMPLES as f64, 1.0)], duration_s);
        assert!((last[0] / last[2 * SAMPLES - 1] - 1.0).abs() < 1e-9 && last[0] < 0.0);
    }
}
