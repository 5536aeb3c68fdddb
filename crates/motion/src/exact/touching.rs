//! Open contacts that close while forces act, and closed ones that open: the certified search of a
//! flight (`clearance.rs`), with forces. Equations (C6) and (C7) of the book, `docs/theory`.
//!
//! In a solved step the forces are known polynomials, so the relative displacement `r` of an open element is
//! a known function too. With the homogeneous block state `x(t)` of the step, `x' = A x + sum_a B_a F_a(t)`,
//! over the row `C` of the element and with the mobility `G = C A B` (`C B` vanishes):
//!
//! `r'' = r_particular'' + C A^2 x + sum_a G_a F_a`, `r''' = r_particular''' + C A^3 x + sum_a (C A^2 B_a
//! F_a + G_a F_a')`.
//!
//! **What is proved.** A constant part `M_a` of each force, the middle of its range, only moves the rest
//! position of every block: with `y = x + sum_a A^-1 B_a M_a`, `r'' = r_particular'' + C A^2 y + sum_a G_a
//! (F_a - M_a)`. (A rigid block has no such position: for it y is x, and it takes the whole force.) The
//! energy norm `|y_i|` of a block decays without forces, and `|B_ai| R_a` is the most that a force of the
//! range `|F_a - M_a| <= R_a` can add per time. So over a window of length T from the state at a look,
//!
//! `B_2 = P_2 + sum_i g_i^(2) (|y_i| + T sum_a |B_ai| R_a) + sum_a |G_a| R_a`,
//! `B_3 = P_3 + sum_i g_i^(3) (|y_i| + T sum_a |B_ai| R_a) + sum_a (|C A^2 B_a| R_a + |G_a| rate_a)`
//!
//! bound `|r''|` and, apart from jumps, `|r'''|`: `r''` is nowhere lower than `r''(0) - J - B_3 t` with `J =
//! sum_a |G_a| jump_a`. The `P` bound the particular solution, the `g^(d)` are the factors of the output's
//! derivatives on the energy norms, and middle, range, rate and jump are those of `force_bound.rs`: finite
//! for every grading. With the second derivative `r''(0) - J` these are the bounds that the safe steps of
//! `clearance.rs` need, so no contact of the motion *that is computed* is missed, down to the margin. What
//! that differs from the exact motion is the error of the step. The window is the rest of the step at first;
//! where the safe step is much shorter, a window of its size gives better bounds.
//!
//! **A closed contact** opens where its penetration ends, or its pressure. Where `enclosure.rs` proves that
//! it does not, nothing is searched; else the search is the same, for the penetration or for `-s` below. It
//! goes on to what the location of an event leaves open of the end of the step; an opening that it finds in
//! the first part [`SAME`] of the step is none, since what the contact does there was decided as the step
//! began.
//!
//! **A contact that has parted** is watched for its pressure `s = a p + b p' + d` to come back, with `|s''|
//! <= a B_2 + b B_3` apart from the jump, which is taken off `s'`; and for its penetration to end.
//!
//! **The margin.** Every look carries the state on from the last one by the exact propagators and a
//! quadrature that leaves rounding, so the margin grows with the number of looks k: `(8 + k) eps` times the
//! sum of the magnitudes of the terms of `r`, those of the forces included. A clearance within it that still
//! falls is a contact; a minimum within it is a graze.
//!
//! **When it cannot decide.** After [`MAX_LOOKS`] looks at a contact the search says [`Unresolved`], and the
//! step is shortened: in a shorter step the same number of looks goes further, since every look gets on by at
//! least `sqrt(2 margin/B_2)`.

use super::{
    ExactIntegrator,
    aim::SAME,
    clearance::{ClearanceBounds, Convex, Look, decide_convex, look},
    collocation::NODES,
    drive::Jet,
    event::Event,
    flight::{Boundary, Touch},
    force_bound::ForceBound,
    hole::{OutputBounds, farthest, reading_bounds},
    run::Run,
};

