//! Contacts that open for an instant between two presses.
//!
//! **Why the polynomials of a step do not tell.** A release is sought on the polynomial through the
//! penetrations at the nodes. With the bound `T <= 2 sqrt(tolerance)` of `step_error.rs` on the part of the
//! force that its polynomial leaves out, the penetration within a step of the length h may be off by some `T
//! V h`, at the nodes as well as between them: the square of T holds for the end alone, where what is left
//! out is orthogonal to all that is smooth. So a valley of the penetration whose bottom is nearer to zero
//! than
//!
//! `b = 2 sqrt(tolerance) V h`
//!
//! may be open or closed, whatever the polynomial says; of a pressure `a p + b p' + d` that vanishes the same
//! is `2 sqrt(tolerance) V (a h + b)`.
//!
//! **What tells.** Such a step is cut at the bottom of the valley, which has the accuracy of the end of a
//! step then: the distance d that falls to zero at a release and its slope d' at the end are those of the
//! motion up to the tolerance, and functions of the length that are smooth down to rounding. The place of the
//! bottom is that of the polynomial, off by a small part e of the length; the turn lies `-d'/d''` from the
//! end, and the lowest distance is `d - d'^2/(2 d'')` up to the third power of e. Is that below minus the
//! rounding margin, the contact opens `sqrt(d'^2 - 2 d d'')/d''` before the turn, and the step that ends
//! there is located as every release is; otherwise the contact stays closed and the next step starts at the
//! bottom.
//!
//! **What it costs.** A look at twelve numbers per step where they have no valley, the place of the bottom of
//! one where they have, and another solution of a step where it is as near as that to zero: of presses of one
//! contact a part of the order of `sqrt(tolerance)`.

use super::{
    ExactIntegrator,
    collocation::{NODES, Rule},
    drive::Jet,
    event::Event,
    flight::clearance_of,
    run::Run,
};

/// Part of a step within which a bottom is at its end or its start.
const AT_END: f64 = 1e-4;
/// Steps of Newton's method to a bottom.
const NEWTON_STEPS: usize = 12;
/// Part of what its neighbours are above a node that a parabola through them may miss of the bottom.
const PARABOLA_MISSES: f64 = 0.5;
/// How far above rounding a contact is at its deepest that is looked at.
const ABOVE_ROUNDING: f64 = 1e4;
/// Part of the deepest distance above which the last node does not stand before a bottom that is near zero.
const LOW: f64 = 0.1;

impl ExactIntegrator {
    /// A release that comes just before the turn with which the solved step ends, and when.
    pub(super) fn opening_at_end(&self, run: &Run) -> Option<(Event, f64)> {
        let length = self.step.length;
        let of_end = |(a, event): (usize, Event)| {
            let distance = self.nodal_distance(run, a, event)?;
            // Falls to a turn at the end, as far as the nodes tell.
            if distance[NODES - 1] > distance[NODES - 2] || !is_low(&distance) {
                return None;
            }
            let mut end = self.distance_at_end(run, event);
            if !end.curvature.is_finite() {
                end.curvature = self.curvature_at(&distance, 1.0);
            }
            let Jet { value, slope, curvature } = end;
            let turn = -slope / curvature;
            let bottom = value + 0.5 * slope * turn;
            let opens = curvature > 0.0 && curvature.is_finite() && turn.abs() <= 2.0 * AT_END * length;
            let margin = self.rounding_of(run, event);
            (opens && bottom < -margin)
                .then(|| (event, length + turn - (-2.0 * bottom / curvature).sqrt()))
                .filter(|(_, time)| *time > 0.0)
        };
        self.possible_ends(run).filter_map(of_end).min_by(|x, y| x.1.total_cmp(&y.1))
    }

    /// How long the solved step, which ends with an event or not, may be so that no bottom within it is as
    /// near to zero as its polynomials do not tell.
    pub(super) fn up_to_uncertain_bottom(&self, run: &Run, at_end: Option<Event>) -> Option<f64> {
        let length = self.step.length;
        let bottoms =
            self.possible_ends(run).filter_map(|(a, event)| self.uncertain_bottom(run, (a, event), at_end));
        let first = bottoms.reduce(f64::min)?;
        // Lengths beyond the reach of the series are not free.
        Some(if first > self.series.reach() { 0.5 * first.min(length) } else { first })
    }

