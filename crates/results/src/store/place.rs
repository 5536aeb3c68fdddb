//! Whether the database is still the file that was opened: of one that was removed SQLite goes on to write
//! what nobody can read.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use super::StoreError;

/// A file, and which one it was.
#[derive(Debug)]
pub(super) struct Place {
    path: PathBuf,
    file: FileNumber,
}

/// Device and number of a file, where the system has such.
type FileNumber = [u64; 2];

impl Place {
    /// Where a file is now.
    pub(super) fn of(path: &Path) -> Result<Self, StoreError> {
        let file = number(path).map_err(|source| StoreError::folder(path, source))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// Refuses to go on if another file is there, or none.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        match number(&self.path) {
            Ok(file) if file == self.file => Ok(()),
            _ => Err(StoreError::Gone { database: self.path.clone() }),
        }
    }
}

#[cfg(unix)]
fn number(path: &Path) -> io::Result<FileNumber> {
    use std::os::unix::fs::MetadataExt;
    let metadata = fs::symlink_metadata(path)?;
    Ok([metadata.dev(), metadata.ino()])
}

/// Only whether there is a file.
#[cfg(not(unix))]
fn number(path: &Path) -> io::Result<FileNumber> {
    fs::symlink_metadata(path).map(|_| [0, 0])
}
