//! Measured points over the branches of a results folder, quantity by quantity.

use std::path::Path;

use hammerbeam_signal::MeasuredQuantity;

use super::{
    ComparedQuantity, Filter, FitSettings, MeasuredPoints, Observation, compare, curves, tables::write_points,
};
use crate::{JobError, PreparedStudy, StoredBranches};

/// Distance of orbits that are computed again as a part of the middle of the frequency range, and their
/// samples in an excitation period.
const SPACING: f64 = 1e-3;
const SAMPLES: usize = 4096;

/// Quantities that are compared.
const COMPARED: [MeasuredQuantity; 4] = [
    MeasuredQuantity::Displacement,
    MeasuredQuantity::Velocity,
    MeasuredQuantity::Acceleration,
    MeasuredQuantity::Force,
];

impl MeasuredPoints {
    /// Quantities that were measured.
    #[must_use]
    pub fn quantities(&self) -> Vec<MeasuredQuantity> {
        let is_measured =
            |quantity: &MeasuredQuantity| self.points.iter().any(|p| p.maxima.of(*quantity).is_some());
        COMPARED.into_iter().filter(is_measured).collect()
    }
}

/// Compares measured points with the branches of a results folder.
///
/// * `study`: that of the results; the response point of its model is where the sensor was.
/// * `point`: the name of that point.
/// * `filter`: of the measurement; forces are compared without.
///
/// # Errors
/// [`JobError`]: the folder holds no branch, among others.
pub fn compare_results(
    (study, point): (&PreparedStudy, &str),
    results: &Path,
    (measured, quantities): (&MeasuredPoints, &[MeasuredQuantity]),
    filter: Option<Filter>,
    settings: &FitSettings,
) -> Result<Vec<ComparedQuantity>, JobError> {
    let PreparedStudy { file, model } = study;
    let range_hz @ [low, high] = file.forced()?.frequency_hz;
    let at_response_point = point == file.study.response.point;
    let branches = StoredBranches::open(results, file)?;
    if branches.branches().is_empty() {
        return Err(JobError::NoBranches { results: results.to_owned() });
    }
    let spacing_hz = SPACING * 0.5 * (low + high);
    let mut compared = Vec::new();
    for &quantity in quantities {
        let filter = filter.filter(|_| quantity != MeasuredQuantity::Force);
        let observation = Observation { quantity, at_response_point, filter, spacing_hz, samples: SAMPLES };
        let curves = curves(&branches, model, &observation)?;
        let comparison = compare(&measured.points, &curves, quantity, settings)?;
        let of_point = quantity != MeasuredQuantity::Force && !at_response_point;
        compared.push(ComparedQuantity {
            curves,
            comparison,
            low_pass_hz: filter.map(|filter| filter.cut_off_hz),
            point: of_point.then(|| point.to_owned()),
            range_hz,
        });
    }
    Ok(compared)
}

/// Writes a table of the points of a quantity.
///
/// # Returns
/// The name of the file.
///
/// # Errors
/// The table cannot be written.
pub fn write_compared(folder: &Path, compared: &ComparedQuantity) -> Result<String, JobError> {
    let name = format!("points_{}.csv", compared.comparison.quantity.word());
    write_points(folder, &name, (&compared.comparison, compared.low_pass_hz))?;
    Ok(name)
}
