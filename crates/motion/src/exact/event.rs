//! Steps that end exactly where a contact opens or closes. Equation (S8) of the book, `docs/theory`.
//!
//! The length of the step is found by Newton's method on the distance that falls to zero at its end: the
//! penetration of the contact that opens, the pressure of one that parts, the clearance of one that closes. A
//! relative error d of the length leaves `d^exponent` of the contact's effect on the sensitivities, and less
//! in the state.

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::Jet,
    flight::{Boundary, Touch, clearance_of},
    hole,
    polynomial::first_below,
    run::Run,
};

/// Tries of the length of one step; three are usual.
const MAX_TRIES: usize = 8;

/// Accuracy of the length, relative to the power of the tolerance that the exponent of the contact asks for:
/// slow contacts weigh their ends more, and another try is cheap.
const RELATIVE_ACCURACY: f64 = 0.02;

/// Precision of the displacements at the first try of a length.
const COARSE: f64 = 1e-5;

/// A step that ends with a release and is longer than what the last step allows by this factor fails as a
/// rule.
pub(super) const HOPELESS: f64 = 1.5;

/// What ends a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The closed contact of this element opens.
    Release(usize),
    /// The closed contact of this element parts: its pressure vanishes, while penetration is left.
    Part(usize),
    /// A contact without force crosses one of its boundaries.
    Touch(Touch),
    /// The rigid stop that holds this element presses no more (`pressing.rs`).
    Lift(usize),
}

impl Event {
    pub fn element(self) -> usize {
        match self {
            Self::Release(element) | Self::Part(element) | Self::Lift(element) => element,
            Self::Touch(touch) => touch.element,
        }
    }
}

/// A solved step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solved {
    /// Error relative to its bound.
    pub error: f64,
    /// Whether the step ends with its event, not with the stretch.
    pub at_event: bool,
    /// Length of the step [s]; of one whose error is infinite, the length that it would have.
    pub length: f64,
}

impl ExactIntegrator {
    /// Solves the step that ends with `event`, at about `length`; `None` if it does not get there.
    pub(super) fn locate(
        &mut self,
        run: &Run,
        event: Event,
        grading: Grading,
        length: f64,
        remaining: f64,
    ) -> Option<Solved> {
        let exponent = self.exponent_of(run, event);
        let accuracy = self.location_accuracy(exponent);
        // Newton's method with the curvature: the next error is below the power 2.5 of this one.
        let nearly = 0.3 * accuracy.powf(0.4);
        // A stop that has just been left is not met before its clearance is looked at again, however little
        // it is above zero meanwhile.
        let least = match event {
            Event::Touch(touch) => self.looked_past(run, touch.element).min(remaining),
            _ => 0.0,
        };
        let mut length = length.min(remaining).max(least);
        // The first try tells little more than the length of the next, unless the event was located before.
        let located = run.release.is_some() || least > 0.0;
        let first = if located { self.full_precision() } else { COARSE };
        let mut precision = first;
        let mut last = false;
        for tries in 0..MAX_TRIES {
            self.solve_step(run, length, (grading, tries > 0), precision)?;
            if self.step.length != length {
                return None;
            }
            if last {
                return Some(Solved { error: self.state_error(run), at_event: true, length });
            }
            if !matches!(event, Event::Lift(_)) {
                self.keep_step_end(run, event.element());
            }
            let distance = self.distance_at_end(run, event);
            if length == least && precision < COARSE && distance.value <= run.start[event.element()].margin {
                return Some(Solved { error: self.state_error(run), at_event: true, length });
            }
            let change = time_to_zero(distance, length)?;
            let fine = precision < COARSE;
            let undecided = self.pressure_rounding(run, event) / distance.slope.abs();
            if fine && change.abs() <= (accuracy * length).max(undecided) {
                return Some(Solved { error: self.state_error(run), at_event: true, length });
            }
            if fine && length == remaining && change > 0.0 {
                return Some(Solved { error: self.state_error(run), at_event: false, length });
            }
            if length + change > self.longest_with_sensitivities(run) {
                return Some(Solved { error: f64::INFINITY, at_event: true, length: length + change });
            }
            let near = change.abs() <= nearly * length && distance.curvature.is_finite();
            if fine && near && self.stays_closed(run, event, distance) {
                return None;
            }
            last = fine && near && length + change < remaining;
            precision = self.full_precision();
            length = (length + change.clamp(-0.5 * length, 0.5 * length)).min(remaining).max(least);
        }
        None
    }

