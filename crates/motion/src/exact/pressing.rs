//! What rigid stops that are held press with, in flight and while forces act, and where that ends.
//!
//! Of the forces `F_e` of the elements that act the held stops take a part at once, and another part through
//! the damping of the structure (`held.rs`):
//!
//! `lambda_j = C_j x + lambda_particular + sum_e gamma_je F_e`, `gamma_je = ((Phi D^-1)^T phi_e)_j`,
//! `lambda'_j = C_j A x + lambda'_particular + sum_e (C_j B_e F_e + gamma_je F'_e)`, `F' = f_r r' + f_v r''`.
//!
//! **In a force step** the motion is the convolution of the held structure, so x is known at every time, and
//! the forces follow from the law at the displacements, which are better than the polynomials of the forces.
//! `lambda_j` is looked at in panels of the step over which no block turns by more than [`RADIANS`]: twelve
//! nodes resolve it to some 1e-9 of its parts. From their polynomial follow where it first falls below zero,
//! its largest value and its integral. So that it tells all, the forces must be resolved, relative to what
//! the stops press with, also where they move nothing, as on a mass that is held itself: `gamma
//! tail(F)/(|lambda_j| + |gamma F|)` is one of the errors of a step (`step_error.rs`).
//!
//! **The lift.** The step ends where `lambda_j = 0` at its end, by Newton's method, as at other events
//! (`event.rs`). The accelerations are continuous there, and so the saltation matrix is the identity. Where
//! `lambda_j` falls below zero by a jump, of a force that sets in with a damper or of the velocities at an
//! impact, the stop is let go in that instant, and the sensitivities jump (`stick.rs`).

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES, Rule},
    drive::Jet,
    event::Event,
    polynomial::first_below,
    recurrence::gauss_sixteen,
    run::Run,
    step_error::Errors,
};

/// Radians of a block that sixteen Gauss points, and about as well the nodes of a panel, resolve.
const RADIANS: f64 = 4.0;
/// Share of the largest value in a step within which its polynomial does not tell whether a located lift
/// comes earlier once more.
const UNDECIDED: f64 = 1e-3;

/// What a held stop presses with at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pressing {
    /// The force and its rate, forces of elements included [N], [N/s].
    pub jet: Jet,
    /// Rounding margin of the force [N].
    pub margin: f64,
}

/// A part of a step, and a pressing force at the nodes of a rule in it.
struct Panel {
    /// Where it begins and ends in the variable of the step.
    from: f64,
    to: f64,
    rule: &'static Rule,
    values: [f64; NODES],
}

impl Panel {
    fn place(&self, s: f64) -> f64 {
        self.from + (self.to - self.from) * s
    }

    /// Where the force first falls below `-margin`. What lies before the first node of a step was looked at
    /// as it began.
    fn first_below(&self, margin: f64) -> Option<f64> {
        let found = if self.from == 0.0 {
            first_below(&self.rule.bernstein(&self.values), self.rule.s[0], margin)
        } else {
            first_below(&self.rule.bernstein_of_whole(&self.values), 0.0, margin)
        };
        found.map(|s| self.place(s))
    }
}

impl ExactIntegrator {
    /// Number of the output that tells what the j-th held stop presses with.
    fn pressing_output(&self, j: usize) -> usize {
        let held = self.holding.as_ref().map_or(0, |holding| holding.held.elements.len());
        self.outputs.len() - held + j
    }

    /// `gamma_je`.
    fn direct_part(&self, j: usize, element: usize) -> f64 {
        self.holding.as_ref().map_or(0.0, |holding| holding.held.direct(j, element))
    }

    /// Pressing forces of all elements, zero for those that are not held, from the homogeneous state at a
    /// time [N].
    pub(super) fn pressing_forces(&self, run: &Run, state: &[f64], time: f64) -> Vec<f64> {
        let mut forces = vec![0.0; self.laws.len()];
        let Some(holding) = &self.holding else { return forces };
        let active: Vec<usize> = (0..self.laws.len()).filter(|&e| self.acts(run, e)).collect();
        for (j, &element) in holding.held.elements.iter().enumerate() {
            forces[element] = self.pressing_with(&active, j, state, time);
        }
        forces
    }

    /// What the j-th held stop presses with while these elements act, from the homogeneous state at a time
    /// [N].
    fn pressing_with(&self, active: &[usize], j: usize, state: &[f64], time: f64) -> f64 {
        let mut force = self.output_jet(state, self.pressing_output(j), time).value;
        for &e in active {
            let at = self.output_jet(state, e, time);
            force += self.direct_part(j, e) * self.laws[e].pressing_force(at.value, at.slope).value;
        }
        force
    }

