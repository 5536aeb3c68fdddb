//! What of an orbit cannot be distinguished from nothing at the accuracy of a verification: touches at
//! grazing, and touches where the orbit is cut.

use hammerbeam_motion::{LocalElement, System, general::ElementMaxima};
use hammerbeam_orbit::PeriodicSolution;

use super::recompute::Recomputed;

/// What is not known from nothing, where contacts graze or orbits are cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unknown {
    /// Force at a penetration, and of a damper at a speed, that is not known from none [N].
    pub force: f64,
    /// Speed of a touch on a damper that is not known from none [m/s].
    pub speed: f64,
    /// How much such a touch changes the acceleration of the response [m/s^2].
    pub acceleration: f64,
    /// Largest speed of a touch that lies where the orbit is cut, so that it belongs to either end or to none
    /// [m/s].
    pub touch_at_node: f64,
}

impl Unknown {
    /// * `(margin, slow)`: to which distance it is not known whether contacts touch [m], and with which speed
    ///   a damper [m/s].
    /// * `cut`: of [`touches_at_nodes`].
    pub fn of(
        (system, response): (&System, &[f64]),
        found: &Recomputed,
        (margin, slow): (f64, f64),
        cut: &[f64],
    ) -> Self {
        Self {
            force: force_at(system, found, margin).max(onset_force(system, slow)),
            speed: slow,
            acceleration: onset_acceleration((system, response), slow),
            touch_at_node: cut.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// Force of the dampers that set in with a speed [N].
fn onset_force(system: &System, speed: f64) -> f64 {
    system.elements().iter().map(|element| element.law.onset_damping() * speed).fold(0.0, f64::max)
}

/// What that makes of the acceleration of the response [m/s^2].
fn onset_acceleration((system, response): (&System, &[f64]), speed: f64) -> f64 {
    let of_element = |element: &LocalElement| {
        let mobility: f64 = element.shape.iter().zip(response).map(|(a, b)| a * b).sum();
        mobility.abs() * element.law.onset_damping() * speed
    };
    system.elements().iter().map(of_element).fold(0.0, f64::max)
}

/// What rounding of penetrations leaves unknown of a monodromy matrix by the jumps of velocities in hard
/// contacts, relative to the scales of states: `h = w eps m/p L/V` of a contact with the depth p and the
/// frequency w among displacements of the size m.
pub(super) fn behind_hard_contacts(system: &System, scales: &[f64], found: &Recomputed) -> f64 {
    let (lengths, velocities) = scales.split_at(system.dof());
    let slowest = lengths.iter().zip(velocities).map(|(x, v)| x / v).fold(0.0, f64::max);
    let of_element = |(element, maxima): (&LocalElement, &ElementMaxima)| {
        let LocalElement { shape, law, .. } = element;
        if law.rigid().is_some() || maxima.deepest <= 0.0 || maxima.contact_force == 0.0 {
            return 0.0;
        }
        let mobility: f64 = shape.iter().map(|phi| phi * phi).sum();
        let frequency = (mobility * maxima.contact_force / maxima.deepest).sqrt();
        let moved: f64 = shape.iter().zip(lengths).map(|(phi, x)| (phi * x).abs()).sum();
        let size = moved + law.gap().unwrap_or(0.0).abs();
        frequency * f64::EPSILON * size / maxima.deepest * slowest
    };
    let each = system.elements().iter().zip(&found.of_elements).map(of_element);
    each.fold(0.0, f64::hypot) * f64::from(found.maxima.contacts).sqrt()
}

/// Speeds of the contacts that are touched at a node to within a distance.
pub(super) fn touches_at_nodes(system: &System, solution: &PeriodicSolution, margin: f64) -> Vec<f64> {
    let length = f64::from(solution.period_multiple) / solution.nodes.len() as f64;
    let mut speeds = Vec::new();
    for (k, node) in solution.nodes.iter().enumerate() {
        let phase = solution.phase + k as f64 * length;
        for (number, element) in system.elements().iter().enumerate() {
            let [r, speed, _] = system.contact_motion(number, solution.frequency_hz, phase, node);
            let touched = element.law.contacts().iter().filter(|contact| (r - contact.level).abs() <= margin);
            speeds.extend(touched.map(|contact| contact.sign * speed).filter(|speed| *speed > 0.0));
        }
    }
    speeds
}

/// The largest force at a penetration of that depth, of the elements that come no deeper [N].
fn force_at(system: &System, found: &Recomputed, depth: f64) -> f64 {
    let of_element = |element: &LocalElement| {
        let contacts = element.law.contacts().iter();
        let forces =
            contacts.map(|contact| element.law.force(contact.level + contact.sign * depth, 0.0).value.abs());
        forces.fold(0.0, f64::max)
    };
    if found.of_elements.iter().any(|element| element.deepest > depth && element.contact_force > 0.0) {
        return 0.0;
    }
    system
        .elements()
        .iter()
        .filter(|element| element.law.rigid().is_none())
        .map(of_element)
        .fold(0.0, f64::max)
}
