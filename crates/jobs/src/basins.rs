//! Basins of attraction: which attractor each of a grid of initial states leads to.

use std::path::PathBuf;

use hammerbeam_attractor::{Attractor, Axis, Basins, Class, Effort, Grid, fractions};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{Store, export::write_basins, store::RequestKind};
use hammerbeam_study::Model;
use serde::Serialize;

use crate::{
    CountedProgress, JobError, JobFolders, Observer, PooledOrder, PreparedStudy, StoredBranches,
    basin_parts::BasinParts,
    counted,
    request::{KeptRequest, effort_words},
};

pub use crate::grid_coordinate::{CoordinateError, GridAxis, direction};

/// What is asked of basins.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsRequest {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// First coordinate of the grid.
    pub x: BasinAxis,
    /// Second coordinate.
    pub y: BasinAxis,
    /// Cells along each coordinate.
    pub grid: u32,
    /// What is spent on the kind of a motion.
    pub effort: Effort,
}

/// A coordinate of the initial state and its range.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BasinAxis {
    /// `q1` .. `qn` or `v1` .. `vn` for modal displacements and velocities, `displacement` or `velocity` for
    /// those of the response point in the first mode.
    pub coordinate: String,
    /// Low end, in SI.
    pub low: f64,
    /// High end.
    pub high: f64,
}

/// The basins over a grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BasinsReport {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// First coordinate.
    pub x: BasinAxis,
    /// Second coordinate.
    pub y: BasinAxis,
    /// Cells along each coordinate.
    pub grid: u32,
    /// Number of the attractor of each cell, from 1 on; 0 where no motion leads to one. `x` varies fastest.
    pub cells: Vec<u32>,
    /// Cells without an attractor.
    pub cells_not_computed: usize,
    /// The attractors, in the order of their numbers.
    pub attractors: Vec<AttractorReport>,
    /// The folder that keeps them, with their tables.
    pub results: Option<String>,
}

/// An attractor of basins.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorReport {
    /// Its number.
    pub attractor: usize,
    /// Kind of its motion, in a word.
    pub class: &'static str,
    /// The same, with its period.
    #[serde(skip)]
    pub kind: Class,
    /// Excitation periods after which it repeats, if it does.
    pub period: Option<usize>,
    /// Part of the cells that lead to it,
    pub fraction: f64,
    /// and its standard error.
    pub standard_error: f64,
    /// Largest exponent [1/s], if it was needed.
    pub largest_exponent_per_s: Option<f64>,
    /// K of the 0-1 test, if it was needed.
    pub zero_one_k: Option<f64>,
    /// The stored branch that it lies on, if it is periodic and branches are known.
    pub branch: Option<u32>,
    /// One of its states.
    pub modal_state: Option<Vec<f64>>,
}

