//! Maxima of an orbit on the continuous motion.
//!
//! Flights are searched once the motion is complete (`flight_maximum.rs`). In a force step the displacement of the response and the force of each
//! element are taken as polynomials in the variable of the step, which tell where the largest value `r` is. They are not accurate enough for the
//! value itself: that is computed once more from the convolution `r(t) = C exp(A t) x + int C exp(A (t - s)) B F(s) ds + r_particular(t)`, at the time
//! where Newton's method finds `r'(t) = 0` for it, or at an end of the step. The force follows from it by its law, and so does the acceleration, at the
//! place of its own maximum.

use super::{
    ExactIntegrator, MotionError,
    collocation::{FINE, Grading, NODES},
    flight::Touch,
    flight_maximum::Flown,
    record::{ContactRecord, Recorder},
    run::Run,
};
use crate::{Law, Stretch};

/// Maxima of a motion on the continuous motion, and its contacts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Maxima {
    /// Largest absolute displacement of the response point, `max |y|` [m].
    pub displacement: f64,
    /// Largest absolute acceleration of the response point, `max |y''|` [m/s^2].
    pub acceleration: f64,
    /// Largest contact force over all elements with a contact [N].
    pub contact_force: f64,
    /// Largest speed with which a contact closes [m/s].
    pub impact_velocity: f64,
    /// Sum of the impulses of all contacts [N s].
    pub impulse: f64,
    /// Energy that the structure has lost to all contacts [J], as in [`ContactRecord::energy_lost`].
    pub energy_lost: f64,
    /// Number of contacts that closed.
    pub touches: u32,
    /// Elements that were closed all the time, one bit each (the first 64).
    pub closed_throughout: u64,
}

impl Maxima {
    /// Maxima of two motions that follow one another.
    #[must_use]
    pub fn joined(self, later: Self) -> Self {
        Self {
            displacement: self.displacement.max(later.displacement),
            acceleration: self.acceleration.max(later.acceleration),
            contact_force: self.contact_force.max(later.contact_force),
            impact_velocity: self.impact_velocity.max(later.impact_velocity),
            impulse: self.impulse + later.impulse,
            energy_lost: self.energy_lost + later.energy_lost,
            touches: self.touches + later.touches,
            closed_throughout: self.closed_throughout & later.closed_throughout,
        }
    }

    /// Number of contacts: those that closed, and those that were closed throughout.
    #[must_use]
    pub fn contacts(&self) -> u32 {
        self.touches + self.closed_throughout.count_ones()
    }
}

/// What is noted while a motion is observed.
#[derive(Debug, Clone, Default)]
pub(crate) struct Observation {
    maxima: Maxima,
    flights: Vec<Flown>,
    /// Of the acceleration of the response,
    fastest: Peaks,
    /// of its displacement,
    farthest: Peaks,
    /// and of the force of elements with a contact.
    hardest: Peaks,
    /// One record for each contact, if wanted.
    recorder: Option<Recorder>,
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
pub(super) struct Peak {
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

impl Peak {
    /// The largest value, by the polynomial.
    pub fn value(&self) -> f64 {
        self.value
    }
}

/// Parabolas by which the largest value of a polynomial is closed in.
const PARABOLAS: usize = 6;
/// Steps of Newton's method to the place of a largest displacement.
const POLISHES: usize = 6;
/// A polynomial through the nodes of a step exceeds its largest nodal value by less than this factor, as smooth as steps are.
const BETWEEN_NODES: f64 = 1.5;

impl Observation {
    pub fn flight(&mut self, start: f64, duration: f64, state: &[f64]) {
        self.maxima.closed_throughout = 0;
        self.flights.push(Flown { start, duration, state: state.to_vec() });
    }

    pub fn touch(&mut self, touch: Touch, time: f64, speed: f64) {
        if let Some(recorder) = &mut self.recorder {
            recorder.strike(touch, time, speed);
        }
        self.maxima.touches += 1;
        self.maxima.impact_velocity = self.maxima.impact_velocity.max(speed.abs());
    }
}

impl ExactIntegrator {
    /// State at the end of a stretch and the maxima on the way, of the response point given at construction.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn observe(&mut self, stretch: &Stretch, state: &[f64]) -> Result<(Vec<f64>, Maxima), MotionError> {
        let (end, maxima, _) = self.observe_with(stretch, state, Observation::default())?;
        Ok((end, maxima))
    }

