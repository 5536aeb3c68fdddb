//! The error of a solved step. Equations (S9) to (S12) of the book, `docs/theory`.
//!
//! Over a step of length h the force `F` of each active element, its slope `f'` and its sensitivities `dF`
//! are expanded in the orthonormal polynomials of the step, up to the degree `m = NODES - 1`; the tail of a
//! function is the magnitude of its two highest coefficients added, its decay D the tail over the same at
//! half the degree. With the mobility `G` (of `C A B` what can follow within the step) and the largest
//! relative velocity `V` that the present state can reach, or that the load gives it in the step,
//!
//! `T = h G tail(F)/V`, or `sqrt(h G tail(F)/V . (h^2 G tail(f') + h G tail(f_v)))` if that is larger,
//!
//! is the relative error of the force. On Gauss nodes it is orthogonal to all that is smooth over the step,
//! so the state at the end has about its square; `T D^2`, the force in the polynomials of twice the degree,
//! if that is larger: near a half-integer power outside the step the coefficients fall slowly. Where a force
//! has a corner, as `abs(x)`, they fall with a power of the degree only: then the polynomials of twice the
//! degree leave `T D`, and what happens between an end of the step and the node next to it is seen at
//! the end alone: what the polynomial through the nodes misses there counts as a tail. What it misses there
//! of the slopes, the sensitivities miss over that part of the step, [`AT_AN_END`] of it. Of the share
//! `S` of the blocks that are not smooth over the step it has the error itself; blocks and orders of the load
//! so fast that the nodes do not resolve their part `U` in the force leave that part: of what is smooth over
//! the step the share `(z/4)^2n/(2n)!` on n nodes, if they turn by z; of the motion of such a block itself,
//! which is in resonance with it and resolved no better, the share `((z/4)^n/n!)^2`, each of its own, so that
//! squares add. What U leaves of a velocity moves the release, up to which the sensitivities follow the
//! force, so where they are wanted it counts `1 + h^2 G f' + h G f_v` times. Orders in resonance with a mode
//! without damping (`secular.rs`), and what an order is in the column by a parameter, have no part in U. The
//! step is accepted if
//!
//! `T^2`, `T D^2 <= 4 tolerance` and `T S`, `U <= 10 tolerance`,
//!
//! where T is also that of what held stops press with (`pressing.rs`), and, where sensitivities are
//! wanted, the same holds of them, relative to the largest sensitivity of a velocity (columns of
//! displacements divided by the eigenfrequency). The columns by the frequency and by a parameter have
//! scales of their own: their velocity, or [`LEAST_SHARE`] of the largest one that they can reach. The
//! velocity alone may vanish, as that by the frequency does with a load that is largest at the start of
//! a stretch; the rounding of the force would then be compared with nothing. Before the first contact
//! the motion does not depend on its stiffness, so there that column has no other scale than what the
//! contact itself makes: in one of the depth `p` it is known to the part `e/p`, with the rounding `e` of
//! a displacement. So of the tails of that column, whatever the parameter, [`ROUNDING`] times the
//! largest such part of the elements that act is taken off.

use std::{f64::consts::TAU, sync::Arc};

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::{Jet, Order},
    hole,
    run::{ElementStart, Run},
};
use crate::law::Force;

/// Share of the velocity that a further column can reach: its scale where its own velocity is smaller.
const LEAST_SHARE: f64 = 0.01;

/// How the expansion of a function over a step ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Tail {
    /// The two highest coefficients, in magnitude, added.
    pub highest: f64,
    /// The same at half the degree.
    pub middle: f64,
}

impl Tail {
    /// Part that is left at twice the degree.
    fn decay(self, has_corners: bool) -> f64 {
        let over_half = (self.highest / self.middle.max(f64::MIN_POSITIVE)).min(1.0);
        if has_corners { over_half } else { over_half.powi(2) }
    }
}

/// What a fast block or order of the load has in the force, relative to the velocities [1/s].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Unresolved {
    /// As far as it acts on what is smooth over the step.
    smooth: f64,
    /// As far as it acts on the block itself.
    resonant: f64,
}

impl Unresolved {
    fn raise(&mut self, smooth: f64, resonant: f64) {
        self.smooth = self.smooth.max(smooth);
        self.resonant = self.resonant.max(resonant);
    }
}

