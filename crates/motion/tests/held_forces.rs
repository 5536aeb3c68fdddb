//! Rigid stops that stick while other elements act: agreement of both integrators, differences, closed forms, energy.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{
    assert_agreement, diagonal, differences::assert_sensitivities, element, hertz, integrator, model, settled,
};
use hammerbeam_motion::{
    Flow, Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, Stretch, System,
    exact::{ContactPiece, ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe},
    law::{
        CubicSpring, HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop,
        TwoSidedStop,
    },
};
use hammerbeam_structure::{Connection, Damping, Lumped, LumpedMass, Reduction};

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
    let load =
        Load { support: vec![], forces: vec![force(&[1.0], 0, 3.0, 0.0), force(&[1.0], 1, 12.0, 0.3)] };
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
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    sticks: usize,
    lifts: usize,
    /// Contacts of other elements that begin while a stop is held, and that end.
    closes: usize,
    opens: usize,
}

impl std::ops::AddAssign for Seen {
    fn add_assign(&mut self, other: Self) {
        self.sticks += other.sticks;
        self.lifts += other.lifts;
        self.closes += other.closes;
        self.opens += other.opens;
    }
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

/// A Duffing oscillator: impacts, chatter to its end, sticking while the spring pulls, and the lift, located in a force step.
#[test]
fn a_duffing_oscillator_chatters_sticks_and_lifts() {
    let mut all = Seen::default();
    for restitution in [0.0, 0.4, 0.6] {
        let system = duffing(restitution);
        for stretch in [(0.0, 0.5), (0.7, 1.5), (0.2, 1.5), (0.9, 1.4)] {
            all += assert_same(&system, 1.1, stretch, 1e-9, &format!("{restitution}"));
        }
        if restitution > 0.5 {
            continue;
        }
        // The state at the end of a held stretch depends on nothing before.
        let state = settled(&system, 1.1, 8, 0.7);
        let stretch = Stretch { frequency_hz: 1.1, start: 0.7, end: 1.05 };
        let flow = integrator(&system).flow(&stretch, &state).unwrap();
        assert!(
            (flow.state[0] - 0.03).abs() < 1e-15 && flow.state[1] == 0.0,
            "{restitution} {:?}",
            flow.state
        );
        assert!((0..4).all(|k| flow.by_state[(k / 2, k % 2)] == 0.0), "{restitution}");
    }
    assert!(all.sticks > 4 && all.lifts > 8, "{all:?}");
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

/// A further element beside the stop.
fn further(law: Law) -> LocalElement {
    LocalElement { name: "further".into(), ..element(&[0.4, -0.9, 0.7], 0.3, law) }
}

const LAWS: usize = 7;

fn laws() -> [(&'static str, Law); LAWS] {
    [
        ("cubic", cubic(3e7)),
        ("hertz", hertz(1e7, 5e-4)),
        ("linear", Law::Linear(LinearStop::with_gap(5e3, 3e-4).unwrap())),
        ("two-sided", Law::TwoSided(TwoSidedStop::new(5e3, 3e-4, 4e-4).unwrap())),
        ("hunt-crossley", hunt_crossley(1e7, 0.5, 5e-4)),
        ("damped", damped(5e3, 4.0, 3e-4)),
        ("memory", restitution_law(1e7, 0.7, 6e-4)),
    ]
}

/// Every law beside a stop that sticks and lifts: contacts that close and open meanwhile, from states that are held and free.
#[test]
fn elements_act_while_a_stop_is_held() {
    for (name, law) in laws() {
        let mut all = Seen::default();
        for (restitution, ratio, coupled) in [(0.5, 1.0, false), (0.0, 0.0, true), (0.6, 1.0, true)] {
            let system = pressed(restitution, ratio, coupled, further(law));
            let stretches = [(0.4, 0.7), (0.4, 0.95), (0.4, 1.4), (0.0, 0.1), (0.0, 0.5), (0.0, 1.3)];
            for stretch in stretches {
                // A stretch cannot begin in a contact with memory.
                if name == "memory" && stretch.0 == 0.0 {
                    continue;
                }
                let what = format!("{name} {restitution} {ratio}");
                all += assert_same(&system, 1.7, stretch, 1e-9, &what);
            }
        }
        assert!(all.sticks > 5 && all.lifts > 2, "{name} {all:?}");
        assert!(name == "cubic" || (all.closes > 10 && all.opens > 10), "{name} {all:?}");
    }
}

/// The columns by state, frequency and every parameter, of the held stop and of the element that acts.
#[test]
fn sensitivities_through_held_force_steps_are_those_of_differences() {
    for (name, law) in laws() {
        for (restitution, ratio, coupled) in [(0.5, 1.0, false), (0.6, 0.0, true)] {
            let system = pressed(restitution, ratio, coupled, further(law));
            let mut parameters = vec![
                Parameter::ExcitationScale,
                Parameter::Gap { element: 0 },
                Parameter::Restitution { element: 0 },
                Parameter::Stiffness { element: 1 },
            ];
            if !law.depends_on_velocity() {
                parameters.push(Parameter::AddedDampingRatio);
            }
            if name != "cubic" && name != "two-sided" {
                parameters.push(Parameter::Gap { element: 1 });
            }
            for end in [0.95, 1.4] {
                let state = settled(&system, 1.7, 8, 0.4);
                let stretch = Stretch { frequency_hz: 1.7, start: 0.4, end };
                assert_sensitivities(&system, &stretch, &state, &parameters, 2e-6);
            }
        }
    }
}

/// A second rigid stop beside the first, and a further element: stops held together under forces, impacts of one while the other is held.
fn two_stops(restitution: f64, second: [f64; 3], coupled: bool, further: LocalElement) -> System {
    let system = pressed(restitution, 1.0, coupled, further);
    let second_stop =
        LocalElement { name: "second".into(), ..element(&second, 0.0, rigid(restitution, 5e-4)) };
    let support = vec![Harmonic { order: 1, amplitude: 1e-3, phase: 0.4 }];
    let first = system.elements()[0].shape.clone();
    let forces = vec![
        force(&first, 0, 2.0, 0.0),
        force(&first, 1, 3.0, 0.3),
        force(&second, 0, 2.5, 0.0),
        force(&second, 2, 3.5, 1.1),
    ];
    let mut elements = system.elements().to_vec();
    elements.push(second_stop);
    System::new(system.model().clone(), &Load { support, forces }, elements).unwrap()
}

#[test]
fn several_stops_are_held_while_elements_act() {
    let mut held = [0; 3];
    for (name, law) in laws() {
        for (restitution, second, coupled) in
            [(0.5, [0.7, -0.9, 0.5], false), (0.3, [0.9, 0.4, 0.8], true), (0.0, [-0.5, 0.9, 0.6], true)]
        {
            let system = two_stops(restitution, second, coupled, further(law));
            for (start, end) in [(0.0, 0.3), (0.2, 0.7), (0.5, 1.1), (0.75, 1.75)] {
                if name == "memory" && start < 0.5 {
                    continue;
                }
                let state = settled(&system, 1.7, 8, start);
                let stretch = Stretch { frequency_hz: 1.7, start, end };
                let mut exact = integrator(&system);
                exact.advance(&stretch, &state).unwrap();
                held[exact.held_at_once()] += 1;
                let what = format!("{name} {restitution} {start}");
                // Stops that throw one another off chatter in cycles of chatter; each cycle leaves its end out, which the sensitivities feel to about 2e-6.
                assert_agreement(&system, &stretch, &state, 5e-6, &what);
            }
        }
    }
    assert!(held[1] > 10 && held[2] > 10, "{held:?}");
}

/// A damper sets in with a jump that throws the held stop off: the lift is at the touch, and the sensitivities jump with it.
#[test]
fn a_damper_throws_a_held_stop_off() {
    let load = Load {
        support: vec![],
        forces: vec![force(&[1.0, 0.0], 0, 1.0, 0.0), force(&[0.0, 1.0], 1, 6.0, 0.2)],
    };
    for coupling in [0.0, 0.8] {
        let damping = faer::Mat::from_fn(2, 2, |i, j| if i == j { 1.0 + i as f64 } else { coupling });
        let stop = element(&[1.0, 0.0], 0.0, rigid(0.3, 0.01));
        let law = damped(400.0, 20.0, 0.012);
        let damper = LocalElement { name: "damper".into(), ..element(&[0.3, 1.0], 0.0, law) };
        let system = System::new(model(&[5.0, 20.0], damping), &load, vec![stop, damper]).unwrap();
        let (mut thrown, mut from_free) = (0, 0);
        for (start, end) in
            [(0.0, 0.6), (0.1, 1.1), (0.2, 1.2), (0.3, 0.9), (0.4, 1.4), (0.6, 1.6), (0.85, 1.25)]
        {
            let state = settled(&system, 2.0, 8, start);
            let stretch = Stretch { frequency_hz: 2.0, start, end };
            let trace = integrator(&system).trace(&stretch, &state, &[]).unwrap();
            let touches = trace.contacts.iter().filter(|c| c.element == 1).filter_map(|c| c.begin.as_ref());
            let touches: Vec<f64> = touches.map(|begin| begin.time).collect();
            let held = trace.contacts.iter().filter(|c| c.element == 0 && c.peak_force > 0.0);
            thrown += held.filter(|c| c.end.is_some_and(|end| touches.contains(&end))).count();
            assert_agreement(&system, &stretch, &state, 1e-9, &format!("{coupling} {start}"));
            // Beside a state that is held motions have no two-sided derivative.
            if trace.contacts.iter().all(|contact| contact.begin.is_some()) {
                let parameters = [
                    Parameter::ExcitationScale,
                    Parameter::Gap { element: 0 },
                    Parameter::Gap { element: 1 },
                ];
                assert_sensitivities(&system, &stretch, &state, &parameters, 2e-6);
                from_free += 1;
            }
        }
        assert!(thrown > 1 && from_free > 0, "{coupling}: {thrown} {from_free}");
    }
}

/// Maxima, impulses and numbers of contacts of both integrators while forces act on a held structure; the trace has the same.
#[test]
fn observed_motions_agree() {
    for (name, law) in laws() {
        let system = pressed(0.5, 1.0, false, further(law));
        let response = [0.2, 1.0, 0.7];
        let state = settled(&system, 1.7, 8, 0.4);
        let stretch = Stretch { frequency_hz: 1.7, start: 0.4, end: 1.4 };
        let mut exact =
            ExactIntegrator::watching(system.clone(), ExactSettings::default(), Some((&response, 1.0)))
                .unwrap();
        let found = exact.observe(&[(stretch, &state)]).unwrap();
        let settings = GeneralSettings::with_tolerance(1e-12);
        let expected = observe(&system, &stretch, &state, (&response, 1.0), &settings).unwrap();
        assert_eq!(found.contacts(), expected.contacts(), "{name}");
        for (what, found, expected) in [
            ("displacement", found.displacement, expected.displacement),
            ("acceleration", found.acceleration, expected.acceleration),
            ("force", found.contact_force, expected.contact_force),
            ("speed", found.impact_velocity, expected.impact_velocity),
            ("impulse", found.impulse, expected.impulse),
        ] {
            // The general integrator has the largest acceleration to 1e-9.
            assert!((found / expected - 1.0).abs() < 2e-9, "{name} {what}: {found} {expected}");
        }
        let trace = exact.trace(&stretch, &state, &[]).unwrap();
        let of_contacts =
            |contact: &&ContactPiece| !system.elements()[contact.element].law.contacts().is_empty();
        let contacts: Vec<_> = trace.contacts.iter().filter(of_contacts).collect();
        let impulse: f64 = contacts.iter().map(|contact| contact.impulse).sum();
        assert!((impulse / found.impulse - 1.0).abs() < 1e-12, "{name}: {impulse}");
        let peak = contacts.iter().map(|contact| contact.peak_force).fold(0.0, f64::max);
        // Of elements with a force the trace takes the peak from polynomials.
        assert!((peak / found.contact_force - 1.0).abs() < 1e-9, "{name}: {peak}");
    }
}

/// The oracle of a linear spring: as an element that acts always, or in the structure with the static load of its preload, it is the same motion.
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
            if let Some(law) = second {
                elements.push(LocalElement { name: "second".into(), ..element(&two, 0.0, law) });
            }
            System::new(model, &Load { support: vec![], forces }, elements).unwrap()
        };
        Self { as_element: system(false), in_structure: system(true) }
    }
}

