//! Running, killing, resuming and exporting with the real command.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use crate::common::{
    SeededNumbers, TWO_MASSES, Workshop, assert_success, extensive, reported, short_run, short_study, stderr,
    stdout,
};

const RUN: [&str; 4] = ["run", "study.toml", "--out", "results"];

/// Columns that scripts rely on, in this order.
const FIXED: &str = "branch,period_multiple,frequency_hz,max_abs_displacement_m,max_abs_acceleration_m_s2,\
    max_contact_force_n,max_impact_velocity_m_s,contacts,leading_multiplier_re,\
    leading_multiplier_im,stable,event";

/// The two masses around their resonances in steps so small that a run takes a second and commits many times.
fn long_study() -> String {
    assert!(TWO_MASSES.contains("[3.0, 14.0]"));
    let study = TWO_MASSES.replace("[3.0, 14.0]", "[4.0, 11.0]");
    format!("{study}\n[continuation]\nmax_step_hz = 0.002\n[search]\nfrequencies = 2\ntrials = 0\n")
}

/// Exported rows of an undisturbed run, and how long it took.
fn undisturbed(study: &str) -> (String, Duration) {
    let workshop = Workshop::with(study);
    let begun = Instant::now();
    assert_success(&workshop.hammerbeam(&RUN));
    (workshop.csv("results"), begun.elapsed())
}

/// Each of the runs is killed somewhere from its beginning to its very end and taken up again once: two by
/// default, ten of the whole range with `HAMMERBEAM_EXTENSIVE=1`.
#[test]
fn killed_at_random_instants_and_resumed_it_ends_with_the_same_bytes() {
    let whole = format!("{TWO_MASSES}\n[continuation]\nmax_step_hz = 0.002\n");
    let (study, kills) = if extensive() { (whole, 10) } else { (long_study(), 2) };
    let (expected, duration) = undisturbed(&study);
    let mut random = SeededNumbers(20);
    for _ in 0..kills {
        let part = random.number();
        let workshop = killed(&study, duration.mul_f64(0.98 * part));
        assert_success(&workshop.hammerbeam(&RUN));
        assert!(workshop.csv("results") == expected, "the rows differ after a kill at {part}");
    }
}

/// A run that was killed after this time, or earlier if it was finished by then.
fn killed(study: &str, after: Duration) -> Workshop {
    let mut wait = after;
    loop {
        let workshop = Workshop::with(study);
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(RUN)
            .current_dir(workshop.path(""))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(wait);
        let at_work = child.try_wait().unwrap().is_none();
        child.kill().unwrap();
        child.wait().unwrap();
        if at_work {
            return workshop;
        }
        wait = wait.mul_f64(0.7);
    }
}

