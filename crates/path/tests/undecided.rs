//! Test functions of which a part stays at zero: its sign is rounding, and makes no event.
//!
//! The path is the unit circle `x^2 + l^2 = 1` from its top, once around, and the test function is `min
//! |g_i|` with the
//! sign of `(-1)^k`, k the number of negative `g_i`. A `g_i` below [`KNOWN`] is undecided.

use hammerbeam_path::{
    Branch, ContinuationPoint, DenseProblem, Judge, ParameterRange, PathProblem, PathStop, Settings,
    StartDirection, TestValue, follow,
};

/// What a part of the function is known to.
const KNOWN: f64 = 1e-11;

type Part = fn(x: f64, l: f64) -> f64;

/// The circle with test functions that are made of several parts each.
struct Circle<P> {
    inner: P,
    functions: Vec<Vec<Part>>,
    at: [f64; 2],
}

impl<P: PathProblem> PathProblem for Circle<P> {
    left_to!(inner but evaluate);

    fn evaluate(&mut self, point: &[f64]) -> Result<(), hammerbeam_path::EvaluationError> {
        self.at = [point[0], point[1]];
        self.inner.evaluate(point)
    }

    fn tests(&mut self, left_out: &[u32], values: &mut Vec<TestValue>) {
        let numbered = self.functions.iter().enumerate();
        let without = |k: usize| left_out.get(k).copied().unwrap_or(0);
        *values = numbered.map(|(k, parts)| test_value(parts, self.at, without(k))).collect();
    }
}

/// A function of these parts without so many of them.
fn test_value(parts: &[Part], [x, l]: [f64; 2], left_out: u32) -> TestValue {
    let mut parts: Vec<f64> = parts.iter().map(|part| part(x, l)).collect();
    parts.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let undecided = parts.iter().filter(|part| part.abs() < KNOWN).count() as u32;
    let kept = &parts[left_out as usize..];
    let count = kept.iter().filter(|part| **part < 0.0).count() as u32;
    let least = kept.first().map_or(1.0, |part| part.abs());
    let value = if count.is_multiple_of(2) { least } else { -least };
    TestValue { undecided, left_out, ..TestValue::sign_change(value, count) }
}

impl<P: PathProblem> Judge for Circle<P> {}

/// Zeros of one function as `[x, l]`, once around the circle.
fn zeros(parts: &[Part], step: f64) -> Vec<[f64; 2]> {
    zeros_of(&[parts], step).into_iter().map(|(at, _)| at).collect()
}

/// Zeros of functions as `[x, l]`, and the bits of those that vanish there, once around the circle.
fn zeros_of(functions: &[&[Part]], step: f64) -> Vec<([f64; 2], u32)> {
    let at = events(functions, step).into_iter();
    at.map(|point| ([point.point[0], point.point[1]], point.events.zeros)).collect()
}

/// Points at which functions vanish, once around the circle.
fn events(functions: &[&[Part]], step: f64) -> Vec<ContinuationPoint> {
    let equation = |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        residual[0] = z[0] * z[0] + z[1] * z[1] - 1.0;
        jacobian.copy_from_slice(&[2.0 * z[0], 2.0 * z[1]]);
        0
    };
    let functions = functions.iter().map(|parts| parts.to_vec()).collect();
    let mut circle = Circle { inner: DenseProblem::new(1, equation), functions, at: [0.0, 0.0] };
    let settings = Settings { max_step_length: step, sheet_distance: 1e-2, ..Settings::default() };
    let range = ParameterRange::new(-2.0, 2.0).unwrap();
    let branch: Branch =
        follow(&mut circle, &[1.0, 0.0], StartDirection::Increasing, range, settings).unwrap();
    assert_eq!(branch.stop, PathStop::Closed);
    branch.points.into_iter().filter(|point| point.events.zeros != 0).collect()
}

/// Of either sign, changing at every step.
const ROUNDING: Part = |x, l| 1e-14 * (1e5 * (x + 2.0 * l)).sin();
/// Zero where the circle meets `x = 0.3`.
const LINE: Part = |x, _| x - 0.3;

fn assert_at_the_line(found: &[[f64; 2]], what: &str) {
    assert_eq!(found.len(), 2, "{what}: {found:?}");
    assert!(found.iter().all(|[x, _]| (x - 0.3).abs() < 1e-9), "{what}: {found:?}");
}

#[test]
fn what_stays_at_zero_makes_no_event() {
    for step in [0.3, 0.1, 0.01] {
        assert!(zeros(&[ROUNDING], step).is_empty(), "step {step}");
        assert!(zeros(&[ROUNDING, |x, l| -1e-14 * (3e4 * (x - l)).cos()], step).is_empty(), "step {step}");
    }
}

