//! Parameters of the study as parameters of the equations of motion.

use hammerbeam_motion::{Family, LawConstant, Member, Parameter, System};
use hammerbeam_orbit::Response;

use super::{Model, damping};
use crate::file::{
    Amplitude, DampingTable, HarmonicExcitation, ModalRatio, ParameterKind, Study, VariedParameter,
};

/// A parameter of the system whose value in the study is `factor value + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyParameter {
    /// The parameter of the system.
    pub parameter: Parameter,
    factor: f64,
    offset: f64,
}

impl StudyParameter {
    /// Value in the study of a value of the system.
    #[must_use]
    pub fn in_study(&self, value: f64) -> f64 {
        self.factor * value + self.offset
    }

    /// The same, where an end of a range, which has been to the system and back, is that end to the last bit.
    #[must_use]
    pub fn in_range(&self, value: f64, range: [f64; 2]) -> f64 {
        let end = range.into_iter().find(|end| self.in_system(*end) == value);
        end.unwrap_or_else(|| self.in_study(value))
    }

    /// Change in the study for a change of the system's value.
    #[must_use]
    pub fn change_in_study(&self, change: f64) -> f64 {
        self.factor * change
    }

    /// Value of the system of a value in the study.
    #[must_use]
    pub fn in_system(&self, value: f64) -> f64 {
        (value - self.offset) / self.factor
    }
}

impl Model {
    /// The parameter of the system that a study's parameter is.
    ///
    /// # Errors
    /// Why the system does not have it, in words.
    pub fn parameter(&self, study: &Study, varied: &VariedParameter) -> Result<StudyParameter, String> {
        let plain = |parameter| StudyParameter { parameter, factor: 1.0, offset: 0.0 };
        match varied.kind {
            ParameterKind::Amplitude => {
                let amplitude = study.excitation.harmonic().and_then(HarmonicExcitation::amplitude);
                let Some(factor) = amplitude.and_then(Amplitude::constant) else {
                    return Err(format!("{} is a table over the frequency", varied.name));
                };
                Ok(StudyParameter { factor, ..plain(Parameter::ExcitationScale) })
            }
            ParameterKind::ModalRatio => {
                let DampingTable::Modal(ModalRatio::Every(offset)) = study.damping else {
                    return Err(format!("{} is not the same for every mode", varied.name));
                };
                Ok(StudyParameter { offset, ..plain(Parameter::ADDED_DAMPING_RATIO) })
            }
            ParameterKind::Damping(key) => {
                let place = self.damping_keys.iter().position(|other| *other == key);
                let part = 1 + place.expect("parts of all damping that varies are built with the model");
                let offset = damping::value(study, key);
                Ok(StudyParameter { offset, ..plain(Parameter::AddedDamping { part }) })
            }
            ParameterKind::Number => {
                let family = self.number_keys.iter().position(|key| *key == varied.name);
                let family = family.expect("families of all numbers that vary are built with the model");
                Ok(plain(Parameter::OfFamily { family }))
            }
            ParameterKind::OfStop { stop, both_sides, constant } => {
                let element = self.element_of(study, stop)?;
                if both_sides && self.element_of(study, stop + 1)? != element + 1 {
                    return Err(format!("{} is not of two stops side by side", varied.name));
                }
                let plain = plain(Parameter::OfLaw { element, both_sides, constant });
                if constant != LawConstant::Gap {
                    return Ok(plain);
                }
                let is_rigid = self.system.elements()[element].law.rigid().is_some();
                if both_sides && is_rigid && varied.range[0] <= 0.0 {
                    return Err("without a gap on either side of a rigid stop its point cannot move".into());
                }
                // A gap that is measured from the rest position differs from the level of the element by the
                // sag.
                let level = self.system.parameter(plain.parameter).map_err(|error| error.to_string())?;
                let gap = study.stops[stop].law.gap_m().unwrap_or(level);
                Ok(StudyParameter { offset: gap - level, ..plain })
            }
        }
    }

    /// The system with another value of a parameter, and what is observed in its coordinates.
    ///
    /// * `value`: in the unit of the study.
    ///
    /// # Errors
    /// Why there is no such system, in words.
    pub fn with_parameter(&self, varied: &StudyParameter, value: f64) -> Result<(System, Response), String> {
        let value = varied.in_system(value);
        if let Parameter::OfFamily { family } = varied.parameter {
            let Member { system, response } = self.families[family].member(value)?;
            let response = Response { shape: response.0, support_ratios: response.1 };
            return Ok((system, response));
        }
        let system = self.system.clone().with_parameter(varied.parameter, value);
        Ok((system.map_err(|error| error.to_string())?, self.response.clone()))
    }

    fn element_of(&self, study: &Study, stop: usize) -> Result<usize, String> {
        let name = &study.stops[stop].name;
        let place = self.system.elements().iter().position(|element| element.name == *name);
        place.ok_or_else(|| {
            format!("{name} is pressed past one of its sides at rest, so it has no single law")
        })
    }
}
