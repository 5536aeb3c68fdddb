//! Zeros of the test functions of the problem.
//!
//! A step over which a test function changes its sign ends at the zero instead, found by few probes
//! (`bracket.rs`). A function may also jump through zero (when what it is made of changes its kind); then the
//! bracket shrinks and the value does not, and nothing is recorded.
//!
//! Most jumps need no search: the judge knows them, the path goes straight on, and as many multipliers lie
//! outside the unit circle behind the step as before.
//!
//! Zeros that leave no trace in the signs are in `hidden_zeros.rs`, functions that say nothing since a part
//! of them stays at zero in `undecided.rs`.

use super::{
    arrival::{Arrival, Counted},
    attempt::Attempt,
    bracket::Bracket,
    hidden_zeros::{dips, hides_zeros, undoes_zeros},
    locator::{Locator, Probing},
    undecided::{leave_undecided_out, left_out},
};
use crate::{
    corrector::Candidate,
    error::StepDoubt,
    point::PathEvents,
    problem::{PathProblem, TestKind, TestValue},
    test_record::has_bit,
};

const MOST_PROBES: u32 = 60;
/// Value relative to the ends of the step at which a zero counts as reached.
const SHARP: f64 = 1e-10;
/// Value relative to the ends of the step above which a search that comes to an end came to a false one, if
/// probes were off the path.
const FALSE_END: f64 = 1e-6;
/// If the value did not fall below `JUMP_SIZE` of the ends when the bracket has this share of the step, it
/// jumps.
const JUMP_WIDTH: f64 = 1e-3;
const JUMP_SIZE: f64 = 0.05;

/// Ends the step to the trial at the first zero of a test function before it, if there is one.
pub(super) fn stop_at_zeros(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    mut arrival: Arrival,
) -> Result<Arrival, StepDoubt> {
    ask_for_tests(attempt);
    if attempt.tests.values.len() != attempt.trial.tests.len() {
        return Ok(arrival);
    }
    let mut apart = leave_undecided_out(attempt, None)?;
    arrival.zeros_near = attempt.tests.stay_behind_zeros(&mut attempt.trial.tests, None);
    let is_long = attempt.step > attempt.settings().signature_step;
    if is_long && hides_zeros(attempt, locator)? {
        return Err(StepDoubt::HiddenZeros);
    }
    for index in 0..attempt.trial.tests.len() {
        if has_bit(apart, index) {
            continue;
        }
        let zeros = attempt.tests.values[index].count.abs_diff(attempt.trial.tests[index].count);
        if is_long && (zeros >= 2 || zeros == 0 && dips(attempt, index)) {
            return Err(StepDoubt::HiddenZeros);
        }
        let changes_sign = zeros % 2 == 1 && attempt.trial.tests[index].kind == TestKind::SignChange;
        if changes_sign && !jumps(attempt, index, &arrival) {
            (arrival, apart) = stop_at_zero(attempt, locator, index, arrival)?;
        }
    }
    // What lies on the way to a zero may not be seen from beyond it.
    if is_long && arrival.events.zeros != 0 && undoes_zeros(attempt) {
        return Err(StepDoubt::HiddenZeros);
    }
    Ok(arrival)
}

/// Whether a test function, the sign of which is another one at the trial, evaluated last, has jumped on the
/// way there.
fn jumps(attempt: &mut Attempt<'_>, index: usize, arrival: &Arrival) -> bool {
    let is_plain = !arrival.events.any() && arrival.parameter_sign.is_none() && !attempt.changes_signature();
    let beside_zero = attempt.state.current.events.zeros | attempt.tests.zeros_near | arrival.zeros_near;
    let Some((least, most)) = attempt.state.outside.filter(|_| is_plain) else { return false };
    let judge = attempt.problem.judge();
    least == most
        && !has_bit(beside_zero, index)
        && judge.outside(arrival.events).is_some_and(|here| (here.least, here.most) == (least, most))
        && judge.jumps(index, &attempt.tests.noted, &attempt.trial.noted)
}

/// The zeros that belong to a point that was reached without a look at what lies between.
pub(super) fn zeros_at_once(attempt: &mut Attempt<'_>, mut arrival: Arrival) -> Arrival {
    ask_for_tests(attempt);
    take_undecided_over(attempt);
    for (index, (before, after)) in attempt.tests.pairs(&attempt.trial.tests).enumerate() {
        let is_known = before.undecided + before.left_out + after.undecided == 0;
        if is_known && before.count.abs_diff(after.count) % 2 == 1 {
            arrival.events.zeros |= 1 << index;
            arrival.uncertainty = arrival.uncertainty.max(attempt.frame.settings.min_step);
        }
    }
    arrival
}

