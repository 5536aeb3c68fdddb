//! Every command that writes, on a disk that refuses: each call that writes, brings to the disk or moves a
//! file fails once, whichever it is, or files may grow only so far.
//!
//! Each time there is an error with a sentence and exit code 1 and no panic, or the failure did no harm and
//! all is there; what was finished is kept; and the command done again leaves the same bytes as an
//! undisturbed one. By default one call of one kind for a command; with `HAMMERBEAM_EXTENSIVE=1` every call
//! of the small commands; `HAMMERBEAM_FAILURES=N` takes N of each kind, `HAMMERBEAM_COMMAND=TEXT` the
//! commands that begin so. Calls are made to fail by `strace`; where that is not there, the test says so and
//! only limits the size of files.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "it has to say what it did")]

use std::{
    collections::BTreeMap,
    fmt, fs,
    path::Path,
    process::{Command, Output},
};

use rusqlite::{Connection, OpenFlags};

use crate::common::{
    SeededNumbers, Workshop, extensive, stderr,
    writers::{Writer, small_writers},
};

/// Calls of the system that fail, and how.
const CALLS: [(&str, &str); 3] = [
    ("write,writev,pwrite64", "ENOSPC"),
    ("fsync,fdatasync", "EIO"),
    ("?rename,?renameat,?renameat2,ftruncate,?unlink,?unlinkat,?mkdir,?mkdirat", "ENOSPC"),
];

/// How `strace` is called.
const TRACED: [&str; 5] = ["-f", "-qq", "--seccomp-bpf", "-s", "0"];

/// What goes wrong in a command.
#[derive(Debug, Clone, Copy)]
enum Fault {
    /// The call with this number, from 1 on, of each thread.
    Call { names: &'static str, error: &'static str, number: usize },
    /// A file that would be longer than so many blocks of 512 bytes.
    FileSize { blocks: usize },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Call { names, error, number } => write!(f, "{error} of call {number} of {names}"),
            Self::FileSize { blocks } => write!(f, "files of {blocks} blocks at most"),
        }
    }
}

#[test]
fn writes_that_fail_end_with_a_sentence_and_the_command_done_again_leaves_the_same_files() {
    let asked = std::env::var("HAMMERBEAM_FAILURES").ok().map(|count| count.parse::<usize>().unwrap());
    let most = asked.unwrap_or(if extensive() { usize::MAX } else { 1 });
    let traces = Command::new("strace").args(TRACED).args(["-e", "trace=?rename,fsync", "true"]).output();
    let traces = traces.is_ok_and(|output| output.status.success());
    if !traces {
        eprintln!("skipped: strace cannot make calls fail here; files are limited alone");
    }
    let mut random = SeededNumbers(7);
    let start = std::env::var("HAMMERBEAM_COMMAND").unwrap_or_default();
    let chosen_writers = small_writers().iter().enumerate();
    for (place, writer) in chosen_writers.filter(|(_, writer)| writer.arguments.join(" ").starts_with(&start))
    {
        let largest = writer.expected.values().map(Vec::len).max().unwrap();
        for number in chosen(largest / 512, most.min(20), &mut random) {
            fail_once(writer, Fault::FileSize { blocks: number - 1 });
        }
        // By default the kinds take turns.
        let kinds = if most == 1 { &CALLS[place % CALLS.len()..][..1] } else { &CALLS[..] };
        for &(names, error) in kinds.iter().filter(|_| traces) {
            let count = calls(writer, names);
            let chosen = chosen(count, most, &mut random);
            let failures: usize = chosen
                .iter()
                .map(|&number| fail_once(writer, Fault::Call { names, error, number }))
                .filter(|failed| *failed)
                .count();
            eprintln!(
                "{}: {failures} of {} failures of {count} calls of {names} were reported",
                writer.arguments.join(" "),
                chosen.len()
            );
        }
    }
}

/// So many numbers from 1 to `count`, or all of them.
fn chosen(count: usize, most: usize, random: &mut SeededNumbers) -> Vec<usize> {
    if most >= count {
        return (1..=count).collect();
    }
    // One from each of so many equal parts.
    let part = count as f64 / most as f64;
    (0..most).map(|k| 1 + ((k as f64 + random.number()) * part) as usize).collect()
}

