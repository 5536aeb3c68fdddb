//! Zeros of test functions become points of their own.

use hammerbeam_path::{
    Branch, DenseProblem, ParameterRange, PathProblem, PathStop, Settings, StartDirection, TestValue, follow,
};

/// The unit circle `x² + λ² = 1`, with these test functions.
fn circle(tests: Vec<fn(&[f64]) -> TestValue>) -> impl PathProblem {
    let equation = |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        residual[0] = z[0] * z[0] + z[1] * z[1] - 1.0;
        jacobian.copy_from_slice(&[2.0 * z[0], 2.0 * z[1]]);
        0
    };
    DenseProblem::new(1, equation).with_tests(tests)
}

/// The circle from the top, `λ` increasing, until it closes.
fn round(tests: Vec<fn(&[f64]) -> TestValue>, step: f64) -> Branch {
    let settings = Settings { max_step_length: step, sheet_distance: 1e-2, ..Settings::default() };
    let range = ParameterRange::new(-2.0, 2.0).expect("in order");
    let branch = follow(&mut circle(tests), &[1.0, 0.0], StartDirection::Increasing, range, settings);
    let branch = branch.expect("the start lies on the circle");
    assert_eq!(branch.stop, PathStop::Closed);
    branch
}

fn signed(value: f64) -> TestValue {
    TestValue::sign_change(value, u32::from(value < 0.0))
}

fn zeros(branch: &Branch, index: u32) -> Vec<(f64, f64)> {
    let at = |point: &&hammerbeam_path::ContinuationPoint| point.events.zeros >> index & 1 == 1;
    branch.points.iter().filter(at).map(|point| (point.point[0], point.point[1])).collect()
}

#[test]
fn zeros_lie_where_the_line_cuts_the_circle() {
    for step in [0.3, 0.1, 0.01] {
        let branch = round(vec![|z| signed(z[0] - 0.3)], step);
        let found = zeros(&branch, 0);
        assert_eq!(found.len(), 2, "step {step}");
        let height = (1.0_f64 - 0.09).sqrt();
        for ((x, l), expected) in found.iter().zip([height, -height]) {
            assert!((x - 0.3).abs() < 1e-9 && (l - expected).abs() < 1e-9, "{x} {l}");
        }
        assert!(
            branch.points.iter().filter(|point| point.events.zeros > 0).all(|point| point.uncertainty < 1e-8)
        );
        assert_eq!(branch.folds().count(), 2);
    }
}

/// A probe that is off the path by a part of the bracket has the wrong sign where the function changes more
/// across the path than along it: the search then closed in on that probe.
#[test]
fn a_function_that_is_steep_across_the_path_has_its_zero_on_it() {
    fn steep<const ACROSS: i32>(z: &[f64]) -> TestValue {
        signed(z[0] - 0.3 + f64::from(ACROSS) * (z[0] * z[0] + z[1] * z[1] - 1.0))
    }
    let functions: [fn(&[f64]) -> TestValue; 4] =
        [steep::<-1000>, steep::<-100>, steep::<100>, steep::<1000>];
    for (place, function) in functions.into_iter().enumerate() {
        for step in [0.3, 0.1, 0.03] {
            let found = zeros(&round(vec![function], step), 0);
            assert_eq!(found.len(), 2, "function {place}, step {step}");
            let is_there = |point: &(f64, f64)| (point.0 - 0.3).abs() < 1e-9;
            assert!(found.iter().all(is_there), "function {place}, step {step}: {found:?}");
        }
    }
}

#[test]
fn a_zero_beside_a_fold_is_distinguished_from_it_on_either_side() {
    // The folds lie at (0, ±1), the zeros within one step before and behind them.
    let branch = round(vec![|z| signed(z[0] - 0.01), |z| signed(z[0] + 0.01)], 0.1);
    for (index, x) in [(0, 0.01), (1, -0.01)] {
        let found = zeros(&branch, index);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|point| (point.0 - x).abs() < 1e-9));
    }
    assert_eq!(branch.folds().count(), 2);
    assert!(branch.folds().all(|point| point.point[0].abs() < 1e-6));
}

#[test]
fn two_functions_that_vanish_within_one_step_give_two_points() {
    let branch = round(vec![|z| signed(z[0] - 0.5), |z| signed(0.501 - z[0])], 0.3);
    assert_eq!((zeros(&branch, 0).len(), zeros(&branch, 1).len()), (2, 2));
    assert!(zeros(&branch, 1).iter().all(|point| (point.0 - 0.501).abs() < 1e-9));
}

/// Which of them are negative there is rounding: whatever their order and their signs, a point is a zero of
/// all, or there is one for each.
#[test]
fn functions_that_vanish_at_one_place_are_all_found_there() {
    let all: [fn(&[f64]) -> TestValue; 4] = [
        |z| signed(z[0] - 0.5),
        |z| signed(2.0 * (0.5 - z[0])),
        |z| signed((z[0] - 0.5 - 1e-13) * (1.5 + z[1])),
        |z| signed((0.5 - 1e-13 - z[0]) * (1.5 - z[0])),
    ];
    for shift in 0..4 {
        let tests: Vec<_> = (0..4).map(|k| all[(k + shift) % 4]).collect();
        for step in [0.3, 0.1] {
            let branch = round(tests.clone(), step);
            for index in 0..4 {
                let found = zeros(&branch, index);
                assert_eq!(found.len(), 2, "function {index}, shift {shift}, step {step}");
                assert!(found.iter().all(|point| (point.0 - 0.5).abs() < 1e-9));
            }
        }
    }
}

#[test]
fn a_jump_through_zero_is_no_zero() {
    let jump: fn(&[f64]) -> TestValue = |z| signed(if z[0] > 0.4 { 1.0 } else { -2.0 });
    assert_eq!(zeros(&round(vec![jump], 0.1), 0), []);
}

