//! A factor of a load that depends on the frequency: a table over it, a power of it, or both.
//!
//! `c(f) W^p` with the curve `c` through a table (`amplitude.rs`), 1 without one, and `W = 2 pi f`. An
//! unbalance `U` of a rotor makes forces of the amplitude `U (m W)^2`, so `p = 2`; an acceleration that is
//! prescribed makes a displacement `-a/(m W)^2`, so `p = -2`.

use std::f64::consts::TAU;

use crate::AmplitudeCurve;

/// A factor that depends on the frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FrequencyFactor {
    curve: Option<AmplitudeCurve>,
    power: i32,
}

impl From<AmplitudeCurve> for FrequencyFactor {
    fn from(curve: AmplitudeCurve) -> Self {
        Self { curve: Some(curve), power: 0 }
    }
}

impl FrequencyFactor {
    /// The square of the circular frequency: of the force of an unbalance.
    pub const SQUARE: Self = Self { curve: None, power: 2 };
    /// Its inverse: of a displacement whose acceleration is given.
    pub const INVERSE_SQUARE: Self = Self { curve: None, power: -2 };

    /// The same times the curve through a table.
    #[must_use]
    pub fn with_curve(self, curve: AmplitudeCurve) -> Self {
        Self { curve: Some(curve), ..self }
    }

    /// The factor and its derivative by the frequency [1/Hz].
    #[must_use]
    pub fn at(&self, frequency_hz: f64) -> (f64, f64) {
        let (value, slope) = self.curve.as_ref().map_or((1.0, 0.0), |curve| curve.at(frequency_hz));
        if self.power == 0 {
            return (value, slope);
        }
        let power = (TAU * frequency_hz).powi(self.power);
        let rise = f64::from(self.power) * power / frequency_hz;
        (value * power, slope * power + value * rise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> AmplitudeCurve {
        AmplitudeCurve::new(vec![[3.0, 1.3], [5.0, 1.1], [7.0, 0.6]]).unwrap()
    }

    #[test]
    fn without_a_power_it_is_the_curve_to_the_last_bit() {
        assert_eq!(FrequencyFactor::from(curve()).at(4.3), curve().at(4.3));
    }

    #[test]
    fn powers_are_those_of_the_circular_frequency() {
        let square = (TAU * 2.0).powi(2);
        assert!((FrequencyFactor::SQUARE.at(2.0).0 / square - 1.0).abs() < 1e-15);
        assert!((FrequencyFactor::INVERSE_SQUARE.at(2.0).0 * square - 1.0).abs() < 1e-15);
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        for factor in [FrequencyFactor::SQUARE, FrequencyFactor::INVERSE_SQUARE] {
            for factor in [factor.clone(), factor.with_curve(curve())] {
                for f in [2.5, 4.4, 6.1, 8.0] {
                    let step = 1e-4;
                    let difference = (factor.at(f + step).0 - factor.at(f - step).0) / (2.0 * step);
                    // Rounding 1e-16/1e-4, and the third derivative times the square of the step.
                    assert!((factor.at(f).1 / difference - 1.0).abs() < 1e-7, "{f} Hz");
                }
            }
        }
    }
}
