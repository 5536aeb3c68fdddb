//! A study of several branches gives the same exported bytes with any number of threads, after kills, and in
//! pieces.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{
    fs,
    process::{Command, Stdio},
    sync::OnceLock,
    thread::sleep,
    time::{Duration, Instant},
};

use crate::common::{SeededNumbers, Workshop, assert_success, stdout};

/// A bilinear oscillator with superharmonic and subharmonic branches and doublings of them: a second or two.
const STUDY: &str = r#"
title = "Bilinear oscillator"

[structure]
kind = "lumped"
mass = [{ name = "mass", mass_kg = 1.0 }]
spring = [{ between = ["mass", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["mass", "ground"], damping_n_s_m = 0.1 }]

[excitation]
kind = "force"
at = "mass"
amplitude_n = 1.0
frequency_hz = [0.12, 0.6]

[[stop]]
at = "mass"
law = "linear"
stiffness_n_m = 19.0
side = "above"

[search]
frequencies = 4
starts = 3
trials = 3

[response]
period_multiples = [1, 2, 3]
period_doubling_depth = 1
"#;

fn with_continuation(lines: &str) -> String {
    format!("{STUDY}\n[continuation]\nmax_step_hz = 0.001\n{lines}\n")
}

/// Everything exported.
fn exported(workshop: &Workshop) -> (String, String) {
    let branches = workshop.csv("results");
    (branches, fs::read_to_string(workshop.path("exported/events.csv")).unwrap())
}

fn run(workshop: &Workshop, jobs: &str) -> String {
    let output = workshop.hammerbeam(&["run", "study.toml", "--out", "results", "--jobs", jobs]);
    assert_success(&output);
    stdout(&output)
}

/// Exported bytes of an undisturbed run on one thread, and how long it took.
fn undisturbed() -> &'static ((String, String), Duration) {
    static BYTES: OnceLock<((String, String), Duration)> = OnceLock::new();
    BYTES.get_or_init(|| {
        let workshop = Workshop::with(&with_continuation(""));
        let begun = Instant::now();
        run(&workshop, "1");
        let took = begun.elapsed();
        (exported(&workshop), took)
    })
}

#[test]
fn one_two_and_three_threads_give_the_same_bytes() {
    let (expected, _) = undisturbed();
    assert!(expected.0.lines().last().unwrap().split(',').next().unwrap().parse::<u32>().unwrap() >= 4);
    for jobs in ["2", "3"] {
        let workshop = Workshop::with(&with_continuation(""));
        run(&workshop, jobs);
        assert!(exported(&workshop) == *expected, "{jobs} threads");
    }
}

#[test]
fn three_threads_killed_at_ten_instants_and_resumed_end_with_the_same_bytes() {
    let (expected, duration) = undisturbed();
    let workshop = Workshop::with(&with_continuation(""));
    let (mut random, mut killed) = (SeededNumbers(20), 0);
    for _ in 0..10 {
        let part = random.number();
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(["run", "study.toml", "--out", "results", "--jobs", "3"])
            .current_dir(workshop.path(""))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(duration.mul_f64(0.2 * part));
        killed += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    run(&workshop, "3");
    assert!(killed >= 3, "only {killed} runs were still at work");
    assert!(exported(&workshop) == *expected);
}

#[test]
fn budgets_and_a_depth_that_are_raised_one_after_the_other_give_the_same_bytes() {
    let (expected, _) = undisturbed();
    let shallow = |budget: &str| {
        with_continuation(budget).replace("period_doubling_depth = 1", "period_doubling_depth = 0")
    };
    let workshop = Workshop::with(&shallow("budget_solutions = 150"));
    assert!(run(&workshop, "2").contains("budget"));
    for study in [shallow("budget_solutions = 400"), with_continuation("budget_solutions = 400")] {
        fs::write(workshop.path("study.toml"), study).unwrap();
        run(&workshop, "2");
    }
    fs::write(workshop.path("study.toml"), with_continuation("")).unwrap();
    run(&workshop, "2");
    assert!(exported(&workshop) == *expected);
}

#[test]
fn a_budget_of_time_ends_a_run_and_running_again_goes_on_to_the_same_bytes() {
    let (expected, _) = undisturbed();
    let workshop = Workshop::with(&with_continuation("budget_time_s = 0.2"));
    run(&workshop, "1");
    assert!(exported(&workshop).0.lines().count() < expected.0.lines().count(), "it ended early");
    fs::write(workshop.path("study.toml"), with_continuation("")).unwrap();
    run(&workshop, "2");
    assert!(exported(&workshop) == *expected);
}

/// Flips of branches of that period.
fn flips_of_period(workshop: &Workshop, period: &str) -> usize {
    let events = fs::read_to_string(workshop.path("exported/events.csv")).unwrap();
    let columns: Vec<&str> = events.lines().next().unwrap().split(',').collect();
    let place = |name: &str| columns.iter().position(|column| *column == name).unwrap();
    let (multiple, event) = (place("period_multiple"), place("event"));
    let rows = events.lines().skip(1).map(|row| row.split(',').collect::<Vec<_>>());
    rows.filter(|row| row[multiple] == period && row[event].split('+').any(|event| event == "flip")).count()
}

/// Flips of which a run says that the doubled branch is not followed, over all branches.
fn not_followed(reported: &str) -> usize {
    let lines =
        reported.lines().filter(|line| line.ends_with("is not followed: the study does not ask for it"));
    lines.map(|line| line.split_whitespace().nth(1).unwrap().parse::<usize>().unwrap()).sum()
}

#[test]
fn a_depth_that_is_raised_later_gives_what_it_gives_at_once() {
    let shallow = with_continuation("").replace("[0.12, 0.6]", "[0.12, 0.25]");
    let deeper = shallow.replace("period_doubling_depth = 1", "period_doubling_depth = 2");
    let at_once = Workshop::with(&deeper);
    run(&at_once, "2");
    let raised = Workshop::with(&shallow);
    let reported = run(&raised, "2");
    let before = raised.csv("results").lines().count();
    let flips_of_four = flips_of_period(&raised, "4");
    assert!(flips_of_four > 0);
    assert_eq!(not_followed(&reported), flips_of_four, "{reported}");
    fs::write(raised.path("study.toml"), &deeper).unwrap();
    run(&raised, "2");
    let (branches, events) = exported(&raised);
    assert!(branches.lines().count() > before, "there are doublings of doublings");
    assert!((branches, events) == exported(&at_once));
}
