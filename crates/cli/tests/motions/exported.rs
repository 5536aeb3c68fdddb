//! Exports of requests: the tables that the commands wrote, under the numbers of the requests.

use std::fs;

use super::{DUFFING, column, table};
use crate::common::{Workshop, assert_success, stdout};

/// Commands in one folder, in the order of their numbers, with the tables of each.
const REQUESTS: [(&[&str], &[&str]); 5] = [
    (&["sweep", "study.toml", "--step", "0.05", "--down"], &["sweep", "sweep_samples"]),
    (
        &["lyapunov", "study.toml", "--frequency", "0.1", "--to", "0.2", "--step", "0.1", "--periods", "40"],
        &["spectra", "exponents", "convergence", "section"],
    ),
    (
        &["sweep", "study.toml", "--from", "0.25", "--to", "0.25", "--starts", "3"],
        &["sweep", "sweep_samples"],
    ),
    (
        &["basins", "study.toml", "--frequency", "0.25", "--x", "q1=-2..2", "--y", "v1=-3..3", "--grid", "3"],
        &["basins", "attractors"],
    ),
    (
        &["simulate", "study.toml", "--frequency", "0.25", "--periods", "3", "--transient-periods", "2"],
        &["samples", "contacts", "stroboscopic"],
    ),
];

/// Each with the bytes that its command wrote, and no table besides; all are named in the document of the
/// export.
#[test]
fn every_table_of_every_request_is_exported_as_its_command_wrote_it() {
    let workshop = Workshop::with(DUFFING);
    let mut written = Vec::new();
    for (number, (command, tables)) in (1..).zip(REQUESTS) {
        assert_success(&workshop.hammerbeam(&[command, &["--out", "out"]].concat()));
        for name in tables {
            let bytes = fs::read(workshop.path(&format!("out/{name}.csv"))).unwrap();
            written.push((format!("{name}-{number}.csv"), bytes));
        }
    }
    let output = workshop.hammerbeam(&["export", "out", "--format", "csv", "--json"]);
    assert_success(&output);
    for (name, bytes) in &written {
        let exported = fs::read(workshop.path(&format!("out/export/{name}"))).unwrap();
        assert!(exported == *bytes, "{name}");
        assert!(stdout(&output).contains(&format!("/{name}\"")), "{name} is not named: {}", stdout(&output));
    }
    let mut expected: Vec<String> = written.into_iter().map(|(name, _)| name).collect();
    expected.extend(["branches.csv", "events.csv", "ends.csv"].map(str::to_owned));
    expected.sort();
    let mut found: Vec<String> = fs::read_dir(workshop.path("out/export"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    assert_eq!(found, expected);
    tables_have_what_was_asked(&workshop);
}

/// Frequencies, numbers of rows and fractions that follow from the commands alone.
fn tables_have_what_was_asked(workshop: &Workshop) {
    let of = |name: &str| table(workshop, &format!("out/export/{name}.csv"));
    // 0.08 to 0.5 Hz in steps of 0.05 Hz, the end besides, and back.
    let sweep = of("sweep-1");
    assert_eq!(column(&sweep, "frequency_hz").len(), 20);
    // Two exponents at each of two frequencies: damping 0.1, which is their sum.
    let exponents = of("exponents-2");
    assert_eq!(column(&exponents, "number"), [1.0, 2.0, 1.0, 2.0]);
    for pair in column(&exponents, "exponent_per_s").chunks(2) {
        assert!((pair[0] + pair[1] + 0.1).abs() < 1e-6, "{pair:?}");
    }
    // One sample of each motion of one period.
    assert_eq!(
        column(&of("sweep_samples-3"), "displacement_m").len(),
        column(&of("sweep-3"), "frequency_hz").len()
    );
    // 100 samples in each of three periods of a mass that touches nothing.
    let rows = ["samples-5", "contacts-5", "stroboscopic-5"].map(|name| of(name).len() - 1);
    assert_eq!(rows, [300, 0, 3]);
    // The fractions are counts among the nine cells.
    let cells = column(&of("basins-4"), "attractor");
    let attractors = of("attractors-4");
    assert_eq!(cells.len(), 9);
    for (number, fraction) in
        column(&attractors, "attractor").into_iter().zip(column(&attractors, "fraction"))
    {
        let count = cells.iter().filter(|&&cell| cell == number).count();
        assert!((fraction - count as f64 / 9.0).abs() < 1e-15 && count > 0, "{number}: {fraction}");
    }
}

/// A command that knows the branches names them in its tables; the export has the same without them.
#[test]
fn exports_are_the_tables_without_the_numbers_of_branches() {
    let study = DUFFING.replace("frequency_hz = [0.08, 0.5]", "frequency_hz = [0.4, 0.42]");
    let workshop = Workshop::with(&format!("{study}\n[continuation]\nmax_step_hz = 0.01\n"));
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "out", "--no-figures"]));
    let basins = ["basins", "study.toml", "--frequency", "0.41", "--x", "q1=0..1", "--y", "v1=0..1"];
    for command in [&["sweep", "study.toml", "--step", "0.01"][..], &[&basins[..], &["--grid", "2"]].concat()]
    {
        assert_success(&workshop.hammerbeam(&[command, &["--out", "out"]].concat()));
    }
    assert_success(&workshop.hammerbeam(&["export", "out", "--format", "csv"]));
    for (written, exported) in [("sweep", "sweep-1"), ("attractors", "attractors-2")] {
        let mut written = table(&workshop, &format!("out/{written}.csv"));
        let exported = table(&workshop, &format!("out/export/{exported}.csv"));
        let branch = written[0].iter().position(|name| name == "branch").unwrap();
        assert!(written.len() > 1 && written[1..].iter().all(|row| row[branch] == "1"), "{written:?}");
        written[1..].iter_mut().for_each(|row| row[branch].clear());
        assert_eq!(written, exported);
    }
}