/// Relative errors of a step by the file header.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Errors {
    /// `T`.
    pub tail: f64,
    /// `T D^2`; of a force with corners `T D`, or what sensitivities miss at the ends if that is larger.
    pub slow: f64,
    /// `S`.
    pub fast_share: f64,
}

/// The largest slopes of a force by displacement and velocity over a step.
#[derive(Debug, Clone, Copy)]
struct Steepest {
    stiffness: f64,
    damping: f64,
}

impl Steepest {
    /// What the force follows of a motion with that displacement and that velocity.
    fn force(self, displacement: f64, velocity: f64) -> f64 {
        self.stiffness * displacement + self.damping * velocity
    }
}

/// How an element's displacement responds to its force over a step.
#[derive(Debug, Clone, Copy)]
struct Response {
    /// The mobility G of the blocks as far as they follow.
    mobility: f64,
    /// `S`.
    fast_share: f64,
}

/// What rounding of the displacements leaves in the tail of a column of a contact, in parts of the column
/// times rounding over depth.
const ROUNDING: f64 = 32.0;
const HIGHEST: (i32, f64) = degree(NODES - 1);
const ALL_NODES: (i32, f64) = degree(NODES);
const TWICE_THE_NODES: (i32, f64) = degree(2 * NODES);
/// Part of a step beyond the node next to an end, equation (S12).
const AT_AN_END: f64 = 0.01;
/// Largest factor from one step to the next.
pub(super) const LONGEST_GROWTH: f64 = 5.0;
/// Turning of a block or of the load over a step, in radians, below which the nodes resolve it to rounding.
const RESOLVED: f64 = 5.5;

impl ExactIntegrator {
    /// Largest velocity that an output can reach from the present state.
    pub(super) fn speed_bound(&self, state: &[f64], output: usize) -> f64 {
        let o = &self.outputs[output];
        self.drive.speed(output)
            + (0..self.blocks.count()).map(|i| o.first_bound[i] * self.energy_norm(state, i)).sum::<f64>()
    }

    /// The same of an element: of a hole in any direction.
    pub(super) fn element_speed(&self, state: &[f64], element: usize) -> f64 {
        let own = self.speed_bound(state, element);
        let is_hole = self.laws[element].round_hole().is_some();
        if is_hole { own.hypot(self.speed_bound(state, element + 1)) } else { own }
    }

    pub(super) fn energy_norm(&self, state: &[f64], block: usize) -> f64 {
        let (p, s) = (state[block], state[self.blocks.count() + block]);
        (self.blocks.stiffness[block] * p * p + s * s).sqrt()
    }

    /// Error of the state at the end of the solved step, relative to its bound, to the power that makes it go
    /// like `h^NODES`.
    pub(super) fn state_error(&mut self, run: &Run) -> f64 {
        let mut amplitudes = std::mem::take(&mut self.step.unresolved);
        amplitudes.clear();
        amplitudes.resize(self.rates.len() + self.drive.orders.len(), Unresolved::default());
        let mut largest = 0.0_f64;
        for (a, &element) in self.step.active.iter().enumerate() {
            let (step, nodes) = (&self.step, a * NODES..(a + 1) * NODES);
            let response = self.response(element);
            let impulse = step.length * response.mobility;
            let ElementStart { output, velocity, .. } = run.start[element];
            let driven = output.slope.abs() + output.curvature.abs() * step.length;
            let velocity = velocity.max(driven).max(f64::MIN_POSITIVE);
            let of_nodes = |values: &[f64]| step.tail(&values.as_chunks::<NODES>().0[a]);
            let mut force = of_nodes(&step.force);
            let has_corners = self.laws[element].has_corners();
            let mut missed_slope = 0.0;
            if has_corners {
                let missed = self.missed_at_ends(run, a);
                force.highest = force.highest.max(missed.value);
                if run.sensitivity.is_some() {
                    let slowest = self.drive.circular_frequency();
                    missed_slope = AT_AN_END * impulse * (missed.slope / slowest + missed.damping);
                }
            }
            let tail = impulse * force.highest / velocity;
            let mut dual = impulse * step.length * of_nodes(&step.slope).highest;
            if step.has_holes() {
                dual += impulse * step.length * of_nodes(&step.cross).highest;
            }
            if step.damped {
                dual += impulse * of_nodes(&step.damping).highest;
            }
            let errors = Errors {
                tail: tail.max((tail * dual).sqrt()),
                slow: (tail * force.decay(has_corners)).max(missed_slope),
                fast_share: response.fast_share,
            };
            largest = largest.max(self.relative_to_bound(errors));
            let (of_blocks, of_loads) = amplitudes.split_at_mut(self.rates.len());
            let steepest = self.steepest(nodes);
            let output = &self.outputs[element];
            for (i, amplitude) in of_blocks.iter_mut().enumerate() {
                if self.may_be_unresolved(self.rates[i]) {
                    let follows = steepest.force(output.value_bound[i], output.first_bound[i]);
                    let vibration = follows * self.vibration(run, i) / velocity;
                    amplitude.raise(response.mobility * vibration, self.mobility_of(element, i) * vibration);
                }
            }
            for (amplitude, (rate, order)) in of_loads.iter_mut().zip(self.loads()) {
                if self.may_be_unresolved(rate) {
                    // What moves the release, up to which sensitivities follow the force.
                    let dual = impulse * steepest.force(self.step.length, 1.0);
                    let count = if run.sensitivity.is_some() { 1.0 + dual } else { 1.0 };
                    let follows = response.mobility * steepest.force(1.0, rate);
                    amplitude.raise(count * follows * order.outputs[element].0.norm() / velocity, 0.0);
                }
            }
        }
        self.step.unresolved = amplitudes;
        if !run.stuck.is_empty() {
            largest = largest.max(self.pressing_error(run));
        }
        largest.max(self.unresolved_excess())
    }

