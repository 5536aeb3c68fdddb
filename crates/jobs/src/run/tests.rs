use std::{path::Path, sync::atomic::Ordering};

use hammerbeam_orbit::{PeriodicSolution, StopReason};
use hammerbeam_results::{
    columns::TableColumn,
    end::BranchEnd,
    export::{BranchTable, export_csv},
    store::{JobKind, JobOutcome, Store, StoreError},
};
use hammerbeam_study::file::StudyFile;
use tempfile::{TempDir, tempdir};

use super::{fake::FakeSolver, *};
use crate::{DoneShare, Observer, Progress, Quiet};

const STUDY: &str = include_str!("../../../../studies/duffing.toml");

fn study_with(response: &str) -> StudyFile {
    let text = STUDY.replace("[0.08, 0.5]", "[10.0, 20.0]");
    StudyFile::parse("study.toml", format!("{text}\n{response}")).unwrap()
}

fn study() -> StudyFile {
    study_with("[response]\nperiod_multiples = [1, 2, 3]\n")
}

/// Stops after a number of questions.
struct StopAfter(usize);

impl Observer for StopAfter {
    fn interrupted(&mut self) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 == 0
    }
}

fn run_into(folder: &Path, study: &StudyFile, observer: &mut dyn Observer) -> RunOutcome {
    let mut store = Store::open_for_run(folder, study).unwrap();
    let outcome = run(&mut store, &FakeSolver::default(), &Plan::of(&study.study), 2, observer).unwrap();
    store.finish().unwrap();
    outcome
}

fn csv(folder: &Path) -> String {
    let out = tempdir().unwrap();
    let exported = export_csv(&Store::open(folder).unwrap(), out.path()).unwrap();
    std::fs::read_to_string(exported.path).unwrap()
}

fn undisturbed(study: &StudyFile) -> (TempDir, String) {
    let folder = tempdir().unwrap();
    assert_eq!(run_into(folder.path(), study, &mut Quiet), RunOutcome::Done);
    let text = csv(folder.path());
    (folder, text)
}

#[test]
fn rows_run_end_to_end_along_the_branch() {
    let (_folder, text) = undisturbed(&study_with(""));
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let columns: Vec<&str> = BranchTable::ALL[0].columns().map(TableColumn::name).collect();
    assert_eq!(lines[0], columns);
    assert_eq!((lines[1][2], lines[1][11]), ("10.0", "start"));
    let last = lines.last().unwrap();
    assert_eq!((last[2], last[11]), ("20.0", "end"));
    let events = |name: &str| lines.iter().filter(|line| line[11].contains(name)).count();
    assert_eq!((events("start"), events("end")), (1, 1));
    assert_eq!(lines.iter().filter(|line| line[2] == "15.0").count(), 1, "the start of the walks is one row");
}

#[test]
fn numbers_read_back_to_the_same_doubles() {
    let (folder, text) = undisturbed(&study_with(""));
    let store = Store::open(folder.path()).unwrap();
    let mut lines = text.lines().skip(1);
    store
        .each_row::<StoreError>(&store.branches().unwrap()[0], |row| {
            let line: Vec<&str> = lines.next().unwrap().split(',').collect();
            assert_eq!(line[2].parse::<f64>().unwrap().to_bits(), row.frequency_hz.to_bits());
            assert_eq!(line[8].parse::<f64>().unwrap().to_bits(), row.leading_multiplier[0].to_bits());
            Ok(())
        })
        .unwrap();
}

#[test]
fn a_run_interrupted_anywhere_and_resumed_ends_with_the_same_bytes() {
    let study = study();
    let (_folder, expected) = undisturbed(&study);
    for first in [1, 2, 3, 5, 8, 13] {
        let folder = tempdir().unwrap();
        let mut interruptions = 0;
        while run_into(folder.path(), &study, &mut StopAfter(first)) == RunOutcome::Interrupted {
            interruptions += 1;
            if interruptions > 20 {
                run_into(folder.path(), &study, &mut Quiet);
            }
        }
        assert!(interruptions > 0);
        assert_eq!(csv(folder.path()), expected, "interrupted after every {first} questions");
    }
}