#[test]
fn the_zero_of_one_part_is_found_beside_parts_that_stay_at_zero() {
    for step in [0.3, 0.1, 0.01] {
        assert_at_the_line(&zeros(&[LINE], step), "alone");
        assert_at_the_line(&zeros(&[LINE, ROUNDING], step), "beside one");
        let more: Part = |x, l| -1e-14 * (3e4 * (x - l)).cos();
        assert_at_the_line(&zeros(&[LINE, ROUNDING, more], step), "beside two");
    }
}

/// Zero for `x < 0`, and the same on both sides of that or of the other sign: nothing happens within a
/// stretch at zero.
#[test]
fn what_is_at_zero_over_a_stretch_makes_no_event_where_it_comes_or_leaves() {
    let same: Part = |x, _| if x > 0.0 { x * x } else { 1e-15 };
    let other: Part = |x, l| if x > 0.0 { x * x * (l + 1e-3).signum() } else { -1e-15 };
    for step in [0.3, 0.1, 0.01] {
        assert!(zeros(&[same], step).is_empty(), "step {step}");
        // At l = 0, where it starts, its own sign jumps, without a zero.
        assert!(zeros(&[other], step).is_empty(), "step {step}");
        assert_at_the_line(&zeros(&[same, LINE], step), "beside a stretch");
    }
}

/// Two parts come to zero in one step, and one leaves it again while the other stays. The sign of the other
/// says nothing then, and the sign of both was taken over.
#[test]
fn a_part_that_leaves_zero_beside_one_that_stays_makes_no_event() {
    let stays: Part = |x, l| if x > 0.3 { 1.0 } else { 1e-14 * (1e5 * (x + 2.0 * l)).sin() };
    let leaves: Part = |x, l| if !(0.2..=0.3).contains(&x) { 2.0 } else { 1e-14 * (3e4 * (x - l)).cos() };
    for step in (0..40).map(|k| 0.06 + 0.003 * f64::from(k)) {
        let found = zeros(&[stays, leaves], step);
        assert!(found.is_empty(), "step {step}: {found:?}");
    }
}

/// A zero that is crossed is undecided at the zero alone.
#[test]
fn a_zero_that_is_crossed_is_an_event_however_flat_it_is() {
    let flat: Part = |x, _| (x - 0.3).powi(3);
    for step in [0.3, 0.1, 0.01] {
        let found = zeros(&[flat], step);
        assert_eq!(found.len(), 2, "step {step}: {found:?}");
        assert!(found.iter().all(|[x, _]| (x - 0.3).abs() < 1e-3), "{found:?}");
    }
}

/// Of a function that is known badly a point may fall beside its zero, where its sign is not known. Where the
/// zero is taken for one at that point, it is reported how far it may be off.
#[test]
fn a_zero_is_found_though_a_point_beside_it_is_undecided() {
    let coarse: Part = |x, _| 1e-9 * (x - 0.3);
    let line = 0.3_f64.acos();
    for step in (0..400).map(|k| 0.03 + 0.0006 * f64::from(k)) {
        let found = events(&[&[coarse]], step);
        assert_eq!(found.len(), 2, "step {step}");
        for point in found {
            let off = (point.point[1].atan2(point.point[0]).abs() - line).abs();
            let stated = point.uncertainty;
            assert!(off < 0.011, "step {step}: {off:.1e} off");
            assert!(off < stated.max(1e-8), "step {step}: {off:.1e} off, within {stated:.1e}");
        }
    }
}

/// As a pair of multipliers that slides along the unit circle to -1, where it becomes real: of one function
/// that is a zero, of the other one, which says nothing before and does not vanish behind, it is none. Its
/// sign by rounding is another one right at that zero.
#[test]
fn what_is_at_zero_up_to_the_zero_of_another_function_makes_no_event_there() {
    let above: Part = |x, _| if x < 0.3 - 1e-9 { 1.0 } else { 1e-15 * (x - 0.3 - 1e-9).signum() };
    let below: Part = |x, _| if x > 0.3 + 1e-9 { 1.0 } else { 1e-15 * (0.3 - 1e-9 - x).signum() };
    for step in [0.3, 0.1, 0.01] {
        for pair in [above, below] {
            let found = zeros_of(&[&[LINE], &[pair]], step);
            assert!(found.iter().all(|(_, functions)| *functions == 1), "step {step}: {found:?}");
            let places: Vec<[f64; 2]> = found.into_iter().map(|(at, _)| at).collect();
            assert_at_the_line(&places, "beside a pair that becomes real");
        }
    }
}
