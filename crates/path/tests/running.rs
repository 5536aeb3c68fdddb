//! Running a follower: work, checkpoints, reasons to stop.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use hammerbeam_path::{
    Checkpoint, ContinuationPoint, DenseProblem, EvaluationError, Follower, PathError, PathEvents,
    PathProblem, PathStop, Settings, StartDirection, StepOutcome, follow,
};

fn wave(x: f64, l: f64) -> (f64, f64, f64, u64) {
    (x - (3.0 * l).sin(), 1.0, -3.0 * (3.0 * l).cos(), 0)
}

#[test]
fn short_steps_on_a_smooth_arc_take_one_evaluation_each() {
    let branch = up(&mut mixed(12, 0.0, wave), &mixed_point(12, 0.0, 0.0, 0.0), 0.0, 2.0, steps_of(0.001));
    assert_reached_end(&branch, 2.0);
    let work = evaluations_per_point(&branch);
    assert!(work < 1.02, "{work} evaluations per point");
    assert!(branch.points.iter().all(|point| point.correction_norm <= 1e-9));
}

#[test]
fn long_steps_on_a_smooth_arc_take_about_two_evaluations_each() {
    let branch = up(&mut mixed(12, 0.0, wave), &mixed_point(12, 0.0, 0.0, 0.0), 0.0, 20.0, steps_of(0.02));
    let work = evaluations_per_point(&branch);
    assert!(work < 2.1, "{work} evaluations per point");
}

#[test]
fn work_on_the_circle_is_pinned() {
    let circle = |x: f64, l: f64| (x * x + l * l - 1.0, 2.0 * x, 2.0 * l, 0);
    let branch = up(&mut plane(circle), &[0.8, 0.6], -2.0, 2.0, Settings::default());
    let counters = branch.counters;
    assert_eq!((counters.accepted, counters.evaluations, counters.rejected), (70, 143, 0));
}

#[test]
fn every_point_reports_its_evaluations() {
    let branch = up(&mut plane(wave), &[0.0, 0.0], 0.0, 2.0, steps_of(0.01));
    let sum: u64 = branch.points.iter().map(|point| point.evaluations).sum();
    assert_eq!(sum, branch.counters.evaluations);
}

/// Folds, touches with pairs of folds, and a fold that closes nothing.
fn rough(x: f64, l: f64) -> (f64, f64, f64, u64) {
    let p = (x - 0.3).max(0.0);
    (x - 20.0 * p.powf(1.5) + 30.0 * p * p - l, 1.0 - 30.0 * p.sqrt() + 60.0 * p, -1.0, u64::from(x > 0.3))
}

fn walk(follower: &mut Follower, problem: &mut impl PathProblem, most: usize) -> Vec<ContinuationPoint> {
    let mut points = Vec::new();
    while points.len() < most && follower.step(problem) == StepOutcome::Accepted {
        points.push(follower.current().clone());
    }
    points
}

#[test]
fn a_resumed_run_repeats_the_uninterrupted_one_bit_by_bit() {
    let problem = mixed(7, 0.3, rough);
    let (start, limits) = (mixed_point(7, 0.3, 0.0, 0.0), range(-1.0, 1.0));
    let start_follower = || {
        Follower::start(&mut problem.clone(), &start, StartDirection::Increasing, limits, Settings::default())
    };
    let first = start_follower().unwrap().current().clone();
    let whole = walk(&mut start_follower().unwrap(), &mut problem.clone(), usize::MAX);
    assert!(whole.len() > 60);
    for cut in (1..whole.len()).step_by(7) {
        let mut early = start_follower().unwrap();
        walk(&mut early, &mut problem.clone(), cut);
        let checkpoint: Checkpoint = early.checkpoint();
        let mut late = Follower::resume(&mut problem.clone(), checkpoint, limits, Settings::default());
        late.remember(&first);
        whole[..cut].iter().for_each(|point| late.remember(point));
        assert_eq!(
            walk(&mut late, &mut problem.clone(), usize::MAX),
            whole[cut..],
            "resumed after point {cut}"
        );
    }
}

/// Follows `f` and checks at each point that the problem was evaluated last exactly there; returns the events
/// seen.
fn events_evaluated_in_place(f: Implicit, start: [f64; 2]) -> PathEvents {
    let seen = std::cell::RefCell::new(vec![]);
    let mut problem = DenseProblem::new(1, |z: &[f64], r: &mut [f64], j: &mut [f64]| {
        seen.replace(z.to_vec());
        let (value, dx, dl, signature) = f(z[0], z[1]);
        r[0] = value;
        j.copy_from_slice(&[dx, dl]);
        signature
    });
    let limits = range(-1.0, 1.0);
    let mut follower =
        Follower::start(&mut problem, &start, StartDirection::Increasing, limits, Settings::default())
            .expect("on the path");
    let mut events = PathEvents::default();
    while follower.step(&mut problem) == StepOutcome::Accepted {
        let point = follower.current();
        assert_eq!(*seen.borrow(), point.point, "{:?}", point.events);
        events.fold |= point.events.fold;
        events.branch_point |= point.events.branch_point;
        events.signature_change |= point.events.signature_change;
        events.corner |= point.events.corner;
    }
    assert!(matches!(follower.stop_reason(), Some(PathStop::RangeEnd | PathStop::Closed)));
    events
}