#[test]
fn walks_that_take_turns_end_with_the_same_bytes() {
    let study = study_with("[response]\nperiod_multiples = [1]\nperiod_doubling_depth = 1\n");
    let of_turns = |turn: u64, threads: usize| {
        let folder = tempdir().unwrap();
        let mut store = Store::open_for_run(folder.path(), &study).unwrap();
        let solver = FakeSolver { flips: Some(100), ..FakeSolver::default() };
        let plan = Plan { turn, ..Plan::of(&study.study) };
        let outcome = run(&mut store, &solver, &plan, threads, &mut Quiet).unwrap();
        assert_eq!(outcome, RunOutcome::Done);
        assert!(store.branches().unwrap().len() > 6);
        store.finish().unwrap();
        (csv(folder.path()), solver.resumed.load(Ordering::Relaxed))
    };
    let (expected, resumed) = of_turns(u64::MAX, 1);
    assert_eq!(resumed, 0);
    for (turn, threads) in [(1, 1), (7, 1), (100, 1), (7, 2), (100, 3)] {
        let (bytes, resumed) = of_turns(turn, threads);
        assert_eq!(bytes, expected, "turns of {turn}, {threads} threads");
        assert!(resumed > 10, "{resumed} walks taken up again");
    }
}

#[test]
fn a_finished_run_started_again_computes_nothing() {
    let study = study();
    let (folder, expected) = undisturbed(&study);
    struct NothingNew;
    impl Observer for NothingNew {
        fn progress(&mut self, progress: &Progress) {
            panic!("computed {progress:?}");
        }
        fn working(&mut self, job: &hammerbeam_results::store::JobRecord, _done: DoneShare) {
            panic!("searched {job:?}");
        }
    }
    run_into(folder.path(), &study, &mut NothingNew);
    assert_eq!(csv(folder.path()), expected);
}

#[test]
fn starts_on_a_known_branch_begin_no_second_one() {
    let (folder, _) = undisturbed(&study());
    let multiples: Vec<u32> =
        Store::open(folder.path()).unwrap().branches().unwrap().iter().map(|b| b.period_multiple).collect();
    assert_eq!(multiples, [1, 2]);
}

#[test]
fn a_larger_budget_lets_a_paused_walk_go_on_to_the_same_bytes() {
    let study = study();
    let (_folder, expected) = undisturbed(&study);
    let folder = tempdir().unwrap();
    for budget in [100, 101, 350, 1_000_000] {
        let mut store = Store::open_for_run(folder.path(), &study).unwrap();
        let plan = Plan { budget, ..Plan::of(&study.study) };
        run(&mut store, &FakeSolver::default(), &plan, 2, &mut Quiet).unwrap();
        let branches = store.branches().unwrap();
        assert_eq!(branches[0].up.end.as_ref().unwrap().is_budget(), budget <= 350);
        // What is left at its budget holds nothing up.
        assert!(branches.iter().any(|branch| branch.period_multiple == 2));
        store.finish().unwrap();
    }
    assert_eq!(csv(folder.path()), expected);
}

#[test]
fn progress_counts_and_its_fraction_never_decreases() {
    struct Watch(f64, u64);
    impl Observer for Watch {
        fn working(&mut self, _job: &hammerbeam_results::store::JobRecord, done: DoneShare) {
            assert!((self.0..=1.0).contains(&done.fraction), "{done:?}");
            self.0 = done.fraction;
        }
        fn progress(&mut self, progress: &Progress) {
            assert!((self.0..=1.0).contains(&progress.done.fraction), "{progress:?}");
            assert!((0.0..=1.0).contains(&progress.done.of_this_run), "{progress:?}");
            assert!(progress.new_solutions > self.1);
            (self.0, self.1) = (progress.done.fraction, progress.new_solutions);
        }
    }
    let mut watch = Watch(0.0, 0);
    let folder = tempdir().unwrap();
    run_into(folder.path(), &study(), &mut watch);
    // How far it is when the last solutions come in depends on which thread was faster.
    assert!(watch.0 > 0.0, "{}", watch.0);
}