    /// The pressing force of the j-th held stop and its rate, from outputs and their derivatives apart from
    /// the direct part of the forces of `active` elements.
    fn pressing_jet(&self, active: &[usize], j: usize, jet: impl Fn(usize) -> Jet) -> Jet {
        let output = self.pressing_output(j);
        let mut pressing = jet(output);
        pressing.curvature = f64::NEG_INFINITY;
        let jets: Vec<Jet> = active.iter().map(|&e| jet(e)).collect();
        let of = |(jet, &e): (&Jet, &usize)| self.laws[e].pressing_force(jet.value, jet.slope);
        let forces: Vec<crate::Force> = jets.iter().zip(active).map(of).collect();
        for ((at, &e), force) in jets.iter().zip(active).zip(&forces) {
            let direct = active.iter().zip(&forces).map(|(&other, f)| self.mobility[e][other] * f.value);
            let acceleration = at.curvature + direct.sum::<f64>();
            let rate = force.slope * at.slope + force.damping * acceleration;
            let gain = self.direct_part(j, e);
            pressing.value += gain * force.value;
            let carried: f64 = self.outputs[output].row.iter().zip(&self.inputs[e]).map(|(c, b)| c * b).sum();
            pressing.slope += carried * force.value + gain * rate;
        }
        pressing
    }

    /// What the held stops press with now.
    pub(super) fn pressing_now(&self, run: &Run) -> Vec<Pressing> {
        let Some(holding) = &self.holding else { return Vec::new() };
        let active: Vec<usize> = (0..self.laws.len()).filter(|&e| self.acts(run, e)).collect();
        let jet = |output: usize| self.output_jet(&run.state, output, run.time);
        let of_stop = |j: usize| {
            let mut margin = self.bounds(&run.state, self.pressing_output(j), self.stretch.duration()).margin;
            for &e in &active {
                let at = jet(e);
                let force = self.laws[e].pressing_force(at.value, at.slope);
                let displacement = self.bounds(&run.state, e, self.stretch.duration()).margin;
                let velocity = self.velocity_rounding(&run.state, e);
                let rounding = force.slope.abs() * displacement + force.damping.abs() * velocity;
                margin += self.direct_part(j, e).abs() * (rounding + 8.0 * f64::EPSILON * force.value.abs());
            }
            Pressing { jet: self.pressing_jet(&active, j, jet), margin }
        };
        (0..holding.held.elements.len()).map(of_stop).collect()
    }

    /// A held stop that presses no more at the start of a step, or about to within rounding.
    pub(super) fn stop_that_lifts(&self, run: &Run) -> Option<usize> {
        let lifts = |pressing: &Pressing| {
            let Jet { value, slope, .. } = pressing.jet;
            value < -pressing.margin || (value <= pressing.margin && slope < 0.0)
        };
        let lifting = run.pressing.iter().zip(&run.stuck).filter(|(pressing, _)| lifts(pressing));
        lifting.min_by(|a, b| a.0.jet.value.total_cmp(&b.0.jet.value)).map(|(_, &element)| element)
    }

    /// What a held element presses with at the end of the solved step, and how fast that changes.
    pub(super) fn pressing_at_step_end(&self, run: &Run, element: usize) -> Jet {
        let j = self.held_place(run, element).unwrap_or(0);
        self.pressing_jet(&self.step.active, j, |output| self.free_jet_at_step_end(run, output))
    }

    /// Error of the forces in the solved step relative to what the held stops press with (`step_error.rs`).
    pub(super) fn pressing_error(&self, run: &Run) -> f64 {
        let step = &self.step;
        let of_stop = |(j, pressing): (usize, &Pressing)| {
            let (mut tail, mut size) = (0.0, pressing.jet.value.abs());
            for (force, &e) in step.force.as_chunks::<NODES>().0.iter().zip(&step.active) {
                let gain = self.direct_part(j, e).abs();
                tail += gain * step.tail(force).highest;
                size += gain * force.iter().fold(0.0_f64, |size, force| size.max(force.abs()));
            }
            let errors = Errors { tail: tail / size.max(f64::MIN_POSITIVE), ..Errors::default() };
            self.relative_to_bound(errors)
        };
        run.pressing.iter().enumerate().map(of_stop).fold(0.0, f64::max)
    }

