//! What came of a run, branch by branch.

use std::{collections::BTreeMap, path::PathBuf};

use hammerbeam_orbit::{BranchEventKind, Side, Stability};
use hammerbeam_results::{
    end_text::{BranchOver, NOT_FINISHED, sentence},
    store::{JobKind, JobOutcome, JobRecord, PieceRecord, WalkRecord},
    summary::{BranchSummary, Peak, PieceSummary},
};
use hammerbeam_study::{UndampedInContact, UndampedMode};
use serde::{Serialize, Serializer};

use super::{RunOutcome, known::SAME_FREQUENCY};
use crate::{
    MirrorImage,
    check::{in_contact_documents, undamped_documents},
    outputs::OutputPass,
};

/// What came of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunReport {
    /// How the run came to its end.
    pub outcome: RunOutcome,
    /// Title of the study.
    pub title: String,
    /// The results folder.
    pub results: PathBuf,
    /// Branches over the frequency.
    pub branches: Vec<BranchReport>,
    /// Branches in other parameters and curves.
    pub varied: Vec<PieceSummary>,
    /// Searches, flips and branch points at which branches were looked for.
    pub searches: Vec<JobRecord>,
    /// What was read off stored orbits.
    pub outputs: OutputPass,
    /// Modes without damping,
    pub undamped_modes: Vec<UndampedMode>,
    /// and those without damping while stops are closed.
    pub undamped_in_contact: Vec<UndampedInContact>,
    /// Names of the figures that were drawn into the folder.
    pub figures: Vec<String>,
}

/// A branch over the frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchReport {
    /// The branch in few numbers.
    pub summary: BranchSummary,
    /// Where its mirror image is, of a symmetric system.
    pub mirror_image: Option<MirrorImage>,
}

impl RunReport {
    /// Number of solutions on all branches over the frequency.
    #[must_use]
    pub fn solutions(&self) -> u64 {
        self.branches.iter().map(|branch| branch.summary.solutions).sum()
    }

    /// Searches, flips and branch points that the run has not come to.
    #[must_use]
    pub fn left(&self) -> usize {
        self.searches.iter().filter(|search| search.outcome.is_none()).count()
    }

    /// Those of which nothing came or that were not complete, with the reason. Where a stored branch ends at
    /// the flip or grazing from which another one was looked for, that is the other one.
    pub fn failed(&self) -> impl Iterator<Item = (&JobRecord, &str)> {
        let records = self.branches.iter().map(|branch| &branch.summary.record);
        let ends = records.flat_map(|record| [&record.up, &record.down]).filter_map(|walk| walk.end.as_ref());
        let met: Vec<f64> =
            ends.filter(|end| end.is_shorter_period()).filter_map(|end| end.place()).collect();
        let is_met = move |search: &JobRecord| {
            let is_there =
                |at: &f64| (at - search.frequency_hz).abs() <= SAME_FREQUENCY * search.frequency_hz;
            let is_doubling = search.kind == JobKind::Doubling;
            search.outcome == Some(JobOutcome::Nothing) && is_doubling && met.iter().any(is_there)
        };
        let ended = self.searches.iter().filter(move |search| search.outcome.is_some() && !is_met(search));
        ended.filter_map(|search| Some((search, search.message.as_deref()?)))
    }
}

impl Serialize for RunReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Failed<'a> {
            frequency_hz: f64,
            message: &'a str,
        }
        #[derive(Serialize)]
        struct OutputsDocument {
            computed: u64,
            failed: u64,
        }
        #[derive(Serialize)]
        struct Document<'a> {
            unfinished: usize,
            failed: Vec<Failed<'a>>,
            results: String,
            title: &'a str,
            solutions: u64,
            branches: &'a [BranchReport],
            varied: Vec<PieceDocument<'a>>,
            outputs: OutputsDocument,
            undamped_in_contact: serde_json::Value,
            undamped_modes: serde_json::Value,
            figures: &'a [String],
        }
        let failed = |(search, message): (&'_ JobRecord, _)| (search.frequency_hz, message);
        let failed = self.failed().map(failed);
        let document = Document {
            unfinished: self.left(),
            failed: failed.map(|(frequency_hz, message)| Failed { frequency_hz, message }).collect(),
            results: self.results.display().to_string(),
            title: &self.title,
            solutions: self.solutions(),
            branches: &self.branches,
            varied: self.varied.iter().map(PieceDocument::from).collect(),
            outputs: OutputsDocument {
                computed: self.outputs.solutions - self.outputs.failed,
                failed: self.outputs.failed,
            },
            undamped_in_contact: in_contact_documents(&self.undamped_in_contact),
            undamped_modes: undamped_documents(&self.undamped_modes),
            figures: &self.figures,
        };
        document.serialize(serializer)
    }
}

