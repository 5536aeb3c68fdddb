//! `[[load]]`: constant and further harmonic loads besides the excitation.

use serde::Serialize;

use crate::document::{Reading, Table, Value, quantity};

use super::{Excitation, names::Names};

/// A load besides the excitation; of order 0 it is constant.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
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

#[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
fn is_first(support: &usize) -> bool {
    *support == 0
}

#[derive(Clone, Copy)]
enum Kind {
    Gravity,
    Force,
    SupportMotion,
}

const KINDS: [(&str, Kind); 3] =
    [("gravity", Kind::Gravity), ("force", Kind::Force), ("support-motion", Kind::SupportMotion)];

pub(super) fn read(
    root: &Table<'_>,
    reading: &Reading,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<Vec<Load>> {
    let before = reading.count();
    let loads =
        root.tables("load").into_iter().filter_map(|load| read_load(load, names, excitation)).collect();
    (reading.count() == before).then_some(loads)
}

fn read_load(table: Table<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<Load> {
    let kind = table.required("kind").and_then(|value| value.choice(&KINDS))?;
    let load = match kind {
        Kind::Gravity => read_gravity(&table),
        Kind::Force => read_force(&table, names, excitation),
        Kind::SupportMotion => read_support_motion(&table, excitation),
    };
    table.finish();
    load
}

fn read_gravity(table: &Table<'_>) -> Option<Load> {
    let acceleration = table.required("acceleration_m_s2").and_then(|value| value.number(&quantity::GRAVITY));
    Some(Load::Gravity { acceleration_m_s2: acceleration? })
}

fn read_force(table: &Table<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<Load> {
    let at = table.required("at").and_then(|value| names.point(&value));
    let amplitude = table.required("amplitude_n").and_then(|value| value.number(&quantity::LOAD_FORCE));
    let (order, phase) = read_harmonic(table, 0);
    if excitation == Some(&Excitation::None) && order.is_some_and(|order| order > 0) {
        let message = "`order` is a multiple of the excitation frequency, and there is no [excitation]";
        table.problem("order", message.into(), vec!["allowed: 0, a constant force".into()]);
    }
    Some(Load::Force { at: at?, amplitude_n: amplitude?, order: order?, phase_rad: phase? })
}

fn read_support_motion(table: &Table<'_>, excitation: Option<&Excitation>) -> Option<Load> {
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
    let amplitude =
        table.required("amplitude_m").and_then(|value| value.number(&quantity::LOAD_DISPLACEMENT));
    let (order, phase) = read_harmonic(table, 1);
    Some(Load::SupportMotion { support: support?, amplitude_m: amplitude?, order: order?, phase_rad: phase? })
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
fn read_harmonic(table: &Table<'_>, lowest_order: u32) -> (Option<u32>, Option<f64>) {
    let order = table.required("order").and_then(|value| value.whole(lowest_order, 1000));
    let Some(phase) = table.optional("phase_rad") else { return (order, Some(0.0)) };
    if order == Some(0) {
        phase.problem(
            "`phase_rad` is given for a constant".into(),
            vec!["allowed: only with `order` >= 1".into()],
        );
    }
    (order, phase.number(&quantity::PHASE))
}