    /// The pressing force of the j-th held stop over the solved step, which starts from `state`.
    fn panels(&self, state: &[f64], j: usize) -> Vec<Panel> {
        let (step, output) = (&self.step, self.pressing_output(j));
        let (grading, length) = (step.grading(), step.length);
        // A graded step passes its times up to twice as fast.
        let pace = if grading == Grading::Smooth { 1.0 } else { 2.0 };
        let turning = self.rates.iter().fold(0.0_f64, |fastest, rate| fastest.max(*rate)) * length;
        let count = (pace * turning / RADIANS).ceil().max(1.0) as usize;
        if turning <= RADIANS && length <= self.series.reach() {
            let loads = (step.active.as_slice(), step.force.as_slice());
            let mut values = self.series.node_values((output, 0), (grading, length), state, loads);
            for (k, value) in values.iter_mut().enumerate() {
                *value += self.drive.jet(output, &self.outputs[output], step.start + step.node_time(k)).value;
                for (a, &e) in step.active.iter().enumerate() {
                    *value += self.direct_part(j, e) * step.force[a * NODES + k];
                }
            }
            return vec![Panel { from: 0.0, to: 1.0, rule: grading.rule(), values }];
        }
        let (mut state, mut time) = (state.to_vec(), 0.0);
        let of_panel = |panel: usize| {
            let at = |panel: usize| panel as f64 / count as f64;
            let rule = Grading::Smooth.rule();
            let mut panel = Panel { from: at(panel), to: at(panel + 1), rule, values: [0.0; NODES] };
            for k in 0..NODES {
                let next = grading.map(panel.place(rule.s[k])).0 * length;
                self.carry_in_step(&mut state, time, next);
                time = next;
                panel.values[k] = self.pressing_with(&step.active, j, &state, step.start + time);
            }
            panel
        };
        (0..count).map(of_panel).collect()
    }

    /// The first lift of a held stop within the solved step, and when; of the one with which the step ends,
    /// once more before that, and none of those that are excused.
    pub(super) fn first_lift(
        &self,
        run: &Run,
        at_end: Option<Event>,
        excused: &[Event],
    ) -> Option<(Event, f64)> {
        let of_stop = |(j, &element): (usize, &usize)| {
            let event = Event::Lift(element);
            if excused.contains(&event) {
                return None;
            }
            let panels = self.panels(&run.state, j);
            let values = panels.iter().flat_map(|panel| panel.values);
            let largest = values.fold(0.0_f64, |largest, value| largest.max(value.abs()));
            let share = if at_end == Some(event) { UNDECIDED } else { 1e-9 };
            let margin = share * largest + run.pressing[j].margin;
            let place = panels.iter().find_map(|panel| panel.first_below(margin))?;
            Some((event, self.step.grading().map(place).0 * self.step.length))
        };
        let lifts = run.stuck.iter().enumerate().filter_map(of_stop);
        lifts.min_by(|x, y| x.1.total_cmp(&y.1))
    }

    /// Integrals of the pressing forces over the solved step, which starts from `state` [N s].
    pub(super) fn pressing_impulses(&self, state: &[f64]) -> Vec<f64> {
        let held = self.holding.as_ref().map_or(0, |holding| holding.held.elements.len());
        let (grading, length) = (self.step.grading(), self.step.length);
        let of_panel = |panel: &Panel| {
            let whole = panel.to - panel.from == 1.0;
            let weight = |k: usize| {
                let pace = if whole { 1.0 } else { grading.map(panel.place(panel.rule.s[k])).1 };
                panel.rule.at_end[0][k] * pace * (panel.to - panel.from) * length
            };
            (0..NODES).map(|k| weight(k) * panel.values[k]).sum::<f64>()
        };
        (0..held).map(|j| self.panels(state, j).iter().map(of_panel).sum()).collect()
    }

    /// The largest that the j-th held stop presses with in the solved step, which starts from `state`, if
    /// that is above `best` [N].
    pub(super) fn pressing_maximum(&self, state: &[f64], j: usize, best: f64) -> f64 {
        let mut best = best;
        for panel in &self.panels(state, j) {
            let (value, place) = panel.rule.extremum(&panel.values);
            if value * (1.0 + UNDECIDED) > best {
                let time = self.step.grading().map(panel.place(place)).0 * self.step.length;
                let mut then = state.to_vec();
                self.carry_in_step(&mut then, 0.0, time);
                best = best.max(self.pressing_with(&self.step.active, j, &then, self.step.start + time));
            }
        }
        best
    }

    /// Integrals of the pressing forces over a flight of the held structure, by Gauss' rule over panels that
    /// resolve every block [N s].
    pub(super) fn held_impulses(&self, state: &[f64], start: f64, duration: f64) -> Vec<f64> {
        let Some(holding) = &self.holding else { return Vec::new() };
        let s = holding.held.elements.len();
        let orders = self.system.orders().iter().copied().max().unwrap_or(0);
        let driven = f64::from(orders) * self.drive.circular_frequency();
        let fastest = self.rates.iter().fold(driven, |fastest, rate| fastest.max(*rate));
        let panels = (fastest * duration / RADIANS).ceil().max(1.0) as usize;
        let width = duration / panels as f64;
        let mut sums = vec![0.0; s];
        let mut moved = state.to_vec();
        for (panel, &(x, weight)) in
            (0..panels).flat_map(|panel| gauss_sixteen().iter().map(move |node| (panel, node)))
        {
            let time = (panel as f64 + x) * width;
            self.blocks.fly(state, time, &mut moved);
            for (j, sum) in sums.iter_mut().enumerate() {
                let force = self.output_jet(&moved, self.pressing_output(j), start + time).value;
                *sum += weight * width * force;
            }
        }
        sums
    }
}