/// Whenever a run is stopped, the next one goes on from what the stopped one showed.
#[test]
fn a_run_that_goes_on_shows_no_less_than_the_stopped_one_did() {
    #[derive(Default)]
    struct Watch {
        shown: f64,
        first: Option<f64>,
        reports: usize,
        stops_at: usize,
    }
    impl Watch {
        fn see(&mut self, done: DoneShare) {
            self.first.get_or_insert(done.fraction);
            self.shown = done.fraction;
            self.reports += 1;
        }
    }
    impl Observer for Watch {
        fn working(&mut self, _job: &hammerbeam_results::store::JobRecord, done: DoneShare) {
            self.see(done);
        }
        fn progress(&mut self, progress: &Progress) {
            self.see(progress.done);
        }
        fn interrupted(&mut self) -> bool {
            self.reports >= self.stops_at
        }
    }
    let (study, folder, mut shown, mut stops) = (study(), tempdir().unwrap(), 0.0, 0);
    loop {
        let mut watch = Watch { stops_at: 5, ..Watch::default() };
        let outcome = run_into(folder.path(), &study, &mut watch);
        assert!(watch.first.is_none_or(|first| first >= shown), "{:?} after {shown}", watch.first);
        if outcome == RunOutcome::Done {
            break;
        }
        (shown, stops) = (watch.shown, stops + 1);
    }
    assert!(stops > 2 && shown > 0.0, "{stops} stops, {shown}");
    assert_eq!(Store::open(folder.path()).unwrap().part_done().unwrap(), 0.0);
}

/// Searches that find nothing are work, too: when the last one begins most of the run is done.
#[test]
fn searches_that_end_count_in_the_fraction() {
    struct Last(f64);
    impl Observer for Last {
        fn working(&mut self, _job: &hammerbeam_results::store::JobRecord, done: DoneShare) {
            self.0 = done.fraction;
        }
    }
    let (mut last, folder) = (Last(0.0), tempdir().unwrap());
    let mut store = Store::open_for_run(folder.path(), &study()).unwrap();
    run(&mut store, &FakeSolver::default(), &Plan::of(&study().study), 1, &mut last).unwrap();
    assert!(last.0 > 0.5, "{}", last.0);
}

/// States of six modes and four shooting segments; a real run also keeps a journal, which is thrown away at
/// the end.
#[test]
fn a_hundred_thousand_solutions_take_less_than_200_megabytes() {
    let study = study_with("");
    let folder = tempdir().unwrap();
    let solver = FakeSolver { step: 1e-4, state_length: 12, segments: 4, ..FakeSolver::default() };
    let mut store = Store::open_for_run(folder.path(), &study).unwrap();
    let plan = Plan { budget: 50_000, ..Plan::of(&study.study) };
    run(&mut store, &solver, &plan, 2, &mut Quiet).unwrap();
    store.finish().unwrap();
    let rows = export_csv(&Store::open(folder.path()).unwrap(), folder.path()).unwrap().rows;
    let size = std::fs::metadata(folder.path().join("results.db")).unwrap().len();
    assert!(rows > 70_000, "{rows} rows");
    let of_100_000 = size as f64 / rows as f64 * 1e5;
    assert!(of_100_000 < 100e6, "{of_100_000:.3e} bytes");
}

#[test]
fn a_panic_in_one_of_several_threads_ends_the_run_and_keeps_what_was_finished() {
    let (study, folder) = (study(), tempdir().unwrap());
    let mut store = Store::open_for_run(folder.path(), &study).unwrap();
    let solver = FakeSolver { panics: true, ..FakeSolver::default() };
    let ended = run(&mut store, &solver, &Plan::of(&study.study), 2, &mut Quiet);
    assert!(matches!(ended, Err(RunError::Thread)), "{ended:?}");
    drop(store);
    assert_eq!(run_into(folder.path(), &study, &mut Quiet), RunOutcome::Done);
    assert_eq!(csv(folder.path()), undisturbed(&study).1);
}

