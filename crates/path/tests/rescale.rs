//! A path whose unknowns grow by orders of magnitude is followed in units that grow with them.

use std::cell::Cell;

use hammerbeam_path::{
    ContinuationPoint, DenseProblem, Follower, ParameterRange, PathStop, Settings, StartDirection,
    StepOutcome,
};

const WIDTH: f64 = 1000.0;

/// The ellipse `(x/1000)² + λ² = 1` from `x = 1` on, in units that stay within a factor of four of `x`;
/// points in the first units.
fn follow_ellipse(rescales: bool) -> (Vec<ContinuationPoint>, PathStop) {
    let unit = Cell::new(1.0);
    let mut problem = DenseProblem::new(1, |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
        let x = z[0] * unit.get() / WIDTH;
        residual[0] = (x * x + z[1] * z[1] - 1.0) / unit.get();
        jacobian.copy_from_slice(&[2.0 * x / WIDTH, 2.0 * z[1] / unit.get()]);
        0
    });
    let settings = Settings { max_step_length: 0.2, ..Settings::default() };
    let range = ParameterRange::new(-2.0, 2.0).expect("in order");
    let start = [1.0, (1.0_f64 - 1e-6).sqrt()];
    let mut follower = Follower::start(&mut problem, &start, StartDirection::Decreasing, range, settings)
        .expect("on the ellipse");
    let mut points = vec![follower.current().clone()];
    loop {
        let size = follower.current().point[0].abs();
        if rescales && !(0.25..=4.0).contains(&size) {
            let factor = 2_f64.powi(size.max(1e-3 / unit.get()).log2().round() as i32);
            unit.set(unit.get() * factor);
            follower.rescale(factor);
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
        assert!((fold.point[1] - expected).abs() < 1e-12, "{:?}", fold.point);
        assert!(fold.point[0].abs() < 1e-6 * WIDTH, "{:?}", fold.point);
    }
    let farthest = points.iter().map(|point| point.point[0].abs()).fold(0.0, f64::max);
    assert!((farthest - WIDTH).abs() < 1.0, "{farthest}");
    assert!(points.len() < 1000, "{} points", points.len());
    let (all, _) = follow_ellipse(false);
    assert!(all.len() > 10 * points.len(), "{} points in the first units", all.len());
}
