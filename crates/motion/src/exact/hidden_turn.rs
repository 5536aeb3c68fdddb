//! Contacts that turn at their level in front of the first node of a step, or behind its last.
//!
//! There neither the opening nor the corner of the slope `s` of the force is seen: at the nodes the
//! penetration has the values of the motion behind the turn, or in front of it, and releases are sought on
//! what is interpolated between them. Of the response over the length h a turn at the time t from the end of
//! the step leaves out about `h G s t`, with the mobility G, which may be as small as the tolerance and yet
//! more than what the error estimate, which knows the nodes only, says. The turn is where the clearance and
//! its derivatives at the end of the step put it; a step that hides it ends there.
//!
//! **Corners beyond an end.** Of a half-integer contact that turns with the penetration b at the time d
//! beyond an end of the step, the slope of the force goes like `s = S sqrt(t^2 + w^2)` with the time t from
//! the turn and the width `w = sqrt(b/a)`, where the penetration is `b + a t^2`. Where w is small that is
//! `S |t|`, which is smooth in the step, and `S w^2/(2 t)`, a pole as seen from there; else two branch points
//! `t = i w` and `-i w`. On n Gauss nodes the integral is wrong by the lesser of
//!
//! `pi S w^2 / rho^(2n+1)` and `5 S sqrt(w) (h |r| / (4n+2))^(3/2) / rho^(2n+1)`,
//! `rho = |z + r|`, `r = sqrt(z^2 - 1)`, `z = 1 + 2 (d + i w)/h`
//!
//! (the contour integral of `2 Q_n/P_n`, of the Legendre functions, around the pole or along the cuts), and
//! sensitivities by h G times that. Where the contact opens around the turn b is negative, and `i w` the real
//! `-sqrt(-b/a)`. The coefficients of the force over the step do not show it: those at half the degree belong
//! to what is smooth. A step in which it is more than the tolerance is shortened until it has only [`SPARE`]
//! of that.
//!
//! **Slow touches.** A step from a touch has its start at one opening: behind it the penetration is `v t + a
//! t^2` with the speed v, and the grading `t = h x^2` makes the slope of the force smooth there. The other
//! opening would be `v/a` in front of the touch. So the slope goes like `S h x sqrt(x^2 + w^2)` with `w^2 =
//! v/(a h)`, and with `dt = 2 h x dx` the integral over the step is wrong by
//!
//! `10 S h^2 w^(5/2) (|r| / (4n+2))^(3/2) / rho^(2n+1)`, `r = sqrt(z^2 - 1)`, `z = -1 + 2 i w`,
//!
//! by the cuts from `i w` and `-i w` as above, as long as these are far from the nodes. Between the end and
//! the first few nodes it is up to 2.1 times as much, which 21 in place of 10 covers for all w.

use std::f64::consts::PI;

use faer::c64;

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

/// Share of the tolerance that a corner beyond an end of a shortened step leaves.
const SPARE: f64 = 0.01;
/// Largest share of the largest speed at the end of a step that lies so near a corner.
const SLOW: f64 = 0.5;
/// Factor by which steps are shortened until they resolve a corner.
const SHORTER: f64 = 0.9;
/// A corner farther from the step than this share of its length is resolved.
const FAR: f64 = 0.5;

/// A turn seen from an end of a step, into the step.
struct Turn {
    element: usize,
    contact: Contact,
    /// Of the element.
    jet: Jet,
    /// Clearance and its derivatives by the time from the end of the step.
    clearance: Jet,
}

/// A corner of a slope beyond an end of a step.
struct Corner {
    /// Its distance d from there, or that of the opening [s].
    apart: f64,
    /// Its distance from real times [s].
    aside: f64,
    /// `w` [s].
    width: f64,
    /// `G S` [1/s^3].
    strength: f64,
    tolerance: f64,
}

/// The opening in front of a slow touch.
struct SlowTouch {
    /// `v/a` [s].
    apart: f64,
    /// `G S` [1/s^3].
    strength: f64,
    tolerance: f64,
}