    /// By how much the polynomials through the nodes miss the force of the a-th active element and its
    /// derivatives at the ends of the solved step.
    fn missed_at_ends(&self, run: &Run, a: usize) -> Force {
        let (step, element) = (&self.step, self.step.active[a]);
        let mut missed = Force::ZERO;
        for (place, output) in
            [(0.0, run.start[element].output), (1.0, self.free_jet_at_step_end(run, element))]
        {
            let force = self.laws[element].force(output.value, output.slope);
            let off = |values: &[f64], found: f64| (step.interpolate(values, a, place) - found).abs();
            missed.value = missed.value.max(off(&step.force, force.value));
            missed.slope = missed.slope.max(off(&step.slope, force.slope));
            if step.damped {
                missed.damping = missed.damping.max(off(&step.damping, force.damping));
            }
        }
        missed
    }

    /// The largest slopes of a force over nodes of the solved step.
    fn steepest(&self, nodes: std::ops::Range<usize>) -> Steepest {
        let (step, mut stiffness) = (&self.step, largest_magnitude(&self.step.slope[nodes.clone()]));
        if step.has_holes() {
            stiffness += largest_magnitude(&step.cross[nodes.clone()]);
        }
        let damping = if step.damped { largest_magnitude(&step.damping[nodes]) } else { 0.0 };
        Steepest { stiffness, damping }
    }

    /// Orders of the load with their circular frequencies as the nodes of the step see them: time in a graded
    /// one goes like the square of its variable, so at its end a load turns twice as fast.
    fn loads(&self) -> impl Iterator<Item = (f64, &Order)> {
        let pace = if self.step.grading() == Grading::Smooth { 1.0 } else { 2.0 };
        let circular = self.drive.circular_frequency();
        self.drive.orders.iter().map(move |order| (pace * order.order * circular, order))
    }

    /// Energy norm of a block apart from what follows the present forces and their rates without vibrating:
    /// those are smooth.
    fn vibration(&self, run: &Run, block: usize) -> f64 {
        let n = self.blocks.count();
        let (k, c) = (self.blocks.stiffness[block], self.blocks.damping[block]);
        let (mut p, mut s) = (run.state[block], run.state[n + block]);
        if k > 0.0 {
            for &element in &self.step.active {
                let outputs = |e: usize| self.output_inside(run, e);
                let force = hole::force_of(&self.laws, element, outputs);
                let rate = hole::force_rate(&self.laws, element, outputs);
                let input = &self.inputs[element];
                // `-A^-1 B F - A^-2 B F'`.
                let first = [(input[n + block] + c * input[block]) / k, -input[block]];
                let second = [-(first[1] + c * first[0]) / k, first[0]];
                p -= first[0] * force.value + second[0] * rate;
                s -= first[1] * force.value + second[1] * rate;
            }
        }
        (k * p * p + s * s).sqrt()
    }

