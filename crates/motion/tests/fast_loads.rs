//! Loads that are hundreds of times as fast as the excitation: their ripple lies on every force and every
//! boundary, and what it does to sensitivities is as large as its acceleration.

use crate::common::{assert_agreement, damped, diagonal, element, force, hertz, model, settled};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
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
