//! Measured points held against branches of periodic solutions.
//!
//! A point `i` was measured at the excitation frequency `f_i` with the largest value `A_i` of some quantity.
//! The model answers at a shifted frequency, and values differ by a factor:
//!
//! `f_i' = c f_i` or `f_i' = f_i + d`, `A_i' = a A_i`, `r_i = ln(a A_i) - ln M(f_i')`
//!
//! with the value `M` of the *nearest stable* solution of the measured period at `f_i'` (every stable one
//! where the period is not known). Logarithms, since values span decades and a factor on them is what is
//! sought; a difference of 0.1 is about 10 %.
//!
//! **Factor or offset.** A model whose modulus, density or contact mass is off has all eigenfrequencies off
//! by about one factor, and with them every resonance, superharmonic or subharmonic: a factor is the usual
//! choice, and the paper's (+6 %). An offset describes a wrong reading of the frequency.
//!
//! **The fit** minimises `sum min(r_i^2, R^2)` over what is not given, where a point that no stable branch of
//! its period meets counts `R^2` too: points farther off than the factor `exp(R)` pull at nothing, and no
//! shift is rewarded for losing points. `R` is twice the logarithm of the reach within which a branch
//! explains a point: with the reach itself, a shift that happens to fit half of the points closely may win
//! over one that fits all of them fairly. At a shift the best factor follows from going over all of them in
//! their order (`fit/problem.rs`); over the shift the sum has many minima, since branches have many peaks, so
//! all shifts of a grid are tried, the lowest valleys are gone over with finer and finer grids, and the
//! lowest place is taken (`fit/search.rs`). Nothing leaves what is tried: a number that stays at an end of it
//! is no minimum and has no standard error, and those of the other one are for that end. With `n` points
//! nearer than `R`, `p` fitted numbers and `J = dr/dp`, standard errors (`fit/errors.rs`) are the roots of
//! the diagonal of `(J^T J)^-1 sum r_i^2 / (n - p)`. Slopes of branches in `J` are secants over 0.5 % of the
//! frequency: at a fold the tangent says nothing of where points will lie. The errors hold for the matching
//! that was found, and for differences that are independent; a model that is wrong makes them too small.
//!
//! **The residual** is told of the points within the reach, and of all that meet a branch. The latter is not
//! what the fit makes small: a shift at which more points meet a branch, one of them far off, has a smaller
//! sum and a larger residual of all that meet one.
//!
//! **Another minimum** that is about as good is told, the lowest of those that worse shifts part from the
//! best one; with sums `F` and `F'` over all points, and `S` over the `n` points nearer than `R` to the best
//! one, it counts if `(n - p)(F' - F)/S` is below 3.84 (chi-squared of one freedom, 95 %), or `(F' - F)/S`
//! below 0.1. What points that never fit add to `F` and `F'` drops out.
//!
//! Aperiodic and doubtful points take no part: branches are of periodic solutions. They are listed with the
//! branch that is nearest, stable or not.
//!
//! | file | what |
//! |---|---|
//! | `curve.rs` | branches as curves of one quantity, by frequency |
//! | `course.rs` | an orbit in samples, also behind a filter; orbits that cannot be gone over |
//! | `observed.rs` | from stored branches to such curves |
//! | `fit/` | shift and factor |
//! | `judge.rs` | what becomes of each point |
//! | `overlay/` | a measured course laid over orbits |
//! | `measured.rs`, `records.rs` | tables of points, and records that are reduced to points |
//! | `whole.rs`, `tables.rs`, `document.rs` | all quantities of a results folder, their tables, their document |

pub mod course;
mod curve;
mod document;
mod fit;
mod judge;
mod measured;
mod observed;
mod overlay;
mod records;
mod tables;
mod whole;

use hammerbeam_signal::{
    MeasuredQuantity,
    points::{MeasuredKind, MeasuredPoint},
};

pub use curve::{BranchCurve, CurvePoint, Curves, Hit};
pub(crate) use document::comparison_document;
pub use document::{CompareReport, ComparedQuantity};
pub use fit::{Estimate, Fit, FitSettings, Fixed, Origin, SecondMinimum};
pub use judge::{Match, PointOutcome, Verdict};
pub use measured::{MeasuredError, MeasuredPoints, read_measured};
pub(crate) use observed::thinned;
pub use observed::{Filter, Observation, ObservationError, curves};
pub use overlay::{
    Alike, LaidWaveform, Overlay, OverlayAdvice, OverlayError, OverlayNote, OverlaySettings, Sought,
    nothing_alike, overlay,
};
pub use records::frequency_in_name;
pub use tables::{ExcitationAmplitudes, write_amplitudes, write_points};
pub use whole::{compare_results, write_compared};

