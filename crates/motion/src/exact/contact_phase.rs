//! Steps while forces act, with control of their error (`step_error.rs`).
//!
//! A contact that is struck and left takes a step from the touch and one to the release, each graded towards
//! its end, and where those are too coarse others between them. How long they are is in `step_length.rs`,
//! what a step aims for in `aim.rs`.
//!
//! **What limits very stiff contacts** is rounding of the displacement. A contact of the duration T has the
//! circular frequency `w_c = pi/T`, which grows like `k^(2/5)` for Hertz and like `k^(1/2)` for a linear
//! stop. Within it sensitivities of the velocity by the displacement are of the size of `w_c`, and cancel
//! down to what an impact leaves of them, some `2 r''/v`. The displacement is a sum over the modes that
//! rounds by about `eps r`; the next step starts from it, and its part `w_c/v eps r` of the depth changes the
//! sensitivities by as much of `w_c`: `eps r w_c^2/v` is left, `eps r w_c^2/r''` of what the impact leaves,
//! `eps (w_c/w)^2` with the frequency w of the motion around the contact. Over a period of the beam of the
//! paper the multiplier has 3e-8 of it at 1e15 N/m^1.5, 2e-7 (36 Hz) to 8e-5 (22 Hz) at 1e20, and 4e-4 to 0.2
//! at 1e24. A finer tolerance takes more steps, each of which rounds, and does not help. A multiplier comes
//! near to that of a rigid stop like T, and so like `k^(-2/5)`: 4e-5 to 1e-4 away from it at 1e15, which is
//! the stop and no error. Where that difference does not matter, a rigid stop has neither.

use std::sync::Arc;

use super::{
    ExactIntegrator, MotionError,
    aim::{Aim, SAME},
    clearance::ClearanceBounds,
    collocation::{Grading, NODES},
    event::{Event, Solved},
    flight::{Boundary, MARGIN, Touch, clearance_of},
    hole, rounding,
    run::Run,
    touching::Unresolved,
};
use crate::Contact;

/// Tries of one step before it is given up.
const MAX_TRIES: usize = 60;

/// Part of the largest velocity of an element below which its own is rounding.
pub(super) const AT_REST: f64 = 8.0 * f64::EPSILON;

/// Most of its length that a step keeps that was too inaccurate: its error is hardly one that a power
/// describes yet, and what would just do by it can be far off.
const MOST_KEPT: f64 = 0.7;

/// What became of a try.
enum Tried {
    Accepted {
        error: f64,
        event: Option<Event>,
    },
    Again(Aim),
    /// A contact closes at the start of the step.
    ClosesNow(Touch),
}

impl ExactIntegrator {
    /// Takes one accepted step with forces, up to a release, a touch, the end of the stretch, or as far as
    /// the error allows.
    pub(super) fn contact_phase(&mut self, run: &mut Run, end: f64) -> Result<(), MotionError> {
        self.note_start(run, end);
        let pressed = run.pressed.take();
        if self.open_what_leaves(run, pressed) {
            return Ok(());
        }
        if let Some(element) = self.stop_that_lifts(run) {
            return self.lift(run, element);
        }
        self.set_active(run);
        let touched = run.touched.take();
        let remaining = end - run.time;
        let mut aim = self.first_aim(run, touched, remaining);
        for _ in 0..MAX_TRIES {
            // Half the way to a release may lie behind the end of the stretch.
            aim.length = self.up_to_hidden_turn(run, touched, aim.length.min(remaining));
            if aim.length < 1e-16 * end || aim.length.is_nan() {
                break;
            }
            match self.try_step(run, touched, &aim, remaining) {
                Tried::Again(next) => aim = next,
                Tried::ClosesNow(touch) => {
                    return self.close(run, touch);
                }
                Tried::Accepted { error, event } => {
                    self.accept(run, end, error);
                    return self.happen(run, event);
                }
            }
        }
        Err(self.given_up(run, aim.length, remaining))
    }

