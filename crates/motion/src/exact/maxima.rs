//! Maxima of an orbit on the continuous motion.
//!
//! In flight the displacement and the acceleration of the response point are sums of known functions with a known bound `B` on
//! their second derivative: over an interval of length h they exceed the larger end value by at most `B h^2/8`. Intervals
//! that cannot beat the best value so far are dropped, the others halved, with Newton's method on the derivative wherever it
//! converges: what is found is the maximum, to [`ACCURACY`]. In a force step displacement, acceleration and force are polynomials in the
//! variable of the step; the largest acceleration is then computed once more from the displacement at its time.

use super::{
    ExactIntegrator, MotionError,
    block::Propagator,
    collocation::{FINE, Grading, NODES},
    run::Run,
};
use crate::Stretch;

/// Relative accuracy to which maxima in flight are enclosed.
const ACCURACY: f64 = 1e-9;

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

/// A flight that was flown.
#[derive(Debug, Clone)]
struct Flown {
    start: f64,
    duration: f64,
    state: Vec<f64>,
}

/// What is noted while a motion is observed.
#[derive(Debug, Clone, Default)]
pub(crate) struct Observation {
    maxima: Maxima,
    flights: Vec<Flown>,
    peak: Option<Peak>,
}

/// The force step that holds the largest acceleration, as far as its polynomial tells.
#[derive(Debug, Clone)]
struct Peak {
    acceleration: f64,
    /// Where in the variable of the step.
    place: f64,
    grading: Grading,
    start: f64,
    length: f64,
    /// State at the start of the step.
    state: Vec<f64>,
    active: Vec<usize>,
    force: Vec<f64>,
}

/// Parabolas by which the largest value of a polynomial is closed in.
const PARABOLAS: usize = 6;
/// A polynomial through the nodes of a step exceeds its largest nodal value by less than this factor, as smooth as steps are.
const BETWEEN_NODES: f64 = 1.5;

impl Observation {
    pub fn flight(&mut self, start: f64, duration: f64, state: &[f64]) {
        self.maxima.closed_throughout = 0;
        self.flights.push(Flown { start, duration, state: state.to_vec() });
    }

