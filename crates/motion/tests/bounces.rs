//! Bounces on stops that lose energy come back as closed forms, the first integral and the sources of the
//! laws say, and volumes shrink as Liouville's formula does.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use crate::common::{damped, element, hunt_crossley, integrator, model, remembering};
use faer::Mat;
use hammerbeam_motion::{
    Flow, Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, Trace},
    law::RestitutionModel,
};

/// A mass that flies against a stop on a heavy base, from `ahead` before it.
struct Bounce {
    system: System,
    mass: f64,
}

impl Bounce {
    fn new(mass: f64, law: Law) -> Self {
        let shape = [1.0 / mass.sqrt()];
        let system =
            System::new(model(&[0.0], Mat::zeros(1, 1)), &Load::default(), vec![element(&shape, 0.0, law)])
                .unwrap();
        Self { system, mass }
    }

    /// The flow from the speed `speed`, and the coefficient of restitution.
    fn restitution(&self, speed: f64, duration: f64) -> (Flow, f64) {
        let start = [-1e-6 * self.mass.sqrt(), speed * self.mass.sqrt()];
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: duration };
        let mut exact =
            ExactIntegrator::new(self.system.clone(), ExactSettings { tolerance: 1e-13 }).unwrap();
        let flow = exact.flow(&stretch, &start).unwrap();
        let restitution = -flow.state[1] / start[1];
        (flow, restitution)
    }
}

/// With `ratio = c/(2 sqrt(k m)) = sin x` the force ends after the angle `pi - 2 x`, and `e = exp(-(pi - 2 x)
/// tan x)`; overdamped the continuation of that, `exp(-2 ratio arcosh(ratio)/sqrt(ratio^2 - 1))`.
#[test]
fn a_spring_with_a_damper_sends_back_the_closed_form() {
    let (mass, stiffness): (f64, f64) = (0.3, 2e4);
    for ratio in [1e-3_f64, 0.1, 0.5, 0.9, 1.5, 4.0] {
        let damping = 2.0 * ratio * (stiffness * mass).sqrt();
        let (flow, found) = Bounce::new(mass, damped(stiffness, damping, 0.0)).restitution(0.7, 0.4);
        let (expected, time) = if ratio < 1.0 {
            let angle = PI - 2.0 * ratio.asin();
            let slowed = (1.0 - ratio * ratio).sqrt();
            ((-angle * ratio / slowed).exp(), angle / slowed)
        } else {
            let root = (ratio * ratio - 1.0).sqrt();
            ((-2.0 * ratio * ratio.acosh() / root).exp(), 2.0 * ratio.acosh() / root)
        };
        assert!((found / expected - 1.0).abs() < 1e-10, "ratio {ratio}: {found} against {expected}");
        // Liouville: the damper acts over the time of the contact; the saltation matrix has the
        // determinant 1.
        let shrunk = (-damping / mass * time / (stiffness / mass).sqrt()).exp();
        let determinant = flow.by_state.determinant();
        assert!((determinant / shrunk - 1.0).abs() < 1e-9, "ratio {ratio}: {determinant} against {shrunk}");
    }
}

/// `(1 + e) y = ln((1 + y)/(1 - e y))`, by bisection.
fn hunt_crossley_restitution(y: f64) -> f64 {
    let (mut low, mut high) = (0.0, (1.0_f64).min(1.0 / y));
    for _ in 0..200 {
        let e = 0.5 * (low + high);
        let excess = (1.0 + e) * y - y.ln_1p() + (-e * y).ln_1p();
        if excess > 0.0 { low = e } else { high = e }
    }
    0.5 * (low + high)
}

