//! The numbers of an output: their words, columns, units and meaning, from which study file, tables, figures
//! and reference follow.

use serde::{Deserialize, Serialize};

/// What is read at a place or a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutputQuantity {
    /// Displacement [m].
    Displacement,
    /// Velocity [m/s].
    Velocity,
    /// Acceleration [m/s^2].
    Acceleration,
    /// Force with which the structure presses on a stop [N].
    Force,
}

impl OutputQuantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Displacement, Self::Velocity, Self::Acceleration, Self::Force];

    /// Its word in the study file and in tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Force => "force",
        }
    }

    /// Its unit, as tables have it.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Velocity => "m/s",
            Self::Acceleration => "m/s^2",
            Self::Force => "N",
        }
    }
}

/// A number of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OutputValue {
    /// Largest value.
    Maximum,
    /// Smallest value.
    Minimum,
    /// Largest absolute value.
    Largest,
    /// Largest less smallest value.
    PeakToPeak,
    /// Mean.
    Mean,
    /// Root of the mean square.
    RootMeanSquare,
    /// Amplitude at the excitation frequency.
    Amplitude,
    /// Phase there, relative to the phase of the excitation [rad].
    Phase,
}

impl OutputValue {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Maximum,
        Self::Minimum,
        Self::Largest,
        Self::PeakToPeak,
        Self::Mean,
        Self::RootMeanSquare,
        Self::Amplitude,
        Self::Phase,
    ];

    /// Those that figures show unless the study says so.
    pub const USUAL: [Self; 2] = [Self::Maximum, Self::Minimum];

    /// Its word in the study file and on the command line.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Maximum => "maximum",
            Self::Minimum => "minimum",
            Self::Largest => "max-abs",
            Self::PeakToPeak => "peak-to-peak",
            Self::Mean => "mean",
            Self::RootMeanSquare => "rms",
            Self::Amplitude => "amplitude",
            Self::Phase => "phase",
        }
    }

    /// What it is called in figures.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Maximum => "maximum",
            Self::Minimum => "minimum",
            Self::Largest => "largest magnitude",
            Self::PeakToPeak => "peak to peak",
            Self::Mean => "mean",
            Self::RootMeanSquare => "root mean square",
            Self::Amplitude => "amplitude at the excitation frequency",
            Self::Phase => "phase at the excitation frequency",
        }
    }
}
