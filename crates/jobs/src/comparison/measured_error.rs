//! Why measured points cannot be read.

use std::{
    io,
    path::{Path, PathBuf},
};

use hammerbeam_signal::SignalError;

/// Why measured points cannot be read.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum MeasuredError {
    /// A folder without files.
    #[error("{}: the folder holds no file", folder.display())]
    NoFile { folder: PathBuf },
    /// A folder that cannot be read.
    #[error("cannot read {}: {source}", folder.display())]
    Folder { folder: PathBuf, source: io::Error },
    /// A table that cannot be read.
    #[error(transparent)]
    Table(#[from] SignalError),
    /// A record that cannot be read or reduced.
    #[error("{}", of_file(path, source))]
    Record { path: PathBuf, source: SignalError },
    /// A record whose excitation frequency is not known.
    #[error(
        "{}: the excitation frequency is not known; name the file like \"31.5Hz.csv\", or give the excited \
        channel",
        path.display()
    )]
    NoFrequency { path: PathBuf },
    /// A record of something else.
    #[error("{}: no channel has a unit of length, speed, acceleration or force", path.display())]
    NoQuantity { path: PathBuf },
}

/// An error with the file that it is about, unless it names that already.
fn of_file(path: &Path, source: &SignalError) -> String {
    let (shown, message) = (path.display().to_string(), source.to_string());
    if source.is_bad_input() && message.starts_with(&shown) { message } else { format!("{shown}: {message}") }
}