    /// [`ExactIntegrator::observe`], with a record of each contact, in the order in which they begin.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn observe_contacts(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
    ) -> Result<(Vec<f64>, Maxima, Vec<ContactRecord>), MotionError> {
        let recording = Observation { recorder: Some(Recorder::default()), ..Observation::default() };
        self.observe_with(stretch, state, recording)
    }

    fn observe_with(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
        mut observation: Observation,
    ) -> Result<(Vec<f64>, Maxima, Vec<ContactRecord>), MotionError> {
        let mut run = self.begin(stretch, state, false);
        observation.maxima.closed_throughout = closed_bits(&run);
        self.observation = Some(observation);
        let result = self.complete(&mut run, stretch);
        let end = self.modal_state(&run, stretch.duration());
        let mut observation = self.observation.take().unwrap_or_default();
        self.remember_end(stretch, &end);
        let recorder = observation.recorder.take().unwrap_or_default();
        let records = if result.is_ok() { self.finish_records(&run, recorder) } else { Vec::new() };
        self.run = run;
        result?;
        let Observation { maxima, fastest, farthest, hardest, .. } = &mut observation;
        for peak in std::mem::take(&mut hardest.peaks) {
            maxima.contact_force = maxima.contact_force.max(self.largest_force(peak));
        }
        for peak in std::mem::take(&mut farthest.peaks) {
            maxima.displacement = maxima.displacement.max(self.exact_extremum(peak, f64::abs));
        }
        for peak in std::mem::take(&mut fastest.peaks) {
            maxima.acceleration = maxima.acceleration.max(self.exact_peak(peak));
        }
        if self.watches() {
            let flights = std::mem::take(&mut observation.flights);
            for flown in &flights {
                let best = observation.maxima.displacement;
                observation.maxima.displacement = self.flight_maximum(flown, 0, best);
                let best = observation.maxima.acceleration;
                observation.maxima.acceleration = self.flight_maximum(flown, 2, best);
            }
        }
        Ok((end, observation.maxima, records))
    }

    fn watches(&self) -> bool {
        self.outputs.len() > self.laws.len()
    }

    /// Notes the solved step that is being accepted; `run` stands at its start.
    pub(super) fn observe_step(&self, run: &Run, observation: &mut Observation) {
        let step = &self.step;
        let rule = step.grading().rule();
        observation.maxima.closed_throughout &= closed_bits(run);
        for (a, &element) in step.active.iter().enumerate() {
            if self.laws[element].contacts().is_empty() {
                continue;
            }
            let force = &step.force[a * NODES..(a + 1) * NODES];
            let impulse: f64 = (0..NODES).map(|j| rule.at_end[0][j] * force[j]).sum();
            let impulse = (impulse * step.weights.length).abs();
            observation.maxima.impulse += impulse;
            observation.maxima.energy_lost += self.energy_taken(a);
            if let Some(recorder) = &mut observation.recorder {
                self.record_step(run, a, impulse, recorder);
            }
            if let Some(largest) = self.largest(force, observation.hardest.bar()) {
                observation.hardest.note(self.peak(run, element, largest));
            }
        }
        if self.watches() {
            self.observe_response(run, observation);
        }
    }

    fn observe_response(&self, run: &Run, observation: &mut Observation) {
        let response = self.laws.len();
        if let Some(largest) = self.largest(&self.response_nodes(run, 0), observation.farthest.bar()) {
            observation.farthest.note(self.peak(run, response, largest));
        }
        if let Some(largest) = self.largest(&self.response_nodes(run, 2), observation.fastest.bar()) {
            observation.fastest.note(self.peak(run, response, largest));
        }
    }

    /// The solved step, whose polynomial has this largest value at this place.
    pub(super) fn peak(&self, run: &Run, output: usize, (value, place): (f64, f64)) -> Peak {
        Peak {
            output,
            value,
            place,
            grading: self.step.grading(),
            start: self.step.start,
            length: self.step.weights.length,
            state: run.state.clone(),
            active: self.step.active.clone(),
            laws: self.step.active.iter().map(|&e| self.laws[e]).collect(),
            force: self.step.force.clone(),
        }
    }

