//! A run of 100 000 solutions stays below 200 MB of memory and 200 MB of disk; a large structure takes what
//! was estimated.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{
    f64::consts::PI,
    fmt::Write,
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use crate::common::{BEAM, COMPUTE, Workshop, assert_success, extensive, number, stderr};

/// Solutions of the small run and of the one with `HAMMERBEAM_EXTENSIVE=1`.
const SOLUTIONS: [u64; 2] = [500, 100_000];

/// Largest memory of a process so far [bytes]; `None` when it has ended.
fn peak_memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}

/// Largest memory of a command that succeeds [bytes].
fn peak_of(workshop: &Workshop, arguments: &[&str]) -> u64 {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(arguments)
        .current_dir(workshop.path(""))
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        peak = peak.max(peak_memory(child.id()).unwrap_or(0));
        sleep(Duration::from_millis(5));
    }
    assert!(child.wait().unwrap().success());
    peak
}

fn folder_size(workshop: &Workshop, folder: &str) -> u64 {
    fs::read_dir(workshop.path(folder)).unwrap().map(|entry| entry.unwrap().metadata().unwrap().len()).sum()
}

#[test]
fn memory_and_results_folder_stay_below_200_megabytes() {
    let solutions = SOLUTIONS[usize::from(extensive())];
    let study = BEAM.replace("period_multiples = [1, 2, 3]", "period_multiples = [1]").replace(
        "[response]",
        &format!("[continuation]\nmax_step_hz = 0.0005\nbudget_solutions = {solutions}\n[response]"),
    );
    let study = study.replace("[19.0, 110.0]", "[25.0, 80.0]");
    // A short search: what is looked for has little to do with what is held.
    let workshop = Workshop::with(&study.replace("trials = 0", "frequencies = 1\ntrials = 0"));
    let peak = peak_of(&workshop, &COMPUTE);
    let rows = workshop.csv("results").lines().count() as u64 - 1;
    let size = folder_size(&workshop, "results");
    assert!(rows >= solutions, "{rows} solutions");
    assert!(peak > 1_000_000 && peak < 200_000_000, "{peak} bytes of memory for {rows} solutions");
    assert!(size < 200_000_000 * rows / 100_000, "{size} bytes of results for {rows} solutions");
}

/// Four equal masses in a row without damping, over all their resonances: each piece of the branch ends where
/// its amplitude has no bound, before it takes memory.
#[test]
fn a_chain_without_damping_ends_at_its_resonances_in_little_memory() {
    let masses: Vec<String> =
        ["a", "b", "c", "d"].map(|name| format!("{{ name = \"{name}\", mass_kg = 1.0 }}")).to_vec();
    let springs: Vec<String> = [("a", "ground"), ("a", "b"), ("b", "c"), ("c", "d")]
        .map(|(one, other)| format!("{{ between = [\"{one}\", \"{other}\"], stiffness_n_m = 1.0 }}"))
        .to_vec();
    let workshop = Workshop::with(&format!(
        "[structure]\nkind = \"lumped\"\nmass = [{}]\nspring = [{}]\n[excitation]\nkind = \"force\"\n\
         at = \"d\"\namplitude_n = 1.0\nfrequency_hz = [0.04, 0.33]\n[continuation]\nmax_step_hz = 1e-3\n",
        masses.join(", "),
        springs.join(", "),
    ));
    let peak = peak_of(&workshop, &COMPUTE);
    assert!(peak < 200_000_000, "{peak} bytes of memory");
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    let ends = workshop.table("results/export/ends.csv");
    let mut unbounded: Vec<f64> =
        ends.iter().filter(|end| end["end"] == "unbounded").map(|end| number(end, "frequency_hz")).collect();
    unbounded.sort_by(f64::total_cmp);
    // `w_k = 2 sin((2 k - 1) pi / 18)`; each is come to from both sides.
    let resonances = (1..=4).map(|k| (f64::from(2 * k - 1) * PI / 18.0).sin() / PI);
    for (found, expected) in unbounded.chunks(2).zip(resonances) {
        assert!(found.iter().all(|hz| (hz / expected - 1.0).abs() < 1e-6), "{unbounded:?}, {expected}");
    }
    assert_eq!((unbounded.len(), ends.len()), (8, 10));
}

/// A cube of unit masses, each on springs to its six neighbours and a weak one to the ground.
fn write_cube(workshop: &Workshop, side: usize) {
    let (mut stiffness, mut mass) = (String::new(), String::new());
    for row in 0..side.pow(3) {
        let mut own = 1e-3;
        for step in [1, side, side * side] {
            let place = row / step % side;
            if place + 1 < side {
                writeln!(stiffness, "{} {} -1.0", row + step + 1, row + 1).unwrap();
            }
            own += f64::from(u8::from(place > 0) + u8::from(place + 1 < side));
        }
        writeln!(stiffness, "{0} {0} {own:?}", row + 1).unwrap();
        writeln!(mass, "{0} {0} 1.0", row + 1).unwrap();
    }
    let head = |text: &str| {
        let (rows, entries) = (side.pow(3), text.lines().count());
        format!("%%MatrixMarket matrix coordinate real symmetric\n{rows} {rows} {entries}\n{text}")
    };
    fs::write(workshop.path("K.mtx"), head(&stiffness)).unwrap();
    fs::write(workshop.path("M.mtx"), head(&mass)).unwrap();
}

/// The parts of the estimate are really taken, and no more than all of it beside the program itself.
#[test]
fn memory_of_a_large_structure_is_as_estimated() {
    const STUDY: &str = "[structure]\nkind = \"matrices\"\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\n\
                         [reduction]\nmethod = \"truncation\"\ncut_off_hz = 0.03\n";
    const PROGRAM: f64 = 0.025;
    let workshop = Workshop::with(STUDY);
    write_cube(&workshop, 30);
    let small = ["modes", "study.toml", "--set", "structure.memory_gb=0.01"];
    let refused = workshop.hammerbeam(&small);
    assert_eq!(refused.status.code(), Some(2));
    let message = stderr(&refused);
    assert!(message.contains("the modes of 27000 coordinates take up to"), "{message}");
    let part = |before: &str, after: &str| -> f64 {
        let text = message.split_once(before).unwrap().1;
        text.split_once(after).unwrap().0.parse().unwrap()
    };
    let (matrices, factors) = (part("(matrices ", ","), part("factors ", ","));
    assert!(factors > 0.05, "{message}");
    let peak = peak_of(&workshop, &["modes", "study.toml"]) as f64 / 1e9;
    let total = {
        let enough = format!("structure.memory_gb={:?}", matrices + factors + 0.005);
        let output = workshop.hammerbeam(&["modes", "study.toml", "--set", &enough]);
        // Once the number of modes is known, its vectors count.
        assert_eq!(output.status.code(), Some(2));
        let message = stderr(&output);
        let text = message.split_once("take up to ").unwrap().1;
        text.split_once(" GB").unwrap().0.parse::<f64>().unwrap()
    };
    assert!(total > matrices + factors);
    assert!((matrices + factors..PROGRAM + total).contains(&peak), "{peak} {message} {total}");
}
