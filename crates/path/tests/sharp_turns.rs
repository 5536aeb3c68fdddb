//! Folds as sharp as grazing makes them: turns within 1e-6 to 1e-8 of the parameter, corners, one-sided
//! powers.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use approx::assert_abs_diff_eq;
use hammerbeam_path::{DenseProblem, MOST_SHORT_STEPS, PathStop, Settings, follow_both};

const STEPS: [f64; 3] = [0.05, 0.01, 0.001];

#[test]
fn a_hairpin_of_any_radius_is_rounded_once() {
    for radius in [1e-2, 1e-4, 1e-6, 1e-7, 1e-8] {
        for step in STEPS {
            let hairpin = move |x: f64| {
                let root = x.hypot(radius);
                (-root, -x / root, 0)
            };
            let start = [-0.5, -0.5_f64.hypot(radius)];
            let branch = up(&mut graph(hairpin), &start, -0.6, 1.0, steps_of(step));
            assert_reached_end(&branch, -0.6);
            assert_eq!(folds(&branch).len(), 1, "radius {radius}, step {step}");
            assert_abs_diff_eq!(folds(&branch)[0], -radius, epsilon = 1e-10);
            assert_monotone(&branch, |z| z[0]);
        }
    }
}

/// The sheets of `λ = −√(x² + r²) / slope` close in on each other: at slope 0.05 they leave the fold 6
/// degrees apart.
#[test]
fn a_narrow_hairpin_is_rounded_without_jumping_to_its_other_sheet() {
    for slope in [0.05, 0.3, 3.0] {
        for radius in [0.0, 1e-8, 1e-5] {
            let hairpin = move |x: f64| {
                let root = x.hypot(radius);
                let sign = if radius == 0.0 { x.signum() } else { x / root };
                (-root / slope, -sign / slope, u64::from(radius == 0.0 && x > 0.0))
            };
            let far = 0.9 * slope;
            let start = [-far, -far.hypot(radius) / slope];
            let branch = up(&mut graph(hairpin), &start, -1.0, 1.0, steps_of(0.01));
            assert_reached_end(&branch, -1.0);
            assert_eq!(folds(&branch).len(), 1, "slope {slope}, radius {radius}");
            assert_abs_diff_eq!(folds(&branch)[0], -radius / slope, epsilon = 1e-9);
            assert_monotone(&branch, |z| z[0]);
        }
    }
}

#[test]
fn a_corner_is_turned_with_and_without_a_signature() {
    for marked in [false, true] {
        for (left, right) in [(1.0, -1.0), (1.0, -0.1), (0.2, -5.0), (1.0, 10.0), (3.0, 0.2)] {
            let corner = move |x: f64| {
                let slope = if x < 0.0 { left } else { right };
                (slope * x, slope, u64::from(marked && x >= 0.0))
            };
            let branch = up(&mut graph(corner), &[-0.5 / left, -0.5], -0.7, 0.6, steps_of(0.01));
            assert_reached_end(&branch, if right > 0.0 { 0.6 } else { -0.7 });
            let turns = if right > 0.0 { vec![] } else { vec![0.0] };
            assert_eq!(folds(&branch).len(), turns.len(), "{left} {right}");
            for fold in folds(&branch) {
                assert_abs_diff_eq!(fold, 0.0, epsilon = 1e-10);
            }
            assert_monotone(&branch, |z| z[0]);
        }
    }
}

/// Hertz contact: `λ = x − c p^1.5` with `p = max(x, 0)`: a fold at `p = (1.5 c)^-2` behind the first touch.
#[test]
fn folds_behind_a_touch_with_power_one_and_a_half_are_found_at_every_step() {
    for c in [2.0, 20.0, 200.0, 2000.0] {
        for step in STEPS {
            let hertz = move |x: f64| {
                let p = x.max(0.0);
                (x - c * p.powf(1.5), 1.0 - 1.5 * c * p.sqrt(), u64::from(x > 0.0))
            };
            let branch = up(&mut graph(hertz), &[-0.5, -0.5], -0.6, 1.0, steps_of(step));
            assert_reached_end(&branch, -0.6);
            let p = (1.5 * c).powi(-2);
            assert_eq!(folds(&branch).len(), 1);
            assert_abs_diff_eq!(folds(&branch)[0], p / 3.0, epsilon = 1e-10);
            assert_monotone(&branch, |z| z[0]);
            assert_eq!(branch.points.iter().filter(|point| point.events.signature_change).count(), 1);
        }
    }
}

