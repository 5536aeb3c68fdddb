//! A measured course laid over computed orbits.
//!
//! The measurement is a waveform over `n` excitation periods ([`hammerbeam_signal::waveform`]). Of the stable orbits of that period in a range of frequencies each goes through the
//! same sensor and filter (line by line of its spectrum, so that there is no transient), is delayed until it is most alike, and the most alike of all is taken: the largest correlation, or, where the factor on
//! measured values is given, the smallest residual. The paper does the same by eye (figures 7 to 14).

use std::sync::atomic::AtomicBool;

use hammerbeam_attractor::in_order;
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_signal::{
    Quantity, SignalError,
    filter::{periodic_low_pass, periodic_zero_phase},
    waveform::{Alignment, Shifts, Waveform, align, delayed},
};

use super::{
    Filter,
    course::{Course, CourseError, course, largest},
    thinned,
};
use crate::{Model, StoreError, StoredBranches, store::BranchRecord};

/// Samples of an orbit in an excitation period, before the filter; a multiple of those of the waveform.
const SAMPLES: usize = 4096;
/// Distance of orbits that are tried, as a part of the frequency.
const SPACING: f64 = 1e-3;

/// Which orbits are tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sought {
    /// Stored ones within a part of a frequency [Hz].
    Near {
        /// The frequency.
        frequency_hz: f64,
        /// The part.
        part: f64,
    },
    /// Those at a frequency [Hz], corrected there.
    At(f64),
}

/// How a course is laid over orbits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlaySettings {
    /// What the sensor measures: displacement, velocity or acceleration of the response point of the model.
    pub quantity: Quantity,
    /// The filter of the measurement, and whether it acts forwards and backwards.
    pub filter: Option<(Filter, bool)>,
    /// Which orbits are tried.
    pub sought: Sought,
    /// A branch, if it has to be that one.
    pub branch: Option<u32>,
    /// Which delays are allowed, in samples of the waveform.
    pub shifts: Shifts,
    /// The factor on measured values, where it is given; negative for a sensor that is turned around.
    pub factor: Option<f64>,
}

/// The orbit that is most alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlay {
    /// Its frequency [Hz].
    pub frequency_hz: f64,
    /// Number of its branch,
    pub branch: u32,
    /// and its row there, from 1 on; `None` if it was corrected at a frequency.
    pub row: Option<usize>,
    /// How it lies over the measurement; over its mirror image, if the factor is given and negative.
    pub alignment: Alignment,
    /// Largest correlation that an orbit among those tried has with the measurement turned around.
    pub turned_correlation: f64,
    /// Factor on measured values: given, or the best one.
    pub factor: f64,
    /// Root mean square of what is left over that of the computed course: without a factor,
    pub residual_before: f64,
    /// and with it.
    pub residual_after: f64,
    /// The measured quantity behind the filter, as it is delayed, at the samples of the waveform,
    pub filtered: Vec<f64>,
    /// and without the filter.
    pub unfiltered: Vec<f64>,
    /// Displacement of the point [m], and of the support [m], so delayed.
    pub displacement: Vec<f64>,
    /// See above.
    pub support: Vec<f64>,
    /// Largest value of the quantity before and behind the filter, of all samples of the orbit.
    pub largest: (f64, f64),
    /// Orbits that were tried.
    pub tried: usize,
}

/// Why nothing is laid over.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OverlayError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// An orbit cannot be gone over.
    #[error(transparent)]
    Course(#[from] CourseError),
    /// The waveform refuses.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A sensor that no orbit has.
    #[error("an orbit shows displacement, velocity and acceleration of a point, no {quantity}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NoSuchSensor { quantity: &'static str },
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}

/// Lays a measured waveform over the orbits of stored branches.
///
/// * `model`: that of the study; its response point is where the sensor is.
/// * `period_multiple`: of the waveform and the orbits.
///
/// # Returns
/// `None` if no stable orbit of the period is among those that are sought.
/// # Errors
/// [`OverlayError`].
pub fn overlay(
    (model, branches): (&Model, &StoredBranches),
    (measured, period_multiple): (&Waveform, u32),
    settings: &OverlaySettings,
    (threads, stop): (usize, &AtomicBool),
) -> Result<Option<Overlay>, OverlayError> {
    let wanted = |record: &BranchRecord| {
        record.period_multiple == period_multiple && settings.branch.is_none_or(|branch| branch == record.id)
    };
    let orbits = match settings.sought {
        Sought::Near { frequency_hz, part } => stored(branches, wanted, frequency_hz, part)?,
        Sought::At(frequency_hz) => at(model, branches, wanted, frequency_hz)?,
    };
    let look = |(): &mut (), candidate: &Candidate| laid(model, candidate, measured, settings);
    let tried = in_order(&orbits, threads, stop, || (), look).ok_or(OverlayError::Interrupted)?;
    let tried = tried.into_iter().collect::<Result<Vec<_>, _>>()?;
    let count = tried.len();
    let turned = tried.iter().map(|one| one.turned_correlation).fold(f64::NEG_INFINITY, f64::max);
    let worth = |one: &Overlay| match settings.factor {
        Some(_) => -one.residual_after,
        None => one.alignment.correlation,
    };
    // The first of equal ones, whatever the number of threads.
    let best = tried.into_iter().reduce(|best, one| if worth(&one) > worth(&best) { one } else { best });
    Ok(best.map(|best| Overlay { tried: count, turned_correlation: turned, ..best }))
}

