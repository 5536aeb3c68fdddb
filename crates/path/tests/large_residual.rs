//! A residual that is large where its correction is small: one more correction takes it away, and no step is
//! shortened for it.

use hammerbeam_path::{DenseProblem, ParameterRange, PathStop, Settings, StartDirection, follow};

/// `K (x - a l^2) = 0`. A step h of the tangent misses the path by `a h^2`, below the tolerance of
/// corrections, and leaves `K a h^2` in the residual, above its own.
#[test]
fn a_large_residual_of_a_small_correction_does_not_shorten_steps() {
    let (factor, bend) = (1e7, 1e-11);
    let mut problem = DenseProblem::new(1, move |z, residual, jacobian| {
        residual[0] = factor * (z[0] - bend * z[1] * z[1]);
        jacobian.copy_from_slice(&[factor, -2.0 * factor * bend * z[1]]);
        0
    });
    let settings = Settings { max_step_length: 1.0, initial_step: 1.0, ..Settings::default() };
    let range = ParameterRange::new(-1.0, 50.0).unwrap();
    let branch =
        follow(&mut problem, &[0.0, 0.0], StartDirection::Increasing, range, settings.clone()).unwrap();
    assert_eq!(branch.stop, PathStop::RangeEnd);
    assert!(branch.points.iter().all(|point| point.residual_norm <= settings.residual_tolerance));
    assert!(branch.points.len() < 60, "{} points", branch.points.len());
    assert_eq!(branch.counters.rejected, 0);
}

/// `x = K sin l`, with lengths so measured that the tolerance is a tenth: across the path lies `l` nearly
/// alone, which is then as good as its own tolerance asks.
#[test]
fn over_a_wide_range_the_parameter_is_known_to_a_part_of_itself() {
    let factor = 1e3;
    let largest = |parameter_tolerance: f64| {
        let mut problem = DenseProblem::new(1, move |z, residual, jacobian| {
            residual[0] = z[0] - factor * z[1].sin();
            jacobian.copy_from_slice(&[1.0, -factor * z[1].cos()]);
            0
        });
        let settings = Settings {
            max_step_length: 100.0,
            initial_step: 10.0,
            correction_tolerance: 0.1,
            sheet_distance: 10.0,
            residual_tolerance: 100.0,
            residual_wanted: 100.0,
            parameter_tolerance,
            ..Settings::default()
        };
        let range = ParameterRange::new(0.1, 1.4).unwrap();
        let start = [factor * 0.1_f64.sin(), 0.1];
        let points =
            follow(&mut problem, &start, StartDirection::Increasing, range, settings).unwrap().points;
        points.iter().map(|point| (point.point[0] / factor - point.point[1].sin()).abs()).fold(0.0, f64::max)
    };
    assert!(largest(f64::INFINITY) > 1e-6, "{:e}", largest(f64::INFINITY));
    assert!(largest(1e-11) <= 2e-11, "{:e}", largest(1e-11));
}