    /// The output of an element at the start of a step, within its contact by the rounding margin: a touch is
    /// located within rounding of its level, as often in front of it, where a stop has no slope.
    fn output_inside(&self, run: &Run, element: usize) -> Jet {
        let output = run.start[element].output;
        let owner = hole::owner(&self.laws, element);
        let Some(contact) = self.closed_contact(run, owner) else { return output };
        let ElementStart { jet, margin, .. } = run.start[owner];
        let missing = (margin - contact.sign * (jet.value - contact.level)).max(0.0);
        let value = if self.laws[owner].round_hole().is_some() {
            output.value * (1.0 + missing / contact.level)
        } else {
            output.value + contact.sign * missing
        };
        Jet { value, ..output }
    }

    pub(super) fn relative_to_bound(&self, errors: Errors) -> f64 {
        let square = errors.tail.powi(2).max(errors.slow) / 4.0;
        let linear = errors.tail * errors.fast_share / 10.0;
        (square.max(linear) / self.settings.tolerance).sqrt()
    }

    /// How an element's displacement responds to its force over the step.
    ///
    /// A block that turns by z over the step has about `(z/4)^m/m!` of its response in the polynomial of
    /// degree m, and it moves by no more than `2/z` of what it would without its stiffness.
    fn response(&self, element: usize) -> Response {
        let (mut mobility, mut fast) = (0.0, 0.0);
        for (rate, share) in self.rates.iter().zip(&self.shares[element]) {
            let z = rate * self.step.length;
            mobility += share * (2.0 / z).min(1.0);
            fast += share * highest_part(z, &HIGHEST).min(z.recip()) * z.recip().min(1.0);
        }
        // Where held stops leave nothing that moves, all is followed.
        let fast_share = if mobility > 0.0 { fast / mobility } else { 0.0 };
        Response { mobility: mobility * self.mobility[element][element], fast_share }
    }

    /// Part of a block in the mobility of an element.
    fn mobility_of(&self, element: usize, block: usize) -> f64 {
        self.shares[element][block] * self.mobility[element][element]
    }

    /// `U` of a step of that length, from what the last step solved has left of it: blocks, then orders.
    fn unresolved(&self, length: f64) -> f64 {
        let rates = self.rates.iter().copied().chain(self.loads().map(|(rate, _)| rate));
        let (mut smooth, mut resonant) = (0.0, 0.0);
        for (rate, amplitude) in rates.zip(&self.step.unresolved) {
            let z = rate * length;
            if z > RESOLVED {
                smooth += highest_part(z, &TWICE_THE_NODES) * amplitude.smooth;
                resonant += (highest_part(z, &ALL_NODES).powi(2) * amplitude.resonant).powi(2);
            }
        }
        (smooth + resonant.sqrt()) * length
    }

    /// `U` relative to its bound, if it is above.
    fn unresolved_excess(&self) -> f64 {
        let excess = self.unresolved(self.step.length) / (10.0 * self.settings.tolerance);
        if excess > 1.0 { excess.sqrt() } else { 0.0 }
    }

    /// Whether a block or a load of that rate is so fast that a somewhat longer step might not resolve it.
    fn may_be_unresolved(&self, rate: f64) -> bool {
        rate * self.step.length * LONGEST_GROWTH > RESOLVED
    }

    /// The longest step up to `length` whose nodes resolve the motion.
    pub(super) fn resolved_length(&self, length: f64) -> f64 {
        let mut length = length;
        while self.unresolved(length) > 10.0 * self.settings.tolerance {
            length *= 0.8;
        }
        length
    }

    /// Rounding of the displacement of the a-th active element, relative to the depth of its contact in the
    /// solved step; 0 where it always acts.
    fn relative_rounding(&self, run: &Run, a: usize) -> f64 {
        let element = self.step.active[a];
        let Some(contact) = self.closed_contact(run, element) else { return 0.0 };
        let nodes = self.step.nodal_readings(&self.laws, a);
        let depth = nodes.iter().fold(0.0_f64, |depth, r| depth.max((r - contact.level).abs()));
        run.start[element].margin / depth.max(f64::MIN_POSITIVE)
    }

