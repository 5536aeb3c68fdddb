//! Events that are told by the problem: zeros of its test functions, and changes of its signature.
//!
//! A step over which a test function changes its sign ends at the zero instead, found by few probes
//! (`bracket.rs`). A function may also jump through zero (when what it is made of changes its kind); then the
//! bracket shrinks and the value does not, and nothing is recorded. Two zeros within one step leave no trace
//! in the signs; where a parabola through three values nearly meets zero between the last two, or the last value
//! is nearly zero, the step is in doubt. So is one at whose end a function has no value any more (it is
//! infinite), and one would have met zero by the line through its last two, and a step at whose end a function
//! has a value that it had not before, and one comes from zero by the line through its value there and one a
//! little behind. Any of them: functions may be the smallest of several values, and what begins or ends among
//! them moves those behind by one place. So is one over which the problem itself knows of zeros that undo each
//! other: on the way to its end, or to the zero that was found before it. A change of signature is bracketed by
//! bisection, since a signature has no size.

use super::{Arrival, Follower, bracket::Bracket, outside::Counted};
use crate::{
    error::Doubt,
    point::Events,
    problem::{PathProblem, TestValue},
    product::progress,
};

const MOST_PROBES: u32 = 60;
/// Value relative to the ends of the step at which a zero counts as reached.
const SHARP: f64 = 1e-10;
/// If the value did not fall below `JUMP_SIZE` of the ends when the bracket has this share of the step, it
/// jumps.
const JUMP_WIDTH: f64 = 1e-3;
const JUMP_SIZE: f64 = 0.05;
/// Value relative to that behind a zero at which the zero is left.
const LEFT: f64 = 1e-3;
/// A function that falls inside a step to this share of its smaller end value is looked at more closely.
const DIP: f64 = 0.5;
/// A function that falls over a step to less than this share of its value has come as near to zero as makes
/// it likely that it was there.
const NEARLY: f64 = 0.1;
/// Lowest points this close to an end of the step (share of the step) belong to that end.
const EDGE: f64 = 0.02;
/// Behind a trial at which a function begins to have a value its slope is taken over this share of the step.
const BEHIND: f64 = 0.05;
/// Share of `signature_step` within which a change of signature is located.
const CHANGE_WIDTH: f64 = 1e-3;

impl Follower {
    /// Ends the step to the trial at the first zero of a test function before it, if there is one.
    pub(super) fn heed_zeros(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        arrival: Arrival,
    ) -> Result<Arrival, Doubt> {
        problem.tests(&mut self.trial.tests);
        problem.note(&mut self.trial.noted);
        if self.state.tests.len() != self.trial.tests.len() {
            return Ok(arrival);
        }
        let apart = self.leave_undecided_out(problem)?;
        let mut arrival = arrival;
        arrival.zeros_near = self.stay_behind_zeros(None);
        let is_long = step > self.settings.signature_step;
        if is_long
            && (self.undoes_zeros(problem) || self.ends_at_zero() || self.begins_at_zero(problem, step)?)
        {
            return Err(Doubt::HiddenZeros);
        }
        for index in (0..self.trial.tests.len()).filter(|index| apart >> index & 1 == 0) {
            let apart = self.state.tests[index].count.abs_diff(self.trial.tests[index].count);
            if is_long && (apart >= 2 || apart == 0 && (self.dips(index) || self.nearly_vanishes(index))) {
                return Err(Doubt::HiddenZeros);
            }
            if apart % 2 == 1 {
                let (found, at, behind) = (arrival, self.trial_progress(), self.trial.tests.clone());
                arrival = self.arrive_at_zero(problem, step, index)?.unwrap_or(arrival);
                arrival.zeros_near |= found.zeros_near | self.stay_behind_zeros(Some(index));
                let apart = at - self.trial_progress();
                if apart <= found.uncertainty + arrival.uncertainty + self.settings.correction_floor {
                    self.keep_zeros(&mut arrival, found, &behind);
                }
            }
        }
        // What lies on the way to a zero may not be seen from beyond it.
        if is_long && arrival.events.zeros != 0 && self.undoes_zeros(problem) {
            return Err(Doubt::HiddenZeros);
        }
        Ok(arrival)
    }

    /// Zeros of other functions that were found just there belong to the same point: at it their signs are
    /// rounding.
    ///
    /// * `behind`: test functions as they were noted with those.
    fn keep_zeros(&mut self, arrival: &mut Arrival, found: Arrival, behind: &[TestValue]) {
        arrival.events.zeros |= found.events.zeros;
        arrival.uncertainty = arrival.uncertainty.max(found.uncertainty);
        for (index, test) in behind.iter().enumerate() {
            if found.events.zeros >> index & 1 == 1 {
                self.trial.tests[index] = *test;
            }
        }
    }

