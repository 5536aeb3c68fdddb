//! Modes without damping that show only while stops are closed.
//!
//! While an element with the shape s presses, its stiff contact holds `s . q` next to constant. In the limit
//! of a rigid contact the structure moves in the null space of the shapes, `q = N y` with orthonormal columns
//! of N, and its modes there are those of `N^T K N`, with the damping `N^T C N`. A damper between the teeth
//! of a gear pair damps every mode of the open pair, but not the motion of both gears together, on the weak
//! spring that holds them. As long as the teeth are closed it has a damping ratio like the square of the
//! ratio of the stiffnesses, and multipliers that rounding cannot keep apart from the unit circle.
//!
//! Each element is closed alone, and all together. `undamped.rs` finds what is undamped with all elements
//! open.

use std::f64::consts::TAU;

use faer::{Mat, Side};
use hammerbeam_motion::System;

use super::{
    drift::complement,
    undamped::{Digits, has_damping_force, least_loss, undamped_modes},
};

/// A mode has the frequency of another one within this part of it.
const SAME: f64 = 1e-6;
/// Entries below this part of the largest are rounding.
const ROUNDING: f64 = 1e-9;

/// A mode that nothing damps while stops are closed.
#[derive(Debug, Clone, PartialEq)]
pub struct UndampedInContact {
    /// The stops, by their names.
    pub stops: Vec<String>,
    /// Eigenfrequency with rigid contacts [Hz].
    pub frequency_hz: f64,
    /// Displacement of the points that it moves, by their names; the largest is 1.
    pub motion: Vec<(String, f64)>,
}

impl std::fmt::Display for UndampedInContact {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names: Vec<String> = self.stops.iter().map(|name| format!("\"{name}\"")).collect();
        let shown = self.motion.iter().take(4).map(|(name, size)| format!("{name} {size:.3}"));
        let more = if self.motion.len() > 4 { ", ..." } else { "" };
        write!(
            f,
            "with {} closed, the motion ({}{more}) at {} Hz has next to no damping",
            names.join(", "),
            shown.collect::<Vec<_>>().join(", "),
            Digits(self.frequency_hz)
        )
    }
}

/// The modes that vibrate and that nothing damps while each stop alone, or all of them, are closed; none
/// where nothing damps the open structure either.
///
/// * `highest_hz`: of the excitation.
pub(super) fn undamped_in_contact(system: &System, highest_hz: f64) -> Vec<UndampedInContact> {
    let excitation_rate = TAU * highest_hz;
    let opening: Vec<usize> = system
        .elements()
        .iter()
        .enumerate()
        .filter(|(_, element)| !element.law.contacts().is_empty())
        .map(|(index, _)| index)
        .collect();
    let mut closed: Vec<Vec<usize>> = opening.iter().map(|&index| vec![index]).collect();
    if opening.len() > 1 {
        closed.push(opening);
    }
    let undamped = undamped_modes(system, excitation_rate);
    // Where nothing damps any mode, that says it all: every stop would name every mode once more.
    if undamped.len() == system.dof() || every_motion_is_damped(system, excitation_rate) {
        return Vec::new();
    }
    let mut known: Vec<f64> = undamped.iter().map(|mode| mode.frequency_hz).collect();
    let mut found = Vec::new();
    for elements in closed {
        for mode in undamped_while_closed(system, &elements, excitation_rate) {
            if known.iter().all(|hz| (hz / mode.frequency_hz - 1.0).abs() > SAME) {
                known.push(mode.frequency_hz);
                found.push(mode);
            }
        }
    }
    found
}

/// Whether the smallest eigenvalue of C alone damps any motion enough, at any frequency up to the highest: no
/// N makes it smaller, as its columns are orthonormal. One eigenvalue problem takes the place of one for each
/// stop.
fn every_motion_is_damped(system: &System, excitation_rate: f64) -> bool {
    let (model, n) = (system.model(), system.dof());
    let symmetric = |i, j| 0.5 * (model.damping[(i, j)] + model.damping[(j, i)]);
    let highest = model.natural_frequencies.iter().copied().fold(0.0, f64::max);
    let losses = Mat::from_fn(n, n, symmetric).self_adjoint_eigenvalues(Side::Lower);
    losses
        .is_ok_and(|losses| losses.first().is_some_and(|least| *least > least_loss(highest, excitation_rate)))
}

fn undamped_while_closed(
    system: &System,
    elements: &[usize],
    excitation_rate: f64,
) -> Vec<UndampedInContact> {
    let model = system.model();
    let n = system.dof();
    let shapes = elements.iter().map(|&index| system.elements()[index].shape.as_slice());
    let shapes: Vec<Vec<f64>> = shapes.map(<[f64]>::to_vec).collect();
    let free = complement(n, &shapes).1;
    if free.is_empty() {
        return Vec::new();
    }
    let rates = &model.natural_frequencies;
    let stiffness = projected(&free, |i, shape| rates[i] * rates[i] * shape[i]);
    let damping = projected(&free, |i, shape| (0..n).map(|j| model.damping[(i, j)] * shape[j]).sum());
    let Ok(modes) = stiffness.self_adjoint_eigen(Side::Lower) else { return Vec::new() };
    let highest = rates.iter().copied().fold(0.0, f64::max);
    let mut found = Vec::new();
    for k in 0..free.len() {
        let rate = modes.S()[k].max(0.0).sqrt();
        let shape: Vec<f64> = (0..free.len()).map(|i| modes.U()[(i, k)]).collect();
        let loss: f64 = (0..shape.len())
            .map(|i| shape[i] * (0..shape.len()).map(|j| damping[(i, j)] * shape[j]).sum::<f64>())
            .sum();
        if rate <= ROUNDING * highest || loss >= least_loss(rate, excitation_rate) {
            continue;
        }
        let modal: Vec<f64> =
            (0..n).map(|i| free.iter().zip(&shape).map(|(row, y)| row[i] * y).sum()).collect();
        if has_damping_force(system, &modal) {
            continue;
        }
        found.push(UndampedInContact {
            stops: elements.iter().map(|&index| system.elements()[index].name.clone()).collect(),
            frequency_hz: rate / TAU,
            motion: points_in(system, &modal),
        });
    }
    found
}

/// How the named points move in a combination of the modes.
fn points_in(system: &System, modal: &[f64]) -> Vec<(String, f64)> {
    let points = system.model().points.iter();
    let of = |shape: &[f64]| shape.iter().zip(modal).map(|(a, b)| a * b).sum::<f64>();
    let moved: Vec<(String, f64)> = points.map(|point| (point.name.clone(), of(&point.shape))).collect();
    let largest =
        moved.iter().map(|(_, size)| *size).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    let scaled = moved.into_iter().map(|(name, size)| (name, size / largest));
    scaled.filter(|(_, size)| size.abs() > ROUNDING).collect()
}

/// `N^T A N` for the rows of `N^T`.
///
/// * `product`: entry `i` of A times a shape.
fn projected(rows: &[Vec<f64>], product: impl Fn(usize, &[f64]) -> f64) -> Mat<f64> {
    let products: Vec<Vec<f64>> =
        rows.iter().map(|shape| (0..shape.len()).map(|i| product(i, shape)).collect()).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
    Mat::from_fn(rows.len(), rows.len(), |i, j| dot(&rows[i], &products[j]))
}
