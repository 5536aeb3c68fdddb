//! The modes that those of a study with another number are held against.
//!
//! The state of a motion is that of the modes, which change with the number. They do so smoothly as long as
//! they keep their order and the mesh its shares; their signs, which a point of the structure decides, are
//! those of the modes of the study as it is.

use hammerbeam_structure::{OutlinePoint, Reduced};

use crate::file::{ParameterKind, StructureTable, Study};

/// Nodes as near as this, in lengths of the beam, are one.
const SAME_PLACE: f64 = 1e-9;

/// What the modes of all members are held against: those of the study as it is.
#[derive(Debug)]
pub(super) struct Reference {
    modes: usize,
    outline: Vec<OutlinePoint>,
    nodes: Vec<usize>,
}

impl Reference {
    pub fn new(study: &Study, reduced: &Reduced) -> Self {
        let nodes = nodes_before_points(study, &reduced.outline);
        Self { modes: reduced.model.dof(), outline: reduced.outline.clone(), nodes }
    }
}

/// Numbers of nodes before the points of a beam and the borders of its spans: where they change, the mesh
/// does, and the modes jump.
pub(super) fn nodes_before_points(study: &Study, outline: &[OutlinePoint]) -> Vec<usize> {
    let StructureTable::Beam(beam) = &study.structure else { return Vec::new() };
    let before = |at: f64| outline.iter().filter(|node| node.at < at - SAME_PLACE * beam.length_m).count();
    beam.points.iter().map(|point| point.at_m).chain(beam.borders_m()).map(before).collect()
}

/// The numbers that vary in a study, each once, with the widths of their ranges.
pub(super) fn varied_numbers(study: &Study) -> Vec<(String, f64)> {
    let mut found: Vec<(String, f64)> = Vec::new();
    for (_, parameter) in study.varied().filter(|(_, parameter)| parameter.kind == ParameterKind::Number) {
        if !found.iter().any(|(key, _)| *key == parameter.name) {
            found.push((parameter.name.clone(), parameter.range[1] - parameter.range[0]));
        }
    }
    found
}

/// Gives the modes the signs of those of a reference.
///
/// # Errors
/// There are more or fewer of them, or the mesh is another, in words.
pub(super) fn turn_like(reduced: &mut Reduced, study: &Study, reference: &Reference) -> Result<(), String> {
    let model = &mut reduced.model;
    if model.dof() != reference.modes {
        return Err(format!("there are {} modes instead of {}", model.dof(), reference.modes));
    }
    if nodes_before_points(study, &reduced.outline) != reference.nodes {
        return Err(
            "the finite elements are shared out to other stretches of the beam, so the modes jump".into()
        );
    }
    let turns = |mode: usize| {
        let points = reduced.outline.iter().zip(&reference.outline);
        points.map(|(new, old)| new.shape[mode] * old.shape[mode]).sum::<f64>() < 0.0
    };
    let turned: Vec<usize> = (0..model.dof()).filter(|mode| turns(*mode)).collect();
    for mode in turned {
        model.points.iter_mut().for_each(|point| point.shape[mode] *= -1.0);
        model.uniform_acceleration[mode] *= -1.0;
        for support in &mut model.supports {
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
