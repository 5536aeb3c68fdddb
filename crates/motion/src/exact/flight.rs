//! Free flight: no force acts, the motion is closed form, and the first contact is found with proof.

use super::{
    ExactIntegrator, MotionError,
    clearance::{ClearanceBounds, Convex, Look, decide_convex, look},
    drive::Jet,
    hole::{OutputBounds, reading_bounds},
    run::Run,
};
use crate::Law;

/// A contact that crosses one of its boundaries, most of them without force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    pub element: usize,
    pub contact: usize,
    pub boundary: Boundary,
}

/// Where such a contact goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// It was open and closes.
    Closes,
    /// It had parted and presses again.
    Presses,
    /// It had parted and opens.
    Leaves,
    /// It was held on a rigid stop, and its pressing force ends.
    Lifts,
    /// It is closed and comes to a kink of its force, with more penetration or with less.
    Kink { deeper: bool },
}

/// What an output can reach over a time ahead: bounds on its second and third derivative, and the sum of the
/// magnitudes of its terms, which bounds it, and is what rounds.
struct OutputReach {
    second: f64,
    third: f64,
    magnitude: f64,
}

/// Rounding margins, in roundings of what they are of.
pub(super) const MARGIN: f64 = 8.0;

/// Largest part of a clearance that fast blocks may be for a look to leave their course aside.
const FAST_SHARE: f64 = 0.2;

/// Looks allowed in one flight; about ten are usual.
const MAX_LOOKS: usize = 100_000;

impl ExactIntegrator {
    /// Flies until the first contact or until `end`; the state of `run` is moved there.
    pub(super) fn fly(&mut self, run: &mut Run, end: f64) -> Result<Option<Touch>, MotionError> {
        self.flight_start.clear();
        self.flight_start.extend_from_slice(&run.state);
        let horizon = end - run.time;
        let mut time = if self.has_contacts { 0.0 } else { horizon };
        let mut touch = None;
        let mut placed = false;
        if self.has_contacts {
            let mut looks = 0;
            while time < horizon && touch.is_none() {
                looks += 1;
                if looks > MAX_LOOKS {
                    return Err(MotionError::FlightStalled { time: run.time + time });
                }
                self.counts.looks += 1;
                self.counts.operations += (2 * self.blocks.count() * self.laws.len()) as u64;
                self.place(run, time);
                let (step, found) = self.look_at_all(run, time, horizon);
                touch = found;
                placed = step == 0.0;
                time = (time + step).min(horizon);
            }
        }
        if horizon - time <= 4.0 * f64::EPSILON * end {
            // A contact that closes with the end of the stretch belongs to the next one.
            touch = None;
            placed &= time == horizon;
            time = horizon;
        }
        if !placed {
            self.place(run, time);
        }
        if self.notes_course {
            let impulses = self.held_impulses(&self.flight_start, run.time, time);
            self.course.flight(run, time, &self.flight_start, &impulses);
        }
        self.trace_flight(run, time);
        run.time = if touch.is_none() { end } else { run.time + time };
        if let Some(sensitivity) = &mut run.sensitivity {
            self.blocks.propagators(time, &mut self.propagators);
            sensitivity.propagate(&self.propagators);
            self.add_damped_flight(time, &self.flight_start, sensitivity);
        }
        Ok(touch)
    }

    /// Puts the state of `run` to `time` after the start of the flight.
    fn place(&self, run: &mut Run, time: f64) {
        self.blocks.fly(&self.flight_start, time, &mut run.state);
    }

    /// A time that is free of contact, counted from now, and the contact that closes at its end, if any.
    fn look_at_all(&self, run: &mut Run, time: f64, horizon: f64) -> (f64, Option<Touch>) {
        let mut free = f64::INFINITY;
        let mut touch = None;
        for element in 0..self.laws.len() {
            if self.laws[element].contacts().is_empty() {
                continue;
            }
            if self.has_rigid_stops && self.is_looked_past(run, element, time, &mut free) {
                continue;
            }
            let parted = run.parted[element];
            let held = self.has_rigid_stops && self.held_place(run, element).is_some();
            let watched = if held { self.watched_output(run, element, Boundary::Lifts) } else { element };
            let jet = self.element_jet(&run.state, watched, run.time + time);
            let span = (run.time + time, run.time + horizon);
            let elastic = self.element_bounds(&run.state, watched, span);
            for touching in self.watched(element, parted) {
                let boundary = if held { Boundary::Lifts } else { touching.boundary };
                let touching = Touch { boundary, ..touching };
                let bounds = self.boundary_bounds(elastic, &run.state, touching);
                let clearance = self.distance(jet, touching);
                let known = (clearance.value, bounds.third);
                let below = || self.below_without_fast_blocks(&run.state, (watched, touching), known, span);
                let (step, hit) = match look(clearance, bounds, below) {
                    Look::Contact => return (0.0, Some(touching)),
                    Look::FreeFor(step) => (step, false),
                    Look::MinimumAhead { at, convex } => {
                        let convex = convex.min(horizon - time);
                        let ahead = |ahead: f64| self.clearance_ahead(run, time + ahead, (watched, touching));
                        let found = decide_convex(ahead, (at, convex), time, bounds.margin);
                        // The other elements are looked at from here.
                        self.place(run, time);
                        match found {
                            Convex::Free => (convex, false),
                            Convex::ContactAt(step) => (step, true),
                        }
                    }
                };
                if step < free {
                    (free, touch) = (step, hit.then_some(touching));
                }
            }
        }
        (free, touch)
    }

