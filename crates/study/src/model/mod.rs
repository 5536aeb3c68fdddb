//! From the study to the equations of motion.

mod crossing;
mod damping;
mod drift;
mod element;
mod export;
mod fault;
mod initial;
mod load;
mod outputs;
mod parameter;
mod reference;
mod structure;
mod undamped;
mod undamped_in_contact;

use std::sync::Arc;

use hammerbeam_motion::{Family, Member, Parameter, ParameterError, PointMotion, System};
use hammerbeam_orbit::Response;
use hammerbeam_structure::{MatrixReport, MeshShape, ModeTables, OutlinePoint, ReducedModel};

pub use drift::Drift;
pub use export::matrix_study;
pub use fault::with_structure_fault;
pub use initial::{PointStart, PointStartError, PointStartKind};
pub use outputs::output_signals;
pub use parameter::StudyParameter;
pub use undamped::UndampedMode;
pub use undamped_in_contact::UndampedInContact;

use fault::{reduce_fault, system_fault};
use reference::Reference;
use structure::interface;

use crate::{
    changed::model_with,
    file::{DampingKey, ParameterKind, Study, StudyError, StudyFile, VariedParameter},
    number::{Number, number_named},
};

/// How near to a number a neighbour is, relative to it.
const NEIGHBOUR: f64 = 1e-5;

/// A study made ready for computing.
#[derive(Debug, Clone)]
pub struct Model {
    /// The equations of motion.
    pub system: System,
    /// What is observed.
    pub response: Response,
    /// Eigenfrequencies of all stages.
    pub tables: ModeTables,
    /// The shape of the whole structure.
    pub outline: Vec<OutlinePoint>,
    /// The mesh of a structure of matrices that has lines.
    pub mesh: Option<MeshShape>,
    /// What was found in the matrices of the structure, if it has such.
    pub matrices: Option<MatrixReport>,
    /// Constants of the damping that vary: parts 1, 2, ... of the damping of the system.
    damping_keys: Vec<DampingKey>,
    /// Other numbers that vary: the families of the system.
    number_keys: Vec<String>,
    families: Vec<Arc<StudyFamily>>,
    /// The elements of each stop of the study.
    elements_of_stops: Vec<element::ElementsOfStop>,
}

impl Model {
    /// Assembles, supports and reduces the structure, and puts loads and local elements on it.
    ///
    /// # Errors
    /// [`StudyError::Invalid`]: something of the study does not fit its structure, at the key that is to
    /// blame.
    pub fn build(file: &StudyFile) -> Result<Self, StudyError> {
        Self::like(file, None)
    }

    /// The same with modes of the signs of a reference.
    fn like(file: &StudyFile, reference: Option<&Reference>) -> Result<Self, StudyError> {
        let study = &file.study;
        let interface = interface(study);
        let (mut reduced, matrices) =
            structure::reduce_and_report(study, &interface).map_err(|error| reduce_fault(file, &error))?;
        load::check_direction(file)?;
        if let Some(reference) = reference {
            let fault = |message| file.fault("structure", message, Vec::new());
            reference::turn_like(&mut reduced, study, reference).map_err(fault)?;
        }
        let numbers = reference::varied_numbers(study);
        let reference = (!numbers.is_empty()).then(|| Arc::new(Reference::new(study, &reduced)));
        load::check(file, &reduced.model)?;
        let drive = load::Drive::of(study, &reduced.model);
        let (elements, elements_of_stops) = element::elements(file, &reduced.model, &drive.kept)?;
        let response = response_point(study, &reduced.model);
        let system = drive
            .driven
            .into_iter()
            .fold(System::new(reduced.model, &drive.kept, elements), |system, (load, factor)| {
                system?.with_amplitude_over_frequency(&load, factor)
            });
        let mut system = system.map_err(|error| system_fault(file, &error))?;
        let damping_keys = damping::varied_keys(study);
        for &key in &damping_keys {
            let part = damping::part(study, key, &interface).map_err(|error| reduce_fault(file, &error))?;
            let fault = |error: ParameterError| file.fault("damping", error.to_string(), Vec::new());
            system = system.with_damping_part(part).map_err(fault)?;
        }
        let mut families = Vec::new();
        for ((key, width), reference) in numbers.iter().zip(reference.iter().cycle()) {
            let family = StudyFamily::new(file, key, Arc::clone(reference));
            let family = Arc::new(family.expect("the study file knows its numbers"));
            let value = family.value();
            let size = if value == 0.0 { *width } else { value.abs() };
            system = system.with_family(Arc::clone(&family) as _, value, size);
            families.push(family);
        }
        let (tables, outline, mesh) = (reduced.tables, reduced.outline, reduced.mesh);
        let number_keys = numbers.into_iter().map(|(key, _)| key).collect();
        let model = Self {
            system,
            response,
            tables,
            outline,
            mesh,
            matrices,
            damping_keys,
            number_keys,
            families,
            elements_of_stops,
        };
        model.check_varied(file)?;
        Ok(model)
    }

    /// The model with another point of the structure observed.
    ///
    /// # Returns
    /// `None` if no point has this name; [`Self::point_names`] has those there are.
    #[must_use]
    pub fn observed_at(&self, point: &str) -> Option<Self> {
        let point = self.system.model().point(point)?;
        let response = Response { shape: point.shape.clone(), support_ratios: point.support_ratios.clone() };
        Some(Self { response, ..self.clone() })
    }

    /// Names of the points of the structure.
    #[must_use]
    pub fn point_names(&self) -> Vec<&str> {
        self.system.model().points.iter().map(|point| point.name.as_str()).collect()
    }