    pub fn touch(&mut self, speed: f64) {
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
        let mut observation = Observation::default();
        let mut run = self.begin(stretch, state, false);
        observation.maxima.closed_throughout = closed_bits(&run);
        self.observation = Some(observation);
        let result = self.complete(&mut run, stretch);
        let end = self.modal_state(&run, stretch.duration());
        let mut observation = self.observation.take().unwrap_or_default();
        self.run = run;
        result?;
        if self.watches() {
            if let Some(peak) = observation.peak.take() {
                observation.maxima.acceleration = self.exact_peak(peak);
            }
            let flights = std::mem::take(&mut observation.flights);
            for flown in &flights {
                let best = observation.maxima.displacement;
                observation.maxima.displacement = self.flight_maximum(flown, 0, best);
                let best = observation.maxima.acceleration;
                observation.maxima.acceleration = self.flight_maximum(flown, 2, best);
            }
        }
        Ok((end, observation.maxima))
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
            observation.maxima.impulse += (impulse * step.weights.length).abs();
            if let Some((largest, _)) = self.largest(force, observation.maxima.contact_force) {
                observation.maxima.contact_force = largest;
            }
        }
        if self.watches() {
            self.observe_response(run, observation);
        }
    }

    fn observe_response(&self, run: &Run, observation: &mut Observation) {
        let displacements = self.response_nodes(run, 0);
        if let Some((largest, _)) = self.largest(&displacements, observation.maxima.displacement) {
            observation.maxima.displacement = largest;
        }
        let best = observation.peak.as_ref().map_or(0.0, |peak| peak.acceleration);
        if let Some((acceleration, place)) = self.largest(&self.response_nodes(run, 2), best) {
            observation.peak = Some(Peak {
                acceleration,
                place,
                grading: self.step.grading(),
                start: self.step.start,
                length: self.step.weights.length,
                state: run.state.clone(),
                active: self.step.active.clone(),
                force: self.step.force.clone(),
            });
        }
    }

    /// The largest acceleration once more: the polynomial tells where it is, and there the forces follow from the
    /// displacements, which are much more accurate.
    fn exact_peak(&mut self, peak: Peak) -> f64 {
        let response = self.laws.len();
        self.step.grading = Some(peak.grading);
        self.step.start = peak.start;
        self.step.weights.length = peak.length;
        self.step.active = peak.active;
        self.step.force = peak.force;
        let time = peak.grading.map(peak.place).0 * peak.length;
        let mut exact = self.jet_in_step(&peak.state, response, time).curvature;
        for (a, &element) in self.step.active.iter().enumerate() {
            let polynomial = self.step.interpolate(&self.step.force, a, peak.place);
            let displacement = self.jet_in_step(&peak.state, element, time).value;
            exact += self.mobility[response][element]
                * (self.laws[element].force(displacement).value - polynomial);
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
    fn largest(&self, values: &[f64], best: f64) -> Option<(f64, f64)> {
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

    /// Largest magnitude of displacement (0) or acceleration (2) of the response point over a flight, not below `best`.
    fn flight_maximum(&self, flown: &Flown, derivative: usize, best: f64) -> f64 {
        let flight = FlightFunction::new(self, flown, derivative);
        let mut best = best;
        if flight.largest <= best {
            return best;
        }
        let (first, last) = (flight.at(0.0), flight.at(flown.duration));
        best = best.max(first.0.abs()).max(last.0.abs());
        // Short enough for the curvature to add a tenth of the best, and at most four thousand intervals to begin with.
        let spacing = if flight.bound > 0.0 {
            (0.8 * best.max(1e-3 * flight.largest) / flight.bound).sqrt()
        } else {
            flown.duration
        };
        let count = (flown.duration / spacing).ceil().clamp(1.0, 4096.0) as usize;
        let values = flight.on_grid(count);
        best = values.iter().fold(best, |best, value| best.max(value.abs()));
        let width = flown.duration / count as f64;
        for (i, ends) in values.windows(2).enumerate() {
            flight.refine(
                (i as f64 * width, ends[0].abs()),
                ((i + 1) as f64 * width, ends[1].abs()),
                &mut best,
            );
        }
        best
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

/// A function of the time of a flight: an output or its second derivative.
struct FlightFunction<'a> {
    integrator: &'a ExactIntegrator,
    flown: &'a Flown,
    derivative: usize,
    /// Rows of the function and of its first two derivatives.
    rows: [Vec<f64>; 3],
    /// Bound on the second derivative of the function.
    bound: f64,
    /// Bound on the third derivative of the function; infinite where none is known.
    third: f64,
    /// Bound on the function.
    largest: f64,
}

impl<'a> FlightFunction<'a> {
    fn new(integrator: &'a ExactIntegrator, flown: &'a Flown, derivative: usize) -> Self {
        let response = integrator.laws.len();
        let (output, blocks, drive) = (&integrator.outputs[response], &integrator.blocks, &integrator.drive);
        let n = blocks.count();
        let until = flown.start + flown.duration;
        let mut row = output.row.clone();
        (0..derivative).for_each(|_| row = blocks.row_times_system(&row));
        let slope = blocks.row_times_system(&row);
        let curvature = blocks.row_times_system(&slope);
        let energy = |factors: &[f64]| {
            let norm =
                |i: usize| (blocks.stiffness[i] * flown.state[i].powi(2) + flown.state[n + i].powi(2)).sqrt();
            (0..n).map(|i| factors[i] * norm(i)).sum::<f64>()
        };
        let driven = drive.bounds(response, output, until);
        let second = energy(&output.second_bound) + driven.0;
        let (bound, third, largest) = if derivative == 0 {
            (second, energy(&output.third_bound) + driven.1, f64::INFINITY)
        } else {
            let fourth = energy(&output.fourth_bound) + drive.fourth_bound(response, output, until);
            (fourth, f64::INFINITY, second)
        };
        Self { integrator, flown, derivative, rows: [row, slope, curvature], bound, third, largest }
    }

    /// Function and its first two derivatives at `time` after the start of the flight.
    fn at(&self, time: f64) -> (f64, f64, f64) {
        let blocks = &self.integrator.blocks;
        let n = blocks.count();
        let mut sums = self.driven(time);
        for i in 0..n {
            let propagator = Propagator::new(blocks.stiffness[i], blocks.damping[i], time);
            let (p, s) = propagator.apply(self.flown.state[i], self.flown.state[n + i]);
            for (sum, row) in sums.iter_mut().zip(&self.rows) {
                *sum += row[i] * p + row[n + i] * s;
            }
        }
        (sums[0], sums[1], sums[2])
    }

    /// Particular part of the function and of its first two derivatives (those of the acceleration by differences suffice: they
    /// only steer Newton's method).
    fn driven(&self, time: f64) -> [f64; 3] {
        let response = self.integrator.laws.len();
        let output = &self.integrator.outputs[response];
        let jet = |t: f64| self.integrator.drive.jet(response, output, self.flown.start + t);
        if self.derivative == 0 {
            let here = jet(time);
            return [here.value, here.slope, here.curvature];
        }
        let step = 1e-3 / self.integrator.drive.circular_frequency();
        let (before, here, after) =
            (jet(time - step).curvature, jet(time).curvature, jet(time + step).curvature);
        [here, (after - before) / (2.0 * step), (after - 2.0 * here + before) / (step * step)]
    }

    /// The function at `count + 1` equal steps over the flight.
    fn on_grid(&self, count: usize) -> Vec<f64> {
        let blocks = &self.integrator.blocks;
        let (n, response) = (blocks.count(), self.integrator.laws.len());
        let step = self.flown.duration / count as f64;
        let propagators: Vec<Propagator> =
            (0..n).map(|i| Propagator::new(blocks.stiffness[i], blocks.damping[i], step)).collect();
        let mut state = self.flown.state.clone();
        let mut values = Vec::with_capacity(count + 1);
        for place in 0..=count {
            let jet = self.integrator.drive.jet(
                response,
                &self.integrator.outputs[response],
                self.flown.start + place as f64 * step,
            );
            let mut value = if self.derivative == 0 { jet.value } else { jet.curvature };
            for i in 0..n {
                value += self.rows[0][i] * state[i] + self.rows[0][n + i] * state[n + i];
                (state[i], state[n + i]) = propagators[i].apply(state[i], state[n + i]);
            }
            values.push(value);
        }
        values
    }

    /// Raises `best` to the largest magnitude in an interval, given the magnitudes at its ends.
    fn refine(&self, (a, at_a): (f64, f64), (b, at_b): (f64, f64), best: &mut f64) {
        let excess = self.bound * (b - a) * (b - a) / 8.0;
        if at_a.max(at_b) + excess <= *best * (1.0 + ACCURACY) || b - a <= f64::EPSILON * b {
            return;
        }
        let middle = 0.5 * (a + b);
        let mut time = middle;
        let mut value = self.at(middle);
        let at_middle = value.0.abs();
        *best = best.max(at_middle);
        // Concave all over the interval: Newton's method finds the one maximum, or an end is it.
        let concave = value.0.signum() * value.2 + 0.5 * self.third * (b - a) < 0.0;
        for _ in 0..8 {
            if value.0 * value.2 >= 0.0 {
                break;
            }
            let step = -value.1 / value.2;
            time += step;
            if !(a..=b).contains(&time) {
                break;
            }
            value = self.at(time);
            *best = best.max(value.0.abs());
            if step.abs() <= 1e-7 * (b - a) {
                break;
            }
        }
        if concave {
            return;
        }
        self.refine((a, at_a), (middle, at_middle), best);
        self.refine((middle, at_middle), (b, at_b), best);
    }
}