    /// The first bottom in the solved step of what falls to zero at an event that is that near to zero.
    fn uncertain_bottom(&self, run: &Run, (a, event): (usize, Event), at_end: Option<Event>) -> Option<f64> {
        let distance = self.nodal_distance(run, a, event)?;
        let (grading, length) = (self.step.grading(), self.step.length);
        let rule = grading.rule();
        let deepest = deepest_of(&distance);
        // Rounding has valleys of its own.
        if deepest < ABOVE_ROUNDING * self.rounding_of(run, event) {
            return None;
        }
        let near = self.uncertainty(run, event).min(LOW * deepest);
        let may_be = |node: usize| match node {
            0 => {
                distance[0] < distance[1]
                    && distance[0] < near.max(LOW * distance[1])
                    && self.falls(run, event)
            }
            node if node == NODES - 1 => {
                at_end.map(Event::element) != Some(event.element())
                    && distance[node] <= distance[node - 1]
                    && is_low(&distance)
            }
            node => {
                let [before, at, after] = [distance[node - 1], distance[node], distance[node + 1]];
                before >= at && at < after && at - PARABOLA_MISSES * (before.max(after) - at) < near
            }
        };
        let bottom = |node: usize| {
            let (s, value) = bottom_of(rule, &distance, node)?;
            let time = grading.map(s).0 * length;
            let inside = time > AT_END * length && time < (1.0 - AT_END) * length;
            (inside && value.abs() < near).then_some(time)
        };
        (0..NODES).filter(|&node| may_be(node)).find_map(bottom)
    }

    /// Whether the contact opens as the step starts.
    fn falls(&self, run: &Run, event: Event) -> bool {
        let element = event.element();
        let opens = |contact: crate::Contact| {
            clearance_of(run.start[element].jet, contact.level, contact.sign).slope > 0.0
        };
        matches!(event, Event::Part(_)) || self.closed_contact(run, element).is_some_and(opens)
    }

    /// `b` of the file header.
    fn uncertainty(&self, run: &Run, event: Event) -> f64 {
        let (length, element) = (self.step.length, event.element());
        let start = run.start[element];
        let velocity = start.velocity.max(start.jet.slope.abs() + start.jet.curvature.abs() * length);
        let time = match (event, self.laws[element].pressure()) {
            (Event::Part(_), Some(pressure)) => pressure.displacement * length + pressure.velocity,
            _ => length,
        };
        2.0 * self.settings.tolerance.sqrt() * velocity * time
    }

    /// Second derivative by the time of a polynomial at a place where it turns.
    fn curvature_at(&self, values: &[f64; NODES], s: f64) -> f64 {
        let (grading, length) = (self.step.grading(), self.step.length);
        let rule = grading.rule();
        let second = rule.derivative(&rule.derivative(values));
        let speed = grading.map(s).1 * length;
        product(&rule.lagrange(s), &second) / (speed * speed)
    }
}

/// Whether the last node is near to zero.
fn is_low(distance: &[f64; NODES]) -> bool {
    distance[NODES - 1] < LOW * deepest_of(distance)
}

fn deepest_of(distance: &[f64; NODES]) -> f64 {
    distance.iter().fold(0.0_f64, |deepest, d| deepest.max(d.abs()))
}

/// Where a polynomial given at the nodes has a minimum between the neighbours of a node, or the end of the
/// step that it has beside it, and its value there.
fn bottom_of(rule: &Rule, values: &[f64; NODES], node: usize) -> Option<(f64, f64)> {
    let low = if node == 0 { 0.0 } else { rule.s[node - 1] };
    let high = if node == NODES - 1 { 1.0 } else { rule.s[node + 1] };
    let first = rule.derivative(values);
    let second = rule.derivative(&first);
    let mut s = rule.s[node];
    for _ in 0..NEWTON_STEPS {
        let lagrange = rule.lagrange(s);
        let (slope, curvature) = (product(&lagrange, &first), product(&lagrange, &second));
        let next = if curvature > 0.0 {
            s - slope / curvature
        } else {
            0.5 * (if slope > 0.0 { low } else { high } + s)
        };
        let next = next.clamp(low, high);
        let change = (next - s).abs();
        s = next;
        if change <= 1e-9 {
            break;
        }
    }
    let turns = s > low && s < high;
    turns.then(|| (s, product(&rule.lagrange(s), values)))
}

fn product(weights: &[f64; NODES], values: &[f64; NODES]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}