/// Most looks at an open contact within one force step; up to ten are usual.
const MAX_LOOKS: usize = 400;
/// Times that the window of the bounds is made smaller at one look.
const WINDOWS: usize = 4;

/// The search did not get to the end of the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Unresolved;

impl ExactIntegrator {
    /// The first open contact that closes within the solved step, or closed one that comes to a kink,
    /// and when. That of `event` closes at its end, those `excused` are not looked for.
    pub(super) fn first_touch_in_step(
        &mut self,
        run: &Run,
        event: Option<Event>,
        excused: &[Event],
    ) -> Result<Option<(Touch, f64)>, Unresolved> {
        let mut first: Option<(Touch, f64)> = None;
        let is_watched = |e: &usize| match run.closed[*e] {
            Some(_) => self.laws[*e].has_kinks(),
            None => !self.laws[*e].contacts().is_empty() && !run.stuck.contains(e),
        };
        let watched: Vec<usize> = (0..self.laws.len()).filter(is_watched).collect();
        if watched.is_empty() {
            return Ok(None);
        }
        let forced = Forced::new(self);
        for element in watched {
            let from = self.looked_past(run, element);
            let closed = run.closed[element];
            let open = closed.is_none().then(|| self.watched(element, run.parted[element]));
            let kinks = closed.map(|contact| self.watched_kinks(element, contact));
            for touch in open.into_iter().flatten().chain(kinks.into_iter().flatten()) {
                if excused.contains(&Event::Touch(touch)) {
                    continue;
                }
                let mut until = first.map_or(self.step.length, |(_, time)| time);
                if event == Some(Event::Touch(touch)) {
                    until = until.min(self.step.length - self.located_within(run, Event::Touch(touch)));
                }
                if let Some(time) = self.search(run, Sought::Open(touch), &forced, (from, until))? {
                    first = Some((touch, time));
                }
            }
        }
        Ok(first)
    }

    /// The first closed contact that opens within the solved step, and when, if it is not proved that none
    /// does. That of `event` opens at its end, those `excused` are not looked for.
    pub(super) fn first_opening_in_step(
        &mut self,
        run: &Run,
        event: Option<Event>,
        excused: &[Event],
    ) -> Result<Option<(Event, f64)>, Unresolved> {
        for a in 0..self.step.active.len() {
            let element = self.step.active[a];
            if run.closed[element].is_some() {
                self.keep_step_end(run, element);
            }
        }
        let is_doubtful =
            |sought: &(usize, Event)| !excused.contains(&sought.1) && !self.stays_above(run, *sought, event);
        let doubtful: Vec<(usize, Event)> = self.possible_ends(run).filter(is_doubtful).collect();
        if doubtful.is_empty() {
            return Ok(None);
        }
        let forced = Forced::new(self);
        let mut first: Option<(Event, f64)> = None;
        for (_, ending) in doubtful {
            let Some(contact) = run.closed[ending.element()] else { continue };
            let mut until = first.map_or(self.step.length, |(_, time)| time);
            if event == Some(ending) {
                until = until.min(self.step.length - self.located_within(run, ending));
            }
            let boundary =
                if matches!(ending, Event::Part(_)) { Boundary::Presses } else { Boundary::Leaves };
            let sought = Sought::Closed(Touch { element: ending.element(), contact, boundary });
            let found = self.search(run, sought, &forced, (0.0, until))?;
            if let Some(time) = found.filter(|time| *time > SAME * self.step.length) {
                first = Some((ending, time));
            }
        }
        Ok(first)
    }

    /// When a contact crosses its boundary between two times in the solved step; there may be nothing between
    /// them.
    fn search(
        &mut self,
        run: &Run,
        sought: Sought,
        forced: &Forced,
        (from, until): (f64, f64),
    ) -> Result<Option<f64>, Unresolved> {
        if from >= until {
            return Ok(None);
        }
        let found = Search::new(self, run, sought, forced, (from, until)).run();
        self.counts.looks += found.looks;
        found.result
    }

