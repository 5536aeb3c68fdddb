//! Spans of a beam: one, whose keys stand in `[structure]`, or several of `[[structure.span]]`.

use hammerbeam_structure::{self as linear, Shear, StructureError};
use serde::Serialize;

use crate::document::{Key, KeyRow, Reading, TomlTable, Value, key::Words, quantity};

use super::beam_section::{self, GivenSection, SectionKeys};

/// A stretch of a beam with one section and one material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BeamSpanEntry {
    /// Length [m].
    pub length_m: f64,
    /// Section and material.
    #[serde(flatten)]
    pub profile: BeamProfile,
}

/// Section and material of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BeamProfile {
    /// Cross-section.
    pub section: SectionKeys,
    /// Young's modulus [Pa].
    pub youngs_modulus_pa: f64,
    /// Density [kg/m^3].
    pub density_kg_m3: f64,
    /// Mass per length that moves along without stiffening [kg/m].
    #[serde(skip_serializing_if = "is_zero")]
    pub added_mass_kg_m: f64,
    /// Poisson's ratio, of a beam with shear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl BeamProfile {
    /// Bending stiffness `E I` [N m^2].
    #[must_use]
    pub fn bending_stiffness(&self) -> f64 {
        self.youngs_modulus_pa * self.section.second_moment_m4
    }

    /// Mass per length, added mass included [kg/m].
    #[must_use]
    pub fn mass_per_length(&self) -> f64 {
        self.density_kg_m3 * self.section.area_m2 + self.added_mass_kg_m
    }
}

impl BeamSpanEntry {
    /// The span in the terms of the structure crate.
    ///
    /// # Errors
    /// [`StructureError`]: a section without area or stiffness.
    pub(super) fn descriptor(&self) -> Result<linear::BeamSpan, StructureError> {
        let BeamProfile { section, youngs_modulus_pa, density_kg_m3, added_mass_kg_m, poisson_ratio } =
            self.profile;
        let shear = poisson_ratio.zip(section.shear_coefficient).map(|(ratio, coefficient)| Shear {
            modulus: youngs_modulus_pa / (2.0 * (1.0 + ratio)),
            coefficient,
        });
        Ok(linear::BeamSpan {
            length: self.length_m,
            section: linear::Section::general(section.area_m2, section.second_moment_m4)?,
            youngs_modulus: youngs_modulus_pa,
            density: density_kg_m3,
            added_mass: added_mass_kg_m,
            shear,
        })
    }
}

/// What a table says of section and material; what it does not say, or says wrongly, is `None`.
#[derive(Debug, Clone, Copy, Default)]
struct GivenProfile {
    section: Option<GivenSection>,
    youngs_modulus_pa: Option<f64>,
    density_kg_m3: Option<f64>,
    added_mass_kg_m: Option<f64>,
    poisson_ratio: Option<f64>,
}

/// Whether a beam has shear.
const THEORY: Key<Words<bool>> = Key::new(
    "theory",
    Words(&[("euler-bernoulli", false), ("timoshenko", true)]),
    "without or with shear and the rotary inertia of the section",
)
.or(false);

/// Rows of the page of keys: the length of a beam or a span.
pub(super) fn row_of_length(without: &'static str) -> KeyRow {
    Key::new("length_m", quantity::LENGTH, "length").without(without).row()
}

/// The theory of a beam.
pub(super) fn row_of_theory() -> KeyRow {
    THEORY.row()
}

/// Section and material.
pub(super) fn rows_of_profile() -> Vec<KeyRow> {
    let added = "mass per length that moves along and does not stiffen: water in a tube, a coat";
    vec![
        KeyRow::read_apart("section", "table, below", "required", "cross-section"),
        Key::new("youngs_modulus_pa", quantity::MODULUS, "Young's modulus; 210 GPa is `2.1e11`").row(),
        Key::new("density_kg_m3", quantity::DENSITY, "density").row(),
        Key::new("added_mass_kg_m", quantity::ADDED_MASS_PER_LENGTH, added).or(0.0).row(),
        Key::new("poisson_ratio", quantity::POISSON, "Poisson's ratio")
            .without("required with shear, not a key without")
            .row(),
    ]
}

/// Those of `[[structure.span]]`.
pub(super) fn rows() -> Vec<KeyRow> {
    let outer = |row: KeyRow| KeyRow { default: "as in `[structure]`".to_owned(), ..row };
    let profile = rows_of_profile().into_iter().map(outer);
    [row_of_length("required")].into_iter().chain(profile).collect()
}

