//! `run --from RESULTS:POINT`: branches of a study with changed parameters begin at a special point of
//! another folder.

use serde_json::Value;

use crate::common::{Row, Workshop, assert_bad_input, assert_success, number, stdout};

/// The impact oscillator where it has a closed branch, from 0.086 to 0.096 Hz, that no slow sweep reaches.
fn study() -> String {
    let study = include_str!("../../../studies/impact-oscillator.toml");
    study.replace("[0.08, 0.5]", "[0.085, 0.1]")
}

/// A search that does not find the closed branch.
const LITTLE: &str = "\n[search]\nfrequencies = 1\nstarts = 1\nsettling_periods = 8\ntrials = 0\n";

/// Number of the first flip among the special points: they are the rows of `events.csv`.
fn first_flip(workshop: &Workshop) -> usize {
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv", "--out", "tables"]));
    let table = std::fs::read_to_string(workshop.path("tables/events.csv")).unwrap();
    let event = |line: &str| line.split(',').nth(3).unwrap().to_owned();
    1 + table.lines().skip(1).position(|line| event(line).contains("flip")).unwrap()
}

fn branches(workshop: &Workshop, more: &[&str], out: &str) -> Vec<Value> {
    let output = workshop.hammerbeam(&[&["run", "changed.toml", "--json", "--out", out][..], more].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    document["branches"].as_array().unwrap().clone()
}

/// A ball that is a little softer at its impacts has the closed branch as well, a little elsewhere.
#[test]
fn a_run_with_a_changed_parameter_begins_at_a_special_point_of_another_run() {
    let workshop = Workshop::with(&study());
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let changed = study().replace("restitution = 0.8", "restitution = 0.795") + LITTLE;
    std::fs::write(workshop.path("changed.toml"), changed).unwrap();
    assert_eq!(branches(&workshop, &[], "without").len(), 1, "the search alone does not find it");
    let origin = format!("results:{}", first_flip(&workshop));
    let found = branches(&workshop, &["--from", &origin], "with");
    assert_eq!(found.len(), 2, "{found:?}");
    let missing = workshop.hammerbeam(&["run", "changed.toml", "--from", "results:1000", "--out", "other"]);
    assert_bad_input(&missing, &["results has no special point 1000", "numbered from 1"]);
    // Another range, which does not hold the point.
    std::fs::write(workshop.path("changed.toml"), study().replace("[0.085, 0.1]", "[0.2, 0.21]") + LITTLE)
        .unwrap();
    let away = workshop.hammerbeam(&["run", "changed.toml", "--from", &origin, "--out", "away"]);
    let said = format!("special point {} of results lies at 0.0", first_flip(&workshop));
    assert_bad_input(&away, &[&said, "outside the range of this study, 0.2 Hz to 0.21 Hz"]);
    assert!(!workshop.path("away").exists(), "it is refused before anything is searched");
}

/// The Duffing oscillator whose symmetric orbits lose their symmetry between two branch points: orbits
/// without it make a loop through both, which starts at one of them.
const LOOP: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "mass", mass_kg = 1.0 }]
damper = [{ between = ["mass", "ground"], damping_n_s_m = 0.1 }]
spring = [{ between = ["mass", "ground"], stiffness_n_m = 1.0 }]
[excitation]
kind = "force"
at = "mass"
amplitude_n = 3.0
frequency_hz = [0.13, 0.18]
[[stop]]
at = "mass"
law = "cubic"
stiffness_n_m3 = 1.0
[search]
frequencies = 0
[continuation]
max_step_hz = 5.0e-4
"#;

/// Both branches go through the same two points, and so does each count.
#[test]
fn a_closed_branch_has_the_branch_point_at_which_it_starts_once() {
    let workshop = Workshop::exported(LOOP);
    let ends = workshop.table("results/export/ends.csv");
    assert!(ends.iter().any(|end| end["branch"] == "2" && end["end"] == "closed"), "{ends:?}");
    for table in ["events", "branches"] {
        let rows = workshop.table(&format!("results/export/{table}.csv"));
        let is_point = |row: &&Row| row["event"].split('+').any(|event| event == "branch-point");
        let mut places: Vec<(&str, f64)> = rows
            .iter()
            .filter(is_point)
            .map(|row| (row["branch"].as_str(), number(row, "frequency_hz")))
            .collect();
        places.sort_by(|one, other| one.0.cmp(other.0).then(one.1.total_cmp(&other.1)));
        let [[first, second], [start, far]] = [[places[0], places[1]], [places[2], places[3]]];
        assert_eq!(places.len(), 4, "{table}: {places:?}");
        assert!((first.1 - start.1).abs() < 1e-9 && (second.1 - far.1).abs() < 1e-9, "{places:?}");
    }
}
