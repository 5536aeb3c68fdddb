//! Rigid stops that hold while other elements act, in closed form: a spring as an element or in the
//! structure, rest, lift, and the touch soon after it.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{cubic, diagonal, element, force, hertz, integrator, model, rigid};
use hammerbeam_motion::{Flow, Law, Load, LocalElement, Stretch, System, law::LinearStop};
use hammerbeam_structure::{Connection, Damping, Lumped, LumpedMass, Reduction};

/// The oracle of a linear spring: as an element that acts always, or in the structure with the static load of
/// its preload, it is the same motion.
struct Spring {
    /// Masses of 1 and 0.6 kg in physical coordinates.
    as_element: System,
    in_structure: System,
}

const SPRING: f64 = 900.0;
const PRELOAD: f64 = 200.0;

impl Spring {
    fn new(restitution: f64, second: Option<Law>) -> Self {
        let system = |inside: bool| {
            let between =
                |a: &str, b: &str, constant: f64| Connection { between: [a.into(), b.into()], constant };
            let mut springs = vec![between("one", "two", 1500.0), between("two", "ground", 400.0)];
            if inside {
                springs.push(between("one", "ground", SPRING));
            }
            let mass = |name: &str, mass: f64| LumpedMass { name: name.into(), mass };
            let lumped = Lumped {
                masses: vec![mass("one", 1.0), mass("two", 0.6)],
                springs,
                dampers: vec![between("one", "two", 3.0), between("two", "ground", 1.0)],
            };
            let structure = lumped.structure().unwrap();
            let model = structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model;
            let shape = |name: &str| model.point(name).unwrap().shape.clone();
            let (one, two) = (shape("one"), shape("two"));
            let mut forces =
                vec![force(&one, 0, 190.0, 0.0), force(&one, 1, 35.0, 0.2), force(&two, 2, 9.0, 0.5)];
            let mut elements = vec![element(&one, 0.0, rigid(restitution, 0.01))];
            let law = Law::Linear(LinearStop::with_preload(SPRING, PRELOAD).unwrap());
            if inside {
                forces.push(force(&one, 0, -PRELOAD, 0.0));
            } else {
                elements.push(LocalElement { name: "spring".into(), ..element(&one, 0.0, law) });
            }
            if let Some(law) = second.clone() {
                elements.push(LocalElement { name: "second".into(), ..element(&two, 0.0, law) });
            }
            System::new(model, &Load { support: vec![], forces }, elements).unwrap()
        };
        Self { as_element: system(false), in_structure: system(true) }
    }
}

/// `[y; y']` of the masses, and the same of the columns of a flow, from modal ones: `y = Phi q`, `Phi^-1 =
/// Phi^T M`.
fn physical(system: &System, flow: &Flow) -> Vec<f64> {
    let masses = [1.0, 0.6];
    let model = system.model();
    let phi = |i: usize, k: usize| {
        model.points.iter().filter(|p| p.name == ["one", "two"][i]).map(|p| p.shape[k]).next().unwrap()
    };
    let rows = |values: &[f64]| -> Vec<f64> {
        (0..4).map(|r| (0..2).map(|k| phi(r % 2, k) * values[r / 2 * 2 + k]).sum()).collect()
    };
    let mut all = rows(&flow.state);
    all.extend(rows(&flow.by_frequency));
    for c in 0..4 {
        // Column by a physical coordinate: `sum_k dz/dq_k (Phi^-1)_kc`.
        let column: Vec<f64> = (0..4)
            .map(|i| (0..2).map(|k| flow.by_state[(i, c / 2 * 2 + k)] * phi(c % 2, k) * masses[c % 2]).sum())
            .collect();
        all.extend(rows(&column));
    }
    all
}

/// Modal state of a physical one.
fn modal(system: &System, state: [f64; 4]) -> Vec<f64> {
    let model = system.model();
    let phi = |name: &str| model.point(name).unwrap().shape.clone();
    let (one, two) = (phi("one"), phi("two"));
    (0..4).map(|r| one[r % 2] * state[r / 2 * 2] + 0.6 * two[r % 2] * state[r / 2 * 2 + 1]).collect()
}

#[test]
fn a_spring_as_an_element_is_one_in_the_structure() {
    for (restitution, second) in
        [(0.0, None), (0.5, None), (0.5, Some(hertz(3e5, 0.006))), (0.4, Some(rigid(0.3, 0.008)))]
    {
        let spring = Spring::new(restitution, second);
        let systems = [&spring.as_element, &spring.in_structure];
        for (from, start) in [([0.0; 4], 0.0), ([0.005, 0.001, 0.1, -0.2], 0.3)] {
            let mut at = systems.map(|system| modal(system, from));
            let mut stuck = 0;
            for cycle in 0..4 {
                let start = start + f64::from(cycle);
                let stretch = Stretch { frequency_hz: 1.3, start, end: start + 1.0 };
                let flows: Vec<Flow> = systems
                    .iter()
                    .zip(&at)
                    .map(|(system, state)| {
                        let mut exact = integrator(system);
                        let flow = exact.flow(&stretch, state).unwrap();
                        stuck += usize::from(exact.directions_lost() > 1);
                        flow
                    })
                    .collect();
                let [a, b] = [physical(systems[0], &flows[0]), physical(systems[1], &flows[1])];
                for part in (0..24).step_by(2) {
                    let size = b[part / 4 * 4..][..4].iter().fold(1e-3_f64, |size, x| size.max(x.abs()));
                    let error = (0..2).map(|i| (a[part + i] - b[part + i]).abs()).fold(0.0, f64::max);
                    assert!(error < 1e-10 * size, "{restitution} {cycle} {part}: {error:e} of {size:e}");
                }
                at = [flows[0].state.clone(), flows[1].state.clone()];
            }
            assert!(stuck > 5, "{restitution}: {stuck}");
        }
    }
}

