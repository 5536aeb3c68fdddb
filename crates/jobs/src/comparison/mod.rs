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
//! **The residual** is reported of the points within the reach, and of all that meet a branch. The latter is not
//! what the fit makes small: a shift at which more points meet a branch, one of them far off, has a smaller
//! sum and a larger residual of all that meet one.
//!
//! **Another minimum** that is about as good is reported, the lowest of those that worse shifts part from the
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
//! | `history.rs` | an orbit in samples, also behind a filter; orbits that cannot be gone over |
//! | `observed.rs` | from stored branches to such curves |
//! | `fit/` | shift and factor |
//! | `judge.rs` | what becomes of each point |
//! | `overlay/` | a measured history laid over orbits |
//! | `measured.rs`, `records.rs` | tables of points, and records that are reduced to points |
//! | `output.rs` | points over an output of the study |
//! | `whole.rs`, `tables.rs`, `document.rs` | all quantities of a results folder, their tables, their document |

mod curve;
mod document;
mod error;
mod fit;
pub mod history;
mod judge;
mod measured;
mod measured_error;
mod observed;
mod output;
mod overlay;
mod records;
mod shift;
mod tables;
mod whole;

use hammerbeam_signal::{MeasuredQuantity, points::MeasuredPoint};

pub use curve::{BranchCurve, CurvePoint, Curves, Hit};
pub(crate) use document::comparison_document;
pub use document::{CompareReport, ComparedQuantity};
pub use error::ComparisonError;
pub use fit::{Estimate, Fit, FitSettings, Fixed, Origin, Residual, SecondMinimum};
pub use history::Filter;
pub use judge::{Match, PointOutcome, Verdict};
pub use measured::{MeasuredPoints, read_measured};
pub use measured_error::MeasuredError;
pub(crate) use observed::thinned;
pub use observed::{Observation, ObservationError, curves};
pub use output::compare_output;
pub use overlay::{
    Alike, LaidWaveform, Overlay, OverlayAdvice, OverlayError, OverlayNote, OverlaySettings, Sought,
    nothing_alike, overlay,
};
pub use records::frequency_in_name;
pub use shift::{FrequencyShift, Shift};
pub use tables::{ExcitationAmplitudes, write_amplitudes, write_points};
pub use whole::{compare_results, write_compared};

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
