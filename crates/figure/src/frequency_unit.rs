//! The unit in which a figure shows frequencies: data are in hertz, and an axis has a factor.

use std::f64::consts::TAU;

use crate::{axis_unit::AxisUnit, text::plain_number};

/// Unit of the frequencies on axes and in words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrequencyUnit {
    /// Hz.
    #[default]
    Hertz,
    /// rad/s, `2 pi` of which to a hertz.
    RadPerSecond,
}

impl FrequencyUnit {
    /// What is shown for one hertz.
    #[must_use]
    pub fn factor(self) -> f64 {
        match self {
            Self::Hertz => 1.0,
            Self::RadPerSecond => TAU,
        }
    }

    /// Its symbol.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Hertz => "Hz",
            Self::RadPerSecond => "rad/s",
        }
    }

    /// The unit of frequencies up to a highest one: hertz have the prefix that suits it.
    pub(crate) fn up_to(self, highest_hz: f64) -> AxisUnit {
        match self {
            Self::Hertz => AxisUnit::of("Hz", highest_hz),
            Self::RadPerSecond => AxisUnit { symbol: self.symbol().to_owned(), factor: self.factor() },
        }
    }

    /// A frequency to nine digits at most, with the unit that suits it.
    #[must_use]
    pub fn words(self, frequency_hz: f64) -> String {
        let unit = self.up_to(frequency_hz);
        format!("{} {}", plain_number(unit.factor * frequency_hz), unit.symbol)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_two_pi_rad() {
        assert_eq!(FrequencyUnit::Hertz.words(36.2), "36.2 Hz");
        assert_eq!(FrequencyUnit::Hertz.words(64_600.0), "64.6 kHz");
        assert_eq!(FrequencyUnit::RadPerSecond.words(31.4 / TAU), "31.4 rad/s");
    }
}