/// What Gauss nodes leave of a root that begins at z, as seen from a step from -1 to 1: `(|r| /
/// (4n+2))^(3/2)` and `rho^(2n+1)`.
fn missed_at(z: c64) -> (f64, f64) {
    let n = NODES as f64;
    let root = (z * z - 1.0).sqrt();
    let rho = (z + root).norm().max((z - root).norm());
    ((root.norm() / (4.0 * n + 2.0)).powf(1.5), rho.powf(2.0 * n + 1.0))
}

impl Corner {
    /// Error of the sensitivities that it leaves in a step of that length which ends by so much earlier.
    fn error(&self, length: f64, earlier: f64) -> f64 {
        let z = c64::new(1.0 + 2.0 * (self.apart + earlier) / length, 2.0 * self.aside / length);
        let (root, decay) = missed_at(z);
        let pole = PI * self.width * self.width;
        let branch = 5.0 * self.width.sqrt() * length.powf(1.5) * root;
        length * self.strength * pole.min(branch) / decay
    }

    /// How long a step may be that does not resolve it with that length; `None` if it does.
    ///
    /// * `earlier`: by how much one of another length ends earlier.
    fn resolved_from(&self, length: f64, earlier: impl Fn(f64) -> f64) -> Option<f64> {
        let is_near = self.apart > 0.0 && self.apart < FAR * length;
        if !is_near || self.error(length, 0.0) <= self.tolerance {
            return None;
        }
        Some(shortened(length, SPARE * self.tolerance, |length| self.error(length, earlier(length))))
    }
}

impl SlowTouch {
    /// Error of the sensitivities that it leaves in a step of that length from the touch.
    fn error(&self, length: f64) -> f64 {
        let width = (self.apart / length).sqrt();
        let (root, decay) = missed_at(c64::new(-1.0, 2.0 * width));
        21.0 * self.strength * length.powi(3) * width.powf(2.5) * root / decay
    }

    /// How long a step from the touch may be that does not resolve it with that length; `None` if it does.
    fn resolved_from(&self, length: f64) -> Option<f64> {
        let is_near = self.apart < length;
        let resolves = !is_near || self.error(length) <= self.tolerance;
        (!resolves).then(|| shortened(length, SPARE * self.tolerance, |length| self.error(length)))
    }
}

/// That length, shortened until the error is at most so large.
fn shortened(mut length: f64, most: f64, error: impl Fn(f64) -> f64) -> f64 {
    while error(length) > most {
        length *= SHORTER;
    }
    length
}

impl ExactIntegrator {
    /// That length, or the time to the first turn in front of the first node of a step of that length, or
    /// what a corner at its start allows; `touched` is the element whose touch begins it.
    pub(super) fn up_to_hidden_turn(&self, run: &Run, touched: Option<usize>, length: f64) -> f64 {
        let smooth = Grading::Smooth;
        let first_node = smooth.map(smooth.rule().s[0]).0 * length;
        let allowed = self.closed_contacts(run).filter_map(|(element, contact)| {
            let at = run.start[element].jet;
            let opens = clearance_of(at, contact.level, contact.sign).slope > 0.0;
            let rests = self.may_be_corner(run, (element, contact), at);
            let jet = (opens || rests).then(|| self.element_jet_with_forces(run, element))?;
            let clearance = clearance_of(jet, contact.level, contact.sign);
            let turn = Turn { element, contact, jet, clearance };
            self.allowed_beside(&turn, (opens, rests), (first_node, length))
        });
        let length = allowed.fold(length, f64::min);
        let beyond = self.corners(run).filter_map(|(element, contact)| {
            let start = run.start[element];
            let behind = clearance_of(start.jet, contact.level, contact.sign).slope < 0.0;
            let is_slow = start.jet.slope.abs() < SLOW * start.velocity;
            let jet = (behind && is_slow).then(|| self.element_jet_with_forces(run, element))?;
            let clearance = clearance_of(jet, contact.level, contact.sign);
            let turn = Turn { element, contact, jet, clearance };
            if touched == Some(element) {
                return self.slow_touch(&turn, length)?.resolved_from(length);
            }
            self.corner(&turn)?.resolved_from(length, |_| 0.0)
        });
        beyond.fold(length, f64::min)
    }

