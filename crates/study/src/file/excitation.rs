//! `[excitation]`: the harmonic that carries the frequency of the study, if it has one.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, TomlTable, Value,
    key::{Whole, Words},
    quantity,
};

use super::{
    ActingForce, Amplitude, ForcePlace, ForceSize, StructureTable, amplitude, force,
    harmonic::{ORDERS, PHASE},
    names::Names,
    support_motion::{self, MovingSupport, PrescribedMotion, SupportDrive},
};

/// What shakes the structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Excitation {
    /// Nothing: it vibrates freely, there is no frequency, and time has no period.
    None,
    /// A harmonic.
    Harmonic(HarmonicExcitation),
}

/// The harmonic excitation `amplitude cos(2 pi order f t + phase)` and the range of `f`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HarmonicExcitation {
    /// What is driven.
    pub kind: ExcitationKind,
    /// Phase [rad].
    pub phase_rad: f64,
    /// Multiple of the excitation frequency.
    pub order: u32,
    /// Range of the excitation frequency [Hz]; branches are cut exactly at its ends.
    pub frequency_hz: [f64; 2],
}

/// What the excitation drives.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExcitationKind {
    /// A displacement common to the named supports is prescribed.
    SupportMotion {
        /// Supports that move together.
        at: Vec<String>,
        /// Amplitude [m].
        amplitude_m: Amplitude,
    },
    /// An acceleration common to the named supports is prescribed.
    SupportAcceleration {
        /// Supports that move together.
        at: Vec<String>,
        /// Amplitude [m/s^2].
        amplitude_m_s2: Amplitude,
    },
    /// Displacements of several supports are prescribed, each in its own way.
    SupportMotions {
        /// The supports.
        supports: Vec<MovingSupport>,
    },
    /// A force acts.
    Force {
        /// Point.
        at: String,
        /// Amplitude [N].
        amplitude_n: Amplitude,
    },
    /// Several forces act, or one that is a pair or of an unbalance.
    Forces {
        /// The forces.
        forces: Vec<ActingForce>,
    },
}

impl Excitation {
    /// The harmonic, if there is one.
    #[must_use]
    pub fn harmonic(&self) -> Option<&HarmonicExcitation> {
        if let Self::Harmonic(harmonic) = self { Some(harmonic) } else { None }
    }

    /// The supports whose motion is prescribed, by the names of their places; none for a force. Places that
    /// move alike are one support.
    #[must_use]
    pub fn supports(&self) -> Vec<&[String]> {
        match self.harmonic().map(|harmonic| &harmonic.kind) {
            Some(
                ExcitationKind::SupportMotion { at, .. } | ExcitationKind::SupportAcceleration { at, .. },
            ) => {
                vec![at]
            }
            Some(ExcitationKind::SupportMotions { supports }) => {
                supports.iter().map(|support| support.at.as_slice()).collect()
            }
            Some(ExcitationKind::Force { .. } | ExcitationKind::Forces { .. }) | None => Vec::new(),
        }
    }

    /// The places of all of them.
    #[must_use]
    pub fn moving_places(&self) -> Vec<&str> {
        self.supports().into_iter().flatten().map(String::as_str).collect()
    }

    /// Number of the support that has a place with that name.
    #[must_use]
    pub fn support_at(&self, name: &str) -> Option<usize> {
        self.supports().iter().position(|places| places.iter().any(|place| place == name))
    }

    /// Whether each support has a motion of its own, so that it has to be named.
    #[must_use]
    pub fn supports_differ(&self) -> bool {
        self.supports().len() > 1
    }