#[test]
fn starts_beyond_those_that_have_numbers_are_told() {
    let most = hammerbeam_results::store::MOST_STARTS as usize;
    assert_eq!(runner::too_many(most), None);
    assert!(runner::too_many(most + 1).is_some_and(|text| text.contains("1025 starts, of which 1024")));
}

/// A study that searches for nothing but the harmonic branch, and a solution of two periods that is known
/// from elsewhere.
#[test]
fn a_solution_that_was_met_elsewhere_begins_a_branch_and_only_once() {
    let study = study_with("[response]\nperiod_multiples = [1]\n[search]\nfrequencies = 0\n");
    let solver = FakeSolver::default();
    let folder = tempdir().unwrap();
    let branches_with = |met: Vec<PeriodicSolution>| {
        let mut store = Store::open_for_run(folder.path(), &study).unwrap();
        let plan = Plan { met, ..Plan::of(&study.study) };
        assert_eq!(run(&mut store, &solver, &plan, 2, &mut Quiet).unwrap(), RunOutcome::Done);
        let multiples: Vec<u32> = store.branches().unwrap().iter().map(|b| b.period_multiple).collect();
        store.finish().unwrap();
        multiples
    };
    assert_eq!(branches_with(vec![]), [1]);
    let met = vec![solver.solution(2, 0.5), solver.solution(2, -1.0)];
    assert_eq!(branches_with(met.clone()), [1, 2], "both lie on one branch");
    assert_eq!(branches_with(met), [1, 2]);
}

/// The branch of the fake is stable where `1.2 |sin 3 s|` is small enough, so the search goes on between.
#[test]
fn frequencies_without_a_stable_solution_are_looked_at_when_the_rest_is_done() {
    let study = study_with("");
    let folder = tempdir().unwrap();
    run_into(folder.path(), &study, &mut Quiet);
    let jobs = Store::open(folder.path()).unwrap().jobs().unwrap();
    let added: Vec<_> = jobs.iter().filter(|job| job.kind == JobKind::NoneStable).collect();
    assert!(!added.is_empty() && added.len() <= 24, "{}", added.len());
    assert!(added.iter().all(|job| job.outcome == Some(JobOutcome::Nothing)));
    let first = jobs.iter().position(|job| job.kind == JobKind::NoneStable).unwrap();
    assert!(jobs[..first].iter().all(|job| job.kind != JobKind::NoneStable) && first > 24);
}

/// A branch that is given up, for its work or since it leads nowhere, keeps what it has and why it ended; the
/// others are whole, and no search begins it anew without end.
#[test]
fn a_branch_that_is_given_up_leaves_the_others_whole() {
    let study = study_with("[response]\nperiod_multiples = [1, 2]\n[search]\nfrequencies = 2\n");
    let given_up = [
        StopReason::TooMuchWork { place: 14.0, solutions: 5, gets_on: false },
        StopReason::TooMuchWork { place: 14.0, solutions: 5, gets_on: true },
        StopReason::NoProgress { place: 14.0, solutions: 5, largest_multiplier: 1e9, has_no_losses: false },
    ];
    for reason in given_up {
        let solver = FakeSolver { given_up: Some(reason.clone()), ..FakeSolver::default() };
        let folder = tempdir().unwrap();
        let mut store = Store::open_for_run(folder.path(), &study).unwrap();
        let outcome = run(&mut store, &solver, &Plan::of(&study.study), 2, &mut Quiet).unwrap();
        assert_eq!(outcome, RunOutcome::Done);
        store.finish().unwrap();
        let branches = Store::open(folder.path()).unwrap().branches().unwrap();
        let mut sides = [0, 0];
        for branch in &branches {
            for side in [&branch.up, &branch.down] {
                sides[branch.period_multiple as usize - 1] += 1;
                match (branch.period_multiple, side.end.as_ref().unwrap()) {
                    (1, BranchEnd::Walk(StopReason::RangeEnd { .. })) => {}
                    // The upper side has the start besides.
                    (2, BranchEnd::Walk(end)) => {
                        assert!(end == &reason && (5..=6).contains(&side.solutions), "{side:?}");
                    }
                    other => panic!("{other:?}"),
                }
            }
        }
        assert_eq!(sides[0], 2);
        // A search at 2 frequencies and at few others: each may begin one more.
        assert!((4..40).contains(&sides[1]), "{sides:?}");
    }
}

