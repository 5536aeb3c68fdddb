//! Contacts that turn at their level in front of the first node of a step, or behind its last.
//!
//! There neither the opening nor the corner of the slope `s` of the force is seen: at the nodes the penetration has the values of the motion behind the turn, or in front of it, and releases are sought on
//! what is interpolated between them. Of the response over the length h a turn at the time t from the end of the step leaves out about `h G s t`, with the mobility G, which may be as small as the tolerance
//! and yet more than what the error estimate, which knows the nodes only, says. The turn is where the clearance and its derivatives at the end of the step put it; a step that hides it ends there.

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::Jet,
    flight::clearance_of,
    run::Run,
};
use crate::Contact;

/// A turn seen from an end of a step, into the step.
struct Turn {
    element: usize,
    contact: Contact,
    /// Of the element.
    jet: Jet,
    /// Clearance and its derivatives by the time from the end of the step.
    clearance: Jet,
}

impl ExactIntegrator {
    /// That length, or the time to the first turn in front of the first node of a step of that length.
    pub(super) fn up_to_hidden_turn(&self, run: &Run, length: f64) -> f64 {
        let smooth = Grading::Smooth;
        let first_node = smooth.map(smooth.rule().s[0]).0 * length;
        let turns = self.closed_contacts(run).filter_map(|(element, contact)| {
            let opens = clearance_of(run.start[element].jet, contact.level, contact.sign).slope > 0.0;
            let jet = opens.then(|| self.jet_with_forces(run, element))?;
            let clearance = clearance_of(jet, contact.level, contact.sign);
            self.hidden(&Turn { element, contact, jet, clearance }, first_node, length)
        });
        turns.fold(length, f64::min)
    }

    /// How long the solved step may be so that no turn lies behind its last node; `None` if none does.
    pub(super) fn hidden_turn_at_end(&self, run: &Run) -> Option<f64> {
        let (length, grading) = (self.step.length, self.step.grading());
        let behind_nodes = (1.0 - grading.map(grading.rule().s[NODES - 1]).0) * length;
        let turns = self.closed_contacts(run).filter_map(|(element, contact)| {
            let jet = self.free_jet_at_step_end(run, element);
            let falls = clearance_of(jet, contact.level, contact.sign).slope < 0.0;
            let jet = falls.then(|| self.jet_at_step_end(run, element))?;
            let forwards = clearance_of(jet, contact.level, contact.sign);
            let clearance = Jet { slope: -forwards.slope, ..forwards };
            self.hidden(&Turn { element, contact, jet, clearance }, behind_nodes, length)
        });
        turns.reduce(f64::max).map(|turn| length - turn)
    }

    fn closed_contacts(&self, run: &Run) -> impl Iterator<Item = (usize, Contact)> {
        (0..self.laws.len()).filter_map(|element| Some((element, self.closed_contact(run, element)?)))
    }

    /// When a turn comes, if it lies within a part of a step of that length which has no node.
    fn hidden(&self, turn: &Turn, without_node: f64, length: f64) -> Option<f64> {
        let &Turn { element, contact, jet, clearance } = turn;
        let time = -clearance.slope / clearance.curvature;
        if !(time > 0.0 && time < without_node) {
            return None;
        }
        let penetration = -(clearance.value + 0.5 * clearance.slope * time);
        // A half-integer power has its corner within the time in which the penetration doubles.
        let half_integer = contact.onset_exponent.fract() != 0.0;
        let width = if half_integer { without_node } else { 0.0 };
        let is_corner = penetration < -0.5 * clearance.curvature * width * width;
        let slope = self.laws[element].pressing_force(jet.value, jet.slope).slope.abs();
        let hidden = length * self.mobility[element][element] * slope * time;
        (is_corner && hidden > self.settings.tolerance).then_some(time)
    }
}
