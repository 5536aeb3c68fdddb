//! Parts of the damping of the structure that vary: what a unit of each constant adds to the equations of
//! motion.
//!
//! The damping is linear in its constants, and the modes do not depend on it. So the matrix of a part is that
//! of the study in which this constant is one and all others are zero.

use hammerbeam_motion::DampingPart;

use super::structure::{ReduceError, reduce};
use crate::file::{DampingKey, DampingTable, ModalRatio, ParameterKind, StructureTable, Study};

/// The constants of the damping that vary in a study, each once, in the order of their first appearance.
pub(super) fn varied_keys(study: &Study) -> Vec<DampingKey> {
    let mut keys = Vec::new();
    for (_, parameter) in study.varied() {
        if let ParameterKind::Damping(key) = parameter.kind
            && !keys.contains(&key)
        {
            keys.push(key);
        }
    }
    keys
}

/// What a unit of a constant adds.
///
/// * `interface`: the points at which forces act, as for the reduction of the study.
pub(super) fn part(study: &Study, key: DampingKey, interface: &[String]) -> Result<DampingPart, ReduceError> {
    let mut alone = study.clone();
    constants(&mut alone, |other, value| *value = if other == key { 1.0 } else { 0.0 });
    let model = reduce(&alone, interface)?.model;
    let supports = model.supports.into_iter().map(|support| support.damping).collect();
    Ok(DampingPart { matrix: model.damping, supports })
}

/// The value that the study gives a constant.
pub(super) fn value(study: &Study, key: DampingKey) -> f64 {
    let (mut study, mut found) = (study.clone(), f64::NAN);
    constants(&mut study, |other, value| {
        if other == key {
            found = *value;
        }
    });
    found
}

/// Shows every constant of the damping of the structure; a ratio that all modes have in common is put to
/// zero.
fn constants(study: &mut Study, mut show: impl FnMut(DampingKey, &mut f64)) {
    match &mut study.damping {
        DampingTable::Modal(ModalRatio::Every(ratio)) => *ratio = 0.0,
        DampingTable::Modal(ModalRatio::Each(ratios)) => {
            for (mode, ratio) in ratios.iter_mut().enumerate() {
                show(DampingKey::ModalRatio { mode }, ratio);
            }
        }
        DampingTable::Rayleigh { mass_per_s, stiffness_s } => {
            show(DampingKey::RayleighMass, mass_per_s);
            show(DampingKey::RayleighStiffness, stiffness_s);
        }
    }
    match &mut study.structure {
        StructureTable::Lumped(lumped) => {
            for (damper, given) in lumped.dampers.iter_mut().enumerate() {
                show(DampingKey::Damper { damper }, &mut given.damping_n_s_m);
            }
        }
        StructureTable::Beam(beam) => {
            for (point, given) in beam.points.iter_mut().enumerate() {
                show(DampingKey::PointDamper { point }, &mut given.damper_n_s_m);
                show(DampingKey::RotationalDamper { point }, &mut given.rotational_damper_n_m_s_rad);
            }
        }
        // The matrix of damping has no constants to vary.
        StructureTable::Matrices(_) => {}
    }
}
