//! What an update goes by: parameters to fit, and data with their standard deviations.

use std::{collections::BTreeMap, io, ops::Range, path::PathBuf};

use hammerbeam_fit::{Bounds, Deviations};
use hammerbeam_study::{
    FaultReport,
    document::{Problem, place},
    number::Number,
};

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
pub enum MeasuredDatum {
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
    pub observation: MeasuredDatum,
    /// Its value, in SI units.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Its path in the data file, for messages.
    pub place: String,
}

/// The text of a data file and where its keys stand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DataSource {
    pub name: String,
    pub text: String,
    pub places: BTreeMap<String, Range<usize>>,
}

impl DataSource {
    pub fn fault(&self, key: &str, message: String, help: Vec<String>) -> FaultReport {
        let problem = Problem { key: key.to_owned(), span: place(&self.places, key), message, help };
        FaultReport::new(&self.name, &self.text, vec![problem])
    }
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
    pub(super) source: DataSource,
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
    Invalid(FaultReport),
}

impl UpdateData {
    /// A fault of a key that was found after reading.
    #[must_use]
    pub fn fault(&self, key: &str, message: String, help: Vec<String>) -> DataError {
        DataError::Invalid(self.source.fault(key, message, help))
    }
}
