//! Curved problems: published ones, failures, and profiles.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use faer::Mat;
use hammerbeam_fit::{
    Bounds, Deviations, FitEnd, FitError, FitProblem, Inference, LeastSquaresSettings, fit, profile,
};

#[derive(Debug, thiserror::Error)]
#[error("there is no model at {at}")]
struct Nowhere {
    at: f64,
}

type Curve = fn(f64, &[f64]) -> (f64, Vec<f64>);

/// A curve with its derivatives, and points.
struct Points {
    curve: Curve,
    points: Vec<(f64, f64)>,
    deviation: f64,
}

impl FitProblem for Points {
    type Error = Nowhere;

    fn residuals(&mut self, p: &[f64]) -> Result<Vec<f64>, Nowhere> {
        if p.iter().any(|value| *value < -1e3) {
            return Err(Nowhere { at: p[0] });
        }
        let residual = |(x, y): &(f64, f64)| ((self.curve)(*x, p).0 - y) / self.deviation;
        Ok(self.points.iter().map(residual).collect())
    }

    fn jacobian(&mut self, p: &[f64]) -> Result<Mat<f64>, Nowhere> {
        let rows: Vec<Vec<f64>> = self.points.iter().map(|(x, _)| (self.curve)(*x, p).1).collect();
        Ok(Mat::from_fn(rows.len(), p.len(), |i, j| rows[i][j] / self.deviation))
    }
}

/// `b1 (1 - exp(-b2 x))`.
fn saturation(x: f64, b: &[f64]) -> (f64, Vec<f64>) {
    let decay = (-b[1] * x).exp();
    (b[0] * (1.0 - decay), vec![1.0 - decay, b[0] * x * decay])
}

/// Misra1a of the Statistical Reference Datasets of NIST, with both of its starts: certified values, standard
/// deviations and residual sum of squares.
#[test]
fn misra1a_has_its_certified_values() {
    let x = [77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0];
    let y =
        [10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78];
    let points: Vec<(f64, f64)> = x.into_iter().zip(y).collect();
    for start in [[500.0, 1e-4], [250.0, 5e-4]] {
        let mut problem = Points { curve: saturation, points: points.clone(), deviation: 1.0 };
        let settings = LeastSquaresSettings::new(Deviations::UpToFactor);
        let found = fit(&mut problem, &start, &[Bounds::NONE; 2], &settings).unwrap();
        assert!(found.end.converged());
        let inference = Inference::of(&found, Deviations::UpToFactor, 0.95);
        // Converged to 1e-6 standard errors, which are 1 % of the values.
        let close = |found: f64, certified: f64| {
            assert!((found / certified - 1.0).abs() < 1e-7, "{found} {certified}");
        };
        close(found.parameters[0], 2.389_421_291_8e2);
        close(found.parameters[1], 5.501_564_318_1e-4);
        close(inference.standard_errors[0].unwrap(), 2.707_007_524_1);
        close(inference.standard_errors[1].unwrap(), 7.266_868_844_2e-6);
        close(found.chi_squared(), 1.245_513_889_4e-1);
    }
}

/// Without noise the parameters of the data are recovered from distant initial values.
#[test]
fn data_without_noise_give_their_parameters_back() {
    let truth = [3.0, 0.7];
    let points = (1..9).map(|k| (f64::from(k), saturation(f64::from(k), &truth).0)).collect();
    let mut problem = Points { curve: saturation, points, deviation: 0.01 };
    let found =
        fit(&mut problem, &[1.0, 0.05], &[Bounds::NONE; 2], &LeastSquaresSettings::new(Deviations::Known))
            .unwrap();
    // 1e-6 standard errors, of about 0.01.
    assert!((found.parameters[0] - truth[0]).abs() < 1e-7 && (found.parameters[1] - truth[1]).abs() < 1e-7);
}

