//! Sheets 1e-4 apart are not mistaken for each other, and no stretch is walked twice.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use approx::assert_abs_diff_eq;
use hammerbeam_path::{DenseProblem, PathProblem, PathStop, Settings};

const STEPS: [f64; 3] = [0.05, 0.01, 0.001];

/// `(x − s(λ))² = w² + (λ/10)²·10⁻²`: two sheets `2 w` apart at `λ = 0`, beside each other over a wide range.
fn two_sheets(width: f64) -> impl Fn(f64, f64) -> (f64, f64, f64, u64) + Clone {
    move |x: f64, l: f64| {
        let (s, ds) = ((2.0 * l).sin(), 2.0 * (2.0 * l).cos());
        let (e, gap) = (x - s, width * width + 1e-4 * l * l);
        (e * e - gap, 2.0 * e, -2.0 * e * ds - 2e-4 * l, 0)
    }
}

#[test]
fn neighbouring_sheets_are_kept_apart_at_every_step() {
    for width in [5e-5, 1e-3] {
        for sheet in [-1.0, 1.0] {
            for step in STEPS {
                let place = |l: f64| (2.0 * l).sin() + sheet * (width * width + 1e-4 * l * l).sqrt();
                let branch =
                    up(&mut plane(two_sheets(width)), &[place(-1.0), -1.0], -1.0, 1.0, steps_of(step));
                assert_reached_end(&branch, 1.0);
                assert_eq!(folds(&branch).len(), 0, "a step of {step} jumped between sheets {width} apart");
                for point in &branch.points {
                    assert_abs_diff_eq!(point.point[0], place(point.parameter()), epsilon = 1e-8);
                }
            }
        }
    }
}

/// Two straight sheets that run opposite ways exactly 1e-4 apart and never meet: `(x − λ)² = w²`.
#[test]
fn parallel_sheets_that_never_meet_are_kept_apart() {
    for step in STEPS {
        let parallel = |x: f64, l: f64| {
            let bend = 0.1 * (7.0 * l).sin();
            let e = x - l - bend;
            (e * e - 2.5e-9, 2.0 * e, -2.0 * e * (1.0 + 0.7 * (7.0 * l).cos()), 0)
        };
        let branch = up(&mut plane(parallel), &[5e-5, 0.0], 0.0, 5.0, steps_of(step));
        assert_reached_end(&branch, 5.0);
        assert!(
            branch
                .points
                .iter()
                .all(|p| { p.point[0] - p.parameter() - 0.1 * (7.0 * p.parameter()).sin() > 4e-5 })
        );
    }
}

/// A spiral in three unknowns: `r = r₀ + a φ` in `(x, λ)`, neighbouring turns `2 π a = 1e-4` apart, `φ` and
/// its double as unknowns.
fn spiral() -> impl PathProblem {
    let a = 1e-4 / (2.0 * std::f64::consts::PI);
    // A rise of φ by 2π must look like a near sheet: φ enters the inner product with a small weight.
    DenseProblem::weighted(vec![1.0, 1e-12, 1.0], move |z: &[f64], r: &mut [f64], j: &mut [f64]| {
        let (x, phi, l) = (z[0], z[1], z[2]);
        let radius = 0.5 + a * phi;
        r[0] = x - radius * phi.cos();
        r[1] = l - radius * phi.sin();
        j.copy_from_slice(&[
            1.0,
            radius * phi.sin() - a * phi.cos(),
            0.0,
            0.0,
            -radius * phi.cos() - a * phi.sin(),
            1.0,
        ]);
        0
    })
}

#[test]
fn turns_of_a_spiral_1e_4_apart_are_walked_one_after_the_other() {
    for step in [0.05, 0.01] {
        let settings = Settings { max_points: 4000, ..steps_of(step) };
        let branch = up(&mut spiral(), &[0.5, 0.0, 0.0], -1.0, 1.0, settings);
        assert_eq!(branch.stop, PathStop::Budget);
        assert_monotone(&branch, |z| z[1]);
        let turns = branch.points.last().unwrap().point[1] / (2.0 * std::f64::consts::PI);
        assert!(turns > 3.0, "{turns}");
        assert_eq!(folds(&branch).len(), (2.0 * turns + 0.5).floor() as usize);
    }
}