#[test]
fn two_zeros_of_one_function_within_a_step_are_both_found() {
    // Zero at x = 0.300 and at x = 0.302: the value has the same sign on both sides, the count differs.
    let pair: fn(&[f64]) -> TestValue = |z| {
        let count = u32::from(z[0] < 0.302) + u32::from(z[0] < 0.300);
        TestValue::sign_change((z[0] - 0.300) * (z[0] - 0.302), count)
    };
    let found = zeros(&round(vec![pair], 0.3), 0);
    let mut places: Vec<f64> = found.iter().map(|point| point.0).collect();
    places.sort_by(f64::total_cmp);
    assert_eq!(places.len(), 4);
    for (place, expected) in places.iter().zip([0.300, 0.300, 0.302, 0.302]) {
        assert!((place - expected).abs() < 1e-8, "{place}");
    }
}

/// Negative between x = 0.300 and x = 0.302 only, so that count and sign are the same on both sides of a step
/// over both zeros: the values before it show that the function comes down.
#[test]
fn two_zeros_within_a_step_that_leave_no_trace_in_the_count_are_found() {
    for step in [0.3, 0.1, 0.03] {
        let found = zeros(&round(vec![|z| signed((z[0] - 0.300) * (z[0] - 0.302))], step), 0);
        let mut places: Vec<f64> = found.iter().map(|point| point.0).collect();
        places.sort_by(f64::total_cmp);
        assert_eq!(places.len(), 4, "step {step}: {places:?}");
        for (place, expected) in places.iter().zip([0.300, 0.300, 0.302, 0.302]) {
            assert!((place - expected).abs() < 1e-8, "{place}");
        }
    }
}

#[test]
fn a_function_that_only_comes_near_zero_has_none() {
    for step in [0.3, 0.1, 0.03] {
        let near: fn(&[f64]) -> TestValue = |z| signed((z[0] - 0.301).powi(2) + 1e-6);
        assert_eq!(zeros(&round(vec![near], step), 0), [], "step {step}");
    }
}

/// Where a pair of multipliers beyond the unit circle becomes real, one test function jumps; where one of
/// both then passes -1, another vanishes. In one step the jump must not undo what is known behind the zero,
/// where the sign of the function is rounding.
#[test]
fn a_zero_is_found_once_though_another_function_jumps_within_the_same_step() {
    let jump: fn(&[f64]) -> TestValue = |z| signed(if z[0] > 0.4 { 1.0 } else { -2.0 });
    // Beside its zero the function has one sign: as before it on one way, as behind it on the other.
    let above: fn(&[f64]) -> TestValue =
        |z| signed(if (z[0] - 0.3).abs() < 1e-9 { 1e-15 } else { z[0] - 0.3 });
    let below: fn(&[f64]) -> TestValue =
        |z| signed(if (z[0] - 0.3).abs() < 1e-9 { -1e-15 } else { z[0] - 0.3 });
    for step in [0.3, 0.2, 0.1, 0.01] {
        for zero in [above, below] {
            for (tests, index) in [(vec![zero, jump], 0), (vec![jump, zero], 1)] {
                let branch = round(tests, step);
                let found = zeros(&branch, index);
                assert_eq!(found.len(), 2, "step {step}, function {index}: {found:?}");
                assert_eq!(zeros(&branch, 1 - index), [], "step {step}");
            }
        }
    }
}

/// Vanishes at the border of where the signature of [`changes_twice`] is another one; has no value elsewhere.
fn beside(z: &[f64]) -> f64 {
    if (0.304..0.6).contains(&z[0]) { z[0] - 0.304 } else { f64::INFINITY }
}

/// Asserts that all changes are found by these test functions where the signature is another one at `0.300 <
/// x < 0.304`.
fn changes_twice(tests: &[fn(&[f64]) -> TestValue]) {
    let equation = |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        residual[0] = z[0] * z[0] + z[1] * z[1] - 1.0;
        jacobian.copy_from_slice(&[2.0 * z[0], 2.0 * z[1]]);
        u64::from((0.300..0.304).contains(&z[0]))
    };
    for step in [0.1, 0.05, 0.03] {
        // From a few places, so that steps fall otherwise; down past the two changes on one side of the
        // circle, up past them on the other.
        for angle in 0..20 {
            let start = [(0.03 * f64::from(angle)).cos(), (0.03 * f64::from(angle)).sin()];
            let settings = Settings { max_step_length: step, sheet_distance: 1e-2, ..Settings::default() };
            let range = ParameterRange::new(-2.0, 2.0).expect("in order");
            let mut problem = DenseProblem::new(1, equation).with_tests(tests.to_vec());
            let branch = follow(&mut problem, &start, StartDirection::Increasing, range, settings);
            let branch = branch.expect("the start lies on the circle");
            let changes = branch.points.iter().filter(|point| point.events.signature_change);
            assert_eq!(changes.count(), 4, "step {step}, angle {angle}");
        }
    }
}

#[test]
fn a_signature_that_changes_twice_within_a_step_is_found_beside_where_a_function_has_a_value() {
    changes_twice(&[|z| TestValue::sign_change(beside(z), 0)]);
}

/// Two values in order, one of which is there always: what begins or ends is the larger one by its place, and
/// may be the smaller one by its value.
#[test]
fn a_signature_that_changes_twice_is_found_where_the_smaller_of_two_values_appears_or_vanishes() {
    const ALWAYS: f64 = 0.2;
    changes_twice(&[
        |z| TestValue::sign_change(beside(z).min(ALWAYS), 0),
        |z| TestValue::sign_change(beside(z).max(ALWAYS), 0),
    ]);
}