impl Serialize for BranchReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        #[serde(untagged)]
        enum Image {
            Branch(u32),
            Word(&'static str),
        }
        #[derive(Serialize)]
        struct Document {
            branch: u32,
            period_multiple: u32,
            solutions: u64,
            stable_solutions: u64,
            marginal_solutions: u64,
            frequency_hz: [f64; 2],
            folds: u64,
            flips: u64,
            flips_not_followed: u64,
            neimark_sacker_points: u64,
            branch_points: u64,
            grazings: u64,
            peaks: Vec<PeakDocument>,
            up: WalkDocument,
            down: WalkDocument,
            mirror_image: Option<Image>,
        }
        let summary = &self.summary;
        let count = |kind| summary.events.of(kind);
        let document = Document {
            branch: summary.record.id,
            period_multiple: summary.record.period_multiple,
            solutions: summary.solutions,
            stable_solutions: summary.stable,
            marginal_solutions: summary.marginal,
            frequency_hz: summary.range,
            folds: count(BranchEventKind::Fold),
            flips: count(BranchEventKind::Flip),
            flips_not_followed: summary.flips_not_followed,
            neimark_sacker_points: count(BranchEventKind::NeimarkSacker),
            branch_points: count(BranchEventKind::BranchPoint),
            grazings: count(BranchEventKind::Grazing),
            peaks: summary.peaks.iter().map(PeakDocument::from).collect(),
            up: WalkDocument::from(&summary.record.up),
            down: WalkDocument::from(&summary.record.down),
            mirror_image: self.mirror_image.map(|image| match image {
                MirrorImage::Itself => Image::Branch(summary.record.id),
                MirrorImage::Branch(other) => Image::Branch(other),
                MirrorImage::Given => Image::Word("not stored"),
            }),
        };
        document.serialize(serializer)
    }
}

#[derive(Serialize)]
struct WalkDocument {
    solutions: u64,
    stop_reason: Option<&'static str>,
    stop_frequency_hz: Option<f64>,
    stop_message: Option<String>,
}

impl From<&WalkRecord> for WalkDocument {
    fn from(walk: &WalkRecord) -> Self {
        let end = walk.end.as_ref();
        Self {
            solutions: walk.solutions,
            stop_reason: end.map(|end| end.word()),
            stop_frequency_hz: end.and_then(|end| end.place()),
            stop_message: end.map(|end| sentence(end, BranchOver::Frequency)),
        }
    }
}

#[derive(Serialize)]
struct PeakDocument {
    frequency_hz: f64,
    equal_hz: [f64; 2],
    equal_solutions: u64,
    max_abs_displacement_m: f64,
    stable: bool,
    stability: &'static str,
}

impl From<&Peak> for PeakDocument {
    fn from(peak: &Peak) -> Self {
        Self {
            frequency_hz: peak.frequency_hz,
            equal_hz: peak.equal_hz,
            equal_solutions: peak.equal,
            max_abs_displacement_m: peak.max_abs_displacement_m,
            stable: peak.stability == Some(Stability::Stable),
            stability: peak_stability(peak),
        }
    }
}

/// Whether a peak is stable, in words.
#[must_use]
pub fn peak_stability(peak: &Peak) -> &'static str {
    peak.stability.map_or("in part stable", Stability::word)
}

#[derive(Serialize)]
struct PieceDocument<'a> {
    piece: u32,
    kind: &'static str,
    parameter_name: &'a str,
    message: Option<&'a str>,
    branches: Vec<PieceBranchDocument>,
}

#[derive(Serialize)]
struct PieceBranchDocument {
    branch: u32,
    of: &'static str,
    period_multiple: u32,
    solutions: u64,
    stable_solutions: u64,
    marginal_solutions: u64,
    events: BTreeMap<&'static str, u64>,
    parameter: [f64; 2],
    up: String,
    down: String,
    up_stop: StopDocument,
    down_stop: StopDocument,
}

/// How a side ended, for programs.
#[derive(Serialize)]
struct StopDocument {
    solutions: u64,
    stop_reason: Option<&'static str>,
    stop_parameter: Option<f64>,
}

impl From<&WalkRecord> for StopDocument {
    fn from(walk: &WalkRecord) -> Self {
        let end = walk.end.as_ref();
        Self {
            solutions: walk.solutions,
            stop_reason: end.map(|end| end.word()),
            stop_parameter: end.and_then(|end| end.place()),
        }
    }
}

impl<'a> From<&'a PieceSummary> for PieceDocument<'a> {
    fn from(piece: &'a PieceSummary) -> Self {
        let record = &piece.record;
        Self {
            piece: record.place,
            kind: if record.kind.is_curve() { "curve" } else { "vary" },
            parameter_name: &record.parameter,
            message: record.message.as_deref(),
            branches: piece.branches.iter().map(|branch| branch_document(record, branch)).collect(),
        }
    }
}

fn branch_document(piece: &PieceRecord, branch: &BranchSummary) -> PieceBranchDocument {
    PieceBranchDocument {
        branch: branch.record.id,
        of: piece.kind.name(),
        period_multiple: branch.record.period_multiple,
        solutions: branch.solutions,
        stable_solutions: branch.stable,
        marginal_solutions: branch.marginal,
        events: branch.events.by_name(),
        parameter: branch.range,
        up: end_of_side(piece, branch, Side::Up),
        down: end_of_side(piece, branch, Side::Down),
        up_stop: StopDocument::from(&branch.record.up),
        down_stop: StopDocument::from(&branch.record.down),
    }
}

/// How a side of a branch over another parameter, or of a curve, ended, in a sentence.
#[must_use]
pub fn end_of_side(piece: &PieceRecord, branch: &BranchSummary, side: Side) -> String {
    let end = branch.record.walk(side).end.as_ref();
    end.map_or_else(|| NOT_FINISHED.to_owned(), |end| sentence(end, piece.along()))
}
