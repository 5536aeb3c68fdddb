//! Measured points: the largest values at each excitation frequency.

use crate::{finding::RecordFinding, unit::MeasuredQuantity};

/// Largest absolute values at one excitation frequency, in SI.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeasuredMaxima {
    /// Of the displacement [m].
    pub displacement: Option<f64>,
    /// Of the velocity [m/s].
    pub velocity: Option<f64>,
    /// Of the acceleration [m/s²].
    pub acceleration: Option<f64>,
    /// Of the contact force [N].
    pub force: Option<f64>,
}

impl MeasuredMaxima {
    /// The maximum of a quantity, if it was measured.
    #[must_use]
    pub const fn of(&self, quantity: MeasuredQuantity) -> Option<f64> {
        match quantity {
            MeasuredQuantity::Displacement => self.displacement,
            MeasuredQuantity::Velocity => self.velocity,
            MeasuredQuantity::Acceleration => self.acceleration,
            MeasuredQuantity::Force => self.force,
            _ => None,
        }
    }

    /// Sets the maximum of a quantity; other quantities are ignored.
    pub const fn set(&mut self, quantity: MeasuredQuantity, value: f64) {
        match quantity {
            MeasuredQuantity::Displacement => self.displacement = Some(value),
            MeasuredQuantity::Velocity => self.velocity = Some(value),
            MeasuredQuantity::Acceleration => self.acceleration = Some(value),
            MeasuredQuantity::Force => self.force = Some(value),
            _ => {}
        }
    }
}

/// Kind of a measured motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredKind {
    /// It repeats.
    Periodic {
        /// Motion period over excitation period, if it is known.
        period_multiple: Option<u32>,
    },
    /// It does not repeat.
    Aperiodic,
    /// The measurement does not decide it.
    Doubtful,
    /// Not specified.
    Unknown,
}

impl MeasuredKind {
    /// Its name in tables and reports.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Periodic { .. } => "periodic",
            Self::Aperiodic => "aperiodic",
            Self::Doubtful => "doubtful",
            Self::Unknown => "unknown",
        }
    }

    /// Motion period over excitation period, if it is known.
    #[must_use]
    pub const fn period_multiple(self) -> Option<u32> {
        match self {
            Self::Periodic { period_multiple } => period_multiple,
            _ => None,
        }
    }
}

/// What was measured at one excitation frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPoint {
    /// Its source: line of the table, or name of the record.
    pub origin: String,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Largest absolute values.
    pub maxima: MeasuredMaxima,
    /// Kind of the motion.
    pub kind: MeasuredKind,
    /// Quantity of the excitation, and its amplitude in SI.
    pub excitation: Option<(MeasuredQuantity, f64)>,
}

impl MeasuredPoint {
    /// Amplitude of the excitation as a displacement [m] (from a harmonic velocity or acceleration) or a
    /// force [N].
    #[must_use]
    pub fn excitation_amplitude(&self) -> Option<(MeasuredQuantity, f64)> {
        let rate = std::f64::consts::TAU * self.frequency_hz;
        self.excitation.map(|(quantity, amplitude)| match quantity {
            MeasuredQuantity::Velocity => (MeasuredQuantity::Displacement, amplitude / rate),
            MeasuredQuantity::Acceleration => (MeasuredQuantity::Displacement, amplitude / (rate * rate)),
            other => (other, amplitude),
        })
    }
}

/// A table of measured points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeasuredTable {
    /// The points, in the order of the file.
    pub points: Vec<MeasuredPoint>,
    /// Findings of the reader, such as columns left out.
    pub findings: Vec<RecordFinding>,
}
