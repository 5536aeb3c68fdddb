//! Maxima in force steps.
//!
//! In a force step the displacement of the response and the force of each element are taken as polynomials in
//! the variable of the step, which tell where the largest value `r` is. They are not accurate enough for the
//! value itself: that is computed once more from the convolution `r(t) = C exp(A t) x + int C exp(A (t - s))
//! B F(s) ds + r_particular(t)`, at the time where Newton's method finds `r'(t) = 0` for it, or at an end of
//! the step. The force follows from it by its law; that of a law that depends on the velocity turns beside
//! the displacement, and it is taken at the vertex of parabolas through the force itself, as is the
//! acceleration, which follows from the forces.
//!
//! **Which steps are looked at.** Without forces the energy norm `|x_i|` of a block does not grow, and
//! `|B_ai|` is the most that a unit of force adds per time (`touching.rs`). With the largest magnitude `F_a`
//! of the Bernstein coefficients of each force, between which its polynomial lies, and the length h of the
//! step,
//!
//! `|r''| <= P_2 + sum_i g_i^(2) (|x_i| + h sum_a |B_ai| F_a) + sum_a |G_a| F_a = B_2`, `|r(t)| <= |r| + |r'|
//! h + B_2 h^2/2`
//!
//! from the state at its start. A step whose bound is below what was found elsewhere is passed.
//!
//! **Which are computed.** The largest by its polynomial is computed first; what the polynomials are off by
//! there tells which of the others may be larger. Where a load of high order acts, that is many of them.

use super::{
    ExactIntegrator,
    collocation::NODES,
    course::{Course, CourseStep},
    hole,
};

/// Force steps that may hold the largest value.
#[derive(Debug, Clone, Default)]
pub(super) struct Peaks {
    largest: f64,
    peaks: Vec<Peak>,
}

/// A force step with a large value of an output, as far as its polynomial tells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Peak {
    /// The stretch it is in.
    pub piece: usize,
    pub step: CourseStep,
    pub output: usize,
    /// The largest value, by the polynomial; at most, where waves lie over it.
    pub value: f64,
    /// Where in the variable of the step.
    pub place: f64,
}

/// Relative difference of two values up to which their polynomials may not tell which is larger,
const ALIKE: f64 = 1e-2;
/// and up to which they never do.
const EQUAL: f64 = 1e-5;
/// In between, polynomials are taken to be off by so many times what those are that were computed.
const DOUBTS: f64 = 4.0;
/// A polynomial through the nodes of a step exceeds its largest nodal value by less than this factor, as
/// smooth as steps are.
const BETWEEN_NODES: f64 = 1.5;
/// Steps of Newton's method to the place of a largest displacement, or of parabolas to that of a largest
/// force or acceleration.
const POLISHES: usize = 6;
/// So near to it, in parts of the step, a parabola gives the value: what is left is of third order, 1e-12 of
/// the variation in the step.
const NEAR: f64 = 1e-4;
/// Distance of the points that a parabola is laid through, in parts of the step: so near to its vertex the
/// value is the largest to 1e-12 of the variation in the step.
const BETWEEN_POINTS: f64 = 1e-3;

impl Peaks {
    /// None yet, of a function that has this value elsewhere.
    fn above(largest: f64) -> Self {
        Self { largest, peaks: Vec::new() }
    }

    /// Value that another one must exceed.
    fn bar(&self) -> f64 {
        (1.0 - ALIKE) * self.largest
    }

    /// Notes the values of an output at the nodes of a step of a stretch, if they can be the largest.
    pub fn note(&mut self, (piece, step): (usize, CourseStep), output: usize, values: &[f64; NODES]) {
        let bar = self.bar();
        if values.iter().all(|value| value.abs() * BETWEEN_NODES <= bar) {
            return;
        }
        let (value, place) = step.grading.rule().extremum(values);
        self.add(Peak { piece, step, output, value, place }, value);
    }

    /// Notes a value that may be the largest, and what it is at least.
    pub fn add(&mut self, peak: Peak, least: f64) {
        if peak.value <= self.bar() {
            return;
        }
        if least > self.largest {
            self.largest = least;
            let bar = self.bar();
            self.peaks.retain(|peak| peak.value >= bar);
        }
        self.peaks.push(peak);
    }

