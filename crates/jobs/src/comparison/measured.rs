//! What was measured: tables of points, and records that are reduced to points.

use std::{
    fs,
    path::{Path, PathBuf},
};

use hammerbeam_signal::{
    PointsError, RecordFinding, SignalError,
    points::{self, MeasuredPoint},
};

use super::{measured_error::MeasuredError, records};

/// All measured points, and what was noticed.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPoints {
    /// The points.
    pub points: Vec<MeasuredPoint>,
    /// Name of the file and what was found in it.
    pub findings: Vec<(String, RecordFinding)>,
}

/// Reads files and folders: tables of points, and records of single excitation frequencies.
///
/// * `reference`: the channel of records that is excited.
///
/// # Errors
/// [`MeasuredError`].
pub fn read_measured(paths: &[PathBuf], reference: Option<&str>) -> Result<MeasuredPoints, MeasuredError> {
    let mut measured = MeasuredPoints { points: Vec::new(), findings: Vec::new() };
    for path in paths {
        if path.is_dir() {
            let files = files_of(path)?;
            if files.is_empty() {
                return Err(MeasuredError::NoFile { folder: path.clone() });
            }
            for file in files {
                measured.record(&file, reference)?;
            }
        } else {
            measured.file(path, reference)?;
        }
    }
    Ok(measured)
}

/// Files of a folder by their names, hidden ones left out.
fn files_of(folder: &Path) -> Result<Vec<PathBuf>, MeasuredError> {
    let failed = |source| MeasuredError::Folder { folder: folder.to_owned(), source };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let hidden = path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'));
        if path.is_file() && !hidden {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

impl MeasuredPoints {
    /// A table if it has a column of frequencies, else a record.
    fn file(&mut self, path: &Path, reference: Option<&str>) -> Result<(), MeasuredError> {
        let name = path.display().to_string();
        match points::read(path) {
            Ok(table) => {
                let origin = |point: MeasuredPoint| MeasuredPoint {
                    origin: format!("{name}, {}", point.origin),
                    ..point
                };
                self.points.extend(table.points.into_iter().map(origin));
                self.findings.extend(table.findings.into_iter().map(|finding| (name.clone(), finding)));
                Ok(())
            }
            Err(SignalError::Points { source: PointsError::NotText, .. }) => self.record(path, reference),
            Err(error @ SignalError::Points { source: PointsError::NoFrequency { .. }, .. }) => {
                // A time series has no column of frequencies either; what is wrong with the table is
                // reported if it is none.
                match records::looks_like_record(path) {
                    true => self.record(path, reference),
                    false => Err(error.into()),
                }
            }
            Err(error) => Err(error.into()),
        }
    }

    fn record(&mut self, path: &Path, reference: Option<&str>) -> Result<(), MeasuredError> {
        let (point, findings) = records::reduce(path, reference)?;
        self.points.push(point);
        let name = path.display().to_string();
        self.findings.extend(findings.into_iter().map(|finding| (name.clone(), finding)));
        Ok(())
    }
}
