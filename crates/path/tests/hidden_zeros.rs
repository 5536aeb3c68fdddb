//! Zeros of a test function that undo each other within a step, of which the problem knows.

use hammerbeam_path::{
    DenseProblem, EvaluationError, Judge, ParameterRange, PathProblem, Settings, StartDirection, TestValue,
    follow,
};

/// The line `x = λ` with a point of the plane that moves along it, and two test functions: the parameter less
/// [`OTHER`], and what the point is beyond the unit circle.
struct Passing<P> {
    line: P,
    at: f64,
}

/// Where the other function vanishes.
const OTHER: f64 = 0.55;

/// Goes through the circle on a straight line, and away from it in another direction where the other function
/// is zero.
fn place(at: f64) -> [f64; 2] {
    let further = (at - OTHER).max(0.0);
    [4.0 * (at - 0.35), 0.9 + 20.0 * further]
}

fn beyond([x, y]: [f64; 2]) -> f64 {
    x.hypot(y) - 1.0
}

impl<P: PathProblem> PathProblem for Passing<P> {
    left_to!(line but evaluate);

    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.at = point[1];
        self.line.evaluate(point)
    }

    fn tests(&mut self, _: &[u32], values: &mut Vec<TestValue>) {
        values.clear();
        let signed = |value: f64| TestValue::sign_change(value, u32::from(value < 0.0));
        values.extend([signed(self.at - OTHER), signed(beyond(place(self.at)))]);
    }
}

impl<P: PathProblem> Judge for Passing<P> {
    fn note(&mut self, numbers: &mut Vec<f64>) {
        numbers.clear();
        numbers.extend(place(self.at));
    }

    /// Whether the middle of the line between the two places is inside, and they are not.
    fn hides_zeros(&self, before: &[f64], behind: &[f64]) -> bool {
        let (from, to) = ([before[0], before[1]], [behind[0], behind[1]]);
        let middle = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
        beyond(from) > 0.0 && beyond(to) > 0.0 && beyond(middle) < 0.0
    }
}

/// From 0.1 to 1 in steps of up to 0.5 along the line: the circle is passed at `0.35 ± 0.109`, and from
/// beyond the other zero the straight way does not lead through it.
#[test]
fn they_are_found_on_the_way_to_the_zero_of_another_function() {
    assert!(beyond(place(0.1)) > 0.0 && beyond(place(OTHER)) > 0.0, "outside at the start and at the zero");
    let equation = |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        residual[0] = z[0] - z[1];
        jacobian.copy_from_slice(&[1.0, -1.0]);
        0
    };
    let mut problem = Passing { line: DenseProblem::new(1, equation), at: 0.0 };
    let settings = Settings { initial_step: 0.8, max_step_length: 0.8, ..Settings::default() };
    let range = ParameterRange::new(0.0, 1.0).expect("in order");
    let branch = follow(&mut problem, &[0.1, 0.1], StartDirection::Increasing, range, settings);
    let branch = branch.expect("the start lies on the line");
    let zeros = |index: u32| -> Vec<f64> {
        let at = |point: &&hammerbeam_path::ContinuationPoint| point.events.zeros >> index & 1 == 1;
        branch.points.iter().filter(at).map(|point| point.point[1]).collect()
    };
    let half_width = (1.0_f64 - 0.81).sqrt() / 4.0;
    let expected = [(0, vec![OTHER]), (1, vec![0.35 - half_width, 0.35 + half_width])];
    for (index, expected) in expected {
        let found = zeros(index);
        assert_eq!(found.len(), expected.len(), "{index}: {found:?}");
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    }
    assert_eq!(branch.points[1].point[1], zeros(1)[0], "from the start to the first zero in one step");
}