/// Why there is no comparison.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ComparisonError {
    /// The quantity was not measured.
    #[error("no point has a measured {quantity}")]
    NothingMeasured { quantity: &'static str },
    /// Too few points for what is to be fitted.
    #[error(
        "{fitted} number(s) are to be fitted to {quantity}, but of {measured} periodic point(s), at the best shift and factor that were tried, {met} meet a stable branch of their period and only {near} of them lie within a factor of {} of it; are frequency and unit right? Give --frequency-factor or --frequency-offset and --amplitude-factor, or measure more",
        to_digits(*ratio)
    )]
    TooFewPoints {
        quantity: &'static str,
        fitted: usize,
        measured: usize,
        met: usize,
        near: usize,
        ratio: f64,
    },
    /// A number that makes no sense.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: &'static str },
}

/// A number rounded to six significant digits.
fn to_digits(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

/// How measured frequencies become those of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrequencyShift {
    /// `f' = c f`.
    Factor(f64),
    /// `f' = f + d` [Hz].
    Offset(f64),
}

impl FrequencyShift {
    /// The frequency of the model [Hz].
    #[must_use]
    pub fn apply(self, frequency_hz: f64) -> f64 {
        match self {
            Self::Factor(factor) => factor * frequency_hz,
            Self::Offset(offset_hz) => frequency_hz + offset_hz,
        }
    }
}

/// Shift of frequencies and factor on values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// Of the frequencies.
    pub frequency: FrequencyShift,
    /// Factor on measured values.
    pub amplitude_factor: f64,
}

/// How well points lie on branches.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// Periodic points that meet a stable branch of their period.
    pub met: usize,
    /// Of those, points within the reach.
    pub within: usize,
    /// Root mean square of the logarithmic differences of all that meet one; 0 without any.
    pub rms: f64,
    /// The same of those within the reach.
    pub rms_within: f64,
}

/// A comparison of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The quantity.
    pub quantity: MeasuredQuantity,
    /// Shift and factor, and how well they are known.
    pub fit: Fit,
    /// Without shift and factor.
    pub before: Residual,
    /// With them.
    pub after: Residual,
    /// Each point that has the quantity, in their order.
    pub points: Vec<PointOutcome>,
}

/// Compares points with branches.
///
/// * `curves`: of the quantity.
///
/// # Errors
/// [`ComparisonError`].
pub fn compare(
    points: &[MeasuredPoint],
    curves: &Curves,
    quantity: MeasuredQuantity,
    settings: &FitSettings,
) -> Result<Comparison, ComparisonError> {
    settings.check()?;
    let measured: Vec<&MeasuredPoint> =
        points.iter().filter(|point| point.maxima.of(quantity).is_some()).collect();
    if measured.is_empty() {
        return Err(ComparisonError::NothingMeasured { quantity: quantity.word() });
    }
    let used: Vec<fit::Used> = measured.iter().filter_map(|point| fit::Used::of(point, quantity)).collect();
    let fit = fit::fit(&used, curves, quantity, settings)?;
    let identity = Shift { frequency: FrequencyShift::Factor(1.0), amplitude_factor: 1.0 };
    let reach = settings.reach.ln();
    let outcomes = measured.iter().map(|point| judge::judge(point, curves, quantity, fit.shift(), reach));
    Ok(Comparison {
        quantity,
        before: fit::residual(&used, curves, identity, reach),
        after: fit::residual(&used, curves, fit.shift(), reach),
        points: outcomes.collect(),
        fit,
    })
}

/// Whether a point takes part in a fit, and the period that its branch must have.
fn period_of(kind: MeasuredKind) -> Option<Option<u32>> {
    match kind {
        MeasuredKind::Periodic { period_multiple } => Some(period_multiple),
        MeasuredKind::Unknown => Some(None),
        MeasuredKind::Aperiodic | MeasuredKind::Doubtful => None,
    }
}
