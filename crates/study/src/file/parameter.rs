//! The name of a parameter of the study, and its range: `parameter` and `range` of `[[vary]]` and
//! `[[curve]]`.

use serde::Serialize;

use crate::{
    document::{Quantity, Table, Value, quantity},
    number::{number_named, numbers},
};

use super::{
    Approach, Damping, Excitation, ExcitationKind, Load, ModalRatio, Stop, StopEntry, StopLaw, Structure,
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

/// What a parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ParameterKind {
    /// Amplitude of the excitation [m or N].
    Amplitude,
    /// Gap of a stop [m].
    Gap {
        /// Number of the stop, from 0.
        stop: usize,
    },
    /// Constant of the law of a stop.
    Stiffness {
        /// Number of the stop, from 0.
        stop: usize,
    },
    /// Coefficient of restitution of a stop.
    Restitution {
        /// Number of the stop, from 0.
        stop: usize,
    },
    /// Constant of the damping of a stop: of its damper, or the loss of its law.
    StopDamping {
        /// Number of the stop, from 0.
        stop: usize,
    },
    /// Ratio to critical damping of every mode.
    ModalRatio,
    /// A part of the damping of the structure.
    Damping(DampingKey),
    /// Another number of the model, by its key path.
    Number,
}

/// A constant of the damping of the structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingKey {
    /// Ratio to critical damping of a mode.
    ModalRatio {
        /// Number of the mode, from 0.
        mode: usize,
    },
    /// Rayleigh damping in proportion to the mass.
    RayleighMass,
    /// Rayleigh damping in proportion to the stiffness.
    RayleighStiffness,
    /// A damper of a lumped structure.
    Damper {
        /// Its number, from 0.
        damper: usize,
    },
    /// The damper at a point of a beam.
    PointDamper {
        /// Number of the point, from 0.
        point: usize,
    },
    /// The rotational damper at a point of a beam.
    RotationalDamper {
        /// Number of the point, from 0.
        point: usize,
    },
}

/// What of a study can vary. Tables that could not be read are `None`: names in them are not judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variable<'a> {
    /// The text of the file.
    pub text: &'a str,
    pub structure: Option<&'a Structure>,
    pub excitation: Option<&'a Excitation>,
    pub damping: Option<&'a Damping>,
    pub loads: Option<&'a [Load]>,
    pub stops: Option<&'a [Stop]>,
}

/// A name with what it means and which values it can have.
type Known = (String, ParameterKind, Quantity);

impl Variable<'_> {
    /// Every parameter by its name; stops also by their number, from 1. What both sides of a stop have in
    /// common is a number of the model as any other, so a side has no number.
    fn known(self) -> Vec<Known> {
        let harmonic = self.excitation.and_then(Excitation::harmonic);
        let amplitude = harmonic.and_then(|harmonic| match harmonic.kind {
            ExcitationKind::SupportMotion { .. } => Some(("excitation.amplitude_m", quantity::AMPLITUDE)),
            // Each has a number of its own, as any other of the model.
            ExcitationKind::SupportMotions { .. } => None,
            ExcitationKind::Force { .. } => Some(("excitation.amplitude_n", quantity::FORCE)),
        });
        let of_amplitude =
            |(key, quantity): (&str, Quantity)| (key.to_owned(), ParameterKind::Amplitude, quantity);
        let mut known: Vec<Known> = amplitude.map(of_amplitude).into_iter().collect();
        known.extend(self.damping.into_iter().flat_map(of_damping));
        known.extend(self.structure.into_iter().flat_map(of_dampers));
        for (number, stop) in self.stops.unwrap_or_default().iter().enumerate() {
            let mut names = vec![stop.name.clone()];
            if let StopEntry::Whole(entry) = stop.entry {
                names.push(format!("{}", entry + 1));
            }
            for (key, kind, quantity) in of_stop(number, &stop.law) {
                known.extend(names.iter().map(|name| (format!("stop.{name}.{key}"), kind, quantity)));
            }
        }
        known
    }

    fn has_further_harmonics(self) -> bool {
        self.loads.unwrap_or_default().iter().any(|load| match load {
            Load::Gravity { .. } => false,
            Load::Force { order, .. } | Load::SupportMotion { order, .. } => *order > 0,
        })
    }

    /// Whether the table that a name begins with was read, so that all its names are known.
    fn knows_table_of(self, name: &str) -> bool {
        match name.split('.').next() {
            Some("structure") => self.structure.is_some(),
            Some("excitation") => self.excitation.is_some(),
            Some("damping") => self.damping.is_some(),
            Some("load") => self.loads.is_some(),
            Some("stop") => self.stops.is_some(),
            _ => true,
        }
    }
}

