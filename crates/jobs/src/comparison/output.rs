//! Measured points over an output of the study, whose largest magnitudes are stored.

use std::path::Path;

use hammerbeam_results::store::{StoredOutputs, solution_key};
use hammerbeam_signal::MeasuredQuantity;
use hammerbeam_study::{StudyFile, file::OutputQuantity};

use super::{BranchCurve, ComparedQuantity, CurvePoint, Curves, FitSettings, MeasuredPoints, compare};
use crate::{JobError, StoredBranches};

/// Compares measured points with an output: those of its quantity with its largest magnitudes.
///
/// # Errors
/// [`JobError`]: the folder holds no branch or no such output, or nothing of its quantity was measured.
pub fn compare_output(
    (file, output): (&StudyFile, &str),
    results: &Path,
    measured: &MeasuredPoints,
    settings: &FitSettings,
) -> Result<ComparedQuantity, JobError> {
    let range_hz = file.forced()?.frequency_hz;
    let branches = StoredBranches::open(results, file)?;
    if branches.branches().is_empty() {
        return Err(JobError::NoBranches { results: results.to_owned() });
    }
    let stored = StoredOutputs::of(branches.store())?;
    let place = stored.outputs().iter().position(|known| known.name == output);
    let Some(place) = place else {
        let known = stored.outputs().iter().map(|known| known.name.clone()).collect();
        return Err(JobError::NoOutput { name: output.to_owned(), known });
    };
    let quantity = match stored.outputs()[place].quantity {
        OutputQuantity::Displacement => MeasuredQuantity::Displacement,
        OutputQuantity::Velocity => MeasuredQuantity::Velocity,
        OutputQuantity::Acceleration => MeasuredQuantity::Acceleration,
        OutputQuantity::Force => MeasuredQuantity::Force,
    };
    let mut curves = Vec::new();
    for branch in branches.branches() {
        let period_multiple = branch.record.period_multiple;
        let mut points = Vec::with_capacity(branch.rows.len());
        for (index, placed) in branch.rows.iter().enumerate() {
            let key = solution_key(branch.record.start, placed.side, placed.number);
            let values = stored.values(key, period_multiple)?;
            points.push(CurvePoint {
                frequency_hz: placed.row.frequency_hz,
                value: values.map_or(f64::NAN, |values| values[place].largest()),
                stable: placed.row.stability.may_be_stable(),
                row: index + 1,
            });
        }
        curves.push(BranchCurve { branch: branch.record.id, period_multiple, points });
    }
    let curves = Curves::new(curves);
    let comparison = compare(&measured.points, &curves, quantity, settings)?;
    Ok(ComparedQuantity { curves, comparison, low_pass_hz: None, point: Some(output.to_owned()), range_hz })
}
