//! `[structure]` of kind "beam": a uniform Euler-Bernoulli beam with points.

use hammerbeam_structure::{self as linear, StructureError};
use serde::Serialize;

use crate::document::{Reading, Table, Value, quantity};

use super::names::{Names, read_name};

/// A uniform Euler-Bernoulli beam in bending.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Beam {
    /// Length [m].
    pub length_m: f64,
    /// Number of finite elements, before nodes are added at the points.
    pub elements: u32,
    /// Cross-section.
    pub section: Section,
    /// Young's modulus [Pa].
    pub youngs_modulus_pa: f64,
    /// Density [kg/m^3].
    pub density_kg_m3: f64,
    /// Support at x = 0.
    pub left: End,
    /// Support at x = length.
    pub right: End,
    /// Named points.
    pub points: Vec<BeamPoint>,
}

/// Cross-section of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Section {
    /// Area [m^2].
    pub area_m2: f64,
    /// Second moment of area about the axis of bending [m^4].
    pub second_moment_m4: f64,
}

/// Support of an end of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// Neither displacement nor rotation.
    Clamped,
    /// No displacement.
    Pinned,
    /// No rotation.
    Sliding,
    /// No support.
    Free,
}

impl End {
    /// Whether the support holds the displacement, so that its motion can be prescribed.
    #[must_use]
    pub fn holds_displacement(self) -> bool {
        matches!(self, Self::Clamped | Self::Pinned)
    }

    fn descriptor(self) -> linear::End {
        match self {
            Self::Clamped => linear::End::Clamped,
            Self::Pinned => linear::End::Pinned,
            Self::Sliding => linear::End::Sliding,
            Self::Free => linear::End::Free,
        }
    }
}

/// A named point of a beam and what is attached to it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BeamPoint {
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
}

impl Beam {
    /// The beam in the terms of the structure crate.
    ///
    /// # Errors
    /// [`StructureError`]: a section without area or stiffness.
    pub fn descriptor(&self) -> Result<linear::Beam, StructureError> {
        let points = self.points.iter().map(|point| linear::BeamPoint {
            name: point.name.clone(),
            at: point.at_m,
            mass: point.mass_kg,
            rotary_inertia: point.rotary_inertia_kg_m2,
            spring: point.spring_n_m,
            damper: point.damper_n_s_m,
            rotational_spring: point.rotational_spring_n_m_rad,
            rotational_damper: point.rotational_damper_n_m_s_rad,
        });
        Ok(linear::Beam {
            length: self.length_m,
            elements: self.elements as usize,
            section: linear::Section::general(self.section.area_m2, self.section.second_moment_m4)?,
            youngs_modulus: self.youngs_modulus_pa,
            density: self.density_kg_m3,
            left: self.left.descriptor(),
            right: self.right.descriptor(),
            points: points.collect(),
        })
    }
}

const ENDS: [(&str, End); 4] =
    [("clamped", End::Clamped), ("pinned", End::Pinned), ("sliding", End::Sliding), ("free", End::Free)];

pub(super) fn read(table: &Table<'_>, reading: &Reading, names: &mut Names) -> Option<Beam> {
    let length_m = table.required("length_m").and_then(|value| value.number(&quantity::LENGTH));
    let elements = table.required("elements").and_then(|value| value.whole(1, 1000));
    let section =
        table.required_with_help("section", forms()).and_then(|value| read_section(&value, length_m));
    let youngs_modulus_pa =
        table.required("youngs_modulus_pa").and_then(|value| value.number(&quantity::MODULUS));
    let density_kg_m3 = table.required("density_kg_m3").and_then(|value| value.number(&quantity::DENSITY));
    let left = table.required("left").and_then(|value| value.choice(&ENDS));
    let right = table.required("right").and_then(|value| value.choice(&ENDS));
    names.add_beam_ends(left, right);
    let points = read_points(table, reading, length_m, names);
    let beam = Beam {
        length_m: length_m?,
        elements: elements?,
        section: section?,
        youngs_modulus_pa: youngs_modulus_pa?,
        density_kg_m3: density_kg_m3?,
        left: left?,
        right: right?,
        points: points?,
    };
    // A beam that is refused is given all the same: the rest of the study is judged by it.
    if let Err(error) = beam.descriptor().and_then(|descriptor| descriptor.check()) {
        table.problem(key_to_blame(&error), error.to_string(), Vec::new());
    }
    Some(beam)
}

