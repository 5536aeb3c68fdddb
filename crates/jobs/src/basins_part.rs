//! A part of basins, which one of several processes computes.

use hammerbeam_attractor::{Basins, Round};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{Store, store::RequestKind};

use crate::{
    CountedProgress, JobError, JobFolders, Observer, PooledOrder, PreparedStudy,
    basin_parts::part_rounds,
    basins::BasinsRequest,
    part::{JobPart, JobPartReport},
    request::KeptRequest,
};

/// Computes a part of basins, or what is left of it, into a results folder.
///
/// * `threads`: results do not depend on it.
///
/// # Errors
/// [`JobError`]; [`JobError::Interrupted`] with the number of cells.
pub fn basins_part(
    study: &PreparedStudy,
    (request, part): (&BasinsRequest, JobPart),
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<JobPartReport, JobError> {
    study.file.forced()?;
    let grid = request.grid(&study.model)?;
    let order = part_rounds(grid.cells(), part);
    let total = order.iter().map(ExactSizeIterator::len).sum::<usize>() as u64;
    let system = study.model.system.clone();
    let mut basins =
        Basins::new(system, request.frequency_hz, grid, request.effort, ExactSettings::default())?;
    let words = part.words(&request.words());
    let mut kept = KeptRequest::open(folders.out, &study.file, (RequestKind::Basins, &words), total)?;
    let (cells, attractors) = kept.read(Store::basins)?;
    let mut done = 0;
    basins.resume(0, attractors);
    for range in order {
        if done + range.len() <= cells.len() {
            done += range.len();
            continue;
        }
        let known = basins.attractors().len();
        basins.skip_to(range.start);
        let round = if observer.interrupted() {
            None
        } else {
            basins.round(&mut PooledOrder::new(threads, observer))
        };
        let Some(round) = round else {
            kept.finish()?;
            return Err(JobError::Interrupted { done: done as u64, part_s: None });
        };
        // In the store of a part its cells follow one another.
        let round = Round { first: done, ..round };
        kept.add(|store, request| store.append_round(request, &round, known))?;
        done += round.cells.len();
        observer.counted(&CountedProgress {
            done: done as u64,
            total: Some(total),
            things: "cells",
            place: &format_args!("part {part}"),
        });
    }
    observer.finishing();
    kept.finish()?;
    Ok(JobPartReport { part: part.to_string(), pieces: total, results: folders.shown() })
}