/// First integral of `p'' = -k/m p^1.5 (1 + y p'/v)`; `e = 1 - a v` to first order, and `-integral f_v/m` is
/// the logarithm in it.
#[test]
fn hunt_and_crossley_send_back_what_the_first_integral_says() {
    for (loss, speed) in [(1e-4, 1.0), (0.05, 0.8), (0.4, 0.5), (2.0, 1.0), (20.0, 2.0)] {
        let y = 1.5 * loss * speed;
        let bounce = Bounce::new(0.2, hunt_crossley(1e8, loss, 0.0));
        let (flow, found) = bounce.restitution(speed, 0.05);
        let expected = hunt_crossley_restitution(y);
        assert!((found - expected).abs() < 1e-9 * expected, "y {y}: {found} against {expected}");
        if loss * speed < 1e-3 {
            // The next term of the series is (a v)^2 times a number below one.
            assert!((found - (1.0 - loss * speed)).abs() < (loss * speed).powi(2));
        }
        // `(1 - e y)/(1 + y)`; the entries of the matrix are of order one.
        let shrunk = (-(1.0 + expected) * y).exp();
        let determinant = flow.by_state.determinant();
        assert!((determinant - shrunk).abs() < 1e-10, "y {y}: {determinant} against {shrunk}");
    }
}

/// What comes out of two bodies alone solves `(1 + e_out) c = ln((1 + c)/(1 - e_out c))` with the factor c of
/// the model.
#[test]
fn restitution_that_comes_out_is_that_of_the_first_integral() {
    for model in RestitutionModel::ALL {
        for e in [0.99, 0.9, 0.6, 0.3, 0.1] {
            let bounce = Bounce::new(0.2, remembering(1e8, model, e, 0.0));
            for speed in [0.05, 2.0] {
                let (flow, found) = bounce.restitution(speed, 0.2);
                let expected = hunt_crossley_restitution(model.factor(e));
                assert!((found - expected).abs() < 1e-9, "{model:?} {e}: {found} against {expected}");
                // Twice the speed comes back twice as fast: the column by the speed has the whole of e.
                let by_speed = flow.by_state[(1, 1)];
                assert!((by_speed + expected).abs() < 1e-8, "{model:?} {e}: {by_speed} against {expected}");
            }
        }
    }
}

/// What comes out of each factor as its source prints it, solved by bisection outside of this program.
#[test]
fn restitution_that_comes_out_is_that_of_the_printed_factors() {
    use RestitutionModel::{
        Flores, Gonthier, HerbertMcWhannell, HuGuo, HuntCrossley, LankaraniNikravesh, LeeWang,
    };
    let table = [
        (HuntCrossley, [0.909_016, 0.768_000, 0.662_962, 0.581_288]),
        (HerbertMcWhannell, [0.900_893, 0.722_683, 0.593_624, 0.519_967]),
        (LeeWang, [0.952_370, 0.869_343, 0.799_199, 0.738_995]),
        (LankaraniNikravesh, [0.913_177, 0.795_973, 0.725_241, 0.684_225]),
        (Gonthier, [0.876_435, 0.669_581, 0.487_741, 0.304_225]),
        (Flores, [0.893_921, 0.683_184, 0.470_445, 0.256_208]),
        (HuGuo, [0.899_900, 0.697_297, 0.487_741, 0.270_658]),
    ];
    assert_eq!(table.len(), RestitutionModel::ALL.len());
    for (model, row) in table {
        for (e, expected) in [0.9, 0.7, 0.5, 0.3].into_iter().zip(row) {
            let (_, found) = Bounce::new(0.2, remembering(1e8, model, e, 0.0)).restitution(1.0, 0.2);
            assert!((found - expected).abs() < 1e-6, "{model:?} {e}: {found} against {expected}");
        }
    }
}

