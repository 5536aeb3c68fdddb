//! The data of a response diagram: branches, measured points, settings.

use crate::{
    dots::{Dot, Shape},
    parameter_axis::ParameterAxis,
    scale::ScaleChoice,
    style::{INK, Style},
};

/// Branches of periodic solutions over the excitation frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseDiagram {
    /// Title above the figure; empty for most journals.
    pub title: String,
    /// The horizontal axis of branches over another parameter: fields for the frequency then hold that
    /// parameter. `None` for the frequency.
    pub parameter: Option<ParameterAxis>,
    /// The branches, in the order in which they are drawn.
    pub curves: Vec<ResponseCurve>,
    /// Ends of the frequency axis (Hz); by default the range of the data.
    pub frequency_range_hz: Option<(f64, f64)>,
    /// Frequency ranges with chaotic motion (Hz), shaded in the background.
    pub chaotic_ranges_hz: Vec<(f64, f64)>,
    /// Measured points, in the foreground.
    pub measured: Vec<MeasuredMark>,
    /// What [`ResponseQuantity::Output`] shows.
    pub output: OutputAxis,
    /// What these branches are called beside those of `overlaid`.
    pub name: String,
    /// Branches of other results, behind these: thin lines without marks.
    pub overlaid: Vec<OverlaidBranches>,
}

/// Branches of other results.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OverlaidBranches {
    /// What they are called in the legend.
    pub name: String,
    /// The branches.
    pub curves: Vec<ResponseCurve>,
}

impl ResponseDiagram {
    /// All solutions, those of other results too.
    pub(super) fn all_points(&self) -> impl Iterator<Item = &ResponsePoint> {
        let others = self.overlaid.iter().flat_map(|other| &other.curves);
        self.curves.iter().chain(others).flat_map(|curve| &curve.points)
    }
}

/// A number that was read off the solutions besides their maxima.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OutputAxis {
    /// What it is.
    pub title: String,
    /// Its SI unit without prefix.
    pub unit: String,
}

/// A measured point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredMark {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Largest absolute displacement (m), if it was measured.
    pub displacement_m: Option<f64>,
    /// Largest absolute acceleration (m/s²), if it was measured.
    pub acceleration_m_s2: Option<f64>,
    /// What was measured.
    pub motion: MeasuredMotion,
}

/// Kind of a measured motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredMotion {
    /// It repeats: an open square.
    Periodic,
    /// It does not repeat: a full square.
    Aperiodic,
    /// Not known or doubtful: an open circle.
    Unknown,
}

impl MeasuredMotion {
    pub(crate) const ALL: [Self; 3] = [Self::Periodic, Self::Aperiodic, Self::Unknown];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Periodic => "measured, periodic",
            Self::Aperiodic => "measured, aperiodic",
            Self::Unknown => "measured, kind unknown",
        }
    }

    pub(crate) const fn dot(self, radius: f64) -> Dot {
        let (shape, full) = match self {
            Self::Periodic => (Shape::Square, false),
            Self::Aperiodic => (Shape::Square, true),
            Self::Unknown => (Shape::Circle, false),
        };
        Dot { shape, colour: INK, full, radius }
    }
}

/// A branch of periodic solutions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseCurve {
    /// Period of the solutions over the period of the excitation, from 1.
    pub period_multiple: u32,
    /// The solutions, in order along the branch. One that is not finite leaves a gap.
    pub points: Vec<ResponsePoint>,
}

/// A periodic solution, and what happens to the branch there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResponsePoint {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Maximum of the absolute displacement over the period (m).
    pub displacement_m: f64,
    /// Maximum of the absolute acceleration over the period (m/s²).
    pub acceleration_m_s2: f64,
    /// Largest contact force over the period and over all local elements (N).
    pub contact_force_n: f64,
    /// Largest speed with which a contact is reached (m/s).
    pub impact_velocity_m_s: f64,
    /// The number of [`ResponseDiagram::output`], in its unit.
    pub output: f64,
    /// Whether no multiplier is known to lie outside the unit circle; at an event the neighbours determine
    /// the line.
    pub stable: bool,
    /// Whether stability is undecided: a multiplier is on the unit circle to its accuracy.
    pub marginal: bool,
    /// The branch turns: a multiplier of +1.
    pub fold: bool,
    /// A contact is reached with zero velocity.
    pub grazing: bool,
    /// A branch of twice the period bifurcates: a multiplier of −1.
    pub flip: bool,
    /// A quasi-periodic motion bifurcates: a complex pair on the unit circle.
    pub neimark_sacker: bool,
    /// Branches cross.
    pub branch_point: bool,
}

/// Quantity of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResponseQuantity {
    /// Maximum displacement.
    Displacement,
    /// Maximum acceleration.
    Acceleration,
    /// Largest contact force.
    ContactForce,
    /// Largest speed with which a contact is reached.
    ImpactVelocity,
    /// The number of [`ResponseDiagram::output`].
    Output,
}

/// How the diagram is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseSettings {
    /// Sizes on paper.
    pub style: Style,
    /// Scale of the axis of displacements and of outputs.
    pub displacement_scale: ScaleChoice,
    /// Scale of the axis of accelerations.
    pub acceleration_scale: ScaleChoice,
    /// Scale of the axes of contact forces and impact velocities.
    pub contact_scale: ScaleChoice,
    /// Ends of a part of the horizontal axis that is drawn again below, larger, in its unit.
    pub detail: Option<(f64, f64)>,
}

impl ResponseQuantity {
    /// The quantity in words.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Displacement => "maximum displacement",
            Self::Acceleration => "maximum acceleration",
            Self::ContactForce => "largest contact force",
            Self::ImpactVelocity => "largest impact velocity",
            Self::Output => "output",
        }
    }
}

/// Solutions of a period multiple in words.
pub(super) fn period_name(multiple: u32) -> String {
    if multiple <= 1 { "harmonic".to_owned() } else { format!("1/{multiple} subharmonic") }
}