    /// A function below the distance that falls to zero at a boundary in flight, and its bounds: the slow
    /// blocks' and the loads' part of it, less all that the other blocks can be. `None` where these fast
    /// blocks have less than half of the bound on the third derivative.
    ///
    /// * `distance`, `third`: the distance now, and that bound.
    pub(super) fn below_without_fast_blocks(
        &self,
        state: &[f64],
        (output, touch): (usize, Touch),
        (distance, third): (f64, f64),
        (now, until): (f64, f64),
    ) -> Option<(Jet, ClearanceBounds)> {
        if touch.boundary == Boundary::Presses || self.laws[touch.element].round_hole().is_some() {
            return None;
        }
        let (n, index, output) = (self.blocks.count(), output, &self.outputs[output]);
        let (mut slow, mut bounds, mut fast) = (Jet::default(), self.drive.bounds(index, output, until), 0.0);
        for i in (0..n).rev() {
            let norm = self.energy_norm(state, i);
            let most = output.value_bound[i] * norm;
            if self.blocks.stiffness[i] > 0.0 && fast + most <= FAST_SHARE * distance {
                fast += most;
                continue;
            }
            let (p, s) = (state[i], state[n + i]);
            slow.value += output.row[i] * p + output.row[n + i] * s;
            slow.slope += output.velocity_row[i] * p + output.velocity_row[n + i] * s;
            slow.curvature += output.acceleration_row[i] * p + output.acceleration_row[n + i] * s;
            bounds.0 += output.second_bound[i] * norm;
            bounds.1 += output.third_bound[i] * norm;
        }
        if bounds.1 > 0.5 * third {
            return None;
        }
        let driven = self.drive.jet(index, output, now);
        slow.value += driven.value;
        slow.slope += driven.slope;
        slow.curvature += driven.curvature;
        let slow = self.distance(slow, touch);
        let below = Jet { value: slow.value - fast, ..slow };
        Some((below, ClearanceBounds { second: bounds.0, third: bounds.1, margin: 0.0 }))
    }

    /// Whether an element has just left its rigid stop, so that rounding would decide on its clearance;
    /// `free` ends with that time.
    fn is_looked_past(&self, run: &Run, element: usize, time: f64, free: &mut f64) -> bool {
        let further = self.looked_past(run, element) - time;
        if further > 0.0 {
            *free = free.min(further);
        }
        further > 0.0
    }

    /// Clearance at `time` after the start of the flight, from the output that tells it; the state of `run`
    /// is moved there.
    fn clearance_ahead(&self, run: &mut Run, time: f64, (output, touch): (usize, Touch)) -> Jet {
        self.place(run, time);
        self.distance(self.element_jet(&run.state, output, run.time + time), touch)
    }

    /// The boundaries of an element without force: of its open contacts, or of the one that has parted.
    pub(super) fn watched(
        &self,
        element: usize,
        parted: Option<usize>,
    ) -> impl Iterator<Item = Touch> + use<> {
        let open = 0..if parted.is_none() { self.laws[element].contacts().len() } else { 0 };
        let closing = open.map(move |contact| Touch { element, contact, boundary: Boundary::Closes });
        let both = [Boundary::Presses, Boundary::Leaves];
        closing.chain(
            parted
                .into_iter()
                .flat_map(move |contact| both.map(move |boundary| Touch { element, contact, boundary })),
        )
    }