fn key_to_blame(error: &StructureError) -> &'static str {
    match error {
        StructureError::TooFewElements { .. } | StructureError::TooManyElements { .. } => "elements",
        StructureError::PointsTooClose { .. } => "point",
        _ => "kind",
    }
}

/// Keys of both forms of a section.
const RECTANGLE: [&str; 2] = ["width_m", "height_m"];
const GENERAL: [&str; 2] = ["area_m2", "second_moment_m4"];

/// The accepted forms of a section, in words.
fn forms() -> Vec<String> {
    let form = |keys: [&str; 2]| format!("{{ {} }}", keys.join(", "));
    vec![
        format!("allowed: {} of a rectangle, or {}", form(RECTANGLE), form(GENERAL)),
        "with units: { width = \"30 mm\", height = \"2 mm\" }, or { area = \"60 mm^2\", second_moment = \
         \"20 mm^4\" }"
            .to_owned(),
    ]
}

/// `{ width_m, height_m }` of a rectangle, or `{ area_m2, second_moment_m4 }`.
fn read_section(value: &Value<'_>, length_m: Option<f64>) -> Option<Section> {
    let table = value.table_with_help(forms())?;
    let has = |keys: [&'static str; 2]| keys.iter().any(|key| table.has(key));
    let section = match (has(RECTANGLE), has(GENERAL)) {
        (true, false) => read_rectangle(&table, length_m),
        (false, true) => read_general_section(&table),
        (mixed, _) => {
            for key in RECTANGLE.into_iter().chain(GENERAL) {
                table.optional(key);
            }
            let found =
                if mixed { "is a mix of the accepted forms" } else { "has none of the accepted forms" };
            value.problem(format!("`section` {found}"), forms());
            None
        }
    };
    table.finish();
    section
}

fn read_general_section(table: &Table<'_>) -> Option<Section> {
    let area = table.required_with_help("area_m2", forms()).and_then(|value| value.number(&quantity::AREA));
    let moment = table
        .required_with_help("second_moment_m4", forms())
        .and_then(|value| value.number(&quantity::SECOND_MOMENT));
    Some(Section { area_m2: area?, second_moment_m4: moment? })
}

fn read_rectangle(table: &Table<'_>, length_m: Option<f64>) -> Option<Section> {
    let width = table.required_with_help("width_m", forms()).and_then(|value| value.number(&quantity::WIDTH));
    let height =
        table.required_with_help("height_m", forms()).and_then(|value| value.number(&quantity::HEIGHT));
    let (width, height, length) = (width?, height?, length_m?);
    if 2.0 * height > length {
        let help = format!("allowed: at most half of the length, {length} m; beam theory needs slenderness");
        table.problem("height_m", format!("`height_m` is {height} m"), vec![help]);
        return None;
    }
    Some(Section { area_m2: width * height, second_moment_m4: width * height.powi(3) / 12.0 })
}

fn read_points(
    table: &Table<'_>,
    reading: &Reading,
    length_m: Option<f64>,
    names: &mut Names,
) -> Option<Vec<BeamPoint>> {
    let before = reading.count();
    let points = table.tables("point");
    let read: Vec<BeamPoint> =
        points.into_iter().filter_map(|point| read_point(point, length_m, names)).collect();
    (reading.count() == before).then_some(read)
}

fn read_point(table: Table<'_>, length_m: Option<f64>, names: &mut Names) -> Option<BeamPoint> {
    let name = read_name(&table, names);
    let at = table.required("at_m").and_then(|value| read_position(&value, length_m));
    let added = |key, quantity| table.optional(key).map_or(Some(0.0), |value| value.number(quantity));
    let mass = added("mass_kg", &quantity::ADDED_MASS);
    let inertia = added("rotary_inertia_kg_m2", &quantity::ROTARY_INERTIA);
    let spring = added("spring_n_m", &quantity::ADDED_STIFFNESS);
    let damper = added("damper_n_s_m", &quantity::DAMPER);
    let rotational_spring = added("rotational_spring_n_m_rad", &quantity::ROTATIONAL_STIFFNESS);
    let rotational_damper = added("rotational_damper_n_m_s_rad", &quantity::ROTATIONAL_DAMPER);
    table.finish();
    Some(BeamPoint {
        name: name?,
        at_m: at?,
        mass_kg: mass?,
        rotary_inertia_kg_m2: inertia?,
        spring_n_m: spring?,
        damper_n_s_m: damper?,
        rotational_spring_n_m_rad: rotational_spring?,
        rotational_damper_n_m_s_rad: rotational_damper?,
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
