//! The response diagram: maximum displacement and acceleration of the response point, contact force and
//! impact velocity over the excitation frequency, or over another parameter.
//!
//! Figures 3 and 4 of van de Vorst, Fey, de Kraker, van Campen are of this kind.

mod drawing;
mod joined;
mod panel;

use crate::{
    Figure, FigureError, ScaleChoice, Style,
    dots::{Dot, Shape},
    style::INK,
};

/// Branches of periodic solutions over the excitation frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseDiagram {
    /// Title above the figure; empty for none, as most journals want it.
    pub title: String,
    /// What the horizontal axis measures, with the unit, for branches over another parameter: all that is
    /// said of the frequency is then said of that parameter. Empty for the frequency.
    pub parameter: String,
    /// The branches, in the order in which they are drawn.
    pub curves: Vec<ResponseCurve>,
    /// Ends of the frequency axis (Hz); by default those of the data.
    pub frequency_range_hz: Option<(f64, f64)>,
    /// Ranges of the frequency in which a chaotic motion was found (Hz), shaded behind everything.
    pub chaotic_ranges_hz: Vec<(f64, f64)>,
    /// Measured points, on top of everything.
    pub measured: Vec<MeasuredMark>,
}

/// A measured point, laid over the branches as it is.
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
    /// It does not: a full square.
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
    /// Whether the solution is stable, as far as is known; at an event the neighbours decide how the line is
    /// drawn.
    pub stable: bool,
    /// Whether that is not known, since a multiplier is on the unit circle as well as it is known.
    pub marginal: bool,
    /// The branch turns: a multiplier of +1.
    pub fold: bool,
    /// A contact begins or ends: it is reached with zero velocity.
    pub grazing: bool,
    /// A branch of twice the period begins: a multiplier of −1.
    pub flip: bool,
    /// A quasi-periodic motion begins: a complex pair on the unit circle.
    pub neimark_sacker: bool,
    /// Branches cross.
    pub branch_point: bool,
}

/// What a panel of the diagram shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Maximum displacement, in millimetres on the axis.
    Displacement,
    /// Maximum acceleration (m/s²).
    Acceleration,
    /// Largest contact force (N).
    ContactForce,
    /// Largest speed with which a contact is reached (m/s).
    ImpactVelocity,
}

/// How the diagram is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseSettings {
    /// Sizes on paper.
    pub style: Style,
    /// Scale of the axis of displacements.
    pub displacement_scale: ScaleChoice,
    /// Scale of the axis of accelerations.
    pub acceleration_scale: ScaleChoice,
    /// Scale of the axis of contact forces and of that of impact velocities.
    pub contact_scale: ScaleChoice,
}

impl ResponseDiagram {
    /// The figure of one quantity, in the default style.
    ///
    /// # Errors
    /// As [`Self::draw_with`].
    pub fn draw(&self, quantity: Quantity) -> Result<Figure, FigureError> {
        self.draw_with(&[quantity], &ResponseSettings::default())
    }

    /// The figure of the displacement over that of the acceleration, with one frequency axis, in the default
    /// style.
    ///
    /// # Errors
    /// As [`Self::draw_with`].
    pub fn draw_both(&self) -> Result<Figure, FigureError> {
        self.draw_with(&[Quantity::Displacement, Quantity::Acceleration], &ResponseSettings::default())
    }

    /// One panel for each of `quantities`, from top to bottom, with one frequency axis.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no solution has a place in a panel; [`FigureError::NoQuantity`] where
    /// there is no panel; [`FigureError::FrequencyRange`] where the ends of the frequency axis are not in
    /// order.
    pub fn draw_with(
        &self,
        quantities: &[Quantity],
        settings: &ResponseSettings,
    ) -> Result<Figure, FigureError> {
        drawing::draw(self, quantities, settings)
    }
}

impl Quantity {
    /// The quantity in words.
    fn name(self) -> &'static str {
        match self {
            Self::Displacement => "maximum displacement",
            Self::Acceleration => "maximum acceleration",
            Self::ContactForce => "largest contact force",
            Self::ImpactVelocity => "largest impact velocity",
        }
    }

    /// The value of a measured point in the unit of the axis; NaN if it was not measured.
    fn measured(self, mark: &MeasuredMark) -> f64 {
        match self {
            Self::Displacement => mark.displacement_m.map_or(f64::NAN, |value| 1e3 * value),
            Self::Acceleration => mark.acceleration_m_s2.unwrap_or(f64::NAN),
            Self::ContactForce | Self::ImpactVelocity => f64::NAN,
        }
    }

    /// The value in the unit of the axis.
    fn value(self, point: &ResponsePoint) -> f64 {
        match self {
            Self::Displacement => 1e3 * point.displacement_m,
            Self::Acceleration => point.acceleration_m_s2,
            Self::ContactForce => point.contact_force_n,
            Self::ImpactVelocity => point.impact_velocity_m_s,
        }
    }
}
