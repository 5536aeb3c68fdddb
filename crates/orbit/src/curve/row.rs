//! A curve of bifurcations as it is asked for and as it comes out: kind and ranges, rows with their events,
//! ends.

use hammerbeam_motion::Parameter;

use crate::{BranchEventKind, EventSet, PeriodicSolution};

/// What is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveKind {
    /// A multiplier at +1.
    Fold,
    /// A multiplier at -1.
    Flip,
    /// A complex pair on the unit circle.
    NeimarkSacker,
    /// A contact that is touched with zero velocity.
    Grazing {
        /// Which one, in the order of the elements and their contacts; `None` for the one that comes nearest
        /// to grazing.
        contact: Option<usize>,
    },
}

/// Where and how far a curve is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSettings {
    /// The second parameter.
    pub parameter: Parameter,
    /// Its range, in its unit; the curve is cut exactly at the ends.
    pub range: (f64, f64),
    /// Range of the frequency [Hz]; the curve is cut exactly at its ends, too.
    pub range_hz: (f64, f64),
    /// Longest step, in hundredths of the ranges.
    pub max_step: f64,
    /// Most rows.
    pub max_rows: usize,
}

/// What happens at a row of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CurveEvents {
    /// First row.
    pub start: bool,
    /// The second parameter turns.
    pub turn: bool,
    /// Two folds meet.
    pub cusp: bool,
    /// A multiplier at +1 and one at -1.
    pub fold_flip: bool,
    /// A multiplier at +1 and a complex pair on the unit circle.
    pub fold_neimark_sacker: bool,
    /// A multiplier at -1 and a complex pair on the unit circle.
    pub flip_neimark_sacker: bool,
    /// Two complex pairs on the unit circle.
    pub double_neimark_sacker: bool,
    /// A flip that changes its criticality.
    pub degenerate_flip: bool,
    /// A branch point, at which the orbits of a symmetric system lose their symmetry, that changes its
    /// criticality.
    pub degenerate_branch_point: bool,
    /// A Neimark-Sacker point that changes its criticality.
    pub degenerate_neimark_sacker: bool,
    /// Resonance 1:n.
    pub resonance: Option<u8>,
    /// A grazing orbit has a multiplier at +1.
    pub grazing_fold: bool,
    /// A grazing orbit has a multiplier at -1.
    pub grazing_flip: bool,
    /// A grazing orbit has a complex pair on the unit circle.
    pub grazing_neimark_sacker: bool,
    /// A touch without curvature.
    pub degenerate_grazing: bool,
    /// A grazing orbit grazes a second contact, or the same one a second time.
    pub double_grazing: bool,
    /// The contacts of an orbit that is no grazing one change.
    pub grazing: bool,
}

impl CurveEvents {
    /// The names of the events joined by `+`, empty if there are none.
    #[must_use]
    pub fn label(self) -> String {
        EventSet::from(self).label()
    }
}

impl From<CurveEvents> for EventSet {
    fn from(events: CurveEvents) -> Self {
        Self::of([
            (events.start, BranchEventKind::Start),
            (events.turn, BranchEventKind::Turn),
            (events.cusp, BranchEventKind::Cusp),
            (events.fold_flip, BranchEventKind::FoldFlip),
            (events.fold_neimark_sacker, BranchEventKind::FoldNeimarkSacker),
            (events.flip_neimark_sacker, BranchEventKind::FlipNeimarkSacker),
            (events.double_neimark_sacker, BranchEventKind::DoubleNeimarkSacker),
            (events.degenerate_flip, BranchEventKind::DegenerateFlip),
            (events.degenerate_branch_point, BranchEventKind::DegenerateBranchPoint),
            (events.degenerate_neimark_sacker, BranchEventKind::DegenerateNeimarkSacker),
            (events.grazing_fold, BranchEventKind::GrazingFold),
            (events.grazing_flip, BranchEventKind::GrazingFlip),
            (events.grazing_neimark_sacker, BranchEventKind::GrazingNeimarkSacker),
            (events.degenerate_grazing, BranchEventKind::DegenerateGrazing),
            (events.double_grazing, BranchEventKind::DoubleGrazing),
            (events.grazing, BranchEventKind::GrazingOnCurve),
            (events.resonance == Some(1), BranchEventKind::Resonance11),
            (events.resonance == Some(2), BranchEventKind::Resonance12),
            (events.resonance == Some(3), BranchEventKind::Resonance13),
            (events.resonance == Some(4), BranchEventKind::Resonance14),
        ])
    }
}