/// `λ = −c x|x| + x`: the curvature jumps at the touch, with folds on both sides or on one.
#[test]
fn folds_beside_a_jump_of_curvature_are_found_at_every_step() {
    for c in [1.0, 1e3, 1e6] {
        for step in STEPS {
            let curve = move |x: f64| (x - c * x * x.abs(), 1.0 - 2.0 * c * x.abs(), u64::from(x > 0.0));
            let far = 0.5 / c + (0.25 / (c * c) + 0.6 / c).sqrt();
            let branch = down(&mut graph(curve), &[-far, 0.6], -0.7, 0.7, steps_of(step));
            assert_reached_end(&branch, -0.7);
            let found = folds(&branch);
            assert_eq!(found.len(), 2, "c {c}, step {step}");
            assert_abs_diff_eq!(found[0], -0.25 / c, epsilon = 1e-10);
            assert_abs_diff_eq!(found[1], 0.25 / c, epsilon = 1e-10);
            assert_monotone(&branch, |z| z[0]);
        }
    }
}

/// Beside the touch at `x = 0.1 k` hides `λ = x − 2 w (G(p/w))`, `G(u) = 3 u^1.5 e^-u`: a pair of folds
/// within about `w` of the touch, on its left or on its right.
fn hidden_pairs(x: f64, width: f64, side: f64) -> (f64, f64, u64) {
    let (mut value, mut slope, mut touches) = (x, 1.0, 0);
    for k in 0..5 {
        let touch = 0.1 * k as f64 + 0.05;
        let u = side * (x - touch) / width;
        touches += u64::from(x > touch);
        if u > 0.0 {
            let e = (-u).exp();
            value -= side * 3.0 * width * u.powf(1.5) * e;
            slope -= 3.0 * (1.5 * u.sqrt() - u.powf(1.5)) * e;
        }
    }
    (value, slope, touches)
}

#[test]
fn pairs_of_folds_hidden_at_a_change_of_signature_do_not_depend_on_the_step() {
    for width in [1e-5, 1e-4] {
        for side in [-1.0, 1.0] {
            let mut lists = Vec::new();
            for step in STEPS {
                let curve = move |x: f64| hidden_pairs(x, width, side);
                let branch = up(&mut graph(curve), &[0.0, 0.0], -0.5, 0.5, steps_of(step));
                assert_reached_end(&branch, 0.5);
                assert_monotone(&branch, |z| z[0]);
                lists.push(folds(&branch));
            }
            assert_eq!(lists[0].len(), 10, "width {width}, side {side}");
            for list in &lists[1..] {
                assert_eq!(list.len(), 10, "width {width}, side {side}");
                for (a, b) in list.iter().zip(&lists[0]) {
                    assert_abs_diff_eq!(a, b, epsilon = 1e-10);
                }
            }
        }
    }
}

#[test]
fn hidden_pairs_are_found_in_mixed_coordinates_and_backwards() {
    for seed in [0.0, 0.7] {
        let f = |x: f64, l: f64| {
            let (value, slope, signature) = hidden_pairs(x, 1e-5, 1.0);
            (value - l, slope, -1.0, signature)
        };
        let mut problem = mixed(6, seed, f);
        let start = mixed_point(6, seed, 0.2, 0.2);
        let both = follow_both(&mut problem, &start, range(0.0, 0.5), steps_of(0.05)).unwrap();
        assert_eq!(both.points[0].parameter(), 0.0);
        assert_eq!(both.points.last().unwrap().parameter(), 0.5);
        assert_eq!(both.points.iter().filter(|point| point.events.fold).count(), 10);
    }
}

#[test]
fn a_sharp_fold_costs_a_bounded_number_of_evaluations() {
    let hairpin = |x: f64| (-x.hypot(1e-8), -x / x.hypot(1e-8), 0);
    let branch = up(&mut graph(hairpin), &[-0.05, -0.05], -0.06, 1.0, Settings::default());
    assert!(branch.counters.evaluations < 600, "{:?}", branch.counters);
}