    /// Opens contacts that have left the stop within rounding; true if no force acts any more.
    fn open_what_leaves(&self, run: &mut Run, pressed: Option<usize>) -> bool {
        for element in 0..self.laws.len() {
            let Some(contact) = self.closed_contact(run, element) else { continue };
            if run.touched == Some(element) || pressed == Some(element) {
                continue;
            }
            let start = run.start[element];
            let jet = clearance_of(start.jet, contact.level, contact.sign);
            if self.laws[element].has_pressure() && self.has_parted(run, element) {
                run.parted[element] = run.closed[element].take();
            } else if jet.value >= -run.slack * jet.slope - start.margin && self.rises(run, element, contact)
            {
                run.closed[element] = None;
            }
        }
        !self.forces_act(run)
    }

    /// Whether the clearance of a closed contact grows; of a speed that is rounding the acceleration tells.
    fn rises(&self, run: &Run, element: usize, contact: Contact) -> bool {
        let start = run.start[element];
        let clearance = |jet| clearance_of(jet, contact.level, contact.sign);
        let speed = clearance(start.jet).slope;
        let is_rounding = speed <= AT_REST * start.velocity;
        speed > 0.0 && (!is_rounding || clearance(self.element_jet_with_forces(run, element)).curvature > 0.0)
    }

    /// Whether the pressure of a closed contact has vanished within rounding, and falls; or is missing, as
    /// after an impact elsewhere.
    fn has_parted(&self, run: &Run, element: usize) -> bool {
        let Some(contact) = run.closed[element] else { return false };
        let touch = Touch { element, contact, boundary: Boundary::Presses };
        let mut jet = run.start[element].jet;
        for other in (0..self.laws.len()).filter(|&e| self.acts(run, e)) {
            let force = hole::force_of(&self.laws, other, |e| run.start[e].output);
            jet.curvature += self.mobility[element][other] * force.value;
        }
        let missing = self.distance(jet, touch);
        let elastic = ClearanceBounds { second: 0.0, third: 0.0, margin: run.start[element].margin };
        let margin = self.boundary_bounds(elastic, &run.state, touch).margin;
        missing.value > margin || missing.slope > 0.0 && missing.value >= -run.slack * missing.slope - margin
    }

    pub(super) fn closed_contact(&self, run: &Run, element: usize) -> Option<Contact> {
        run.closed[element].map(|contact| self.laws[element].contacts()[contact])
    }

    pub(super) fn set_active(&mut self, run: &Run) {
        self.step.start_anew();
        for element in 0..self.laws.len() {
            if self.acts(run, element) {
                if self.laws[element].round_hole().is_some() {
                    self.step.holes.push(self.step.active.len());
                }
                self.step.active.push(element);
            }
        }
        let step = &mut self.step;
        step.damped = step.active.iter().any(|&e| self.laws[e].depends_on_velocity());
        if step.damped || step.has_holes() {
            step.coinciding.part(step.active.len());
        } else {
            step.coinciding.set(&step.active, &self.outputs, &self.inputs);
        }
    }

    /// How a step is graded; a step from a touch that ends with a release cannot be.
    pub(super) fn grading(&self, run: &Run, touched: Option<usize>, event: Option<Event>) -> Option<Grading> {
        let half_integer = |element: usize| {
            self.closed_contact(run, element).is_some_and(|contact| contact.onset_exponent.fract() != 0.0)
        };
        let from_touch = touched.is_some_and(half_integer);
        let to_release = matches!(event, Some(Event::Release(element)) if half_integer(element));
        match (from_touch, to_release) {
            (false, false) => Some(Grading::Smooth),
            (true, false) => Some(Grading::Touch),
            (false, true) => Some(Grading::Release),
            (true, true) => None,
        }
    }

