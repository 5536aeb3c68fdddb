//! The name of a parameter of the study, and its range: `parameter` and `range` of `[[vary]]` and
//! `[[curve]]`.

use hammerbeam_motion::{
    LawConstant,
    law::{DESCRIPTIONS, LawKey},
};
use serde::Serialize;

use crate::{
    document::{Quantity, TomlTable, Value, quantity, unit::without_unit},
    number::{number_named, numbers, written_paths},
};

use super::{
    DampingKey, DampingTable, Excitation, ExcitationKind, GapMeasured, LoadTable, ModalRatio, ParameterKind,
    Stop, StopEntry, StopLaw, StructureTable,
};

/// A parameter of the study and the range in which it varies.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariedParameter {
    /// Its name, as the study writes it.
    pub name: String,
    /// What it is.
    pub kind: ParameterKind,
    /// Its range, in the unit of the name.
    pub range: [f64; 2],
}

/// What of a study can vary. Tables that could not be read are `None`: names in them are not judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variable<'a> {
    /// The text of the file.
    pub text: &'a str,
    pub structure: Option<&'a StructureTable>,
    pub excitation: Option<&'a Excitation>,
    pub damping: Option<&'a DampingTable>,
    pub loads: Option<&'a [LoadTable]>,
    pub stops: Option<&'a [Stop]>,
}

/// A name with what it means and which values it can have.
type Known = (String, ParameterKind, Quantity);

impl Variable<'_> {
    /// Every parameter by its name; stops also by their number, from 1, which of two sides stands for both.
    fn known(self) -> Vec<Known> {
        let harmonic = self.excitation.and_then(Excitation::harmonic);
        let amplitude = harmonic.and_then(|harmonic| match harmonic.kind {
            ExcitationKind::SupportMotion { .. } => Some(("excitation.amplitude_m", quantity::AMPLITUDE)),
            ExcitationKind::SupportAcceleration { .. } => {
                Some(("excitation.amplitude_m_s2", quantity::ACCELERATION))
            }
            // Each has a number of its own, as any other of the model.
            ExcitationKind::SupportMotions { .. } | ExcitationKind::Forces { .. } => None,
            ExcitationKind::Force { .. } => Some(("excitation.amplitude_n", quantity::FORCE)),
        });
        let of_amplitude =
            |(key, quantity): (&str, Quantity)| (key.to_owned(), ParameterKind::Amplitude, quantity);
        let mut known: Vec<Known> = amplitude.map(of_amplitude).into_iter().collect();
        known.extend(self.damping.into_iter().flat_map(of_damping));
        known.extend(self.structure.into_iter().flat_map(of_dampers));
        let stops = self.stops.unwrap_or_default();
        for (number, stop) in stops.iter().enumerate() {
            let numbered = format!("{}", stop.entry.number() + 1);
            let mut named = |names: &[&str], both_sides: bool| {
                let other = both_sides.then(|| &stops[number + 1].law);
                for (key, kind, quantity) in of_stop(number, &stop.law, other) {
                    known.extend(names.iter().map(|name| (format!("stop.{name}.{key}"), kind, quantity)));
                }
            };
            match (stop.entry, stop.name_of_both_sides()) {
                (StopEntry::Whole(_), _) => named(&[&stop.name, &numbered], false),
                (StopEntry::OneSide(_), Some(name)) => {
                    named(&[&stop.name], false);
                    named(&[name, &numbered], true);
                }
                (StopEntry::OneSide(_), None) => named(&[&stop.name], false),
            }
        }
        known
    }

    fn has_further_harmonics(self) -> bool {
        self.loads.unwrap_or_default().iter().any(|load| load.order() > 0)
    }

    /// Whether a name may mean something that is not known because the table that it begins with has faults:
    /// what is written there, or a key that an element that is there may have.
    fn may_mean(self, name: &str) -> bool {
        let Some((element, key)) = name.rsplit_once('.') else { return false };
        let written = written_paths(self.text);
        let is_written = |path: &str| written.iter().any(|known| known == path);
        let of_law = || DESCRIPTIONS.iter().any(|law| law.keys.iter().any(|of| of.name == key));
        let (is_faulty, may_have) = match name.split('.').next() {
            Some("structure") => {
                let of_point = ["damper_n_s_m", "rotational_damper_n_m_s_rad"].contains(&key);
                (self.structure.is_none(), of_point && is_written(element))
            }
            Some("excitation") => (self.excitation.is_none(), key.starts_with("amplitude_")),
            Some("damping") => {
                let of_damping = ["modal_ratio", "mass_per_s", "stiffness_s"].contains(&key);
                (self.damping.is_none(), of_damping)
            }
            Some("load") => (self.loads.is_none(), false),
            Some("stop") => {
                let of_stop = element != "stop" && is_written(element);
                (self.stops.is_none(), of_stop && (key == "gap_m" || of_law()))
            }
            _ => return false,
        };
        let with_unit = || without_unit(name).is_some_and(|(stem, _)| is_written(stem));
        is_faulty && (may_have || is_written(name) || with_unit())
    }
}

