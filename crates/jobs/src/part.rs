//! Parts of a job that several processes or machines compute, each into a results folder of its own.
//!
//! A part is kept as a request of its own: the words of the whole job, and `part = 2/4` behind them. The
//! whole job, given the folders of its parts, takes from them what it would compute itself, and computes what
//! they do not have; so its results are those of one process.

use std::{fmt, ops::Range, path::PathBuf, str::FromStr};

use hammerbeam_results::{
    Store, StoreError,
    store::{RequestKind, RequestRecord},
};
use hammerbeam_study::StudyFile;
use serde::Serialize;

use crate::crossings::open_for_study;

/// One of so many parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct JobPart {
    number: u32,
    of: u32,
}

/// A text that is no part.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found the part {text:?}, must be K/N with 1 <= K <= N, as in 2/4")]
pub struct JobPartError {
    text: String,
}

impl JobPart {
    /// The part of that number, counted from 1; `None` if there are fewer.
    #[must_use]
    pub fn new(number: u32, of: u32) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// Which of so many pieces of work it has; all parts together have each piece once, in their order.
    #[must_use]
    pub fn range(self, pieces: usize) -> Range<usize> {
        let start = |part: u32| (pieces as u64 * u64::from(part) / u64::from(self.of)) as usize;
        start(self.number - 1)..start(self.number)
    }

    /// What identifies it in a store, after the words of the whole.
    pub(crate) fn words(self, whole: &[String]) -> Vec<String> {
        [whole, &[format!("part = {self}")]].concat()
    }
}

impl fmt::Display for JobPart {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

impl FromStr for JobPart {
    type Err = JobPartError;

    fn from_str(text: &str) -> Result<Self, JobPartError> {
        let numbers =
            text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        numbers
            .and_then(|(number, of)| Self::new(number, of))
            .ok_or_else(|| JobPartError { text: text.to_owned() })
    }
}

/// What came of a part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JobPartReport {
    /// Which part, as `2/4`.
    pub part: String,
    /// Cells or frequencies that it has computed.
    pub pieces: u64,
    /// The folder that keeps them.
    pub results: Option<String>,
}

/// Reads what folders have of the parts of a job.
///
/// * `words`: those of the whole job.
/// * `read`: reads a part of a store.
///
/// # Errors
/// [`StoreError::NoPart`]: a folder has none.
pub(crate) fn read_parts<T>(
    folders: &[PathBuf],
    file: &StudyFile,
    (kind, words): (RequestKind, &[String]),
    read: impl Fn(&Store, &RequestRecord, JobPart) -> Result<T, StoreError>,
) -> Result<Vec<T>, StoreError> {
    let whole = format!("{}\npart = ", words.join("\n"));
    let mut parts = Vec::new();
    for folder in folders {
        let store = open_for_study(folder, file)?;
        let known = parts.len();
        for request in store.requests()?.iter().filter(|request| request.kind == kind) {
            let part = request.words.strip_prefix(&whole).and_then(|part| part.parse().ok());
            if let Some(part) = part {
                parts.push(read(&store, request, part)?);
            }
        }
        if parts.len() == known {
            return Err(StoreError::NoPart { folder: folder.clone() });
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_each_piece_once() {
        for (pieces, of) in [(0, 3), (1, 3), (10, 3), (10, 1), (7, 7), (3, 5)] {
            let all: Vec<usize> =
                (1..=of).flat_map(|number| JobPart::new(number, of).unwrap().range(pieces)).collect();
            assert_eq!(all, (0..pieces).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_part_is_read_as_it_is_written() {
        assert_eq!("2/4".parse(), Ok(JobPart { number: 2, of: 4 }));
        assert_eq!(JobPart { number: 2, of: 4 }.to_string(), "2/4");
        for text in ["", "2", "0/4", "5/4", "1/0", "a/b", "1/2/3"] {
            let message = format!("found the part {text:?}, must be K/N with 1 <= K <= N, as in 2/4");
            assert_eq!(text.parse::<JobPart>().unwrap_err().to_string(), message);
        }
    }
}