    /// Solves for the sensitivities of the forces of the solved step; their error, 0 if none are wanted,
    /// `None` if the step is singular.
    pub(super) fn sensitivity_error(&mut self, run: &Run) -> Option<f64> {
        let Some(sensitivity) = &run.sensitivity else { return Some(0.0) };
        if !self.step.weights.complete {
            let active = (self.step.active.as_slice(), self.step.damped);
            let shape = (self.step.grading(), self.step.length);
            self.series.complete(active, shape, Arc::make_mut(&mut self.step.weights));
        }
        self.prepare_driven(run);
        let parameter = self.parameter;
        self.step.solve_sensitivity(&self.drive, (&self.laws, &self.outputs), sensitivity, parameter).ok()?;
        let slowest = self.drive.circular_frequency();
        let frequencies = &self.system.model().natural_frequencies;
        let scale = |column: usize| frequencies.get(column).map_or(1.0, |w| w.max(slowest));
        let (mut errors, mut norm) = (Errors::default(), f64::MIN_POSITIVE);
        let mut by_frequency = f64::MIN_POSITIVE;
        // By the frequency and by a parameter.
        let mut further = [Errors::default(); 2];
        let elements = 0..self.step.active.len();
        let rounding = ROUNDING * elements.map(|a| self.relative_rounding(run, a)).fold(0.0, f64::max);
        for a in 0..self.step.active.len() {
            let element = self.step.active[a];
            let response = self.response(element);
            let impulse = self.step.length * response.mobility.sqrt();
            for (column, found) in self.step.sensitivity_tails(a, sensitivity).enumerate() {
                let further_column = column >= sensitivity.frequency_column();
                let velocity = if further_column {
                    let reachable = sensitivity.energy_norm_of(column, &self.blocks.stiffness);
                    found.velocity.max(LEAST_SHARE * reachable)
                } else {
                    found.velocity
                };
                let size = velocity + impulse * found.largest;
                let mut highest = found.tail.highest;
                let (scale, into) = if further_column {
                    if column == sensitivity.frequency_column() {
                        by_frequency = by_frequency.max(size);
                    }
                    if sensitivity.parameter_column() == Some(column) {
                        highest = (highest - rounding * found.largest).max(0.0);
                    }
                    (size.max(f64::MIN_POSITIVE), &mut further[column - sensitivity.frequency_column()])
                } else {
                    norm = norm.max(size / scale(column));
                    (scale(column), &mut errors)
                };
                let tail = impulse * highest / scale;
                into.tail = into.tail.max(tail);
                into.slow = into.slow.max(tail * found.tail.decay(self.laws[element].has_corners()));
                into.fast_share = into.fast_share.max(response.fast_share);
            }
        }
        errors.tail /= norm;
        errors.slow /= norm;
        let error = further.map(|errors| self.relative_to_bound(errors));
        let error = self.relative_to_bound(errors).max(error[0]).max(error[1]);
        let mut amplitudes = std::mem::take(&mut self.step.unresolved);
        let (of_blocks, of_loads) = amplitudes.split_at_mut(self.rates.len());
        let steepest = self.steepest(0..self.step.slope.len());
        for &element in &self.step.active {
            let (output, mobility) = (&self.outputs[element], self.response(element).mobility.sqrt());
            for (i, amplitude) in of_blocks.iter_mut().enumerate() {
                if self.may_be_unresolved(self.rates[i]) {
                    let follows = steepest.force(output.value_bound[i], output.first_bound[i]);
                    let largest = sensitivity.largest_energy_norm(i, self.blocks.stiffness[i], &scale);
                    // Columns of their own vibration keep steps so short that its resonance is resolved.
                    amplitude.raise(mobility * follows * largest / norm, 0.0);
                }
            }
            let turned = TAU * (run.time + self.step.length);
            for (amplitude, (rate, order)) in of_loads.iter_mut().zip(self.loads()) {
                if self.may_be_unresolved(rate) {
                    let (value, slope) = order.outputs[element];
                    let slope = slope.norm() + turned * order.order * value.norm();
                    amplitude.raise(mobility * steepest.force(1.0, rate) * slope / by_frequency, 0.0);
                }
            }
        }
        self.step.unresolved = amplitudes;
        Some(error.max(self.unresolved_excess()))
    }
}

/// About the part of `exp(i z t)` over a step in the polynomial of a degree: `(z/4)^degree/degree!`, at
/// most 1.
fn highest_part(z: f64, (degree, factorial): &(i32, f64)) -> f64 {
    ((0.25 * z).powi(*degree) / factorial).min(1.0)
}

fn largest_magnitude(values: &[f64]) -> f64 {
    values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()))
}

/// A degree and its factorial.
const fn degree(degree: usize) -> (i32, f64) {
    let (mut factorial, mut k) = (1.0, 2);
    while k <= degree {
        factorial *= k as f64;
        k += 1;
    }
    (degree as i32, factorial)
}