    /// Time in the step before which an element is not looked at: it has just left its rigid stop, and
    /// rounding would decide on its clearance.
    pub(super) fn looked_past(&self, run: &Run, element: usize) -> f64 {
        (run.left[element].until - run.time).max(0.0)
    }
}

/// What the forces of the solved step do to the blocks.
struct Forced {
    /// Bounds on the force of each active element.
    bounds: Vec<ForceBound>,
    /// Rest position under the middle of the forces, length 2n; zero for rigid blocks.
    rest: Vec<f64>,
    /// `sum_a |B_ai| R_a`, length n: the energy norm that each block can gain per time.
    gain: Vec<f64>,
}

impl Forced {
    fn new(it: &ExactIntegrator) -> Self {
        let (step, blocks) = (&it.step, &it.blocks);
        let n = blocks.count();
        let of_active = |a: usize| {
            let nodal: [f64; NODES] = std::array::from_fn(|k| step.force[a * NODES + k]);
            ForceBound::new(step.grading(), step.length, &nodal, step.tail(&nodal).highest)
        };
        let bounds: Vec<ForceBound> = (0..step.active.len()).map(of_active).collect();
        let (mut rest, mut gain) = (vec![0.0; 2 * n], vec![0.0; n]);
        for (force, &active) in bounds.iter().zip(&step.active) {
            let input = &it.inputs[active];
            for i in 0..n {
                let (k, c) = (blocks.stiffness[i], blocks.damping[i]);
                gain[i] += (k * input[i].powi(2) + input[n + i].powi(2)).sqrt() * force.range_of(k == 0.0);
                if k > 0.0 {
                    rest[i] += (input[n + i] + c * input[i]) / k * force.middle;
                    rest[n + i] -= input[i] * force.middle;
                }
            }
        }
        Self { bounds, rest, gain }
    }
}

/// Bounds on what the forces add to the derivatives of an output directly.
#[derive(Debug, Clone, Copy, Default)]
struct Direct {
    second: f64,
    third: f64,
    /// `J`.
    jump: f64,
}

impl Direct {
    fn new(it: &ExactIntegrator, forced: &Forced, element: usize) -> Self {
        let (n, output) = (it.blocks.count(), &it.outputs[element]);
        let mut direct = Self::default();
        for (force, &active) in forced.bounds.iter().zip(&it.step.active) {
            let input = &it.inputs[active];
            // Parts of `C A B` and `C A^2 B` in the blocks, elastic and rigid.
            let (mut mobility, mut later) = ([0.0; 2], [0.0; 2]);
            for i in 0..n {
                let kind = usize::from(it.blocks.stiffness[i] == 0.0);
                mobility[kind] +=
                    output.velocity_row[i] * input[i] + output.velocity_row[n + i] * input[n + i];
                later[kind] +=
                    output.acceleration_row[i] * input[i] + output.acceleration_row[n + i] * input[n + i];
            }
            let all = |parts: [f64; 2]| (parts[0] + parts[1]).abs();
            direct.second += all(mobility) * force.range + mobility[1].abs() * force.middle.abs();
            direct.third +=
                all(later) * force.range + later[1].abs() * force.middle.abs() + all(mobility) * force.rate;
            direct.jump += all(mobility) * force.jump;
        }
        direct
    }
}

/// What a search ended with.
struct Found {
    looks: u64,
    result: Result<Option<f64>, Unresolved>,
}

/// Whose boundary is searched for.
#[derive(Debug, Clone, Copy)]
enum Sought {
    /// Of a contact without force: its clearance, its missing pressure, or its penetration.
    Open(Touch),
    /// Of a closed one: its penetration, or its pressure.
    Closed(Touch),
}