    /// Whether the distance that falls to zero where a contact ends turns before, beyond rounding.
    fn stays_closed(&self, run: &Run, event: Event, distance: Jet) -> bool {
        let Jet { value, slope, curvature } = distance;
        let ends = matches!(event, Event::Release(_) | Event::Part(_));
        ends && curvature > 0.0 && value - 0.5 * slope * slope / curvature > self.rounding_of(run, event)
    }

    /// Length above which the sensitivities of the step would hardly be accurate enough, as the last step
    /// tells; it is not worth locating its end.
    fn longest_with_sensitivities(&self, run: &Run) -> f64 {
        if run.sensitivity.is_some() && run.proposal > 0.0 { HOPELESS * run.proposal } else { f64::INFINITY }
    }

    /// Accuracy of the length of a step that ends with a contact that sets in or ends with that exponent,
    /// relative to it.
    fn location_accuracy(&self, exponent: f64) -> f64 {
        (RELATIVE_ACCURACY * self.settings.tolerance.powf(1.0 / exponent)).max(4.0 * f64::EPSILON)
    }

    /// How much earlier than at the end of the solved step an event that was located there may be found: what
    /// its location, and rounding of what falls to zero, leave undecided [s].
    pub(super) fn located_within(&self, run: &Run, event: Event) -> f64 {
        let length = self.step.length;
        let speed = self.distance_at_end(run, event).slope.abs();
        let of_displacement = match event {
            Event::Lift(_) => 0.0,
            other => run.start[other.element()].margin,
        };
        let margin = of_displacement.max(self.pressure_rounding(run, event));
        let rounding = (8.0 * margin / speed).min(length);
        let accuracy = self.location_accuracy(self.exponent_of(run, event));
        (10.0 * accuracy).max(1e-9) * length + rounding
    }

    /// Whether an event that was expected can still come.
    pub(super) fn may_come(&self, run: &Run, event: Event) -> bool {
        match event {
            Event::Lift(element) => self.held_place(run, element).is_some(),
            _ => run.closed[event.element()].is_some(),
        }
    }

    /// What rounding leaves undecided of a pressure that vanishes or comes back; 0 at other events, whose
    /// distances are displacements.
    fn pressure_rounding(&self, run: &Run, event: Event) -> f64 {
        let of_pressure = match event {
            Event::Part(_) => true,
            Event::Touch(touch) => touch.boundary == Boundary::Presses,
            Event::Release(_) => false,
            Event::Lift(element) => {
                return self.held_place(run, element).map_or(0.0, |place| run.pressing[place].margin);
            }
        };
        let pressure = self.laws[event.element()].pressure().filter(|_| of_pressure);
        let start = run.start[event.element()];
        pressure.map_or(0.0, |pressure| {
            pressure.displacement * start.margin
                + 8.0 * f64::EPSILON * (pressure.velocity * start.velocity + pressure.offset)
        })
    }

    /// Exponent with which the force sets in or ends at an event: where the pressure vanishes or comes back,
    /// linearly.
    fn exponent_of(&self, run: &Run, event: Event) -> f64 {
        let contacts = self.laws[event.element()].contacts();
        match event {
            Event::Release(element) => contacts[run.closed[element].unwrap_or(0)].onset_exponent,
            Event::Touch(touch) if touch.boundary == Boundary::Closes => {
                contacts[touch.contact].onset_exponent
            }
            Event::Part(_) | Event::Touch(_) | Event::Lift(_) => 1.0,
        }
    }

