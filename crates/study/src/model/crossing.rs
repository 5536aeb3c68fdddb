//! Eigenfrequencies that cross over the range of a number.
//!
//! The modes of a study with another number are in the order of their frequencies. Where two frequencies
//! cross, which they do where nothing couples their modes, two modes change places, and states mean another
//! motion behind. Where something couples them they only come near each other and the shapes change over
//! within some distance, smoothly. Two values of the number are held against each other by the modal
//! assurance criterion of the shapes, `(phi . psi)^2 / (phi . phi)(psi . psi)`: each mode is most alike to
//! its own number, or the stretch between the two is halved. What is still not in order over a stretch of
//! rounding is a crossing.

use super::{
    reference::nodes_before_points,
    structure::{interface, reduce},
};
use crate::{StudyFile, changed::model_with, number::Number};

/// A stretch this long, relative to the number, is one value.
const ONE_VALUE: f64 = 1e-9;

/// Two modes that change places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Value of the number.
    pub value: f64,
    /// The modes, from 0.
    pub modes: [usize; 2],
}

/// The crossing found first between the value of the study and the ends of a range; `None` if there is none,
/// or no model beside which there could be one.
pub(super) fn crossing(file: &StudyFile, number: &Number, range: [f64; 2]) -> Option<Crossing> {
    let shapes = |value: f64| shapes(file, number, value);
    let here = shapes(number.value)?;
    range.into_iter().find_map(|end| between(&shapes, (number.value, &here), (end, &shapes(end)?)))
}

/// The modes of one study.
struct Shapes {
    /// Numbers of nodes before the points of a beam: where they differ, the mesh is another and the modes
    /// have jumped.
    nodes: Vec<usize>,
    /// Displacements of the places of the outline in each mode.
    of_modes: Vec<Vec<f64>>,
}

fn shapes(file: &StudyFile, number: &Number, value: f64) -> Option<Shapes> {
    let study = model_with(file, std::slice::from_ref(number), &[value]).ok()?.study;
    let reduced = reduce(&study, &interface(&study)).ok()?;
    let of_mode = |mode: usize| reduced.outline.iter().map(|place| place.shape[mode]).collect();
    let of_modes = (0..reduced.model.dof()).map(of_mode).collect();
    Some(Shapes { nodes: nodes_before_points(&study, &reduced.outline), of_modes })
}

fn between(
    shapes: &impl Fn(f64) -> Option<Shapes>,
    (from, before): (f64, &Shapes),
    (to, after): (f64, &Shapes),
) -> Option<Crossing> {
    let modes = first_out_of_order(before, after)?;
    let value = 0.5 * (from + to);
    if (to - from).abs() <= ONE_VALUE * value.abs() {
        return Some(Crossing { value, modes });
    }
    let middle = shapes(value)?;
    between(shapes, (from, before), (value, &middle))
        .or_else(|| between(shapes, (value, &middle), (to, after)))
}

/// A mode and another one that it is more alike to behind; `None` if there is none, or the shapes are not to
/// be compared.
fn first_out_of_order(before: &Shapes, after: &Shapes) -> Option<[usize; 2]> {
    let places = |shapes: &Shapes| shapes.of_modes.iter().map(Vec::len).collect::<Vec<_>>();
    if before.nodes != after.nodes || places(before) != places(after) {
        return None;
    }
    let most_alike = |shape: &[f64]| {
        let likeness = |other: &&Vec<f64>| likeness(shape, other);
        let best = after.of_modes.iter().enumerate().max_by(|a, b| likeness(&a.1).total_cmp(&likeness(&b.1)));
        best.map(|(mode, _)| mode)
    };
    let mut found =
        before.of_modes.iter().enumerate().filter_map(|(mode, shape)| Some([mode, most_alike(shape)?]));
    found.find(|[mode, other]| mode != other)
}

/// The modal assurance criterion, 0 to 1.
fn likeness(a: &[f64], b: &[f64]) -> f64 {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    product(a, b).powi(2) / (product(a, a) * product(b, b)).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::number_named;

    /// Two masses of 1 kg, on a spring each, and one between them unless it has no stiffness.
    fn masses(coupling: f64) -> StudyFile {
        let between = format!(r#"{{ between = ["a", "b"], stiffness_n_m = {coupling} }},"#);
        let between = if coupling > 0.0 { between } else { String::new() };
        let text = format!(
            r#"title = "Two masses"
structure = {{ kind = "lumped", mass = [
    {{ name = "a", mass_kg = 1.0 }}, {{ name = "b", mass_kg = 1.0 }}
], spring = [
    {{ between = ["a", "ground"], stiffness_n_m = 900.0 }},
    {{ between = ["b", "ground"], stiffness_n_m = 1000.0 }},
    {between}
] }}
damping = {{ modal_ratio = 0.03 }}
excitation = {{ kind = "force", at = "a", amplitude_n = 1.0, frequency_hz = [4.0, 4.2] }}
response = {{ point = "a" }}
stop = [{{ name = "wall", at = "a", law = "linear", side = "above", gap_m = 1e-3, stiffness_n_m = 100.0 }}]
"#
        );
        StudyFile::parse("masses.toml", text).unwrap()
    }

    fn of_first_spring(coupling: f64, range: [f64; 2]) -> Option<Crossing> {
        let file = masses(coupling);
        let number = number_named(&file.text, "structure.spring.1.stiffness_n_m").unwrap().unwrap();
        crossing(&file, &number, range)
    }

    #[test]
    fn uncoupled_masses_cross_where_their_springs_are_equal() {
        let found = of_first_spring(0.0, [500.0, 1300.0]).unwrap();
        assert!((found.value - 1000.0).abs() < 2e-6, "{found:?}");
        assert!(found.modes == [0, 1] || found.modes == [1, 0]);
        assert_eq!(of_first_spring(0.0, [500.0, 999.0]), None);
    }

    /// The shapes change over within some coupling of the place of the crossing.
    #[test]
    fn coupled_masses_come_near_each_other_and_do_not_cross() {
        for coupling in [100.0, 1.0, 1e-3] {
            assert_eq!(of_first_spring(coupling, [500.0, 1300.0]), None, "{coupling}");
        }
    }
}
