//! Branches over other parameters and curves, stopped in their middle and verified.

use hammerbeam_jobs::{
    Observer, PreparedStudy, VariedProgress,
    run::{RunOutcome, RunRequest, run_study},
    verify::{VerifySettings, verify},
};
use hammerbeam_results::{Store, export_csv, export_states};
use tempfile::{TempDir, tempdir};

/// An oscillator on a hardening spring: an S over the force, with two folds, and the curve of the folds.
pub const STUDY: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "mass", mass_kg = 1.0 }]
spring = [{ between = ["mass", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["mass", "ground"], damping_n_s_m = 0.1 }]
[excitation]
kind = "force"
at = "mass"
amplitude_n = 0.3
frequency_hz = [0.2, 0.3]
[[stop]]
name = "spring"
at = "mass"
law = "cubic"
stiffness_n_m3 = 1.0
[search]
frequencies = 2
starts = 1
trials = 0
[continuation]
max_step_hz = 0.005
[[vary]]
parameter = "excitation.amplitude_n"
range = [0.02, 0.8]
frequency_hz = 0.25
steps = 60
[[vary]]
parameter = "structure.mass.1.mass_kg"
range = [0.9, 1.2]
frequency_hz = 0.25
steps = 40
[[curve]]
of = "fold"
near_hz = 0.25
parameter = "excitation.amplitude_n"
range = [0.1, 0.6]
"#;

/// Stops at so many rows of pieces.
struct StopAtRow {
    rows: usize,
    at: usize,
}

impl Observer for StopAtRow {
    fn varied(&mut self, _: &VariedProgress<'_>) {
        self.rows += 1;
    }

    fn interrupted(&mut self) -> bool {
        self.rows >= self.at
    }
}

/// Runs a study, stopped at every so many rows and started again; the folder, and how often it was stopped.
fn run_stopped_at(text: &str, rows: usize) -> (TempDir, usize) {
    let study = PreparedStudy::parse("study.toml", text).unwrap();
    let folder = tempdir().unwrap();
    let mut stops = 0;
    loop {
        let request = RunRequest { out: folder.path(), from: &[], threads: 1 };
        let run = run_study(&study, request, &mut StopAtRow { rows: 0, at: rows }).unwrap();
        run.store.finish().unwrap();
        match run.report.outcome {
            RunOutcome::Done => return (folder, stops),
            outcome => assert_eq!(outcome, RunOutcome::Interrupted),
        }
        stops += 1;
        assert!(stops < 1000, "it does not get on");
    }
}

/// All tables of a folder.
fn tables(folder: &TempDir) -> Vec<(String, String)> {
    let out = tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    export_csv(&store, out.path()).unwrap();
    export_states(&store, out.path()).unwrap();
    let mut tables: Vec<(String, String)> = std::fs::read_dir(out.path())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| {
            (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(path).unwrap())
        })
        .collect();
    tables.sort();
    tables
}

/// A branch over a parameter goes on in its middle. Without the curve: a side of one is stored whole, so
/// stops that come before its end would let it never get on.
#[test]
fn branches_over_parameters_that_are_stopped_anywhere_end_with_the_same_bytes() {
    let (branches, _) = STUDY.split_once("[[curve]]").unwrap();
    let (whole, stops) = run_stopped_at(branches, usize::MAX);
    assert_eq!(stops, 0);
    let expected = tables(&whole);
    assert!(
        expected.iter().any(|(name, text)| name == "parameter_branches.csv" && text.lines().count() > 100)
    );
    for rows in [40, 61] {
        let (stopped, stops) = run_stopped_at(branches, rows);
        assert!(stops > 1, "stopped {stops} times");
        assert!(tables(&stopped) == expected, "other bytes when stopped at every {rows} rows");
    }
}

/// The independent integrator agrees with every row of every piece, of one over a mass as well, where each
/// row has modes of its own.
#[test]
fn rows_of_branches_over_parameters_and_of_curves_are_verified() {
    let (folder, _) = run_stopped_at(STUDY, usize::MAX);
    let store = Store::open(folder.path()).unwrap();
    let study = PreparedStudy::of_store(&store).unwrap();
    let settings = VerifySettings { sample: None, jobs: 2, ..VerifySettings::default() };
    let found = verify(&store, &study, &settings, &mut hammerbeam_jobs::Quiet).unwrap().unwrap();
    let lines = |name: &str| {
        let (_, text) = tables(&folder).into_iter().find(|(other, _)| other == name).unwrap();
        text.lines().count() as u64 - 1
    };
    assert_eq!(found.stored, lines("branches.csv") + lines("parameter_branches.csv") + lines("curves.csv"));
    assert_eq!((found.sampled, found.disagreements), (found.stored, Vec::new()));
}
