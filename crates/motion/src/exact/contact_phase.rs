//! Steps while forces act, with control of their error.
//!
//! Over a step the force `F` and its slope `f'` of each active element are expanded in the orthonormal polynomials of the step. With
//! `|F|_tail` and `|f'|_tail` the two highest coefficients added, `G = C A B` the mobility, and `D`, `V` the ranges of the relative displacement
//! and velocity that the present state can reach, the step is accepted if
//!
//! `h G (|F|_tail + D |f'|_tail) / V <= 10 sqrt(tolerance)`.
//!
//! The left side is the relative error of the collocation polynomial; at the end of the step, on Gauss nodes, state and
//! sensitivities have about its square.

use super::{
    ExactIntegrator, MotionError,
    clearance::{Look, look},
    collocation::{Grading, NODES},
    drive::Jet,
    flight::{Touch, clearance_of},
    release::ReleaseStep,
    run::Run,
    weights::StepWeights,
};
use crate::Contact;

/// Power of the step length with which the error of a step falls.
const TAIL_ORDER: f64 = NODES as f64 - 1.5;
/// A step that ends at the release is tried if the release is expected within this many proposed steps.
const RELEASE_REACH: f64 = 3.0;
/// Other steps go at most this part of the way to the expected release.
const SMOOTH_REACH: f64 = 0.6;
/// Relative tail of a step of half a contact from the touch on, for the first guess of the length.
const HALF_CONTACT_TAIL: f64 = 0.02;
/// Looks at an open contact within one force step.
const MAX_LOOKS: usize = 1000;

impl ExactIntegrator {
    /// Takes one accepted step with forces, up to a release, a touch, the end of the stretch, or as far as the error allows.
    pub(super) fn contact_phase(&mut self, run: &mut Run, end: f64) -> Result<(), MotionError> {
        if self.open_what_leaves(run, end) {
            return Ok(());
        }
        self.set_active(run);
        let touched = run.touched.take();
        let grading = self.first_grading(run, touched);
        let remaining = end - run.time;
        let expected = self.expected_release(run);
        if let Some((element, time)) = expected
            && (run.proposal == 0.0 || time <= RELEASE_REACH * run.proposal)
            && let ReleaseStep::Solved(error) = self.release(run, element, time, grading, remaining)
            && self.first_touch_in_step(run).is_none()
        {
            self.accept(run, end, error)?;
            run.closed[element] = None;
            return Ok(());
        }
        let mut length = if run.proposal > 0.0 { run.proposal } else { self.first_length(run, touched, remaining) };
        if let Some((_, time)) = expected {
            // A smooth step keeps away from the half-integer power at the release.
            length = length.min(SMOOTH_REACH * time);
        }
        loop {
            length = length.min(remaining);
            if length < 1e-16 * end || length.is_nan() {
                return Err(MotionError::StepTooShort { time: run.time, step: length });
            }
            let Some(error) = self.attempt(run, length, grading) else {
                length *= 0.25;
                continue;
            };
            if error > 1.0 {
                length = self.step.weights.length * (0.9 * error.powf(-1.0 / TAIL_ORDER)).clamp(0.1, 0.8);
                continue;
            }
            if let Some(touch) = self.first_touch_in_step(run) {
                if touch.1 < self.step.weights.length * (1.0 - 1e-12) && touch.1 > 0.0 {
                    length = touch.1;
                    continue;
                }
                self.accept(run, end, error)?;
                self.close(run, touch.0);
                return Ok(());
            }
            match self.first_release(run) {
                None => return self.accept(run, end, error),
                Some((element, time)) => match self.release(run, element, time, grading, remaining) {
                    ReleaseStep::Solved(error) => {
                        self.accept(run, end, error)?;
                        run.closed[element] = None;
                        return Ok(());
                    }
                    ReleaseStep::Shorter(shorter) => length = shorter,
                },
            }
        }
    }

    /// Opens contacts that have left the stop within rounding; true if no force acts any more.
    fn open_what_leaves(&self, run: &mut Run, end: f64) -> bool {
        for element in 0..self.laws.len() {
            let Some(contact) = self.closed_contact(run, element) else { continue };
            if run.touched == Some(element) {
                continue;
            }
            let jet = clearance_of(self.output_jet(run, element, run.time), contact.level, contact.sign);
            if jet.slope > 0.0 && jet.value >= -self.bounds(run, element, end).margin {
                run.closed[element] = None;
            }
        }
        !self.forces_act(run)
    }

    pub(super) fn closed_contact(&self, run: &Run, element: usize) -> Option<Contact> {
        run.closed[element].map(|contact| self.laws[element].contacts()[contact])
    }

    fn set_active(&mut self, run: &Run) {
        self.step.active.clear();
        let active = (0..self.laws.len()).filter(|&e| run.closed[e].is_some() || self.laws[e].contacts().is_empty());
        self.step.active.extend(active);
    }

