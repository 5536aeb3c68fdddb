//! The march over a stretch: step control, crossings of boundaries, samples.
//!
//! After a step of error `e` (see the stepper) the next is `0.9 e^(-1/8)` times as long, between a fifth and
//! six times. A step that leaves its smooth region is done again to end on the boundary; there the march
//! starts afresh. Behind a boundary forces grow like a low power of time, so that the first step there is
//! corrected by `0.9 e^(-2/5)` if it fails, and its best length is remembered for the next crossing of that
//! kind.

use faer::Mat;

use super::{
    Counts, FieldFlow, GeneralError, GeneralSettings, VectorField,
    dense::Dense,
    search::Verdict,
    stepper::Stepper,
    switching::Region,
    watch::{Accepted, Place, Watcher},
};

/// Steps shorter than this fraction of the one before a crossing do not resolve what follows it.
const FINEST: f64 = 1e-7;

/// Share of the time in which the state would double over which rates are differences: rounding of what
/// depends on the state is as small a share of them as this.
const RESOLVED: f64 = 1e-8;

/// A motion under way.
pub(super) struct March<'a, F> {
    field: &'a mut F,
    settings: &'a GeneralSettings,
    pub(super) stepper: Stepper,
    region: Region,
    dense: Dense,
    time: f64,
    end: f64,
    duration: f64,
    pub(super) step: f64,
    finest: f64,
    /// Where the march started afresh for the last time, and the length of a first step from there whose
    /// error does not count.
    restart: f64,
    negligible: f64,
    failed: bool,
    unmoved: usize,
    pub(super) counts: Counts,
}

impl<'a, F: VectorField> March<'a, F> {
    pub(super) fn new(
        field: &'a mut F,
        settings: &'a GeneralSettings,
        (start, end): (f64, f64),
        state: &[f64],
    ) -> Self {
        let mut stepper = Stepper::new(field, state, settings.sensitivities);
        let mut region = Region::new(state.len(), field.switches());
        stepper.start(field, start, &region.inside);
        let step = settings.first_step.unwrap_or_else(|| first_step(field, &stepper, end - start));
        region.locate(field, start, &stepper, 1e-6 * step);
        stepper.begin(field, start, &mut region.inside);
        stepper.start(field, start, &region.inside);
        let dense = Dense::new(state.len());
        let counts = Counts::default();
        let (finest, negligible) = (FINEST * step, negligible(step, settings));
        Self {
            field,
            settings,
            stepper,
            region,
            dense,
            time: start,
            end,
            duration: end - start,
            step,
            finest,
            restart: start,
            negligible,
            failed: false,
            unmoved: 0,
            counts,
        }
    }

    /// Marches to the end.
    pub(super) fn run(&mut self, watcher: &mut impl Watcher<F>) -> Result<(), GeneralError> {
        let start = Place { time: self.time, state: self.stepper.state(), inside: &self.region.inside };
        watcher.begin(self.field, start);
        while self.time < self.end {
            self.check()?;
            self.advance(watcher);
        }
        self.counts.evaluations = self.stepper.evaluations;
        Ok(())
    }

    /// Where it has come to.
    pub(super) fn flow(&self) -> FieldFlow {
        let d = self.stepper.state().len();
        let (state, columns) = self.stepper.value.split_at(d);
        let (by_state, by_parameter) = match columns.len() {
            0 => (Mat::new(), Vec::new()),
            _ => (Mat::from_fn(d, d, |i, j| columns[j * d + i]), columns[d * d..].to_vec()),
        };
        FieldFlow { state: state.to_vec(), by_state, by_parameter, counts: self.counts, next_step: self.step }
    }

    fn check(&self) -> Result<(), GeneralError> {
        let (time, step) = (self.time, self.step);
        if !self.stepper.state().iter().all(|value| value.is_finite()) {
            return Err(GeneralError::NotFinite { time });
        }
        if self.counts.steps + self.counts.rejected >= self.settings.max_steps {
            return Err(GeneralError::TooManySteps { steps: self.settings.max_steps, time });
        }
        // What is left after a boundary right before the end may be no more than rounding.
        if !step.is_finite() || 1.01 * step < self.end - time && time + 0.1 * step == time {
            return Err(GeneralError::StepTooSmall { time, step });
        }
        Ok(())
    }