/// Branch, row and orbit.
type Candidate = (u32, Option<usize>, PeriodicSolution);

fn stored(
    branches: &StoredBranches,
    wanted: impl Fn(&BranchRecord) -> bool,
    frequency_hz: f64,
    part: f64,
) -> Result<Vec<Candidate>, StoreError> {
    let mut orbits = Vec::new();
    for branch in branches.branches().iter().filter(|branch| wanted(&branch.record)) {
        for (index, placed) in thinned(branch, SPACING * frequency_hz) {
            let near = (placed.row.frequency_hz - frequency_hz).abs() <= part * frequency_hz;
            if near && placed.row.stable {
                orbits.push((branch.record.id, Some(index + 1), branches.solution(branch, placed)?));
            }
        }
    }
    Ok(orbits)
}

fn at(
    model: &Model,
    branches: &StoredBranches,
    wanted: impl Fn(&BranchRecord) -> bool,
    frequency_hz: f64,
) -> Result<Vec<Candidate>, StoreError> {
    let found = branches.crossings(model, frequency_hz, wanted)?.into_iter();
    let stable = found.filter(|(_, orbit)| orbit.stable());
    Ok(stable.map(|(branch, orbit)| (branch, None, orbit)).collect())
}

/// The quantity of a course.
fn sensed(course: &Course, quantity: Quantity) -> Result<&[f64], OverlayError> {
    match quantity {
        Quantity::Displacement => Ok(&course.displacement),
        Quantity::Velocity => Ok(&course.velocity),
        Quantity::Acceleration => Ok(&course.acceleration),
        other => Err(OverlayError::NoSuchSensor { quantity: other.word() }),
    }
}

fn laid(
    model: &Model,
    (branch, row, orbit): &Candidate,
    measured: &Waveform,
    settings: &OverlaySettings,
) -> Result<Overlay, OverlayError> {
    let finer = SAMPLES.div_ceil(measured.per_period);
    let course = course(model, orbit, finer * measured.per_period)?;
    let unfiltered = sensed(&course, settings.quantity)?;
    let filtered = match settings.filter {
        None => unfiltered.to_vec(),
        Some((filter, zero_phase)) => {
            let filter = (filter.order, filter.cut_off_hz);
            let behind = if zero_phase { periodic_zero_phase } else { periodic_low_pass };
            behind(unfiltered, course.duration_s, filter)?
        }
    };
    let shown = |series: &[f64]| -> Vec<f64> { series.iter().step_by(finer).copied().collect() };
    let narrow = shown(&filtered);
    let sign = settings.factor.map_or(1.0, f64::signum);
    let lie = |sign: f64| {
        let oriented: Vec<f64> = measured.samples.iter().map(|value| sign * value).collect();
        align(&oriented, &narrow, settings.shifts)
    };
    let alignment = lie(sign)?;
    let factor = settings.factor.unwrap_or(alignment.factor);
    // What is delayed by whole samples of the orbit has no overshoot at a contact.
    let turned = |series: &[f64]| -> Vec<f64> {
        let mut series = series.to_vec();
        let steps = (alignment.shift * finer as f64).round() as usize % series.len();
        series.rotate_right(steps);
        shown(&series)
    };
    Ok(Overlay {
        frequency_hz: orbit.frequency_hz,
        branch: *branch,
        row: *row,
        factor,
        residual_before: alignment.residual(1.0),
        residual_after: alignment.residual(factor.abs()),
        turned_correlation: lie(-sign)?.correlation,
        filtered: delayed(&narrow, alignment.shift)?,
        unfiltered: turned(unfiltered),
        displacement: turned(&course.displacement),
        support: turned(&course.support),
        largest: (largest(unfiltered), largest(&filtered)),
        alignment,
        tried: 0,
    })
}
