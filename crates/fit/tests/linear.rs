//! Linear problems, whose intervals have closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::convert::Infallible;

use faer::Mat;
use hammerbeam_fit::{
    Bounds, Deviations, FitProblem, Identifiability, Inference, LeastSquaresSettings, fit, profile,
};

/// `y = X p` with unit standard deviations.
struct Linear {
    design: Mat<f64>,
    data: Vec<f64>,
}

impl FitProblem for Linear {
    type Error = Infallible;

    fn residuals(&mut self, p: &[f64]) -> Result<Vec<f64>, Infallible> {
        let row = |i: usize| -> f64 { p.iter().enumerate().map(|(j, p)| self.design[(i, j)] * p).sum() };
        Ok(self.data.iter().enumerate().map(|(i, d)| row(i) - d).collect())
    }

    fn jacobian(&mut self, _: &[f64]) -> Result<Mat<f64>, Infallible> {
        Ok(self.design.clone())
    }
}

/// A straight line `a + b x` through points at these abscissae.
fn line(places: &[f64], data: &[f64]) -> Linear {
    let design = Mat::from_fn(places.len(), 2, |i, j| if j == 0 { 1.0 } else { places[i] });
    Linear { design, data: data.to_vec() }
}

/// Simple linear regression: with `S = sum (x - mean)^2`, `b = sum (x - mean) y / S`, `var b = s^2/S`, `var
/// a = s^2 (1/m + mean^2/S)`, `cov = -s^2 mean/S`; and the quantiles of the tables.
#[test]
fn a_straight_line_has_the_intervals_of_the_textbook() {
    let (x, y) = ([0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 8.0], [1.1, 2.9, 5.2, 8.8, 11.1, 15.2, 16.7]);
    let (m, mean) = (7.0, x.iter().sum::<f64>() / 7.0);
    let spread: f64 = x.iter().map(|x| (x - mean).powi(2)).sum();
    let slope = x.iter().zip(&y).map(|(x, y)| (x - mean) * y).sum::<f64>() / spread;
    let offset = y.iter().sum::<f64>() / m - slope * mean;
    let squares: f64 = x.iter().zip(&y).map(|(x, y)| (offset + slope * x - y).powi(2)).sum();
    for (deviations, variance, quantile) in
        [(Deviations::Known, 1.0, 1.959_964), (Deviations::UpToFactor, squares / 5.0, 2.570_582)]
    {
        let settings = LeastSquaresSettings::new(deviations);
        let found = fit(&mut line(&x, &y), &[30.0, -9.0], &[Bounds::NONE; 2], &settings).unwrap();
        assert!(found.end.converged());
        // Converged to 1e-6 standard errors.
        assert!((found.parameters[0] - offset).abs() < 1e-6 && (found.parameters[1] - slope).abs() < 1e-6);
        let inference = Inference::of(&found, deviations, 0.95);
        let error = (variance / spread).sqrt();
        assert!((inference.standard_errors[1].unwrap() / error - 1.0).abs() < 1e-10);
        let of_offset = (variance * (1.0 / m + mean * mean / spread)).sqrt();
        assert!((inference.standard_errors[0].unwrap() / of_offset - 1.0).abs() < 1e-10);
        let correlation = -variance * mean / spread / (error * of_offset);
        assert!((inference.correlation[0][1].unwrap() - correlation).abs() < 1e-10);
        let interval = inference.intervals[1].unwrap();
        // The quantiles are printed to seven digits.
        assert!((interval.high - slope - quantile * error).abs() < 1e-5 * error);
        assert_eq!(inference.chi_squared.degrees_of_freedom, 5);
        assert!((inference.chi_squared.value - squares).abs() < 1e-9);
        // The profile of a linear model is its interval to first order; it is met to 1e-3 standard errors.
        let settings = (1, &[Bounds::NONE; 2][..]);
        let ends =
            profile(&mut line(&x, &y), &found, &inference, settings, &LeastSquaresSettings::new(deviations))
                .unwrap();
        assert!((ends.low.unwrap() - interval.low).abs() < 2e-3 * error);
        assert!((ends.high.unwrap() - interval.high).abs() < 2e-3 * error);
    }
}

