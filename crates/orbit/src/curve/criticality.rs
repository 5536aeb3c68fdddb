//! The test function that distinguishes sub- from supercritical bifurcations, over places where its value is
//! not known.
//!
//! Beside a grazing no coefficient can be computed. There the test has no value and keeps its sign, and where
//! it has one again, whatever that is, it starts anew with that sign: no change behind such a place is taken
//! for a zero.

use hammerbeam_path::TestValue;

/// What is known at the last point of the curve, and the last value that was asked for.
#[derive(Debug, Clone)]
pub(super) struct Criticality {
    /// The test is this times the coefficient, which is known; `None` where it is not.
    orientation: Option<f64>,
    /// Sign of the test, +1 or -1.
    sign: f64,
    /// Coefficient at a point.
    asked: Option<(Vec<f64>, Option<f64>)>,
}

impl Criticality {
    pub fn new() -> Self {
        Self { orientation: None, sign: 1.0, asked: None }
    }

    /// The coefficient at a point, if that was the last that was asked for.
    pub fn known_at(&self, point: &[f64]) -> Option<Option<f64>> {
        self.asked.as_ref().filter(|(at, _)| at == point).map(|(_, coefficient)| *coefficient)
    }

    pub fn keep(&mut self, point: &[f64], coefficient: Option<f64>) {
        self.asked = Some((point.to_vec(), coefficient));
    }

    /// The test function where the coefficient is this; infinite where there is none.
    pub fn test(&self, coefficient: Option<f64>) -> TestValue {
        let value = match (coefficient, self.orientation) {
            (Some(coefficient), Some(orientation)) => orientation * coefficient,
            (Some(coefficient), None) => self.sign * coefficient.abs(),
            (None, _) => self.sign * f64::INFINITY,
        };
        TestValue::sign_change(value, u32::from(value < 0.0))
    }

    /// Adapts it to an accepted point.
    ///
    /// * `at_zero`: whether it is a zero, where the sign of the coefficient is rounding.
    pub fn renew(&mut self, coefficient: Option<f64>, at_zero: bool) {
        if at_zero {
            self.sign = -self.sign;
            return;
        }
        let negative = self.test(coefficient).count == 1;
        self.sign = if negative { -1.0 } else { 1.0 };
        self.orientation = coefficient.map(|c| if (c < 0.0) == negative { 1.0 } else { -1.0 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_behind_a_place_without_value_is_no_zero() {
        let mut criticality = Criticality::new();
        let mut counts = Vec::new();
        for coefficient in [Some(-0.5), Some(-0.2), None, Some(0.3), Some(0.1), Some(-0.1), None, Some(-0.2)]
        {
            counts.push(criticality.test(coefficient).count);
            criticality.renew(coefficient, false);
        }
        assert_eq!(counts, [0, 0, 0, 0, 0, 1, 1, 1]);
        assert_eq!(criticality.test(Some(0.2)).count, 0);
    }
}