/// Computes basins, or what is left of them, and writes `basins.csv` and `attractors.csv`.
///
/// * `threads`: results do not depend on it.
///
/// # Errors
/// [`JobError`]; [`JobError::Interrupted`] and [`JobError::Stopped`] with the number of cells.
pub fn basins(
    study: &PreparedStudy,
    request: &BasinsRequest,
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<BasinsReport, JobError> {
    basins_with_parts(study, (request, &[]), folders, threads, observer)
}

/// The same, with what parts of it have computed taken from their folders.
///
/// * `parts`: results folders; what they do not have is computed here.
///
/// # Errors
/// [`JobError`]; [`JobError::Store`] of a folder that has no part of it.
pub fn basins_with_parts(
    study: &PreparedStudy,
    (request, parts): (&BasinsRequest, &[PathBuf]),
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<BasinsReport, JobError> {
    study.file.forced()?;
    let grid = request.grid(&study.model)?;
    let system = study.model.system.clone();
    let mut basins =
        Basins::new(system, request.frequency_hz, grid, request.effort, ExactSettings::default())?;
    folders.branches(&study.file)?;
    let total = basins.grid().cells();
    let words = request.words();
    let parts = BasinParts::read(parts, &study.file, (&words, total))?;
    let mut kept = KeptRequest::open(folders.out, &study.file, (RequestKind::Basins, &words), total as u64)?;
    let (mut cells, attractors) = kept.read(Store::basins)?;
    basins.resume(cells.len(), attractors);
    let mut again = 0;
    while !observer.interrupted() {
        let known = basins.attractors().len();
        let was_computed = parts.has_round(&basins);
        let round = match parts.round(&basins).cloned() {
            Some(round) => {
                basins.take(&round);
                round
            }
            None => {
                let Some(round) = basins.round(&mut PooledOrder::new(threads, observer)) else { break };
                again += if was_computed { round.cells.len() } else { 0 };
                round
            }
        };
        kept.add(|store, request| store.append_round(request, &round, known))?;
        cells.extend(round.cells);
        observer.counted(&CountedProgress {
            done: cells.len() as u64,
            total: Some(total as u64),
            things: "cells",
            place: &counted(basins.attractors().len() as u64, "attractor"),
        });
    }
    observer.finishing();
    if again > 0 {
        observer.notice(&format_args!(
            "{again} cells were computed again: their parts did not know an attractor of earlier cells"
        ));
    }
    let done = cells.len() as u64;
    if cells.len() < total {
        kept.finish()?;
        return Err(JobError::Interrupted { done, part_s: None });
    }
    // Under the lock of the folder: two jobs do not write the same tables at once.
    let branches = numbered_and_written(study, request, folders, (&basins, &cells));
    kept.finish()?;
    let branches = branches.map_err(|error| error.stopped_after(done))?;
    Ok(report(request, folders, (&basins, cells), &branches))
}

/// Writes the tables.
///
/// # Returns
/// The branch that each attractor lies on. The branches are closed again here: a store that is read cannot be
/// finished.
fn numbered_and_written(
    study: &PreparedStudy,
    request: &BasinsRequest,
    folders: JobFolders<'_>,
    (basins, cells): (&Basins, &[u32]),
) -> Result<Vec<Option<u32>>, JobError> {
    let attractors = basins.attractors();
    let numbers = match folders.branches(&study.file)? {
        Some(branches) => branch_numbers(&branches, &study.model, request.frequency_hz, attractors)?,
        None => vec![None; attractors.len()],
    };
    if let Some(folder) = folders.out {
        write_basins(folder, "", (basins.grid(), cells), attractors, &numbers)?;
    }
    Ok(numbers)
}

fn branch_numbers(
    branches: &StoredBranches,
    model: &Model,
    frequency_hz: f64,
    attractors: &[Attractor],
) -> Result<Vec<Option<u32>>, JobError> {
    let of = |attractor: &Attractor| match attractor.class {
        Class::Periodic { .. } => branches.branch_of(model, frequency_hz, &attractor.states),
        _ => Ok(None),
    };
    Ok(attractors.iter().map(of).collect::<Result<_, _>>()?)
}

fn report(
    request: &BasinsRequest,
    folders: JobFolders<'_>,
    (basins, cells): (&Basins, Vec<u32>),
    branches: &[Option<u32>],
) -> BasinsReport {
    let found = basins.attractors();
    let fractions = fractions(&cells, found.len());
    let all = found.iter().zip(fractions.into_iter().skip(1)).zip(branches).enumerate();
    let attractors = all.map(|(index, ((attractor, fraction), branch))| AttractorReport {
        attractor: index + 1,
        class: attractor.class.name(),
        kind: attractor.class,
        period: attractor.class.period(),
        fraction: fraction.value,
        standard_error: fraction.half_width,
        largest_exponent_per_s: attractor.largest_exponent.map(|exponent| exponent.value),
        zero_one_k: attractor.zero_one,
        branch: *branch,
        modal_state: attractor.states.last().cloned(),
    });
    BasinsReport {
        frequency_hz: request.frequency_hz,
        x: request.x.clone(),
        y: request.y.clone(),
        grid: request.grid,
        attractors: attractors.collect(),
        cells_not_computed: cells.iter().filter(|&&number| number == 0).count(),
        cells,
        results: folders.shown(),
    }
}

impl BasinsRequest {
    /// What identifies the request in the store.
    pub(crate) fn words(&self) -> Vec<String> {
        let axis = |name: &str, axis: &BasinAxis| {
            [
                format!("{name}.coordinate = {}", axis.coordinate),
                format!("{name}.low = {:e}", axis.low),
                format!("{name}.high = {:e}", axis.high),
            ]
        };
        let mut words =
            vec![format!("frequency_hz = {:e}", self.frequency_hz), format!("grid = {}", self.grid)];
        words.extend(axis("x", &self.x));
        words.extend(axis("y", &self.y));
        words.extend(effort_words(&self.effort));
        words
    }

    pub(crate) fn grid(&self, model: &Model) -> Result<Grid, CoordinateError> {
        let axis = |axis: &BasinAxis, which: GridAxis| {
            let direction = direction(&axis.coordinate, which, model)?;
            Ok(Axis { direction, low: axis.low, high: axis.high, count: self.grid as usize })
        };
        let (x, y) = (axis(&self.x, GridAxis::X)?, axis(&self.y, GridAxis::Y)?);
        if x.direction.iter().zip(&y.direction).any(|(x, y)| x * y != 0.0) {
            let (x, y) = (self.x.coordinate.clone(), self.y.coordinate.clone());
            return Err(CoordinateError::Same { x, y });
        }
        Ok(Grid { base: vec![0.0; 2 * model.system.dof()], x, y })
    }
}