/// Two parameters of which the data determine only the sum.
#[test]
fn dependent_parameters_have_no_standard_error_and_are_named_together() {
    let design = Mat::from_fn(4, 3, |i, j| if j == 2 { (i as f64 - 1.5).powi(2) } else { 1.0 + i as f64 });
    let mut problem = Linear { design, data: vec![2.0, 4.0, 7.0, 8.0] };
    let settings = LeastSquaresSettings::new(Deviations::Known);
    let found = fit(&mut problem, &[1.0, 1.0, 0.3], &[Bounds::NONE; 3], &settings).unwrap();
    assert!(found.end.converged());
    let inference = Inference::of(&found, Deviations::Known, 0.95);
    assert_eq!(inference.standard_errors[..2], [None, None]);
    assert!(inference.standard_errors[2].is_some());
    assert_eq!(inference.chi_squared.degrees_of_freedom, 2);
    let open = Identifiability::of(&found, &inference, &[1.0, 1.0, 1.0]).undetermined;
    assert_eq!(open[open.len() - 1].parameters.len(), 2);
    assert!(open[open.len() - 1].measure.is_infinite());
    let parts = &open[open.len() - 1].parts;
    // The direction (1, -1, 0)/sqrt(2).
    assert!((parts[0] + parts[1]).abs() < 1e-9 && (parts[0].abs() - 0.5_f64.sqrt()).abs() < 1e-9);
}

/// Two columns at a small angle have the collinearity index `1/sqrt(1 - cos)`, from the eigenvalues `1 -+
/// cos` of their unit product matrix.
#[test]
fn collinearity_index_of_two_columns_follows_from_their_angle() {
    let angle = 0.01_f64;
    let design = Mat::from_fn(3, 2, |i, j| match (i, j) {
        (0, 0) => 1e6,
        (0, 1) => 2e4 * angle.cos(),
        (1, 1) => 2e4 * angle.sin(),
        _ => 0.0,
    });
    let mut problem = Linear { design, data: vec![1e6, 1e4, 0.0] };
    let found =
        fit(&mut problem, &[1.0, 1.0], &[Bounds::NONE; 2], &LeastSquaresSettings::new(Deviations::Known))
            .unwrap();
    let inference = Inference::of(&found, Deviations::Known, 0.95);
    let found_directions = Identifiability::of(&found, &inference, &[1.0, 1.0]);
    let index = 1.0 / (1.0 - angle.cos()).sqrt();
    // Cancellation in one minus the cosine loses four digits.
    assert!(
        (found_directions.collinearity_index / index - 1.0).abs() < 1e-6,
        "{}",
        found_directions.collinearity_index
    );
    assert!(
        found_directions.undetermined.is_empty(),
        "the data are precise enough: {:?}",
        found_directions.undetermined
    );
    assert_eq!(found_directions.collinear.len(), 1);
    assert_eq!(found_directions.collinear[0].parameters.len(), 2);
}

#[test]
fn a_bound_holds_a_parameter_and_the_others_have_the_intervals_of_the_smaller_problem() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0], [1.0, 2.1, 2.9, 4.05]);
    let bounds = [Bounds { low: 1.5, high: 9.0 }, Bounds::NONE];
    let found =
        fit(&mut line(&x, &y), &[5.0, 5.0], &bounds, &LeastSquaresSettings::new(Deviations::Known)).unwrap();
    assert!(found.end.converged());
    assert_eq!((found.parameters[0], found.at_bound.as_slice()), (1.5, &[true, false][..]));
    // With the offset held at 1.5 the slope is sum x (y - 1.5) / sum x^2, with the variance 1/sum x^2.
    let squares: f64 = x.iter().map(|x| x * x).sum();
    let slope = x.iter().zip(&y).map(|(x, y)| x * (y - 1.5)).sum::<f64>() / squares;
    assert!((found.parameters[1] - slope).abs() < 1e-6);
    let inference = Inference::of(&found, Deviations::Known, 0.95);
    assert_eq!(inference.standard_errors[0], None);
    assert!((inference.standard_errors[1].unwrap() - squares.sqrt().recip()).abs() < 1e-10);
    assert_eq!(found.degrees_of_freedom(), Some(3));
}
