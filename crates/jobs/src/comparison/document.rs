//! A comparison as a document.

use std::path::PathBuf;

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{Comparison, Curves, Filter, FitEstimate, MeasuredPoints, Origin, PointOutcome, Residual};

/// A quantity with its curves and what came of it.
#[derive(Debug, Clone)]
pub struct ComparedQuantity {
    /// The branches.
    pub curves: Curves,
    /// The comparison.
    pub comparison: Comparison,
    /// Cut-off of the filter that the curves are behind [Hz], if there is one.
    pub low_pass_hz: Option<f64>,
    /// The point that was measured, if it is not the response point of the study.
    pub point: Option<String>,
    /// Range of the frequency of the study [Hz].
    pub range_hz: [f64; 2],
}

impl ComparedQuantity {
    /// How many points are shifted beyond the range of the study, where nothing is computed or drawn.
    #[must_use]
    pub fn beyond(&self) -> usize {
        let [low, high] = self.range_hz;
        self.comparison.points.iter().filter(|point| !(low..=high).contains(&point.shifted_hz)).count()
    }
}

/// What came of measured points over branches.
#[derive(Debug, Clone)]
pub struct CompareReport {
    /// Folder of the branches.
    pub results: PathBuf,
    /// Name of the point that was measured.
    pub point: String,
    /// Files and folders of what was measured.
    pub files_measured: Vec<PathBuf>,
    /// What they hold.
    pub measured: MeasuredPoints,
    /// The filter of the measurement.
    pub filter: Option<Filter>,
    /// Ratio up to which a point is explained by a branch.
    pub reach: f64,
    /// One comparison for each quantity.
    pub compared: Vec<ComparedQuantity>,
    /// Folder of the tables and figures.
    pub folder: PathBuf,
    /// Their names.
    pub files: Vec<String>,
    /// What has to be known of the measured excitation.
    pub excitation_notes: Vec<String>,
}

impl Serialize for CompareReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let findings = self.measured.findings.iter().map(
            |(file, finding)| json!({ "file": file, "kind": finding.kind(), "message": finding.to_string() }),
        );
        let document = json!({
            "results": self.results,
            "point": self.point,
            "measured": self.files_measured,
            "low_pass_hz": self.filter.map(|filter| filter.cut_off_hz),
            "order": self.filter.map(|filter| filter.order),
            "reach": self.reach,
            "findings": findings.collect::<Vec<_>>(),
            "comparisons": self.compared.iter().map(of_study).collect::<Vec<_>>(),
            "folder": self.folder,
            "files": self.files,
            "excitation_notes": self.excitation_notes,
        });
        document.serialize(serializer)
    }
}

/// A comparison of one quantity, how many points the range of the study leaves out, and how many solutions
/// could not be gone over.
fn of_study(compared: &ComparedQuantity) -> Value {
    let mut document = comparison_document(&compared.comparison);
    document["beyond_the_range"] = json!(compared.beyond());
    document["gaps"] = json!(compared.curves.gaps());
    document
}

/// A comparison of one quantity.
pub(crate) fn comparison_document(comparison: &Comparison) -> Value {
    let count = |wanted: &str| comparison.points.iter().filter(|p| p.verdict.word() == wanted).count();
    let unexplained = comparison.points.iter().filter(|point| point.verdict.is_unexplained());
    json!({
        "quantity": comparison.quantity.word(),
        "unit": comparison.quantity.symbol(),
        "frequency_shift": if comparison.fit.offset { "offset" } else { "factor" },
        "frequency_factor": (!comparison.fit.offset).then(|| estimate(comparison.fit.frequency)),
        "frequency_offset_hz": comparison.fit.offset.then(|| estimate(comparison.fit.frequency)),
        "amplitude_factor": estimate(comparison.fit.amplitude),
        "correlation": comparison.fit.correlation.filter(|value| value.is_finite()),
        "second_minimum": comparison.fit.second.map(|second| json!({
            "frequency": second.frequency,
            "amplitude_factor": second.amplitude,
            "sum_of_squares_over_best": second.cost_ratio,
            "fitted_points": second.points,
            "at_end_of_what_is_tried": second.at_end,
        })),
        "fitted_points": comparison.fit.points,
        "residual_before": residual(comparison.before),
        "residual_after": residual(comparison.after),
        "explained": count("explained"),
        "too_far": count("too-far"),
        "only_unstable": count("only-unstable"),
        "no_branch": count("no-branch"),
        "no_contact": count("no-contact"),
        "aperiodic": count("aperiodic"),
        "doubtful": count("doubtful"),
        "unexplained": unexplained.map(point_document).collect::<Vec<_>>(),
        "points": comparison.points.iter().map(point_document).collect::<Vec<_>>(),
    })
}

fn estimate(estimate: FitEstimate) -> Value {
    json!({
        "value": estimate.value,
        "standard_error": estimate.standard_error().filter(|error| error.is_finite()),
        "given": estimate.origin == Origin::Given,
        "at_end_of": estimate.ends().map(|(low, high)| [low, high]),
    })
}

fn residual(residual: Residual) -> Value {
    json!({
        "points": residual.met,
        "within_reach": residual.within,
        "log_rms": residual.rms,
        "log_rms_within_reach": residual.rms_within,
    })
}

/// A point.
fn point_document(outcome: &PointOutcome) -> Value {
    let nearest = outcome.nearest.map(|nearest| {
        json!({
            "branch": nearest.hit.branch,
            "period_multiple": nearest.hit.period_multiple,
            "stable": nearest.hit.stable,
            "row": nearest.hit.row,
            "value": nearest.hit.value,
            "log_difference": nearest.difference,
        })
    });
    json!({
        "origin": outcome.point.origin,
        "kind": outcome.point.kind.word(),
        "period_multiple": outcome.point.kind.period_multiple(),
        "frequency_hz": outcome.point.frequency_hz,
        "value": outcome.value,
        "shifted_frequency_hz": outcome.shifted_hz,
        "shifted_value": outcome.shifted_value,
        "verdict": outcome.verdict.word(),
        "nearest": nearest,
        "nearest_stable_hz": outcome.verdict.nearest_hz(),
        "stable_periods_there": outcome.stable_periods,
    })
}
