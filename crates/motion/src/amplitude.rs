//! An amplitude that depends on the frequency, as a shaker has it: a table, and the monotone cubic through
//! it.
//!
//! Between the knots `f_k < f < f_{k+1}`, with `h = f_{k+1} - f_k`, `t = (f - f_k)/h`, values `a_k` and
//! slopes `m_k`, the curve is Hermite's cubic
//!
//! `a = (1 + 2t)(1 - t)^2 a_k + t^2 (3 - 2t) a_{k+1} + h (t (1 - t)^2 m_k - t^2 (1 - t) m_{k+1})`.
//!
//! The slope at a knot is the weighted harmonic mean of the secants beside it, zero where they have different
//! signs; at the ends it follows from three points, limited so that nothing overshoots. So the curve and its
//! derivative are continuous, which is what following a path needs, and it rises and falls where the table
//! does: noise of a measured table makes no new maxima, as a spline of continuous curvature would.
//!
//! Beyond its ends the table goes on as `a exp(m (f - f_end)/a)`, which is positive and has the value and
//! slope of the end.
//!
//! # Source
//! Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984), 300-304; the ends as in Fritsch and Carlson,
//! SIAM J. Numer. Anal. 17 (1980), 238-246, in the three-point form of Moler.

/// Why a table is no amplitude.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum AmplitudeError {
    /// A curve needs two points.
    #[error("an amplitude over the frequency needs two points at least, there are {found}")]
    TooFew { found: usize },
    /// A number that makes no sense.
    #[error("point {index} is [{frequency_hz} Hz, {amplitude}]: both must be finite and more than 0")]
    NotPositive { index: usize, frequency_hz: f64, amplitude: f64 },
    /// Frequencies do not rise.
    #[error(
        "point {index} is at {frequency_hz} Hz, the one before it at {before_hz} Hz: frequencies must rise"
    )]
    NotRising { index: usize, frequency_hz: f64, before_hz: f64 },
}

/// An amplitude over the frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct AmplitudeCurve {
    /// `[f_k, a_k]`.
    knots: Vec<[f64; 2]>,
    /// `m_k` [1/Hz].
    slopes: Vec<f64>,
}

impl AmplitudeCurve {
    /// Through points `[frequency in Hz, amplitude]`.
    ///
    /// # Errors
    /// [`AmplitudeError`].
    pub fn new(knots: Vec<[f64; 2]>) -> Result<Self, AmplitudeError> {
        if knots.len() < 2 {
            return Err(AmplitudeError::TooFew { found: knots.len() });
        }
        for (index, &[frequency_hz, amplitude]) in (1..).zip(&knots) {
            let positive = |value: f64| value.is_finite() && value > 0.0;
            if !positive(frequency_hz) || !positive(amplitude) {
                return Err(AmplitudeError::NotPositive { index, frequency_hz, amplitude });
            }
        }
        for (index, pair) in (2..).zip(knots.windows(2)) {
            let ([before_hz, _], [frequency_hz, _]) = (pair[0], pair[1]);
            if frequency_hz <= before_hz {
                return Err(AmplitudeError::NotRising { index, frequency_hz, before_hz });
            }
        }
        let slopes = slopes(&knots);
        Ok(Self { knots, slopes })
    }

    /// The table.
    #[must_use]
    pub fn knots(&self) -> &[[f64; 2]] {
        &self.knots
    }

    /// Amplitude and its derivative by the frequency [1/Hz].
    #[must_use]
    pub fn at(&self, frequency_hz: f64) -> (f64, f64) {
        let last = self.knots.len() - 1;
        if frequency_hz <= self.knots[0][0] {
            return self.beyond(0, frequency_hz);
        }
        if frequency_hz >= self.knots[last][0] {
            return self.beyond(last, frequency_hz);
        }
        let k = self.knots.partition_point(|knot| knot[0] <= frequency_hz) - 1;
        let ([f, a], [g, b]) = (self.knots[k], self.knots[k + 1]);
        let (m, n, h) = (self.slopes[k], self.slopes[k + 1], g - f);
        let t = (frequency_hz - f) / h;
        let s = 1.0 - t;
        let value = (1.0 + 2.0 * t) * s * s * a + t * t * (3.0 - 2.0 * t) * b + h * t * s * (s * m - t * n);
        let slope = 6.0 * t * s * (b - a) / h + s * (s - 2.0 * t) * m + t * (t - 2.0 * s) * n;
        (value, slope)
    }