/// Search for the time at which one contact crosses a boundary within the solved step.
struct Search<'a> {
    integrator: &'a ExactIntegrator,
    touch: Touch,
    /// Whether it is closed: what falls to zero is the pressure, and not what is missing of it.
    is_closed: bool,
    forced: &'a Forced,
    direct: Direct,
    /// Of the second direction of a hole.
    direct_across: Option<Direct>,
    /// End of the search, counted from the start of the step [s].
    until: f64,
    /// Time of the last look, and the homogeneous state then.
    time: f64,
    state: Vec<f64>,
    looks: usize,
}

impl<'a> Search<'a> {
    fn new(
        integrator: &'a ExactIntegrator,
        run: &'a Run,
        sought: Sought,
        forced: &'a Forced,
        (from, until): (f64, f64),
    ) -> Self {
        let (touch, is_closed) = match sought {
            Sought::Open(touch) => (touch, false),
            Sought::Closed(touch) => (touch, true),
        };
        let direct = Direct::new(integrator, forced, touch.element);
        let is_hole = integrator.laws[touch.element].round_hole().is_some();
        let direct_across = is_hole.then(|| Direct::new(integrator, forced, touch.element + 1));
        let mut state = run.state.clone();
        if from > 0.0 {
            integrator.carry_in_step(&mut state, 0.0, from);
        }
        Self {
            integrator,
            touch,
            is_closed,
            forced,
            direct,
            direct_across,
            until,
            time: from,
            state,
            looks: 0,
        }
    }

    fn run(mut self) -> Found {
        let result = self.first_closing();
        Found { looks: self.looks as u64, result }
    }

    fn first_closing(&mut self) -> Result<Option<f64>, Unresolved> {
        if self.closes_again_at_once() {
            return Ok(Some(self.time));
        }
        while self.looks < MAX_LOOKS {
            self.looks += 1;
            let (step, hit) = self.look();
            if hit {
                return Ok(Some(self.time + step).filter(|&time| time < self.until));
            }
            let next = self.time + step;
            if next >= self.until {
                return Ok(None);
            }
            self.state = self.state_at(next);
            self.time = next;
        }
        Err(Unresolved)
    }

    /// Whether a contact that was just released comes back before it rises above what its own location left
    /// undecided.
    fn closes_again_at_once(&self) -> bool {
        if self.touch.boundary != Boundary::Closes {
            return false;
        }
        let start = self.clearance(&self.state, self.time);
        let highest = start.value - 0.5 * start.slope * start.slope / start.curvature;
        start.value <= 0.0 && start.curvature < 0.0 && highest <= self.bounds(self.until).margin
    }

    /// A time that is free of the contact, counted from the last look, or that to the contact (`true`).
    fn look(&self) -> (f64, bool) {
        let remaining = self.until - self.time;
        let clearance = self.clearance(&self.state, self.time);
        let (mut free, mut window) = (0.0_f64, remaining);
        for _ in 0..WINDOWS {
            let bounds = self.bounds(window);
            let cautious = self.cautious(clearance, window);
            match look(cautious, bounds, || None) {
                Look::Contact => return (0.0, true),
                Look::FreeFor(step) => free = free.max(step.min(window)),
                Look::MinimumAhead { at, convex } => {
                    let convex = convex.min(window);
                    let ahead = |ahead: f64| {
                        let time = self.time + ahead;
                        self.clearance(&self.state_at(time), time)
                    };
                    match decide_convex(ahead, (at, convex), self.time, bounds.margin) {
                        Convex::ContactAt(step) => return (step, true),
                        Convex::Free => free = free.max(convex),
                    }
                }
            }
            if free >= 0.25 * window {
                break;
            }
            window = 2.0 * free;
        }
        (free, false)
    }

    /// Homogeneous state at a time not before the last look.
    fn state_at(&self, time: f64) -> Vec<f64> {
        let mut state = self.state.clone();
        self.integrator.carry_in_step(&mut state, self.time, time);
        state
    }

