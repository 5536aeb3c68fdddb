//! Maxima of an orbit on the continuous motion.
//!
//! They are taken from the course of the motion (`course.rs`). Flights are searched last (`flight_maximum.rs`). In a force step the displacement of the response and the force of each
//! element are taken as polynomials in the variable of the step, which tell where the largest value `r` is. They are not accurate enough for the
//! value itself: that is computed once more from the convolution `r(t) = C exp(A t) x + int C exp(A (t - s)) B F(s) ds + r_particular(t)`, at the time
//! where Newton's method finds `r'(t) = 0` for it, or at an end of the step. The force follows from it by its law, and so does the acceleration, at the
//! place of its own maximum.

use super::{
    ExactIntegrator, MotionError,
    collocation::{FINE, Grading, NODES},
    course::{Course, CourseStep, Passage},
    drive::Drive,
    flight_maximum::Flown,
    run::Run,
};
use crate::{Law, Stretch};

/// Maxima of a motion on the continuous motion, and its contacts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Maxima {
    /// Largest absolute displacement of the response point, `max |y|` [m].
    pub displacement: f64,
    /// Largest absolute acceleration of the response point, `max |y''|`, apart from the jumps of the velocity at impacts on rigid stops [m/s^2].
    pub acceleration: f64,
    /// Largest contact force over all elements with a contact [N]; impacts on rigid stops have none, stops that are stuck to have.
    pub contact_force: f64,
    /// Largest speed with which a contact closes [m/s].
    pub impact_velocity: f64,
    /// Sum of the impulses of all contacts [N s].
    pub impulse: f64,
    /// Energy that the structure has lost to all contacts [J], what is stored in them at the end included; 0 for laws that lose none.
    pub energy_lost: f64,
    /// Number of contacts that closed; on a rigid stop where chatter came to its end, how often it did.
    pub touches: u32,
    /// Elements that were closed all the time, one bit each (the first 64).
    pub closed_throughout: u64,
}

impl Maxima {
    /// Number of contacts: those that closed, and those that were closed throughout.
    #[must_use]
    pub fn contacts(&self) -> u32 {
        self.touches + self.closed_throughout.count_ones()
    }
}

/// What a course holds that can be among the maxima.
#[derive(Debug, Default)]
struct Observation {
    maxima: Maxima,
    flights: Vec<Flown>,
    /// Of the acceleration of the response,
    fastest: Peaks,
    /// of its displacement,
    farthest: Peaks,
    /// and of the force of elements with a contact.
    hardest: Peaks,
    /// Impacts on the rigid stop of each element, and how many of them stuck.
    impacts: Vec<[u32; 2]>,
}

/// Force steps that may hold the largest value.
#[derive(Debug, Clone, Default)]
struct Peaks {
    largest: f64,
    peaks: Vec<Peak>,
}

/// Relative difference of two values up to which their polynomials do not tell which is larger.
const ALIKE: f64 = 1e-5;

impl Peaks {
    /// Value that another one must exceed.
    fn bar(&self) -> f64 {
        (1.0 - ALIKE) * self.largest
    }

    fn note(&mut self, peak: Peak) {
        if peak.value > self.largest {
            self.largest = peak.value;
            let bar = self.bar();
            self.peaks.retain(|peak| peak.value >= bar);
        }
        self.peaks.push(peak);
    }
}

/// A force step with a large value of an output, as far as its polynomial tells.
#[derive(Debug, Clone)]
struct Peak {
    /// The stretch it is in.
    piece: usize,
    output: usize,
    /// The largest value, by the polynomial.
    value: f64,
    /// Where in the variable of the step.
    place: f64,
    grading: Grading,
    start: f64,
    length: f64,
    /// State at the start of the step.
    state: Vec<f64>,
    active: Vec<usize>,
    /// Laws of the active elements, with what they remember.
    laws: Vec<Law>,
    force: Vec<f64>,
}

/// Parabolas by which the largest value of a polynomial is closed in.
const PARABOLAS: usize = 6;
/// Steps of Newton's method to the place of a largest displacement.
const POLISHES: usize = 6;
/// So near to it, in parts of the step, a parabola gives the value: what is left is of third order, 1e-12 of the variation in the step.
const NEAR: f64 = 1e-4;
/// A polynomial through the nodes of a step exceeds its largest nodal value by less than this factor, as smooth as steps are.
const BETWEEN_NODES: f64 = 1.5;