/// A run that got Ctrl-C after this time, or earlier if all was computed by then, and how many lines of rows
/// it kept.
#[cfg(unix)]
fn interrupted(study: &str, after: Duration, whole: usize) -> (Workshop, usize) {
    let mut wait = after;
    loop {
        let workshop = Workshop::with(study);
        let child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(RUN)
            .current_dir(workshop.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        sleep(wait);
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        wait = wait.mul_f64(0.7);
        // A process that has ended gets no signal.
        if output.status.success() {
            continue;
        }
        assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
        let kept = workshop.csv("results").lines().count();
        if kept < whole {
            assert!(stderr(&output).contains("solutions are kept in results"), "{}", stderr(&output));
            return (workshop, kept);
        }
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_finished_and_exits_with_130() {
    let (expected, duration) = undisturbed(&long_study());
    let (workshop, kept) = interrupted(&long_study(), duration.mul_f64(0.5), expected.lines().count());
    assert!(kept > 10, "{kept} rows");
    assert_success(&workshop.hammerbeam(&RUN));
    assert!(workshop.csv("results") == expected);
}

#[test]
fn exported_rows_have_the_fixed_columns_and_run_end_to_end() {
    let (csv, _) = undisturbed(&format!("{TWO_MASSES}\n[continuation]\nmax_step_hz = 0.01\n"));
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().starts_with(FIXED));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let event = |index: usize| rows[index][11];
    assert!(event(0).contains("start") && event(rows.len() - 1).contains("end"));
    assert!(rows.iter().all(|row| ["true", "false", "marginal"].contains(&row[10])));
    // In a damped system a multiplier is on the unit circle at bifurcations alone.
    let bifurcation =
        |event: &str| ["fold", "flip", "neimark-sacker"].iter().any(|kind| event.contains(kind));
    assert!(rows.iter().all(|row| row[10] != "marginal" || bifurcation(row[11])));
    assert!(rows.iter().all(|row| row[9].parse::<f64>().unwrap() >= 0.0), "the positive one of a pair");
    assert!(rows.iter().any(|row| row[11].contains("fold")));
    // A small closed branch near 4.75 Hz is the other one.
    let first: Vec<&Vec<&str>> = rows.iter().filter(|row| row[0] == "1").collect();
    let ends: Vec<f64> =
        [first[0], first[first.len() - 1]].iter().map(|row| row[2].parse().unwrap()).collect();
    assert!(
        ends.contains(&3.0) && ends.contains(&14.0),
        "branches are cut exactly at the ends, not at {ends:?}"
    );
}

#[test]
fn without_a_terminal_a_run_says_only_its_summary() {
    let workshop = Workshop::with(&short_study());
    let output = workshop.hammerbeam(&RUN);
    assert_success(&output);
    assert_eq!(reported(&output), "");
    assert!(stdout(&output).contains("solutions on 1 branch in results"));
    for figure in ["response_displacement.svg", "response_displacement.png", "response_acceleration.svg"] {
        assert!(fs::metadata(workshop.path("results").join(figure)).unwrap().len() > 1000, "{figure}");
    }
}

#[test]
fn two_runs_do_not_write_one_folder() {
    let workshop = Workshop::with(TWO_MASSES);
    let mut first = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(RUN)
        .current_dir(workshop.path(""))
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while !workshop.path("results/results.db").exists() {
        sleep(Duration::from_millis(5));
    }
    crate::common::assert_bad_input(&workshop.hammerbeam(&RUN), &["another run is writing to results"]);
    first.kill().unwrap();
    first.wait().unwrap();
}

#[test]
fn the_starter_study_checks_and_runs() {
    let workshop = Workshop::with("");
    assert_success(&workshop.hammerbeam(&["new", "starter"]));
    assert_success(&workshop.hammerbeam(&["check", "starter/study.toml"]));
    assert_success(&workshop.hammerbeam(&["run", "starter/study.toml", "--out", "starter/results"]));
    assert!(workshop.csv("starter/results").lines().count() > 100);
}

/// The states of a run are those from which `simulate` repeats: an orbit of `n` periods is there again after
/// `n`.
#[test]
fn exported_states_and_multipliers_belong_to_the_rows() {
    let workshop = short_run();
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv", "--states", "--out", "x"]));
    let read = |name: &str| fs::read_to_string(workshop.path(name)).unwrap();
    let (branches, states) = (read("x/branches.csv"), read("x/states.csv"));
    assert_eq!(branches.lines().count(), states.lines().count());
    for (branch, state) in branches.lines().zip(states.lines()).skip(1) {
        let (branch, state): (Vec<&str>, Vec<&str>) =
            (branch.split(',').collect(), state.split(',').collect());
        assert_eq!((branch[0], branch[1], branch[2]), (state[0], state[1], state[3]));
        assert!(state[6].starts_with(branch[8]), "{} leads, not {}", branch[8], state[6]);
    }
    let row: Vec<&str> = states.lines().nth(1).unwrap().split(',').collect();
    let initial = row[5].replace(' ', ",");
    let arguments = ["simulate", "study.toml", "--frequency", row[3], "--initial", &initial];
    let options = ["--periods", "1", "--samples-per-period", "1", "--out", "motion"];
    assert_success(&workshop.hammerbeam(&[&arguments[..], &options].concat()));
    let section = read("motion/stroboscopic.csv");
    let entries =
        |line: &str| line.split(',').rev().take(4).map(|e| e.parse().unwrap()).collect::<Vec<f64>>();
    let lines: Vec<Vec<f64>> = section.lines().skip(1).map(entries).collect();
    for (first, last) in lines[0].iter().zip(&lines[lines.len() - 1]) {
        assert!((first - last).abs() < 1e-9, "{first} and {last}");
    }
}