    fn first_grading(&self, run: &Run, touched: Option<usize>) -> Grading {
        match touched.and_then(|element| self.closed_contact(run, element)) {
            Some(contact) if contact.onset_exponent.fract() != 0.0 => Grading::Touch,
            _ => Grading::Smooth,
        }
    }

    /// A first guess of the step length: half a contact after a touch, else a part of the period of the loaded contact.
    fn first_length(&self, run: &Run, touched: Option<usize>, remaining: f64) -> f64 {
        if let Some(element) = touched {
            let share = (0.5 * self.largest_tail() / HALF_CONTACT_TAIL).powf(1.0 / TAIL_ORDER).min(1.0);
            return (share * self.half_contact(run, element)).min(remaining);
        }
        let stiffest = |&e: &usize| {
            let slope = self.laws[e].force(self.output_jet(run, e, run.time).value).slope;
            (self.mobility[e][e] * slope.abs()).sqrt()
        };
        let rate = self.step.active.iter().map(stiffest).fold(8.0 / remaining, f64::max);
        0.5 / rate
    }

    /// About half the duration of a contact that has just closed.
    ///
    /// With the speed v and `f = K p^e`, energy gives the depth `p = ((e + 1)/2 v^2/(K G))^(1/(e+1))`, the duration about `1.5 p/v`;
    /// a soft touch is turned by the free acceleration a after `v/a`.
    fn half_contact(&self, run: &Run, element: usize) -> f64 {
        let Some(contact) = self.closed_contact(run, element) else { return f64::INFINITY };
        let jet = clearance_of(self.output_jet(run, element, run.time), contact.level, contact.sign);
        let (speed, exponent, probe) = (-jet.slope, contact.onset_exponent, 1e-6);
        let force = self.laws[element].force(contact.level + contact.sign * probe).value.abs();
        let coefficient = force / probe.powf(exponent) * self.mobility[element][element];
        let depth = (0.5 * (exponent + 1.0) * speed * speed / coefficient).powf(1.0 / (exponent + 1.0));
        let stopped = 1.5 * depth / speed;
        let turned = if jet.curvature > 0.0 { speed / jet.curvature } else { f64::INFINITY };
        if stopped > 0.0 { stopped.min(turned) } else { 1e-3 / self.series.reach().recip() }
    }

    /// Solves a step of about `length` (shorter where the lengths are discrete); its error relative to the tolerance.
    pub(super) fn attempt(&mut self, run: &Run, length: f64, grading: Grading) -> Option<f64> {
        self.counts.solves += 1;
        self.set_weights(length, grading);
        let step = &mut self.step;
        step.grading = Some(grading);
        step.start = run.time;
        step.set_free_motion(&self.series, &self.drive, &self.outputs, &run.state);
        self.guess(run);
        let scale = self.step.active.iter().map(|&e| self.ranges(run, e).0).fold(0.0, f64::max);
        self.step.solve(&self.laws, 8.0 * f64::EPSILON * scale).ok()?;
        if self.step.weights.complete {
            self.set_next_state(run);
        }
        Some(self.error(run))
    }

    /// State at the end of the solved step.
    fn set_next_state(&mut self, run: &Run) {
        self.next_state.clear();
        self.next_state.extend_from_slice(&run.state);
        self.step.advance_state(&self.blocks, &mut self.next_state);
    }

    fn set_weights(&mut self, length: f64, grading: Grading) {
        let Self { blocks, series, step, cache, outputs, inputs, .. } = self;
        if length <= series.reach() {
            return series.prepare(&step.active, grading, length, &mut step.weights);
        }
        let exponent = length.log2().floor() as i32;
        let length = 2f64.powi(exponent);
        if length <= series.reach() {
            return series.prepare(&step.active, grading, length, &mut step.weights);
        }
        let make = || StepWeights::by_quadrature(blocks, outputs, inputs, &step.active, grading, length);
        step.weights.clone_from(cache.entry((step.active.clone(), grading, exponent)).or_insert_with(make));
    }

    /// First guess of the displacements: the present motion continued.
    fn guess(&mut self, run: &Run) {
        self.step.displacement.clear();
        for a in 0..self.step.active.len() {
            let element = self.step.active[a];
            let mut jet = self.output_jet(run, element, run.time);
            for &other in &self.step.active {
                let displacement = self.output_jet(run, other, run.time).value;
                jet.curvature += self.mobility[element][other] * self.laws[other].force(displacement).value;
            }
            for k in 0..NODES {
                let t = self.step.node_time(k);
                self.step.displacement.push(jet.value + t * (jet.slope + 0.5 * t * jet.curvature));
            }
        }
    }

    /// Ranges of displacement and velocity that an output can reach from the present state.
    fn ranges(&self, run: &Run, output: usize) -> (f64, f64) {
        let (n, o) = (self.blocks.count(), &self.outputs[output]);
        let magnitude = self.drive.magnitude(output);
        let (mut displacement, mut velocity) = (magnitude, magnitude * self.drive.circular_frequency());
        for i in 0..n {
            let (p, s) = (run.state[i], run.state[n + i]);
            let norm = (self.blocks.stiffness[i] * p * p + s * s).sqrt();
            displacement += (o.row[i] * p).abs().max(o.value_bound[i] * norm);
            velocity += o.first_bound[i] * norm;
        }
        (displacement, velocity)
    }

