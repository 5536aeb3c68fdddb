//! Every command that writes, in small: for tests that disturb it in the middle and look at what is there.

use std::{
    collections::BTreeMap,
    f64::consts::PI,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    sync::OnceLock,
    time::{Duration, Instant},
};

use super::{Workshop, assert_success};

/// An oscillator beside a spring that it grazes: branches, one over another parameter, a curve of grazings.
const STUDY: &str = r#"
title = "Oscillator beside a spring"
[structure]
kind = "lumped"
mass = [{ name = "mass", mass_kg = 1.0 }]
spring = [{ between = ["mass", "ground"], stiffness_n_m = 9.869604401089358 }]
[damping]
modal_ratio = 0.05
[excitation]
kind = "force"
at = "mass"
amplitude_n = 0.1
frequency_hz = [0.4, 0.6]
[[stop]]
name = "stop"
at = "mass"
law = "linear"
stiffness_n_m = 1.0
side = "above"
gap_m = 0.05
[continuation]
max_step_hz = 0.02
[search]
frequencies = 2
starts = 1
trials = 0
[[vary]]
parameter = "excitation.amplitude_n"
range = [0.08, 0.12]
frequency_hz = 0.5
steps = 100
[[curve]]
of = "grazing"
near_hz = 0.5
parameter = "excitation.amplitude_n"
range = [0.08, 0.12]
"#;

/// Its eigenfrequency, from which `update` finds its spring.
const DATA: &str = r#"
title = "spring"
[[parameter]]
key = "structure.spring.1.stiffness_n_m"
start = 9.0
[[eigenfrequency]]
mode = [1]
hz = [0.5]
deviation_relative = 0.001
"#;

/// The virtual rig of the studies folder on two hertz of its sweep.
const RIG: &str = include_str!("../../../../studies/virtual-rig.toml");
const RIG_CHANGES: [(&str, &str); 4] = [
    ("sweep_hz = [20.0, 70.0]", "sweep_hz = [30.0, 32.0]"),
    ("\nstep_hz = 0.5", "\nstep_hz = 1.0"),
    ("frequency_hz = [20.0, 78.0]", "frequency_hz = [30.0, 33.0]"),
    ("other_low_pass_hz = [1500.0, 3000.0]", "other_low_pass_hz = [1500.0]"),
];

/// Commands with what they need, and those that take seconds.
const COMMANDS: [(&str, Needs, Cost); 18] = [
    ("run study.toml --out out --jobs 2", Needs::Study, Cost::Small),
    ("run study.toml --out out --from swept --jobs 2", Needs::Sweep, Cost::Small),
    ("modes study.toml --out drawn", Needs::Study, Cost::Small),
    ("orbit study.toml --frequency 0.5 --out drawn", Needs::Study, Cost::Small),
    ("simulate study.toml --frequency 0.5 --periods 400 --out out", Needs::Study, Cost::Small),
    ("sweep study.toml --step 0.004 --down --out out", Needs::Study, Cost::Small),
    ("sweep study.toml --step 0.02 --starts 3 --out out", Needs::Study, Cost::Small),
    (
        "lyapunov study.toml --frequency 0.45 --to 0.55 --step 0.02 --periods 200 --out out",
        Needs::Study,
        Cost::Small,
    ),
    (
        "basins study.toml --frequency 0.5 --x q1=-0.1..0.1 --y v1=-0.3..0.3 --grid 12 --out out",
        Needs::Study,
        Cost::Small,
    ),
    ("export out --format csv --states", Needs::Results, Cost::Small),
    ("figure out --out drawn", Needs::Results, Cost::Small),
    ("compare out points.csv", Needs::Results, Cost::Small),
    ("overlay out record.csv --frequency 0.45 --out laid", Needs::Results, Cost::Small),
    ("update study.toml data.toml --out updated", Needs::Study, Cost::Small),
    ("signal filter record.csv --low-pass 2 --out filtered", Needs::Study, Cost::Small),
    ("signal chain record.csv --sensor displacement --low-pass 2 --out chained", Needs::Study, Cost::Small),
    ("signal spectrum record.csv --out drawn", Needs::Study, Cost::Small),
    ("rig rig.toml --out out --jobs 2", Needs::Study, Cost::Large),
];

/// What a command works on.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Needs {
    Study,
    /// Attractors in `swept`.
    Sweep,
    /// The results of `run` in `out`.
    Results,
}

/// How long a command takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// Up to a second or two.
    Small,
    /// Many seconds.
    Large,
}

/// Files by their paths from the folder of the work.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A command that writes, and what it leaves behind when nothing disturbs it.
pub struct Writer {
    pub arguments: Vec<&'static str>,
    pub cost: Cost,
    /// What it begins with.
    before: Files,
    /// What is there afterwards, results as tables.
    pub expected: Files,
    /// Of the undisturbed command.
    pub duration: Duration,
}

