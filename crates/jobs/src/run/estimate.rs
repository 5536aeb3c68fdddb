//! How much of a run is done: the work that was done, beside the work that is still expected.
//!
//! Work is counted in seconds of one thread. A run consists of evaluations of jobs, of class `k` (searches
//! for the harmonic branch, other searches, departures from a branch), and of walks. With the mean time `c_k`
//! of an evaluation, the mean time `c` of a solution, `n_k` evaluations and `N` solutions so far, `m_k` open
//! evaluations, and a walk of `L_i` solutions of which `N_i` are there,
//!
//! ```text
//! done = Σ n_k c_k + N c,    left = Σ m_k (c_k + p_k M_k c) + Σ (L_i - N_i) c
//! ```
//!
//! where `p_k` is the part of the decided jobs of the class that began a branch and `M_k` the mean length of
//! such a branch. All of these are measured as the run goes on; each has a first guess of small weight. A
//! harmonic branch that has covered the part `r` of the range with `N` solutions is taken to have `N / r` in
//! all.
//!
//! A branch leads to departures, and these lead to branches in turn. Branches that a departure began have led
//! to `d` departures in the mean; so a departure that is still to come costs, with `p` and `M` of departures,
//!
//! ```text
//! D = c_departure + p (M c + d D) = (c_departure + p M c) / (1 - p d)
//! ```
//!
//! A branch that is still to be found costs `d D` on top of its solutions, and one that is being followed `D`
//! for each departure that it leads to so far, and for as many as it will lead to at this rate. Where `p d`
//! comes near 1, branches lead to branches without end as far as is known; it is taken to be 0.75 at most, so
//! that `left` may grow.

use std::{collections::BTreeSet, time::Instant};

use hammerbeam_results::store::{JobKind, start_of_key};

use super::{
    Plan, again,
    agenda::{Agenda, Job, Start},
    follow_ups,
};
use crate::observer::DoneShare;

/// Classes of evaluations that cost alike.
const HARMONIC: usize = 0;
const SEARCH: usize = 1;
const DEPARTURE: usize = 2;
const CLASSES: usize = 3;

/// First guesses of the time of an evaluation of each class and of a solution [s], and their weights as
/// numbers of such.
const EVALUATION_S: [f64; CLASSES] = [0.02, 0.1, 0.005];
const EVALUATION_WEIGHT: f64 = 0.5;
const SOLUTION_S: f64 = 5e-4;
const SOLUTION_WEIGHT: f64 = 20.0;
/// First guesses of the solutions of a branch, and of the part of the range that it covers with some.
const BRANCH_SOLUTIONS: f64 = 200.0;
const COVERED: f64 = 0.05;
/// Searches that are expected where no stable solution is known or contacts change, before it is known where
/// that is.
const LATER_SEARCHES: usize = 4;
/// Largest number of departures that a departure is taken to lead to, and a first guess of how many a branch
/// leads to.
const MOST_LED_TO: f64 = 0.75;
const LED_TO: f64 = 0.5;
/// Part of what is walked that an unfinished walk is taken to have before it, at least.
const STILL: f64 = 0.1;

fn class(kind: JobKind) -> usize {
    match kind {
        JobKind::Harmonic => HARMONIC,
        JobKind::Survey | JobKind::Resonance | JobKind::NoneStable | JobKind::ContactChange => SEARCH,
        JobKind::Met | JobKind::Doubling | JobKind::Crossing => DEPARTURE,
    }
}

/// Time that threads have spent, and what was there when the run began.
#[derive(Debug)]
pub(super) struct Effort {
    counted_to: Instant,
    evaluating_s: [f64; CLASSES],
    walking_s: f64,
    before: Counts,
}

/// Evaluations and solutions that are there.
#[derive(Debug, Clone, Copy)]
struct Counts {
    evaluated: [f64; CLASSES],
    solutions: f64,
}