    /// What falls to zero at the boundary, in the step from the homogeneous state at `time`.
    fn clearance(&self, state: &[f64], time: f64) -> Jet {
        let jet = self.integrator.forced_element_jet(state, self.touch.element, time);
        let distance = self.integrator.distance(jet, self.touch);
        if self.is_closed && self.touch.boundary == Boundary::Presses {
            return Jet { value: -distance.value, slope: -distance.slope, ..distance };
        }
        distance
    }

    /// The lowest derivatives with the jumps of the forces: `r''` may be lower by J, and so the rate of a
    /// pressure by J times its part of the velocity.
    fn cautious(&self, clearance: Jet, window: f64) -> Jet {
        match self.integrator.laws[self.touch.element].pressure() {
            Some(pressure) if self.touch.boundary == Boundary::Presses => {
                Jet { slope: clearance.slope - pressure.velocity * self.direct.jump, ..clearance }
            }
            _ => Jet { curvature: clearance.curvature - self.jump(window), ..clearance },
        }
    }

    /// J over a window from the last look; of the reading of a hole, `P J/c` with the largest distance P from
    /// its axis.
    fn jump(&self, window: f64) -> f64 {
        match (self.direct_across, self.integrator.laws[self.touch.element].round_hole()) {
            (Some(across), Some(hole)) => {
                let (now, bounds) = self.hole_bounds(across, window);
                farthest(now, bounds, window) * self.direct.jump.hypot(across.jump) / hole.clearance()
            }
            _ => self.direct.jump,
        }
    }

    /// The outputs of a hole now, and bounds on them over a window from the last look.
    fn hole_bounds(&self, across: Direct, window: f64) -> ([Jet; 2], [OutputBounds; 2]) {
        let (it, element) = (self.integrator, self.touch.element);
        let bounds = [(element, self.direct), (element + 1, across)].map(|(output, direct)| {
            let ClearanceBounds { second, third, margin } = self.output_bounds(output, direct, window);
            OutputBounds { value: f64::INFINITY, first: f64::INFINITY, second, third, margin }
        });
        ([0, 1].map(|k| it.forced_jet(&self.state, element + k, self.time)), bounds)
    }

    /// Bounds over a window from the last look.
    fn bounds(&self, window: f64) -> ClearanceBounds {
        let (it, element) = (self.integrator, self.touch.element);
        let (Some(across), Some(hole)) = (self.direct_across, it.laws[element].round_hole()) else {
            let bounds = self.output_bounds(element, self.direct, window);
            return it.boundary_bounds(bounds, &self.state, self.touch);
        };
        let (now, bounds) = self.hole_bounds(across, window);
        reading_bounds(hole, now, bounds, window)
    }

    /// Bounds on an output over a window from the last look.
    fn output_bounds(&self, element: usize, direct: Direct, window: f64) -> ClearanceBounds {
        let it = self.integrator;
        let (output, until) = (&it.outputs[element], it.step.start + self.time + window);
        let vibration: Vec<f64> =
            self.state.iter().zip(&self.forced.rest).map(|(x, rest)| x - rest).collect();
        let mut bounds = it.bounds(&vibration, element, until);
        bounds.second += direct.second;
        bounds.third += direct.third;
        let mut margin = it.bounds(&self.state, element, until).margin / (8.0 * f64::EPSILON);
        for (i, gain) in self.forced.gain.iter().enumerate() {
            bounds.second += output.second_bound[i] * gain * window;
            bounds.third += output.third_bound[i] * gain * window;
            // A rigid block has no bound on its displacement but the time.
            let rigid = if it.blocks.stiffness[i] == 0.0 { output.row[i].abs() * window } else { 0.0 };
            margin += (output.value_bound[i] + rigid) * gain * window;
        }
        bounds.margin = margin * f64::EPSILON * (8 + self.looks) as f64;
        bounds
    }
}
