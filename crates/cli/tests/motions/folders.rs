//! Folders that a command refuses: of another study, or none at all.

use std::{
    fs,
    process::{Child, Command},
    thread::sleep,
    time::Duration,
};

use rusqlite::{Connection, ErrorCode, OpenFlags};

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, short_run};

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
    let workshop = short_run();
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

/// Two commands do not write the same tables at once: one that has stored all and is stopped before its first
/// table is in its place has the folder for itself still.
#[cfg(unix)]
#[test]
fn a_folder_is_locked_until_the_tables_are_written() {
    for (command, table) in COMMANDS.into_iter().zip(["samples", "sweep", "sweep", "spectra", "basins"]) {
        let command = [command, &["--out", "out"]].concat();
        let stopped = (0..30).find_map(|_| stopped_before_its_table(&command, table));
        let (workshop, mut child) =
            stopped.unwrap_or_else(|| panic!("{command:?} was never stopped in time"));
        assert_bad_input(&workshop.hammerbeam(&command), &["another run is writing to out"]);
        child.kill().unwrap();
        child.wait().unwrap();
    }
}

/// The command, stopped when all was stored and the table not there; `None` where it was too quick.
///
/// It is let go for a moment at a time, so that it does not get far between two looks however busy the
/// machine.
#[cfg(unix)]
fn stopped_before_its_table(command: &[&str], table: &str) -> Option<(Workshop, Child)> {
    let workshop = Workshop::with(TWO_MASSES);
    let mut child = workshop.spawn(command);
    let number = child.id().to_string();
    let signal = |signal: &str| {
        assert!(Command::new("kill").args([signal, &number]).status().unwrap().success());
    };
    // A command that is stopped may hold the database for itself; it is not waited for.
    let stored = || -> rusqlite::Result<bool> {
        let database = workshop.path("out/results.db");
        let connection = Connection::open_with_flags(database, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
        connection.busy_timeout(Duration::ZERO)?;
        if !connection.table_exists(None::<&str>, "request")? {
            return Ok(false);
        }
        connection.query_row("SELECT done = pieces FROM request ORDER BY id LIMIT 1", [], |row| row.get(0))
    };
    loop {
        signal("-STOP");
        if stored().unwrap_or_else(|error| panic_unless_not_yet(&error))
            || child.try_wait().unwrap().is_some()
        {
            break;
        }
        signal("-CONT");
        sleep(Duration::from_micros(300));
    }
    if !workshop.path(&format!("out/{table}.csv")).exists() {
        return Some((workshop, child));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    None
}

/// False where the database is not there, still without a request, or in use.
#[cfg(unix)]
fn panic_unless_not_yet(error: &rusqlite::Error) -> bool {
    let not_yet = match error {
        rusqlite::Error::QueryReturnedNoRows => true,
        error => matches!(
            error.sqlite_error_code(),
            Some(
                ErrorCode::DatabaseBusy
                    | ErrorCode::DatabaseLocked
                    // A command that was stopped while it opened the log beside the database.
                    | ErrorCode::FileLockingProtocolFailed
                    | ErrorCode::CannotOpen
            )
        ),
    };
    assert!(not_yet, "{error}");
    false
}

/// As a command leaves it whose first write has failed, or that was killed before its tables were there.
#[test]
fn a_folder_whose_database_is_still_empty_is_begun() {
    for arguments in COMMANDS {
        let workshop = Workshop::with(TWO_MASSES);
        fs::create_dir(workshop.path("out")).unwrap();
        fs::write(workshop.path("out/results.db"), "").unwrap();
        assert_success(&workshop.hammerbeam(&[arguments, &["--out", "out"]].concat()));
    }
}