    /// Makes the step of a peak the present one; the state at its start, and the time of the peak in it.
    fn recall(&mut self, peak: Peak) -> (Vec<f64>, f64) {
        self.step.grading = Some(peak.grading);
        self.step.start = peak.start;
        self.step.weights.length = peak.length;
        peak.active.iter().zip(&peak.laws).for_each(|(&element, law)| self.laws[element] = *law);
        self.step.active = peak.active;
        self.step.force = peak.force;
        (peak.state, peak.grading.map(peak.place).0 * peak.length)
    }

    /// Largest value that a function of the displacement has in the step of a peak, near its place: at the extremum of the displacement or at an
    /// end of the step.
    fn exact_extremum(&mut self, peak: Peak, magnitude: impl Fn(f64) -> f64) -> f64 {
        let (length, output) = (peak.length, peak.output);
        let (state, mut time) = self.recall(peak);
        let mut jet = self.jet_in_step(&state, output, time);
        let mut largest = magnitude(jet.value);
        for _ in 0..POLISHES {
            let next = (time - jet.slope / jet.curvature).clamp(0.0, length);
            if next.is_nan() || (next - time).abs() <= 1e-9 * length {
                break;
            }
            time = next;
            jet = self.jet_in_step(&state, output, time);
            largest = largest.max(magnitude(jet.value));
        }
        largest
    }

    /// The largest force once more: at the extremum of the displacement; where the law depends on the velocity, at the place that the polynomial tells.
    pub(super) fn largest_force(&mut self, peak: Peak) -> f64 {
        let element = peak.output;
        let law = self.laws[element];
        if !law.depends_on_velocity() {
            return self.exact_extremum(peak, |displacement| law.force(displacement, 0.0).value.abs());
        }
        let (state, time) = self.recall(peak);
        let jet = self.jet_in_step(&state, element, time);
        self.laws[element].pressing_force(jet.value, jet.slope).value.abs()
    }

    /// The largest acceleration once more: the polynomial tells where it is, and there the forces follow from the
    /// displacements, which are much more accurate.
    fn exact_peak(&mut self, peak: Peak) -> f64 {
        let (response, place) = (self.laws.len(), peak.place);
        let (state, time) = self.recall(peak);
        let mut exact = self.jet_in_step(&state, response, time).curvature;
        for (a, &element) in self.step.active.iter().enumerate() {
            let polynomial = self.step.interpolate(&self.step.force, a, place);
            let jet = self.jet_in_step(&state, element, time);
            exact += self.mobility[response][element]
                * (self.laws[element].pressing_force(jet.value, jet.slope).value - polynomial);
        }
        exact.abs()
    }

    /// Displacement (`derivative` 0) or acceleration (2) of the response point at the nodes of the solved step.
    fn response_nodes(&self, run: &Run, derivative: usize) -> [f64; NODES] {
        let (step, response) = (&self.step, self.laws.len());
        let length = step.weights.length;
        let pick = |jet: super::drive::Jet| if derivative == 0 { jet.value } else { jet.curvature };
        if length > self.series.reach() {
            return std::array::from_fn(|k| pick(self.jet_in_step(&run.state, response, step.node_time(k))));
        }
        let loads = (step.active.as_slice(), step.force.as_slice());
        let mut values =
            self.series.node_values((response, derivative), (step.grading(), length), &run.state, loads);
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
    pub(super) fn largest(&self, values: &[f64], best: f64) -> Option<(f64, f64)> {
        if values.iter().all(|value| value.abs() * BETWEEN_NODES <= best) {
            return None;
        }
        let (value, place) = self.largest_of_polynomial(values);
        (value > best).then_some((value, place))
    }

    fn largest_of_polynomial(&self, values: &[f64]) -> (f64, f64) {
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
    let closed = run.closed.iter().take(64).enumerate().filter(|(_, contact)| contact.is_some());
    closed.map(|(element, _)| 1 << element).sum()
}

/// Place of the maximum of the parabola through three points, if it has one.
fn vertex([(a, at_a), (b, at_b), (c, at_c)]: [(f64, f64); 3]) -> Option<f64> {
    let (left, right) = ((at_b - at_a) / (b - a), (at_c - at_b) / (c - b));
    let curvature = (right - left) / (c - a);
    let place = 0.5 * (a + b) - 0.5 * left / curvature;
    (curvature < 0.0 && place.is_finite()).then_some(place)
}
