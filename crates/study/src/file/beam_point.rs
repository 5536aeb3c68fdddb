//! `[[structure.point]]` of a beam: what is attached to it and how it is held; ends, which are held alike.

use hammerbeam_structure as linear;
use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, Reading, TomlTable, Value, key::Words, quantity};

use super::{
    beam_end::{END_KINDS, EndSupport},
    names::{Names, read_name},
};

/// A named point of a beam and what is attached to it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BeamPointTable {
    /// Name.
    pub name: String,
    /// Distance from the left end [m].
    pub at_m: f64,
    /// Attached mass [kg].
    pub mass_kg: f64,
    /// Its rotary inertia [kg m^2].
    pub rotary_inertia_kg_m2: f64,
    /// Spring to the ground [N/m].
    pub spring_n_m: f64,
    /// Damper to the ground [N s/m].
    pub damper_n_s_m: f64,
    /// Rotational spring to the ground [N m/rad].
    pub rotational_spring_n_m_rad: f64,
    /// Rotational damper to the ground [N m s/rad].
    pub rotational_damper_n_m_s_rad: f64,
    /// How the point is held.
    #[serde(skip_serializing_if = "is_free")]
    pub support: EndSupport,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
fn is_free(support: &EndSupport) -> bool {
    *support == EndSupport::Free
}

impl BeamPointTable {
    /// The point in the terms of the structure crate.
    pub(super) fn descriptor(&self) -> linear::BeamPoint {
        linear::BeamPoint {
            name: self.name.clone(),
            at: self.at_m,
            mass: self.mass_kg,
            rotary_inertia: self.rotary_inertia_kg_m2,
            spring: self.spring_n_m,
            damper: self.damper_n_s_m,
            rotational_spring: self.rotational_spring_n_m_rad,
            rotational_damper: self.rotational_damper_n_m_s_rad,
            support: self.support.descriptor(),
        }
    }
}

const SUPPORT: Key<Words<EndSupport>> = Key::new(
    "support",
    Words(END_KINDS),
    "a support between the ends; one that the excitation may move, if it holds the displacement",
)
.or(EndSupport::Free);
const MASS: Key<Quantity> = added("mass_kg", quantity::ADDED_MASS, "attached mass");
const ROTARY_INERTIA: Key<Quantity> =
    added("rotary_inertia_kg_m2", quantity::ROTARY_INERTIA, "its rotary inertia");
const SPRING: Key<Quantity> = added("spring_n_m", quantity::ADDED_STIFFNESS, "spring to the ground");
const DAMPER: Key<Quantity> = added("damper_n_s_m", quantity::DAMPER, "damper to the ground");
const ROTATIONAL_SPRING: Key<Quantity> =
    added("rotational_spring_n_m_rad", quantity::ROTATIONAL_STIFFNESS, "rotational spring to the ground");
const ROTATIONAL_DAMPER: Key<Quantity> =
    added("rotational_damper_n_m_s_rad", quantity::ROTATIONAL_DAMPER, "rotational damper to the ground");

/// Something that is attached to a point, or not.
const fn added(name: &'static str, quantity: Quantity, meaning: &'static str) -> Key<Quantity> {
    Key::new(name, quantity, meaning).or(0.0)
}

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let at = KeyRow::read_apart(
        "at_m",
        "0 to `length_m`",
        "required",
        "distance from the left end; equal to that of another point or border of spans, or at least 1e-4 of \
         the length away",
    );
    let attached = [MASS, ROTARY_INERTIA, SPRING, DAMPER, ROTATIONAL_SPRING, ROTATIONAL_DAMPER];
    let mut rows = vec![KeyRow::read_apart("name", "text", "required", "name, each once"), at];
    rows.push(SUPPORT.row());
    rows.extend(attached.iter().map(Key::row));
    rows
}

pub(super) fn read(
    table: &TomlTable<'_>,
    reading: &Reading,
    length_m: Option<f64>,
    names: &mut Names,
) -> Option<Vec<BeamPointTable>> {
    let before = reading.count();
    let points = table.tables("point");
    let read: Vec<BeamPointTable> =
        points.into_iter().filter_map(|point| read_point(point, length_m, names)).collect();
    (reading.count() == before).then_some(read)
}

fn read_point(table: TomlTable<'_>, length_m: Option<f64>, names: &mut Names) -> Option<BeamPointTable> {
    let name = read_name(&table, names);
    let at = table.required("at_m").and_then(|value| read_position(&value, length_m));
    let (mass, inertia) = (MASS.read(&table), ROTARY_INERTIA.read(&table));
    let (spring, damper) = (SPRING.read(&table), DAMPER.read(&table));
    let rotational_spring = ROTATIONAL_SPRING.read(&table);
    let rotational_damper = ROTATIONAL_DAMPER.read(&table);
    let support = SUPPORT.read(&table);
    table.finish();
    Some(BeamPointTable {
        name: name?,
        at_m: at?,
        mass_kg: mass?,
        rotary_inertia_kg_m2: inertia?,
        spring_n_m: spring?,
        damper_n_s_m: damper?,
        rotational_spring_n_m_rad: rotational_spring?,
        rotational_damper_n_m_s_rad: rotational_damper?,
        support: support?,
    })
}

fn read_position(value: &Value<'_>, length_m: Option<f64>) -> Option<f64> {
    let at = value.number(&quantity::POSITION)?;
    match length_m {
        Some(length) if at > length => {
            let help = format!("allowed: 0 to {length} m, the length of the beam");
            value.problem(format!("`at_m` is {at} m, which is off the beam"), vec![help]);
            None
        }
        _ => Some(at),
    }
}
