//! `[[load]]`: constant and further harmonic loads besides the excitation.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, Quantity, Reading, TomlTable, Value,
    key::{Whole, Words, words},
    quantity,
};

use super::{
    ActingForce, Amplitude, Excitation, ForcePlace, SupportDrive, amplitude, force,
    harmonic::{ORDERS, PHASE},
    names::Names,
    support_motion,
};

/// A load besides the excitation; of order 0 it is constant.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LoadTable {
    /// A uniform acceleration field.
    Gravity {
        /// Acceleration along the displacement [m/s^2]; negative pulls downwards.
        acceleration_m_s2: f64,
    },
    /// A force.
    Force {
        /// Point.
        at: String,
        /// Amplitude [N].
        amplitude_n: f64,
        /// Multiple of the excitation frequency; 0 for a constant.
        order: u32,
        /// Phase [rad].
        phase_rad: f64,
    },
    /// A force that is a pair, of an unbalance, or over the frequency.
    ActingForce {
        /// The force.
        #[serde(flatten)]
        force: ActingForce,
        /// Multiple of the excitation frequency; 0 for a constant.
        order: u32,
    },
    /// A further harmonic of a support's acceleration, or of its motion over the frequency.
    DrivenSupport {
        /// Number of the support among those that move, from 0.
        #[serde(skip_serializing_if = "is_first")]
        support: usize,
        /// What is prescribed.
        motion: SupportDrive,
        /// Multiple of the excitation frequency.
        order: u32,
        /// Phase [rad].
        phase_rad: f64,
    },
    /// A further harmonic of the motion of a support.
    SupportMotion {
        /// Number of the support among those that move, from 0.
        #[serde(skip_serializing_if = "is_first")]
        support: usize,
        /// Amplitude [m].
        amplitude_m: f64,
        /// Multiple of the excitation frequency.
        order: u32,
        /// Phase [rad].
        phase_rad: f64,
    },
}

impl LoadTable {
    /// Multiple of the excitation frequency; 0 of a constant.
    #[must_use]
    pub fn order(&self) -> u32 {
        match self {
            Self::Gravity { .. } => 0,
            Self::Force { order, .. }
            | Self::ActingForce { order, .. }
            | Self::DrivenSupport { order, .. }
            | Self::SupportMotion { order, .. } => *order,
        }
    }