    /// How long the solved step may be so that no turn lies behind its last node, nor a corner at its end;
    /// `None` if none does.
    pub(super) fn hidden_turn_at_end(&self, run: &Run) -> Option<f64> {
        let (length, grading) = (self.step.length, self.step.grading());
        let behind_nodes = (1.0 - grading.map(grading.rule().s[NODES - 1]).0) * length;
        let allowed = self.closed_contacts(run).filter_map(|(element, contact)| {
            let at = self.free_element_jet_at_step_end(run, element);
            let falls = clearance_of(at, contact.level, contact.sign).slope < 0.0;
            let rests = self.may_be_corner(run, (element, contact), at);
            let jet = (falls || rests).then(|| self.element_jet_at_step_end(run, element))?;
            let forwards = clearance_of(jet, contact.level, contact.sign);
            let clearance = Jet { slope: -forwards.slope, ..forwards };
            let turn = Turn { element, contact, jet, clearance };
            self.allowed_beside(&turn, (falls, rests), (behind_nodes, length))
        });
        allowed.reduce(f64::max).map(|allowed| length - allowed)
    }

    /// How long the solved step may be so that it resolves the corners beyond its end; `None` if it does.
    pub(super) fn corner_beyond_end(&self, run: &Run) -> Option<f64> {
        let length = self.step.length;
        let allowed = self.corners(run).filter_map(|(element, contact)| {
            let at = self.free_element_jet_at_step_end(run, element);
            let comes = clearance_of(at, contact.level, contact.sign).slope > 0.0;
            let is_slow = at.slope.abs() < SLOW * run.start[element].velocity;
            let jet = (comes && is_slow).then(|| self.element_jet_at_step_end(run, element))?;
            let forwards = clearance_of(jet, contact.level, contact.sign);
            let clearance = Jet { slope: -forwards.slope, ..forwards };
            let corner = self.corner(&Turn { element, contact, jet, clearance })?;
            corner.resolved_from(length, |shorter| length - shorter)
        });
        allowed.reduce(f64::min)
    }

    /// Closed contacts whose force has a corner at their level, where sensitivities are wanted.
    fn corners(&self, run: &Run) -> impl Iterator<Item = (usize, Contact)> {
        let wanted = run.sensitivity.is_some();
        let is_half_integer = |contact: &Contact| contact.onset_exponent.fract() != 0.0;
        self.closed_contacts(run).filter(move |(_, contact)| wanted && is_half_integer(contact))
    }

    /// The corner of a turn beyond an end of a step.
    fn corner(&self, turn: &Turn) -> Option<Corner> {
        let &Turn { element, jet, clearance, .. } = turn;
        let (time, bend) = (clearance.slope / clearance.curvature, -0.5 * clearance.curvature);
        let depth = -clearance.value;
        if !(bend > 0.0 && time > 0.0 && depth > 0.0) {
            return None;
        }
        let bottom = depth - bend * time * time;
        let width = (bottom.abs() / bend).sqrt();
        let slope = self.laws[element].pressing_force(jet.value, jet.slope).slope.abs();
        let (apart, aside) = if bottom > 0.0 { (time, width) } else { (time - width, 0.0) };
        Some(Corner {
            apart,
            aside,
            width,
            strength: self.mobility[element][element] * slope / (depth / bend).sqrt(),
            tolerance: self.settings.tolerance,
        })
    }

    /// The opening in front of the touch with which a step of about that length begins.
    fn slow_touch(&self, turn: &Turn, length: f64) -> Option<SlowTouch> {
        let &Turn { element, contact, clearance, .. } = turn;
        let (speed, bend) = (-clearance.slope, -0.5 * clearance.curvature);
        if !(bend > 0.0 && speed > 0.0) {
            return None;
        }
        let depth = length * (speed + bend * length);
        let inside = contact.level + contact.sign * depth;
        let velocity = contact.sign * (speed + 2.0 * bend * length);
        let slope = self.laws[element].pressing_force(inside, velocity).slope.abs();
        Some(SlowTouch {
            apart: speed / bend,
            strength: self.mobility[element][element] * slope / (depth / bend).sqrt(),
            tolerance: self.settings.tolerance,
        })
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
