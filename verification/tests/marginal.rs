//! Solutions whose multipliers stay on the unit circle, in closed form: without damping nothing is
//! stable, nothing happens where multipliers only pass one another on the circle, and what truly happens
//! beside an undamped mode is found.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{ObservedSystem, Walked, element_at, force_at, masses, response_of, walk, walk_both};
use hammerbeam_motion::{
    Law, Load, System,
    law::{LinearStop, RigidStop},
};
use hammerbeam_orbit::{OrbitMaxima, OrbitSettings, PeriodicSolution, Side, Stability};
use hammerbeam_structure::{GROUND, ReducedModel};

fn rig(model: ReducedModel, (at, law): (&str, Law), force: f64) -> ObservedSystem {
    let forces = vec![force_at(&model, "mass", 1, force)];
    let (element, response) = (element_at(&model, at, law), response_of(&model, "mass"));
    let load = Load { support: vec![], forces };
    ObservedSystem { system: System::new(model, &load, vec![element]).unwrap(), response }
}

fn settings(range_hz: (f64, f64)) -> OrbitSettings {
    OrbitSettings { max_step: (range_hz.1 - range_hz.0) / 200.0, ..OrbitSettings::default() }
}

/// Two masses of 1 kg, `k = 1` to the ground and `0.7 N/m` between: `w^2 = (2.4 -+ sqrt(2.96))/2`. Over
/// 0.10 to 0.21 Hz the lower pair of `exp(+-i w T)` passes -1 (at 0.1855 Hz), the upper one -1 (at
/// 0.1523 Hz), and both pass one another.
#[test]
fn multipliers_of_a_linear_undamped_system_are_marginal_and_make_no_events() {
    let springs = [("mass", GROUND, 1.0), ("mass", "second", 0.7)];
    let model = masses(&[("mass", 1.0), ("second", 1.0)], &springs, &[], false);
    let far = Law::Linear(LinearStop::with_gap(1.0, 1e3).unwrap());
    let rig = rig(model, ("second", far), 0.1);
    let range_hz = (0.10, 0.21);
    let Walked { rows, .. } = walk_both(&rig, 0.13, range_hz, &settings(range_hz));
    assert_eq!((rows[0].solution.frequency_hz, rows.last().unwrap().solution.frequency_hz), range_hz);
    let rates = [-1.0, 1.0].map(|sign: f64| (0.5 * (2.4 + sign * 2.96_f64.sqrt())).sqrt());
    for row in &rows {
        let solution = &row.solution;
        let frequency_hz = solution.frequency_hz;
        assert_eq!(solution.stability(), Stability::Marginal, "{frequency_hz}");
        assert_eq!(solution.on_circle, [true; 4], "{frequency_hz}");
        let events = row.events;
        assert!(!(events.fold || events.flip || events.neimark_sacker || events.branch_point), "{events:?}");
        for rate in rates {
            let angle = rate / frequency_hz;
            for expected in [[angle.cos(), angle.sin()], [angle.cos(), -angle.sin()]] {
                let off = |[re, im]: &[f64; 2]| (re - expected[0]).hypot(im - expected[1]);
                let nearest = solution.floquet_multipliers.iter().map(off).fold(f64::INFINITY, f64::min);
                // Two that meet are known to the root of the rounding.
                assert!(nearest < 1e-6, "{frequency_hz} Hz: {expected:?}");
            }
        }
    }
}

