//! Places that take nothing: folders that cannot be made, links, a standard output that is full or closed.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, short_run};

/// Every command that makes a folder says the same of one that cannot be made, with the same exit code.
#[test]
fn a_folder_that_cannot_be_written_is_exit_code_2_everywhere() {
    let workshop = short_run();
    std::fs::write(workshop.path("file"), "").unwrap();
    for arguments in [
        &["run", "study.toml", "--out", "file/results"][..],
        &["export", "results", "--format", "csv", "--out", "file/tables"],
        &["figure", "results", "--out", "file/figures"],
        &["new", "file/study"],
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), &["file/"]);
    }
}

/// Neither a database, nor what stands beside it, nor a folder that a command makes by itself may be a link;
/// what it leads to stays as it was. Tables take the place of links.
#[cfg(unix)]
#[test]
fn nothing_is_written_through_links() {
    use std::{fs, os::unix::fs::symlink};
    let workshop = short_run();
    let at = |name: &str| workshop.path(name);
    for (k, name) in
        ["results.db", "results.db-wal", "results.db-journal", "run.lock"].into_iter().enumerate()
    {
        fs::create_dir(at(&format!("{k}"))).unwrap();
        // Once to what is not there yet, once to a database.
        let led_to = if k == 0 { at("results/results.db") } else { at("new") };
        symlink(led_to, at(&format!("{k}/{name}"))).unwrap();
    }
    fs::create_dir_all(at("elsewhere")).unwrap();
    symlink(at("elsewhere"), at("results/export")).unwrap();
    symlink(at("elsewhere"), at("results/compare")).unwrap();
    fs::write(at("points.csv"), "frequency [Hz],tip [mm]\n13.6,1\n13.8,1\n").unwrap();
    let before = fs::read(at("results/results.db")).unwrap();
    for (arguments, name) in [
        (&["run", "study.toml", "--out", "0"][..], "0/results.db"),
        (&["run", "study.toml", "--out", "1"], "1/results.db-wal"),
        (&["run", "study.toml", "--out", "2"], "2/results.db-journal"),
        (&["run", "study.toml", "--out", "3"], "3/run.lock"),
        (&["sweep", "study.toml", "--step", "0.1", "--out", "0"], "0/results.db"),
        (&["export", "results", "--format", "csv"], "results/export"),
        (&["compare", "results", "points.csv"], "results/compare"),
    ] {
        let sentence = format!("cannot write to {name}: it is a link, and nothing is written through links");
        let sentence = if name.contains('.') { sentence } else { sentence.replace("write to", "write") };
        assert_bad_input(&workshop.hammerbeam(arguments), &[&sentence]);
    }
    // A member of a family is a folder that the command makes by itself, too.
    fs::create_dir(at("family")).unwrap();
    symlink(at("elsewhere"), at("family/damping.modal_ratio=0.02")).unwrap();
    let vary = ["run", "study.toml", "--out", "family", "--vary-set", "damping.modal_ratio=0.02"];
    assert_bad_input(&workshop.hammerbeam(&vary), &["damping.modal_ratio=0.02: it is a link"]);
    assert!(!at("new").exists() && fs::read_dir(at("elsewhere")).unwrap().next().is_none());
    assert_eq!(fs::read(at("results/results.db")).unwrap(), before);
    // What one reads may be a link.
    assert_success(&workshop.hammerbeam(&["export", "0", "--format", "csv", "--out", "tables"]));
}

/// A disk without room is an error, a reader that has gone away is none.
#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_takes_nothing_is_an_error_and_a_closed_pipe_is_none() {
    let workshop = Workshop::with(TWO_MASSES);
    for arguments in [
        &["check", "study.toml"][..],
        &["check", "study.toml", "--json"],
        &["--help"],
        &["--version"],
        &["help", "run"],
        &["check", "-h"],
        &["signal", "--help"],
    ] {
        let run = |stdout: std::process::Stdio| {
            let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"));
            command.args(arguments).current_dir(workshop.path("")).stdout(stdout);
            command.stderr(std::process::Stdio::piped()).output().unwrap()
        };
        let full = run(std::fs::File::options().write(true).open("/dev/full").unwrap().into());
        assert_eq!(full.status.code(), Some(1));
        let text = String::from_utf8(full.stderr).unwrap();
        assert!(text.contains("cannot write to standard output"), "{text}");
        // A descriptor that was opened for reading only.
        let unwritable = run(std::fs::File::open("/dev/null").unwrap().into());
        assert_eq!(unwritable.status.code(), Some(1), "{arguments:?}");
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        assert_eq!(run(writer.into()).status.code(), Some(0));
    }
}

/// Where nobody listens the work goes on, and a failure has its exit code.
#[cfg(target_os = "linux")]
#[test]
fn standard_error_that_cannot_be_written_changes_nothing() {
    let workshop = Workshop::with(TWO_MASSES);
    let run = |arguments: &[&str]| {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"));
        command.args(arguments).current_dir(workshop.path("")).stderr(full);
        command.stdout(std::process::Stdio::null()).status().unwrap().code()
    };
    assert_eq!(run(&["check", "study.toml"]), Some(0));
    assert_eq!(run(&["check", "nowhere.toml"]), Some(2));
    assert_eq!(run(&["orbit", "study.toml"]), Some(2));
}