/// `y = p^2`: the interval of p follows from the interval of p^2 by its root, and is not symmetric.
#[test]
fn a_profile_follows_the_curve_of_the_model() {
    let square: Curve = |_, p| (p[0] * p[0], vec![2.0 * p[0]]);
    let mut problem = Points { curve: square, points: vec![(0.0, 4.0)], deviation: 1.0 };
    let bounds = [Bounds { low: 0.0, high: 10.0 }];
    let settings = LeastSquaresSettings::new(Deviations::Known);
    let found = fit(&mut problem, &[1.0], &bounds, &settings).unwrap();
    let inference = Inference::of(&found, Deviations::Known, 0.95);
    let ends = profile(&mut problem, &found, &inference, (0, &bounds), &settings).unwrap();
    let q = inference.quantile;
    // Met to 1e-3 standard errors of a quarter.
    assert!((ends.low.unwrap() - (4.0 - q).sqrt()).abs() < 1e-3);
    assert!((ends.high.unwrap() - (4.0 + q).sqrt()).abs() < 1e-3);
    let first = inference.intervals[0].unwrap();
    assert!((first.low - (2.0 - q / 4.0)).abs() < 1e-6, "to first order it is symmetric");
}

#[test]
fn a_profile_that_never_rises_has_an_open_end() {
    // y = exp(-p) tends to 0, which is within two standard deviations of the datum.
    let decay: Curve = |_, p| ((-p[0]).exp(), vec![-(-p[0]).exp()]);
    let mut problem = Points { curve: decay, points: vec![(0.0, 0.1)], deviation: 0.1 };
    let settings = LeastSquaresSettings::new(Deviations::Known);
    let found = fit(&mut problem, &[1.0], &[Bounds::NONE], &settings).unwrap();
    let inference = Inference::of(&found, Deviations::Known, 0.95);
    let ends = profile(&mut problem, &found, &inference, (0, &[Bounds::NONE]), &settings).unwrap();
    assert_eq!(ends.high, None);
    assert!((ends.low.unwrap() + (0.1 + 0.1 * inference.quantile).ln()).abs() < 1e-3);
}

#[test]
fn a_model_that_falls_forever_does_not_converge() {
    let falling: Curve =
        |_, p| (1.0 + 1.0 / (1.0 + p[0].abs()), vec![-p[0].signum() / (1.0 + p[0].abs()).powi(2)]);
    let mut problem = Points { curve: falling, points: vec![(0.0, 0.0)], deviation: 1e-9 };
    let settings =
        LeastSquaresSettings { max_iterations: 20, ..LeastSquaresSettings::new(Deviations::Known) };
    let found = fit(&mut problem, &[1.0], &[Bounds::NONE], &settings).unwrap();
    assert!(matches!(found.end, FitEnd::OutOfIterations { .. }), "{:?}", found.end);
    assert_eq!(found.iterations, 20);
}

#[test]
fn derivatives_of_the_wrong_sign_stall() {
    let wrong: Curve = |_, p| (p[0] + p[0].powi(3), vec![-1.0 - 3.0 * p[0] * p[0]]);
    let mut problem = Points { curve: wrong, points: vec![(0.0, 5.0)], deviation: 0.1 };
    let found =
        fit(&mut problem, &[1.0], &[Bounds::NONE], &LeastSquaresSettings::new(Deviations::Known)).unwrap();
    assert!(!found.end.converged(), "{:?}", found.end);
}

/// The minimum is at -2000, where the model of these tests does not exist.
#[test]
fn a_minimum_outside_the_model_is_out_of_reach() {
    let straight: Curve = |_, p| (p[0], vec![1.0]);
    let mut problem = Points { curve: straight, points: vec![(0.0, -2000.0)], deviation: 0.1 };
    let found =
        fit(&mut problem, &[1.0], &[Bounds::NONE], &LeastSquaresSettings::new(Deviations::Known)).unwrap();
    assert!(matches!(found.end, FitEnd::Blocked { .. }), "{:?}", found.end);
    assert!((-1000.0..-900.0).contains(&found.parameters[0]), "{:?}", found.parameters);
}

#[test]
fn no_model_and_no_numbers_are_errors() {
    let settings = LeastSquaresSettings::new(Deviations::Known);
    let nan: Curve = |_, _| (f64::NAN, vec![f64::NAN]);
    let mut problem = Points { curve: nan, points: vec![(0.0, 5.0)], deviation: 0.1 };
    assert!(matches!(fit(&mut problem, &[1.0], &[Bounds::NONE], &settings), Err(FitError::NotFinite)));
    let fine: Curve = |_, p| (p[0], vec![1.0]);
    let mut problem = Points { curve: fine, points: vec![(0.0, 5.0)], deviation: 0.1 };
    let nowhere = fit(&mut problem, &[-1e4], &[Bounds::NONE], &settings);
    assert!(matches!(nowhere, Err(FitError::Start { .. })));
}
