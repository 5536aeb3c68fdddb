//! Simple branch points are recognised, recorded, and walked through.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use approx::assert_abs_diff_eq;
use hammerbeam_path::{Branch, PathStop, Settings, StartDirection, follow};

/// `λ x − x³ = 0`: the stem `x = 0` and the arms `λ = x²`.
fn pitchfork(x: f64, l: f64) -> (f64, f64, f64, u64) {
    (l * x - x * x * x, l - 3.0 * x * x, x, 0)
}

/// `x (λ − x) = 0`: `x = 0` and `x = λ`.
fn transcritical(x: f64, l: f64) -> (f64, f64, f64, u64) {
    (l * x - x * x, l - 2.0 * x, x, 0)
}

fn assert_one_branch_point_at_origin(branch: &Branch) {
    let found: Vec<_> = branch.branch_points().collect();
    assert_eq!(found.len(), 1);
    assert!(found[0].point.iter().all(|z| z.abs() < 1e-6), "{:?}", found[0]);
}

#[test]
fn stem_of_a_pitchfork_is_walked_through_both_ways() {
    for (start, direction) in [(-0.537, StartDirection::Increasing), (0.611, StartDirection::Decreasing)] {
        let branch =
            follow(&mut plane(pitchfork), &[0.0, start], direction, range(-1.0, 1.0), Settings::default())
                .unwrap();
        assert_reached_end(&branch, if start < 0.0 { 1.0 } else { -1.0 });
        assert_one_branch_point_at_origin(&branch);
        assert_eq!(folds(&branch).len(), 0);
        assert!(branch.points.iter().all(|point| point.point[0].abs() < 1e-8));
    }
}

#[test]
fn arms_of_a_pitchfork_are_one_branch_through_the_branch_point() {
    for step in [0.05, 0.01, 0.001] {
        let branch = down(&mut plane(pitchfork), &[0.8, 0.64], -1.0, 0.9, steps_of(step));
        assert_reached_end(&branch, 0.9);
        assert_one_branch_point_at_origin(&branch);
        assert_monotone(&branch, |z| -z[0]);
        let folds: Vec<_> = branch.folds().collect();
        assert_eq!(folds.len(), 1, "the parameter turns where the arms meet");
        assert!(folds[0].events.branch_point);
    }
}

#[test]
fn both_branches_of_a_transcritical_point_go_straight_on() {
    for slope in [0.0, 1.0] {
        let branch = up(&mut plane(transcritical), &[-0.77 * slope, -0.77], -1.0, 1.0, Settings::default());
        assert_reached_end(&branch, 1.0);
        assert_one_branch_point_at_origin(&branch);
        let last = branch.points.last().unwrap();
        assert_abs_diff_eq!(last.point[0], slope, epsilon = 1e-9);
    }
}

#[test]
fn orientation_is_anchored_anew_at_a_branch_point() {
    let branch = up(&mut plane(transcritical), &[0.0, -0.77], -1.0, 1.0, Settings::default());
    let at = branch.points.iter().position(|point| point.events.branch_point).unwrap();
    let signs: Vec<f64> = branch.points.iter().map(|point| point.orientation).collect();
    assert!(signs[..at].iter().all(|sign| *sign == signs[0]));
    assert!(signs[at..].iter().all(|sign| *sign == -signs[0]));
}

#[test]
fn branch_points_are_found_in_mixed_coordinates() {
    for seed in [0.0, 1.0, 2.0] {
        let start = mixed_point(12, seed, 0.8, 0.64);
        let branch = down(&mut mixed(12, seed, pitchfork), &start, -1.0, 0.9, Settings::default());
        assert_reached_end(&branch, 0.9);
        assert_eq!(branch.branch_points().count(), 1);
        assert_monotone(&branch, |z| -unmixed(12, seed, z));
    }
}

/// A period-doubled orbit reaches its flip as `x` reaches zero, and leaves as its own copy, half a period
/// later: `x (x² − (λ − λ²))`, the loop `x² = λ − λ²` between the flips at `λ = 0` and `1`.
#[test]
fn a_branch_between_two_flips_closes_through_both_of_them() {
    let bubble = |x: f64, l: f64| {
        let arc = l - l * l;
        (x * (x * x - arc), 3.0 * x * x - arc, x * (2.0 * l - 1.0), 0)
    };
    let branch = up(&mut plane(bubble), &[0.45, 0.28], -1.0, 2.0, Settings::default());
    assert_eq!(branch.stop, PathStop::Closed);
    assert_eq!(branch.branch_points().count(), 2);
    assert_eq!(folds(&branch).len(), 2);
}

/// `x (x² − λ) = 10⁻⁶`: no branch point, but two branches that avoid each other closely.
#[test]
fn an_unfolded_pitchfork_has_a_turn_instead_of_a_branch_point() {
    for size in [1e-4, 1e-6, 1e-9] {
        let unfolded = move |x: f64, l: f64| {
            let (f, dx, dl, s) = pitchfork(x, l);
            (f + size, dx, dl, s)
        };
        let branch = down(&mut plane(unfolded), &[0.8 + 0.78 * size, 0.64], -1.0, 0.9, Settings::default());
        assert_reached_end(&branch, -1.0);
        assert_eq!(branch.branch_points().count(), 0);
        assert_eq!(folds(&branch).len(), 0);
    }
}