    /// Largest of the exact values, and of what there is elsewhere.
    fn largest_exact(mut self, elsewhere: f64, mut exact: impl FnMut(&Peak) -> f64) -> f64 {
        self.peaks.sort_by(|a, b| b.value.total_cmp(&a.value));
        let (mut largest, mut doubt) = (elsewhere, EQUAL);
        for peak in &self.peaks {
            if peak.value * (1.0 + doubt) < largest {
                break;
            }
            let value = exact(peak);
            doubt = doubt.max(DOUBTS * (value / peak.value - 1.0).abs());
            largest = largest.max(value);
        }
        largest
    }
}

impl ExactIntegrator {
    /// Largest acceleration of the response in force steps.
    pub(super) fn largest_acceleration(&mut self, course: &Course, steps: &[(usize, CourseStep)]) -> f64 {
        let (response, mut peaks) = (self.laws.len(), Peaks::default());
        for &(piece, step) in steps {
            self.recall(course, piece, &step);
            let state = course.numbers(step.state);
            if self.acceleration_bound(state) <= peaks.bar() {
                continue;
            }
            let nodes = self.response_nodes(state, 2);
            if self.has_waves() {
                self.note_waves(&mut peaks, (piece, step), &nodes);
            } else {
                peaks.note((piece, step), response, &nodes);
            }
        }
        peaks.largest_exact(0.0, |peak| self.exact_acceleration(course, peak))
    }

    /// Largest displacement of the response in force steps, or what it has `elsewhere` if that is larger.
    pub(super) fn largest_displacement(
        &mut self,
        course: &Course,
        steps: &[(usize, CourseStep)],
        elsewhere: f64,
    ) -> f64 {
        let (response, mut peaks) = (self.laws.len(), Peaks::above(elsewhere));
        for &(piece, step) in steps {
            self.recall(course, piece, &step);
            let state = course.numbers(step.state);
            if self.displacement_bound(state) <= peaks.bar() {
                continue;
            }
            peaks.note((piece, step), response, &self.response_nodes(state, 0));
        }
        peaks.largest_exact(elsewhere, |peak| self.exact_extremum(course, peak, f64::abs))
    }

    /// Largest of the forces that were noted: at the extremum of the displacement, or where the law depends
    /// on the velocity, of the force itself.
    pub(super) fn largest_force(&mut self, course: &Course, peaks: Peaks) -> f64 {
        peaks.largest_exact(0.0, |peak| {
            // With its whole force: the piece that a run is in last need not be that of the step.
            let law = self.system.elements()[peak.output].law.clone();
            if law.depends_on_velocity() {
                self.exact_damped_force(course, peak)
            } else {
                self.exact_extremum(course, peak, |displacement| law.force(displacement, 0.0).value.abs())
            }
        })
    }

    /// The largest that held stops press with in force steps, or `best` if that is larger.
    pub(super) fn largest_pressing_force(
        &mut self,
        course: &Course,
        steps: &[(usize, CourseStep)],
        best: f64,
    ) -> f64 {
        let mut best = best;
        for (piece, step) in steps {
            let held = course.held(step.held).len();
            if held > 0 {
                self.recall(course, *piece, step);
            }
            best = (0..held)
                .fold(best, |best, j| best.max(self.pressing_maximum(course.numbers(step.state), j, best)));
        }
        best
    }

    /// Bound on the acceleration of the response in the present step from `state`.
    fn acceleration_bound(&self, state: &[f64]) -> f64 {
        let (step, response) = (&self.step, self.laws.len());
        let (output, until) = (&self.outputs[response], step.start + step.length);
        let mut bound = self.drive.bounds(response, output, until).0;
        for (i, factor) in output.second_bound.iter().enumerate() {
            bound += factor * self.energy_norm(state, i);
        }
        for (&element, force) in step.active.iter().zip(step.force.as_chunks::<NODES>().0) {
            let coefficients = step.grading().rule().bernstein_of_whole(force);
            let largest = coefficients.iter().fold(0.0_f64, |largest, b| largest.max(b.abs()));
            let input = &self.inputs[element];
            let blocks = output.second_bound.iter().enumerate();
            let gain = blocks.map(|(i, factor)| factor * self.energy_norm(input, i)).sum::<f64>();
            bound += (gain * step.length + self.mobility[response][element].abs()) * largest;
        }
        bound
    }