    /// Whether the problem knows of zeros that undo each other on the way to the trial.
    fn undoes_zeros(&self, problem: &(impl PathProblem + ?Sized)) -> bool {
        !self.changes_signature() && problem.hides_zeros(&self.state.noted, &self.trial.noted)
    }

    /// Whether a test function may have two zeros within the step to the trial, though its count is the same
    /// on both sides: the parabola through its values at the last two points and the trial comes closer to
    /// zero inside the step than [`DIP`] of both ends.
    fn dips(&self, index: usize) -> bool {
        let Some((earlier, behind)) = self.test_before(index) else { return false };
        let (before, after) = (self.state.tests[index], self.trial.tests[index]);
        if earlier.count != before.count || earlier.left_out != before.left_out {
            return false;
        }
        let ahead = self.trial_progress();
        let [first, second, third] = [earlier, before, after].map(|test| test.value.abs());
        let slope = (second - first) / -behind;
        let bend = ((third - second) / ahead - slope) / (ahead - behind);
        let place = 0.5 * (behind - slope / bend);
        let inside = bend > 0.0 && (EDGE * ahead..=(1.0 - EDGE) * ahead).contains(&place);
        inside && second + place * (slope + bend * (place - behind)) < DIP * second.min(third)
    }

    /// Whether a test function falls nearly to zero over the step to the trial. Two zeros just before its end
    /// show in no parabola through values before them.
    fn nearly_vanishes(&self, index: usize) -> bool {
        let (before, after) = (self.state.tests[index], self.trial.tests[index]);
        after.value.abs() < NEARLY * before.value.abs() && before.value.is_finite()
    }

    /// A test function at the point before the last one, and how far that lies behind it, which is negative;
    /// `None` where it is not known.
    fn test_before(&self, index: usize) -> Option<(TestValue, f64)> {
        let history = &self.state.history;
        let earlier = self.state.tests_before.get(index).filter(|_| history.used >= 2)?;
        let base = history.base();
        let behind = progress(&self.weights, &base.tangent, &history.nodes[1].point, &base.point);
        Some((*earlier, behind))
    }

    /// Whether a test function has no value any more at the trial, and the line through the values of one of
    /// them at the last two points meets zero before.
    fn ends_at_zero(&self) -> bool {
        let ends =
            |(before, after): (&TestValue, &TestValue)| before.value.is_finite() && !after.value.is_finite();
        if !self.state.tests.iter().zip(&self.trial.tests).any(ends) {
            return false;
        }
        let ahead = self.trial_progress();
        (0..self.state.tests.len())
            .filter_map(|index| self.test_before(index).map(|before| (index, before)))
            .any(|(index, (earlier, behind))| {
                let before = self.state.tests[index].value.abs();
                before + (before - earlier.value.abs()) / -behind * ahead < 0.0
            })
    }