    /// How the closed contact of an element ends as a rule: the pressure of a spring with a damper vanishes
    /// before its penetration does.
    pub(super) fn usual_end(&self, element: usize) -> Event {
        match self.laws[element].pressure() {
            Some(pressure) if pressure.offset == 0.0 => Event::Part(element),
            _ => Event::Release(element),
        }
    }

    /// What falls to zero at the end of the solved step, and its derivatives.
    pub(super) fn distance_at_end(&self, run: &Run, event: Event) -> Jet {
        if let Event::Lift(element) = event {
            return self.pressing_at_step_end(run, element);
        }
        let jet = self.element_jet_at_step_end(run, event.element());
        self.distance_of(run, event, jet)
    }

    /// What falls to zero at an event, from the relative displacement.
    fn distance_of(&self, run: &Run, event: Event, jet: Jet) -> Jet {
        let touch =
            |element: usize, boundary| Touch { element, contact: run.closed[element].unwrap_or(0), boundary };
        match event {
            Event::Touch(touch) => self.distance(jet, touch),
            Event::Release(element) => self.distance(jet, touch(element, Boundary::Leaves)),
            Event::Lift(_) => jet,
            Event::Part(element) => {
                let missing = self.distance(jet, touch(element, Boundary::Presses));
                Jet { value: -missing.value, slope: -missing.slope, curvature: f64::NEG_INFINITY }
            }
        }
    }

    /// An output and its derivatives at the end of the solved step, apart from the direct part of the forces.
    pub(super) fn free_jet_at_step_end(&self, run: &Run, output: usize) -> Jet {
        let known = self.step.known_ends.iter().find(|(known, _)| *known == output);
        known.map_or_else(|| self.read_step_end(run, output), |(_, jet)| *jet)
    }

    /// Reads it once for all who ask for it before another step is solved.
    pub(super) fn keep_step_end(&mut self, run: &Run, output: usize) {
        if self.laws.get(output).is_some_and(|law| law.round_hole().is_some()) {
            self.keep_step_end(run, output + 1);
        }
        let jet = self.free_jet_at_step_end(run, output);
        self.step.known_ends.push((output, jet));
    }

    fn read_step_end(&self, run: &Run, output: usize) -> Jet {
        let end = self.step.start + self.step.length;
        let (own, driven) = (
            self.step.end_jet(output, &self.series, &self.outputs, &run.state),
            self.drive.jet(output, &self.outputs[output], end),
        );
        Jet {
            value: own.value + driven.value,
            slope: own.slope + driven.slope,
            curvature: own.curvature + driven.curvature,
        }
    }

    /// The same with that.
    pub(super) fn jet_at_step_end(&self, run: &Run, output: usize) -> Jet {
        let mut found = self.free_jet_at_step_end(run, output);
        let own = found;
        let at = |e: usize| if e == output { own } else { self.free_jet_at_step_end(run, e) };
        for &other in &self.step.active {
            found.curvature += self.mobility[output][other] * hole::force_of(&self.laws, other, at).value;
        }
        found
    }

    /// The same of an element: of a hole its reading.
    pub(super) fn element_jet_at_step_end(&self, run: &Run, element: usize) -> Jet {
        let own = self.jet_at_step_end(run, element);
        match self.laws[element].round_hole() {
            Some(hole) => hole::reading(hole, own, self.jet_at_step_end(run, element + 1)),
            None => own,
        }
    }

    /// The relative displacement of an element at the end of the solved step, of a hole its reading, apart
    /// from the direct part of the forces.
    pub(super) fn free_element_jet_at_step_end(&self, run: &Run, element: usize) -> Jet {
        let own = self.free_jet_at_step_end(run, element);
        match self.laws[element].round_hole() {
            Some(hole) => hole::reading(hole, own, self.free_jet_at_step_end(run, element + 1)),
            None => own,
        }
    }

