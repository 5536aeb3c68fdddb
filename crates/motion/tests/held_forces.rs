//! Rigid stops that stick while other elements act: agreement of both integrators, and of sensitivities with
//! differences. Closed forms: `held_closed_forms.rs`.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{
    assert_agreement, cubic, damped, diagonal, differences::assert_sensitivities, element, force, formula,
    hertz, hunt_crossley, integrator, model, remembering, rigid, settled,
};
use hammerbeam_motion::{
    Harmonic, Law, LawConstant, Load, LocalElement, Parameter, Stretch, System,
    exact::{ContactPiece, ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe},
    law::{LinearStop, RestitutionModel, TwoSidedStop},
};
use hammerbeam_testkit::stride;

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

/// A Duffing oscillator: impacts, chatter to its end, sticking while the spring pulls, and the lift, located
/// in a force step.
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
    model.supports = vec![hammerbeam_structure::SupportInput {
        inertia: vec![0.5, 0.3, -0.1],
        damping: vec![0.02, 0.01, 0.03],
    }];
    let support = vec![Harmonic { order: 1, amplitude: 2e-3, phase: 0.4 }.into()];
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

const LAWS: usize = 8;

fn laws() -> [(&'static str, Law); LAWS] {
    [
        ("cubic", cubic(3e7)),
        ("formula", formula("3e7*x^3 + 4*tanh(6*v)")),
        ("hertz", hertz(1e7, 5e-4)),
        ("linear", Law::Linear(LinearStop::with_gap(5e3, 3e-4).unwrap())),
        ("two-sided", Law::TwoSided(TwoSidedStop::new(5e3, 3e-4, 4e-4).unwrap())),
        ("hunt-crossley", hunt_crossley(1e7, 0.5, 5e-4)),
        ("damped", damped(5e3, 4.0, 3e-4)),
        ("memory", remembering(1e7, RestitutionModel::LankaraniNikravesh, 0.7, 6e-4)),
    ]
}

/// Whether a law has no contact.
fn always_acts(name: &str) -> bool {
    ["cubic", "formula"].contains(&name)
}

/// Every law beside a stop that sticks and lifts: contacts that close and open meanwhile, from states that
/// are held and free. By default beside every other law.
#[test]
fn elements_act_while_a_stop_is_held() {
    for (name, law) in laws().into_iter().step_by(stride(2)) {
        let mut all = Seen::default();
        for (restitution, ratio, coupled) in [(0.5, 1.0, false), (0.0, 0.0, true), (0.6, 1.0, true)] {
            let system = pressed(restitution, ratio, coupled, further(law.clone()));
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
        assert!(always_acts(name) || (all.closes > 10 && all.opens > 10), "{name} {all:?}");
    }
}

/// The columns by state, frequency and every parameter, of the held stop and of the element that acts.
#[test]
fn sensitivities_through_held_force_steps_are_those_of_differences() {
    for (name, law) in laws() {
        for (restitution, ratio, coupled) in [(0.5, 1.0, false), (0.6, 0.0, true)] {
            let system = pressed(restitution, ratio, coupled, further(law.clone()));
            let mut parameters = vec![
                Parameter::ExcitationScale,
                Parameter::gap(0),
                Parameter::restitution(0),
                Parameter::ADDED_DAMPING_RATIO,
            ];
            if law.constant(LawConstant::Stiffness).is_some() {
                parameters.push(Parameter::stiffness(1));
            }
            if law.constant(LawConstant::Damping).is_some_and(|damping| damping > 0.0) {
                parameters.push(Parameter::contact_damping(1));
            }
            if law.constant(LawConstant::Restitution).is_some() {
                parameters.push(Parameter::restitution(1));
            }
            if !always_acts(name) && name != "two-sided" {
                parameters.push(Parameter::gap(1));
            }
            for end in [0.95, 1.4] {
                let state = settled(&system, 1.7, 8, 0.4);
                let stretch = Stretch { frequency_hz: 1.7, start: 0.4, end };
                assert_sensitivities(&system, &stretch, &state, &parameters, 2e-6);
            }
        }
    }
}

/// A second rigid stop beside the first, and a further element: stops held together under forces, impacts of
/// one while the other is held.
fn two_stops(restitution: f64, second: [f64; 3], coupled: bool, further: LocalElement) -> System {
    let system = pressed(restitution, 1.0, coupled, further);
    let second_stop =
        LocalElement { name: "second".into(), ..element(&second, 0.0, rigid(restitution, 5e-4)) };
    let support = vec![Harmonic { order: 1, amplitude: 1e-3, phase: 0.4 }.into()];
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

/// By default with every other law.
#[test]
fn several_stops_are_held_while_elements_act() {
    let mut held = [0; 3];
    for (name, law) in laws().into_iter().step_by(stride(2)) {
        for (restitution, second, coupled) in
            [(0.5, [0.7, -0.9, 0.5], false), (0.3, [0.9, 0.4, 0.8], true), (0.0, [-0.5, 0.9, 0.6], true)]
        {
            let system = two_stops(restitution, second, coupled, further(law.clone()));
            for (start, end) in [(0.0, 0.3), (0.2, 0.7), (0.5, 1.1), (0.75, 1.75)] {
                if name == "memory" && start < 0.5 {
                    continue;
                }
                let state = settled(&system, 1.7, 8, start);
                let stretch = Stretch { frequency_hz: 1.7, start, end };
                let mut exact = integrator(&system);
                exact.advance(&stretch, &state).unwrap();
                held[exact.directions_lost() / 2] += 1;
                let what = format!("{name} {restitution} {start}");
                // Stops that throw one another off chatter in cycles of chatter; each cycle leaves its end
                // out, which the sensitivities feel to about 2e-6.
                assert_agreement(&system, &stretch, &state, 5e-6, &what);
            }
        }
    }
    assert!(held[1] > 10 && held[2] > 10, "{held:?}");
}

/// A damper sets in with a jump that throws the held stop off: the lift is at the touch, and the
/// sensitivities jump with it.
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
                let parameters = [Parameter::ExcitationScale, Parameter::gap(0), Parameter::gap(1)];
                assert_sensitivities(&system, &stretch, &state, &parameters, 2e-6);
                from_free += 1;
            }
        }
        assert!(thrown > 1 && from_free > 0, "{coupling}: {thrown} {from_free}");
    }
}

/// Maxima, impulses and numbers of contacts of both integrators while forces act on a held structure; the
/// trace has the same.
#[test]
fn observed_motions_agree() {
    for (name, law) in laws() {
        let system = pressed(0.5, 1.0, false, further(law));
        let response = [0.2, 1.0, 0.7];
        let state = settled(&system, 1.7, 8, 0.4);
        let stretch = Stretch { frequency_hz: 1.7, start: 0.4, end: 1.4 };
        let mut exact =
            ExactIntegrator::watching(system.clone(), ExactSettings::default(), Some((&response, &[1.0])))
                .unwrap();
        let found = exact.observe(&[(stretch, &state)]).unwrap();
        let settings = GeneralSettings::with_tolerance(1e-12);
        let expected = observe(&system, &stretch, &state, (&response, &[1.0]), &settings).unwrap();
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
