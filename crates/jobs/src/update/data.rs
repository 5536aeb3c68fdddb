//! What an update is told: parameters to fit, and data with their standard deviations.

use std::{
    io,
    path::{Path, PathBuf},
};

use hammerbeam_fit::{Bounds, Deviations};
use hammerbeam_signal::limits::{self, LARGEST_TEXT};
use hammerbeam_study::{Report, StudyFile, number::Number};

use super::reading;

/// A parameter that is fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedKey {
    /// Its key path, as the data file writes it.
    pub key: String,
    pub(super) number: Number,
    /// Value from which the fit starts.
    pub start: f64,
    /// Its size where its value is zero.
    pub typical: f64,
    /// Values that it may take.
    pub bounds: Bounds,
}

/// Tables of eigenfrequencies, as `hammerbeam modes` has them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrequencyTable {
    /// Of the supported structure, unreduced.
    Clamped,
    /// Of the free-interface reduction, rigid-body modes included.
    FreeInterface,
    /// Of the fixed-interface reduction.
    FixedInterface,
    /// Of the reduced structure.
    Reduced,
}

/// A measured eigenfrequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EigenfrequencyDatum {
    /// Which table.
    pub table: FrequencyTable,
    /// Number in the table, from 0.
    pub mode: usize,
}

/// A measured damping ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingDatum {
    /// Number of the mode of the reduced structure, lowest first, from 0.
    pub mode: usize,
}

/// A measured stable periodic response.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredOrbit {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Its path in the data file, for messages.
    pub place: String,
}

/// A maximum over an orbit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Maximum {
    /// Of the absolute displacement of the response point [m].
    Displacement,
    /// Of the absolute velocity of the response point [m/s].
    Velocity,
    /// Of the absolute acceleration of the response point [m/s^2].
    Acceleration,
    /// Of the contact force [N].
    ContactForce,
    /// Of the speed with which a contact is reached [m/s].
    ImpactVelocity,
}

/// A measured maximum of a response.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ResponseDatum {
    /// Number of the orbit in the data, from 0.
    pub orbit: usize,
    /// Of what.
    pub of: Maximum,
}

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Observation {
    /// An eigenfrequency [Hz].
    Eigenfrequency(EigenfrequencyDatum),
    /// A damping ratio.
    Damping(DampingDatum),
    /// A maximum of a response.
    Response(ResponseDatum),
}

/// A number that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Datum {
    /// What it is.
    pub observation: Observation,
    /// Its value, in SI units.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Its path in the data file, for messages.
    pub place: String,
}

/// A data file.
#[derive(Debug, Clone, PartialEq)]
pub struct UpdateData {
    /// Title for reports.
    pub title: String,
    /// What is known of the standard deviations.
    pub deviations: Deviations,
    /// Parameters to fit.
    pub parameters: Vec<FittedKey>,
    /// Measured responses.
    pub orbits: Vec<MeasuredOrbit>,
    /// Measured numbers.
    pub data: Vec<Datum>,
    pub(super) source: reading::Source,
}

/// Why there are no data.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataError {
    /// The file could not be read.
    #[error("cannot read the data {}: {source}", path.display())]
    #[expect(missing_docs, reason = "the message names its fields")]
    Unreadable { path: PathBuf, source: io::Error },
    /// The file says something that is not allowed.
    #[error("{0}")]
    Invalid(Report),
}

impl UpdateData {
    /// Reads a data file for a study.
    ///
    /// # Errors
    /// [`DataError`]: the file cannot be read, or something in it is not allowed.
    pub fn read(path: &Path, study: &StudyFile) -> Result<Self, DataError> {
        let text = limits::read_text(path, LARGEST_TEXT)
            .map_err(|source| DataError::Unreadable { path: path.to_owned(), source })?;
        Self::parse(&path.display().to_string(), text, study)
    }

    /// Reads data from their text.
    ///
    /// # Errors
    /// [`DataError::Invalid`] with everything that is not allowed.
    pub fn parse(name: &str, text: String, study: &StudyFile) -> Result<Self, DataError> {
        reading::parse(name, text, study).map_err(DataError::Invalid)
    }

    /// A fault of a key that was found after reading.
    #[must_use]
    pub fn fault(&self, key: &str, message: String, help: Vec<String>) -> DataError {
        DataError::Invalid(self.source.fault(key, message, help))
    }
}