/// A free mass under the load g on a stop at h, beside a cubic spring: at rest `lambda = g - k h^3`, and all
/// energy that the spring does not hold is lost to the stop.
#[test]
fn a_mass_rests_on_a_stop_beside_a_spring() {
    let (g, h, k) = (1.0, 0.5, 2.0_f64);
    for e in [0.0, 0.5] {
        let load = Load { support: vec![], forces: vec![force(&[1.0], 0, g, 0.0)] };
        let elements = vec![
            element(&[1.0], 0.0, rigid(e, h)),
            LocalElement { name: "spring".into(), ..element(&[1.0], 0.0, cubic(k)) },
        ];
        let system = System::new(model(&[0.0], diagonal(&[0.0])), &load, elements).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 12.0 };
        let trace = integrator(&system).trace(&stretch, &[0.0, 0.0], &[11.5]).unwrap();
        assert!((trace.state[0] - h).abs() < 1e-15 && trace.state[1].abs() < 1e-13, "{:?}", trace.state);
        let pressing = g - k * h.powi(3);
        assert!((trace.forces[0][0] + pressing).abs() < 1e-13, "{:?}", trace.forces);
        assert!((trace.forces[0][1] + k * h.powi(3)).abs() < 1e-13, "{:?}", trace.forces);
        let stop: Vec<_> = trace.contacts.iter().filter(|contact| contact.element == 0).collect();
        assert!((stop.last().unwrap().peak_force - pressing).abs() < 1e-12);
        let lost: f64 = stop.iter().map(|contact| contact.energy_lost).sum();
        let expected = g * h - 0.25 * k * h.powi(4);
        assert!((lost / expected - 1.0).abs() < 1e-11, "{e}: {lost} {expected}");
    }
}

/// `k h^3 < g(t)` in a part of the period alone: the stop is left where `a + b cos(w t) = k h^3`, to
/// rounding.
#[test]
fn a_lift_is_where_load_and_spring_are_in_balance() {
    let (a, b, h, k) = (3.0, 2.5, 0.5, 8.0_f64);
    let load = Load { support: vec![], forces: vec![force(&[1.0], 0, a, 0.0), force(&[1.0], 1, b, 0.0)] };
    let elements = vec![
        element(&[1.0], 0.0, rigid(0.3, h)),
        LocalElement { name: "spring".into(), ..element(&[1.0], 0.0, cubic(k)) },
    ];
    let system = System::new(model(&[0.0], diagonal(&[0.2])), &load, elements).unwrap();
    let stretch = Stretch { frequency_hz: 0.5, start: 0.0, end: 0.5 };
    let mut exact = integrator(&system);
    let trace = exact.trace(&stretch, &[h, 0.0], &[]).unwrap();
    let expected = ((k * h.powi(3) - a) / b).acos() / (std::f64::consts::PI);
    let held = trace.contacts.iter().find(|contact| contact.element == 0).unwrap();
    let found = held.end.unwrap();
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    // What the stop got: the integral of `a + b cos(pi t) - k h^3` up to there.
    let w = std::f64::consts::PI;
    let impulse = (a - k * h.powi(3)) * expected + b / w * (w * expected).sin();
    assert!((held.impulse / impulse - 1.0).abs() < 1e-12, "{} {impulse}", held.impulse);
    assert!((held.peak_force / (a + b - k * h.powi(3)) - 1.0).abs() < 1e-12);
    // Known before any impact: nothing of the state is left.
    let flow = exact.flow(&stretch, &[h, 0.0]).unwrap();
    assert!((0..4).all(|i| flow.by_state[(i / 2, i % 2)] == 0.0));
}

/// The pressing force dips below zero by a part of the load, down to rounding: the mass leaves for an
/// instant, or not at all, and rests again. Where the touch comes within the time after the lift in which
/// rounding decides on the clearance, the search for it ended before it began.
#[test]
fn a_touch_soon_after_a_lift_is_met() {
    let (h, k) = (0.5, 8.0_f64);
    let mut lifts = 0;
    for exponent in 0..240 {
        let dip = 1e-2 * 0.87_f64.powi(exponent);
        let loads = vec![force(&[1.0], 0, 3.0, 0.0), force(&[1.0], 1, 2.0 + dip, 0.0)];
        let spring = LocalElement { name: "spring".into(), ..element(&[1.0], 0.0, cubic(k)) };
        let elements = vec![element(&[1.0], 0.0, rigid(0.5, h)), spring];
        let load = Load { support: vec![], forces: loads };
        let system = System::new(model(&[0.0], diagonal(&[0.1])), &load, elements).unwrap();
        let stretch = Stretch { frequency_hz: 0.7, start: 0.0, end: 1.0 };
        let trace = integrator(&system).trace(&stretch, &[h, 0.0], &[]).unwrap();
        lifts += usize::from(trace.contacts[0].end.is_some());
        assert!(
            (trace.state[0] - h).abs() < 1e-13 && trace.state[1].abs() < 1e-12,
            "{dip:e}: {:?}",
            trace.state
        );
        // What the load gave, the spring and the stop took, up to a bounce within the rounding margin of the
        // clearance, 1e-14 m, whose speed is its root.
        let impulse: f64 = trace.contacts.iter().filter(|c| c.element == 0).map(|c| c.impulse).sum();
        let expected = (3.0 - k * h.powi(3)) / 0.7;
        assert!((impulse / expected - 1.0).abs() < 10.0 * dip * dip + 1e-8, "{dip:e}: {impulse} {expected}");
    }
    assert!((140..240).contains(&lifts), "{lifts}");
}
