//! `section` of a beam: a rectangle, a rod, a tube, or any form by its constants.

use hammerbeam_structure::Section as LinearSection;
use serde::Serialize;

use crate::document::{Key, KeyRow, TomlTable, Value, quantity};

/// Cross-section of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SectionKeys {
    /// Area [m^2].
    pub area_m2: f64,
    /// Second moment of area about the axis of bending [m^4].
    pub second_moment_m4: f64,
    /// Shear coefficient, of a beam with shear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_coefficient: Option<f64>,
    /// Whether it is a rectangle that is no square: then it bends in one plane more easily than across.
    #[serde(skip)]
    pub is_oblong: bool,
}

/// A section as it is given: its form, and its shear coefficient where it has one of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct GivenSection {
    form: LinearSection,
    shear_coefficient: Option<f64>,
}

impl GivenSection {
    /// The section in a material of that Poisson ratio, if it has shear.
    pub(super) fn with_poisson_ratio(self, poisson_ratio: Option<f64>) -> SectionKeys {
        let of_form = |ratio| self.shear_coefficient.or_else(|| self.form.shear_coefficient(ratio));
        SectionKeys {
            area_m2: self.form.area(),
            second_moment_m4: self.form.second_moment(),
            shear_coefficient: poisson_ratio.and_then(of_form),
            is_oblong: self.form.is_oblong(),
        }
    }
}

/// The forms of a section, each with its keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Rectangle,
    Round,
    General,
}

pub(super) const FORMS: [(Form, [&str; 2]); 3] = [
    (Form::Rectangle, ["width_m", "height_m"]),
    (Form::Round, ["outer_diameter_m", "wall_m"]),
    (Form::General, ["area_m2", "second_moment_m4"]),
];

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let half = "; at most half of the length";
    let wall = "; less than half of the diameter";
    let [none, rod] = ["required in this form", "none, a rod"];
    vec![
        Key::new("width_m", quantity::WIDTH, "width of a rectangle").without(none).row(),
        Key::new("height_m", quantity::HEIGHT, "its height, along which it bends")
            .further(half)
            .without(none)
            .row(),
        Key::new("outer_diameter_m", quantity::WIDTH, "outer diameter of a rod or tube")
            .further(half)
            .without(none)
            .row(),
        Key::new("wall_m", quantity::WIDTH, "wall of a tube").further(wall).without(rod).row(),
        Key::new("area_m2", quantity::AREA, "area of any section").without(none).row(),
        Key::new("second_moment_m4", quantity::SECOND_MOMENT, "its second moment of area")
            .without(none)
            .row(),
        Key::new(
            "shear_coefficient",
            quantity::SHEAR_COEFFICIENT,
            "part of the section that bears shear; with `theory = \"timoshenko\"` only",
        )
        .without("Cowper's coefficient of a rectangle, rod or tube; required for any other section")
        .row(),
    ]
}

/// The accepted forms, in words.
pub(super) fn forms() -> Vec<String> {
    vec![
        "allowed: { width_m, height_m } of a rectangle, { outer_diameter_m } of a rod, { outer_diameter_m, \
         wall_m } of a tube, or { area_m2, second_moment_m4 }"
            .to_owned(),
        "with units: { width = \"30 mm\", height = \"2 mm\" }, or { area = \"60 mm^2\", second_moment = \
         \"20 mm^4\" }"
            .to_owned(),
    ]
}

