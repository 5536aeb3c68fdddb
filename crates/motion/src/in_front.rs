//! States in front of the contacts in which no motion can begin.
//!
//! A state within a contact whose law remembers its impact does not tell how that contact began, and behind a
//! rigid stop there is no motion at all. Such a state is *reflected* at the stop that it lies behind by the
//! depth `p`: displacements change by `-2 p w/(phi . w)` with `w_i = phi_i/(w_i^2 + W^2)`, so that it comes
//! to lie in front of the stop by as much, and velocities stay. This is how a force at the stop would move
//! the structure that hangs, besides, on springs which make it swing with the excitation: no mode is rigid
//! against it, and the direction is that in which the structure yields most.

use std::f64::consts::TAU;

use crate::{Law, LocalElement, System};

/// Reflections for each element: at one stop a state may come to lie behind another.
const REFLECTIONS: usize = 8;

/// A state from which a motion can begin: the given one, or, as long as it lies within contacts of laws
/// that remember their impact or behind rigid stops, its reflection at the deepest of them.
///
/// * `phase`: [cycles]; `state`: `[q; q']`, length 2n.
///
/// # Returns
/// `None` where stops leave no room that a few reflections find.
#[must_use]
pub fn in_front_of_contacts(
    system: &System,
    frequency_hz: f64,
    phase: f64,
    state: &[f64],
) -> Option<Vec<f64>> {
    let mut state = state.to_vec();
    for _ in 0..=REFLECTIONS * system.elements().len() {
        let Some((element, depth)) = deepest(system, frequency_hz, phase, &state) else {
            return Some(state);
        };
        reflect(system, frequency_hz, (element, depth), &mut state);
    }
    None
}

/// The element, of those in whose contacts no motion begins, behind whose level a state lies most deeply,
/// and how deeply.
fn deepest(system: &System, frequency_hz: f64, phase: f64, state: &[f64]) -> Option<(usize, f64)> {
    let keeps_out = |law: &Law| law.remembers_impact() || law.rigid().is_some();
    let elements = system.elements().iter().enumerate().filter(|(_, element)| keeps_out(&element.law));
    let depths = elements.filter_map(|(number, _)| {
        system.depth_in_contact(number, frequency_hz, phase, state).map(|depth| (number, depth))
    });
    depths.filter(|(_, depth)| *depth > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Reflects a state at the only contact of an element.
fn reflect(system: &System, frequency_hz: f64, (element, depth): (usize, f64), state: &mut [f64]) {
    let LocalElement { shape, law, .. } = &system.elements()[element];
    let beyond = depth * law.contacts()[0].sign;
    let modes = shape.iter().zip(&system.model().natural_frequencies);
    let along: Vec<f64> = modes.map(|(phi, w)| phi / (w * w + (TAU * frequency_hz).powi(2))).collect();
    let yielding: f64 = shape.iter().zip(&along).map(|(phi, w)| phi * w).sum();
    if yielding > 0.0 {
        state.iter_mut().zip(&along).for_each(|(q, w)| *q -= 2.0 * beyond * w / yielding);
    }
}
