//! From stored branches to curves of what an instrument would show.
//!
//! Largest displacements and accelerations of the response point, and contact forces, are stored with each
//! solution, exact on the continuous motion. Velocities, other points, and everything behind a filter, are
//! computed again from the stored orbit, for solutions that are far enough apart: a filtered history has no
//! feature narrower than the branch itself.

use hammerbeam_orbit::BranchEventKind;
use hammerbeam_results::{StoreError, store::PlacedRow};
use hammerbeam_signal::{MeasuredQuantity, SignalError};
use hammerbeam_study::Model;

use super::{
    BranchCurve, CurvePoint, Curves,
    history::{Filter, LEFT, MotionHistory, NoneSampled, history, largest, largest_behind, sampled},
};
use crate::{StoredBranch, StoredBranches};

/// What of an orbit is observed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// The quantity.
    pub quantity: MeasuredQuantity,
    /// Whether the model observes the response point of the study, whose maxima are stored.
    pub at_response_point: bool,
    /// The filter before the maximum is taken.
    pub filter: Option<Filter>,
    /// Distance of solutions that are computed again [Hz].
    pub spacing_hz: f64,
    /// Samples in an excitation period.
    pub samples: usize,
}

/// Why there are no curves.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObservationError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// No orbit can be gone over.
    #[error(transparent)]
    NoneSampled(#[from] NoneSampled),
    /// The filter refuses.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Nothing of the motion is left to compare.
    #[error(
        "the low-pass filter of {cut_off_hz} Hz leaves {left:.1e} of the computed motion over \
        {duration_s:.6} s, less than one step of 24 bits: there is nothing to compare with; is the cut-off \
        that of the measurement?"
    )]
    #[expect(missing_docs, reason = "the message names its fields")]
    FilteredAway { cut_off_hz: f64, left: f64, duration_s: f64 },
    /// A force behind a filter.
    #[error("contact forces are not filtered: an accelerometer's filter does not see them")]
    FilteredForce,
}

/// Curves of an observation over all branches.
///
/// * `model`: that of the study; its response point is where the sensor is.
///
/// # Errors
/// [`ObservationError`].
pub fn curves(
    branches: &StoredBranches,
    model: &Model,
    observation: &Observation,
) -> Result<Curves, ObservationError> {
    let is_stored = match observation.quantity {
        MeasuredQuantity::Force => true,
        MeasuredQuantity::Velocity => false,
        _ => observation.at_response_point,
    };
    if observation.filter.is_none() && is_stored {
        return Ok(stored(branches, observation.quantity));
    }
    gone_over(branches, model, observation, |history| {
        let series = match observation.quantity {
            MeasuredQuantity::Displacement => &history.displacement,
            MeasuredQuantity::Velocity => &history.velocity,
            MeasuredQuantity::Acceleration => &history.acceleration,
            _ => return Err(ObservationError::FilteredForce),
        };
        match observation.filter {
            Some(filter) => behind(series, history.duration_s, filter),
            None => Ok(largest(series)),
        }
    })
}

/// Largest value behind a filter that leaves something.
fn behind(series: &[f64], duration_s: f64, filter: Filter) -> Result<f64, ObservationError> {
    let (largest, left) = largest_behind(series, duration_s, filter)?;
    if left < LEFT {
        return Err(ObservationError::FilteredAway { cut_off_hz: filter.cut_off_hz, left, duration_s });
    }
    Ok(largest)
}

/// Curves of stored solutions that are some distance apart and gone over again: `value` gives that of an
/// orbit. One whose motion cannot be gone over leaves a gap; it is an error only if none can.
fn gone_over(
    branches: &StoredBranches,
    model: &Model,
    observation: &Observation,
    value: impl Fn(&MotionHistory) -> Result<f64, ObservationError>,
) -> Result<Curves, ObservationError> {
    let all = branches.branches();
    let places = all.iter().enumerate().flat_map(|(index, branch)| {
        thinned(branch, observation.spacing_hz).into_iter().map(move |(row, placed)| (index, row, placed))
    });
    let places: Vec<(usize, usize, &PlacedRow)> = places.collect();
    let (values, _) = sampled(places.iter().map(|(index, _, placed)| {
        let orbit = branches.solution(&all[*index], placed)?;
        let history = history(model, &orbit, observation.samples);
        history.map_or_else(|reason| Ok(Err(reason)), |history| value(&history).map(Ok))
    }))?;
    let mut curves: Vec<BranchCurve> = all.iter().map(empty).collect();
    for ((index, row, placed), value) in places.into_iter().zip(values) {
        let (frequency_hz, stable) = (placed.row.frequency_hz, placed.row.stability.may_be_stable());
        let value = value.unwrap_or(f64::NAN);
        curves[index].points.push(CurvePoint { frequency_hz, value, stable, row: row + 1 });
    }
    Ok(Curves::new(curves))
}

fn stored(branches: &StoredBranches, quantity: MeasuredQuantity) -> Curves {
    let of = |branch: &StoredBranch| {
        let point = |(index, placed): (usize, &PlacedRow)| CurvePoint {
            frequency_hz: placed.row.frequency_hz,
            value: match quantity {
                MeasuredQuantity::Displacement => placed.row.maxima.displacement,
                MeasuredQuantity::Force => placed.row.maxima.contact_force,
                _ => placed.row.maxima.acceleration,
            },
            stable: placed.row.stability.may_be_stable(),
            row: index + 1,
        };
        BranchCurve { points: branch.rows.iter().enumerate().map(point).collect(), ..empty(branch) }
    };
    Curves::new(branches.branches().iter().map(of).collect())
}

fn empty(branch: &StoredBranch) -> BranchCurve {
    let record = &branch.record;
    BranchCurve { branch: record.id, period_multiple: record.period_multiple, points: Vec::new() }
}

/// Change of a stored maximum beyond which a solution is kept however near the last one is.
const CHANGE: f64 = 0.05;

/// Solutions that are far enough apart in frequency or value, where stability changes, and both ends.
pub(crate) fn thinned(branch: &StoredBranch, spacing_hz: f64) -> Vec<(usize, &PlacedRow)> {
    let mut kept: Vec<(usize, &PlacedRow)> = Vec::new();
    let count = branch.rows.len();
    for (index, placed) in branch.rows.iter().enumerate() {
        let row = &placed.row;
        let far = |last: &PlacedRow| {
            let ratio = row.maxima.displacement / last.row.maxima.displacement;
            (row.frequency_hz - last.row.frequency_hz).abs() >= spacing_hz
                || (ratio.ln().abs() > CHANGE)
                || row.stability != last.row.stability
                || row.events.has(BranchEventKind::Fold)
        };
        if index + 1 == count || kept.last().is_none_or(|(_, last)| far(last)) {
            kept.push((index, placed));
        }
    }
    kept
}