/// A stiff stop: `λ = x − c (√(p + δ) − √δ)`, whose slope jumps to `1 − c / (2 √δ)` at the touch. The
/// parameter turns at the touch itself, at `λ = 0`, and again at `p = c²/4 − δ`.
#[test]
fn a_fold_at_a_touch_with_a_steep_far_side_is_passed() {
    for c in [0.01, 0.1, 0.5] {
        for delta in [1e-4, 1e-6, 1e-8] {
            for step in STEPS {
                let stiff = move |x: f64, l: f64| {
                    let p = x.max(0.0);
                    let root = (p + delta).sqrt();
                    let slope = if x > 0.0 { 1.0 - 0.5 * c / root } else { 1.0 };
                    (x - c * (root - delta.sqrt()) - l, slope, -1.0, u64::from(x > 0.0))
                };
                let branch = up(&mut plane(stiff), &[-0.5, -0.5], -0.6, 1.0, steps_of(step));
                assert_reached_end(&branch, 1.0);
                let turn = c * c / 4.0 - delta;
                assert_monotone(&branch, |z| z[0]);
                if turn <= 0.0 {
                    assert_eq!(folds(&branch).len(), 0, "c {c}, delta {delta}, step {step}");
                    continue;
                }
                assert_eq!(folds(&branch).len(), 2, "c {c}, delta {delta}, step {step}");
                assert_abs_diff_eq!(folds(&branch)[0], 0.0, epsilon = 1e-9);
                assert_abs_diff_eq!(folds(&branch)[1], turn - c * (0.5 * c - delta.sqrt()), epsilon = 1e-9);
            }
        }
    }
}

/// Parameter in hertz, unknowns in units a thousand times smaller, scaled by the weights.
#[test]
fn weights_scale_the_problem() {
    for step in STEPS {
        let (size, width) = (1e-3, 1e-5);
        let mut problem = DenseProblem::weighted(
            vec![1.0 / (size * size), 1.0],
            move |z: &[f64], r: &mut [f64], j: &mut [f64]| {
                let (value, slope, signature) = hidden_pairs(z[0] / size - 90.0, width, 1.0);
                r[0] = value + 90.0 - z[1];
                j.copy_from_slice(&[slope / size, -1.0]);
                signature
            },
        );
        let branch = up(&mut problem, &[90.0 * size, 90.0], 80.0, 90.5, steps_of(step));
        assert_reached_end(&branch, 90.5);
        assert_eq!(folds(&branch).len(), 10);
        assert_monotone(&branch, |z| z[0]);
    }
}

#[test]
fn hidden_pairs_are_found_through_noise() {
    for step in STEPS {
        let noisy = |x: f64, l: f64| {
            let (value, slope, signature) = hidden_pairs(x, 1e-5, 1.0);
            let bits = (x.to_bits() ^ l.to_bits().rotate_left(17)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            (value - l + 1e-12 * (bits >> 40) as f64 / f64::from(1 << 24), slope, -1.0, signature)
        };
        let branch = up(&mut plane(noisy), &[0.0, 0.0], -0.5, 0.5, steps_of(step));
        assert_reached_end(&branch, 0.5);
        assert_eq!(folds(&branch).len(), 10);
    }
}

/// A path that turns by a right angle every few hundredths of a millionth is followed, but without progress:
/// that is reported instead of going on for ever.
#[test]
fn a_path_without_progress_is_left() {
    let wriggle = |x: f64, l: f64| (x - 1e-8 * (1e8 * l).sin(), 1.0, -(1e8 * l).cos(), 0);
    let settings = Settings { short_step: 1e-7, ..steps_of(0.01) };
    let branch = up(&mut mixed(3, 0.3, wriggle), &mixed_point(3, 0.3, 0.0, 0.0), -1.0, 1.0, settings);
    let PathStop::NoProgress { parameter, steps } = branch.stop else { panic!("{:?}", branch.stop) };
    assert_eq!(steps, MOST_SHORT_STEPS);
    assert!(parameter < 1e-7 * MOST_SHORT_STEPS as f64, "{parameter}");
}