    /// Tries a step, and moves on if it succeeds.
    fn advance(&mut self, watcher: &mut impl Watcher<F>) {
        let remaining = self.end - self.time;
        let step = if 1.01 * self.step >= remaining { remaining } else { self.step };
        self.stepper.attempt(self.field, self.time, step, &self.region.inside);
        let error = self.stepper.error(step, self.settings.tolerance);
        if !self.good_enough(step, error) {
            self.reject(step, error);
            return;
        }
        match self.inspect(step) {
            Verdict::Clear => {
                self.lengthen(step, error);
                self.accept(step, watcher);
            }
            Verdict::TooLong { .. } if step > self.finest.max(self.instant()) => {
                self.step = (step / 16.0).max(self.finest.max(self.instant()));
                self.counts.rejected += 1;
            }
            Verdict::TooLong { switch } => self.cross(switch, watcher),
            Verdict::Crossing { fraction, switch } => {
                let to_crossing = self.polish(switch, fraction, step);
                if self.step_to_crossing(to_crossing, watcher) {
                    self.finest = FINEST * step;
                    self.negligible = negligible(step, self.settings);
                    self.cross(switch, watcher);
                }
            }
        }
    }

    /// Whether the error of the attempted step allows to accept it.
    ///
    /// Behind a boundary what was zero before may grow like `t^1.5`, and a step from its zero has the same
    /// relative error however short it is. What grows within `tolerance^(2/3)` of the last smooth step is
    /// below the tolerance of what that step brings.
    fn good_enough(&self, step: f64, error: f64) -> bool {
        error <= 1.0 || error.is_finite() && self.time == self.restart && step <= self.negligible
    }

    /// Time that rounding does not resolve, or in which crossings are not told apart.
    fn instant(&self) -> f64 {
        64.0 * f64::EPSILON * self.time.abs() + 1e-3 * self.settings.tolerance * self.finest / FINEST
    }

    fn lengthen(&mut self, step: f64, error: f64) {
        let most = match self.region.is_fresh() {
            _ if self.failed => 1.0,
            true => 100.0,
            false => 6.0,
        };
        let next =
            step * (0.9 * error.powf(-0.125)).clamp(0.2, most).max(if error > 1.0 { 1.0 } else { 0.0 });
        self.step = if step < self.step { next.max(self.step) } else { next };
        self.region.moved(step * (0.9 * error.powf(-0.4)).clamp(0.2, 1e4));
    }

    fn reject(&mut self, step: f64, error: f64) {
        let factor = match self.region.is_fresh() {
            _ if !error.is_finite() => 0.1,
            true => (0.9 * error.powf(-0.4)).max(0.02),
            false => (0.9 * error.powf(-0.125)).max(0.2),
        };
        self.step = factor * step;
        self.failed = true;
        self.counts.rejected += 1;
    }

    fn inspect(&mut self, step: f64) -> Verdict {
        let switches = self.region.inside.len();
        if switches == 0 || self.unmoved > 2 * switches {
            return Verdict::Clear;
        }
        if !self.region.near_boundary(self.field, &self.stepper, self.time + step) {
            return Verdict::Clear;
        }
        self.stepper.densify(self.field, self.time, step, &self.region.inside, false);
        self.dense.load(&self.stepper, step);
        let evaluations = self.stepper.evaluations;
        let verdict = self.region.inspect(self.field, (&mut self.stepper, &self.dense), (self.time, step));
        if verdict == Verdict::Clear && self.stepper.evaluations > evaluations {
            // The search has gone to a lowest place within the step.
            self.stepper.attempt(self.field, self.time, step, &self.region.inside);
        }
        verdict
    }

