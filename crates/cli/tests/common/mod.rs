//! What the tests of the command share.

#![allow(dead_code, reason = "every test file uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

pub mod writers;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::{self, Child, Output, Stdio},
    sync::LazyLock,
};

use assert_cmd::Command;
use hammerbeam_jobs::StoredBranches;
use hammerbeam_study::{Model, StudyFile};
pub use hammerbeam_testkit::{SeededNumbers, extensive};
use serde_json::Value;
use tempfile::TempDir;

/// A results database, to be changed as the program itself would change it: with the checksums of its rows.
pub fn database(path: impl AsRef<Path>) -> rusqlite::Connection {
    let connection = rusqlite::Connection::open(path).unwrap();
    hammerbeam_results::store::add_checksums(&connection).unwrap();
    connection
}

/// A beam with a stop, as in the studies folder.
pub const BEAM: &str = include_str!("../../../../studies/beam-with-stop.toml");
/// Two masses with a one-sided spring: a whole run takes a few seconds.
pub const TWO_MASSES: &str = include_str!("../../../../studies/two-masses.toml");

/// A mass on a spring, driven by a force; the frequencies and all tables that follow are still to come.
pub const DRIVEN_MASS: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 1.0 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["m", "ground"], damping_n_s_m = 0.04 }]
[excitation]
kind = "force"
at = "m"
amplitude_n = 0.4
"#;

/// One mass that is shaken against a stop above it, 0.02 m away; `stop` has its law.
pub fn mass_against_a_stop(stop: &str) -> String {
    format!(
        r#"
[structure]
kind = "lumped"
[[structure.mass]]
name = "mass"
mass_kg = 1.0
[[structure.spring]]
between = ["mass", "ground"]
stiffness_n_m = 1000.0
[damping]
modal_ratio = 0.02
[excitation]
kind = "force"
at = "mass"
amplitude_n = 5.0
frequency_hz = [5.2, 6.4]
phase_rad = -2.2
[[stop]]
name = "wall"
at = "mass"
side = "above"
gap_m = 0.02
{stop}
[response]
period_multiples = [1]
[search]
frequencies = 1
starts = 1
[continuation]
max_step_hz = 0.01
[[vary]]
parameter = "stop.wall.gap_m"
range = [0.015, 0.022]
frequency_hz = 5.9
steps = 100
"#
    )
}

/// A row of a table by the names of its columns.
pub type Row = BTreeMap<String, String>;

/// The model of a study and the branches of its results.
pub fn stored(workshop: &Workshop) -> (Model, StoredBranches) {
    let file = StudyFile::read(&workshop.path("study.toml")).unwrap();
    let branches = StoredBranches::open(&workshop.path("results"), &file).unwrap();
    (Model::build(&file).unwrap(), branches)
}

/// A number of a row.
pub fn number(row: &Row, key: &str) -> f64 {
    row[key].parse().unwrap()
}

/// A folder with a study file in it.
pub struct Workshop {
    folder: TempDir,
}