/// What the sources say of their range: exact to first order near 1 (four models), complete loss at 0 (those
/// with e below the line), fair throughout (Flores).
#[test]
fn models_are_good_where_their_sources_say() {
    use RestitutionModel::{
        Flores, Gonthier, HerbertMcWhannell, HuGuo, HuntCrossley, LankaraniNikravesh, LeeWang,
    };
    let out = |model: RestitutionModel, e: f64| hunt_crossley_restitution(model.factor(e));
    for model in [HuntCrossley, HerbertMcWhannell, LankaraniNikravesh, HuGuo] {
        assert!((out(model, 0.999) - 0.999).abs() < 1e-5, "{model:?}");
    }
    for model in [Gonthier, Flores, HuGuo] {
        assert!(out(model, 1e-3) < 2e-3, "{model:?}");
    }
    for e in [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95] {
        // By 0.045 at most, near e = 0.25.
        assert!((out(Flores, e) - e).abs() < 0.05, "{e}: {}", out(Flores, e));
    }
    // Three quarters of `1 - e` instead of three halves: half of the loss.
    assert!((1.0 - out(LeeWang, 0.999) - 0.5e-3).abs() < 1e-5);
}

/// What a bounce tells: `(m v^2/2) (1 - e^2)` is lost, the impulse is `m v (1 + e)`, and the force of the
/// damper is largest at once if it is heavy.
#[test]
fn records_of_a_bounce_are_those_of_its_speeds() {
    let (mass, speed) = (0.3, 0.7);
    for law in [
        damped(2e4, 10.0, 0.0),
        damped(2e4, 400.0, 0.0),
        hunt_crossley(1e8, 0.5, 0.0),
        remembering(1e8, RestitutionModel::Flores, 0.4, 0.0),
        crate::common::hertz(1e8, 0.0),
    ] {
        let bounce = Bounce::new(mass, law.clone());
        let (_, e) = bounce.restitution(speed, 0.2);
        let start = [-1e-3 * mass.sqrt(), speed * mass.sqrt()];
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.3 };
        let mut exact = integrator(&bounce.system);
        let trace = exact.trace(&stretch, &start, &[]).unwrap();
        let maxima = exact.observe(&[(stretch, &start)]).unwrap();
        let [record] = &trace.contacts[..] else { panic!("{law:?}: {} contacts", trace.contacts.len()) };
        let begin = record.begin.as_ref().unwrap();
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-9 * expected.abs().max(1e-2);
        let lost = 0.5 * mass * speed * speed * (1.0 - e * e);
        assert!(near(record.energy_lost, lost), "{law:?}: {} against {lost}", record.energy_lost);
        assert!(near(record.impulse, mass * speed * (1.0 + e)), "{law:?}: {}", record.impulse);
        assert!(near(begin.time, 1e-3 / speed) && near(begin.velocity.abs(), speed));
        assert!(record.end.unwrap() > begin.time && record.end.unwrap() < 0.3);
        // The largest force of a record is that of its polynomial.
        assert!((record.peak_force / maxima.contact_force - 1.0).abs() < 1e-4, "{law:?}");
        assert!(near(record.energy_lost, maxima.energy_lost) && near(record.impulse, maxima.impulse));
        if law == damped(2e4, 400.0, 0.0) {
            assert!(near(maxima.contact_force, 400.0 * speed), "{}", maxima.contact_force);
        }
    }
    // Cut in the middle of the contact, the pieces add up.
    let bounce = Bounce::new(mass, damped(2e4, 10.0, 0.0));
    let mut exact = integrator(&bounce.system);
    let start = [0.0, speed * mass.sqrt()];
    let piece = |start: f64, end: f64| Stretch { frequency_hz: 1.0, start, end };
    let lost = |trace: &Trace| trace.contacts.iter().map(|contact| contact.energy_lost).sum::<f64>();
    let whole = lost(&exact.trace(&piece(0.0, 0.1), &start, &[]).unwrap());
    let first = exact.trace(&piece(0.0, 5e-3), &start, &[]).unwrap();
    let begin = first.contacts[0].begin.as_ref().map(|begin| begin.time);
    assert_eq!((begin, first.contacts[0].end), (Some(0.0), None));
    let second = exact.trace(&piece(5e-3, 0.1), &first.state, &[]).unwrap();
    assert_eq!(second.contacts[0].begin, None);
    assert!((lost(&first) + lost(&second) - whole).abs() < 1e-10 * whole);
}