    fn beyond(&self, end: usize, frequency_hz: f64) -> (f64, f64) {
        let ([f, a], m) = (self.knots[end], self.slopes[end]);
        let value = a * (m * (frequency_hz - f) / a).exp();
        (value, value * m / a)
    }
}

fn slopes(knots: &[[f64; 2]]) -> Vec<f64> {
    let widths: Vec<f64> = knots.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let secants: Vec<f64> =
        knots.windows(2).zip(&widths).map(|(pair, h)| (pair[1][1] - pair[0][1]) / h).collect();
    let last = knots.len() - 1;
    if last == 1 {
        return vec![secants[0]; 2];
    }
    let inner = |k: usize| {
        let (left, right) = (secants[k - 1], secants[k]);
        if left * right <= 0.0 {
            return 0.0;
        }
        let (w, v) = (2.0 * widths[k] + widths[k - 1], widths[k] + 2.0 * widths[k - 1]);
        (w + v) / (w / left + v / right)
    };
    let mut slopes = vec![end_slope([widths[0], widths[1]], [secants[0], secants[1]])];
    slopes.extend((1..last).map(inner));
    slopes.push(end_slope([widths[last - 1], widths[last - 2]], [secants[last - 1], secants[last - 2]]));
    slopes
}

/// Slope at an end from the two intervals next to it, the nearer first.
fn end_slope([h, g]: [f64; 2], [near, far]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h + g) * near - h * far) / (h + g);
    if slope * near <= 0.0 {
        0.0
    } else if near * far <= 0.0 && slope.abs() > 3.0 * near.abs() {
        3.0 * near
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaker() -> AmplitudeCurve {
        AmplitudeCurve::new(vec![[20.0, 5.0], [31.0, 4.9], [33.0, 4.95], [50.0, 4.4], [70.0, 3.86]]).unwrap()
    }

    #[test]
    fn curve_goes_through_its_points_and_stays_between_them() {
        let curve = shaker();
        for &[f, a] in curve.knots() {
            assert!((curve.at(f).0 - a).abs() < 1e-14);
        }
        for pair in curve.knots().windows(2) {
            let (low, high) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
            for k in 0..=100 {
                let f = pair[0][0] + (pair[1][0] - pair[0][0]) * f64::from(k) / 100.0;
                assert!((low - 1e-12..=high + 1e-12).contains(&curve.at(f).0), "{f} Hz");
            }
        }
    }

    #[test]
    fn derivative_is_that_of_the_curve_inside_and_beyond() {
        let curve = shaker();
        for f in [5.0, 19.9, 20.7, 30.0, 32.0, 33.5, 49.0, 60.0, 69.0, 70.5, 140.0] {
            let step = 1e-4;
            let difference = (curve.at(f + step).0 - curve.at(f - step).0) / (2.0 * step);
            // The third derivative of the cubics is below 0.1; rounding 1e-15 * 5 / 1e-4.
            assert!((curve.at(f).1 - difference).abs() < 1e-9, "{f} Hz: {} {difference}", curve.at(f).1);
        }
        for &[f, _] in curve.knots() {
            let ((a, m), (b, n)) = (curve.at(f - 1e-9), curve.at(f + 1e-9));
            assert!((a - b).abs() < 1e-8 && (m - n).abs() < 1e-8, "continuous at {f} Hz");
        }
        assert!(curve.at(1e3).0 > 0.0 && curve.at(1e-3).0 > 0.0);
    }

    #[test]
    fn two_points_make_a_straight_line() {
        let line = AmplitudeCurve::new(vec![[10.0, 1.0], [20.0, 3.0]]).unwrap();
        assert!((line.at(14.0).0 - 1.8).abs() < 1e-14 && (line.at(14.0).1 - 0.2).abs() < 1e-14);
    }

    #[test]
    fn tables_that_are_none_are_refused() {
        for knots in [
            vec![],
            vec![[1.0, 1.0]],
            vec![[1.0, 1.0], [1.0, 2.0]],
            vec![[2.0, 1.0], [1.0, 2.0]],
            vec![[1.0, 0.0], [2.0, 2.0]],
            vec![[-1.0, 1.0], [2.0, 2.0]],
            vec![[1.0, f64::NAN], [2.0, 2.0]],
        ] {
            assert!(AmplitudeCurve::new(knots.clone()).is_err(), "{knots:?}");
        }
    }
}
