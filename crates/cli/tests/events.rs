//! The table of events, held against the table of solutions.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{fs, sync::LazyLock};

use crate::common::{Workshop, assert_success};

/// `x'' + 0.1 x' + x = cos W t` with 19 N/m more above zero: its harmonic branch flips, and branches of
/// doubled period join pairs of flips.
const BILINEAR: &str = r#"
title = "Bilinear oscillator"

[structure]
kind = "lumped"

[[structure.mass]]
name = "mass"
mass_kg = 1.0

[[structure.spring]]
between = ["mass", "ground"]
stiffness_n_m = 1.0

[[structure.damper]]
between = ["mass", "ground"]
damping_n_s_m = 0.1

[excitation]
kind = "force"
at = "mass"
amplitude_n = 1.0
frequency_hz = [0.12, 0.5]

[[stop]]
name = "second spring"
at = "mass"
law = "linear"
stiffness_n_m = 19.0
side = "above"

[search]
frequencies = 0

[continuation]
max_step_hz = 0.0005

[response]
period_multiples = [1, 2]
"#;

/// Its results, exported.
static RESULTS: LazyLock<Workshop> = LazyLock::new(|| {
    let workshop = Workshop::with(BILINEAR);
    assert_success(&workshop.compute(&[]));
    workshop.csv("results");
    workshop
});

/// The table of branches.
fn branches() -> String {
    fs::read_to_string(RESULTS.path("exported/branches.csv")).unwrap()
}

/// One event as both tables have it: branch, event without start and end, frequency.
fn of_solutions(csv: &str) -> Vec<(String, String, f64)> {
    let rows = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let named = |events: &str| {
        let kept: Vec<&str> =
            events.split('+').filter(|event| !["", "start", "end"].contains(event)).collect();
        kept.join("+")
    };
    rows.map(|row| (row[0].to_owned(), named(row[11]), row[2].parse().unwrap()))
        .filter(|(_, events, _)| !events.is_empty())
        .collect()
}

#[test]
fn every_event_of_a_solution_stands_in_the_table_of_events_with_what_is_known_of_it() {
    let expected = of_solutions(&branches());
    let text = fs::read_to_string(RESULTS.path("exported/events.csv")).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let place = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let number = |row: &[&str], name: &str| row[place(name)].parse::<f64>().unwrap();
    let reported: Vec<(String, String, f64)> = rows
        .iter()
        .map(|row| (row[0].to_owned(), row[place("event")].to_owned(), number(row, "frequency_hz")))
        .collect();
    assert_eq!(reported, expected);

    let roots: Vec<&Vec<&str>> =
        rows.iter().filter(|row| row[1] == "2" && row[place("event")].contains("branch-point")).collect();
    assert!(roots.len() >= 2, "a doubled branch begins at one flip and ends at another");
    for root in roots {
        assert_eq!(root[place("status")], "located");
        let off = (number(root, "multiplier_re") - 1.0).hypot(number(root, "multiplier_im"));
        assert!(off < 1e-4, "of two periods the critical multiplier is the square of -1, not off by {off}");
        assert_eq!(root[place("direction")].split(' ').count(), 3, "displacement, velocity, frequency");
        let frequency = number(root, "frequency_hz");
        let flips = rows.iter().filter(|row| row[1] == "1" && row[place("event")] == "flip");
        let nearest = flips.map(|row| (number(row, "frequency_hz") - frequency).abs()).fold(1.0, f64::min);
        assert!(nearest < 1e-8 * frequency, "no flip of period 1 at {frequency} Hz: {nearest} Hz off");
    }
}

/// With one stop, what a grazing says of its contact is how their number changes from one row to the next, on
/// both sides of where the branch began.
#[test]
fn contacts_appear_and_vanish_in_the_order_of_the_rows() {
    let branches = branches();
    let events = fs::read_to_string(RESULTS.path("exported/events.csv")).unwrap();
    let rows = |text: &str, names: &[&str]| -> Vec<Vec<String>> {
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let places: Vec<usize> =
            names.iter().map(|name| header.iter().position(|column| column == name).unwrap()).collect();
        lines.map(|row| places.iter().map(|place| row[*place].clone()).collect()).collect()
    };
    let solutions = rows(&branches, &["branch", "contacts"]);
    let mut seen = [0, 0];
    for event in rows(&events, &["branch", "row", "event", "contact_change"]) {
        if event[2] != "grazing" {
            continue;
        }
        let contacts: Vec<i32> =
            solutions.iter().filter(|row| row[0] == event[0]).map(|row| row[1].parse().unwrap()).collect();
        let row: usize = event[1].parse().unwrap();
        let change = contacts[row + 1] - contacts[row - 1];
        assert_eq!(event[3], format!("{change:+}"), "branch {}, row {row}", event[0]);
        seen[usize::from(change > 0)] += 1;
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
}

/// The motion from the state at an end of a branch comes back to it after its periods.
#[test]
fn the_states_at_ends_of_branches_repeat() {
    let workshop = &*RESULTS;
    let text = fs::read_to_string(workshop.path("exported/ends.csv")).unwrap();
    let mut repeated = 0;
    for line in text.lines().skip(1) {
        // The message may have commas, what stands before and behind it has none.
        let (fields, (rest, state)) = (line.split(',').collect::<Vec<_>>(), line.rsplit_once(',').unwrap());
        let (multiple, frequency, phase) = (fields[1], fields[4], rest.rsplit_once(',').unwrap().1);
        assert!(["range-end", "closed", "shorter-period", "crossing"].contains(&fields[3]), "{line}");
        assert_eq!(phase, "0.0");
        let initial = format!("--initial={state}");
        let periods = format!("--transient-periods={multiple}");
        let at = format!("--frequency={frequency}");
        let run = workshop.hammerbeam(&[
            "simulate",
            "study.toml",
            &at,
            &initial,
            &periods,
            "--periods=1",
            "--out=motion",
        ]);
        assert_success(&run);
        let sections = fs::read_to_string(workshop.path("motion/stroboscopic.csv")).unwrap();
        let section: Vec<f64> =
            sections.lines().nth(1).unwrap().split(',').map(|entry| entry.parse().unwrap()).collect();
        let expected: Vec<f64> = state.split(' ').map(|entry| entry.parse().unwrap()).collect();
        let size = expected.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        let came_back = &section[section.len() - expected.len()..];
        let off = came_back.iter().zip(&expected).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs()));
        assert!(off < 1e-6 * size, "{line}: off by {off}");
        repeated += 1;
    }
    assert!(repeated >= 4, "{text}");
}
