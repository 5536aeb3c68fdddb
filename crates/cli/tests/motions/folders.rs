//! Folders that a command refuses: of another study, or none at all.

use std::{fs, process::Command, thread::sleep, time::Duration};

use hammerbeam_study::Store;

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, short_run};

/// The commands that keep what they find, each with little to do.
const COMMANDS: [&[&str]; 5] = [
    &["simulate", "study.toml", "--frequency", "13.6", "--periods", "1"],
    &["sweep", "study.toml", "--from", "13.6", "--to", "13.6"],
    &["sweep", "study.toml", "--from", "13.6", "--to", "13.6", "--starts", "2"],
    &["lyapunov", "study.toml", "--frequency", "13.6", "--periods", "20"],
    &["basins", "study.toml", "--frequency", "13.6", "--x", "q1=0..1", "--y", "v1=0..1", "--grid", "1"],
];

/// The results are those of a study with another damping; they stay what they are.
#[test]
fn results_of_another_study_are_refused_whatever_they_are_wanted_for() {
    let workshop = short_run("");
    let study = fs::read_to_string(workshop.path("study.toml")).unwrap();
    let changed = study.replacen("modal_ratio = 0.02", "modal_ratio = 0.03", 1);
    assert_ne!(changed, study);
    fs::write(workshop.path("study.toml"), changed).unwrap();
    let before = workshop.listing();
    for command in COMMANDS {
        for option in ["--out", "--results"] {
            let output = workshop.hammerbeam(&[command, &[option, "results"]].concat());
            let parts = ["results holds the results of another study", "0.02 there, 0.03 here"];
            assert_bad_input(&output, &parts);
        }
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

/// The path is a file, or lies in one.
#[test]
fn a_file_is_refused_as_a_folder() {
    let workshop = Workshop::with(TWO_MASSES);
    fs::write(workshop.path("notes"), "mine").unwrap();
    let before = workshop.listing();
    for command in COMMANDS {
        for (out, part) in [
            ("notes", "cannot write to notes: it is a file, not a folder"),
            ("notes/out", "cannot write to notes/out: "),
        ] {
            assert_bad_input(&workshop.hammerbeam(&[command, &["--out", out]].concat()), &[part]);
        }
        let output = workshop.hammerbeam(&[command, &["--results", "notes"]].concat());
        assert_bad_input(&output, &["there are no results in notes"]);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

/// Two commands do not write the same tables at once: one that is stopped while it writes a long table has the folder for itself still.
#[cfg(unix)]
#[test]
fn a_folder_is_locked_until_the_tables_are_written() {
    let workshop = Workshop::with(TWO_MASSES);
    let motion = ["simulate", "study.toml", "--frequency", "13.6", "--periods", "200"];
    let command = [&motion[..], &["--samples-per-period", "3000", "--out", "out"]].concat();
    let mut child = workshop.spawn(&command);
    let stored = || {
        let requests = Store::open(&workshop.path("out")).and_then(|store| store.requests());
        requests.is_ok_and(|requests| requests.first().is_some_and(|one| one.done == one.pieces))
    };
    while !stored() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before its tables");
        sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-STOP", &child.id().to_string()]).status().unwrap().success());
    assert!(!workshop.path("out/samples.csv").exists(), "the table was written already");
    assert_bad_input(&workshop.hammerbeam(&command), &["another run is writing to out"]);
    child.kill().unwrap();
    child.wait().unwrap();
}