    /// The first end of a closed contact, or lift of a held stop, within the solved step, and when, other
    /// than those `excused` and the one with which the step ends.
    pub(super) fn first_release(
        &self,
        run: &Run,
        at_end: Option<Event>,
        excused: &[Event],
    ) -> Option<(Event, f64)> {
        let is_sought = |event: &Event| at_end != Some(*event) && !excused.contains(event);
        let ends = self.possible_ends(run).filter(|(_, event)| is_sought(event));
        let ends = ends.filter_map(|(a, event)| self.first_end(run, a, event).map(|time| (event, time)));
        let lift = if run.stuck.is_empty() { None } else { self.first_lift(run, at_end, excused) };
        ends.chain(lift).min_by(|x, y| x.1.total_cmp(&y.1))
    }

    /// What may end the contacts of the active elements, each with the place of its element among them.
    pub(super) fn possible_ends(&self, run: &Run) -> impl Iterator<Item = (usize, Event)> {
        let closed =
            self.step.active.iter().enumerate().filter(|(_, element)| run.closed[**element].is_some());
        closed.flat_map(|(a, &element)| {
            let both = self.laws[element].pressure().is_some_and(|pressure| pressure.offset > 0.0);
            let parting = both.then_some(Event::Part(element));
            [Some(self.usual_end(element)), parting].into_iter().flatten().map(move |event| (a, event))
        })
    }

    /// What falls to zero at an end of the contact of the a-th active element, at the nodes of the solved
    /// step.
    pub(super) fn nodal_distance(&self, run: &Run, a: usize, event: Event) -> Option<[f64; NODES]> {
        let contact = self.closed_contact(run, event.element())?;
        let of_element = a * NODES..(a + 1) * NODES;
        let mut distance = [0.0; NODES];
        for (distance, displacement) in distance.iter_mut().zip(self.step.nodal_readings(&self.laws, a)) {
            *distance = contact.sign * (displacement - contact.level);
        }
        if let (Event::Part(_), Some(pressure)) = (event, self.laws[event.element()].pressure()) {
            for (distance, velocity) in distance.iter_mut().zip(&self.step.velocity[of_element]) {
                *distance = pressure.at(*distance, contact.sign * velocity);
            }
        }
        Some(distance)
    }

    /// What rounding, and the accuracy with which a touch was located, leave undecided of that.
    pub(super) fn rounding_of(&self, run: &Run, event: Event) -> f64 {
        let start = run.start[event.element()];
        let in_front = self
            .closed_contact(run, event.element())
            .map_or(0.0, |contact| clearance_of(start.jet, contact.level, contact.sign).value.max(0.0));
        match event {
            Event::Part(_) => self.pressure_rounding(run, event),
            // What the location of a touch has left in front of the level is no release.
            _ => start.margin + 2.0 * in_front,
        }
    }

    /// When what ends the contact of the a-th active element first falls to zero within the solved step.
    fn first_end(&self, run: &Run, a: usize, event: Event) -> Option<f64> {
        let rule = self.step.grading().rule();
        let distance = self.nodal_distance(run, a, event)?;
        let deepest = distance.iter().fold(0.0_f64, |deepest, d| deepest.max(d.abs()));
        let margin = 1e-9 * deepest + self.rounding_of(run, event);
        let s = first_below(&rule.bernstein(&distance), rule.s[0], margin)?;
        Some(self.step.grading().map(s).0 * self.step.length)
    }
}

/// Time until a falling distance is zero, from its value and derivatives; `None` if it is not falling or
/// turns before.
fn time_to_zero(distance: Jet, length: f64) -> Option<f64> {
    let Jet { value, slope, curvature } = distance;
    if slope >= 0.0 || slope.is_nan() {
        return None;
    }
    if curvature == f64::NEG_INFINITY {
        return Some(-value / slope).filter(|change| change.abs() < length);
    }
    let discriminant = slope * slope - 2.0 * curvature * value;
    if discriminant <= 0.0 {
        // A turn ahead may be an effect of the curvature's change over a long way.
        return Some(-value / slope).filter(|change| change.abs() < 0.5 * length);
    }
    Some(2.0 * value / (discriminant.sqrt() - slope))
}
