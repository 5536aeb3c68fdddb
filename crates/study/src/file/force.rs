//! Forces: on a point or as a pair on two, with an amplitude or of an unbalance.

use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, TomlTable, quantity};

use super::{Amplitude, amplitude, harmonic::PHASE, names::Names};

/// A harmonic force `amplitude cos(2 pi order f t + phase)`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ActingForce {
    /// Where.
    pub place: ForcePlace,
    /// How large.
    pub size: ForceSize,
    /// Phase [rad]; that of the excitation is added.
    pub phase_rad: f64,
}

/// Where a force acts.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ForcePlace {
    /// At a point.
    At(String),
    /// At two points, against the displacement of the second.
    Between([String; 2]),
}

/// How large a force is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ForceSize {
    /// Amplitude [N].
    Amplitude(Amplitude),
    /// That of a mass which turns with the frequency, `m e (2 pi order f)^2`.
    Unbalance {
        /// The mass m [kg].
        mass_kg: f64,
        /// Its distance e from the axis [m].
        eccentricity_m: f64,
    },
}

impl ForcePlace {
    /// The point, or the two.
    #[must_use]
    pub fn points(&self) -> &[String] {
        match self {
            Self::At(point) => std::slice::from_ref(point),
            Self::Between(pair) => pair,
        }
    }
}

impl ForceSize {
    /// A constant amplitude [N].
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Amplitude(amplitude) => amplitude.constant(),
            Self::Unbalance { .. } => None,
        }
    }

    /// Amplitude of the force [N] of an order at a frequency.
    #[must_use]
    pub fn at(&self, order: u32, frequency_hz: f64) -> f64 {
        match self {
            Self::Amplitude(amplitude) => amplitude.at(frequency_hz),
            Self::Unbalance { mass_kg, eccentricity_m } => {
                let rate = std::f64::consts::TAU * f64::from(order) * frequency_hz;
                mass_kg * eccentricity_m * rate * rate
            }
        }
    }
}

/// The keys of the amplitude and of an unbalance.
const AMPLITUDE: &str = "amplitude_n";
const UNBALANCE: [&str; 2] = [UNBALANCE_MASS.name, ECCENTRICITY.name];

const UNBALANCE_MASS: Key<Quantity> = Key::new(
    "unbalance_mass_kg",
    quantity::MASS,
    "a mass `m` that turns at the distance `e` from its axis: amplitude `m e (2 pi order f)^2`",
)
.without("none");
const ECCENTRICITY: Key<Quantity> =
    Key::new("eccentricity_m", quantity::ECCENTRICITY, "its distance `e`").without("none");

/// Rows of the page of keys: the size of a force.
///
/// * `without`: when its amplitude is required.
pub(super) fn rows_of_size(without: &'static str) -> [KeyRow; 3] {
    let amplitude = Key::new(AMPLITUDE, quantity::FORCE, "amplitude of the force").without(without);
    [amplitude.further("; or a table over the frequency").row(), UNBALANCE_MASS.row(), ECCENTRICITY.row()]
}

/// That of a pair.
pub(super) fn row_of_between() -> KeyRow {
    KeyRow::read_apart(
        "between",
        "two names",
        "none",
        "a pair of forces: `F` on the first point and `-F` on the second, as an actuator between them makes",
    )
}

/// Those of `force`.
pub(super) fn rows() -> Vec<KeyRow> {
    let at = KeyRow::read_apart("at", "a name", "required, or `between`", "the point");
    let [amplitude, mass, eccentricity] = rows_of_size("required, or an unbalance");
    vec![at, row_of_between(), amplitude, mass, eccentricity, PHASE.row()]
}

/// Reads `at` or `between`, and `amplitude_n` or an unbalance; no phase.
///
/// * `constant`: what an amplitude may be that is a number.
pub(super) fn read(
    table: &TomlTable<'_>,
    names: &Names,
    constant: &Quantity,
) -> Option<(ForcePlace, ForceSize)> {
    let place = read_place(table, names);
    let size = read_size(table, constant);
    Some((place?, size?))
}

fn read_place(table: &TomlTable<'_>, names: &Names) -> Option<ForcePlace> {
    let Some(between) = table.optional("between") else {
        let at = table.required("at").and_then(|value| names.point(&value));
        return at.map(ForcePlace::At);
    };
    if table.optional("at").is_some() {
        let help = vec!["allowed: one of `at` and `between`".to_owned()];
        between.problem("`between` is given, and `at`, too".to_owned(), help);
        return None;
    }
    names.pair(&between, false).map(ForcePlace::Between)
}

fn read_size(table: &TomlTable<'_>, constant: &Quantity) -> Option<ForceSize> {
    if !UNBALANCE.iter().any(|key| table.has(key)) {
        let value = table.required(AMPLITUDE)?;
        let allowed = if value.is_list() { &quantity::FORCE } else { constant };
        UNBALANCE.iter().for_each(|key| drop(table.optional(key)));
        return amplitude::read(&value, allowed).map(ForceSize::Amplitude);
    }
    let has_both = table.has(AMPLITUDE);
    if has_both {
        let help = vec![format!("allowed: `{AMPLITUDE}`, or `{}` with `{}`", UNBALANCE[0], UNBALANCE[1])];
        table.problem(AMPLITUDE, format!("`{AMPLITUDE}` is given for an unbalance"), help);
        table.optional(AMPLITUDE);
    }
    let (mass, eccentricity) = (UNBALANCE_MASS.read(table), ECCENTRICITY.read(table));
    let (mass_kg, eccentricity_m) = (mass?, eccentricity?);
    (!has_both).then_some(ForceSize::Unbalance { mass_kg, eccentricity_m })
}

/// Refuses a table of amplitudes that does not cover the range of the frequency [Hz].
pub(super) fn check_size(table: &TomlTable<'_>, size: &ForceSize, range: [f64; 2]) {
    if let ForceSize::Amplitude(amplitude) = size {
        amplitude::check_range(table, AMPLITUDE, amplitude, range);
    }
}

/// Reads an entry of `[[excitation.force]]`.
pub(super) fn read_entry(
    entry: TomlTable<'_>,
    names: &Names,
    range: Option<[f64; 2]>,
) -> Option<ActingForce> {
    let force = read(&entry, names, &quantity::FORCE);
    let phase = PHASE.read(&entry);
    if let (Some((_, size)), Some(range)) = (&force, range) {
        check_size(&entry, size, range);
    }
    entry.finish();
    let (place, size) = force?;
    Some(ActingForce { place, size, phase_rad: phase? })
}
