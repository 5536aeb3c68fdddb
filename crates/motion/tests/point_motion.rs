//! Acceleration of a point from the forces that a motion tells: the derivative of its velocity, whatever the
//! law remembers.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{beam_with, element, force, hertz, integrator, rigid, settled};
use hammerbeam_motion::{
    Law, Load, PointMotion, Stretch, System,
    law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop},
};

const SAMPLES: usize = 40_000;

/// Largest difference between accelerations and central differences of velocities, of velocities and those of
/// displacements, each over the largest of them, where no contact begins or ends within the four samples; and
/// how many of these accelerations lie within a contact.
fn error(system: &System, (shape, ratios): (&[f64], &[f64]), frequency_hz: f64) -> ([f64; 2], usize) {
    let stretch = Stretch { frequency_hz, start: 0.3, end: 1.3 };
    let state = settled(system, frequency_hz, 60, 0.3);
    let phases: Vec<f64> = (0..SAMPLES).map(|k| 0.3 + k as f64 / SAMPLES as f64).collect();
    let trace = integrator(system).trace(&stretch, &state, &phases).unwrap();
    let point = PointMotion::of(system, frequency_hz, shape, ratios);
    let of = |k: usize| point.at(phases[k], &trace.samples[k], &trace.forces[k]);
    let motion: Vec<[f64; 3]> = (0..SAMPLES).map(of).collect();
    let time = |k: usize| k as f64 / (SAMPLES as f64 * frequency_hz);
    let ends: Vec<f64> = trace
        .contacts
        .iter()
        .flat_map(|piece| [piece.begin.as_ref().map(|touch| touch.time), piece.end])
        .flatten()
        .collect();
    let (mut errors, mut largest, mut inside) = ([0.0_f64; 2], [0.0_f64; 2], 0);
    for k in (2..SAMPLES - 2).filter(|&k| !ends.iter().any(|end| (time(k - 2)..=time(k + 2)).contains(end))) {
        for (j, (error, most)) in errors.iter_mut().zip(&mut largest).enumerate() {
            let by_two = motion[k + 2][j] - motion[k - 2][j];
            let by_one = motion[k + 1][j] - motion[k - 1][j];
            let slope = (8.0 * by_one - by_two) / (12.0 * time(1));
            *error = error.max((motion[k][j + 1] - slope).abs());
            *most = most.max(slope.abs());
        }
        inside += usize::from(trace.forces[k].iter().any(|force| *force != 0.0));
    }
    ([errors[0] / largest[0], errors[1] / largest[1]], inside)
}

/// Differences of the fourth order over samples that resolve a contact two hundred times leave far less; at
/// the end of a Hertz contact the third derivative of its force has no bound.
#[test]
fn acceleration_of_the_beam_is_the_slope_of_its_velocity_in_every_contact() {
    let restitution = |model| {
        let elastic = HertzStop::with_gap(4.5e9, 0.0).unwrap();
        Law::Restitution(RestitutionStop::new(elastic, model, 0.6).unwrap())
    };
    let loss = HuntCrossleyStop::new(HertzStop::with_gap(4.5e9, 0.0).unwrap(), 0.6).unwrap();
    let laws = [
        hertz(4.5e9, 0.0),
        Law::Linear(LinearStop::with_gap(1e5, 0.0).unwrap().with_damping(20.0).unwrap()),
        Law::HuntCrossley(loss),
        restitution(RestitutionModel::LankaraniNikravesh),
        restitution(RestitutionModel::Flores),
    ];
    for law in laws {
        let what = format!("{law:?}");
        let system = beam_with(0.015, law);
        let point = &system.model().points[0];
        let ([velocity, acceleration], inside) = error(&system, (&point.shape, &point.support_ratios), 36.0);
        assert!(inside > 100, "{what}: {inside} samples in contacts");
        assert!(velocity < 1e-6 && acceleration < 1e-4, "{what}: {velocity:e} {acceleration:e}");
    }
}

/// A constant force presses the mass on a stop, where it comes to rest: no acceleration there, only with the
/// force of the stop.
#[test]
fn held_mass_has_no_acceleration() {
    let model = crate::common::model(&[1.0], crate::common::diagonal(&[0.1]));
    let load = Load { support: vec![], forces: vec![force(&[1.0], 0, 0.9, 0.0)] };
    let system = System::new(model, &load, vec![element(&[1.0], 0.0, rigid(0.3, 0.2))]).unwrap();
    let stretch = Stretch { frequency_hz: 0.01, start: 0.0, end: 1.0 };
    let trace = integrator(&system).trace(&stretch, &[0.0, 0.0], &[0.9]).unwrap();
    let at =
        |forces: &[f64]| PointMotion::of(&system, 0.01, &[1.0], &[0.0]).at(0.9, &trace.samples[0], forces);
    let [displacement, velocity, acceleration] = at(&trace.forces[0]);
    assert!((displacement - 0.2).abs() < 1e-12 && velocity.abs() < 1e-12 && acceleration.abs() < 1e-12);
    // 0.9 N less the spring's 0.2 N on a mass of 1 kg.
    assert!((at(&[])[2] - 0.7).abs() < 1e-12);
}
