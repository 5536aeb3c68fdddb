//! Orbits on whose branches a touch comes to lie on phase 0, of a stop with a damper: its force sets in with
//! a jump, so one touch too many or too few is another count of contacts, a false grazing, and a product of
//! the multipliers that lacks a factor.
//!
//! The load is given the phase at which the start or the end of the contact of one orbit lies on phase 0 to
//! rounding, and phases a rounding beside it, so that the states at both ends of the orbit lie on either side
//! of it.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::PI;

use crate::common::events::{Subject, general_multipliers, oscillator_driven_at, step_of, whole, with};
use hammerbeam_motion::{
    Law, Stretch,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::LinearStop,
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, Segments, find_start};

const TOUCHED_HZ: f64 = 0.1512;
const RANGE: (f64, f64) = (0.1505, 0.1519);
/// A phase in flight: the contact lasts some tenth of a cycle.
const LATER: f64 = 0.37;

/// `x'' + 0.05 x' + x = 0.4 cos(2 pi (f t + shift)) - F` with `F` the force of a spring of 20 N/m and a
/// damper at a gap of 0.3 m.
///
/// * `damping`: of the damper [N s/m].
fn subject(damping: f64, shift: f64) -> Subject {
    let law = LinearStop::with_gap(20.0, 0.3).unwrap().with_damping(damping).unwrap();
    oscillator_driven_at(2.0 * PI * shift, 1.0, 0.05, 0.4, Law::Linear(law))
}

fn settings() -> OrbitSettings {
    OrbitSettings { segments: Segments::Fixed(1), ..step_of(1e-4) }
}

fn orbit((system, response): &Subject, frequency_hz: f64) -> PeriodicSolution {
    find_start(system, response, frequency_hz, 1, &settings()).unwrap()
}

/// Where the contact of the orbit from the phase 0 begins, where its force vanishes, and where its
/// penetration ends [cycles].
fn instants(subject: &Subject, frequency_hz: f64) -> [f64; 3] {
    let orbit = orbit(subject, frequency_hz);
    let mut integrator = ExactIntegrator::new(subject.0.clone(), ExactSettings::default()).unwrap();
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: 2.0 };
    let trace = integrator.trace(&stretch, &orbit.nodes[0], &[]).unwrap();
    let contact = trace.contacts.iter().find(|contact| contact.begin.is_some()).unwrap();
    let times = [contact.begin.as_ref().unwrap().time, contact.end.unwrap(), contact.clear.unwrap()];
    assert!(times[1] < times[2], "the damper pulls before the penetration ends");
    times.map(|time| time * orbit.frequency_hz)
}

/// The same orbit from a phase at which it touches nothing, and so does none beside it.
fn started_later(subject: &Subject, orbit: &PeriodicSolution) -> PeriodicSolution {
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: LATER };
    let settings = GeneralSettings::with_tolerance(1e-12).state_only();
    let state = advance(&subject.0, &stretch, &orbit.nodes[0], &settings).unwrap().flow.state;
    PeriodicSolution { phase: LATER, nodes: vec![state], ..orbit.clone() }
}

/// The branch past the orbit that is cut `beside` roundings off an instant of its contact has one contact
/// everywhere, and the multipliers of the general integrator.
fn assert_one_contact(instant: f64, beside: i32) {
    let subject = subject(0.8, instant + f64::from(beside) * f64::EPSILON);
    let rows = whole(&subject, &orbit(&subject, TOUCHED_HZ), RANGE, &settings());
    assert!(rows.len() > 12, "{}", rows.len());
    assert!(with(&rows, |events| events.grazing).is_empty(), "{beside}: false grazing");
    for row in &rows {
        assert_eq!(row.solution.maxima.contacts, 1, "{beside}: {} Hz", row.solution.frequency_hz);
        assert_multipliers(&subject, &row.solution);
    }
}

/// The multipliers are those that the general integrator finds from a later phase.
fn assert_multipliers(subject: &Subject, orbit: &PeriodicSolution) {
    let expected = general_multipliers(&subject.0, &started_later(subject, orbit))[0];
    let found = orbit.floquet_multipliers[0];
    let error = (found[0] - expected[0]).hypot(found[1].abs() - expected[1].abs());
    assert!(error < 1e-8, "{} Hz, {found:?}, {expected:?}", orbit.frequency_hz);
}

#[test]
fn what_comes_to_lie_on_phase_0_is_no_grazing() {
    for instant in instants(&subject(0.8, 0.0), TOUCHED_HZ) {
        (-4..=4).for_each(|beside| assert_one_contact(instant, beside));
    }
}

/// Without the factor of the touch, or with it twice, these stable orbits have multipliers outside the unit
/// circle.
#[test]
fn an_orbit_that_is_cut_at_its_touch_is_as_stable_as_it_is() {
    for (damping, frequency_hz) in [(1.2, 0.165), (1.8, 0.1512), (1.8, 0.165), (2.5, 0.2)] {
        let [touch, ..] = instants(&subject(damping, 0.0), frequency_hz);
        for beside in -4..=4 {
            let subject = subject(damping, touch + f64::from(beside) * f64::EPSILON);
            for segments in [1, 3] {
                let settings = OrbitSettings { segments: Segments::Fixed(segments), ..settings() };
                let orbit = find_start(&subject.0, &subject.1, frequency_hz, 1, &settings).unwrap();
                assert!(orbit.stable(), "{damping} N s/m: {:?}", orbit.floquet_multipliers);
                assert_multipliers(&subject, &orbit);
            }
        }
    }
}

/// Without damping motions are the same forwards and backwards, and the mass rests at the deepest point of
/// its contact right at phase 0: by rounding it is closing at one end and opening at the other.
#[test]
fn a_contact_that_is_deepest_on_phase_0_is_one() {
    let law = Law::Linear(LinearStop::with_gap(20.0, 0.05).unwrap());
    let subject = oscillator_driven_at(PI, 1.0, 0.0, 0.4, law);
    let start = find_start(&subject.0, &subject.1, 0.35, 1, &settings()).unwrap();
    let settings = OrbitSettings { max_solutions: 300, max_step: 1e-3, ..settings() };
    let rows = whole(&subject, &start, (0.33, 0.37), &settings);
    let ends = [rows[0].solution.frequency_hz, rows[rows.len() - 1].solution.frequency_hz];
    assert_eq!(ends, [0.33, 0.37]);
    assert!(rows.iter().all(|row| row.solution.nodes[0][1].abs() < 1e-9), "at rest on phase 0");
    assert!(rows.iter().all(|row| row.solution.maxima.contacts == 1 && !row.events.grazing));
}