    /// Whether a test function has a value at the trial that it had not before, and the line through the
    /// values of one of them there and a little behind comes from zero within the step.
    fn begins_at_zero(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<bool, Doubt> {
        let begins =
            |(before, after): (&TestValue, &TestValue)| !before.value.is_finite() && after.value.is_finite();
        if !self.state.tests.iter().zip(&self.trial.tests).any(begins) {
            return Ok(false);
        }
        self.probe_between(problem, step, (1.0 - BEHIND) * self.trial_progress())?;
        problem.tests_without(&self.left_out(), &mut self.probe.tests);
        let from_zero = |(behind, after): (&TestValue, &TestValue)| {
            after.value.abs() - (after.value.abs() - behind.value.abs()) / BEHIND < 0.0
        };
        let hides = self.probe.tests.iter().zip(&self.trial.tests).any(from_zero);
        self.return_to_trial(problem)?;
        Ok(hides)
    }

    /// Beside a zero the sign of a test function is rounding: as long as it is small it counts as what it was
    /// found to be behind the zero.
    ///
    /// * `but`: the function whose zero the trial is.
    fn stay_behind_zeros(&mut self, but: Option<usize>) -> u32 {
        let mut near = 0;
        for (index, (behind, trial)) in self.state.tests.iter().zip(&mut self.trial.tests).enumerate() {
            let is_near = self.state.zeros_near >> index & 1 == 1 && but != Some(index);
            if is_near && trial.value.abs() < LEFT * behind.value.abs() {
                *trial = *behind;
                near |= 1 << index;
            }
        }
        near
    }

    /// The zeros that belong to a point that was reached without a look at what lies between.
    pub(super) fn zeros_at_once(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        mut arrival: Arrival,
    ) -> Arrival {
        problem.tests(&mut self.trial.tests);
        problem.note(&mut self.trial.noted);
        for (index, (before, after)) in self.state.tests.iter().zip(&self.trial.tests).enumerate() {
            let is_known = before.undecided + before.left_out + after.undecided == 0;
            if is_known && before.count.abs_diff(after.count) % 2 == 1 {
                arrival.events.zeros |= 1 << index;
                arrival.uncertainty = arrival.uncertainty.max(self.settings.min_step);
            }
        }
        arrival
    }

    /// Makes the zero of one test function before the trial the trial; `None`, with the trial as it was, if
    /// the function jumps.
    fn arrive_at_zero(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        index: usize,
    ) -> Result<Option<Arrival>, Doubt> {
        let (before, after) = (self.state.tests[index], self.trial.tests[index]);
        let sign = if before.count % 2 == 0 { 1.0 } else { -1.0 };
        let ends = before.value.abs().max(after.value.abs());
        let low = sign * before.value.abs().max(f64::MIN_POSITIVE);
        let length = self.trial_progress();
        let mut bracket = Bracket::new((0.0, low), (length, -sign * after.value.abs()));
        let (mut value, mut counted) = (low, None);
        let left_out = self.left_out();
        for probes in 0..MOST_PROBES {
            let place = bracket.next();
            value = self.probe_toward_zero(
                problem,
                step,
                (&bracket, SHARP * ends),
                (place, probes > 0),
                |probe, problem| {
                    problem.tests_without(&left_out, &mut probe.tests);
                    problem.note(&mut probe.noted);
                    probe.tests.get(index).map(|test| test.value)
                },
            )?;
            bracket.narrow(place, value);
            if bracket.width() < JUMP_WIDTH * length && value.abs() > JUMP_SIZE * ends {
                return self.return_to_trial(problem);
            }
            if value.abs() <= SHARP * ends || bracket.uncertainty(value) <= self.settings.correction_floor {
                break;
            }
            let outside = problem.outside(Events::default()).filter(|outside| outside.least == outside.most);
            counted = outside.map(|outside| (place, outside.least)).or(counted);
        }
        if value.abs() > JUMP_SIZE * ends {
            return self.return_to_trial(problem);
        }
        if !self.range.contains(self.probe.parameter()) {
            return Err(Doubt::NotLocated);
        }
        let uncertainty = bracket.uncertainty(value);
        self.probe.orient(self.state.orientation);
        std::mem::swap(&mut self.trial, &mut self.probe);
        self.trial.tests[index] = after;
        let zero = bracket.newest();
        let counted = counted.map(|(place, count)| Counted { count, before: place < zero });
        let mut arrival = Arrival { uncertainty, counted, ..Arrival::default() };
        arrival.events.zeros = 1 << index;
        Ok(Some(arrival))
    }

    /// Evaluates the trial again, so that the problem holds the point that is accepted. Its test functions
    /// stay as they are noted: of one whose zero was located there before, the sign at the trial is rounding.
    pub(super) fn return_to_trial(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
    ) -> Result<Option<Arrival>, Doubt> {
        self.state.counters.evaluations += 1;
        problem.evaluate(&self.trial.point).map_err(|error| Doubt::Corrector(error.into()))?;
        Ok(None)
    }

    /// Whether the signature of the trial differs from that of the point before.
    pub(super) fn changes_signature(&self) -> bool {
        self.trial.signature != self.state.current.signature
    }

    /// Bisects the change of signature before the trial; its far side becomes the trial.
    pub(super) fn arrive_at_change(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        earlier: usize,
    ) -> Result<Arrival, Doubt> {
        let sharp = (CHANGE_WIDTH * self.settings.signature_step).max(self.settings.correction_floor);
        let (mut low, mut high) = (0.0, self.trial_progress());
        let mut evaluated_far = true;
        while high - low > sharp {
            let middle = 0.5 * (low + high);
            if self.probe_between(problem, step, middle).is_err() {
                break;
            }
            evaluated_far = self.probe.signature != self.state.current.signature;
            if evaluated_far {
                self.probe.orient(self.state.orientation);
                std::mem::swap(&mut self.trial, &mut self.probe);
                high = middle;
            } else {
                low = middle;
            }
        }
        if !evaluated_far {
            self.return_to_trial(problem)?;
        }
        Ok(Arrival { earlier, uncertainty: high - low, events: Events::default(), ..Arrival::default() })
    }
}