/// Behind a corner some of what a test function is made of may be known so badly that its sign is not; where
/// none was beyond zero before, it counts as not beyond it, and the others decide.
fn take_undecided_over(attempt: &mut Attempt<'_>) {
    let rule = |(before, after): (&TestValue, &TestValue)| {
        let was_clear = before.undecided + before.left_out + before.count == 0;
        if was_clear && after.kind == TestKind::SignChange { after.undecided } else { 0 }
    };
    let rules: Vec<u32> = attempt.tests.pairs(&attempt.trial.tests).map(rule).collect();
    if rules.iter().all(|left_out| *left_out == 0) {
        return;
    }
    let mut known = Vec::new();
    attempt.problem.tests(&rules, &mut known);
    for ((after, known), left_out) in attempt.trial.tests.iter_mut().zip(known).zip(rules) {
        if left_out > 0 {
            let sign = if known.count % 2 == 0 { 1.0 } else { -1.0 };
            *after =
                TestValue { value: sign * after.value.abs(), count: known.count, undecided: 0, ..*after };
        }
    }
}

/// The test functions at the trial, evaluated last, and what the judge notes with them.
fn ask_for_tests(attempt: &mut Attempt<'_>) {
    attempt.problem.tests(&[], &mut attempt.trial.tests);
    attempt.problem.judge().note(&mut attempt.trial.noted);
}

/// Ends the step at the zero of one test function, the sign of which is another one at the trial. Zeros of
/// other functions that were found just there belong to the same point. Also bits of the functions that are
/// not comparable there, as of [`leave_undecided_out`].
///
/// * `found`: what is known of the trial.
fn stop_at_zero(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    index: usize,
    found: Arrival,
) -> Result<(Arrival, u32), StepDoubt> {
    let (at, behind) = (attempt.progress(), attempt.trial.tests.clone());
    let mut arrival = arrive_at_zero(attempt, locator, index)?.unwrap_or(found);
    // Of the other functions less may be known here than at the end of the step.
    let not_comparable = leave_undecided_out(attempt, Some(index))?;
    let near = attempt.tests.stay_behind_zeros(&mut attempt.trial.tests, Some(index));
    arrival.zeros_near |= found.zeros_near | near;
    if !found.events.fold {
        arrival.parameter_sign = found.parameter_sign;
    }
    let apart = at - attempt.progress();
    if apart <= found.uncertainty + arrival.uncertainty + attempt.settings().correction_floor {
        arrival.events.zeros |= found.events.zeros;
        arrival.uncertainty = arrival.uncertainty.max(found.uncertainty);
        keep_tests(&mut attempt.trial.tests, &behind, found.events.zeros);
    }
    Ok((arrival, not_comparable))
}

/// At a zero the signs of the functions that vanish there are rounding: they stay as they were noted
/// `behind`.
fn keep_tests(tests: &mut [TestValue], behind: &[TestValue], zeros: u32) {
    for (index, (test, behind)) in tests.iter_mut().zip(behind).enumerate() {
        if has_bit(zeros, index) {
            *test = *behind;
        }
    }
}

/// What the search for a zero of one function compares with.
#[derive(Clone, Copy)]
struct Ends {
    /// Its values before and behind, the first never zero.
    low: f64,
    high: f64,
    /// The larger of them, in magnitude.
    size: f64,
    length: f64,
    /// Where the sign at the last point was taken over from the point before (`undecided.rs`): how far behind
    /// that lies. The zero may be there already.
    taken_over: Option<f64>,
}

impl Ends {
    fn of(attempt: &Attempt<'_>, index: usize) -> Self {
        let (before, after) = (attempt.tests.values[index], attempt.trial.tests[index]);
        let sign = if before.count % 2 == 0 { 1.0 } else { -1.0 };
        let was_undecided = before.undecided > before.left_out && attempt.state.history.used >= 2;
        Self {
            taken_over: was_undecided.then(|| -attempt.progress_of(&attempt.state.history.nodes[1])),
            low: sign * before.value.abs().max(f64::MIN_POSITIVE),
            high: -sign * after.value.abs(),
            size: before.value.abs().max(after.value.abs()),
            length: attempt.progress(),
        }
    }

    /// How far behind the last point that one lies behind which the zero is, where it is not within the step:
    /// the function has the sign of its end right from the last point on, and is no smaller than there.
    ///
    /// * `value`: of the newest probe.
    fn lies_behind(&self, bracket: &Bracket, value: f64) -> Option<f64> {
        let at_last_point = bracket.is_open_at_start() && bracket.newest() <= JUMP_WIDTH * self.length;
        self.taken_over.filter(|_| at_last_point && value.abs() > JUMP_SIZE * self.low.abs())
    }
}

