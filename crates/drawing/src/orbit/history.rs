//! The history of an orbit: its samples from phase 0 on, its impacts on rigid stops, and its paths in holes.

use hammerbeam_attractor::{ContactRecord, Simulation};
use hammerbeam_figure::{OrbitImpulse, OrbitSample};
use hammerbeam_motion::{
    LocalElement, PointMotion,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{PeriodicSolution, states_at_phase};
use hammerbeam_study::Model;

use crate::DrawingError;

/// Samples in an excitation period.
pub(super) const SAMPLES: usize = 2048;
/// How far from an impact its accelerations are taken (excitation periods): far less than a pixel, far more
/// than rounding.
const BESIDE: f64 = 1e-9;

/// What is drawn of an orbit.
pub(super) struct History {
    /// Samples from phase 0 on.
    pub samples: Vec<OrbitSample>,
    /// Impacts on rigid stops.
    pub impulses: Vec<OrbitImpulse>,
    /// The path in each round hole at the instants of the samples (m), with the number of its first element.
    pub paths: Vec<(usize, Vec<[f64; 2]>)>,
}

/// The history of an orbit.
pub(super) fn history(model: &Model, orbit: &PeriodicSolution) -> Result<History, DrawingError> {
    let frequency_hz = orbit.frequency_hz;
    let settings = ExactSettings::default();
    let mut integrator = ExactIntegrator::new(model.system.clone(), settings)?;
    // The first node of an orbit need not be at phase 0, where a simulation begins.
    let states = states_at_phase(&mut integrator, orbit, 0.0)?;
    let first = states.first().map_or(&[][..], Vec::as_slice);
    let mut simulation = Simulation::new(model.system.clone(), frequency_hz, first, settings)?;
    let response = model.response_motion(frequency_hz);
    let holes = holes(model, frequency_hz);
    let mut paths: Vec<(usize, Vec<[f64; 2]>)> =
        holes.iter().map(|(element, _)| (*element, Vec::new())).collect();
    let (mut samples, mut contacts) = (Vec::new(), Vec::new());
    for _ in 0..orbit.period_multiple {
        let (sampled, ended) = simulation.period(SAMPLES)?;
        contacts.extend(ended);
        for sample in sampled {
            let [displacement_m, velocity_m_s, acceleration_m_s2] =
                response.at(sample.phase, &sample.state, &sample.forces);
            for ((_, directions), (_, path)) in holes.iter().zip(&mut paths) {
                let at = |motion: &PointMotion| motion.at(sample.phase, &sample.state, &sample.forces)[0];
                path.push(directions.each_ref().map(at));
            }
            let motions = model.system.support_motions(frequency_hz, sample.phase);
            samples.push(OrbitSample {
                displacement_m,
                velocity_m_s,
                acceleration_m_s2,
                forces_n: sample.forces,
                supports_m: motions.into_iter().map(|[u, ..]| u).collect(),
            });
        }
    }
    contacts.extend(simulation.unfinished());
    let mut impulses: Vec<OrbitImpulse> =
        contacts.iter().filter_map(|contact| impulse(&response, frequency_hz, contact)).collect();
    impulses.sort_by(|a, b| a.cycles.total_cmp(&b.cycles));
    let cycles: Vec<f64> = impulses.iter().map(|impulse| impulse.cycles).collect();
    let accelerations = accelerations_beside(model, frequency_hz, (first, orbit.period_multiple), &cycles)?;
    for (impulse, acceleration_m_s2) in impulses.iter_mut().zip(accelerations) {
        impulse.acceleration_m_s2 = acceleration_m_s2;
    }
    Ok(History { samples, impulses, paths })
}

/// The first element of each round hole, with the relative displacements across its axis.
fn holes(model: &Model, frequency_hz: f64) -> Vec<(usize, [PointMotion; 2])> {
    let elements = model.system.elements();
    let of_hole = (0..elements.len()).filter(|&element| elements[element].law.round_hole().is_some());
    // The element of the second direction follows that of the first.
    let motions = of_hole.map(|first| {
        let motion = |element: usize| {
            let LocalElement { shape, support_ratios, .. } = &elements[element];
            PointMotion::of(&model.system, frequency_hz, shape, support_ratios)
        };
        (first, [motion(first), motion(first + 1)])
    });
    motions.collect()
}

/// Accelerations of the response point just before and just after instants of a motion, with all forces that
/// act then: also that of a stop to which the structure sticks.
///
/// * `first`, `periods`: the state at phase 0, and for how many excitation periods the motion goes on before
///   it repeats.
/// * `cycles`: the instants, in excitation periods.
fn accelerations_beside(
    model: &Model,
    frequency_hz: f64,
    (first, periods): (&[f64], u32),
    cycles: &[f64],
) -> Result<Vec<[f64; 2]>, DrawingError> {
    let mut found = vec![[f64::NAN; 2]; cycles.len()];
    if cycles.is_empty() {
        return Ok(found);
    }
    let mut simulation =
        Simulation::new(model.system.clone(), frequency_hz, first, ExactSettings::default())?;
    let response = model.response_motion(frequency_hz);
    for period in 0..periods {
        let sides = |(k, at): (usize, &f64)| [(k, 0, at - BESIDE), (k, 1, at + BESIDE)];
        let in_period = |(k, side, at): (usize, usize, f64)| {
            let phase = at.rem_euclid(f64::from(periods)) - f64::from(period);
            (0.0..1.0).contains(&phase).then_some((k, side, phase))
        };
        let mut wanted: Vec<(usize, usize, f64)> =
            cycles.iter().enumerate().flat_map(sides).filter_map(in_period).collect();
        wanted.sort_by(|a, b| a.2.total_cmp(&b.2));
        let phases: Vec<f64> = wanted.iter().map(|(_, _, phase)| *phase).collect();
        let (samples, _) = simulation.period_at(&phases)?;
        for (sample, (k, side, phase)) in samples.into_iter().zip(wanted) {
            let [_, _, acceleration] = response.at(phase, &sample.state, &sample.forces);
            found[k][side] = acceleration;
        }
    }
    Ok(found)
}

/// The impact with which a contact begins, if it does; without its accelerations.
fn impulse(response: &PointMotion, frequency_hz: f64, contact: &ContactRecord) -> Option<OrbitImpulse> {
    let (touch, jump) = (contact.begin.as_ref()?, contact.jump.as_ref()?);
    let cycles = touch.time * frequency_hz;
    let at = |state: &[f64]| response.at(cycles.fract(), state, &[]);
    let [displacement_m, velocity, _] = at(&touch.state);
    let [_, velocity_after, _] = at(&jump.state);
    Some(OrbitImpulse {
        element: contact.element,
        cycles,
        impulse_n_s: -jump.impulse,
        displacement_m,
        velocity_m_s: [velocity, velocity_after],
        ..OrbitImpulse::default()
    })
}

#[cfg(test)]
mod tests {
    use hammerbeam_study::StudyFile;

    use super::*;

    const STUDY: &str = include_str!("../../../../studies/impact-oscillator.toml");
    const DAMPING: f64 = 0.04;
    const RESTITUTION: f64 = 0.5;

    /// Unit mass that a constant force brings to rest on its stop after some bounces: held there its
    /// acceleration is 0; an impact that does not stick changes `x'` by `-(1 + e) v`, and so `x'' = F - x - c
    /// x'` by `c (1 + e) v`.
    #[test]
    fn an_impact_that_sticks_leaves_no_acceleration_and_any_other_that_of_the_equation_of_motion() {
        let load = "[[load]]\nkind = \"force\"\nat = \"mass\"\namplitude_n = 0.9\norder = 0\n";
        let study = STUDY.replacen("[0.08, 0.5]", "[0.02, 0.5]", 1).replacen(
            "restitution = 0.8",
            "restitution = 0.5",
            1,
        );
        let file = StudyFile::parse("study.toml", format!("{study}\n{load}")).unwrap();
        let model = Model::build(&file).unwrap();
        let (frequency_hz, periods) = (0.05, 3);
        let first = [0.0, 0.0];
        let mut simulation =
            Simulation::new(model.system.clone(), frequency_hz, &first, ExactSettings::default()).unwrap();
        let mut contacts = Vec::new();
        for _ in 0..periods {
            contacts.extend(simulation.period(1).unwrap().1);
        }
        let touched: Vec<&ContactRecord> = contacts.iter().filter(|contact| contact.jump.is_some()).collect();
        let cycles: Vec<f64> =
            touched.iter().map(|contact| contact.begin.as_ref().unwrap().time * frequency_hz).collect();
        let found = accelerations_beside(&model, frequency_hz, (&first, periods), &cycles).unwrap();
        let (mut sticking, mut bouncing) = (0, 0);
        for (contact, [before, after]) in touched.into_iter().zip(found) {
            let touch = contact.begin.as_ref().unwrap();
            if contact.end.unwrap() > touch.time {
                sticking += 1;
                assert!(after.abs() < 1e-12, "{after}");
            } else if touch.velocity > 1e-3 {
                bouncing += 1;
                // The states lie 2e-9 periods of 20 s apart, in which the acceleration of order one changes
                // by as little.
                let jump = DAMPING * (1.0 + RESTITUTION) * touch.velocity;
                assert!((after - before - jump).abs() < 1e-6, "{before} {after} {jump}");
            }
        }
        assert!(sticking > 0 && bouncing > 3, "{sticking} {bouncing}");
    }
}
