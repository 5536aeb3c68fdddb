//! Excitation and loads of a study as harmonics over the modes.

use hammerbeam_motion::{AmplitudeCurve, Harmonic, HarmonicForce, Load, SupportHarmonic};
use hammerbeam_structure::ReducedModel;

use crate::file::{
    self, Amplitude, ExcitationKind, HarmonicExcitation, MovingSupport, Study, StudyError, StudyFile,
};

/// Refuses forces on points that cannot move.
pub(super) fn check(file: &StudyFile, model: &ReducedModel) -> Result<(), StudyError> {
    let of_excitation = file.study.excitation.force_point().map(|at| ("excitation.at".to_owned(), at));
    let of_loads = file.study.loads.iter().enumerate().filter_map(|(index, load)| match load {
        file::Load::Force { at, .. } => Some((format!("load[{index}].at"), at.as_str())),
        _ => None,
    });
    for (key, at) in of_excitation.into_iter().chain(of_loads) {
        if shape(model, at).iter().all(|entry| *entry == 0.0) {
            let message = format!("a force at \"{at}\" does nothing: its motion is prescribed or held");
            return Err(file.fault(&key, message, vec!["allowed: a point that can move".into()]));
        }
    }
    Ok(())
}

/// All that drives the structure with amplitudes that the frequency does not change.
pub(super) fn load(study: &Study, model: &ReducedModel) -> Load {
    // Supports that move differently have their amplitudes of their own.
    let constant = |harmonic: &HarmonicExcitation| {
        let amplitude = harmonic.amplitude().map_or(Some(1.0), Amplitude::constant);
        amplitude.map(|amplitude| excitation(harmonic, model, amplitude))
    };
    let mut load = study.excitation.harmonic().and_then(constant).unwrap_or_default();
    for further in &study.loads {
        add(&mut load, further, model);
    }
    load
}

/// The excitation at amplitude 1 and its amplitude, where that is a table over the frequency.
pub(super) fn over_frequency(study: &Study, model: &ReducedModel) -> Option<(Load, AmplitudeCurve)> {
    let harmonic = study.excitation.harmonic()?;
    let curve = harmonic.amplitude()?.curve()?;
    Some((excitation(harmonic, model, 1.0), curve))
}

/// The motions of supports that move differently, each times a factor.
fn each_in_its_way(supports: &[MovingSupport], order: u32, factor: f64) -> Load {
    let motion = |(support, of): (usize, &MovingSupport)| {
        let harmonic = Harmonic { order, amplitude: factor * of.amplitude_m, phase: of.phase_rad };
        SupportHarmonic { support, harmonic }
    };
    Load { support: supports.iter().enumerate().map(motion).collect(), forces: Vec::new() }
}

fn excitation(excitation: &HarmonicExcitation, model: &ReducedModel, amplitude: f64) -> Load {
    let harmonic = Harmonic { order: excitation.order, amplitude, phase: excitation.phase_rad };
    match &excitation.kind {
        ExcitationKind::SupportMotion { .. } => Load { support: vec![harmonic.into()], forces: Vec::new() },
        ExcitationKind::SupportMotions { supports } => each_in_its_way(supports, excitation.order, amplitude),
        ExcitationKind::Force { at, .. } => {
            let force = HarmonicForce { shape: shape(model, at), harmonic };
            Load { support: Vec::new(), forces: vec![force] }
        }
    }
}

fn add(load: &mut Load, further: &file::Load, model: &ReducedModel) {
    match further {
        file::Load::Gravity { acceleration_m_s2 } => load.forces.push(HarmonicForce {
            shape: model.uniform_acceleration.clone(),
            harmonic: Harmonic { order: 0, amplitude: *acceleration_m_s2, phase: 0.0 },
        }),
        file::Load::Force { at, amplitude_n, order, phase_rad } => load.forces.push(HarmonicForce {
            shape: shape(model, at),
            harmonic: Harmonic { order: *order, amplitude: *amplitude_n, phase: *phase_rad },
        }),
        file::Load::SupportMotion { support, amplitude_m, order, phase_rad } => {
            let harmonic = Harmonic { order: *order, amplitude: *amplitude_m, phase: *phase_rad };
            load.support.push(SupportHarmonic { support: *support, harmonic });
        }
    }
}

fn shape(model: &ReducedModel, name: &str) -> Vec<f64> {
    model.point(name).expect("the study knows the names of its structure").shape.clone()
}

/// Modal displacements under the constant part of the load, `q_i = b_i / w_i^2`.
///
/// # Errors
/// The number of the first mode that a constant load drives and nothing restrains.
pub(super) fn rest(load: &Load, model: &ReducedModel) -> Result<Vec<f64>, usize> {
    let constant = load.forces.iter().filter(|force| force.harmonic.order == 0);
    let mut rest = vec![0.0; model.dof()];
    for force in constant {
        let amplitude = force.harmonic.amplitude * force.harmonic.phase.cos();
        rest.iter_mut().zip(&force.shape).for_each(|(sum, shape)| *sum += amplitude * shape);
    }
    for (mode, (value, w)) in rest.iter_mut().zip(&model.natural_frequencies).enumerate() {
        match (*value, *w) {
            (0.0, _) => {}
            (_, 0.0) => return Err(mode),
            _ => *value /= w * w,
        }
    }
    Ok(rest)
}

/// Refuses gravity on a structure that does not know which way is down.
///
/// # Errors
/// The fault at the load.
pub(super) fn check_direction(file: &StudyFile) -> Result<(), StudyError> {
    let file::Structure::Matrices(matrices) = &file.study.structure else { return Ok(()) };
    let gravity = file.study.loads.iter().position(|load| matches!(load, file::Load::Gravity { .. }));
    match (gravity, matrices.acceleration_direction) {
        (Some(load), None) => {
            let help = "allowed: with `acceleration_direction = \"-z\"`, say, in [structure]".to_owned();
            let message = "the structure is given as matrices, and no direction of gravity".to_owned();
            Err(file.fault(&format!("load[{load}]"), message, vec![help]))
        }
        _ => Ok(()),
    }
}