fn of_damping(damping: &Damping) -> Vec<Known> {
    let of = |name: &str, key, quantity| (format!("damping.{name}"), ParameterKind::Damping(key), quantity);
    match damping {
        Damping::Modal(ModalRatio::Every(_)) => {
            vec![("damping.modal_ratio".to_owned(), ParameterKind::ModalRatio, quantity::DAMPING_RATIO)]
        }
        Damping::Modal(ModalRatio::Each(ratios)) => {
            let of_mode = |mode: usize| {
                let name = format!("modal_ratio.{}", mode + 1);
                of(&name, DampingKey::ModalRatio { mode }, quantity::DAMPING_RATIO)
            };
            (0..ratios.len()).map(of_mode).collect()
        }
        Damping::Rayleigh { .. } => vec![
            of("rayleigh.mass_per_s", DampingKey::RayleighMass, quantity::RAYLEIGH_MASS),
            of("rayleigh.stiffness_s", DampingKey::RayleighStiffness, quantity::RAYLEIGH_STIFFNESS),
        ],
    }
}

fn of_dampers(structure: &Structure) -> Vec<Known> {
    let of =
        |name: String, key, quantity| (format!("structure.{name}"), ParameterKind::Damping(key), quantity);
    match structure {
        Structure::Lumped(lumped) => {
            let of_damper = |damper: usize| {
                let name = format!("damper.{}.damping_n_s_m", damper + 1);
                of(name, DampingKey::Damper { damper }, quantity::DAMPER)
            };
            (0..lumped.dampers.len()).map(of_damper).collect()
        }
        Structure::Beam(beam) => {
            let of_point = |(point, given): (usize, &super::BeamPoint)| {
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
        Structure::Matrices(_) => Vec::new(),
    }
}

fn of_stop(stop: usize, law: &StopLaw) -> Vec<(&'static str, ParameterKind, Quantity)> {
    let (gap, stiffness) = (ParameterKind::Gap { stop }, ParameterKind::Stiffness { stop });
    let gap_of = |approach: &Approach| matches!(approach, Approach::Gap { .. });
    let (key, quantity, has_gap) = match law {
        StopLaw::Hertz { approach, .. }
        | StopLaw::HuntCrossley { approach, .. }
        | StopLaw::Restitution { approach, .. } => {
            ("stiffness_n_m15", quantity::HERTZ_STIFFNESS, gap_of(approach))
        }
        StopLaw::Linear { approach, .. } => ("stiffness_n_m", quantity::STIFFNESS, gap_of(approach)),
        StopLaw::TwoSided { gap_above_m, gap_below_m, .. } => {
            ("stiffness_n_m", quantity::STIFFNESS, gap_above_m == gap_below_m)
        }
        // Without a cubic term there is none to be varied by its derivative.
        StopLaw::Cubic { stiffness_n_m3: 0.0, .. } => return Vec::new(),
        // The constants of a formula are numbers of the model as any other.
        StopLaw::Formula { .. } => return Vec::new(),
        StopLaw::Cubic { .. } => ("stiffness_n_m3", quantity::CUBIC_STIFFNESS, false),
        StopLaw::Rigid { approach, .. } => ("restitution", quantity::RIGID_RESTITUTION, gap_of(approach)),
    };
    let first = if key == "restitution" { ParameterKind::Restitution { stop } } else { stiffness };
    let mut known = vec![(key, first, quantity)];
    let damping = ParameterKind::StopDamping { stop };
    match law {
        StopLaw::Linear { damping_n_s_m, .. } if *damping_n_s_m > 0.0 => {
            known.push(("damping_n_s_m", damping, quantity::DAMPER));
        }
        StopLaw::HuntCrossley { loss_s_m, .. } if *loss_s_m > 0.0 => {
            known.push(("loss_s_m", damping, quantity::LOSS));
        }
        StopLaw::Restitution { .. } => {
            known.push(("restitution", ParameterKind::Restitution { stop }, quantity::RESTITUTION));
        }
        _ => {}
    }
    if has_gap {
        known.push(("gap_m", gap, quantity::GAP));
    }
    known
}

/// Reads `parameter` and `range`; the range in any case, so that all faults of both are told at once.
pub(super) fn read(table: &Table<'_>, study: Variable<'_>) -> Option<VariedParameter> {
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

/// What a name means and which values it can have; told if that is nothing, or more than one thing. Nothing is
/// told of names in a table that is faulty itself.
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
    if found.is_none() && study.knows_table_of(text) {
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
