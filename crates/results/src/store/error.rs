//! Why a results folder cannot be used.

use std::{
    io,
    path::{Path, PathBuf},
};

use rusqlite::ErrorCode;

use crate::whole_file::is_wrong_place;

/// Name of the database in a results folder.
pub const DATABASE: &str = "results.db";

/// Why a results folder cannot be used.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum StoreError {
    /// There is nothing to read.
    #[error("there are no results in {}", folder.display())]
    NoResults { folder: PathBuf },
    /// The folder has no part of what is put together from parts.
    #[error("{} holds no part of this: of the same study, with the same numbers", folder.display())]
    NoPart { folder: PathBuf },
    /// `results.db` is something else.
    #[error("{} was not written by hammerbeam", folder.join(DATABASE).display())]
    NotResults { folder: PathBuf },
    /// The folder holds the results of another study.
    #[error(
        "{} holds the results of another study; it differs in\n{}",
        folder.display(),
        indented(differences)
    )]
    OtherStudy { folder: PathBuf, differences: Vec<String> },
    /// The folder was written by a program that stores or computes differently.
    #[error(
        "{} was written by hammerbeam {program} with {what} version {found}, this is version {expected}",
        folder.display()
    )]
    OtherVersion { folder: PathBuf, program: String, what: &'static str, found: String, expected: u32 },
    /// Another run is at work.
    #[error("another run is writing to {}", folder.display())]
    Locked { folder: PathBuf },
    /// Something stored has an impossible size.
    #[error("the stored {what} has {found} bytes, {expected} are expected")]
    Damaged { what: &'static str, found: usize, expected: usize },
    /// What is stored of a solution cannot be read.
    #[error("solution {number} on the {side} side of branch {branch} is damaged: {source}")]
    DamagedSolution { branch: String, side: &'static str, number: u32, source: Box<StoreError> },
    /// Rows of solutions that a walk has counted are not there.
    #[error(
        "{} missing from results.db; a run of the study into a new folder computes {} again",
        place(*first, *last, side, branch), if first == last { "it" } else { "them" }
    )]
    MissingSolutions { branch: String, side: &'static str, first: u32, last: u32 },
    /// Periods of a motion are not there, or there are some that were not counted.
    #[error(
        "the motion of request {request} is damaged: {done} periods are done, in results.db {found} follow \
         one another; the same command into a new folder computes them again"
    )]
    DamagedMotion { request: i64, found: u64, done: u64 },
    /// Something stored has a name that this program does not know.
    #[error("the stored {what} {found} is unknown")]
    Unknown { what: &'static str, found: String },
    /// Something stored is a number that nothing has.
    #[error("the stored {what} is {found}")]
    Impossible { what: &'static str, found: f64 },
    /// Somebody else has gone on with a request in the meantime.
    #[error("request {request} is at piece {found}, piece {expected} cannot follow")]
    OutOfOrder { request: i64, found: u64, expected: u64 },
    /// The folder cannot be made or written.
    #[error("cannot write to {}: {source}", folder.display())]
    Folder { folder: PathBuf, source: io::Error },
    /// Something else than rows of solutions is not as it was written.
    #[error(
        "results.db is damaged: {what}; put back a copy of it, or let a run of the study into a new folder \
         compute everything again"
    )]
    DamagedFile { what: String },
    /// What is stored of a solution is not what was written.
    #[error("it is not as it was stored; a run of the study into a new folder computes it again")]
    OtherThanStored,
    /// Another run has started to write, though this one held the lock: someone has removed it.
    #[error(
        "another run has begun to write to {}; what this one had stored is kept, nothing more was added",
        folder.display()
    )]
    TakenOver { folder: PathBuf },
    /// The database is not where it was.
    #[error(
        "{} was removed or replaced while it was written; what was stored in it is gone with it",
        database.display()
    )]
    Gone { database: PathBuf },
    /// The database refuses.
    #[error("results database: {}", in_words(.0))]
    Database(rusqlite::Error),
}

impl From<rusqlite::Error> for StoreError {
    fn from(error: rusqlite::Error) -> Self {
        match error.sqlite_error_code() {
            Some(ErrorCode::DatabaseCorrupt) => Self::DamagedFile { what: error.to_string() },
            _ => Self::Database(error),
        }
    }
}

impl StoreError {
    /// What stands in the way is named where it is a file.
    pub(super) fn folder(folder: &Path, source: io::Error) -> Self {
        let source = if folder.is_file() {
            io::Error::new(io::ErrorKind::NotADirectory, "it is a file, not a folder")
        } else {
            source
        };
        Self::Folder { folder: folder.to_owned(), source }
    }

    /// Whether solutions are missing or cannot be read, as opposed to a whole folder: what does not need them
    /// can be had.
    #[must_use]
    pub fn is_of_solutions(&self) -> bool {
        matches!(self, Self::DamagedSolution { .. } | Self::MissingSolutions { .. })
    }

    /// Whether the user pointed at the wrong folder, as opposed to a disk that refuses.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        use ErrorCode::{CannotOpen, PermissionDenied, ReadOnly};
        if let Self::Database(error) = self {
            return matches!(error.sqlite_error_code(), Some(CannotOpen | PermissionDenied | ReadOnly));
        }
        if let Self::Folder { source, .. } = self {
            return is_wrong_place(source);
        }
        !matches!(
            self,
            Self::Damaged { .. }
                | Self::DamagedSolution { .. }
                | Self::MissingSolutions { .. }
                | Self::DamagedMotion { .. }
                | Self::DamagedFile { .. }
                | Self::OtherThanStored
                | Self::TakenOver { .. }
                | Self::Gone { .. }
                | Self::Unknown { .. }
                | Self::Impossible { .. }
                | Self::OutOfOrder { .. }
        )
    }
}

/// What the database says, once: its own errors repeat themselves.
fn in_words(error: &rusqlite::Error) -> String {
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => "there is no room left on the disk".to_owned(),
        Some(ErrorCode::SystemIoFailure) => {
            let code = error.sqlite_error().map_or(0, |error| error.extended_code);
            format!("the disk fails, or a file may not grow further (code {code} of SQLite)")
        }
        _ => error.to_string(),
    }
}

fn place(first: u32, last: u32, side: &str, branch: &str) -> String {
    let place = format!("on the {side} side of branch {branch}");
    if first == last {
        format!("solution {first} {place} is")
    } else {
        format!("solutions {first} to {last} {place} are")
    }
}

fn indented(lines: &[String]) -> String {
    lines.iter().map(|line| format!("  {line}")).collect::<Vec<_>>().join("\n")
}
