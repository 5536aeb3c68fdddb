//! Contacts that turn at their level in front of the first node of a step, or behind its last.
//!
//! There neither the opening nor the corner of the slope `s` of the force is seen: at the nodes the
//! penetration has the values of the motion behind the turn, or in front of it, and releases are sought on
//! what is interpolated between them. Of the response over the length h a turn at the time t from the end of
//! the step leaves out about `h G s t`, with the mobility G, which may be as small as the tolerance and yet
//! more than what the error estimate, which knows the nodes only, says. The turn is where the clearance and
//! its derivatives at the end of the step put it; a step that hides it ends there.

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::Jet,
    flight::clearance_of,
    run::Run,
};
use crate::Contact;

/// A step begins or ends with a turn where the speed is so small a part of the largest one.
const AT_REST: f64 = 1e-2;
/// Length of a step whose nodes stand in the corner at its end, over the width of the corner.
const IN_CORNER: f64 = 12.0;

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
    /// That length, or the time to the first turn in front of the first node of a step of that length, or
    /// what a corner at its start allows.
    pub(super) fn up_to_hidden_turn(&self, run: &Run, length: f64) -> f64 {
        let smooth = Grading::Smooth;
        let first_node = smooth.map(smooth.rule().s[0]).0 * length;
        let allowed = self.closed_contacts(run).filter_map(|(element, contact)| {
            let at = run.start[element].jet;
            let opens = clearance_of(at, contact.level, contact.sign).slope > 0.0;
            let rests = self.may_be_corner(run, (element, contact), at);
            let jet = (opens || rests).then(|| self.jet_with_forces(run, element))?;
            let clearance = clearance_of(jet, contact.level, contact.sign);
            let turn = Turn { element, contact, jet, clearance };
            self.allowed_beside(&turn, (opens, rests), (first_node, length))
        });
        allowed.fold(length, f64::min)
    }

    /// How long the solved step may be so that no turn lies behind its last node, nor a corner at its end;
    /// `None` if none does.
    pub(super) fn hidden_turn_at_end(&self, run: &Run) -> Option<f64> {
        let (length, grading) = (self.step.length, self.step.grading());
        let behind_nodes = (1.0 - grading.map(grading.rule().s[NODES - 1]).0) * length;
        let allowed = self.closed_contacts(run).filter_map(|(element, contact)| {
            let at = self.free_jet_at_step_end(run, element);
            let falls = clearance_of(at, contact.level, contact.sign).slope < 0.0;
            let rests = self.may_be_corner(run, (element, contact), at);
            let jet = (falls || rests).then(|| self.jet_at_step_end(run, element))?;
            let forwards = clearance_of(jet, contact.level, contact.sign);
            let clearance = Jet { slope: -forwards.slope, ..forwards };
            let turn = Turn { element, contact, jet, clearance };
            self.allowed_beside(&turn, (falls, rests), (behind_nodes, length))
        });
        allowed.reduce(f64::max).map(|allowed| length - allowed)
    }

    /// How much of a step of that length may lie on this side of a turn that comes, and of one at its end.
    fn allowed_beside(
        &self,
        turn: &Turn,
        (comes, rests): (bool, bool),
        (without_node, length): (f64, f64),
    ) -> Option<f64> {
        let hidden = if comes { self.hidden(turn, without_node, length) } else { None };
        hidden.or_else(|| rests.then(|| self.longest_beside(turn, without_node, length)).flatten())
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

    /// Whether a half-integer contact may be at a bottom of its penetration in a state in which the element
    /// has that displacement and speed.
    fn may_be_corner(&self, run: &Run, (element, contact): (usize, Contact), at: Jet) -> bool {
        at.slope.abs() < AT_REST * run.start[element].velocity
            && contact.onset_exponent.fract() != 0.0
            && clearance_of(at, contact.level, contact.sign).value < 0.0
    }

    /// How long a step of that length may be that has a turn at its end, so that the corner there is not
    /// hidden; `None` if it is not.
    fn longest_beside(&self, turn: &Turn, without_node: f64, length: f64) -> Option<f64> {
        let &Turn { element, jet, clearance, .. } = turn;
        let time = -clearance.slope / clearance.curvature;
        let bottom = -(clearance.value + 0.5 * clearance.slope * time);
        let bend = -0.5 * clearance.curvature;
        if !(bottom > 0.0 && bend > 0.0) {
            return None;
        }
        let width = (bottom / bend).sqrt();
        if time.abs() > width.max(1e-3 * without_node) || width > without_node {
            return None;
        }
        let slope = self.laws[element].pressing_force(jet.value, jet.slope).slope.abs();
        let slope = slope * (bottom / -clearance.value).sqrt();
        let left_out = 0.25 * slope * width * (1.0 + (4.0 * (without_node / width).powi(2)).ln());
        let hidden = length * self.mobility[element][element] * left_out;
        let shortened = length * self.settings.tolerance / hidden;
        (hidden > self.settings.tolerance).then(|| shortened.max(IN_CORNER * width)).filter(|at| *at < length)
    }
}
