//! Rigid stops that stick while other elements act: agreement of both integrators, differences, closed forms, energy.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{assert_agreement, diagonal, element, integrator, model, settled};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    law::{CubicSpring, LinearStop, RigidStop},
};

fn rigid(restitution: f64, gap: f64) -> Law {
    Law::Rigid(RigidStop::with_gap(restitution, gap).unwrap())
}

fn cubic(stiffness: f64) -> Law {
    Law::Cubic(CubicSpring::new(stiffness).unwrap())
}

fn damped(stiffness: f64, damping: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap().with_damping(damping).unwrap())
}

fn force(shape: &[f64], order: u32, amplitude: f64, phase: f64) -> HarmonicForce {
    HarmonicForce { shape: shape.to_vec(), harmonic: Harmonic { order, amplitude, phase } }
}

/// A Duffing oscillator that is pressed on a rigid stop in a part of every period.
fn duffing(restitution: f64) -> System {
    let load = Load { support: vec![], forces: vec![force(&[1.0], 0, 3.0, 0.0), force(&[1.0], 1, 12.0, 0.3)] };
    let stop = element(&[1.0], 0.0, rigid(restitution, 0.03));
    let spring = LocalElement { name: "spring".into(), ..element(&[1.0], 0.0, cubic(3e4)) };
    System::new(model(&[8.0], diagonal(&[0.7])), &load, vec![stop, spring]).unwrap()
}

#[test]
fn a_duffing_oscillator_chatters_and_sticks() {
    for restitution in [0.0, 0.4, 0.7] {
        let system = duffing(restitution);
        for (start, end) in [(0.0, 0.5), (0.5, 1.0), (0.2, 1.2), (0.9, 1.4)] {
            let state = settled(&system, 1.1, 6, start);
            let stretch = Stretch { frequency_hz: 1.1, start, end };
            let trace = integrator(&system).trace(&stretch, &state, &[]).unwrap();
            println!("{restitution} {start} {end}");
            for c in trace.contacts.iter().filter(|c| c.peak_force > 0.0) {
                println!("   {} {:?} {:?} {} {}", c.element, c.begin.as_ref().map(|b| b.time), c.end, c.impulse, c.peak_force);
            }
            println!("{} contacts", trace.contacts.len());
            assert_agreement(&system, &stretch, &state, 1e-9, &format!("{restitution} {start}"));
        }
    }
}