#[test]
fn the_problem_is_left_evaluated_at_every_accepted_point() {
    let circle: Implicit = |x, l| (x * x + l * l - 0.5, 2.0 * x, 2.0 * l, 0);
    let transcritical: Implicit = |x, l| (l * x - x * x, l - 2.0 * x, x, 0);
    let corner: Implicit = |x, l| (-x.abs() - l, -x.signum(), -1.0, u64::from(x > 0.0));
    assert!(events_evaluated_in_place(rough, [0.0, 0.0]).signature_change);
    assert!(events_evaluated_in_place(circle, [0.5, 0.5]).fold);
    assert!(events_evaluated_in_place(transcritical, [0.0, -0.77]).branch_point);
    assert!(events_evaluated_in_place(transcritical, [0.0, -0.5]).branch_point);
    assert!(events_evaluated_in_place(corner, [-0.5, -0.5]).corner);
}

#[test]
fn the_budget_ends_a_branch() {
    let settings = Settings { max_points: 5, ..Settings::default() };
    let branch = up(&mut plane(wave), &[0.0, 0.0], 0.0, 2.0, settings);
    assert_eq!((branch.stop, branch.points.len()), (PathStop::Budget, 6));
}

#[test]
fn a_start_at_the_end_of_the_range_leads_nowhere_outwards() {
    let branch = up(&mut plane(wave), &[0.0, 0.0], -1.0, 0.0, Settings::default());
    assert_eq!((branch.stop, branch.points.len()), (PathStop::RangeEnd, 1));
    let branch = down(&mut plane(wave), &[0.0, 0.0], -1.0, 0.0, Settings::default());
    assert_reached_end(&branch, -1.0);
}

#[test]
fn a_path_that_ends_stops_with_its_place() {
    let ends = |x: f64, l: f64| (x - l, 1.0, if l > 0.5 { f64::NAN } else { -1.0 }, 0);
    let branch = up(&mut plane(ends), &[0.0, 0.0], 0.0, 1.0, Settings::default());
    let PathStop::EvaluationFailed { parameter, step, error } = branch.stop else {
        panic!("{:?}", branch.stop)
    };
    assert!((parameter - 0.5).abs() < 1e-8 && step < 1e-8, "{parameter} {step}");
    assert_eq!(error, EvaluationError::NotFinite);
}

#[test]
fn unusable_input_is_refused() {
    let mut problem = plane(wave);
    let mut follow_from = |start: &[f64], settings: Settings| {
        follow(&mut problem, start, StartDirection::Increasing, range(0.0, 1.0), settings).map(|_| ())
    };
    assert_eq!(
        follow_from(&[0.0], Settings::default()),
        Err(PathError::WrongLength { found: 1, expected: 2 })
    );
    let outside = follow_from(&[0.0, 3.0], Settings::default());
    assert!(matches!(outside, Err(PathError::StartOutsideRange { .. })));
    let settings = Settings { max_angle: 2.0, ..Settings::default() };
    assert!(matches!(
        follow_from(&[0.0, 0.5], settings),
        Err(PathError::UnusableSetting { name: "max_angle", .. })
    ));
}

#[test]
fn a_start_at_a_fold_goes_along_a_direction() {
    let fold = |x: f64| (x * x, 2.0 * x, 0);
    let branch = follow(
        &mut graph(fold),
        &[0.0, 0.001],
        StartDirection::Along(&[-1.0, 0.0]),
        range(-1.0, 1.0),
        Settings::default(),
    )
    .unwrap();
    assert_reached_end(&branch, 1.0);
    assert_monotone(&branch, |z| -z[0]);
}

/// The equation changes its sign at `λ = 0.3`, as when a problem is cut into other segments: the determinant
/// jumps, the path does not.
#[test]
fn orientation_is_anchored_anew_where_the_equations_change() {
    let sign_changes = |x: f64, l: f64| {
        let (f, dx, dl, _) = wave(x, l);
        if l > 0.3 { (-2.0 * f, -2.0 * dx, -2.0 * dl, 1) } else { (f, dx, dl, 0) }
    };
    let branch = up(&mut plane(sign_changes), &[0.0, 0.0], 0.0, 1.0, Settings::default());
    assert_reached_end(&branch, 1.0);
    assert_eq!(branch.branch_points().count(), 0);
    assert_eq!(folds(&branch).len(), 0);
    let signs: Vec<f64> = branch.points.iter().map(|point| point.orientation).collect();
    assert_eq!((signs.first(), signs.last()), (Some(&signs[0]), Some(&-signs[0])));
}

/// Work over a fold or corner of each kind, from 0.05 before it to 0.06 behind it. A change here is a change
/// of speed.
#[test]
fn work_over_sharp_turns_is_pinned() {
    let hairpin = |radius: f64| {
        let curve = move |x: f64| (-x.hypot(radius), -x / x.hypot(radius), 0);
        up(&mut graph(curve), &[-0.05, -0.05], -0.06, 1.0, Settings::default()).counters.evaluations
    };
    let kink = |far_slope: f64| {
        let slope = move |x: f64| if x > 0.0 { far_slope } else { 1.0 };
        let curve = move |x: f64| (slope(x) * x, slope(x), u64::from(x > 0.0));
        up(&mut graph(curve), &[-0.05, -0.05], -0.06, 0.06, Settings::default()).counters.evaluations
    };
    let found =
        [hairpin(1e-2), hairpin(1e-4), hairpin(1e-6), hairpin(1e-8), kink(-1.0), kink(1.05), kink(1.0)];
    assert_eq!(found, [68, 83, 82, 85, 85, 68, 51]);
}