impl Counts {
    /// * `under_way`: what an evaluation counts that a thread is at.
    fn of(agenda: &Agenda, under_way: f64) -> Self {
        let mut evaluated = [0.0; CLASSES];
        for job in &agenda.jobs {
            evaluated[class(job.record.kind)] += match (job.record.evaluated, job.running) {
                (true, _) => 1.0,
                (false, true) => under_way,
                (false, false) => 0.0,
            };
        }
        Self { evaluated, solutions: agenda.solutions() as f64 }
    }

    /// Seconds of a thread at these means.
    fn cost(&self, means: &Means) -> f64 {
        let evaluations: f64 =
            self.evaluated.iter().zip(means.evaluation_s).map(|(count, mean)| count * mean).sum();
        evaluations + self.solutions * means.solution_s
    }
}

/// Mean times of an evaluation of each class and of a solution [s].
struct Means {
    evaluation_s: [f64; CLASSES],
    solution_s: f64,
}

impl Effort {
    /// Of a run that begins now with this agenda.
    pub fn new(agenda: &Agenda) -> Self {
        Self {
            counted_to: Instant::now(),
            evaluating_s: [0.0; CLASSES],
            walking_s: 0.0,
            before: Counts::of(agenda, 0.0),
        }
    }

    /// Counts the time since the last call for what threads are at.
    pub fn count(&mut self, agenda: &Agenda) {
        let passed = self.counted_to.elapsed().as_secs_f64();
        self.counted_to = Instant::now();
        for job in agenda.jobs.iter().filter(|job| job.running) {
            self.evaluating_s[class(job.record.kind)] += passed;
        }
        self.walking_s += passed * agenda.starts().map(walking).sum::<usize>() as f64;
    }

    /// How much is done now.
    pub fn done(&self, agenda: &Agenda, plan: &Plan) -> DoneShare {
        let (whole, before) = (Counts::of(agenda, 0.5), self.before);
        let new = Counts {
            evaluated: std::array::from_fn(|k| (whole.evaluated[k] - before.evaluated[k]).max(0.0)),
            solutions: (whole.solutions - before.solutions).max(0.0),
        };
        let mean =
            |seconds: f64, count: f64, guess: f64, weight: f64| (seconds + guess * weight) / (count + weight);
        let means = Means {
            evaluation_s: std::array::from_fn(|k| {
                mean(self.evaluating_s[k], new.evaluated[k], EVALUATION_S[k], EVALUATION_WEIGHT)
            }),
            solution_s: mean(self.walking_s, new.solutions, SOLUTION_S, SOLUTION_WEIGHT),
        };
        let left_s = left_s(agenda, plan, &means);
        let share = |done_s: f64| if left_s > 0.0 { done_s / (done_s + left_s) } else { 1.0 };
        DoneShare { fraction: share(whole.cost(&means)), of_this_run: share(new.cost(&means)) }
    }
}

/// Threads at a start.
pub(super) fn walking(start: &Start) -> usize {
    usize::from(start.up.running.is_some()) + usize::from(start.down.running.is_some())
}

fn solutions(start: &Start) -> f64 {
    (start.up.rows.len() + start.down.rows.len()) as f64
}

/// What the decided jobs of a class led to.
#[derive(Debug, Clone, Copy, Default)]
struct Yield {
    decided: f64,
    branches: f64,
    solutions: f64,
}

impl Yield {
    fn of(agenda: &Agenda, plan: &Plan, wanted: usize) -> Self {
        let mut sum = Self::default();
        for job in agenda.jobs.iter().filter(|job| class(job.record.kind) == wanted) {
            sum.decided += f64::from(u8::from(job.record.outcome.is_some()));
            for start in job.starts.iter().filter(|start| start.branch.is_some() && start.is_finished(plan)) {
                sum.branches += 1.0;
                sum.solutions += solutions(start);
            }
        }
        sum
    }

    /// Solutions of a branch.
    fn length(&self) -> f64 {
        (self.solutions + BRANCH_SOLUTIONS) / (self.branches + 1.0)
    }

    /// Branches that a job leads to.
    fn of_job(&self) -> f64 {
        ((self.branches + 0.5) / (self.decided + 1.0)).min(2.0)
    }
}