impl Workshop {
    pub fn with(study: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("study.toml"), study).unwrap();
        Self { folder }
    }

    /// [`DRIVEN_MASS`] with the rest of its study.
    pub fn driven_mass(rest: &str) -> Self {
        Self::with(&format!("{DRIVEN_MASS}{rest}"))
    }

    /// A study with one piece of text replaced.
    #[track_caller]
    pub fn changed(study: &str, old: &str, new: &str) -> Self {
        assert!(study.contains(old), "{old} is not in the study");
        Self::with(&study.replacen(old, new, 1))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Another folder with the same files.
    pub fn copied(&self) -> Self {
        let copy = Self { folder: tempfile::tempdir().unwrap() };
        for (path, bytes) in self.listing() {
            let target = copy.path("").join(path.strip_prefix(self.path("")).unwrap());
            if path.is_dir() { fs::create_dir(target) } else { fs::write(target, bytes) }.unwrap();
        }
        copy
    }

    /// Runs the command in the folder.
    pub fn hammerbeam(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Computes the study into `results` and draws nothing.
    pub fn compute(&self, more: &[&str]) -> Output {
        self.hammerbeam(&[&COMPUTE[..], more].concat())
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::cargo_bin("hammerbeam").unwrap();
        command.current_dir(self.folder.path()).args(arguments);
        command
    }

    /// Starts the command in the folder; what it prints can be read when it has ended.
    pub fn spawn(&self, arguments: &[&str]) -> Child {
        self.spawn_into(Stdio::null(), arguments)
    }

    /// The same, with its standard output there.
    pub fn spawn_into(&self, stdout: Stdio, arguments: &[&str]) -> Child {
        process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(arguments)
            .current_dir(self.folder.path())
            .stdout(stdout)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    /// Exported branches of a results folder.
    pub fn csv(&self, results: &str) -> String {
        let export = self.hammerbeam(&["export", results, "--format", "csv", "--out", "exported"]);
        assert_success(&export);
        fs::read_to_string(self.path("exported/branches.csv")).unwrap()
    }

    /// A study that was run and exported into `results`.
    #[track_caller]
    pub fn exported(study: &str) -> Self {
        let workshop = Self::with(study);
        assert_success(&workshop.compute(&[]));
        assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
        workshop
    }

    /// Rows of a CSV file by the names of its columns.
    pub fn table(&self, name: &str) -> Vec<Row> {
        let text = fs::read_to_string(self.path(name)).unwrap();
        let mut lines = text.lines();
        let header: Vec<&str> = lines.next().unwrap().split(',').collect();
        let row = |line: &str| {
            let values = fields(line);
            assert_eq!(values.len(), header.len(), "{line}");
            header.iter().zip(values).map(|(key, value)| ((*key).to_owned(), value)).collect()
        };
        lines.map(row).collect()
    }

    /// All files below the folder with their contents.
    pub fn listing(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let mut files = Vec::new();
        collect(self.folder.path(), &mut files);
        files.sort();
        files
    }
}

/// Fields of a line; commas between quotation marks do not separate.
fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut is_quoted) = (vec![String::new()], false);
    for character in line.chars() {
        match character {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            _ => fields.last_mut().unwrap().push(character),
        }
    }
    fields
}

fn collect(folder: &Path, files: &mut Vec<(PathBuf, Vec<u8>)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.push((path.clone(), Vec::new()));
            collect(&path, files);
        } else {
            files.push((path.clone(), fs::read(&path).unwrap()));
        }
    }
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Standard error without the lines of progress that work of more than ten seconds has.
pub fn reported(output: &Output) -> String {
    stderr(output)
        .lines()
        .filter(|line| !line.starts_with("progress: "))
        .map(|line| format!("{line}\n"))
        .collect()
}

/// Presses Ctrl-C, and waits for the end.
#[cfg(unix)]
pub fn interrupted(child: Child) -> Output {
    let kill = process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    child.wait_with_output().unwrap()
}

#[track_caller]
pub fn assert_success(output: &Output) {
    assert!(output.status.success(), "{:?}\n{}\n{}", output.status, stdout(output), stderr(output));
}

/// Exit code 2, every part in the message, nothing on standard output.
#[track_caller]
pub fn assert_bad_input(output: &Output, parts: &[&str]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(stdout(output), "");
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in:\n{message}");
    }
}

/// Computes the study and draws what it finds.
pub const RUN: [&str; 4] = ["run", "study.toml", "--out", "results"];

/// Computes the study.
pub const COMPUTE: [&str; 5] = ["run", "study.toml", "--out", "results", "--no-figures"];

/// The two masses above their resonances, where there is one branch, in a hundred steps, after a short
/// search.
pub fn short_study() -> String {
    assert!(TWO_MASSES.contains("[3.0, 14.0]"));
    let study = TWO_MASSES.replacen("[3.0, 14.0]", "[13.5, 14.0]", 1);
    format!("{study}\n[search]\nfrequencies = 2\ntrials = 0\n[continuation]\nmax_step_hz = 0.005\n")
}

/// A run of one short branch, which is done once: each test has a copy.
pub fn short_run() -> Workshop {
    static DONE: LazyLock<Workshop> = LazyLock::new(|| short_run_with(""));
    DONE.copied()
}

/// A run of one short branch with more in its study.
pub fn short_run_with(added: &str) -> Workshop {
    let workshop = Workshop::with(&format!("{}{added}", short_study()));
    assert_success(&workshop.compute(&[]));
    workshop
}

/// Files that `figure` draws of the folder, of which nothing is refused.
pub fn files(workshop: &Workshop, arguments: &[&str]) -> Vec<String> {
    let output = workshop.hammerbeam(&[&["figure", "results", "--json"][..], arguments].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).expect("one JSON document");
    assert_eq!(document["not_drawn"].as_array().unwrap().len(), 0, "{}", stderr(&output));
    document["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}
