//! What came of a run, branch by branch.

use std::{collections::BTreeMap, path::PathBuf};

use hammerbeam_orbit::Stability;
use hammerbeam_results::{
    store::{JobRecord, PieceBranchRecord, PieceRecord, WalkRecord},
    summary::{BranchSummary, Peak},
};
use hammerbeam_study::{UndampedInContact, UndampedMode};
use serde::{Serialize, Serializer};

use super::RunOutcome;
use crate::{
    MirrorImage,
    check::{in_contact_documents, undamped_documents},
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
    pub varied: Vec<PieceRecord>,
    /// Searches, flips and branch points at which branches were looked for.
    pub searches: Vec<JobRecord>,
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

    /// Those of which nothing came or that were not complete, with the reason.
    pub fn failed(&self) -> impl Iterator<Item = (&JobRecord, &str)> {
        let ended = self.searches.iter().filter(|search| search.outcome.is_some());
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
        struct Document<'a> {
            unfinished: usize,
            failed: Vec<Failed<'a>>,
            results: String,
            title: &'a str,
            solutions: u64,
            branches: &'a [BranchReport],
            varied: Vec<PieceDocument<'a>>,
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
        struct Document<'a> {
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
            up: WalkDocument<'a>,
            down: WalkDocument<'a>,
            mirror_image: Option<Image>,
        }
        let summary = &self.summary;
        let document = Document {
            branch: summary.record.id,
            period_multiple: summary.record.period_multiple,
            solutions: summary.solutions,
            stable_solutions: summary.stable,
            marginal_solutions: summary.marginal,
            frequency_hz: summary.range_hz,
            folds: summary.folds,
            flips: summary.flips,
            flips_not_followed: summary.flips_not_followed,
            neimark_sacker_points: summary.neimark_sackers,
            branch_points: summary.branch_points,
            grazings: summary.grazings,
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
struct WalkDocument<'a> {
    solutions: u64,
    stop_reason: Option<&'a str>,
    stop_frequency_hz: Option<f64>,
    stop_message: Option<&'a str>,
}

impl<'a> From<&'a WalkRecord> for WalkDocument<'a> {
    fn from(walk: &'a WalkRecord) -> Self {
        let reason = walk.reason.as_ref();
        Self {
            solutions: walk.solutions,
            stop_reason: reason.map(|reason| reason.kind.as_str()),
            stop_frequency_hz: reason.and_then(|reason| reason.frequency_hz),
            stop_message: reason.map(|reason| reason.message.as_str()),
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
    branches: Vec<PieceBranchDocument<'a>>,
}

#[derive(Serialize)]
struct PieceBranchDocument<'a> {
    branch: u32,
    of: &'a str,
    period_multiple: u32,
    solutions: u32,
    stable_solutions: u32,
    marginal_solutions: u32,
    events: &'a BTreeMap<String, u32>,
    parameter: [f64; 2],
    up: &'a str,
    down: &'a str,
}

impl<'a> From<&'a PieceRecord> for PieceDocument<'a> {
    fn from(piece: &'a PieceRecord) -> Self {
        Self {
            piece: piece.id,
            kind: if piece.is_curve { "curve" } else { "vary" },
            parameter_name: &piece.parameter,
            message: piece.message.as_deref(),
            branches: piece.branches.iter().map(PieceBranchDocument::from).collect(),
        }
    }
}

impl<'a> From<&'a PieceBranchRecord> for PieceBranchDocument<'a> {
    fn from(branch: &'a PieceBranchRecord) -> Self {
        Self {
            branch: branch.branch,
            of: &branch.kind,
            period_multiple: branch.period_multiple,
            solutions: branch.rows,
            stable_solutions: branch.stable,
            marginal_solutions: branch.marginal,
            events: &branch.events,
            parameter: branch.range,
            up: &branch.up,
            down: &branch.down,
        }
    }
}
