//! The bifurcation diagram of settled motions: displacement of the response point at phase 0 of every period,
//! and its maximum, over the excitation frequency.
//!
//! Sweeps up and down have a panel each, so that neither covers the other; the panel of the maxima has both
//! and shows the hysteresis.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    motion::MotionKind,
    scale::extent,
    style::{PALE_INK, Style, kind_colour},
};

/// Radius of a sample, of a sample of a motion with few of them, and of a maximum (pt).
const SPECK: f64 = 0.35;
const SINGLE: f64 = 0.7;
const MAXIMUM: f64 = 1.3;
/// Samples up to which they are drawn larger.
const FEW: usize = 40;

/// Settled motions over the frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SweepDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// The motions, in any order.
    pub motions: Vec<DrawnMotion>,
}

/// Initial state of a motion of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SweepOrigin {
    /// From the motion at a lower frequency.
    #[default]
    Up,
    /// From the motion at a higher frequency.
    Down,
    /// From a separate initial state.
    Start,
}

/// A settled motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnMotion {
    /// Its initial state.
    pub origin: SweepOrigin,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Kind of the motion.
    pub kind: MotionKind,
    /// Displacement of the response point at phase 0 of each period (m).
    pub samples_m: Vec<f64>,
    /// Largest absolute displacement (m).
    pub max_displacement_m: f64,
}

impl SweepOrigin {
    const ALL: [Self; 3] = [Self::Up, Self::Down, Self::Start];

    fn heading(self) -> &'static str {
        match self {
            Self::Up => "frequency rising",
            Self::Down => "frequency falling",
            Self::Start => "from several initial states",
        }
    }

    fn dot(self, colour: &'static str) -> Dot {
        let (shape, full) = match self {
            Self::Up => (Shape::TriangleUp, true),
            Self::Down => (Shape::TriangleDown, false),
            Self::Start => (Shape::Circle, true),
        };
        Dot { shape, colour, full, radius: if self == Self::Start { 0.8 * MAXIMUM } else { MAXIMUM } }
    }
}

impl SweepDiagram {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no motion has a finite sample.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let origins: Vec<SweepOrigin> = SweepOrigin::ALL
            .into_iter()
            .filter(|origin| self.motions.iter().any(|m| m.origin == *origin))
            .collect();
        if origins.is_empty() {
            return Err(FigureError::Empty { quantity: "displacement", curves: 0, points: 0 });
        }
        let all = self.motions.iter().flat_map(|motion| &motion.samples_m).map(|sample| 1e3 * sample);
        let ends = extent(all.filter(|sample| sample.is_finite()));
        let ends = ends.filter(|(least, greatest)| least < greatest);
        let ends = ends.map(|(least, greatest)| {
            let margin = 0.05 * (greatest - least);
            (least - margin, greatest + margin)
        });
        let sampled = |origin: &SweepOrigin| ChartPanel {
            quantity: "displacement at phase 0",
            y: Measure { ends, ..Measure::new("Displ. at phase 0 (mm)") },
            layers: self.samples(*origin),
            heading: origin.heading().to_owned(),
        };
        let mut panels: Vec<ChartPanel> = origins.iter().map(sampled).collect();
        panels.push(ChartPanel {
            quantity: "maximum displacement",
            y: Measure::new("Max. displ. (mm)"),
            layers: origins.iter().flat_map(|origin| self.maxima(*origin)).collect(),
            heading: String::new(),
        });
        let frequencies = self.motions.iter().map(|motion| motion.frequency_hz);
        let x = Measure::frequency("Excitation frequency", style, frequencies);
        let (title, description) = (self.title.clone(), self.description());
        Chart { title, x, panels, legend: self.legend(&origins), description, aspect: None }.draw(style)
    }

    fn of(&self, origin: SweepOrigin, kind: MotionKind) -> impl Iterator<Item = &DrawnMotion> {
        self.motions.iter().filter(move |motion| motion.origin == origin && motion.kind.is_like(kind))
    }

    fn samples(&self, origin: SweepOrigin) -> Vec<Layer> {
        let layer = |kind: MotionKind, few: bool| Layer::Dots {
            points: self
                .of(origin, kind)
                .filter(|motion| (motion.samples_m.len() <= FEW) == few)
                .flat_map(|motion| motion.samples_m.iter().map(|sample| (motion.frequency_hz, 1e3 * sample)))
                .collect(),
            dot: speck(kind, few),
        };
        MotionKind::ALL.into_iter().flat_map(|kind| [layer(kind, false), layer(kind, true)]).collect()
    }

    fn maxima(&self, origin: SweepOrigin) -> Vec<Layer> {
        let points =
            |kind| self.of(origin, kind).map(|motion| (motion.frequency_hz, 1e3 * motion.max_displacement_m));
        let kinds = MotionKind::ALL.into_iter();
        kinds
            .map(|kind| Layer::Dots { points: points(kind).collect(), dot: origin.dot(kind_colour(kind)) })
            .collect()
    }

    fn legend(&self, origins: &[SweepOrigin]) -> Vec<Vec<LegendEntry>> {
        let has = |kind: &MotionKind| self.motions.iter().any(|motion| motion.kind.is_like(*kind));
        let kind = |kind: MotionKind| LegendEntry {
            sample: LegendSample::Cell(kind_colour(kind)),
            name: kind.name().to_owned(),
        };
        let origin = |origin: &SweepOrigin| LegendEntry {
            sample: LegendSample::Dot(origin.dot(PALE_INK)),
            name: format!("maximum, {}", origin.heading()),
        };
        let kinds = MotionKind::ALL.into_iter().filter(has).map(kind);
        let several = origins.len() > 1;
        vec![kinds.collect(), origins.iter().filter(|_| several).map(origin).collect()]
    }

    fn description(&self) -> String {
        let count =
            |kind: &MotionKind| self.motions.iter().filter(|motion| motion.kind.is_like(*kind)).count();
        let counts = MotionKind::ALL.into_iter().filter(|kind| count(kind) > 0);
        let counts: Vec<String> = counts.map(|kind| format!("{} {}", count(&kind), kind.name())).collect();
        format!("settled motions over the excitation frequency: {}", counts.join(", "))
    }
}

fn speck(kind: MotionKind, few: bool) -> Dot {
    let (shape, radius) = if few { (Shape::Circle, SINGLE) } else { (Shape::Speck, SPECK) };
    Dot { shape, colour: kind_colour(kind), full: true, radius }
}
