//! The table of events, held against the table of solutions.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use std::fs;

use common::{Workshop, assert_success};

/// `x'' + 0.1 x' + x = cos W t` with 19 N/m more above zero: its harmonic branch flips, and branches of doubled period join pairs of flips.
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

[response]
period_multiples = [1, 2]
"#;

/// One event as both tables tell it: branch, event without start and end, frequency.
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
    let workshop = Workshop::with(BILINEAR);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let expected = of_solutions(&workshop.csv("results"));
    let text = fs::read_to_string(workshop.path("exported/events.csv")).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let place = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let number = |row: &[&str], name: &str| row[place(name)].parse::<f64>().unwrap();
    let told: Vec<(String, String, f64)> = rows
        .iter()
        .map(|row| (row[0].to_owned(), row[place("event")].to_owned(), number(row, "frequency_hz")))
        .collect();
    assert_eq!(told, expected);

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
