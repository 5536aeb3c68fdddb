//! A run of 100 000 solutions stays below 200 MB of memory and 200 MB of disk.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use crate::common::{BEAM, Workshop, extensive};

/// Solutions of the small run and of the one with `HAMMERBEAM_EXTENSIVE=1`.
const SOLUTIONS: [u64; 2] = [500, 100_000];

/// Largest memory of a process so far [bytes]; `None` when it has ended.
fn peak_memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
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
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(["run", "study.toml", "--out", "results"])
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
    let rows = workshop.csv("results").lines().count() as u64 - 1;
    let size = folder_size(&workshop, "results");
    assert!(rows >= solutions, "{rows} solutions");
    assert!(peak > 1_000_000 && peak < 200_000_000, "{peak} bytes of memory for {rows} solutions");
    assert!(size < 200_000_000 * rows / 100_000, "{size} bytes of results for {rows} solutions");
}
