//! The unit in which a figure shows frequencies: data are in hertz, and an axis has a factor.

use std::f64::consts::TAU;

use crate::text::plain_number;

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

    /// Label of an axis.
    pub(crate) fn label(self, what: &str) -> String {
        format!("{what} ({})", self.symbol())
    }

    /// A frequency to nine digits at most, with its unit.
    #[must_use]
    pub fn words(self, frequency_hz: f64) -> String {
        format!("{} {}", plain_number(self.factor() * frequency_hz), self.symbol())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_two_pi_rad() {
        assert_eq!(FrequencyUnit::Hertz.words(36.2), "36.2 Hz");
        assert_eq!(FrequencyUnit::RadPerSecond.words(31.4 / TAU), "31.4 rad/s");
    }
}
