//! Folds of a path that lie beside a simpler one, which it has left or comes to: the slope is known badly
//! there, and a change of its sign says nothing until later.
#![allow(clippy::unwrap_used, reason = "a test ends where its path is wrong")]

use crate::support::{down, folds, graph, plane, steps_of, up};
use hammerbeam_path::{Judge, PathProblem, Settings};

/// A path of one unknown that leaves a simpler one at `x = 0`.
struct Leaving<P>(P);

impl<P: PathProblem> PathProblem for Leaving<P> {
    left_to!(0);
}

impl<P: PathProblem> Judge for Leaving<P> {
    fn distance_to_simpler(&mut self, point: &[f64]) -> f64 {
        point[0].abs()
    }
}

const BEND: f64 = 0.05;

/// `λ = -BEND (x - fold)^2`: behind the fold the slope is beyond doubt from `2 BEND (x - fold) x > 1e-6` on,
/// some hundredths later.
#[test]
fn a_fold_lies_where_the_slope_vanishes_and_not_where_that_is_beyond_doubt() {
    for fold in [1e-5, 1e-4, 1e-3] {
        let arc = move |x: f64| (-BEND * (x - fold).powi(2), -2.0 * BEND * (x - fold), 0);
        let start = [1e-6, arc(1e-6).0];
        let branch = up(&mut Leaving(graph(arc)), &start, -0.1, 1.0, steps_of(1e-3));
        let at: Vec<f64> = branch.folds().map(|point| point.point[0]).collect();
        assert_eq!(at.len(), 1, "fold at {fold}: {at:?}");
        assert!((at[0] - fold).abs() < 2e-6, "fold at {fold}: {at:?}");
        assert!(branch.points.last().unwrap().parameter() == -0.1);
    }
}

/// A ripple of the slope that changes its sign and goes again before that could be resolved is no fold.
#[test]
fn a_slope_that_comes_back_is_no_fold() {
    // The slope is negative between 0.9e-3 and 1.1e-3 by at most 1e-5, which is beyond doubt from 1e-3 on.
    let arc = |x: f64| {
        let u = x - 1e-3;
        (1e3 * (u.powi(3) / 3.0 - 1e-8 * u), 1e3 * (u * u - 1e-8), 0)
    };
    let (start, end) = ([1e-6, arc(1e-6).0], arc(3e-3).0);
    let settings = Settings { max_step_length: 3e-5, ..steps_of(1e-3) };
    let branch = up(&mut Leaving(graph(arc)), &start, -1.0, end, settings);
    assert_eq!(branch.points.last().unwrap().parameter(), end);
    assert!(branch.points.iter().any(|point| point.tangent[1] < 0.0), "no point lies on the ripple");
    assert_eq!(folds(&branch), Vec::<f64>::new());
}

/// `λ x - x^3 = 0`, whose arms meet the stem `x = 0` at the branch point, with errors of its derivatives as
/// rounding makes them: within some 1e-4 of the stem the sign of the slope says nothing.
#[test]
fn arms_turn_once_where_they_meet_the_simpler_path_whatever_the_slope_says() {
    let pitchfork = |x: f64, l: f64| {
        let error = 2e-7 * (1e9 * x + 3e9 * l).sin();
        (l * x - x * x * x, l - 3.0 * x * x + error, x, 0)
    };
    for number in 0..40 {
        // Steps end at other distances from the stem.
        let x = 0.3 + 1.3e-4 * f64::from(number);
        let step = [0.05, 0.01, 0.001][number as usize % 3];
        let arms = down(&mut Leaving(plane(pitchfork)), &[x, x * x], -1.0, 0.1, steps_of(step));
        assert_eq!(arms.points.last().unwrap().parameter(), 0.1, "from {x}: {:?}", arms.stop);
        let turns: Vec<_> = arms.points.iter().filter(|p| p.events.fold || p.events.branch_point).collect();
        assert_eq!(turns.len(), 1, "from {x}: {turns:?}");
        assert!(turns[0].events.branch_point, "from {x}: {turns:?}");
        assert!(arms.points.last().unwrap().point[0] < 0.0, "from {x}");
    }
}

/// `(x - x0)(λ - (x - x0)) = 0`: a path that only passes near a simpler one, at a branch point.
#[test]
fn a_branch_point_near_a_simpler_path_is_passed_straight_on() {
    let near = 9e-4;
    let crossing = move |x: f64, l: f64| {
        let u = x - near;
        (u * (l - u), l - 2.0 * u, u, 0)
    };
    let branch = up(&mut Leaving(plane(crossing)), &[near - 0.05, -0.05], -0.1, 0.1, steps_of(1e-3));
    assert_eq!(branch.points.last().unwrap().parameter(), 0.1, "{:?}", branch.stop);
    assert_eq!(branch.branch_points().count(), 1);
    assert_eq!(folds(&branch), Vec::<f64>::new());
}