    /// Error of the solved step by the formula of the file header, relative to its bound.
    fn error(&self, run: &Run) -> f64 {
        let step = &self.step;
        let of_element = |a: usize| {
            let element = step.active[a];
            let (displacement, velocity) = self.ranges(run, element);
            let tail = step.tail(&step.force, a) + displacement * step.tail(&step.slope, a);
            step.weights.length * self.mobility[element][element] * tail / velocity.max(f64::MIN_POSITIVE)
        };
        let largest = (0..step.active.len()).map(of_element).fold(0.0, f64::max);
        largest / self.largest_tail()
    }

    /// The bound of the file header.
    fn largest_tail(&self) -> f64 {
        10.0 * self.settings.tolerance.sqrt()
    }

    /// Moves the run to the end of the solved step.
    fn accept(&mut self, run: &mut Run, end: f64, error: f64) -> Result<(), MotionError> {
        let length = self.step.weights.length;
        if !self.step.weights.complete {
            let grading = self.step.grading();
            self.series.complete(&self.blocks, &self.step.active, grading, &mut self.step.weights);
            self.set_next_state(run);
        }
        if let Some(sensitivity) = &mut run.sensitivity {
            let done = self.step.advance_sensitivity(&self.drive, &self.outputs, sensitivity);
            done.map_err(|_| MotionError::StepTooShort { time: run.time, step: length })?;
        }
        self.counts.steps += 1;
        if let Some(mut observation) = self.observation.take() {
            self.observe_step(run, &mut observation);
            self.observation = Some(observation);
        }
        run.state.copy_from_slice(&self.next_state);
        run.time += length;
        if end - run.time <= 4.0 * f64::EPSILON * end {
            run.time = end;
        }
        run.proposal = length * (0.9 * error.powf(-1.0 / TAIL_ORDER)).clamp(0.3, 4.0);
        Ok(())
    }

    /// Jet of the displacement of the a-th active element at the end of the solved step, apart from the direct part of the forces.
    pub(super) fn jet_at_step_end(&self, a: usize) -> Jet {
        self.step.end_jet(a, &self.series, &self.drive, &self.outputs, &self.next_state)
    }

    /// The first open contact that closes within the solved step, and when.
    fn first_touch_in_step(&self, run: &Run) -> Option<(Touch, f64)> {
        let mut first: Option<(Touch, f64)> = None;
        for element in 0..self.laws.len() {
            if run.closed[element].is_some() {
                continue;
            }
            for contact in 0..self.laws[element].contacts().len() {
                if let Some(time) = self.touch_in_step(run, element, contact)
                    && first.is_none_or(|(_, earlier)| time < earlier)
                {
                    first = Some((Touch { element, contact }, time));
                }
            }
        }
        first
    }

    /// When an open contact closes within the solved step, by the certified steps of a flight with the forces in the bound.
    fn touch_in_step(&self, run: &Run, element: usize, contact: usize) -> Option<f64> {
        let c = self.laws[element].contacts()[contact];
        let length = self.step.weights.length;
        let mut bounds = self.bounds(run, element, run.time + length);
        bounds.second += self.forced_bound(element);
        bounds.third = f64::INFINITY;
        let mut time = 0.0;
        let mut jet = self.output_jet(run, element, run.time);
        for _ in 0..MAX_LOOKS {
            let step = match look(clearance_of(jet, c.level, c.sign), bounds) {
                Look::Contact => return Some(time),
                Look::FreeFor(step) => step,
                Look::MinimumAhead { at, .. } => at,
            };
            // A touch too slow to resolve carries no force: pass it by.
            time += step.max(1e-9 * length);
            if time >= length {
                return None;
            }
            jet = self.jet_in_step(&run.state, element, time);
        }
        None
    }

    /// Bound on the relative acceleration that the forces of the step cause.
    fn forced_bound(&self, element: usize) -> f64 {
        let (n, step, output) = (self.blocks.count(), &self.step, &self.outputs[element]);
        let of_active = |a: usize| {
            let other = step.active[a];
            let nodal = step.force[a * NODES..(a + 1) * NODES].iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let input = &self.inputs[other];
            let energy = |i: usize| (self.blocks.stiffness[i] * input[i].powi(2) + input[n + i].powi(2)).sqrt();
            let later: f64 = (0..n).map(|i| output.second_bound[i] * energy(i)).sum();
            // Between Gauss nodes the polynomial exceeds them by little; twice is safe.
            2.0 * nodal * (self.mobility[element][other].abs() + step.weights.length * later)
        };
        (0..step.active.len()).map(of_active).sum()
    }
}
