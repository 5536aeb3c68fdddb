//! Smooth paths in closed form: what is on them, in which order, and at which price.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use approx::assert_abs_diff_eq;
use hammerbeam_path::{PathStop, Settings, follow_both};

fn circle(x: f64, l: f64) -> (f64, f64, f64, u64) {
    (x * x + l * l - 1.0, 2.0 * x, 2.0 * l, 0)
}

/// `λ = x³ − x`: folds at `x = ∓1/√3`, `λ = ±2/(3√3)`.
fn s_curve(x: f64) -> (f64, f64, u64) {
    (x * x * x - x, 3.0 * x * x - 1.0, 0)
}

#[test]
fn circle_closes_with_two_folds() {
    let branch = up(&mut plane(circle), &[0.8, 0.6], -2.0, 2.0, Settings::default());
    assert_eq!(branch.stop, PathStop::Closed);
    let found = folds(&branch);
    assert_eq!(found.len(), 2);
    assert_abs_diff_eq!(found[0], 1.0, epsilon = 1e-10);
    assert_abs_diff_eq!(found[1], -1.0, epsilon = 1e-10);
    let last = branch.points.last().unwrap();
    assert_abs_diff_eq!(last.point[0], 0.8, epsilon = 1e-8);
    assert_abs_diff_eq!(last.arc_length, 2.0 * std::f64::consts::PI, epsilon = 1e-5);
}

#[test]
fn circle_is_cut_exactly_at_both_ends() {
    let branch = follow_both(&mut plane(circle), &[1.0, 0.0], range(-0.3, 0.7), Settings::default()).unwrap();
    assert_eq!((branch.backward, branch.forward), (PathStop::RangeEnd, PathStop::RangeEnd));
    assert_eq!(branch.points[0].parameter(), -0.3);
    assert_eq!(branch.points.last().unwrap().parameter(), 0.7);
    assert_abs_diff_eq!(branch.points[0].point[0], 0.91_f64.sqrt(), epsilon = 1e-9);
    assert_eq!(branch.points[branch.start].parameter(), 0.0);
    assert!(branch.points.windows(2).all(|p| p[1].arc_length > p[0].arc_length));
}

#[test]
fn cubic_has_its_two_folds_where_the_formula_says() {
    let branch = up(&mut graph(s_curve), &[-1.5, -1.875], -1.9, 1.9, Settings::default());
    assert_reached_end(&branch, 1.9);
    let (found, fold) = (folds(&branch), 2.0 / 27.0_f64.sqrt());
    assert_eq!(found.len(), 2);
    assert_abs_diff_eq!(found[0], fold, epsilon = 1e-12);
    assert_abs_diff_eq!(found[1], -fold, epsilon = 1e-12);
    for point in branch.folds() {
        assert!(point.tangent_parameter().abs() <= 1e-6);
        assert_abs_diff_eq!(point.point[0].abs(), 1.0 / 3.0_f64.sqrt(), epsilon = 1e-7);
    }
    assert_monotone(&branch, |z| z[0]);
}

/// `λ = x/20 + sin x`: folds at `cos x = −1/20`, two a period.
#[test]
fn sine_has_all_its_folds_in_order_at_every_step() {
    for step in [0.05, 0.01, 0.001] {
        let sine = |x: f64| (x / 20.0 + x.sin(), 0.05 + x.cos(), 0);
        let branch = up(&mut graph(sine), &[0.0, 0.0], -1.0, 3.0, steps_of(step));
        assert_reached_end(&branch, 3.0);
        let expected: Vec<f64> = (0..100)
            .map(|k| {
                let base = (-0.05_f64).acos();
                if k % 2 == 0 {
                    base + k as f64 * std::f64::consts::PI
                } else {
                    -base + (k + 1) as f64 * std::f64::consts::PI
                }
            })
            .map(|x| x / 20.0 + x.sin())
            .take_while(|l| *l < 3.0)
            .collect();
        let found = folds(&branch);
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(&expected) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-10);
        }
        assert_monotone(&branch, |z| z[0]);
    }
}

#[test]
fn start_is_corrected_at_its_parameter() {
    let branch = up(&mut plane(circle), &[0.9, 0.6], 0.0, 0.65, Settings::default());
    assert_eq!(branch.points[0].parameter(), 0.6);
    assert_abs_diff_eq!(branch.points[0].point[0], 0.8, epsilon = 1e-10);
}

#[test]
fn arc_length_of_the_circle_is_its_angle() {
    let branch = up(&mut plane(circle), &[1.0, 0.0], -2.0, 0.5, Settings::default());
    for point in &branch.points {
        let mut angle = point.point[1].atan2(point.point[0]);
        if angle < -1e-9 {
            angle += 2.0 * std::f64::consts::PI;
        }
        assert_abs_diff_eq!(point.arc_length, angle, epsilon = 1e-5);
    }
}