fn of_damping(damping: &DampingTable) -> Vec<Known> {
    let of = |name: &str, key, quantity| (format!("damping.{name}"), ParameterKind::Damping(key), quantity);
    match damping {
        DampingTable::Modal(ModalRatio::Every(_)) => {
            vec![("damping.modal_ratio".to_owned(), ParameterKind::ModalRatio, quantity::DAMPING_RATIO)]
        }
        DampingTable::Modal(ModalRatio::Each(ratios)) => {
            let of_mode = |mode: usize| {
                let name = format!("modal_ratio.{}", mode + 1);
                of(&name, DampingKey::ModalRatio { mode }, quantity::DAMPING_RATIO)
            };
            (0..ratios.len()).map(of_mode).collect()
        }
        DampingTable::Rayleigh { .. } => vec![
            of("rayleigh.mass_per_s", DampingKey::RayleighMass, quantity::RAYLEIGH_MASS),
            of("rayleigh.stiffness_s", DampingKey::RayleighStiffness, quantity::RAYLEIGH_STIFFNESS),
        ],
    }
}

fn of_dampers(structure: &StructureTable) -> Vec<Known> {
    let of =
        |name: String, key, quantity| (format!("structure.{name}"), ParameterKind::Damping(key), quantity);
    match structure {
        StructureTable::Lumped(lumped) => {
            let of_damper = |damper: usize| {
                let name = format!("damper.{}.damping_n_s_m", damper + 1);
                of(name, DampingKey::Damper { damper }, quantity::DAMPER)
            };
            (0..lumped.dampers.len()).map(of_damper).collect()
        }
        StructureTable::Beam(beam) => {
            let of_point = |(point, given): (usize, &super::BeamPointTable)| {
                let name = |key: &str| format!("point.{}.{key}", given.name);
                [
                    of(name("damper_n_s_m"), DampingKey::PointDamper { point }, quantity::DAMPER),
                    of(
                        name("rotational_damper_n_m_s_rad"),
                        DampingKey::RotationalDamper { point },
                        quantity::ROTATIONAL_DAMPER,
                    ),
                ]
            };
            beam.points.iter().enumerate().flat_map(of_point).collect()
        }
        StructureTable::Matrices(_) => Vec::new(),
    }
}