    /// How the response point moves at a frequency, read off states and the forces of all local elements
    /// then.
    #[must_use]
    pub fn response_motion(&self, frequency_hz: f64) -> PointMotion {
        PointMotion::of(&self.system, frequency_hz, &self.response.shape, &self.response.support_ratios)
    }

    /// The directions in which the structure can drift; none for one that springs hold.
    #[must_use]
    pub fn drifts(&self) -> Vec<Drift> {
        drift::drifts(&self.system)
    }

    /// The highest excitation frequency at which rounding leaves enough of periodic motion, if the structure
    /// vibrates at all [Hz].
    #[must_use]
    pub fn resolved_hz(&self) -> Option<f64> {
        undamped::resolved_hz(&self.system)
    }

    /// The modes that vibrate (rigid-body modes are not among them) and that nothing damps, lowest first.
    #[must_use]
    pub fn undamped_modes(&self) -> Vec<UndampedMode> {
        undamped::undamped_modes(&self.system, 0.0)
    }

    /// The modes that vibrate and that nothing damps while each stop alone, or all of them, are closed:
    /// nothing that shows in a period of the excitation.
    ///
    /// * `highest_hz`: highest frequency of the excitation.
    #[must_use]
    pub fn undamped_in_contact(&self, highest_hz: f64) -> Vec<UndampedInContact> {
        undamped_in_contact::undamped_in_contact(&self.system, highest_hz)
    }

    /// Refuses parameters that the system does not have, and ranges that leave out the value from which they
    /// are followed.
    fn check_varied(&self, file: &StudyFile) -> Result<(), StudyError> {
        let study = &file.study;
        for (key, varied) in study.varied() {
            let fault = |part: &str, message: String, help: &str| {
                file.fault(&format!("{key}.{part}"), message, vec![help.to_owned()])
            };
            let parameter = self
                .parameter(study, varied)
                .map_err(|message| fault("parameter", message, "allowed: another parameter"))?;
            let value = self.system.parameter(parameter.parameter);
            let value = value.map_err(|error| fault("parameter", error.to_string(), "allowed: another"))?;
            let (value, [low, high]) = (parameter.in_study(value), varied.range);
            if !(low..=high).contains(&value) {
                let message =
                    format!("`range` is [{low}, {high}], but the study has {} = {value}", varied.name);
                return Err(fault("range", message, "allowed: a range that holds the value of the study"));
            }
            self.check_neighbours(parameter.parameter, value).map_err(|message| {
                fault("parameter", message, "allowed: a study that can be changed a little")
            })?;
            if let Some(message) = modes_change_places(file, varied) {
                return Err(fault("range", message, "allowed: a range without it"));
            }
            for end in varied.range {
                let system = self.system.clone();
                system
                    .with_parameter(parameter.parameter, parameter.in_system(end))
                    .map_err(|error| fault("range", error.to_string(), "allowed: a range without it"))?;
            }
        }
        Ok(())
    }

    /// Refuses numbers of which no neighbour makes a model: there would be no direction to follow.
    fn check_neighbours(&self, parameter: Parameter, value: f64) -> Result<(), String> {
        if !matches!(parameter, Parameter::OfFamily { .. }) {
            return Ok(());
        }
        let step = NEIGHBOUR * if value == 0.0 { 1.0 } else { value };
        let beside = |value: f64| self.system.clone().with_parameter(parameter, value);
        match (beside(value - step), beside(value + step)) {
            (Err(error), Err(_)) => Err(format!("no number beside that of the study makes a model: {error}")),
            _ => Ok(()),
        }
    }
}

/// The studies that differ in one number, each of which makes a model.
#[derive(Debug)]
struct StudyFamily {
    file: StudyFile,
    number: Number,
    reference: Arc<Reference>,
}

impl StudyFamily {
    /// The family of a study over the number with that key path; `None` if it has none, or several.
    fn new(file: &StudyFile, key: &str, reference: Arc<Reference>) -> Option<Self> {
        let number = number_named(&file.text, key).ok().flatten()?;
        Some(Self { file: file.clone(), number, reference })
    }

    /// The value of the study as it is.
    fn value(&self) -> f64 {
        self.number.value
    }
}

impl Family for StudyFamily {
    fn member(&self, value: f64) -> Result<Member, String> {
        let built = model_with(&self.file, std::slice::from_ref(&self.number), &[value])
            .and_then(|file| Model::like(&file, Some(&self.reference)));
        let model =
            built.map_err(|error| format!("{} = {value}: {}", self.number.keys[0], in_short(&error)))?;
        let response = (model.response.shape, model.response.support_ratios);
        Ok(Member { system: model.system, response })
    }
}

/// What is wrong, without the text around it.
fn in_short(error: &StudyError) -> String {
    match error {
        StudyError::Invalid(report) => {
            let messages: Vec<&str> =
                report.problems.iter().map(|problem| problem.message.as_str()).collect();
            messages.join("; ")
        }
        other => other.to_string(),
    }
}

/// Where two modes change places over the range of a number, in words.
fn modes_change_places(file: &StudyFile, varied: &VariedParameter) -> Option<String> {
    if varied.kind != ParameterKind::Number {
        return None;
    }
    let number = number_named(&file.text, &varied.name).ok()??;
    let found = crossing::crossing(file, &number, varied.range)?;
    let [one, other] = found.modes.map(|mode| mode + 1);
    Some(format!(
        "the eigenfrequencies of modes {one} and {other} cross at {} = {}: the modes change places there",
        varied.name, found.value
    ))
}

fn response_point(study: &Study, model: &ReducedModel) -> Response {
    let point = model.point(&study.response.point).expect("the study knows the names of its structure");
    Response { shape: point.shape.clone(), support_ratios: point.support_ratios.clone() }
}

#[cfg(test)]
mod tests;