/// A mass of 1 kg on 1 N/m under `F cos W t` strikes a rigid stop at the gap g once in a period and loses
/// nothing. With `X = F/(1 - W^2)` the motion between impacts at `t = 0` and `T` is
/// `x = X cos W t + B cos(t - T/2)`, `B = (g - X)/cos(T/2)`: it strikes with `v = -B sin(T/2)` while
/// accelerated by `a = F - g`. The impact turns a change `(dx, dv)` into `(-dx, -dv + 2 a/v dx)`, so with
/// `cos T, sin T` of the flight the product of the multipliers is 1 and their sum
/// `-2 cos T + 2 (a/v) sin T`: on the circle up to 2, beyond real.
#[test]
fn multipliers_at_an_undamped_rigid_stop_are_in_closed_form_and_never_stable() {
    const FORCE: f64 = 0.4;
    let model = masses(&[("mass", 1.0)], &[("mass", GROUND, 1.0)], &[], false);
    let stop = Law::Rigid(RigidStop::with_gap(1.0, 1.0).unwrap());
    let rig = rig(model, ("mass", stop), FORCE);
    let motion = |frequency_hz: f64| {
        let (w, period) = (TAU * frequency_hz, 1.0 / frequency_hz);
        let steady = FORCE / (1.0 - w * w);
        (period, steady, (1.0 - steady) / (0.5 * period).cos())
    };
    let start_hz = 0.25;
    let (_, steady, free) = motion(start_hz);
    let start = PeriodicSolution {
        frequency_hz: start_hz,
        period_multiple: 1,
        phase: 0.5,
        nodes: vec![vec![(free - steady) / rig.response.shape[0], 0.0]],
        floquet_multipliers: vec![],
        on_circle: vec![],
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    };
    let range_hz = (0.2, 0.3);
    let (mut marginal, mut unstable) = (0, 0);
    for side in [Side::Up, Side::Down] {
        let (rows, reason, _) = walk(&rig, &start, side, range_hz, &settings(range_hz));
        assert!(rows.len() > 50, "{} rows: {reason:?}", rows.len());
        for row in rows.iter().filter(|row| row.solution.maxima.contacts == 1) {
            let solution = &row.solution;
            let (period, _, free) = motion(solution.frequency_hz);
            let speed = -free * (0.5 * period).sin();
            let sum = -2.0 * period.cos() + 2.0 * (FORCE - 1.0) / speed * period.sin();
            let [one, other] = solution.floquet_multipliers[..] else { panic!("two multipliers") };
            assert!(
                (one[0] + other[0] - sum).abs() < 1e-7,
                "{} Hz: {one:?} {other:?} {sum}",
                solution.frequency_hz
            );
            let found = solution.stability();
            if sum.abs() < 2.0 - 1e-6 {
                assert_eq!(found, Stability::Marginal, "{} Hz", solution.frequency_hz);
                marginal += 1;
            } else if sum.abs() > 2.0 + 1e-6 {
                assert_eq!(found, Stability::Unstable, "{} Hz", solution.frequency_hz);
                unstable += 1;
            }
            assert!(!row.events.neimark_sacker, "{} Hz", solution.frequency_hz);
        }
    }
    assert!(marginal > 20, "{marginal} marginal, {unstable} unstable");
}

/// The impact oscillator of the studies, alone and with a second mass beside it that nothing damps,
/// drives or couples, at 0.03 Hz: its pair of multipliers is on the circle all along. Folds and flips
/// stay where they are.
#[test]
fn a_flip_and_a_fold_beside_an_undamped_mode_are_found() {
    let range_hz = (0.15, 0.26);
    let of = |with_mode: bool| {
        let rate = TAU * 0.03;
        let mut all = vec![("mass", 1.0)];
        let mut springs = vec![("mass", GROUND, 1.0)];
        if with_mode {
            all.push(("beside", 1.0));
            springs.push(("beside", GROUND, rate * rate));
        }
        let model = masses(&all, &springs, &[("mass", GROUND, 0.1)], false);
        let stop = Law::Linear(LinearStop::with_gap(10.0, 0.5).unwrap());
        walk_both(&rig(model, ("mass", stop), 0.4), 0.255, range_hz, &settings(range_hz))
    };
    let places = |walked: &Walked| -> Vec<(f64, bool, bool)> {
        let events = walked.rows.iter().filter(|row| row.events.fold || row.events.flip);
        events.map(|row| (row.solution.frequency_hz, row.events.fold, row.events.flip)).collect()
    };
    let (alone, beside) = (of(false), of(true));
    let (expected, found) = (places(&alone), places(&beside));
    assert!(!expected.is_empty(), "the range has events");
    assert_eq!(found.len(), expected.len(), "{found:?}, not {expected:?}");
    for (one, other) in expected.iter().zip(&found) {
        assert!((one.0 - other.0).abs() < 1e-8 && (one.1, one.2) == (other.1, other.2), "{one:?} {other:?}");
    }
    assert!(beside.rows.iter().all(|row| !row.events.neimark_sacker && !row.solution.stable()));
    // The mode makes nothing unstable that is stable alone.
    assert!(alone.rows.iter().any(|row| row.solution.stable()));
    assert!(beside.rows.iter().any(|row| row.solution.stability() == Stability::Marginal));
}
