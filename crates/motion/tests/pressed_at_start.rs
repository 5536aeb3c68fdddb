//! Stretches that begin in a contact with a damper whose pressure soon ends: a load that is largest, or
//! zero, as they begin, so that either the velocity or the displacement by the frequency begins at zero.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::{FRAC_PI_2, PI};

use faer::Mat;
use hammerbeam_motion::{Law, Load, Stretch, System, law::LinearStop};

use crate::common::{differences::assert_sensitivities, element, force, model};

/// One mass of 1 kg on 1 N/m with a stop of 10 N/m and 0.1 N s/m at 0.1 m, shaken with 0.16 N.
fn oscillator(load_phase: f64) -> System {
    let stop = LinearStop::with_gap(10.0, 0.1).unwrap().with_damping(0.1).unwrap();
    let load = Load { forces: vec![force(&[1.0], 1, 0.16, load_phase)], ..Load::default() };
    System::new(model(&[1.0], Mat::zeros(1, 1)), &load, vec![element(&[1.0], 0.0, Law::Linear(stop))])
        .unwrap()
}

#[test]
fn the_column_by_the_frequency_is_followed_from_where_its_velocity_or_displacement_is_zero() {
    for load_phase in [0.0, FRAC_PI_2, PI, 4.0] {
        let system = oscillator(load_phase);
        // Pressure ends after 0.019, 0.018 and 0.006 s.
        for state in [[0.10021553, -0.0080954], [0.1191328, -0.6843163], [0.1117585, -0.7530325]] {
            for end in [1.0 / 64.0, 0.25, 1.0] {
                let stretch = Stretch { frequency_hz: 0.130942, start: 0.0, end };
                assert_sensitivities(&system, &stretch, &state, &[], 1e-7);
            }
        }
    }
}
