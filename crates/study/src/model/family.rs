//! Other numbers of the study as parameters: the study is built anew with each value, as in an update.
//!
//! The state of a motion is that of the modes, which change with the number. They do so smoothly as long as they keep their order; their signs, which a point of the structure decides, are those of the modes of the
//! study as it is.

use hammerbeam_motion::{Family, Member};
use hammerbeam_structure::ReducedModel;

use super::Model;
use crate::{
    StudyFile,
    file::{ParameterKind, Study},
    number::{Number, numbers, with_numbers},
};

/// The studies that differ in one number.
#[derive(Debug)]
pub(super) struct StudyFamily {
    file: StudyFile,
    number: Number,
    reference: ReducedModel,
}

impl StudyFamily {
    /// The family of a study over the number with that key path; `None` if it has none.
    pub fn new(file: &StudyFile, key: &str, reference: &ReducedModel) -> Option<Self> {
        let named = |number: &Number| number.keys.iter().any(|known| known == key);
        let number = numbers(&file.text).into_iter().find(named)?;
        Some(Self { file: file.clone(), number, reference: reference.clone() })
    }

    /// The value of the study as it is.
    pub fn value(&self) -> f64 {
        self.number.value
    }
}

impl Family for StudyFamily {
    fn member(&self, value: f64) -> Result<Member, String> {
        let of = |error: &dyn std::fmt::Display| format!("with {value}: {error}");
        let mut file = with_numbers(&self.file, std::slice::from_ref(&self.number), &[value])
            .map_err(|error| of(&error))?;
        // Ranges of the study as it is have nothing to say here.
        file.study.varies.clear();
        file.study.curves.clear();
        let model = Model::like(&file, Some(&self.reference)).map_err(|error| of(&error))?;
        let response = (model.response.shape, model.response.support_ratio);
        Ok(Member { system: model.system, response })
    }
}

/// The numbers that vary in a study, each once, with the widths of their ranges.
pub(super) fn varied_numbers(study: &Study) -> Vec<(String, f64)> {
    let of_varies = study.varies.iter().map(|vary| &vary.parameter);
    let of_curves = study.curves.iter().map(|curve| &curve.parameter);
    let mut found: Vec<(String, f64)> = Vec::new();
    for parameter in of_varies.chain(of_curves).filter(|parameter| parameter.kind == ParameterKind::Number) {
        if !found.iter().any(|(key, _)| *key == parameter.name) {
            found.push((parameter.name.clone(), parameter.range[1] - parameter.range[0]));
        }
    }
    found
}

/// Gives the modes the signs of those of a reference.
///
/// # Errors
/// There are more or fewer of them, in words.
pub(super) fn turn_like(model: &mut ReducedModel, reference: &ReducedModel) -> Result<(), String> {
    if model.dof() != reference.dof() {
        return Err(format!("there are {} modes instead of {}", model.dof(), reference.dof()));
    }
    let turns = |mode: usize| {
        let points = model.points.iter().zip(&reference.points);
        let along: f64 = points.map(|(new, old)| new.shape[mode] * old.shape[mode]).sum();
        let acceleration = model.uniform_acceleration[mode] * reference.uniform_acceleration[mode];
        along < 0.0 || (along == 0.0 && acceleration < 0.0)
    };
    let turned: Vec<usize> = (0..model.dof()).filter(|mode| turns(*mode)).collect();
    for mode in turned {
        model.points.iter_mut().for_each(|point| point.shape[mode] *= -1.0);
        model.uniform_acceleration[mode] *= -1.0;
        if let Some(support) = &mut model.support {
            support.inertia[mode] *= -1.0;
            support.damping[mode] *= -1.0;
        }
        for other in (0..model.dof()).filter(|other| *other != mode) {
            model.damping[(mode, other)] *= -1.0;
            model.damping[(other, mode)] *= -1.0;
        }
    }
    Ok(())
}
