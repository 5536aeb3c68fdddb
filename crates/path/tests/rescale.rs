//! A path whose unknowns grow by orders of magnitude is followed in units that grow with them.

use std::cell::Cell;

use hammerbeam_path::{
    ContinuationPoint, DenseProblem, Follower, ParameterRange, PathStop, Settings, StartDirection,
    StepOutcome,
};

const WIDTH: f64 = 1000.0;

/// The ellipse `(x/1000)² + λ² = 1` from `x = 1` on, with a second unknown `y = λ/1000` and a copy of both;
/// where x leaves its unit by a factor of four, all unknowns and their equations get units that fit. Points
/// in the first units.
fn follow_ellipse(rescales: bool) -> (Vec<ContinuationPoint>, PathStop) {
    let units = Cell::new([1.0, 1.0]);
    let mut problem = DenseProblem::new(4, |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        let [of_x, of_y] = units.get();
        let x = z[0] * of_x / WIDTH;
        residual[0] = (x * x + z[4] * z[4] - 1.0) / of_x;
        residual[1] = z[1] - z[4] / (of_y * WIDTH);
        residual[2] = z[2] - z[0];
        residual[3] = z[3] - z[1];
        let rows = [
            [2.0 * x / WIDTH, 0.0, 0.0, 0.0, 2.0 * z[4] / of_x],
            [0.0, 1.0, 0.0, 0.0, -1.0 / (of_y * WIDTH)],
            [-1.0, 0.0, 1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0, 1.0, 0.0],
        ];
        jacobian.copy_from_slice(rows.as_flattened());
        0
    });
    let settings = Settings { max_step_length: 0.2, ..Settings::default() };
    let range = ParameterRange::new(-2.0, 2.0).expect("in order");
    let level = (1.0_f64 - 1e-6).sqrt();
    let start = [1.0, level / WIDTH, 1.0, level / WIDTH, level];
    let mut follower = Follower::start(&mut problem, &start, StartDirection::Decreasing, range, settings)
        .expect("on the ellipse");
    let mut points = vec![follower.current().clone()];
    loop {
        let size = follower.current().point[0].abs();
        if rescales && !(0.25..=4.0).contains(&size) {
            let [of_x, of_y] = units.get();
            let wanted = [size.max(1e-3 / of_x), 1.0 / (WIDTH * of_y)];
            let factors = wanted.map(|factor| 2_f64.powi(factor.log2().round() as i32));
            units.set([of_x * factors[0], of_y * factors[1]]);
            follower.rescale(&factors);
        }
        match follower.step(&mut problem) {
            StepOutcome::Accepted => points.push(follower.state().in_first_units(follower.current())),
            StepOutcome::Stopped(reason) => return (points, reason),
        }
    }
}

#[test]
fn the_ellipse_closes_in_growing_units_with_both_folds_and_far_fewer_points() {
    let (points, reason) = follow_ellipse(true);
    assert_eq!(reason, PathStop::Closed);
    let folds: Vec<_> = points.iter().filter(|point| point.events.fold).collect();
    assert_eq!(folds.len(), 2);
    for (fold, expected) in folds.iter().zip([-1.0, 1.0]) {
        assert!((fold.point[4] - expected).abs() < 1e-12, "{:?}", fold.point);
        assert!(fold.point[0].abs() < 1e-6 * WIDTH, "{:?}", fold.point);
        assert!((WIDTH * fold.point[3] - expected).abs() < 1e-12, "{:?}", fold.point);
    }
    let farthest = points.iter().map(|point| point.point[0].abs()).fold(0.0, f64::max);
    assert!((farthest - WIDTH).abs() < 1.0, "{farthest}");
    assert!(points.len() < 1000, "{} points", points.len());
    let (all, _) = follow_ellipse(false);
    assert!(all.len() > 10 * points.len(), "{} points in the first units", all.len());
}
