//! Commands that are killed or interrupted: what was finished is kept, and what goes on ends with the same bytes.

use std::{
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use crate::{
    DUFFING,
    basins::BASINS,
    column,
    common::{Workshop, assert_success, stderr},
    remembering, table,
};

/// Basins that were killed three times have the bytes of those that were not, on another number of threads.
#[test]
fn basins_go_on_after_a_kill_with_the_same_bytes() {
    let whole = Workshop::with(DUFFING);
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&[&BASINS[..], &["out", "--jobs", "1"]].concat()));
    let duration = begun.elapsed();
    let workshop = Workshop::with(DUFFING);
    for _ in 0..3 {
        kill_after(&workshop, duration.mul_f64(0.2));
    }
    assert_success(&workshop.hammerbeam(&[&BASINS[..], &["out", "--jobs", "3"]].concat()));
    for name in ["out/basins.csv", "out/attractors.csv"] {
        assert!(fs::read(whole.path(name)).unwrap() == fs::read(workshop.path(name)).unwrap(), "{name}");
    }
}

fn start(workshop: &Workshop) -> std::process::Child {
    spawn(workshop, &[&BASINS[..], &["out", "--jobs", "1"]].concat())
}

fn spawn(workshop: &Workshop, arguments: &[&str]) -> std::process::Child {
    Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(arguments)
        .current_dir(workshop.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn kill_after(workshop: &Workshop, wait: Duration) {
    let mut child = start(workshop);
    sleep(wait);
    child.kill().unwrap();
    child.wait().unwrap();
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_finished_cells_and_exits_with_130() {
    let workshop = Workshop::with(DUFFING);
    let child = start(&workshop);
    while !workshop.path("out/results.db").exists() {
        sleep(Duration::from_millis(2));
    }
    sleep(Duration::from_millis(150));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("cells are kept in out"), "{}", stderr(&output));
}

/// A long motion of any kind ends with what is finished, too.
#[cfg(unix)]
#[test]
fn ctrl_c_ends_every_command_with_130() {
    for (arguments, table) in [
        (
            &["simulate", "study.toml", "--frequency", "0.2", "--periods", "100000000"][..],
            Some("samples.csv"),
        ),
        (&["lyapunov", "study.toml", "--frequency", "0.2", "--periods", "10000000"], None),
        (&["sweep", "study.toml", "--step", "0.00001"], Some("sweep.csv")),
        (&["sweep", "study.toml", "--step", "0.0001", "--starts", "5"], Some("sweep.csv")),
    ] {
        let workshop = Workshop::with(DUFFING);
        let child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(arguments)
            .args(["--out", "out"])
            .current_dir(workshop.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Long enough for the command to listen; the work takes hours.
        sleep(Duration::from_millis(1500));
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{arguments:?} {}", stderr(&output));
        assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
        if let Some(name) = table {
            let rows = fs::read_to_string(workshop.path("out").join(name)).unwrap();
            assert!(rows.lines().count() > 1, "{arguments:?}");
        }
    }
}

/// Sweeps, diagrams and series of exponents that were killed have the bytes of those that were not.
#[test]
fn sweeps_and_exponents_go_on_after_a_kill_with_the_same_bytes() {
    let sweep = ["sweep", "study.toml", "--step", "0.001", "--down", "--out", "out"];
    let starts = ["sweep", "study.toml", "--step", "0.005", "--starts", "3", "--out", "out"];
    let series =
        ["lyapunov", "study.toml", "--frequency", "0.1", "--to", "0.4", "--step", "0.05", "--out", "out"];
    for (arguments, names) in [
        (&sweep[..], &["sweep.csv", "sweep_samples.csv"][..]),
        (&starts, &["sweep.csv", "sweep_samples.csv"]),
        (&series, &["spectra.csv", "exponents.csv", "convergence.csv", "section.csv"]),
    ] {
        let whole = Workshop::with(DUFFING);
        let begun = Instant::now();
        assert_success(&whole.hammerbeam(arguments));
        let duration = begun.elapsed();
        let workshop = Workshop::with(DUFFING);
        for _ in 0..3 {
            let mut child = spawn(&workshop, arguments);
            sleep(duration.mul_f64(0.3));
            child.kill().unwrap();
            child.wait().unwrap();
        }
        assert_success(&workshop.hammerbeam(arguments));
        for name in names {
            let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
            assert!(of(&whole) == of(&workshop), "{arguments:?} {name}");
        }
    }
}

/// A sweep whose motions are in contact at phase 0, which their states do not tell all of: killed and taken up again it has the same bytes.
#[test]
fn a_sweep_within_contacts_that_remember_goes_on_with_the_same_bytes() {
    let study = remembering();
    let whole = Workshop::with(&study);
    let sweep =
        ["sweep", "study.toml", "--from", "0.3", "--to", "0.5", "--step", "0.001", "--initial", "-0.1,0"];
    let sweep = [&sweep[..], &["--down", "--out", "out"]].concat();
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&sweep));
    let duration = begun.elapsed();
    let samples = column(&table(&whole, "out/sweep_samples.csv"), "displacement_m");
    assert!(samples.iter().filter(|displacement| **displacement > 0.0).count() > 10, "some are in contact");
    let workshop = Workshop::with(&study);
    for _ in 0..3 {
        let mut child = spawn(&workshop, &sweep);
        sleep(duration.mul_f64(0.3));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_success(&workshop.hammerbeam(&sweep));
    for name in ["sweep.csv", "sweep_samples.csv"] {
        let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
        assert!(of(&whole) == of(&workshop), "{name}");
    }
}