impl ExactIntegrator {
    /// Maxima of a motion over stretches that follow one another, each from its own state, of the response point given at construction.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn observe(&mut self, motion: &[(Stretch, &[f64])]) -> Result<Maxima, MotionError> {
        let mut course = self.take_course(motion)?;
        let mut observation = Observation::default();
        observation.maxima.closed_throughout = if motion.is_empty() { 0 } else { u64::MAX };
        for piece in 0..course.stretches.len() {
            self.look_through(&course, piece, &mut observation);
        }
        std::mem::swap(&mut self.course, &mut course);
        self.exact_maxima(observation, motion)
    }

    /// From now on what happens is noted, so that [`ExactIntegrator::observe`] need not go through the same motion again.
    pub fn begin_course(&mut self) {
        self.course.clear();
        self.notes_course = true;
    }

    /// From now on nothing is noted; what was stays until the next course begins.
    pub fn end_course(&mut self) {
        self.notes_course = false;
    }

    /// The course of a motion, which is gone through where it was not gone through last.
    fn take_course(&mut self, motion: &[(Stretch, &[f64])]) -> Result<Course, MotionError> {
        if !self.course.is_of(motion) {
            self.begin_course();
            let advanced =
                motion.iter().try_for_each(|(stretch, state)| self.advance(stretch, state).map(|_| ()));
            self.end_course();
            if let Err(error) = advanced {
                self.course.clear();
                return Err(error);
            }
        }
        Ok(std::mem::take(&mut self.course))
    }

    /// Notes what happened in one stretch of a course.
    fn look_through(&mut self, course: &Course, piece: usize, observation: &mut Observation) {
        let passed = &course.stretches[piece];
        let end = course.stretches.get(piece + 1).map_or(course.passages.len(), |next| next.first_passage);
        self.drive = Drive::new(&self.system, &self.blocks, &self.outputs, &passed.stretch);
        observation.maxima.closed_throughout &= passed.closed;
        for passage in &course.passages[passed.first_passage..end] {
            match *passage {
                Passage::Flight { start, duration, state, held, impulses } => {
                    let (state, held) = (course.numbers(state).to_vec(), course.held(held).to_vec());
                    observation.maxima.closed_throughout &= bits(held.iter().copied());
                    observation.maxima.impulse += course.numbers(impulses).iter().sum::<f64>();
                    observation.flights.push(Flown { piece, start, duration, state, held });
                }
                Passage::Impact { element, impulse, energy, sticks } => {
                    observation.impacts.resize(self.laws.len(), [0; 2]);
                    observation.impacts[element][0] += 1;
                    observation.impacts[element][1] += u32::from(sticks);
                    observation.maxima.impulse += impulse;
                    observation.maxima.energy_lost += energy;
                }
                Passage::Touch { speed } => {
                    let maxima = &mut observation.maxima;
                    maxima.touches += 1;
                    maxima.impact_velocity = maxima.impact_velocity.max(speed.abs());
                }
                Passage::Step(step) => {
                    self.recall(course, &step);
                    observation.maxima.energy_lost += step.energy_taken;
                    self.observe_step(piece, course.numbers(step.state), observation);
                    observation.maxima.closed_throughout &= step.closed;
                }
            }
        }
    }

    /// The maxima once more at the places that the polynomials tell, and in the flights that can hold larger ones.
    fn exact_maxima(
        &mut self,
        observation: Observation,
        motion: &[(Stretch, &[f64])],
    ) -> Result<Maxima, MotionError> {
        let mut driven = Some(motion.len().saturating_sub(1));
        let mut drive_of = |integrator: &mut Self, piece: usize| {
            if driven.replace(piece) != Some(piece) {
                integrator.drive =
                    Drive::new(&integrator.system, &integrator.blocks, &integrator.outputs, &motion[piece].0);
            }
        };
        let Observation { mut maxima, fastest, farthest, hardest, flights, impacts } = observation;
        // An infinite number of impacts, of which some were followed, counts once.
        maxima.touches -=
            impacts.iter().filter(|[_, stuck]| *stuck > 0).map(|[all, stuck]| all - stuck).sum::<u32>();
        for peak in hardest.peaks {
            drive_of(self, peak.piece);
            maxima.contact_force = maxima.contact_force.max(self.largest_force(peak));
        }
        for peak in farthest.peaks {
            drive_of(self, peak.piece);
            maxima.displacement = maxima.displacement.max(self.exact_extremum(peak, f64::abs));
        }
        for peak in fastest.peaks {
            drive_of(self, peak.piece);
            maxima.acceleration = maxima.acceleration.max(self.exact_peak(peak));
        }
        let (response, watches) = (self.laws.len(), self.watches());
        for flown in flights.iter().filter(|flown| watches || !flown.held.is_empty()) {
            if flown.held.is_empty() {
                drive_of(self, flown.piece);
            } else {
                self.stretch = motion[flown.piece].0;
                self.take_hold(&flown.held)?;
            }
            if watches {
                maxima.displacement = self.flight_maximum(flown, (response, 0), maxima.displacement);
                maxima.acceleration = self.flight_maximum(flown, (response, 2), maxima.acceleration);
            }
            for output in self.outputs.len() - flown.held.len()..self.outputs.len() {
                maxima.contact_force = self.flight_maximum(flown, (output, 0), maxima.contact_force);
            }
            self.let_go();
        }
        Ok(maxima)
    }

    fn watches(&self) -> bool {
        self.outputs.len() > self.laws.len()
    }

    /// Notes the present step, which started from `state`.
    fn observe_step(&self, piece: usize, state: &[f64], observation: &mut Observation) {
        let step = &self.step;
        let rule = step.grading().rule();
        for (a, &element) in step.active.iter().enumerate() {
            if self.laws[element].contacts().is_empty() {
                continue;
            }
            let force = &step.force[a * NODES..(a + 1) * NODES];
            let impulse: f64 = (0..NODES).map(|j| rule.at_end[0][j] * force[j]).sum();
            observation.maxima.impulse += (impulse * step.length).abs();
            if let Some(largest) = self.largest(force, observation.hardest.bar()) {
                observation.hardest.note(self.peak(state, (piece, element), largest));
            }
        }
        if self.watches() {
            self.observe_response(piece, state, observation);
        }
    }

    fn observe_response(&self, piece: usize, state: &[f64], observation: &mut Observation) {
        let response = self.laws.len();
        if let Some(largest) = self.largest(&self.response_nodes(state, 0), observation.farthest.bar()) {
            observation.farthest.note(self.peak(state, (piece, response), largest));
        }
        if let Some(largest) = self.largest(&self.response_nodes(state, 2), observation.fastest.bar()) {
            observation.fastest.note(self.peak(state, (piece, response), largest));
        }
    }

    /// The solved step, whose polynomial has this largest value at this place.
    fn peak(&self, state: &[f64], (piece, output): (usize, usize), (value, place): (f64, f64)) -> Peak {
        Peak {
            piece,
            output,
            value,
            place,
            grading: self.step.grading(),
            start: self.step.start,
            length: self.step.length,
            state: state.to_vec(),
            active: self.step.active.clone(),
            laws: self.step.active.iter().map(|&e| self.laws[e]).collect(),
            force: self.step.force.clone(),
        }
    }

    /// Makes a step that was solved earlier the present one.
    fn recall(&mut self, course: &Course, step: &CourseStep) {
        self.step.grading = Some(step.grading);
        self.step.start = step.start;
        self.step.length = step.length;
        self.step.active.clear();
        for (element, law) in course.active(step) {
            self.step.active.push(*element);
            self.laws[*element] = *law;
        }
        self.step.force.clear();
        self.step.force.extend_from_slice(course.numbers(step.force));
    }

    /// Makes the step of a peak the present one; the time of the peak in it.
    fn recall_peak(&mut self, peak: &Peak) -> f64 {
        self.step.grading = Some(peak.grading);
        self.step.start = peak.start;
        self.step.length = peak.length;
        peak.active.iter().zip(&peak.laws).for_each(|(&element, law)| self.laws[element] = *law);
        self.step.active.clone_from(&peak.active);
        self.step.force.clone_from(&peak.force);
        peak.grading.map(peak.place).0 * peak.length
    }

    /// Largest value that a function of the displacement has in the step of a peak, near its place: at the extremum of the displacement or at an
    /// end of the step.
    fn exact_extremum(&mut self, peak: Peak, magnitude: impl Fn(f64) -> f64) -> f64 {
        let (length, output) = (peak.length, peak.output);
        let mut time = self.recall_peak(&peak);
        let mut largest = 0.0_f64;
        for _ in 0..POLISHES {
            let jet = self.jet_in_step(&peak.state, output, time);
            largest = largest.max(magnitude(jet.value));
            let away = -jet.slope / jet.curvature;
            let next = (time + away).clamp(0.0, length);
            if next.is_nan() || next == time {
                break;
            }
            if next == time + away && away.abs() <= NEAR * length {
                return largest.max(magnitude(jet.value + 0.5 * jet.slope * away));
            }
            time = next;
        }
        largest
    }

    /// The largest force once more: at the extremum of the displacement; where the law depends on the velocity, at the place that the polynomial tells.
    fn largest_force(&mut self, peak: Peak) -> f64 {
        let element = peak.output;
        let of_element = peak.active.iter().position(|&active| active == element);
        let law = of_element.map_or(self.laws[element], |a| peak.laws[a]);
        if !law.depends_on_velocity() {
            return self.exact_extremum(peak, |displacement| law.force(displacement, 0.0).value.abs());
        }
        let time = self.recall_peak(&peak);
        let jet = self.jet_in_step(&peak.state, element, time);
        law.pressing_force(jet.value, jet.slope).value.abs()
    }

    /// The largest acceleration once more: the polynomial tells where it is, and there the forces follow from the
    /// displacements, which are much more accurate.
    fn exact_peak(&mut self, peak: Peak) -> f64 {
        let (response, place) = (self.laws.len(), peak.place);
        let time = self.recall_peak(&peak);
        let mut exact = self.jet_in_step(&peak.state, response, time).curvature;
        for (a, &element) in self.step.active.iter().enumerate() {
            let polynomial = self.step.interpolate(&self.step.force, a, place);
            let jet = self.jet_in_step(&peak.state, element, time);
            exact += self.mobility[response][element]
                * (self.laws[element].pressing_force(jet.value, jet.slope).value - polynomial);
        }
        exact.abs()
    }

    /// Displacement (`derivative` 0) or acceleration (2) of the response point at the nodes of the solved step.
    fn response_nodes(&self, state: &[f64], derivative: usize) -> [f64; NODES] {
        let (step, response) = (&self.step, self.laws.len());
        let length = step.length;
        let pick = |jet: super::drive::Jet| if derivative == 0 { jet.value } else { jet.curvature };
        if length > self.series.reach() {
            return std::array::from_fn(|k| pick(self.jet_in_step(state, response, step.node_time(k))));
        }
        let loads = (step.active.as_slice(), step.force.as_slice());
        let mut values =
            self.series.node_values((response, derivative), (step.grading(), length), state, loads);
        for (k, value) in values.iter_mut().enumerate() {
            *value += pick(self.drive.jet(response, &self.outputs[response], step.start + step.node_time(k)));
            if derivative == 2 {
                for (a, &element) in step.active.iter().enumerate() {
                    *value += self.mobility[response][element] * step.force[a * NODES + k];
                }
            }
        }
        values
    }

    /// Largest magnitude of a polynomial given at the nodes of the solved step, and where in its variable; `None` if it is not above
    /// `best`.
    fn largest(&self, values: &[f64], best: f64) -> Option<(f64, f64)> {
        if values.iter().all(|value| value.abs() * BETWEEN_NODES <= best) {
            return None;
        }
        let (value, place) = self.largest_of_polynomial(values);
        (value > best).then_some((value, place))
    }

    pub(super) fn largest_of_polynomial(&self, values: &[f64]) -> (f64, f64) {
        let rule = self.step.grading().rule();
        let mut table = [0.0; FINE + 1];
        for (entry, row) in table.iter_mut().zip(&rule.fine) {
            *entry = row.iter().zip(values).map(|(l, v)| l * v).sum::<f64>().abs();
        }
        let best = (0..=FINE).fold(0, |best, i| if table[i] > table[best] { i } else { best });
        // Successive parabolas through the best place and its neighbours, from half an interval beyond an end of the step inwards.
        let width = 1.0 / FINE as f64;
        let value = |s: f64| rule.lagrange(s).iter().zip(values).map(|(l, v)| l * v).sum::<f64>().abs();
        let middle = (best as f64 * width).clamp(0.5 * width, 1.0 - 0.5 * width);
        let mut points =
            [(middle - width).max(0.0), middle, (middle + width).min(1.0)].map(|s| (s, value(s)));
        let mut largest = (table[best], best as f64 * width);
        for _ in 0..PARABOLAS {
            let Some(s) = vertex(points) else { break };
            let s = s.clamp(0.0, 1.0);
            let next = (s, value(s));
            if next.1 > largest.0 {
                largest = (next.1, s);
            }
            // Keep the three points around the best.
            let worst = (0..3).fold(0, |w, k| if points[k].1 < points[w].1 { k } else { w });
            points[worst] = next;
        }
        largest
    }
}

/// Closed elements, one bit each.
pub(crate) fn closed_bits(run: &Run) -> u64 {
    let closed = run.closed.iter().enumerate().filter(|(_, contact)| contact.is_some());
    bits(closed.map(|(element, _)| element)) | bits(run.stuck.iter().copied())
}

/// One bit each of the first 64 elements.
fn bits(elements: impl Iterator<Item = usize>) -> u64 {
    elements.filter(|element| *element < 64).fold(0, |bits, element| bits | 1 << element)
}

/// Place of the maximum of the parabola through three points, if it has one.
fn vertex([(a, at_a), (b, at_b), (c, at_c)]: [(f64, f64); 3]) -> Option<f64> {
    let (left, right) = ((at_b - at_a) / (b - a), (at_c - at_b) / (c - b));
    let curvature = (right - left) / (c - a);
    let place = 0.5 * (a + b) - 0.5 * left / curvature;
    (curvature < 0.0 && place.is_finite()).then_some(place)
}