    fn try_step(&mut self, run: &mut Run, touched: Option<usize>, aim: &Aim, remaining: f64) -> Tried {
        let free = |length: f64| Tried::Again(Aim::free(length));
        let to = |event: Event, length: f64| Tried::Again(Aim::to(event, length));
        let Some(grading) = self.grading(run, touched, aim.event) else { return free(aim.otherwise) };
        let solved = match aim.event {
            Some(event) => self.locate(run, event, grading, aim.length, remaining),
            None => self.attempt(run, aim.length, grading).map(|error| Solved {
                error,
                at_event: false,
                length: self.step.length,
            }),
        };
        let Some(Solved { error, at_event, length }) = solved else {
            run.release = None;
            let length = if aim.event.is_some() { aim.otherwise } else { 0.5 * self.step.length };
            return Tried::Again(aim.without_event(length));
        };
        let event = aim.event.filter(|_| at_event);
        let (release, polynomials) = match event {
            Some(end @ (Event::Release(_) | Event::Part(_) | Event::Lift(_))) => (Some((end, length)), None),
            _ => {
                let found = self.first_release(run, None, &[]);
                (found, Some(found))
            }
        };
        if error > 1.0 {
            let shorter = length * self.growth(error).clamp(0.1, MOST_KEPT);
            let Some((end, time)) = release else { return free(shorter) };
            // Where the step passed the release its error says little.
            let news = run.release.is_none();
            run.release = Some((end, run.time + time));
            let whole = news && self.grading(run, touched, Some(end)).is_some();
            if whole && event.is_none() {
                return to(end, time);
            }
            return free(if event.is_some() { 0.5 * time } else { shorter.min(0.5 * time) });
        }
        if event.is_none()
            && !aim.settled
            && let Some((opening, time)) = self.opening_at_end(run)
        {
            run.release = Some((opening, run.time + time));
            let whole = self.grading(run, touched, Some(opening)).is_some();
            return if whole {
                Tried::Again(Aim::to_opening(opening, time, length))
            } else {
                free(0.5 * time)
            };
        }
        if let Some(shorter) = self.up_to_uncertain_bottom(run, event) {
            return free(shorter);
        }
        // One that was located behind the stretch is not looked for again where the search for it went out
        // from.
        let refuted = (aim.event.is_some() && !at_event).then(|| aim.refuted(length));
        let aim = refuted.as_ref().unwrap_or(aim);
        let Ok(earlier) = self.earlier_event(run, aim, (event, length), polynomials) else {
            // Undecided: in a shorter step the search goes further.
            return free(0.5 * length);
        };
        if let Some((earlier, time)) = earlier {
            if let Event::Touch(touch) = earlier
                && time <= 1e-12 * length
            {
                return Tried::ClosesNow(touch);
            }
            return Tried::Again(aim.rather(earlier, time, event, length));
        }
        if event.is_none()
            && let Some(shorter) = self.hidden_turn_at_end(run)
        {
            return free(shorter);
        }
        let error = error.max(self.sensitivity_error(run).unwrap_or(f64::INFINITY));
        if error <= 1.0
            && event.is_none()
            && let Some(shorter) = self.corner_beyond_end(run)
        {
            return free(shorter);
        }
        let accurate = (error > 1.0).then(|| length * self.growth(error).clamp(0.1, MOST_KEPT));
        if let Some(shorter) = accurate.or_else(|| self.shorter_for_volume(run)) {
            run.release = release.map(|(end, time)| (end, run.time + time)).or(run.release);
            return free(shorter);
        }
        Tried::Accepted { error, event }
    }