/// What departures lead to.
#[derive(Debug, Clone, Copy)]
struct Departures {
    /// Departures that a branch leads to.
    of_branch: f64,
    /// Time of a departure and all that it leads to [s].
    each_s: f64,
}

impl Departures {
    fn of(agenda: &Agenda, of_class: &Yield, means: &Means) -> Self {
        let begun = agenda.jobs.iter().filter(|job| class(job.record.kind) == DEPARTURE);
        let begun: BTreeSet<u32> = begun.flat_map(|job| &job.starts).map(|start| start.key).collect();
        let sources = agenda.jobs.iter().filter_map(|job| job.record.source.map(start_of_key));
        let led_to = sources.filter(|source| begun.contains(source)).count() as f64;
        let of_branch = (led_to + LED_TO) / (of_class.branches + 1.0);
        let led_to = (of_class.of_job() * of_branch).min(MOST_LED_TO);
        let alone_s =
            means.evaluation_s[DEPARTURE] + of_class.of_job() * of_class.length() * means.solution_s;
        Self { of_branch, each_s: alone_s / (1.0 - led_to) }
    }
}

/// Time that is still expected [s].
fn left_s(agenda: &Agenda, plan: &Plan, means: &Means) -> f64 {
    let yields: [Yield; CLASSES] = std::array::from_fn(|wanted| Yield::of(agenda, plan, wanted));
    let departures = Departures::of(agenda, &yields[DEPARTURE], means);
    let covered = covered(agenda, plan);
    let mut harmonic_is_expected = covered.is_none();
    let mut left_s = 0.0;
    for job in agenda.jobs.iter().filter(|job| job.record.outcome.is_none()) {
        let kind = class(job.record.kind);
        let is_needed = kind != HARMONIC
            || std::mem::take(&mut harmonic_is_expected)
            || !job.starts.is_empty()
            || covered.is_some_and(|[low, high]| !(low..=high).contains(&job.record.frequency_hz));
        if is_needed {
            left_s += of_job(job, (&yields[kind], &departures), plan, means.solution_s);
            left_s += means.evaluation_s[kind] * unevaluated(job);
        }
    }
    let looked_again = agenda.jobs.iter().any(|job| again::KINDS.contains(&job.record.kind));
    let later = if looked_again { 0 } else { LATER_SEARCHES.min(plan.survey_hz.len()) };
    left_s + later as f64 * means.evaluation_s[SEARCH]
}

/// Part of an evaluation that is before a job.
fn unevaluated(job: &Job) -> f64 {
    match (job.record.evaluated, job.running) {
        (true, _) => 0.0,
        (false, true) => 0.5,
        (false, false) => 1.0,
    }
}

/// Time that branches of a job that is not decided still take, with all that they lead to [s].
fn of_job(job: &Job, (of_class, departures): (&Yield, &Departures), plan: &Plan, solution_s: f64) -> f64 {
    let is_walked = |start: &&Start| start.branch.is_some() || solutions(start) > 1.0;
    let walked = job.starts.iter().filter(is_walked).filter(|start| !start.is_finished(plan));
    let walked_s = walked.map(|start| {
        let (there, before) = (solutions(start), before(start, of_class, plan));
        let leads_to = follow_ups::of_branch(start, job.record.depth, plan).len() as f64;
        before * solution_s + leads_to * (1.0 + before / there.max(1.0)) * departures.each_s
    });
    let is_open =
        !job.record.evaluated || job.starts.iter().any(|start| !is_walked(&start) && !start.doubtful);
    let branch_s = of_class.length() * solution_s + departures.of_branch * departures.each_s;
    walked_s.sum::<f64>() + if is_open { of_class.of_job() * branch_s } else { 0.0 }
}

/// Solutions that are before a branch that is being followed.
fn before(start: &Start, of_class: &Yield, plan: &Plan) -> f64 {
    let there = solutions(start);
    let whole = if start.period_multiple == 1 || of_class.branches == 0.0 {
        (there + COVERED * BRANCH_SOLUTIONS) / (reach(start, plan) + COVERED)
    } else {
        of_class.length()
    };
    (whole - there).max(STILL * there)
}