    /// Points at which a force acts.
    #[must_use]
    pub fn force_points(&self) -> &[String] {
        match self {
            Self::Force { at, .. } => std::slice::from_ref(at),
            Self::ActingForce { force, .. } => force.place.points(),
            Self::Gravity { .. } | Self::DrivenSupport { .. } | Self::SupportMotion { .. } => &[],
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
fn is_first(support: &usize) -> bool {
    *support == 0
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Gravity,
    Force,
    SupportMotion,
}

const KIND: Key<Words<Kind>> = Key::new(
    "kind",
    Words(&[("gravity", Kind::Gravity), ("force", Kind::Force), ("support-motion", Kind::SupportMotion)]),
    "what acts",
);
const GRAVITY: Key<Quantity> = Key::new(
    "acceleration_m_s2",
    quantity::GRAVITY,
    "uniform acceleration, positive upwards: the weight of a horizontal beam is `-9.81`",
);
/// Of a force, which may be constant.
const FORCE_ORDER: Key<Whole> =
    Key::new("order", Whole(0, ORDERS.1), "multiple of the frequency; of order 0 it is constant");
const SUPPORT_ORDER: Key<Whole> = Key::new("order", ORDERS, "multiple of the frequency");

/// A key of some kinds.
fn of_kinds(kinds: &[&str], row: KeyRow) -> KeyRow {
    KeyRow { of: words(kinds.iter().copied()), ..row }
}

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let (force, support) = (["force"], ["support-motion"]);
    let point = KeyRow::read_apart("at", "a point", "required, or `between`", "the point");
    let [amplitude, mass, eccentricity] = force::rows_of_size("required, or an unbalance");
    let amplitude = KeyRow { allowed: or_table(&quantity::LOAD_FORCE), ..amplitude };
    let forces = [point, force::row_of_between(), amplitude, mass, eccentricity, FORCE_ORDER.row()];
    let moved = "of the supports that `[excitation]` moves, which one";
    let place = KeyRow::read_apart("at", "a name", "required where supports move differently", moved);
    let [displacement, acceleration] = support_motion::rows_of_amplitude("");
    let displacement = KeyRow { allowed: or_table(&quantity::LOAD_DISPLACEMENT), ..displacement };
    let displacement = KeyRow { default: "required, or `amplitude_m_s2`".to_owned(), ..displacement };
    let acceleration = KeyRow { allowed: or_table(&quantity::GRAVITY), ..acceleration };
    let motions = [place, displacement, acceleration, SUPPORT_ORDER.row()];
    let mut rows = vec![KIND.row(), of_kinds(&["gravity"], GRAVITY.row())];
    rows.extend(forces.map(|row| of_kinds(&force, row)));
    rows.extend(motions.map(|row| of_kinds(&support, row)));
    rows.push(of_kinds(&[force, support].concat(), PHASE.meaning("phase; not of order 0").row()));
    rows
}

/// A number of that range, or a table.
fn or_table(quantity: &Quantity) -> String {
    format!("{}; or a table over the frequency", quantity.allowed())
}

pub(super) fn read(
    root: &TomlTable<'_>,
    reading: &Reading,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<Vec<LoadTable>> {
    let before = reading.count();
    let loads =
        root.tables("load").into_iter().filter_map(|load| read_load(load, names, excitation)).collect();
    (reading.count() == before).then_some(loads)
}

fn read_load(table: TomlTable<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<LoadTable> {
    let kind = KIND.read(&table)?;
    let load = match kind {
        Kind::Gravity => read_gravity(&table),
        Kind::Force => read_force(&table, names, excitation),
        Kind::SupportMotion => read_support_motion(&table, excitation),
    };
    table.finish();
    load
}

fn read_gravity(table: &TomlTable<'_>) -> Option<LoadTable> {
    Some(LoadTable::Gravity { acceleration_m_s2: GRAVITY.read(table)? })
}

fn read_force(table: &TomlTable<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<LoadTable> {
    let force = force::read(table, names, &quantity::LOAD_FORCE);
    let (order, phase) = read_harmonic(table, FORCE_ORDER);
    if excitation == Some(&Excitation::None) && order.is_some_and(|order| order > 0) {
        let message = "`order` is a multiple of the excitation frequency, and there is no [excitation]";
        table.problem("order", message.into(), vec!["allowed: 0, a constant force".into()]);
    }
    let ((place, size), order, phase_rad) = (force?, order?, phase?);
    check_over_frequency(table, size.constant().is_some(), order);
    if let Some(excitation) = excitation {
        force::check_size(table, &size, excitation.range_hz());
    }
    Some(match (place, size.constant()) {
        (ForcePlace::At(at), Some(amplitude_n)) => LoadTable::Force { at, amplitude_n, order, phase_rad },
        (place, _) => LoadTable::ActingForce { force: ActingForce { place, size, phase_rad }, order },
    })
}

/// Refuses a constant of which the frequency is to change the amplitude.
fn check_over_frequency(table: &TomlTable<'_>, keeps: bool, order: u32) {
    if !keeps && order == 0 {
        let help = vec!["allowed: only with `order` >= 1".to_owned()];
        table.problem("order", "the amplitude of a constant depends on the frequency".to_owned(), help);
    }
}

fn read_support_motion(table: &TomlTable<'_>, excitation: Option<&Excitation>) -> Option<LoadTable> {
    if excitation.is_some_and(|excitation| excitation.supports().is_empty()) {
        let help = vec!["allowed: only with `kind = \"support-motion\"` in [excitation]".into()];
        table.problem("kind", "a load of kind \"support-motion\" needs a moving support".into(), help);
    }
    let support = match excitation {
        Some(excitation) if excitation.supports_differ() => {
            table.required("at").and_then(|value| read_support(&value, excitation))
        }
        _ => Some(0),
    };
    let motion = support_motion::read_motion(table, &quantity::LOAD_DISPLACEMENT, &quantity::GRAVITY);
    let (order, phase) = read_harmonic(table, SUPPORT_ORDER);
    let (support, motion, order, phase_rad) = (support?, motion?, order?, phase?);
    if let Some(excitation) = excitation {
        let (key, amplitude) = match &motion {
            SupportDrive::Displacement(amplitude) => ("amplitude_m", amplitude),
            SupportDrive::Acceleration(amplitude) => ("amplitude_m_s2", amplitude),
        };
        amplitude::check_range(table, key, amplitude, excitation.range_hz());
    }
    Some(match motion {
        SupportDrive::Displacement(Amplitude::Constant(amplitude_m)) => {
            LoadTable::SupportMotion { support, amplitude_m, order, phase_rad }
        }
        motion => LoadTable::DrivenSupport { support, motion, order, phase_rad },
    })
}

/// Number of the support that has a place with that name.
fn read_support(value: &Value<'_>, excitation: &Excitation) -> Option<usize> {
    let name = value.text()?;
    let number = excitation.support_at(name);
    if number.is_none() {
        value.unknown_word(name, "a support that [excitation] moves", &excitation.moving_places());
    }
    number
}

/// `order`, which a load has to state, and `phase_rad`, which a constant does not have.
fn read_harmonic(table: &TomlTable<'_>, order: Key<Whole>) -> (Option<u32>, Option<f64>) {
    let order = order.read(table);
    if order == Some(0) && table.has(PHASE.name) {
        let help = vec!["allowed: only with `order` >= 1".into()];
        table.problem(PHASE.name, "`phase_rad` is given for a constant".into(), help);
    }
    (order, PHASE.read(table))
}
