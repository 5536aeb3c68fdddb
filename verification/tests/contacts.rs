//! What is reported of contacts and maxima, against the balance of momentum and against dense sampling by the
//! general integrator.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{ObservedSystem, element_at, hertz, masses, paper_beam, response_of};
use approx::assert_relative_eq;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, Stretch, System,
    general::{GeneralSettings, sample},
    law::LinearStop,
};
use hammerbeam_orbit::{OrbitMaxima, OrbitSettings, PeriodicSolution, find_start};
use hammerbeam_structure::GROUND;

const GRAVITY: f64 = 9.81;
const MASS: f64 = 0.7;

/// A mass that lies or bounces on a vibrating table and is braked by a damper to it; nothing else holds it.
fn bouncing(law: Law, amplitude: f64) -> ObservedSystem {
    let model = masses(&[("mass", MASS)], &[], &[("mass", GROUND, 4.0)], true);
    // The displacement is counted downwards, towards the table.
    let weight = HarmonicForce {
        shape: model.uniform_acceleration.clone(),
        harmonic: Harmonic { order: 0, amplitude: GRAVITY, phase: 0.0 },
    };
    let load =
        Load { support: vec![Harmonic { order: 1, amplitude, phase: 0.0 }.into()], forces: vec![weight] };
    let (table, response) = (element_at(&model, "mass", law), response_of(&model, "mass"));
    ObservedSystem { system: System::new(model, &load, vec![table]).unwrap(), response }
}

fn orbit(rig: &ObservedSystem, frequency_hz: f64, period_multiple: u32) -> PeriodicSolution {
    let settings = OrbitSettings::default();
    find_start(&rig.system, &rig.response, frequency_hz, period_multiple, &settings).unwrap()
}

/// Momentum: over a period the table's impulse carries the weight, `int F dt = m g T`; the damper moves with
/// the table and back, so it carries none.
#[test]
fn table_carries_the_weight_of_a_bouncing_mass_on_average() {
    let laws = [Law::Linear(LinearStop::with_gap(3e4, 0.0).unwrap()), hertz(2e6, 0.0)];
    for law in laws {
        for (amplitude, frequency_hz) in [(1e-3, 7.0), (8e-3, 9.0), (12e-3, 8.0)] {
            let rig = bouncing(law.clone(), amplitude);
            let orbit = orbit(&rig, frequency_hz, 1);
            assert!(orbit.maxima.contacts >= 1);
            let expected = MASS * GRAVITY / frequency_hz;
            assert_relative_eq!(orbit.maxima.impulse, expected, max_relative = 1e-8);
            let bounces = orbit.maxima.impact_velocity > 0.0;
            let flies = amplitude * (TAU * frequency_hz).powi(2) > 2.0 * GRAVITY;
            assert_eq!(bounces, flies, "{amplitude} m at {frequency_hz} Hz");
        }
    }
}

/// What dense sampling says of an orbit of a single element.
struct Sampled {
    displacement: f64,
    acceleration: f64,
    contact_force: f64,
    impact_velocity: f64,
    impulse: f64,
    contacts: u32,
}

/// Values of an orbit at a phase.
#[derive(Clone, Copy)]
struct Values {
    displacement: f64,
    acceleration: f64,
    clearance: f64,
    speed: f64,
    force: f64,
}

/// Orbits are sampled at equal phases first, then more densely between those on either side of what is
/// sought.
struct Sampler<'a> {
    rig: &'a ObservedSystem,
    orbit: &'a PeriodicSolution,
}

