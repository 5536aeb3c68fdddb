//! What is known of a study before anything is computed of it.

use std::{collections::BTreeMap, f64::consts::TAU};

use hammerbeam_structure::MatrixReport;
use hammerbeam_study::{Drift, Model, Study, UndampedInContact, UndampedMode};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::{JobError, Observer, PreparedStudy, matrix_document::matrix_document, rig::changed_study};

/// What is known of a study.
#[derive(Debug, Clone)]
pub struct CheckReport<'a> {
    /// The study.
    pub study: &'a Study,
    /// Eigenfrequencies of the equations of motion [Hz].
    pub eigenfrequencies_hz: Vec<f64>,
    /// Modes without damping,
    pub undamped_modes: Vec<UndampedMode>,
    /// and those without damping while stops are closed.
    pub undamped_in_contact: Vec<UndampedInContact>,
    /// Directions that nothing holds, or only stops.
    pub drifts: Vec<Drift>,
    /// What was found in the matrices of the structure, if it consists of such.
    pub matrices: Option<&'a MatrixReport>,
}

/// Looks at a study, and whether its rig makes one too; directions that nothing holds, or only stops, are
/// reported as warnings.
///
/// # Errors
/// [`JobError`]: the rig has faults, or the range of the excitation reaches too high.
pub fn check<'a>(study: &'a PreparedStudy, observer: &mut dyn Observer) -> Result<CheckReport<'a>, JobError> {
    let PreparedStudy { file, model } = study;
    if file.study.rig.is_some() {
        Model::build(&changed_study(file)?)?;
    }
    let drifts = model.drifts();
    drifts.iter().for_each(|drift| observer.notice(&format_args!("warning: {drift}")));
    study.warn_of_many_modes(observer);
    study.check_range()?;
    Ok(CheckReport {
        study: &file.study,
        eigenfrequencies_hz: model.system.model().natural_frequencies.iter().map(|w| w / TAU).collect(),
        undamped_modes: model.undamped_modes(),
        undamped_in_contact: model.undamped_in_contact(file.study.excitation.range_hz()[1]),
        drifts,
        matrices: model.matrices.as_ref(),
    })
}

impl Serialize for CheckReport<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let study = self.study;
        let drift = |drift: &Drift| {
            let motion = by_name(&drift.motion);
            json!({ "frequency_hz": 0.0, "motion": motion, "held_by_stops": drift.held_by_stops })
        };
        let document = json!({
            "title": study.title,
            "identity": study.identity(),
            "degrees_of_freedom": self.eigenfrequencies_hz.len(),
            "eigenfrequencies_hz": self.eigenfrequencies_hz,
            "frequency_hz": study.excitation.harmonic().map(|harmonic| harmonic.frequency_hz),
            "undamped_modes": undamped_documents(&self.undamped_modes),
            "undamped_in_contact": in_contact_documents(&self.undamped_in_contact),
            "drifts": self.drifts.iter().map(drift).collect::<Vec<_>>(),
            "stops": study.stops.iter().map(|stop| stop.name.as_str()).collect::<Vec<_>>(),
            "response_point": study.response.point,
            "period_multiples": study.response.period_multiples,
            "matrices": self.matrices.map(matrix_document),
            "study": study,
        });
        document.serialize(serializer)
    }
}

/// Displacements by the names of their points, relative to the largest.
fn by_name(motion: &[(String, f64)]) -> BTreeMap<&str, f64> {
    motion.iter().map(|(name, size)| (name.as_str(), *size)).collect()
}

/// Modes without damping.
pub(crate) fn undamped_documents(modes: &[UndampedMode]) -> Value {
    let one = |mode: &UndampedMode| {
        let (number, hz) = (mode.number, mode.frequency_hz);
        json!({ "mode": number, "frequency_hz": hz, "damping_ratio": mode.ratio })
    };
    modes.iter().map(one).collect()
}

/// Modes without damping while stops are closed.
pub(crate) fn in_contact_documents(modes: &[UndampedInContact]) -> Value {
    let one = |mode: &UndampedInContact| {
        let motion = by_name(&mode.motion);
        json!({ "stops": mode.stops, "frequency_hz": mode.frequency_hz, "motion": motion })
    };
    modes.iter().map(one).collect()
}