/// Reads a section.
///
/// * `length_m`: of the beam, which has to be slender.
/// * `has_shear`: whether the beam needs the shear coefficient.
pub(super) fn read(value: &Value<'_>, length_m: Option<f64>, has_shear: bool) -> Option<GivenSection> {
    let table = value.table_with_help(forms())?;
    let is_given = |(_, keys): &&(Form, [&'static str; 2])| keys.iter().any(|key| table.has(key));
    let given: Vec<Form> = FORMS.iter().filter(is_given).map(|(form, _)| *form).collect();
    let form = match given[..] {
        [Form::Rectangle] => read_rectangle(&table, length_m),
        [Form::Round] => read_round(&table, length_m),
        [Form::General] => read_general(&table),
        _ => {
            for key in FORMS.into_iter().flat_map(|(_, keys)| keys) {
                table.optional(key);
            }
            let found = if given.is_empty() { "has none" } else { "is a mix" };
            value.problem(format!("`section` {found} of the accepted forms"), forms());
            None
        }
    };
    let coefficient = read_coefficient(&table, has_shear, given[..] == [Form::General]);
    table.finish();
    Some(GivenSection { form: form?, shear_coefficient: coefficient? })
}

/// The shear coefficient: asked for where the form does not have one.
fn read_coefficient(table: &TomlTable<'_>, has_shear: bool, is_needed: bool) -> Option<Option<f64>> {
    const KEY: &str = "shear_coefficient";
    if !has_shear {
        return without_shear(table, KEY).then_some(None);
    }
    let value = if is_needed { Some(table.required(KEY)?) } else { table.optional(KEY) };
    value.map_or(Some(None), |value| value.number(&quantity::SHEAR_COEFFICIENT).map(Some))
}

/// Refuses a key of beams with shear; whether it is not there.
pub(super) fn without_shear(table: &TomlTable<'_>, key: &'static str) -> bool {
    if !table.has(key) {
        return true;
    }
    table.optional(key);
    let help = vec!["allowed: only with `theory = \"timoshenko\"` in [structure]".to_owned()];
    table.problem(key, format!("`{key}` is given for a beam without shear"), help);
    false
}

fn read_general(table: &TomlTable<'_>) -> Option<LinearSection> {
    let area = table.required_with_help("area_m2", forms()).and_then(|value| value.number(&quantity::AREA));
    let moment = table
        .required_with_help("second_moment_m4", forms())
        .and_then(|value| value.number(&quantity::SECOND_MOMENT));
    LinearSection::general(area?, moment?).ok()
}

fn read_rectangle(table: &TomlTable<'_>, length_m: Option<f64>) -> Option<LinearSection> {
    let width = table.required_with_help("width_m", forms()).and_then(|value| value.number(&quantity::WIDTH));
    let height =
        table.required_with_help("height_m", forms()).and_then(|value| value.number(&quantity::HEIGHT));
    let (width, height) = (width?, height?);
    is_slender(table, "height_m", height, length_m?).then_some(())?;
    LinearSection::rectangle(width, height).ok()
}

fn read_round(table: &TomlTable<'_>, length_m: Option<f64>) -> Option<LinearSection> {
    let outer = table
        .required_with_help("outer_diameter_m", forms())
        .and_then(|value| value.number(&quantity::WIDTH));
    let wall = table.optional("wall_m").map_or(Some(None), |value| value.number(&quantity::WIDTH).map(Some));
    let (outer, wall) = (outer?, wall?);
    is_slender(table, "outer_diameter_m", outer, length_m?).then_some(())?;
    let Some(wall) = wall else { return LinearSection::round(outer).ok() };
    if 2.0 * wall >= outer {
        let half = outer / 2.0;
        let help = format!("allowed: less than {half} m, half of the diameter; without `wall_m` it is a rod");
        table.problem("wall_m", format!("`wall_m` is {wall} m"), vec![help]);
        return None;
    }
    LinearSection::tube(outer, wall).ok()
}

/// Whether a beam is at least twice as long as high; noted where it is not.
fn is_slender(table: &TomlTable<'_>, key: &'static str, height: f64, length: f64) -> bool {
    let is_slender = 2.0 * height <= length;
    if !is_slender {
        let help = format!("allowed: at most half of the length, {length} m; beam theory needs slenderness");
        table.problem(key, format!("`{key}` is {height} m"), vec![help]);
    }
    is_slender
}