/// What the description of a law lets vary, and its gap. What else its keys say (the terms of a spring but
/// the cubic one, the constants of a formula) are numbers of the model as any other. So is a gap of both
/// sides that counts from where the structure rests: the levels of the sides differ. And what else sides have
/// in common that press, which keep their preload.
///
/// * `other`: the law of the other side, if what both sides have in common is asked for.
fn of_stop(
    stop: usize,
    law: &StopLaw,
    other: Option<&StopLaw>,
) -> Vec<(&'static str, ParameterKind, Quantity)> {
    let kind = |constant| ParameterKind::OfStop { stop, both_sides: other.is_some(), constant };
    let of = |key: &'static LawKey, value| Some((key.name, kind(key.constant(value)?), key.quantity()?));
    if other.is_some_and(|other| other.gap_m().is_none()) {
        return Vec::new();
    }
    let is_shared =
        |other: &StopLaw| other.gap_m() == law.gap_m() && law.gap_measured() == GapMeasured::Undeformed;
    let gap = law.gap_m().filter(|_| other.is_none_or(is_shared));
    let gap = gap.map(|_| ("gap_m", kind(LawConstant::Gap), quantity::GAP));
    law.keys().filter_map(|(key, value)| of(key, value)).chain(gap).collect()
}

/// Reads `parameter` and `range`; the range in any case, so that all faults of both are reported at once.
pub(super) fn read(table: &TomlTable<'_>, study: Variable<'_>) -> Option<VariedParameter> {
    let name = table.required("parameter");
    let range = table.required("range");
    let meant = name.as_ref().and_then(|name| Some((name, meaning(name, name.text()?, study)?)));
    let Some((name, (kind, quantity))) = meant else {
        read_range(&range?, &quantity::ANY)?;
        return None;
    };
    let (text, range) = (name.text()?, range?);
    if kind == ParameterKind::Amplitude && study.has_further_harmonics() {
        let help = vec!["allowed: only where the excitation is the only harmonic load".into()];
        name.problem(format!("`parameter` is \"{text}\", but further loads are harmonic"), help);
        return None;
    }
    let range = read_range(&range, &quantity)?;
    Some(VariedParameter { name: text.to_owned(), kind, range })
}

/// What a name means and which values it can have; reported if that is nothing, or more than one thing. Names
/// in a table that is faulty itself are not judged.
fn meaning(name: &Value<'_>, text: &str, study: Variable<'_>) -> Option<(ParameterKind, Quantity)> {
    let known = study.known();
    let mut kinds: Vec<(ParameterKind, Quantity)> = Vec::new();
    for (_, kind, quantity) in known.iter().filter(|(known, ..)| known == text) {
        if !kinds.iter().any(|(other, _)| other == kind) {
            kinds.push((*kind, *quantity));
        }
    }
    let number = number_named(study.text, text);
    let several = kinds.len().max(number.as_ref().err().copied().unwrap_or(0));
    if several > 1 {
        let help = vec![
            "allowed: a path that names one number; the name of an element may not be the number of another"
                .into(),
        ];
        name.problem(format!("`parameter` is \"{text}\", which names {several} numbers of this study"), help);
        return None;
    }
    let of_model = matches!(number, Ok(Some(_))).then_some((ParameterKind::Number, quantity::ANY));
    let found = kinds.pop().or(of_model);
    if found.is_none() && !study.may_mean(text) {
        let others = numbers(study.text).into_iter().map(|mut number| number.keys.swap_remove(0));
        let mut names: Vec<String> = known.into_iter().map(|(name, ..)| name).collect();
        for other in others {
            if !names.contains(&other) {
                names.push(other);
            }
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        name.unknown_word(text, "a parameter of this study", &names);
    }
    found
}

fn read_range(value: &Value<'_>, quantity: &Quantity) -> Option<[f64; 2]> {
    let range = value.numbers::<2>(quantity)?;
    if range[0] >= range[1] {
        let what = if range[0] == range[1] { "empty" } else { "reversed" };
        let help = vec!["allowed: [low, high] with low < high".into()];
        value.problem(format!("`range` is [{}, {}], which is {what}", range[0], range[1]), help);
        return None;
    }
    if range[0] < 0.0 && range[1] > 0.0 {
        let help = vec!["allowed: a range on one side of zero".into()];
        value.problem(format!("`range` is [{}, {}], which holds zero", range[0], range[1]), help);
        return None;
    }
    Some(range)
}
