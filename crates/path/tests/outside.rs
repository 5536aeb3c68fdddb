//! A pair of multipliers that crosses the unit circle, turns real and comes back at +1 within a step is found.
#![allow(clippy::unwrap_used, reason = "a test ends where its path is wrong")]

mod support;

use hammerbeam_path::{
    Determinant, Direction, EvaluationError, Events, Outside, ParameterRange, PathProblem, Settings,
    SingularJacobian, TestValue, follow,
};

/// Where the pair crosses the circle, before the fold at `x = 0`.
const CROSSING: f64 = -1e-3;

/// `λ = -x²` whose point `x` is a fixed point with two multipliers of the product `D = 1 + b tanh((x + a)/a)` and the sum `T = 1 + D + tanh x`.
///
/// `(1 - mu)(1 - mu') = 1 - T + D = -tanh x`: one is at +1 at the fold. With `a = 1e-3` and `b = 0.1` they are complex on the circle at `x = -a`, where
/// `T = 2 - tanh a`; real and outside from about `x = -a/2`, where `T^2 - 4 D = (T - 2)^2 - 4 (1 - T + D)` changes its sign; 1 and 1.1 at the fold;
/// one on either side of the circle behind it. The numbers outside are 0, 2, 2, 1.
struct Normal<P> {
    fold: P,
    x: f64,
}

fn normal() -> Normal<impl PathProblem> {
    Normal { fold: support::graph(|x| (-x * x, -2.0 * x, 0)), x: 0.0 }
}

impl<P> Normal<P> {
    /// Real and imaginary part of the multipliers.
    fn multipliers(&self) -> [(f64, f64); 2] {
        let product = 1.0 + 0.1 * ((self.x - CROSSING) / -CROSSING).tanh();
        let half = 0.5 * (1.0 + product + self.x.tanh());
        let square = half * half - product;
        let root = square.abs().sqrt();
        if square < 0.0 { [(half, root), (half, -root)] } else { [(half + root, 0.0), (half - root, 0.0)] }
    }
}

impl<P: PathProblem> PathProblem for Normal<P> {
    fn unknowns(&self) -> usize {
        self.fold.unknowns()
    }
    fn weights(&self) -> &[f64] {
        self.fold.weights()
    }
    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.x = point[0];
        self.fold.evaluate(point)
    }
    fn residual(&self) -> &[f64] {
        self.fold.residual()
    }
    fn factorise(&mut self, row: &[f64]) -> Result<Determinant, SingularJacobian> {
        self.fold.factorise(row)
    }
    fn solve(&self, right_hand_side: &mut [f64]) {
        self.fold.solve(right_hand_side);
    }

    /// Of pairs alone.
    fn tests(&mut self, values: &mut Vec<TestValue>) {
        let (re, im) = self.multipliers()[0];
        let value = if im > 0.0 { 1.0 - re * re - im * im } else { 1.0 };
        values.clear();
        values.push(TestValue { value, count: u32::from(value < 0.0) });
    }

    fn outside(&mut self, events: Events) -> Option<Outside> {
        let mut left: Vec<f64> = self.multipliers().iter().map(|(re, im)| re.hypot(*im)).collect();
        if events.fold {
            left.pop();
        }
        if events.zeros > 0 {
            left.clear();
        }
        let (critical, least) =
            (2 - left.len() as u32, left.iter().filter(|size| **size > 1.0).count() as u32);
        Some(Outside { least, most: least + critical, critical })
    }
}

#[test]
fn the_crossing_is_found_from_either_side_whatever_the_step() {
    for (start, step) in [(-0.9, 0.3), (-0.9, 0.1), (-0.9, 0.007), (0.9, 0.3), (0.9, 0.1), (0.9, 0.007)] {
        let settings = Settings { max_step_length: step, sheet_distance: 1e-2, ..Settings::default() };
        let range = ParameterRange::new(-1.0, 1.0).unwrap();
        let branch = follow(&mut normal(), &[start, -start * start], Direction::Increasing, range, settings);
        let branch = branch.unwrap();
        let found: Vec<f64> = branch
            .points
            .iter()
            .filter(|point| point.events.zeros == 1)
            .map(|point| point.point[0])
            .collect();
        assert_eq!(found.len(), 1, "from {start} in steps of {step}: {found:?}");
        assert!((found[0] - CROSSING).abs() < 1e-9, "{found:?}");
        assert_eq!(branch.folds().count(), 1);
        // The interval of a thousandth is not walked in steps as short as that throughout.
        assert!(branch.points.len() < 60 + (4.0 / step) as usize, "{} points", branch.points.len());
    }
}
