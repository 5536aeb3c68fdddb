//! `hammerbeam basins`: which attractor each of a grid of initial states leads to.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    JobError, JobFolders, PreparedStudy,
    basins::{BasinAxis, BasinsReport, BasinsRequest, CoordinateError, GridAxis, basins},
    counted,
    pool::threads,
};

use crate::{
    failure::Failure,
    interrupt::Interrupt,
    kept::{unfinished, what_is_kept},
    motion_args::{AxisOption, BasinsOptions},
    output::Output,
    watch::Watch,
};

/// Why a cell has no attractor.
const NOT_COMPUTED: &str = "they begin behind a rigid stop or within a contact that remembers its impact, \
or settle with such a contact closed for good, or their motion could not be computed";

pub fn run(options: &BasinsOptions, output: Output) -> Result<(), Failure> {
    let file = options.study.read()?;
    file.forced()?;
    let study = PreparedStudy::new(file)?;
    let axis = |option: &AxisOption| BasinAxis {
        coordinate: option.name.clone(),
        low: option.low,
        high: option.high,
    };
    let request = BasinsRequest {
        frequency_hz: options.frequency,
        x: axis(&options.x),
        y: axis(&options.y),
        grid: options.grid,
        effort: (&options.effort).into(),
    };
    let folders = JobFolders { results: options.results.as_deref(), out: options.out.as_deref() };
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let report = basins(&study, &request, folders, threads(options.jobs), &mut watch);
    let report = report.map_err(|error| refused(options, error))?;
    let total = report.cells.len();
    if report.cells_not_computed == total {
        return Err(Failure::NoResult(format!("no motion from any of the {total} cells: {NOT_COMPUTED}")));
    }
    output.give(&report, || text(&report, output.frequency_unit))?;
    Ok(())
}

fn refused(options: &BasinsOptions, error: JobError) -> Failure {
    let total = u64::from(options.grid) * u64::from(options.grid);
    let what_is_kept =
        |number| format!("{number} of {total} cells {}", what_is_kept(number, options.out.as_deref()));
    match error {
        JobError::Coordinate(error) => Failure::BadInput(coordinate_refused(&error)),
        other => unfinished(other, what_is_kept),
    }
}

/// Why there is no grid, by the options that say what it is.
fn coordinate_refused(error: &CoordinateError) -> String {
    match error {
        CoordinateError::PointNotMoved { axis, .. } | CoordinateError::Unknown { axis, .. } => {
            let flag = if *axis == GridAxis::X { "--x" } else { "--y" };
            format!("{flag}: {error}")
        }
        CoordinateError::Same { x, y } => {
            format!("--x and --y, {x:?} and {y:?}, are the same coordinate; two different ones are needed")
        }
        other => other.to_string(),
    }
}

fn text(report: &BasinsReport, unit: FrequencyUnit) -> String {
    let mut lines = vec![format!("{} cells at {}", report.cells.len(), unit.words(report.frequency_hz))];
    for found in &report.attractors {
        let branch = found.branch.map_or_else(String::new, |branch| format!(", branch {branch}"));
        lines.push(format!(
            "  attractor {}: {}{branch}, fraction {:.4} +- {:.4}",
            found.attractor, found.kind, found.fraction, found.standard_error
        ));
    }
    if report.cells_not_computed > 0 {
        let lost = report.cells_not_computed;
        lines.push(format!("  {} without an attractor: {NOT_COMPUTED}", counted(lost as u64, "cell")));
    }
    if let Some(folder) = &report.results {
        lines.push(format!("basins.csv and attractors.csv are in {folder}"));
    }
    lines.join("\n")
}