/// `[y; y']` of the masses, and the same of the columns of a flow, from modal ones: `y = Phi q`, `Phi^-1 = Phi^T M`.
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
                        stuck += usize::from(exact.held_at_once() > 0);
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

/// A free mass under the load g on a stop at h, beside a cubic spring: at rest `lambda = g - k h^3`, and all energy that the spring does not hold is lost to the stop.
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

/// `k h^3 < g(t)` in a part of the period alone: the stop is left where `a + b cos(w t) = k h^3`, to rounding.
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

/// The pressing force dips below zero by a part of the load, down to rounding: the mass leaves for an instant, or not at all, and rests again. Where the touch comes within the time after the
/// lift in which rounding decides on the clearance, the search for it ended before it began.
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
        // What the load gave, the spring and the stop took, up to a bounce within the rounding margin of the clearance, 1e-14 m, whose speed is its root.
        let impulse: f64 = trace.contacts.iter().filter(|c| c.element == 0).map(|c| c.impulse).sum();
        let expected = (3.0 - k * h.powi(3)) / 0.7;
        assert!((impulse / expected - 1.0).abs() < 10.0 * dip * dip + 1e-8, "{dip:e}: {impulse} {expected}");
    }
    assert!((140..240).contains(&lifts), "{lifts}");
}
