//! Exact derivatives of the eigenfrequencies of a beam, where they are known: unreduced, supported or with
//! its moving support let go.

use hammerbeam_structure::{BeamChange, Boundary, PointChange};
use hammerbeam_study::{
    StudyError, StudyFile,
    file::{BeamTable, StructureTable},
    number::Number,
};

use super::data::FrequencyTable;

/// Derivatives of a table of eigenfrequencies [Hz] by a number of the study; `None` where they have to be
/// taken by differences.
///
/// * `file`: the study with the values at which derivatives are wanted.
/// * `value`: that of the number among them.
pub(super) fn eigenfrequency_derivatives(
    file: &StudyFile,
    number: &Number,
    value: f64,
    table: FrequencyTable,
) -> Result<Option<Vec<f64>>, StudyError> {
    let StructureTable::Beam(beam) = &file.study.structure else { return Ok(None) };
    let boundary = match table {
        FrequencyTable::Clamped => Boundary::Supported,
        FrequencyTable::FreeInterface => Boundary::Released,
        FrequencyTable::FixedInterface | FrequencyTable::Reduced => return Ok(None),
    };
    let Some(change) = change(beam, number, value) else { return Ok(None) };
    let moving = file.study.excitation.moving_places();
    let derivatives = beam.uniform_descriptor().and_then(|beam| match beam {
        Some(beam) => beam.eigenfrequency_derivatives(&moving, boundary, &change),
        None => Ok(None),
    });
    derivatives.map_err(|error| file.fault("structure", error.to_string(), Vec::new()))
}

/// What of a beam changes with a number, and how fast; nothing at all if the number is not of the structure.
fn change(beam: &BeamTable, number: &Number, value: f64) -> Option<BeamChange> {
    // The last path has numbers where the others may have names.
    let key = number.keys.last()?;
    let Some(key) = key.strip_prefix("structure.") else { return Some(BeamChange::default()) };
    let none = BeamChange::default();
    let profile = beam.uniform()?.profile;
    let (bending, per_length) = (profile.bending_stiffness(), profile.mass_per_length());
    Some(match key {
        "length_m" => BeamChange { length: 1.0, ..none },
        "youngs_modulus_pa" => BeamChange { bending_stiffness: profile.section.second_moment_m4, ..none },
        "density_kg_m3" => BeamChange { mass_per_length: profile.section.area_m2, ..none },
        "section.area_m2" => BeamChange { mass_per_length: profile.density_kg_m3, ..none },
        "section.second_moment_m4" => BeamChange { bending_stiffness: profile.youngs_modulus_pa, ..none },
        "section.width_m" => {
            BeamChange { bending_stiffness: bending / value, mass_per_length: per_length / value, ..none }
        }
        "section.height_m" => BeamChange {
            bending_stiffness: 3.0 * bending / value,
            mass_per_length: per_length / value,
            ..none
        },
        point => BeamChange { points: point_changes(beam, point)?, ..none },
    })
}

/// Changes of all points with `point.NUMBER.KEY`.
fn point_changes(beam: &BeamTable, key: &str) -> Option<Vec<PointChange>> {
    let (index, key) = key.strip_prefix("point.")?.split_once('.')?;
    let index = index.parse::<usize>().ok()?.checked_sub(1)?;
    let none = PointChange::default();
    let change = match key {
        "at_m" => PointChange { at: 1.0, ..none },
        "mass_kg" => PointChange { mass: 1.0, ..none },
        "rotary_inertia_kg_m2" => PointChange { rotary_inertia: 1.0, ..none },
        "spring_n_m" => PointChange { spring: 1.0, ..none },
        "rotational_spring_n_m_rad" => PointChange { rotational_spring: 1.0, ..none },
        "damper_n_s_m" | "rotational_damper_n_m_s_rad" => none,
        _ => return None,
    };
    let mut changes = vec![none; beam.points.len()];
    *changes.get_mut(index)? = change;
    Some(changes)
}
