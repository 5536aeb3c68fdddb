//! `[structure]` of kind "beam": a beam of one span or several, with points.

use hammerbeam_structure::{self as linear, StructureError};
use serde::{Serialize, Serializer};

use crate::document::{
    Key, KeyRow, Reading, TomlTable,
    key::{Whole, Words},
};

use super::{
    beam_end::{END_KINDS, EndSupport},
    beam_point::{self, BeamPointTable},
    beam_span::{self, BeamSpanEntry},
    names::Names,
};

/// A beam in bending.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BeamTable {
    /// Length of all spans [m].
    pub length_m: f64,
    /// Planes in which it bends.
    #[serde(skip_serializing_if = "BeamPlanes::is_one")]
    pub planes: BeamPlanes,
    /// Number of finite elements, before nodes are added at the points.
    pub elements: u32,
    /// The spans from left to right, at least one.
    #[serde(flatten, serialize_with = "as_written")]
    pub spans: Vec<BeamSpanEntry>,
    /// Support at x = 0.
    pub left: EndSupport,
    /// Support at x = length.
    pub right: EndSupport,
    /// Named points.
    pub points: Vec<BeamPointTable>,
}

/// In how many planes a beam bends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum BeamPlanes {
    /// In one: points have one displacement.
    #[serde(rename = "1")]
    One,
    /// In two that do not couple: a point `tip` is the points `tip.y` and `tip.z`.
    #[serde(rename = "2")]
    Two,
}

impl BeamPlanes {
    /// Whether it is one.
    #[must_use]
    pub fn is_one(&self) -> bool {
        *self == Self::One
    }
}

/// A single span as keys of the structure, several as a list.
fn as_written<S: Serializer>(spans: &[BeamSpanEntry], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Several<'a> {
        span: &'a [BeamSpanEntry],
    }
    match spans {
        [only] => only.profile.serialize(serializer),
        span => Several { span }.serialize(serializer),
    }
}

impl BeamTable {
    /// The only span, where there is one, and it bends in one plane, after Euler and Bernoulli and without
    /// added mass.
    #[must_use]
    pub fn uniform(&self) -> Option<&BeamSpanEntry> {
        let [only] = self.spans.as_slice() else { return None };
        (self.planes.is_one() && only.profile.added_mass_kg_m == 0.0 && only.profile.poisson_ratio.is_none())
            .then_some(only)
    }

    /// Places at which spans meet, in their order [m].
    #[must_use]
    pub fn borders_m(&self) -> Vec<f64> {
        let mut at = 0.0;
        let ends = self.spans.iter().map(|span| {
            at += span.length_m;
            at
        });
        ends.take(self.spans.len().saturating_sub(1)).collect()
    }

    /// Distance of a point, or an end, from the left end [m], by its name in the study.
    #[must_use]
    pub fn place_of(&self, name: &str) -> Option<f64> {
        let name = match self.planes {
            BeamPlanes::One => name,
            BeamPlanes::Two => linear::Plane::split(name)?.0,
        };
        match name {
            "left" => Some(0.0),
            "right" => Some(self.length_m),
            _ => self.points.iter().find(|point| point.name == name).map(|point| point.at_m),
        }
    }

    /// The beam in the terms of the structure crate, in one plane.
    ///
    /// # Errors
    /// [`StructureError`]: a section without area or stiffness.
    pub fn descriptor(&self) -> Result<linear::SteppedBeam, StructureError> {
        Ok(linear::SteppedBeam {
            elements: self.elements as usize,
            spans: self.spans.iter().map(BeamSpanEntry::descriptor).collect::<Result<_, _>>()?,
            left: self.left.descriptor(),
            right: self.right.descriptor(),
            points: self.points.iter().map(BeamPointTable::descriptor).collect(),
        })
    }

    /// A uniform beam in the terms of the structure crate; `None` of others.
    ///
    /// # Errors
    /// As [`Self::descriptor`].
    pub fn uniform_descriptor(&self) -> Result<Option<linear::Beam>, StructureError> {
        if self.uniform().is_none() {
            return Ok(None);
        }
        let linear::SteppedBeam { elements, spans, left, right, points } = self.descriptor()?;
        Ok(spans.first().map(|span| linear::Beam {
            length: span.length,
            elements,
            section: span.section,
            youngs_modulus: span.youngs_modulus,
            density: span.density,
            left,
            right,
            points,
        }))
    }
}

const ELEMENTS: Key<Whole> = Key::new(
    "elements",
    Whole(1, 1000),
    "number of finite elements; at least one between neighbouring points, ends and borders of spans",
);
const PLANES: Key<Whole> = Key::new(
    "planes",
    Whole(1, 2),
    "planes in which it bends; in two a point `tip` is the points `tip.y` and `tip.z`, the ends are `left.y` and \
     so on",
)
.or(1);
const LEFT: Key<Words<EndSupport>> = Key::new(
    "left",
    Words(END_KINDS),
    "support of the left end: clamped holds displacement and rotation, pinned the displacement, sliding the \
     rotation",
);
const RIGHT: Key<Words<EndSupport>> = Key::new("right", Words(END_KINDS), "support of the right end");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let list = |name, meaning| KeyRow::read_apart(name, "list of tables, below", "none", meaning);
    let mut rows = vec![KeyRow::read_apart("kind", "`\"beam\"`", "required", "what the structure is")];
    rows.push(beam_span::row_of_length("required, but not a key of a beam with `span`"));
    rows.extend([PLANES.row(), ELEMENTS.row()]);
    rows.extend(beam_span::rows_of_profile());
    rows.extend([beam_span::row_of_theory(), LEFT.row(), RIGHT.row()]);
    rows.push(list("span", "spans of different section or material"));
    rows.push(list("point", "named points"));
    rows
}

pub(super) fn read(table: &TomlTable<'_>, reading: &Reading, names: &mut Names) -> Option<BeamTable> {
    let (length_m, spans) = beam_span::read(table, reading);
    let elements = ELEMENTS.read(table);
    let (left, right) = (LEFT.read(table), RIGHT.read(table));
    let planes = read_planes(table);
    names.add_beam_ends(left, right);
    let points = beam_point::read(table, reading, length_m, names);
    if planes == Some(BeamPlanes::Two) {
        names.in_two_planes();
    }
    let beam = BeamTable {
        length_m: length_m?,
        planes: planes?,
        elements: elements?,
        spans: spans?,
        left: left?,
        right: right?,
        points: points?,
    };
    // A beam that is refused is given all the same: the rest of the study is judged by it.
    if let Err(error) = beam.descriptor().and_then(|descriptor| descriptor.check()) {
        table.problem(key_to_blame(&error), error.to_string(), Vec::new());
    }
    if !beam.planes.is_one() && beam.spans.iter().any(|span| span.profile.section.is_oblong) {
        let help = "allowed: rods, tubes, squares, or { area_m2, second_moment_m4 } of a section that bends \
                    in every direction alike";
        let message = "the beam bends in two planes, and its rectangle not in both alike".to_owned();
        table.problem("planes", message, vec![help.to_owned()]);
    }
    Some(beam)
}

fn read_planes(table: &TomlTable<'_>) -> Option<BeamPlanes> {
    PLANES.read(table).map(|planes| if planes == 1 { BeamPlanes::One } else { BeamPlanes::Two })
}

fn key_to_blame(error: &StructureError) -> &'static str {
    match error {
        StructureError::TooFewElements { .. } | StructureError::TooManyElements { .. } => "elements",
        StructureError::PointsTooClose { .. } => "point",
        _ => "kind",
    }
}