impl Sampler<'_> {
    fn states(&self, phases: &[f64]) -> Vec<Vec<f64>> {
        let stretch = Stretch {
            frequency_hz: self.orbit.frequency_hz,
            start: 0.0,
            end: f64::from(self.orbit.period_multiple),
        };
        let settings = GeneralSettings::with_tolerance(1e-13);
        sample(&self.rig.system, &stretch, &self.orbit.nodes[0], phases, &settings).unwrap()
    }

    /// The equations of motion, read off once more: `q'' = -w^2 q - C q' - g u'' + phi F`, `y = phi_y q + u`.
    fn values(&self, phase: f64, state: &[f64]) -> Values {
        let (model, element) = (self.rig.system.model(), &self.rig.system.elements()[0]);
        let n = self.rig.system.dof();
        let (q, v) = state.split_at(n);
        let read = |row: &[f64], part: &[f64]| row.iter().zip(part).map(|(a, b)| a * b).sum::<f64>();
        let level = element.law.contacts()[0].level;
        let relative = read(&element.shape, q);
        let force = element.law.force(relative, 0.0).value;
        let omega = TAU * self.orbit.frequency_hz;
        let u = self.rig.system.support_motions(1.0, 0.0)[0][0] * (TAU * phase).cos();
        let inertia = &model.supports[0].inertia;
        let rate = |i: usize| {
            let damping: f64 = (0..n).map(|j| model.damping[(i, j)] * v[j]).sum();
            let load = inertia[i] * omega * omega * u + element.shape[i] * force;
            load - model.natural_frequencies[i].powi(2) * q[i] - damping
        };
        let rates: Vec<f64> = (0..n).map(rate).collect();
        let response = &self.rig.response;
        Values {
            displacement: read(&response.shape, q) + response.support_ratios[0] * u,
            acceleration: read(&response.shape, &rates) - response.support_ratios[0] * omega * omega * u,
            clearance: relative - level,
            speed: read(&element.shape, v),
            force: -force,
        }
    }

    fn between(&self, start: f64, end: f64, points: u32) -> Vec<(f64, Values)> {
        let phase = |k: u32| start + (end - start) * f64::from(k) / f64::from(points);
        let phases: Vec<f64> = (0..=points).map(phase).collect();
        let states = self.states(&phases);
        phases.iter().zip(&states).map(|(&phase, state)| (phase, self.values(phase, state))).collect()
    }

    /// Largest of a value: about the five largest local maxima of the equal phases once more, in a thousandth
    /// of their distance.
    fn largest(&self, coarse: &[(f64, Values)], of: fn(&Values) -> f64) -> f64 {
        let peak = |i: &usize| {
            let [before, at, after] = [i - 1, *i, i + 1].map(|k| of(&coarse[k].1));
            at >= before && at >= after
        };
        let mut peaks: Vec<usize> = (1..coarse.len() - 1).filter(peak).collect();
        peaks.sort_by(|&a, &b| of(&coarse[b].1).total_cmp(&of(&coarse[a].1)));
        let refined = peaks.into_iter().take(5).flat_map(|i| {
            let values = self.between(coarse[i - 1].0, coarse[i + 1].0, 2000);
            values.into_iter().map(|(_, value)| of(&value)).collect::<Vec<_>>()
        });
        refined.fold(0.0, f64::max)
    }

    fn all(&self) -> Sampled {
        let periods = f64::from(self.orbit.period_multiple);
        let coarse = self.between(0.0, periods, 8_000 * self.orbit.period_multiple);
        let onsets = coarse.windows(2).filter(|pair| pair[0].1.clearance <= 0.0 && pair[1].1.clearance > 0.0);
        let speeds: Vec<f64> = onsets
            .map(|pair| {
                let fine = self.between(pair[0].0, pair[1].0, 1000);
                let crossing = fine.windows(2).find(|pair| pair[1].1.clearance > 0.0).unwrap();
                let (a, b) = (crossing[0].1, crossing[1].1);
                a.speed + a.clearance / (a.clearance - b.clearance) * (b.speed - a.speed)
            })
            .collect();
        let dense = self.between(0.0, periods, 200_000);
        let dt = periods / (200_000.0 * self.orbit.frequency_hz);
        Sampled {
            displacement: self.largest(&coarse, |values| values.displacement.abs()),
            acceleration: self.largest(&coarse, |values| values.acceleration.abs()),
            contact_force: self.largest(&coarse, |values| values.force),
            impact_velocity: speeds.iter().fold(0.0, |a, b| f64::max(a, *b)),
            impulse: dense[1..].iter().map(|(_, values)| values.force * dt).sum(),
            contacts: speeds.len() as u32,
        }
    }
}

/// Orbits of the paper's beam from one contact to many, stable and unstable.
fn beam_orbits(rig: &ObservedSystem) -> Vec<PeriodicSolution> {
    let found = [(33.6, 1), (36.2, 1), (32.34, 1), (27.55, 1), (29.0, 1), (66.0, 2), (53.0, 2), (99.5, 3)];
    found.map(|(frequency_hz, multiple)| orbit(rig, frequency_hz, multiple)).to_vec()
}

/// Displacements to 1e-8 and accelerations to 1e-6: the acceleration has its peak within a contact of a
/// hundred microseconds.
#[test]
fn maxima_and_contacts_of_the_beam_are_those_of_dense_sampling() {
    let rig = paper_beam();
    let mut counts = Vec::new();
    for orbit in beam_orbits(&rig) {
        let sampled = Sampler { rig: &rig, orbit: &orbit }.all();
        let OrbitMaxima { displacement, acceleration, contact_force, impact_velocity, impulse, contacts } =
            orbit.maxima;
        assert_relative_eq!(displacement, sampled.displacement, max_relative = 1e-8);
        assert_relative_eq!(acceleration, sampled.acceleration, max_relative = 1e-6);
        assert_relative_eq!(contact_force, sampled.contact_force, max_relative = 1e-6);
        assert_eq!(contacts, sampled.contacts, "{} Hz", orbit.frequency_hz);
        assert_relative_eq!(impact_velocity, sampled.impact_velocity, max_relative = 1e-7);
        assert_relative_eq!(impulse, sampled.impulse, max_relative = 1e-5); // The trapezoidal rule.
        counts.push(contacts);
    }
    assert!(
        counts.contains(&1) && counts.contains(&2) && counts.iter().any(|&count| count >= 9),
        "{counts:?}"
    );
}