/// The commands that cost little, each done once, for all tests.
pub fn small_writers() -> &'static [Writer] {
    static SMALL: OnceLock<Vec<Writer>> = OnceLock::new();
    SMALL.get_or_init(|| writers(Cost::Small))
}

/// The commands that cost no more than that, each done once.
pub fn writers(most: Cost) -> Vec<Writer> {
    let study = Workshop::with(STUDY);
    let rig = RIG_CHANGES.iter().fold(RIG.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    });
    for (name, text) in [
        ("data.toml", DATA.to_owned()),
        ("points.csv", points()),
        ("record.csv", record()),
        ("rig.toml", rig),
    ] {
        fs::write(study.path(name), text).unwrap();
    }
    let alone = files(&study);
    assert_success(&study.hammerbeam(&[
        "sweep",
        "study.toml",
        "--step",
        "0.04",
        "--starts",
        "3",
        "--out",
        "swept",
    ]));
    let with_sweep = files(&study);
    fs::remove_dir_all(study.path("swept")).unwrap();
    assert_success(&study.hammerbeam(&["run", "study.toml", "--out", "out"]));
    let with_results = files(&study);
    let chosen = COMMANDS.into_iter().filter(|(_, _, cost)| *cost == Cost::Small || most == Cost::Large);
    chosen
        .map(|(command, needs, cost)| {
            let before = match needs {
                Needs::Study => &alone,
                Needs::Sweep => &with_sweep,
                Needs::Results => &with_results,
            };
            Writer::new(command.split(' ').collect(), cost, before.clone())
        })
        .collect()
}

impl Writer {
    fn new(arguments: Vec<&'static str>, cost: Cost, before: Files) -> Self {
        let mut writer =
            Self { arguments, cost, before, expected: Files::new(), duration: Duration::default() };
        let workshop = writer.begin();
        let begun = Instant::now();
        assert_success(&workshop.hammerbeam(&writer.arguments));
        writer.duration = begun.elapsed();
        writer.expected = left_behind(&workshop);
        let is_new = |path: &PathBuf| !writer.before.contains_key(path);
        assert!(writer.expected.keys().any(is_new), "{:?} writes nothing", writer.arguments);
        writer
    }

    /// A folder in which the command can be done.
    pub fn begin(&self) -> Workshop {
        let workshop = Workshop::with("");
        for (path, bytes) in &self.before {
            let path = workshop.path("").join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        workshop
    }

    /// Does the command once more, and looks whether all is as it would be without what happened before.
    #[track_caller]
    pub fn assert_ends_the_same(&self, workshop: &Workshop, after: &str) {
        let output = workshop.hammerbeam(&self.arguments);
        assert!(output.status.success(), "{:?} after {after}: {}", self.arguments, super::stderr(&output));
        self.assert_is_whole(workshop, after);
    }

    /// Looks whether all is there, as it would be without what happened.
    #[track_caller]
    pub fn assert_is_whole(&self, workshop: &Workshop, after: &str) {
        let found = left_behind(workshop);
        let names = |files: &Files| files.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&found), names(&self.expected), "{:?} after {after}", self.arguments);
        for (name, bytes) in &self.expected {
            let same = &found[name] == bytes;
            assert!(same, "{:?} after {after}: {} differs", self.arguments, name.display());
        }
    }
}

/// Whether a file is of the database, whose pages may lie in another order.
fn is_of_the_database(path: &Path) -> bool {
    let name = path.file_name().unwrap().to_string_lossy();
    name.starts_with("results.db") || name == "run.lock"
}

/// Files below the folder of the work, parts of files included.
fn files(workshop: &Workshop) -> Files {
    let root = workshop.path("");
    let below = workshop.listing().into_iter().filter(|(path, _)| path.is_file());
    below.map(|(path, bytes)| (path.strip_prefix(&root).unwrap().to_owned(), bytes)).collect()
}

/// All files, and the tables of the database in its place.
fn left_behind(workshop: &Workshop) -> Files {
    if workshop.path("out/results.db").is_file() {
        let export = ["export", "out", "--format", "csv", "--states", "--out", "tables"];
        assert_success(&workshop.hammerbeam(&export));
    }
    files(workshop).into_iter().filter(|(path, _)| !is_of_the_database(path)).collect()
}

/// Measured maxima.
fn points() -> String {
    let mut table = "frequency [Hz],tip [mm],kind,period\n".to_owned();
    for k in 0..15 {
        writeln!(table, "{},{},periodic,1", 0.42 + 0.01 * f64::from(k), 40 + k).unwrap();
    }
    table
}

/// Twenty seconds of a measured displacement.
fn record() -> String {
    let mut table = "time [s],tip [m]\n".to_owned();
    for k in 0..400 {
        let time = 0.05 * f64::from(k);
        writeln!(table, "{time:.2},{:.8}", 0.08 * (2.0 * PI * 0.45 * time).sin()).unwrap();
    }
    table
}