    /// The points at which forces act; none for support motion.
    #[must_use]
    pub fn force_points(&self) -> Vec<&str> {
        match self.harmonic().map(|harmonic| &harmonic.kind) {
            Some(ExcitationKind::Force { at, .. }) => vec![at],
            Some(ExcitationKind::Forces { forces }) => {
                forces.iter().flat_map(|force| force.place.points()).map(String::as_str).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Range of the frequency [Hz]; without a harmonic there is nothing in it, `[0, 0]`.
    #[must_use]
    pub fn range_hz(&self) -> [f64; 2] {
        self.harmonic().map_or([0.0; 2], |harmonic| harmonic.frequency_hz)
    }
}

impl ExcitationKind {
    fn of_supports(motion: PrescribedMotion) -> Self {
        match motion {
            PrescribedMotion::Common { at, drive: SupportDrive::Displacement(amplitude_m) } => {
                Self::SupportMotion { at, amplitude_m }
            }
            PrescribedMotion::Common { at, drive: SupportDrive::Acceleration(amplitude_m_s2) } => {
                Self::SupportAcceleration { at, amplitude_m_s2 }
            }
            PrescribedMotion::Each(supports) => Self::SupportMotions { supports },
        }
    }
}

impl HarmonicExcitation {
    /// Amplitude [m, m/s^2 or N]; supports that move each in its own way have several, and so have forces.
    #[must_use]
    pub fn amplitude(&self) -> Option<&Amplitude> {
        match &self.kind {
            ExcitationKind::SupportMotion { amplitude_m, .. } => Some(amplitude_m),
            ExcitationKind::SupportAcceleration { amplitude_m_s2, .. } => Some(amplitude_m_s2),
            ExcitationKind::SupportMotions { .. } | ExcitationKind::Forces { .. } => None,
            ExcitationKind::Force { amplitude_n, .. } => Some(amplitude_n),
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    SupportMotion,
    Force,
}

const KIND: Key<Words<Kind>> = Key::new(
    "kind",
    Words(&[("support-motion", Kind::SupportMotion), ("force", Kind::Force)]),
    "what is prescribed",
);
const ORDER: Key<Whole> = Key::new("order", ORDERS, "multiple of the frequency").or(1);

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let at = KeyRow::read_apart(
        "at",
        "a name; for support motion also a list of names",
        "required, or `support`, `between`, `force`",
        "where",
    );
    let list = |name, meaning| KeyRow::read_apart(name, "list of tables, below", "none", meaning);
    let frequency = Key::new(
        "frequency_hz",
        quantity::EXCITATION_FREQUENCY,
        "`[low, high]`, the range of the excitation frequency; branches are cut exactly at its ends",
    );
    let frequency = frequency.further(", `low` less than `high`").row();
    let mut rows = vec![KIND.row(), at];
    rows.extend(support_motion::rows_of_amplitude("; on a beam at most its length"));
    rows.push(list("support", "supports that move differently"));
    rows.extend(force::rows_of_size("required for a force, or an unbalance, or `force`"));
    rows.extend([force::row_of_between(), list("force", "several forces")]);
    rows.extend([frequency, PHASE.row(), ORDER.row()]);
    rows
}

pub(super) fn read(
    root: &TomlTable<'_>,
    names: &Names,
    structure: Option<&StructureTable>,
) -> Option<Excitation> {
    let Some(table) = root.optional("excitation") else { return Some(Excitation::None) };
    let table = table.table()?;
    let kind = KIND.read(&table);
    let known = kind.is_some();
    let range = table.required("frequency_hz").and_then(|value| read_range(&value));
    let kind = kind.and_then(|kind| match kind {
        Kind::SupportMotion => support_motion::read(&table, names).map(ExcitationKind::of_supports),
        Kind::Force if table.has("force") => read_forces(&table, names, range),
        Kind::Force => read_force(&table, names),
    });
    let phase = PHASE.read(&table);
    let order = ORDER.read(&table);
    if let (Some(kind), Some(range)) = (&kind, range) {
        check_table(&table, kind, range);
    }
    if let (Some(kind), Some(structure)) = (&kind, structure) {
        check_magnitude(&table, kind, structure);
    }
    if known {
        table.finish();
    }
    let (kind, phase_rad, order, frequency_hz) = (kind?, phase?, order?, range?);
    Some(Excitation::Harmonic(HarmonicExcitation { kind, phase_rad, order, frequency_hz }))
}

/// One force, on a point with an amplitude or otherwise.
fn read_force(table: &TomlTable<'_>, names: &Names) -> Option<ExcitationKind> {
    let (place, size) = force::read(table, names, &quantity::FORCE)?;
    Some(match (place, size) {
        (ForcePlace::At(at), ForceSize::Amplitude(amplitude_n)) => ExcitationKind::Force { at, amplitude_n },
        (place, size) => ExcitationKind::Forces { forces: vec![ActingForce { place, size, phase_rad: 0.0 }] },
    })
}

/// The entries of `[[excitation.force]]`.
fn read_forces(table: &TomlTable<'_>, names: &Names, range: Option<[f64; 2]>) -> Option<ExcitationKind> {
    for key in ["at", "between", "amplitude_n", "unbalance_mass_kg", "eccentricity_m", "phase_rad"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: in each entry of `force`, which says it for its own".to_owned()];
            value.problem(format!("`{key}` is given besides `force`"), help);
        }
    }
    if table.optional("force").is_some_and(|value| value.is_empty_list()) {
        let help = vec!["allowed: one [[excitation.force]] or more".to_owned()];
        table.problem("force", "`force` is an empty list".to_owned(), help);
        return None;
    }
    let entries = table.tables("force").into_iter();
    let forces: Vec<Option<ActingForce>> =
        entries.map(|entry| force::read_entry(entry, names, range)).collect();
    if forces.is_empty() {
        return None;
    }
    forces.into_iter().collect::<Option<Vec<_>>>().map(|forces| ExcitationKind::Forces { forces })
}

/// A table has to cover the range of the frequency.
fn check_table(table: &TomlTable<'_>, kind: &ExcitationKind, range: [f64; 2]) {
    let (key, amplitude) = match kind {
        ExcitationKind::SupportMotion { amplitude_m, .. } => ("amplitude_m", amplitude_m),
        ExcitationKind::SupportAcceleration { amplitude_m_s2, .. } => ("amplitude_m_s2", amplitude_m_s2),
        ExcitationKind::Force { amplitude_n, .. } => ("amplitude_n", amplitude_n),
        ExcitationKind::Forces { forces } if !table.has("force") => {
            return forces.iter().for_each(|force| force::check_size(table, &force.size, range));
        }
        ExcitationKind::SupportMotions { .. } | ExcitationKind::Forces { .. } => return,
    };
    amplitude::check_range(table, key, amplitude, range);
}

/// A support that moves further than the beam is long is in the wrong unit.
fn check_magnitude(table: &TomlTable<'_>, kind: &ExcitationKind, structure: &StructureTable) {
    let StructureTable::Beam(beam) = structure else { return };
    let (key, amplitude) = match kind {
        ExcitationKind::SupportMotion { amplitude_m, .. } => ("amplitude_m", amplitude_m.largest()),
        ExcitationKind::SupportMotions { supports } => {
            let moved = supports.iter().map(|support| match &support.drive {
                SupportDrive::Displacement(amplitude) => amplitude.largest(),
                SupportDrive::Acceleration(_) => 0.0,
            });
            ("support", moved.fold(0.0, f64::max))
        }
        ExcitationKind::SupportAcceleration { .. }
        | ExcitationKind::Force { .. }
        | ExcitationKind::Forces { .. } => return,
    };
    let length = beam.length_m;
    if amplitude > length {
        let help = format!("allowed: at most {length} m, the length of the beam; is the unit m?");
        table.problem(key, format!("`amplitude_m` is {amplitude} m"), vec![help]);
    }
}

fn read_range(value: &Value<'_>) -> Option<[f64; 2]> {
    let range = value.numbers::<2>(&quantity::EXCITATION_FREQUENCY)?;
    if range[0] < range[1] {
        return Some(range);
    }
    let what = if range[0] == range[1] { "empty" } else { "reversed" };
    let help = vec!["allowed: [low, high] with low < high".into()];
    value.problem(format!("`frequency_hz` is [{}, {}], which is {what}", range[0], range[1]), help);
    None
}