    /// What falls to zero at a boundary, from the relative displacement: the clearance, the missing pressure
    /// (whose second derivative is not known, only bounded), or the penetration.
    pub(super) fn distance(&self, displacement: Jet, touch: Touch) -> Jet {
        if touch.boundary == Boundary::Lifts {
            return displacement;
        }
        let law = &self.laws[touch.element];
        let c = law.contacts()[touch.contact];
        if let Boundary::Kink { deeper } = touch.boundary {
            let towards = if deeper { c.sign } else { -c.sign };
            let level = law.kinks()[usize::from(deeper)].unwrap_or(f64::NAN);
            return clearance_of(displacement, level, towards);
        }
        let clearance = clearance_of(displacement, c.level, c.sign);
        let penetration = clearance_of(clearance, 0.0, 1.0);
        match (touch.boundary, law.pressure()) {
            (Boundary::Closes, _) => clearance,
            (Boundary::Presses, Some(pressure)) => Jet {
                value: -pressure.at(penetration.value, penetration.slope),
                slope: -(pressure.displacement * penetration.slope
                    + pressure.velocity * penetration.curvature),
                curvature: f64::NEG_INFINITY,
            },
            _ => penetration,
        }
    }

    /// Bounds on what falls to zero at a boundary, from those on the displacement: `|s''| <= a B_2 + b B_3`
    /// for the pressure `s = a p + b p' + d`.
    pub(super) fn boundary_bounds(
        &self,
        elastic: ClearanceBounds,
        state: &[f64],
        touch: Touch,
    ) -> ClearanceBounds {
        let Some(pressure) =
            self.laws[touch.element].pressure().filter(|_| touch.boundary == Boundary::Presses)
        else {
            return elastic;
        };
        let rounding = self.velocity_rounding(state, touch.element);
        ClearanceBounds {
            second: pressure.displacement * elastic.second + pressure.velocity * elastic.third,
            third: 0.0,
            margin: pressure.displacement * elastic.margin
                + pressure.velocity * rounding
                + MARGIN * f64::EPSILON * pressure.offset,
        }
    }

    /// Rounding margin of the velocity of an output, from the homogeneous state now.
    pub(super) fn velocity_rounding(&self, state: &[f64], output: usize) -> f64 {
        let secular = self.drive.secular_speed(&self.outputs[output], self.stretch.duration());
        MARGIN * f64::EPSILON * (self.speed_bound(state, output) + secular)
    }

    /// Bounds on a clearance of `element`, of a hole on its reading, over a time ahead from the homogeneous
    /// state now.
    pub(super) fn element_bounds(
        &self,
        state: &[f64],
        element: usize,
        (now, until): (f64, f64),
    ) -> ClearanceBounds {
        let Some(hole) = self.laws.get(element).and_then(Law::round_hole) else {
            return self.bounds(state, element, until);
        };
        let both = [element, element + 1];
        let jets = both.map(|output| self.output_jet(state, output, now));
        let bounds = both.map(|output| {
            let OutputReach { second, third, magnitude } = self.reach(state, output, until);
            let first =
                self.speed_bound(state, output) + self.drive.secular_speed(&self.outputs[output], until);
            OutputBounds { value: magnitude, first, second, third, margin: MARGIN * f64::EPSILON * magnitude }
        });
        reading_bounds(hole, jets, bounds, until - now)
    }

    /// Bounds on a clearance of `element` until `until`, from the homogeneous state now.
    pub(super) fn bounds(&self, state: &[f64], element: usize, until: f64) -> ClearanceBounds {
        let OutputReach { second, third, magnitude } = self.reach(state, element, until);
        // The pressing forces, after the elements, have no level.
        let law = self.laws.get(element);
        let levels = law.map_or(&[][..], |law| law.contacts()).iter().map(|c| c.level);
        let kinks = law.map_or([None; 2], Law::kinks).into_iter().flatten();
        let level = levels.chain(kinks).map(f64::abs).fold(0.0, f64::max);
        ClearanceBounds { second, third, margin: MARGIN * f64::EPSILON * (magnitude + level) }
    }

    /// What an output can reach until `until`, from the homogeneous state now.
    fn reach(&self, state: &[f64], output: usize, until: f64) -> OutputReach {
        let (index, output) = (output, &self.outputs[output]);
        let n = self.blocks.count();
        let (mut second, mut third) = self.drive.bounds(index, output, until);
        let mut magnitude = self.drive.magnitude(index) + self.drive.secular_magnitude(output, until);
        for i in 0..n {
            let (p, s) = (state[i], state[n + i]);
            let norm = self.energy_norm(state, i);
            second += output.second_bound[i] * norm;
            third += output.third_bound[i] * norm;
            // What rounds is what the sum is made of, also where it passes through zero.
            magnitude += (output.row[i] * p).abs().max(output.value_bound[i] * norm);
            if self.blocks.stiffness[i] == 0.0 {
                magnitude += (output.row[i] * s).abs() * until;
            }
        }
        OutputReach { second, third, magnitude }
    }
}

/// Clearance of a contact from the relative displacement.
pub(crate) fn clearance_of(displacement: Jet, level: f64, sign: f64) -> Jet {
    Jet {
        value: -sign * (displacement.value - level),
        slope: -sign * displacement.slope,
        curvature: -sign * displacement.curvature,
    }
}