    /// Length of the step that ends on the zero itself, from that which ends on the zero of the dense output.
    ///
    /// Where the Jacobian jumps, sensitivities are wrong by as much as the time of the crossing.
    fn polish(&mut self, switch: usize, fraction: f64, step: f64) -> f64 {
        let start = (self.time, step);
        let rate = self.region.rate(self.field, &self.dense, start, fraction, switch);
        let mut polished = fraction * step;
        for _ in 0..4 {
            self.stepper.attempt_state(self.field, self.time, polished, &self.region.inside);
            let end = self.time + polished;
            let change = -self.region.value(self.field, switch, end, self.stepper.end_state()) / rate;
            if change.is_nan() || change.abs() > 1e-2 * fraction * step {
                break;
            }
            polished += change;
            if change.abs() <= 1e-3 * self.settings.tolerance * polished {
                break;
            }
        }
        polished
    }

    /// Steps onto the boundary; tells whether the step was good enough.
    fn step_to_crossing(&mut self, step: f64, watcher: &mut impl Watcher<F>) -> bool {
        if self.time + step > self.time {
            self.stepper.attempt(self.field, self.time, step, &self.region.inside);
            let error = self.stepper.error(step, self.settings.tolerance);
            if !self.good_enough(step, error) {
                self.reject(step, error);
                return false;
            }
            self.accept(step, watcher);
        }
        true
    }

    fn cross(&mut self, switch: usize, watcher: &mut impl Watcher<F>) {
        let instant = self.instant();
        let resolved = RESOLVED * doubling_time(self.field, &self.stepper).min(self.duration);
        let span = instant.max(self.finest).max(resolved);
        let moment = (self.time, instant, span);
        let before = self.region.inside.clone();
        let first_step = self.region.cross(self.field, &self.stepper, moment, switch);
        self.stepper.impact(self.field, self.time, (&mut self.region.inside, &before));
        self.stepper.jump(self.field, self.time, (&self.region.inside, &before));
        // The first step behind a contact that lasted no longer than rounding would not advance the time.
        self.step = first_step.unwrap_or(self.step).max(instant);
        self.restart = self.time;
        self.unmoved += 1;
        self.counts.crossings += 1;
        self.stepper.start(self.field, self.time, &self.region.inside);
        let at = Place { time: self.time, state: self.stepper.state(), inside: &self.region.inside };
        watcher.crossed(self.field, at);
    }

    fn accept(&mut self, step: f64, watcher: &mut impl Watcher<F>) {
        let end = if step == self.end - self.time { self.end } else { self.time + step };
        self.stepper.finish(self.field, end, &self.region.inside);
        self.show(step, end, watcher);
        self.stepper.accept(self.field);
        self.time = end;
        self.failed = false;
        self.unmoved = 0;
        self.counts.steps += 1;
    }

    fn show(&mut self, step: f64, end: f64, watcher: &mut impl Watcher<F>) {
        if !watcher.wants(end) {
            return;
        }
        self.stepper.densify(self.field, self.time, step, &self.region.inside, true);
        self.dense.load(&self.stepper, step);
        let accepted = Accepted {
            stepper: &self.stepper,
            dense: &self.dense,
            inside: &self.region.inside,
            time: self.time,
            length: step,
            end,
        };
        watcher.step(self.field, &accepted);
    }
}

fn negligible(smooth_step: f64, settings: &GeneralSettings) -> f64 {
    smooth_step * settings.tolerance.powf(2.0 / 3.0)
}

/// Shortest first step, in parts of the stretch: a velocity that is rounding alone, where the motion turns,
/// doubles in no time. A step that is too long is done again.
const SHORTEST_FIRST: f64 = 1e-6;

/// A hundredth of the time in which a part of the state would double, at most a tenth of the stretch.
fn first_step(field: &impl VectorField, stepper: &Stepper, duration: f64) -> f64 {
    (0.01 * doubling_time(field, stepper)).min(0.1 * duration).max(SHORTEST_FIRST * duration)
}

/// The shortest time in which a part of the state would double; infinite at rest.
fn doubling_time(field: &impl VectorField, stepper: &Stepper) -> f64 {
    let part = stepper.state().len() / field.parts();
    let norm = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let parts = stepper.state().chunks_exact(part).zip(stepper.slope(0).chunks_exact(part));
    let times = parts.map(|(value, slope)| norm(value) / norm(slope)).filter(|&time| time > 0.0);
    times.fold(f64::INFINITY, f64::min)
}
