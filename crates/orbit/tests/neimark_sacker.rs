//! Neimark-Sacker points of the paper's beam on its harmonic branch: the pair has modulus one, and motion
//! beside them does what it says.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{
    beam,
    events::{apart, assert_same, general_advance, general_multipliers, sorted, step_of, whole, with},
};
use hammerbeam_orbit::{BranchRow, EventStatus, OrbitSettings, PeriodicSolution, find_start};

const RANGE: (f64, f64) = (23.3, 40.0);

fn rows(settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = beam();
    let start = find_start(&subject.0, &subject.1, 30.0, 1, settings).unwrap();
    whole(&subject, &start, RANGE, settings)
}

/// The modulus of the pair nearest to the unit circle.
fn modulus(multipliers: &[[f64; 2]]) -> f64 {
    let pairs = multipliers.iter().filter(|[_, im]| *im != 0.0).map(|[re, im]| re.hypot(*im));
    pairs.min_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())).unwrap()
}

#[test]
fn the_pair_has_modulus_one_by_the_variational_equations_too() {
    let (system, _) = beam();
    let rows = rows(&step_of(0.02));
    let points = with(&rows, |events| events.neimark_sacker);
    assert!(points.len() >= 2, "{:?}", sorted(&points));
    for point in points {
        assert_eq!(point.located.as_ref().unwrap().status, EventStatus::Located);
        let found = modulus(&general_multipliers(&system, &point.solution));
        assert!((found - 1.0).abs() < 1e-6, "{found} at {} Hz", point.solution.frequency_hz);
    }
}

#[test]
fn neimark_sacker_points_do_not_depend_on_step_or_segments() {
    let frequencies =
        |settings: &OrbitSettings| sorted(&with(&rows(settings), |events| events.neimark_sacker));
    let expected = frequencies(&step_of(0.02));
    for (step, segments) in [(0.05, 1), (0.02, 4)] {
        let settings = OrbitSettings { max_step: step, ..crate::common::with_segments(segments) };
        assert_same(&frequencies(&settings), &expected, 1e-8, "steps and segments");
    }
}

/// Distance of the motion from an orbit after some periods, relative to the distance at the start.
fn factor(orbit: &PeriodicSolution, periods: u32) -> f64 {
    let (system, _) = beam();
    let beside: Vec<f64> = orbit.nodes[0].iter().map(|z| z * (1.0 + 1e-6)).collect();
    let after = |state: &[f64], periods| general_advance(&system, orbit.frequency_hz, state, periods);
    // The damped modes are gone after some periods.
    let started = after(&beside, 40);
    let ended = after(&started, periods);
    apart(&system, &orbit.nodes[0], &ended) / apart(&system, &orbit.nodes[0], &started)
}

/// On the side where the pair lies inside, a small disturbance dies away; on the other it grows. Nothing but
/// simulation.
#[test]
fn motion_settles_on_one_side_only() {
    let rows = rows(&step_of(0.02));
    let places = (1..rows.len() - 1).filter(|&k| rows[k].events.neimark_sacker);
    let mut seen = 0;
    for place in places {
        let leading = |orbit: &PeriodicSolution| modulus(&orbit.floquet_multipliers);
        let others = |orbit: &PeriodicSolution| {
            orbit.floquet_multipliers.iter().filter(|[_, im]| *im == 0.0).all(|[re, _]| re.abs() < 0.9)
        };
        let near = |range: &mut dyn Iterator<Item = usize>, inside: bool| {
            let fits = |orbit: &PeriodicSolution| {
                let size = leading(orbit);
                let right = if inside { (0.9..0.985).contains(&size) } else { (1.015..1.1).contains(&size) };
                right && others(orbit) && orbit.stable() == inside
            };
            range.map(|k| rows[k].solution.clone()).find(fits)
        };
        let [before, after] = [true, false].map(|inside| {
            let back = near(&mut (place.saturating_sub(40)..place).rev(), inside);
            (back, near(&mut (place + 1..(place + 40).min(rows.len())), inside))
        });
        let (Some(stable), Some(unstable)) = (before.0.or(before.1), after.0.or(after.1)) else { continue };
        let (dies, grows) = (factor(&stable, 120), factor(&unstable, 120));
        assert!(dies < 0.4 && grows > 2.5, "{dies:.2e}, {grows:.2e} at {} Hz", stable.frequency_hz);
        seen += 1;
        if seen == 2 {
            break;
        }
    }
    assert!(seen > 0, "no point at which the pair alone decides");
}
