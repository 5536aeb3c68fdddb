//! Rigid stops that stick while other elements act: agreement of both integrators, differences, closed forms, energy.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{assert_agreement, diagonal, element, hertz, integrator, model, settled};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::ContactPiece,
    law::{
        CubicSpring, HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop,
        TwoSidedStop,
    },
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

fn hunt_crossley(stiffness: f64, loss: f64, gap: f64) -> Law {
    Law::HuntCrossley(HuntCrossleyStop::new(HertzStop::with_gap(stiffness, gap).unwrap(), loss).unwrap())
}

fn restitution_law(stiffness: f64, e: f64, gap: f64) -> Law {
    let hertz = HertzStop::with_gap(stiffness, gap).unwrap();
    Law::Restitution(RestitutionStop::new(hertz, RestitutionModel::LankaraniNikravesh, e).unwrap())
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

/// Both integrators over one of these stretches of a settled motion; what its trace shows.
fn assert_same(system: &System, frequency_hz: f64, (start, end): (f64, f64), bound: f64, what: &str) -> Seen {
    let state = settled(system, frequency_hz, 8, start);
    let stretch = Stretch { frequency_hz, start, end };
    let trace = integrator(system).trace(&stretch, &state, &[]).unwrap();
    assert_agreement(system, &stretch, &state, bound, &format!("{what} {start} {end}"));
    Seen::of(system, &trace.contacts)
}

/// What happened in a motion.
#[derive(Debug, Default)]
struct Seen {
    sticks: usize,
    lifts: usize,
    /// Contacts of other elements that begin while a stop is held, and that end.
    closes: usize,
    opens: usize,
}

impl Seen {
    fn of(system: &System, contacts: &[ContactPiece]) -> Self {
        let rigid = |c: &&ContactPiece| system.elements()[c.element].law.rigid().is_some();
        let begin = |c: &ContactPiece| c.begin.as_ref().map_or(0.0, |begin| begin.time);
        let end = |c: &ContactPiece| c.end.unwrap_or(f64::INFINITY);
        let held: Vec<_> = contacts.iter().filter(rigid).filter(|c| c.peak_force > 0.0).collect();
        let inside = |time: f64| held.iter().any(|c| begin(c) < time && time < end(c));
        let others: Vec<_> = contacts.iter().filter(|c| !rigid(c)).collect();
        Self {
            sticks: held.iter().filter(|c| c.begin.is_some()).count(),
            lifts: held.iter().filter(|c| c.end.is_some()).count(),
            closes: others.iter().filter(|c| c.begin.is_some() && inside(begin(c))).count(),
            opens: others.iter().filter(|c| c.end.is_some_and(inside)).count(),
        }
    }
}

#[test]
fn a_duffing_oscillator_chatters_and_sticks() {
    for restitution in [0.0, 0.4, 0.7] {
        let system = duffing(restitution);
        for stretch in [(0.0, 0.5), (0.7, 1.5), (0.2, 1.5), (0.9, 1.4)] {
            let seen = assert_same(&system, 1.1, stretch, 1e-9, &format!("{restitution}"));
            println!("{restitution} {stretch:?} {seen:?}");
        }
    }
}

/// Three modes that are pressed on a rigid stop, with a further element.
fn pressed(restitution: f64, support_ratio: f64, coupled: bool, further: LocalElement) -> System {
    let shape = [1.0, 0.6, -0.4];
    let damping = if coupled {
        faer::Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.4 })
    } else {
        diagonal(&[0.8, 1.5, 3.0])
    };
    let mut model = model(&[20.0, 55.0, 130.0], damping);
    model.support = Some(hammerbeam_structure::SupportInput {
        inertia: vec![0.5, 0.3, -0.1],
        damping: vec![0.02, 0.01, 0.03],
    });
    let support = vec![Harmonic { order: 1, amplitude: 2e-3, phase: 0.4 }];
    let other = [0.3, -1.0, 0.8];
    let forces = vec![
        force(&shape, 0, 2.0, 0.0),
        force(&shape, 1, 3.0, 0.3),
        force(&other, 2, 4.0, 0.7),
        force(&other, 3, 2.0, 0.1),
    ];
    let stop = element(&shape, support_ratio, rigid(restitution, 1e-3));
    System::new(model, &Load { support, forces }, vec![stop, further]).unwrap()
}

#[test]
fn elements_act_while_a_stop_is_held() {
    let laws = [
        ("cubic", cubic(3e7)),
        ("hertz", hertz(1e7, 5e-4)),
        ("linear", Law::Linear(LinearStop::with_gap(5e3, 3e-4).unwrap())),
        ("two-sided", Law::TwoSided(TwoSidedStop::new(5e3, 3e-4, 4e-4).unwrap())),
        ("hunt-crossley", hunt_crossley(1e7, 0.5, 5e-4)),
        ("damped", damped(5e3, 4.0, 3e-4)),
        ("memory", restitution_law(1e7, 0.7, 5e-4)),
    ];
    for (name, law) in laws {
        for (restitution, ratio, coupled) in [(0.5, 1.0, false), (0.0, 0.0, true), (0.6, 1.0, true)] {
            let shape = [0.4, -0.9, 0.7];
            let further = LocalElement { name: "further".into(), ..element(&shape, 0.3, law) };
            let system = pressed(restitution, ratio, coupled, further);
            for (start, end) in [(0.4, 0.7), (0.4, 0.95), (0.4, 1.4), (0.0, 0.1), (0.0, 0.5), (0.0, 1.3)] {
                let what = format!("{name} {restitution} {ratio}");
                let run = std::panic::catch_unwind(|| assert_same(&system, 1.7, (start, end), 1e-9, &what));
                println!("{what} {start} {end} {run:?}");
            }
        }
    }
}