/// Walks from above are lost at 14 Hz; the rest of the curve is found by later searches, and followed from
/// below up to there.
#[test]
fn a_branch_that_comes_upon_the_lost_end_of_another_is_cut_there() {
    let study = study_with("[response]\nperiod_multiples = [2]\n");
    let solver = FakeSolver { lost_hz: Some(14.0), ..FakeSolver::default() };
    let of_threads = |threads: usize, patience: usize| {
        let folder = tempdir().unwrap();
        let mut observer = StopAfter(patience);
        loop {
            let mut store = Store::open_for_run(folder.path(), &study).unwrap();
            let outcome = run(&mut store, &solver, &Plan::of(&study.study), threads, &mut observer).unwrap();
            store.finish().unwrap();
            if outcome == RunOutcome::Done {
                return (csv(folder.path()), folder);
            }
            observer = StopAfter(2 * patience);
        }
    };
    let (expected, folder) = of_threads(1, usize::MAX);
    let branches = Store::open(folder.path()).unwrap().branches().unwrap();
    let kind = |walk: &hammerbeam_results::store::WalkRecord| walk.end.as_ref().unwrap().word();
    let kinds: Vec<_> = branches.iter().map(|branch| (kind(&branch.up), kind(&branch.down))).collect();
    assert_eq!(kinds, [("range-end", "step-too-short"), ("joins", "range-end")]);
    let joins = matches!(branches[1].up.end, Some(BranchEnd::Joins { branch: Some(1), .. }));
    assert!(joins, "{:?}", branches[1].up.end);
    let frequencies = |text: &str| {
        let lines = text.lines().skip(1).map(|line| line.split(',').nth(2).unwrap().parse::<f64>().unwrap());
        let mut sorted: Vec<f64> = lines.collect();
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let steps = frequencies(&expected).windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>();
    assert!(steps.iter().all(|step| (0.005..0.015).contains(step)), "one row in each step");
    for (threads, patience) in [(2, usize::MAX), (3, usize::MAX), (1, 3), (2, 5), (3, 8)] {
        assert_eq!(of_threads(threads, patience).0, expected, "{threads} threads, patience {patience}");
    }
}

/// A ring of 628 steps: both sides are lost, the upper one is, the lower one is, or none.
#[test]
fn a_closed_branch_is_held_once_whichever_side_comes_round() {
    let study = study_with("[response]\nperiod_multiples = [2]\n");
    let cases = [
        ([400, 400], ["step-too-short", "joins"], [400..=402, 226..=230]),
        ([400, 900], ["closed", "closed"], [1..=1, 628..=630]),
        ([900, 400], ["closed", "closed"], [629..=631, 0..=0]),
        ([900, 900], ["closed", "closed"], [629..=631, 0..=0]),
    ];
    for (ring, words, counts) in cases {
        let solver = FakeSolver { ring: Some(ring), ..FakeSolver::default() };
        let of_threads = |threads: usize| {
            let folder = tempdir().unwrap();
            let mut store = Store::open_for_run(folder.path(), &study).unwrap();
            let outcome = run(&mut store, &solver, &Plan::of(&study.study), threads, &mut Quiet).unwrap();
            assert_eq!(outcome, RunOutcome::Done);
            store.finish().unwrap();
            (csv(folder.path()), folder)
        };
        let (expected, folder) = of_threads(1);
        let branches = Store::open(folder.path()).unwrap().branches().unwrap();
        assert_eq!(branches.len(), 1, "{ring:?}");
        let sides = [&branches[0].up, &branches[0].down];
        assert_eq!(sides.map(|side| side.end.as_ref().unwrap().word()), words, "{ring:?}");
        let fits = sides.iter().zip(&counts).all(|(side, counts)| counts.contains(&side.solutions));
        assert!(fits, "{ring:?}: {:?}", sides.map(|side| side.solutions));
        assert_eq!(of_threads(3).0, expected, "{ring:?}");
    }
}
