//! A path goes on in other unknowns: it still closes at its start, and what was walked before is known.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use hammerbeam_path::{
    ContinuationPoint, DenseProblem, Follower, Judge, Node, ParameterRange, PathError, PathProblem, PathStop,
    Settings, StartDirection, StepOutcome,
};

type Function = Box<dyn FnMut(&[f64], &mut [f64], &mut [f64]) -> u64>;

/// The unit circle `x² + λ² = 1` in several copies of `x`, each `1/copies` of the weight; the first is
/// remembered.
struct Circle(DenseProblem<Function>);

impl Circle {
    fn new(copies: usize) -> Self {
        let function = move |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
            let (width, last) = (copies + 1, copies - 1);
            jacobian.fill(0.0);
            for i in 0..last {
                residual[i] = z[i] - z[i + 1];
                (jacobian[i * width + i], jacobian[i * width + i + 1]) = (1.0, -1.0);
            }
            residual[last] = z[last] * z[last] + z[copies] * z[copies] - 1.0;
            jacobian[last * width + last] = 2.0 * z[last];
            jacobian[last * width + copies] = 2.0 * z[copies];
            0
        };
        let weights = (0..copies).map(|_| 1.0 / copies as f64).chain([1.0]).collect();
        Self(DenseProblem::weighted(weights, Box::new(function)))
    }
}

impl PathProblem for Circle {
    left_to!(0);
}

impl Judge for Circle {
    fn memory_weights(&self) -> Option<Vec<f64>> {
        Some(vec![1.0, 1.0])
    }
}

/// `[x; λ]` as `[x; ..; x; λ]`.
fn copied(values: &[f64], copies: usize) -> Vec<f64> {
    let (x, parameter) = (values[0], values[values.len() - 1]);
    std::iter::repeat_n(x, copies).chain([parameter]).collect()
}

fn transfer(follower: &mut Follower, copies: usize) -> Result<Circle, PathError> {
    let mut problem = Circle::new(copies);
    let start = &follower.state().start;
    let [current, start] = [follower.current(), start]
        .map(|point| Node { point: copied(&point.point, copies), tangent: copied(&point.tangent, copies) });
    follower.transfer(&mut problem, &current, Some(&start))?;
    Ok(problem)
}

fn started(problem: &mut Circle, start: &[f64]) -> Follower {
    let range = ParameterRange::new(-2.0, 2.0).unwrap();
    Follower::start(problem, start, StartDirection::Increasing, range, Settings::default()).unwrap()
}

#[test]
fn a_circle_closes_at_its_start_whatever_happens_to_its_unknowns() {
    let mut problem = Circle::new(1);
    let mut follower = started(&mut problem, &[1.0, 0.0]);
    let mut folds = 0;
    for step in 1_u64.. {
        match follower.step(&mut problem) {
            StepOutcome::Accepted => folds += u32::from(follower.current().events.fold),
            StepOutcome::Stopped(reason) => {
                assert_eq!(reason, PathStop::Closed);
                assert_eq!(follower.counters().accepted, step - 1);
                break;
            }
        }
        match step {
            10 => problem = transfer(&mut follower, 3).unwrap(),
            20 => problem = transfer(&mut follower, 12).unwrap(),
            25 => problem = transfer(&mut follower, 2).unwrap(),
            _ => {}
        }
    }
    assert_eq!(folds, 2);
    // Steps of up to 0.3 rad: the arc length of the follower is good to the fourth order.
    assert_relative_eq!(follower.current().arc_length, TAU, epsilon = 1e-4);
}

#[test]
fn other_equations_on_the_way_are_refused_and_change_nothing() {
    let mut problem = Circle::new(1);
    let mut follower = started(&mut problem, &[1.0, 0.0]);
    follower.step(&mut problem);
    let before = follower.checkpoint();
    let node = Node {
        point: copied(&before.state.current.point, 2),
        tangent: copied(&before.state.current.tangent, 2),
    };
    let found = follower.transfer(&mut Circle::new(3), &node, Some(&node));
    assert_eq!(found, Err(PathError::WrongLength { found: 3, expected: 4 }));
    assert_eq!(follower.checkpoint(), before);
}

/// The unknowns are the same as before, but nothing of them is said to stay: without its start the circle is
/// walked on beyond it; with the start brought back on the way it closes there.
#[test]
fn a_start_that_is_out_of_reach_can_be_brought_back() {
    for brought_back in [false, true] {
        let mut problem = Circle::new(1);
        let mut follower = started(&mut problem, &[1.0, 0.0]);
        let first = follower.state().start.clone();
        let node =
            |point: &ContinuationPoint| Node { point: point.point.clone(), tangent: point.tangent.clone() };
        let mut closed = false;
        while follower.current().arc_length < TAU + 0.5 && !closed {
            match follower.step(&mut problem) {
                StepOutcome::Accepted => {}
                StepOutcome::Stopped(reason) => {
                    assert_eq!(reason, PathStop::Closed);
                    closed = true;
                }
            }
            let current = node(follower.current());
            let length = follower.current().arc_length;
            if follower.state().has_start() && (1.0..2.0).contains(&length) {
                follower.transfer_afresh(&mut problem, &current, None).unwrap();
                assert!(!follower.state().has_start());
            } else if brought_back && !follower.state().has_start() && length > 5.0 {
                let start = node(&first);
                follower.transfer_afresh(&mut problem, &current, Some((&start, &first))).unwrap();
                assert!(follower.state().has_start());
            }
        }
        assert_eq!(closed, brought_back);
        if closed {
            assert_relative_eq!(follower.current().arc_length, TAU, epsilon = 1e-4);
        }
    }
}
