//! Sweeps from many states by parts: frequencies that several processes have computed.

use std::{collections::BTreeMap, path::PathBuf};

use hammerbeam_results::{
    Store, StoreError,
    store::{RequestKind, RequestRecord, SettledMotion},
};
use hammerbeam_study::StudyFile;

use crate::part::{JobPart, read_parts};

/// The motions of frequencies, by the numbers of these from 0 on.
pub(crate) type SweepPieces = BTreeMap<u64, Vec<SettledMotion>>;

/// What parts have computed of a sweep.
///
/// * `words`: of the whole sweep; `upward`: its frequencies [Hz].
///
/// # Errors
/// [`StoreError::NoPart`]: a folder has none.
pub(crate) fn read_sweep_parts(
    folders: &[PathBuf],
    file: &StudyFile,
    (words, upward): (&[String], &[f64]),
) -> Result<SweepPieces, StoreError> {
    let read = |store: &Store, request: &RequestRecord, part: JobPart| {
        let done = part.range(upward.len()).take(request.done as usize);
        Ok(by_frequency(done, upward, store.settled(request.id)?))
    };
    let parts = read_parts(folders, file, (RequestKind::Starts, words), read)?;
    Ok(parts.into_iter().flatten().collect())
}

/// Motions in the order of their frequencies; at some there may be none.
fn by_frequency(
    pieces: impl Iterator<Item = usize>,
    upward: &[f64],
    motions: Vec<SettledMotion>,
) -> Vec<(u64, Vec<SettledMotion>)> {
    let mut rest = motions.into_iter().peekable();
    let mut of = |piece: usize| {
        let mut here = Vec::new();
        while let Some(motion) = rest.next_if(|motion| motion.point.frequency_hz == upward[piece]) {
            here.push(motion);
        }
        (piece as u64, here)
    };
    pieces.map(&mut of).collect()
}
