//! One run at a time in a results folder.

use std::{
    fs::{File, TryLockError},
    path::Path,
};

use super::StoreError;
use crate::whole_file::refuse_link;

/// Name of the file whose lock a run holds; the system lets it go when the run ends, however it ends.
const LOCK: &str = "run.lock";

/// Held while a run writes.
#[derive(Debug)]
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock of a folder.
    ///
    /// # Errors
    /// [`StoreError::Locked`] if another run has it, [`StoreError::Folder`] if it is a link.
    pub(super) fn take(folder: &Path) -> Result<Self, StoreError> {
        let path = folder.join(LOCK);
        refuse_link(&path).map_err(|source| StoreError::Folder { folder: path.clone(), source })?;
        let open = File::options().create(true).truncate(false).write(true).open(path);
        let file = open.map_err(|source| StoreError::folder(folder, source))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(StoreError::Locked { folder: folder.to_owned() }),
            Err(TryLockError::Error(source)) => Err(StoreError::folder(folder, source)),
        }
    }
}