/// The most calls that a thread of the undisturbed command makes.
fn calls(writer: &Writer, names: &str) -> usize {
    let workshop = writer.begin();
    let (output, log) = traced(writer, &workshop, names, None);
    assert!(output.status.success(), "{}", stderr(&output));
    let mut of_threads = BTreeMap::<&str, usize>::new();
    for line in log.lines().filter(|line| line.contains('(')) {
        *of_threads.entry(line.split(' ').next().unwrap()).or_default() += 1;
    }
    of_threads.into_values().max().unwrap_or(0)
}

/// Does the command under `strace`, with a failure of one of the calls or without.
///
/// # Returns
/// How it ended, and the calls.
fn traced(writer: &Writer, workshop: &Workshop, names: &str, failure: Option<&str>) -> (Output, String) {
    let log = tempfile::NamedTempFile::new().unwrap();
    let mut command = Command::new("strace");
    command.args(TRACED).arg("-o").arg(log.path());
    command.args(["-e", &format!("trace={names}")]);
    if let Some(failure) = failure {
        command.args(["-e", &format!("inject={names}:{failure}")]);
    }
    command.arg(assert_cmd::cargo::cargo_bin!("hammerbeam")).args(&writer.arguments);
    let output = command.current_dir(workshop.path("")).output().unwrap();
    (output, fs::read_to_string(log.path()).unwrap())
}

/// Does the command with this fault, and again without it.
///
/// # Returns
/// Whether it ended with an error.
fn fail_once(writer: &Writer, fault: Fault) -> bool {
    let workshop = writer.begin();
    let (output, is_mute) = disturbed(writer, &workshop, fault);
    let (message, place) = (stderr(&output), format!("{fault}, {:?}", writer.arguments));
    assert!(!message.contains("panicked"), "{place}: {message}");
    let failed = match output.status.code() {
        Some(0) => false,
        Some(1) => true,
        other => panic!("exit code {other:?} after {place}: {message}"),
    };
    let sentence = message.lines().find_map(|line| line.strip_prefix("error: "));
    assert!(!failed || is_mute || sentence.is_some_and(|text| text.len() > 20), "{place}: {message}");
    let kept = solutions(&workshop.path("out/results.db"));
    if failed {
        writer.assert_ends_the_same(&workshop, &format!("{place}: {message}"));
    } else {
        writer.assert_is_whole(&workshop, &place);
    }
    let now = solutions(&workshop.path("out/results.db"));
    assert!(kept.iter().all(|(key, checksum)| now.get(key) == Some(checksum)), "{place}: rows are lost");
    failed
}

/// Does the command with this fault.
///
/// # Returns
/// How it ended, and whether it was standard error that could not be written.
fn disturbed(writer: &Writer, workshop: &Workshop, fault: Fault) -> (Output, bool) {
    match fault {
        Fault::Call { names, error, number } => {
            let failure = format!("error={error}:when={number}");
            let (output, log) = traced(writer, workshop, names, Some(&failure));
            (output, log.lines().any(|line| line.contains("write(2,") && line.contains("INJECTED")))
        }
        Fault::FileSize { blocks } => {
            let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
            let mut command = Command::new("sh");
            command.args(["-c", &script, "sh"]).arg(assert_cmd::cargo::cargo_bin!("hammerbeam"));
            let output = command.args(&writer.arguments).current_dir(workshop.path("")).output();
            (output.unwrap(), false)
        }
    }
}

/// Keys of the stored solutions of numbered branches with their checksums; none where there is no database
/// yet. Walks run ahead of what is decided on them: one that turns out to go where another went has no
/// number, and its rows may go.
fn solutions(database: &Path) -> BTreeMap<i64, i64> {
    let read = || -> rusqlite::Result<BTreeMap<i64, i64>> {
        let connection = Connection::open_with_flags(database, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
        let mut statement = connection.prepare(
            "SELECT solution.id, solution.checksum FROM solution
            JOIN walk ON walk.id = solution.id >> 32
            JOIN start ON start.id = walk.start
            WHERE start.branch IS NOT NULL",
        )?;
        statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect()
    };
    read().unwrap_or_default()
}
