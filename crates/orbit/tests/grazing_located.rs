//! Where a contact begins to open for an instant: a grazing that is located while the contact presses,
//! against a closed form that knows no scale.
//!
//! `x'' + c x' + x + max(x, 0) = F cos W t`: the motion is proportional to F, and the grazing lies at the
//! same frequency for all F. With one contact a period, that begins at the time `t_1` with the velocity v and
//! lasts s,
//!
//! `x(t_1 + s) = 0`, `x(t_1 + T) = 0`, `x'(t_1 + T) = v`, `x(t_2) = x'(t_2) = 0`
//!
//! with `t_2` in the contact determine `t_1, v, s, t_2` and the frequency. Newton's method with differences,
//! in a program of its own, gives 0.062104177790375 Hz.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{oscillator, step_of, whole, with};
use hammerbeam_motion::{Law, law::LinearStop};
use hammerbeam_orbit::{EventStatus, find_start};

const GRAZING_HZ: f64 = 0.062_104_177_790_375;

#[test]
fn a_grazing_within_a_contact_lies_within_its_uncertainty_whatever_the_force() {
    for force in [1.1, 0.3, 3.0, 12.5] {
        let stop = Law::Linear(LinearStop::with_gap(1.0, 0.0).unwrap());
        let subject = oscillator(1.0, 0.1, force, stop);
        let settings = step_of(0.001);
        let start = find_start(&subject.0, &subject.1, 0.0619, 1, &settings).unwrap();
        let rows = whole(&subject, &start, (0.0615, 0.0623), &settings);
        let grazings = with(&rows, |events| events.grazing);
        let [row] = grazings.as_slice() else { panic!("one grazing, not {}", grazings.len()) };
        let (found, event) = (row.solution.frequency_hz, row.located.as_ref().unwrap());
        let error = (found - GRAZING_HZ).abs();
        assert!(error <= event.uncertainty, "{force} N: {error:e}, within {:e}", event.uncertainty);
        assert!(event.uncertainty < 1e-10, "{force} N: {:e} is absurdly wide", event.uncertainty);
        assert_eq!(event.status, EventStatus::Located);
    }
}
