//! The data of a sketch.

/// A structure with its stops.
#[derive(Debug, Clone, PartialEq)]
pub struct StructureDiagram {
    /// Title above the sketch; may be empty.
    pub title: String,
    /// The structure.
    pub layout: SketchLayout,
    /// The stops.
    pub stops: Vec<SketchStop>,
    /// Names of the points, ends or masses that follow a moving support; `ground` for the ground of lumped
    /// masses.
    pub moving: Vec<SketchMotion>,
    /// Names of the points at which a force acts.
    pub forces: Vec<String>,
    /// Text below the sketch, one or more lines each.
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
    /// Support of the left end, which is named `left`.
    pub left: SketchEnd,
    /// Support of the right end, which is named `right`.
    pub right: SketchEnd,
    /// Named points.
    pub points: Vec<SketchPoint>,
}

/// Support of an end or a point of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SketchEnd {
    /// No displacement, no rotation.
    Clamped,
    /// Rotation only.
    Pinned,
    /// Transverse displacement only.
    Sliding,
    /// No support.
    #[default]
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
    /// How it is held between the ends.
    pub support: SketchEnd,
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
    /// The point or mass that hits it.
    pub point: String,
    /// Its carrier.
    pub carrier: SketchCarrier,
    /// Its symbol.
    pub kind: StopKind,
    /// Whether it is on the side of positive displacements; irrelevant for a two-sided stop and a permanent
    /// spring.
    pub above: bool,
    /// Whether there is a gap at rest.
    pub has_gap: bool,
}

/// Carrier of a stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SketchCarrier {
    /// A moving support, of this number from 0.
    Support(usize),
    /// The fixed frame.
    Space,
    /// Another point or mass.
    Point(String),
}

/// Symbol of a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopKind {
    /// A sphere, full for contacts with energy loss: Hertz contacts.
    Sphere {
        /// Whether a contact loses energy.
        loses: bool,
    },
    /// A spring behind a gap.
    Spring,
    /// A rigid block.
    Rigid,
    /// A spring on each side.
    TwoSided,
    /// A permanent spring.
    Always,
}

impl StructureDiagram {
    /// The support that a place follows.
    pub(super) fn support_of(&self, name: &str) -> Option<usize> {
        self.moving.iter().find(|moving| moving.place == name).map(|moving| moving.support)
    }

    pub(super) fn moves(&self, name: &str) -> bool {
        self.support_of(name).is_some()
    }

    /// Whether supports move in different ways.
    pub(super) fn supports_differ(&self) -> bool {
        self.moving.iter().any(|moving| moving.support > 0)
    }

    /// The variable of the motion of a support: `u`, or `u1`, `u2` and so on where they differ.
    pub(super) fn motion_of(&self, support: usize) -> String {
        if self.supports_differ() { format!("u{}", support + 1) } else { "u".to_owned() }
    }
}