    /// Bound on the displacement of the response in the present step from `state`.
    fn displacement_bound(&self, state: &[f64]) -> f64 {
        let length = self.step.length;
        let jet = self.output_jet(state, self.laws.len(), self.step.start);
        jet.value.abs() + length * (jet.slope.abs() + 0.5 * length * self.acceleration_bound(state))
    }

    /// Makes a step that was solved earlier the present one.
    pub(super) fn recall(&mut self, course: &Course, piece: usize, step: &CourseStep) {
        let known = self.turn_to(&course.stretches[piece].stretch, course.held(step.held));
        known.expect("a structure that was held in the course can be held again");
        self.step.grading = Some(step.grading);
        self.step.start = step.start;
        self.step.length = step.length;
        self.step.active.clear();
        for (element, law) in course.active(step) {
            self.step.active.push(*element);
            self.laws[*element] = law.clone();
        }
        self.step.force.clear();
        self.step.force.extend_from_slice(course.numbers(step.force));
    }

    /// Makes the step of a peak the present one; the time of the peak in it.
    fn recall_peak(&mut self, course: &Course, peak: &Peak) -> f64 {
        self.recall(course, peak.piece, &peak.step);
        peak.step.grading.map(peak.place).0 * peak.step.length
    }

    /// Largest value that a function of the displacement has in the step of a peak, near its place: at the
    /// extremum of the displacement or at an end of the step.
    fn exact_extremum(&mut self, course: &Course, peak: &Peak, magnitude: impl Fn(f64) -> f64) -> f64 {
        let (length, output, state) = (peak.step.length, peak.output, course.numbers(peak.step.state));
        let mut time = self.recall_peak(course, peak);
        let mut largest = 0.0_f64;
        for _ in 0..POLISHES {
            let jet = self.element_jet_in_step(state, output, time);
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

    /// Largest force of a law that depends on the velocity in the step of a peak, near its place.
    fn exact_damped_force(&mut self, course: &Course, peak: &Peak) -> f64 {
        let (output, state) = (peak.output, course.numbers(peak.step.state));
        let time = self.recall_peak(course, peak);
        let length = peak.step.length;
        largest_near(time, (length, BETWEEN_POINTS * length), |time| {
            let jet = self.refined_jet(state, output, time);
            self.laws[output].pressing_force(jet.value, jet.slope).value.abs()
        })
    }

    /// Largest acceleration of the response in the step of a peak, near its place. The forces follow from the
    /// displacements, which are much more accurate than their polynomials.
    fn exact_acceleration(&mut self, course: &Course, peak: &Peak) -> f64 {
        let (response, state) = (self.laws.len(), course.numbers(peak.step.state));
        let (time, grading) = (self.recall_peak(course, peak), peak.step.grading);
        let length = peak.step.length;
        // As near to one another as a wave of a load is long, see `step_waves.rs`.
        let between = BETWEEN_POINTS * length.min(self.shown_length());
        largest_near(time, (length, between), |time| {
            let mut exact = self.jet_in_step(state, response, time).curvature;
            let place = grading.inverse(time / length);
            for (a, &element) in self.step.active.iter().enumerate() {
                let polynomial = self.step.interpolate(&self.step.force, a, place);
                let force = hole::force_of(&self.laws, element, |e| {
                    if self.laws[e].depends_on_velocity() {
                        self.refined_jet(state, e, time)
                    } else {
                        self.jet_in_step(state, e, time)
                    }
                });
                exact += self.mobility[response][element] * (force.value - polynomial);
            }
            exact.abs()
        })
    }

    /// Displacement (`derivative` 0) or acceleration (2) of the response point at the nodes of the solved
    /// step.
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
}

/// Largest value of a function in a step of that length, near a time: the vertices of parabolas through three
/// values so close to one another, as long as they move, or an end of the step.
fn largest_near(mut time: f64, (length, between): (f64, f64), value: impl Fn(f64) -> f64) -> f64 {
    let mut largest = value(time);
    for _ in 0..POLISHES {
        let middle = time.clamp(between, length - between);
        let [before, here, after] = [middle - between, middle, middle + between].map(&value);
        largest = largest.max(before).max(here).max(after);
        let away = 0.5 * between * (before - after) / (before - 2.0 * here + after);
        let next = (middle + away).clamp(0.0, length);
        if next.is_nan() {
            break;
        }
        largest = largest.max(value(next));
        if (next - time).abs() <= between {
            break;
        }
        time = next;
    }
    largest
}