/// Makes the zero of one test function before the trial the trial; `None`, with the trial as it was, if the
/// function jumps.
fn arrive_at_zero(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    index: usize,
) -> Result<Option<Arrival>, StepDoubt> {
    let (ends, after) = (Ends::of(attempt, index), attempt.trial.tests[index]);
    let mut found = narrow(attempt, locator, (&ends, index), false)?;
    if is_false(attempt, locator, (&ends, index), &found).unwrap_or(false) {
        let first = locator.probe.clone();
        match narrow(attempt, locator, (&ends, index), true) {
            Ok(again) => found = again,
            Err(_) => {
                locator.probe = first;
                attempt.evaluate(&locator.probe.point)?;
            }
        }
    }
    let NarrowedZero { bracket, value, counted, .. } = found;
    let mut uncertainty = bracket.uncertainty(value);
    if let Some(behind) = ends.lies_behind(&bracket, value) {
        // The last point is as near to it as the step can end.
        uncertainty = behind + bracket.newest();
    } else if value.abs() > JUMP_SIZE * ends.size {
        attempt.return_to_trial()?;
        return Ok(None);
    }
    if !attempt.frame.range.contains(locator.probe.parameter()) {
        return Err(StepDoubt::NotLocated);
    }
    locator.probe.orient(attempt.state.orientation);
    locator.arrive(attempt);
    attempt.trial.tests[index] = after;
    let zero = bracket.newest();
    let counted = counted.map(|(place, count)| Counted { count, before: place < zero });
    let mut arrival = Arrival { uncertainty, counted, ..Arrival::default() };
    arrival.events.zeros = 1 << index;
    Ok(Some(arrival))
}

/// Whether the sign of a probe off the path was wrong, as far as the end of a search shows: the value there
/// is not small. Where the function seems to jump, which it often does, the other end of the bracket is
/// probed once more, on the path.
fn is_false(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    (ends, index): (&Ends, usize),
    found: &NarrowedZero,
) -> Result<bool, StepDoubt> {
    let size = found.value.abs() / ends.size;
    let lies_behind = ends.lies_behind(&found.bracket, found.value).is_some();
    if !found.is_loose || size <= FALSE_END || lies_behind {
        return Ok(false);
    }
    if size <= JUMP_SIZE {
        return Ok(true);
    }
    let place = found.bracket.far_end();
    let probing = Probing { bracket: &found.bracket, reached: 0.0, place, goes_on: true, sharply: true };
    let value = locator.probe_toward_zero(attempt, &probing, asked(attempt, index))?;
    Ok(value * found.value > 0.0)
}

/// The value of one test function at a probe, and what the judge notes with it; `None` if it has none there.
fn asked(
    attempt: &Attempt<'_>,
    index: usize,
) -> impl Fn(&mut Candidate, &mut dyn PathProblem) -> Option<f64> + use<> {
    let (left_out, functions) = (left_out(&attempt.trial.tests), attempt.trial.tests.len());
    move |probe, problem| {
        problem.tests(&left_out, &mut probe.tests);
        problem.judge().note(&mut probe.noted);
        probe.tests.get(index).filter(|_| probe.tests.len() == functions).map(|test| test.value)
    }
}

/// Where a search for a zero ended.
struct NarrowedZero {
    bracket: Bracket,
    /// The function at its newest probe.
    value: f64,
    /// Where a probe lay at which it is known how many multipliers are outside, and how many.
    counted: Option<(f64, u32)>,
    /// Whether an end of the bracket is a probe that is off the path, or was one.
    is_loose: bool,
}

/// Narrows the bracket of a zero of one test function as far as it goes.
///
/// * `sharply`: whether no probe may be off the path.
fn narrow(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    (ends, index): (&Ends, usize),
    sharply: bool,
) -> Result<NarrowedZero, StepDoubt> {
    let floor = attempt.settings().correction_floor;
    let mut bracket = Bracket::new((0.0, ends.low), (ends.length, ends.high));
    let (mut value, mut counted, mut is_loose) = (ends.low, None, false);
    let ask = asked(attempt, index);
    for probes in 0..MOST_PROBES {
        let place = bracket.next();
        let reached = SHARP * ends.size;
        let probing = Probing { bracket: &bracket, reached, place, goes_on: probes > 0, sharply };
        value = locator.probe_toward_zero(attempt, &probing, &ask)?;
        is_loose |= locator.probe_is_loose(attempt);
        bracket.narrow(place, value);
        if bracket.width() < JUMP_WIDTH * ends.length && value.abs() > JUMP_SIZE * ends.size {
            break;
        }
        if value.abs() <= reached || bracket.uncertainty(value) <= floor {
            break;
        }
        let outside = attempt.problem.judge().outside(PathEvents::default());
        let outside = outside.filter(|outside| outside.least == outside.most);
        counted = outside.map(|outside| (place, outside.least)).or(counted);
    }
    Ok(NarrowedZero { bracket, value, counted, is_loose })
}
