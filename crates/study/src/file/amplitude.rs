//! Amplitude of the excitation: one number, or a table over the frequency.

use hammerbeam_motion::AmplitudeCurve;
use serde::Serialize;

use crate::document::{Quantity, TomlTable, Value, quantity};

/// Amplitude of the excitation, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Amplitude {
    /// The same at every frequency.
    Constant(f64),
    /// Points `[frequency in Hz, amplitude]`, joined by a monotone cubic.
    OverFrequency(Vec<[f64; 2]>),
}

impl Amplitude {
    /// The amplitude at every frequency, if it is one.
    #[must_use]
    pub const fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(amplitude) => Some(*amplitude),
            Self::OverFrequency(_) => None,
        }
    }

    /// The largest amplitude.
    #[must_use]
    pub fn largest(&self) -> f64 {
        match self {
            Self::Constant(amplitude) => *amplitude,
            Self::OverFrequency(points) => points.iter().map(|point| point[1]).fold(0.0, f64::max),
        }
    }

    /// Amplitude at a frequency.
    #[must_use]
    pub fn at(&self, frequency_hz: f64) -> f64 {
        match self {
            Self::Constant(amplitude) => *amplitude,
            Self::OverFrequency(_) => self.curve().map_or(0.0, |curve| curve.at(frequency_hz).0),
        }
    }

    /// The curve through the table.
    #[must_use]
    pub fn curve(&self) -> Option<AmplitudeCurve> {
        match self {
            Self::Constant(_) => None,
            Self::OverFrequency(points) => AmplitudeCurve::new(points.clone()).ok(),
        }
    }

    /// The ends of a table [Hz].
    #[must_use]
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Constant(_) => None,
            Self::OverFrequency(points) => Some([points.first()?[0], points.last()?[0]]),
        }
    }
}

/// Refuses a table that does not cover the range of the frequency [Hz]: what a shaker does beyond it is not
/// known.
pub(super) fn check_range(
    table: &TomlTable<'_>,
    key: &'static str,
    amplitude: &Amplitude,
    [low, high]: [f64; 2],
) {
    if let Some([first, last]) = amplitude.ends()
        && (first > low || last < high)
    {
        let message = format!(
            "`{key}` is given from {first} to {last} Hz, the excitation runs from {low} to {high} Hz"
        );
        table.problem(key, message, vec!["allowed: a table that covers `frequency_hz`".to_owned()]);
    }
}

pub(super) fn read(value: &Value<'_>, amplitude: &Quantity) -> Option<Amplitude> {
    if !value.is_list() {
        return value.number(amplitude).map(Amplitude::Constant);
    }
    let points = value.array_of("pairs [frequency in Hz, amplitude]")?;
    let pair = |point: &Value<'_>| {
        let entries = point.array_of("frequency and amplitude")?;
        let [frequency, value] = &entries[..] else {
            let message = format!("a point of the amplitude has {} entries", entries.len());
            point.problem(message, vec!["allowed: [frequency in Hz, amplitude]".to_owned()]);
            return None;
        };
        Some([frequency.number(&quantity::FREQUENCY)?, value.number(amplitude)?])
    };
    let points: Vec<Option<[f64; 2]>> = points.iter().map(pair).collect();
    let points = points.into_iter().collect::<Option<Vec<[f64; 2]>>>()?;
    match AmplitudeCurve::new(points.clone()) {
        Ok(_) => Some(Amplitude::OverFrequency(points)),
        Err(error) => {
            let help = "allowed: two points [frequency in Hz, amplitude] at least, with rising frequencies";
            value.problem(error.to_string(), vec![help.to_owned()]);
            None
        }
    }
}
