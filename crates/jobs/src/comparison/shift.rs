//! How measured frequencies and values become those of the model.

/// How measured frequencies become those of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrequencyShift {
    /// `f' = c f`.
    Factor(f64),
    /// `f' = f + d` [Hz].
    Offset(f64),
}

impl FrequencyShift {
    /// The frequency of the model [Hz].
    #[must_use]
    pub fn apply(self, frequency_hz: f64) -> f64 {
        match self {
            Self::Factor(factor) => factor * frequency_hz,
            Self::Offset(offset_hz) => frequency_hz + offset_hz,
        }
    }
}

/// Shift of frequencies and factor on values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// Of the frequencies.
    pub frequency: FrequencyShift,
    /// Factor on measured values.
    pub amplitude_factor: f64,
}

impl Shift {
    /// * `is_offset`: whether the number for the frequency is an offset [Hz] and no factor.
    /// * `log_amplitude`: natural logarithm of the factor on measured values.
    pub(super) fn new(is_offset: bool, frequency: f64, log_amplitude: f64) -> Self {
        let frequency =
            if is_offset { FrequencyShift::Offset(frequency) } else { FrequencyShift::Factor(frequency) };
        Self { frequency, amplitude_factor: log_amplitude.exp() }
    }
}