/// An isola: `(λ − 50)² + 100 (x − 3)² = 1`, of the size of a branch in hertz.
#[test]
fn an_isola_closes_from_any_start() {
    for angle in [0.1_f64, 1.0, 2.0, 4.0, 5.5] {
        let isola = |x: f64, l: f64| {
            ((l - 50.0).powi(2) + 100.0 * (x - 3.0).powi(2) - 1.0, 200.0 * (x - 3.0), 2.0 * (l - 50.0), 0)
        };
        let start = [3.0 + 0.1 * angle.sin(), 50.0 + angle.cos()];
        let branch = up(&mut plane(isola), &start, 19.0, 110.0, steps_of(0.05));
        assert_eq!(branch.stop, PathStop::Closed);
        let mut found = folds(&branch);
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 2);
        assert_abs_diff_eq!(found[0], 49.0, epsilon = 1e-9);
        assert_abs_diff_eq!(found[1], 51.0, epsilon = 1e-9);
        assert_abs_diff_eq!(branch.points.last().unwrap().parameter(), start[1], epsilon = 1e-8);
    }
}

/// A figure eight crosses itself with another tangent: that is a branch point, not a stretch walked twice.
#[test]
fn a_path_that_crosses_itself_is_not_taken_for_a_retrace() {
    let eight = |x: f64, l: f64| (x * x - l * l + l * l * l * l, 2.0 * x, -2.0 * l + 4.0 * l * l * l, 0);
    let l: f64 = 0.6;
    let branch = up(&mut plane(eight), &[(l * l - l.powi(4)).sqrt(), l], -2.0, 2.0, Settings::default());
    assert_eq!(branch.stop, PathStop::Closed);
    assert_eq!(branch.branch_points().count(), 2);
    assert_eq!(folds(&branch).len(), 2);
}

/// A lollipop: the stem `x = 0, λ < 0` runs into the circle `(x − 1)² + λ² = 1` at the origin with the same
/// tangent, as no regular path can. After one round on the circle the follower stands at the junction again.
#[test]
fn a_stretch_that_would_be_walked_again_ends_the_branch() {
    let lollipop = |x: f64, l: f64| {
        let circle = (x - 1.0) * (x - 1.0) + l * l - 1.0;
        if l < 0.0 && x < 1.0 {
            (-x * circle, -circle - x * 2.0 * (x - 1.0), -x * 2.0 * l, 0)
        } else {
            (-circle, -2.0 * (x - 1.0), -2.0 * l, 0)
        }
    };
    let branch =
        up(&mut plane(lollipop), &[0.0, -0.51], -2.0, 2.0, Settings { max_points: 2000, ..steps_of(0.02) });
    let PathStop::RunsBack { parameter, met_arc_length } = branch.stop else { panic!("{:?}", branch.stop) };
    assert_abs_diff_eq!(parameter, 0.0, epsilon = 0.03);
    assert_abs_diff_eq!(met_arc_length, 0.51, epsilon = 0.03);
}

/// `λ = 0.3 sin(π x / s)`: nearly parallel sheets `s` apart, joined by hairpins of radius `s² / 3`.
#[test]
fn a_pleat_of_sheets_is_walked_sheet_by_sheet_at_every_step() {
    for spacing in [1e-2, 1e-3, 1e-4] {
        for step in STEPS {
            let k = std::f64::consts::PI / spacing;
            let pleat =
                move |x: f64, l: f64| ((0.3 * (k * x).sin() - l) / k, 0.3 * (k * x).cos(), -1.0 / k, 0);
            let settings = Settings { max_points: 20_000, ..steps_of(step) };
            for n in [1, 5] {
                let start = mixed_point(n, 0.4, 0.0, 0.0);
                let branch = up(
                    &mut mixed(n, 0.4, pleat),
                    &start,
                    -1.0,
                    1.0,
                    Settings { max_points: if n == 1 { 3000 } else { 1000 }, ..settings.clone() },
                );
                assert_eq!(branch.stop, PathStop::Budget, "spacing {spacing}, step {step}");
                assert_monotone(&branch, |z| unmixed(n, 0.4, z));
                let last = unmixed(n, 0.4, &branch.points.last().unwrap().point);
                println!(
                    "{spacing} {step} {n}: folds {} x {last} evals/pt {}",
                    folds(&branch).len(),
                    evaluations_per_point(&branch)
                );
                // The budget may end the walk on a fold, which is located to rounding.
                let passed = last / spacing + 0.5;
                let on_fold =
                    branch.points.last().unwrap().events.fold && (passed - passed.round()).abs() < 1e-3;
                let expected = if on_fold { passed.round() } else { passed.floor() };
                assert_eq!(folds(&branch).len(), expected as usize);
            }
        }
    }
}
