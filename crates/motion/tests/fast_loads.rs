//! Loads that are hundreds of times as fast as the excitation: their ripple lies on every force and every
//! boundary, and what it does to sensitivities is as large as its acceleration.

use std::f64::consts::TAU;

use crate::common::{assert_agreement, cubic, damped, diagonal, element, force, hertz, model, settled};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, Maxima},
    general::{GeneralSettings, Observed, observe},
    law::{LinearStop, TwoSidedStop},
};

/// Two masses of `m` and `m/2` on springs of 1000 and 800 N/m for each kilogramme of m, a stop at the second;
/// modes in closed form.
fn two_masses(order: u32, (m, law): (f64, Law)) -> System {
    let (a, b, c) = (1800.0, 1600.0, -800.0 * 2.0_f64.sqrt());
    let (middle, half) = (f64::midpoint(a, b), f64::hypot((a - b) / 2.0, c));
    let squares = [middle - half, middle + half];
    let shape = |square: f64| {
        let (x, y) = (c, square - a);
        let norm = f64::hypot(x, y);
        [x / norm / m.sqrt(), y / norm * (2.0 / m).sqrt()]
    };
    let frequencies = squares.map(f64::sqrt);
    let shapes = squares.map(shape);
    let [first, second] = [[shapes[0][0], shapes[1][0]], [shapes[0][1], shapes[1][1]]];
    let model = model(&frequencies, diagonal(&frequencies.map(|frequency| 0.06 * frequency)));
    let forces = vec![force(&first, 1, 10.0 * m, 0.0), force(&first, order, m, 0.3)];
    System::new(model, &Load { support: vec![], forces }, vec![element(&second, 0.0, law)]).unwrap()
}

#[test]
fn sensitivities_agree_under_a_load_of_order_300() {
    let laws = |m: f64| {
        [
            Law::Linear(LinearStop::with_gap(5e4 * m, 0.01).unwrap()),
            hertz(5e5 * m, 0.01),
            damped(5e4 * m, 20.0 * m, 0.01),
            Law::TwoSided(TwoSidedStop::new(5e4 * m, 0.01, 0.02).unwrap()),
        ]
    };
    for (order, m, count) in [(40, 1.0, 1), (300, 1.0, 4), (300, 1e4, 2), (300, 1e-3, 2)] {
        for law in &laws(m)[..count] {
            let system = two_masses(order, (m, law.clone()));
            for frequency_hz in [2.898_802_636_591_897_3, 3.3, 4.1] {
                let state = settled(&system, frequency_hz, 60, 0.0);
                let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
                let what = format!("{law:?}, order {order}, {frequency_hz} Hz");
                assert!(assert_agreement(&system, &stretch, &state, 1e-9, &what) > 0);
            }
        }
    }
}

/// Maxima of one mode over a period: those of the exact integrator, and those of the general one.
fn maxima_of_both(system: System, frequency_hz: f64, state: &[f64]) -> (Maxima, Observed) {
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    let response: (&[f64], &[f64]) = (&[1.0], &[0.0]);
    let settings = GeneralSettings::with_tolerance(1e-12);
    let expected = observe(&system, &stretch, state, response, &settings).unwrap();
    let mut exact = ExactIntegrator::watching(system, ExactSettings::default(), Some(response)).unwrap();
    (exact.observe(&[(stretch, state)]).unwrap(), expected)
}

/// A soft contact lasts for dozens of waves of the load, whose parts of the acceleration are as large as that
/// of the contact: the largest of hundreds of tops is one that the general integrator finds, too.
#[test]
fn the_largest_acceleration_is_the_highest_of_all_waves_of_a_load() {
    let laws = [
        Law::Linear(LinearStop::with_gap(20.0, 0.5).unwrap()),
        hertz(20.0, 0.5),
        damped(20.0, 0.2, 0.5),
        cubic(1.0),
    ];
    for (order, frequencies) in [(40, 4), (300, 3), (1000, 2)] {
        for law in &laws {
            for frequency_hz in [0.151_386, 0.113, 0.187, 0.131].into_iter().take(frequencies) {
                let forces = vec![force(&[1.0], 1, 1.0, 0.0), force(&[1.0], order, 1.0, 0.0)];
                let damping = diagonal(&[0.1]);
                let load = Load { support: vec![], forces };
                let stop = element(&[1.0], 0.0, law.clone());
                let system = System::new(model(&[1.0], damping), &load, vec![stop]).unwrap();
                let state = settled(&system, frequency_hz, 20, 0.0);
                let (found, expected) = maxima_of_both(system, frequency_hz, &state);
                let what = format!("{law:?}, order {order}, {frequency_hz} Hz");
                for (found, expected) in [
                    (found.acceleration, expected.acceleration),
                    (found.displacement, expected.displacement),
                    (found.contact_force, expected.contact_force),
                ] {
                    assert!((found - expected).abs() <= 1e-8 * expected, "{what}: {found} {expected}");
                }
            }
        }
    }
}

/// A weak spring acts all the time, in steps of more than half a period. Beside a constant load it makes the
/// top on one side higher by some 1e-6 than that on the other: the higher one is found wherever it lies in a
/// step.
#[test]
fn of_two_tops_that_are_nearly_equal_the_higher_one_is_found() {
    let frequency_hz = 0.249;
    for phase in (0..40).map(|k| TAU * f64::from(k) / 40.0) {
        let forces = vec![force(&[1.0], 1, 1.0, phase), force(&[1.0], 0, 0.5, 0.0)];
        let load = Load { support: vec![], forces };
        let spring = element(&[1.0], 0.0, cubic(1e-6));
        let system = System::new(model(&[1.0], diagonal(&[0.2])), &load, vec![spring]).unwrap();
        let state = settled(&system, frequency_hz, 60, 0.0);
        let (found, expected) = maxima_of_both(system, frequency_hz, &state);
        let (found, expected) = (found.acceleration, expected.acceleration);
        assert!((found - expected).abs() <= 1e-9 * expected, "{phase}: {found} {expected}");
    }
}