/// One row of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveRow {
    /// Value of the second parameter, in its unit.
    pub parameter: f64,
    /// The orbit, with the frequency.
    pub solution: PeriodicSolution,
    /// Phase at which the contact is touched [cycles], on a curve of grazing orbits.
    pub phase: Option<f64>,
    /// What happens there.
    pub events: CurveEvents,
}

impl CurveEvents {
    /// What the end of a curve makes of its last row: where a fold, flip or Neimark-Sacker point meets a
    /// grazing, its multipliers belong to a grazing orbit. Such a *resonant grazing* is a point of
    /// codimension two, at which the curve ends on the grazing curve.
    pub fn mark_end(&mut self, kind: CurveKind, end: &CurveEnd) {
        if !matches!(end, CurveEnd::Grazing { .. }) {
            return;
        }
        match kind {
            CurveKind::Fold => self.grazing_fold = true,
            CurveKind::Flip => self.grazing_flip = true,
            CurveKind::NeimarkSacker => self.grazing_neimark_sacker = true,
            CurveKind::Grazing { .. } => {}
        }
    }
}

impl CurveKind {
    /// The name of a resonant grazing at which a curve ends, as [`CurveEvents::label`] has it; `None`
    /// for a curve of grazings.
    #[must_use]
    pub fn resonant_grazing(self) -> Option<&'static str> {
        match self {
            Self::Fold => Some("grazing-fold"),
            Self::Flip => Some("grazing-flip"),
            Self::NeimarkSacker => Some("grazing-neimark-sacker"),
            Self::Grazing { .. } => None,
        }
    }
}

/// Why a curve ended.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveEnd {
    /// End of the range of the second parameter.
    RangeEnd,
    /// The frequency left its range.
    FrequencyRangeEnd,
    /// The curve came back to its start.
    Closed,
    /// A Neimark-Sacker curve ends at a resonance 1:1 or 1:2.
    Resonance,
    /// The orbits, one of a pair of images until then, are their own image, where these branch off: the curve
    /// of their folds goes on as its own image, over the same parameters.
    OwnImage {
        /// Value of the second parameter there, in its unit.
        parameter: f64,
        /// Whether the images are mirror images and the orbits become symmetric; else they become orbits of
        /// half the period.
        mirrored: bool,
    },
    /// The bifurcation has met a grazing, where matrices jump or go like the root of the distance: no step
    /// led on, or rows one after the other were at it as far as can be resolved.
    Grazing {
        /// Value of the second parameter at the last row, in its unit.
        parameter: f64,
        /// Why no step led on.
        cause: Option<String>,
    },
    /// The contact opposite to the one that is followed, which is touched half a period later where orbits
    /// are symmetric, is grazed as well at the last row; beyond it would be struck.
    GrazedAsWell {
        /// Value of the second parameter at the last row, in its unit.
        parameter: f64,
        /// Name of the local element.
        element: String,
    },
    /// Beyond the last row a contact opens and is pressed on again at once. With an impact-speed-dependent
    /// law its force jumps there, and so does the motion.
    ContactReopens {
        /// Value of the second parameter at the last row, in its unit.
        parameter: f64,
        /// Name of the local element.
        element: String,
        /// Phase of the excitation at which that happens [cycles].
        phase: f64,
    },
    /// Thousands of rows did not get anywhere.
    NoProgress {
        /// Value of the second parameter at the last row, in its unit.
        parameter: f64,
        /// So many rows.
        rows: u32,
    },
    /// The budget of rows is used up.
    Budget,
    /// It could not be followed further.
    Stopped {
        /// Value of the second parameter at the last row, in its unit.
        parameter: f64,
        /// Why.
        message: String,
    },
}

impl CurveEnd {
    /// The same end with its value of the parameter in another unit.
    #[must_use]
    pub fn in_unit(mut self, unit: impl Fn(f64) -> f64) -> Self {
        match &mut self {
            Self::OwnImage { parameter, .. }
            | Self::Grazing { parameter, .. }
            | Self::GrazedAsWell { parameter, .. }
            | Self::ContactReopens { parameter, .. }
            | Self::NoProgress { parameter, .. }
            | Self::Stopped { parameter, .. } => *parameter = unit(*parameter),
            Self::RangeEnd | Self::FrequencyRangeEnd | Self::Closed | Self::Resonance | Self::Budget => {}
        }
        self
    }
}