/// Reads the keys of a span, or those that hold for all spans.
#[derive(Clone, Copy)]
struct ProfileReader<'r, 'a> {
    table: &'r TomlTable<'a>,
    /// The table whose keys hold where this one has none, and what it says.
    outer: Option<(&'r TomlTable<'a>, &'r GivenProfile)>,
    /// Whether keys have to be here or there.
    is_needed: bool,
    has_shear: bool,
}

impl ProfileReader<'_, '_> {
    /// Reads a key here; or takes it from the outer table, where it stands only there.
    fn chosen<T>(
        &self,
        key: &'static str,
        help: Vec<String>,
        outer: impl Fn(&GivenProfile) -> Option<T>,
        read: impl Fn(&Value<'_>) -> Option<T>,
    ) -> Option<T> {
        if let Some((_, given)) = self.outer.filter(|(table, _)| table.has(key) && !self.table.has(key)) {
            self.table.optional(key);
            return outer(given);
        }
        let value =
            if self.is_needed { self.table.required_with_help(key, help) } else { self.table.optional(key) };
        value.and_then(|value| read(&value))
    }

    fn read(&self, length_m: Option<f64>) -> GivenProfile {
        let section = self.chosen(
            "section",
            beam_section::forms(),
            |given| given.section,
            |value| beam_section::read(value, length_m, self.has_shear),
        );
        let none = Vec::new;
        let youngs_modulus_pa = self.chosen(
            "youngs_modulus_pa",
            none(),
            |given| given.youngs_modulus_pa,
            |value| value.number(&quantity::MODULUS),
        );
        let density_kg_m3 = self.chosen(
            "density_kg_m3",
            none(),
            |given| given.density_kg_m3,
            |value| value.number(&quantity::DENSITY),
        );
        let poisson_ratio = if self.has_shear {
            let read = |value: &Value<'_>| value.number(&quantity::POISSON);
            self.chosen("poisson_ratio", none(), |given| given.poisson_ratio, read)
        } else {
            beam_section::without_shear(self.table, "poisson_ratio");
            None
        };
        let added = Self { is_needed: false, ..*self };
        let read = |value: &Value<'_>| value.number(&quantity::ADDED_MASS_PER_LENGTH);
        let is_given = |table: &TomlTable<'_>| table.has("added_mass_kg_m");
        let has_added = is_given(self.table) || self.outer.is_some_and(|(table, _)| is_given(table));
        let added_mass = added.chosen("added_mass_kg_m", none(), |given| given.added_mass_kg_m, read);
        let added_mass_kg_m = if has_added { added_mass } else { Some(0.0) };
        GivenProfile { section, youngs_modulus_pa, density_kg_m3, added_mass_kg_m, poisson_ratio }
    }
}

impl GivenProfile {
    /// The profile, if all of it is there.
    fn whole(self, has_shear: bool) -> Option<BeamProfile> {
        let poisson_ratio = if has_shear { Some(self.poisson_ratio?) } else { None };
        Some(BeamProfile {
            section: self.section?.with_poisson_ratio(poisson_ratio),
            youngs_modulus_pa: self.youngs_modulus_pa?,
            density_kg_m3: self.density_kg_m3?,
            added_mass_kg_m: self.added_mass_kg_m?,
            poisson_ratio,
        })
    }
}

/// Reads length, section, material and theory of a beam.
///
/// # Returns
/// Length of all spans [m], and the spans; each `None` where something of it is wrong.
pub(super) fn read(table: &TomlTable<'_>, reading: &Reading) -> (Option<f64>, Option<Vec<BeamSpanEntry>>) {
    let has_shear = THEORY.read(table);
    let has_shear_or_not = has_shear.unwrap_or(table.has("poisson_ratio"));
    let (length, spans) = if table.has("span") {
        read_several(table, reading, has_shear_or_not)
    } else {
        read_one(table, has_shear_or_not)
    };
    (length, has_shear.and(spans))
}

fn read_one(table: &TomlTable<'_>, has_shear: bool) -> (Option<f64>, Option<Vec<BeamSpanEntry>>) {
    let length = table.required("length_m").and_then(|value| value.number(&quantity::LENGTH));
    let reader = ProfileReader { table, outer: None, is_needed: true, has_shear };
    let profile = reader.read(length).whole(has_shear);
    // Known, so that a key that is nearly it is suggested.
    table.optional("span");
    let span = length.zip(profile).map(|(length_m, profile)| vec![BeamSpanEntry { length_m, profile }]);
    (length, span)
}

fn read_several(
    table: &TomlTable<'_>,
    reading: &Reading,
    has_shear: bool,
) -> (Option<f64>, Option<Vec<BeamSpanEntry>>) {
    if table.has("length_m") {
        table.optional("length_m");
        let help = vec!["allowed: `length_m` of each span, and none of the beam".to_owned()];
        table.problem("length_m", "`length_m` is given for a beam of several spans".to_owned(), help);
    }
    let before = reading.count();
    let spans = table.tables("span");
    if spans.is_empty() && reading.count() == before {
        let help = vec!["allowed: at least one [[structure.span]]".to_owned()];
        table.problem("span", "`span` is an empty list".to_owned(), help);
    }
    let lengths: Vec<Option<f64>> =
        spans.iter().map(|span| span.required("length_m")?.number(&quantity::LENGTH)).collect();
    let length = lengths.iter().copied().sum::<Option<f64>>().filter(|length| *length > 0.0);
    let common = ProfileReader { table, outer: None, is_needed: false, has_shear }.read(length);
    let read = |(span, length_m): (TomlTable<'_>, Option<f64>)| {
        let reader =
            ProfileReader { table: &span, outer: Some((table, &common)), is_needed: true, has_shear };
        let profile = reader.read(length).whole(has_shear);
        span.finish();
        Some(BeamSpanEntry { length_m: length_m?, profile: profile? })
    };
    let read: Vec<Option<BeamSpanEntry>> = spans.into_iter().zip(lengths).map(read).collect();
    (length, if reading.count() == before { read.into_iter().collect() } else { None })
}