    /// An event that the polynomials find before the end of the solved step, and when, apart from those that
    /// were located to come later.
    ///
    /// * `polynomials`: the first release of all of them, where it was looked for.
    fn earlier_event(
        &mut self,
        run: &Run,
        aim: &Aim,
        (event, length): (Option<Event>, f64),
        polynomials: Option<Option<(Event, f64)>>,
    ) -> Result<Option<(Event, f64)>, Unresolved> {
        let mut excused = Vec::new();
        loop {
            let release = polynomials.filter(|_| excused.is_empty());
            let found = self.first_in_step(run, event, &excused, release)?;
            let Some((earlier, time)) = found.filter(|found| found.1 < length * (1.0 - SAME)) else {
                return Ok(None);
            };
            let undecided = self.located_within(run, earlier);
            if !aim.was_later(earlier, time, (length, undecided)) {
                return Ok(Some((earlier, time)));
            }
            // What is not looked for any more was the first: there may be another one behind it.
            excused.push(earlier);
        }
    }

    /// The first touch, else the first release, in the solved step that ends with `event`, other than those
    /// `excused`. Where the polynomials through the nodes show none there is one only if the proof of
    /// `enclosure.rs` fails.
    ///
    /// * `release`: the first release, where it is known.
    fn first_in_step(
        &mut self,
        run: &Run,
        event: Option<Event>,
        excused: &[Event],
        release: Option<Option<(Event, f64)>>,
    ) -> Result<Option<(Event, f64)>, Unresolved> {
        let length = self.step.length;
        let touch = self.first_touch_in_step(run, event, excused)?;
        let touch = touch.filter(|(_, time)| *time < length * (1.0 - SAME));
        if let Some((touch, time)) = touch {
            return Ok(Some((Event::Touch(touch), time)));
        }
        match release.unwrap_or_else(|| self.first_release(run, event, excused)) {
            Some(release) => Ok(Some(release)),
            None => self.first_opening_in_step(run, event, excused),
        }
    }

    /// Opens or closes the contact that ended a step.
    fn happen(&mut self, run: &mut Run, event: Option<Event>) -> Result<(), MotionError> {
        run.slack = 0.0;
        match event {
            None => {}
            Some(Event::Touch(touch)) => self.close(run, touch)?,
            Some(Event::Release(element)) => {
                run.closed[element] = None;
                run.slack = 1e-7 * self.step.length;
            }
            Some(Event::Part(element)) => {
                run.parted[element] = run.closed[element].take();
                run.slack = 1e-7 * self.step.length;
            }
            Some(Event::Lift(element)) => {
                run.release = None;
                self.lift(run, element)?;
            }
        }
        Ok(())
    }

    /// Adds what rounding leaves unknown behind the solved step (`rounding.rs`).
    fn count_rounding(&mut self, run: &Run) {
        for (a, &element) in self.step.active.iter().enumerate() {
            if !self.laws[element].contacts().is_empty() {
                let known = (self.mobility[element][element], run.start[element].margin / MARGIN);
                let nodes = a * NODES..(a + 1) * NODES;
                let of_step = (&self.step.force[nodes.clone()], &self.step.slope[nodes]);
                let added = rounding::of_contact(self.step.length, of_step, known);
                self.rounding = self.rounding.hypot(added);
            }
        }
    }

    /// Moves the run to the end of the solved step.
    fn accept(&mut self, run: &mut Run, end: f64, error: f64) {
        let length = self.step.length;
        if self.step.weights.propagators.is_empty() {
            Arc::make_mut(&mut self.step.weights).set_propagators(&self.blocks, length);
        }
        if let Some(sensitivity) = &mut run.sensitivity {
            self.step.advance_sensitivity(sensitivity, self.parameter);
            self.count_contraction(sensitivity);
            self.count_rounding(run);
            let states = 2 * self.blocks.count();
            self.counts.operations += (self.step.active.len() * NODES * states * states) as u64;
        }
        self.counts.steps += 1;
        if self.notes_course {
            let impulses = self.pressing_impulses(&run.state);
            self.course.step(run, &self.step, &self.laws, &impulses);
        }
        self.trace_step(run);
        self.step.advance_state(&self.series, &mut run.state);
        self.step.known_ends.clear();
        run.time += length;
        if end - run.time <= 4.0 * f64::EPSILON * end {
            run.time = end;
        }
        self.plan_next(run, length, error);
    }
}
