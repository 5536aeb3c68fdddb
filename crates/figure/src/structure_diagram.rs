//! The structure as a sketch: what holds it, what it carries, what it can hit, and what moves it.
//!
//! Along a beam the sketch is to scale; its depth, the gaps and all symbols are not. A displacement is
//! positive upwards, that of lumped masses to the right. What a sketch cannot say stands below it in words,
//! which come from the caller.

mod beam;
mod lumped;
mod stop;

use crate::{
    Figure, FigureError, Style,
    font::CAPITAL_HEIGHT,
    plot::lettering,
    svg::{Anchor, Point, SvgWriter, points},
    text::wrap,
};

/// Most masses that a sketch has room for.
const MOST_MASSES: usize = 20;
/// Space around everything, and between the sketch and its words (pt).
const MARGIN: f64 = 3.0;
const GAP: f64 = 9.0;

/// A structure with its stops.
#[derive(Debug, Clone, PartialEq)]
pub struct StructureDiagram {
    /// Title above the sketch; empty for none.
    pub title: String,
    /// What is drawn.
    pub layout: SketchLayout,
    /// The stops.
    pub stops: Vec<SketchStop>,
    /// Names of the points, ends or masses that follow a moving support; `ground` for the ground of lumped
    /// masses.
    pub moving: Vec<SketchMotion>,
    /// Names of the points at which a force acts.
    pub forces: Vec<String>,
    /// What stands below the sketch, a line or more each.
    pub words: Vec<String>,
}

/// A place that follows a moving support.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SketchMotion {
    /// Name of the place.
    pub place: String,
    /// Number of the support, from 0.
    pub support: usize,
}

/// Kind of a structure.
#[derive(Debug, Clone, PartialEq)]
pub enum SketchLayout {
    /// A beam.
    Beam(SketchBeam),
    /// Masses on a line.
    Lumped(SketchLumped),
}

/// A beam.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchBeam {
    /// Length (m).
    pub length_m: f64,
    /// How the left end is held; its name is `left`.
    pub left: SketchEnd,
    /// How the right end is held; its name is `right`.
    pub right: SketchEnd,
    /// Named points.
    pub points: Vec<SketchPoint>,
}

/// How an end of a beam is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SketchEnd {
    /// Neither moves nor turns.
    Clamped,
    /// Turns.
    Pinned,
    /// Moves across.
    Sliding,
    /// Not held.
    Free,
}

/// A point of a beam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SketchPoint {
    /// Name.
    pub name: String,
    /// Distance from the left end (m).
    pub at_m: f64,
    /// Whether it carries a mass.
    pub has_mass: bool,
    /// Whether a spring joins it to the ground.
    pub has_spring: bool,
    /// Whether a damper joins it to the ground.
    pub has_damper: bool,
    /// Whether a rotational spring or damper joins it to the ground.
    pub has_rotational: bool,
}

/// Masses on a line, from left to right.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SketchLumped {
    /// Names of the masses.
    pub masses: Vec<String>,
    /// Springs and dampers.
    pub links: Vec<SketchLink>,
}

/// A spring or a damper between masses, or between a mass and the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SketchLink {
    /// Numbers of the masses, from 0; `None` is the ground.
    pub between: [Option<usize>; 2],
    /// A damper, not a spring.
    pub is_damper: bool,
}

/// A stop or a local spring.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchStop {
    /// The point or mass that meets it.
    pub point: String,
    /// What carries it.
    pub carrier: SketchCarrier,
    /// How it looks.
    pub kind: StopKind,
    /// Whether it is on the side of positive displacements; of a two-sided one and of a spring that always
    /// acts it says nothing.
    pub above: bool,
    /// Whether there is a gap at rest.
    pub has_gap: bool,
}

/// What carries a stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SketchCarrier {
    /// A moving support, of this number from 0.
    Support(usize),
    /// Something that stands still.
    Space,
    /// Another point or mass.
    Point(String),
}

/// How a stop looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopKind {
    /// A sphere, full where it loses energy: contacts after Hertz.
    Sphere {
        /// Whether a contact loses energy.
        loses: bool,
    },
    /// A spring that begins to act at a gap.
    Spring,
    /// A rigid block.
    Rigid,
    /// A spring on each side.
    TwoSided,
    /// A spring that always acts.
    Always,
}

impl StructureDiagram {
    /// The figure.
    ///
    /// # Errors
    /// [`FigureError::Crowded`] for more masses than a sketch has room for, [`FigureError::Empty`] for no
    /// mass or a beam without a length.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let width = points(style.width_mm);
        let title = wrap(&self.title, style.label_size, width - 2.0 * MARGIN);
        let top = MARGIN + 1.5 * style.label_size * title.len() as f64;
        let description = self.description();
        let sketch = match &self.layout {
            SketchLayout::Beam(beam) => beam::sketch(self, beam, top, style)?,
            SketchLayout::Lumped(lumped) => lumped::sketch(self, lumped, top, style)?,
        };
        let words: Vec<_> = self
            .words
            .iter()
            .flat_map(|line| wrap(line, style.tick_size, width - 2.0 * MARGIN - style.tick_size))
            .collect();
        let line = 1.4 * style.tick_size;
        let height = sketch.bottom + GAP + line * words.len() as f64 + MARGIN;
        let mut svg = SvgWriter::new(style.width_mm, height * 25.4 / 72.0, &self.title, &description);
        for (i, text) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(Point { x: MARGIN, y }, text, lettering(style.label_size, Anchor::Start));
        }
        (sketch.draw)(&mut svg);
        for (i, text) in words.iter().enumerate() {
            let y = sketch.bottom + GAP + (i as f64 + 0.7) * line;
            svg.text(Point { x: MARGIN, y }, text, lettering(style.tick_size, Anchor::Start));
        }
        Ok(Figure::new(svg.finish(), description, style.width_mm, height * 25.4 / 72.0))
    }

    fn description(&self) -> String {
        let counted = |count: usize, one: &str, several: &str| {
            format!("{count} {}", if count == 1 { one } else { several })
        };
        let what = match &self.layout {
            SketchLayout::Beam(beam) => {
                format!("a beam with {}", counted(beam.points.len(), "point", "points"))
            }
            SketchLayout::Lumped(lumped) => counted(lumped.masses.len(), "mass", "masses"),
        };
        let stops = counted(self.stops.len(), "stop", "stops");
        format!("sketch of {what} and {stops}; {}", self.words.join("; "))
    }

    /// The support that a place follows.
    fn support_of(&self, name: &str) -> Option<usize> {
        self.moving.iter().find(|moving| moving.place == name).map(|moving| moving.support)
    }

    fn moves(&self, name: &str) -> bool {
        self.support_of(name).is_some()
    }

    /// Whether supports move in different ways.
    fn supports_differ(&self) -> bool {
        self.moving.iter().any(|moving| moving.support > 0)
    }

    /// The variable of the motion of a support: `u`, or `u1`, `u2` and so on where they differ.
    fn motion_of(&self, support: usize) -> String {
        if self.supports_differ() { format!("u{}", support + 1) } else { "u".to_owned() }
    }
}

/// A sketch that is laid out: how far down it reaches, and what draws it.
struct Sketch<'a> {
    bottom: f64,
    draw: Box<dyn Fn(&mut SvgWriter) + 'a>,
}