/// Part of the range that a branch covers.
fn reach(start: &Start, plan: &Plan) -> f64 {
    let [low, high] = plan.range_hz;
    let [least, greatest] = ends(start);
    ((greatest - least) / (high - low)).clamp(0.0, 1.0)
}

/// Lowest and highest frequency of a branch [Hz].
fn ends(start: &Start) -> [f64; 2] {
    let rows = start.up.rows.iter().chain(&start.down.rows).map(|row| row.frequency_hz);
    rows.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// Range of the harmonic branches that are known; one that is being followed is taken to reach through.
fn covered(agenda: &Agenda, plan: &Plan) -> Option<[f64; 2]> {
    let harmonic = || agenda.accepted().filter(|start| start.period_multiple == 1);
    if harmonic().any(|start| !start.is_finished(plan)) {
        return Some(plan.range_hz);
    }
    harmonic().map(ends).reduce(|[low, high], [least, greatest]| [low.min(least), high.max(greatest)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::agenda::examples::{self, job, row, start};
    use hammerbeam_results::store::JobOutcome;

    fn plan() -> Plan {
        Plan { range_hz: [0.0, 100.0], survey_hz: vec![], ..examples::plan() }
    }

    /// A harmonic branch that is walked from 0 Hz up to there, 10 solutions a hertz.
    fn walked_to(hertz: u32) -> Start {
        start(0, Some(1), (0..10 * hertz).map(|number| row(f64::from(number) / 10.0)).collect())
    }

    /// Where a walk is all that there is to do, the part that is done is that of the range, almost.
    #[test]
    fn a_walk_alone_is_done_as_far_as_it_covers_the_range() {
        for hertz in [20, 50, 80] {
            let first = Job { starts: vec![walked_to(hertz)], ..job(0, JobKind::Harmonic, true) };
            let agenda = Agenda { jobs: vec![first] };
            // As long as is guessed.
            let effort = Effort {
                evaluating_s: [EVALUATION_S[HARMONIC], 0.0, 0.0],
                walking_s: f64::from(10 * hertz) * SOLUTION_S,
                ..Effort::new(&Agenda { jobs: vec![] })
            };
            let done = effort.done(&agenda, &plan());
            let part = f64::from(hertz) / 100.0;
            assert!((done.fraction - part).abs() < 0.1, "{done:?} at {part}");
            assert!((done.fraction - done.of_this_run).abs() < 1e-12);
            // What an earlier run did is no work of this one.
            let resumed = Effort::new(&agenda).done(&agenda, &plan());
            assert!((resumed.fraction - done.fraction).abs() < 1e-12 && resumed.of_this_run == 0.0);
        }
    }

    /// Ten searches alike are a tenth of the work each, decided or not; what is under way counts half.
    #[test]
    fn searches_count_when_they_are_evaluated_not_when_they_are_decided() {
        for evaluated in 0..10 {
            let mut jobs: Vec<Job> = (0..10).map(|id| job(id, JobKind::Survey, id < evaluated)).collect();
            jobs[evaluated as usize].running = true;
            let effort = Effort {
                evaluating_s: [0.0, 1000.0 * (f64::from(evaluated) + 0.5), 0.0],
                ..Effort::new(&Agenda { jobs: vec![] })
            };
            let done = effort.done(&Agenda { jobs }, &plan()).fraction;
            let expected = (f64::from(evaluated) + 0.5) / 10.0;
            assert!((done - expected).abs() < 1e-3, "{done}, {expected}");
        }
    }

    #[test]
    fn all_is_done_when_nothing_is_left() {
        let mut jobs = vec![job(0, JobKind::NoneStable, true)];
        jobs[0].record.outcome = Some(JobOutcome::Nothing);
        let agenda = Agenda { jobs };
        let done = Effort::new(&agenda).done(&agenda, &plan());
        assert_eq!((done.fraction, done.of_this_run), (1.0, 1.0));
    }
}
