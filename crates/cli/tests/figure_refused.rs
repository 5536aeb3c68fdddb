//! What the command that draws says of folders that are not whole, are drawn into twice at once, or hold what
//! the font lacks.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{RUN, Workshop, assert_success, files, short_run, short_study, stderr, stdout};
use serde_json::Value;

/// Solutions whose multipliers are cut: what needs them is named with the solution, everything else is drawn.
#[test]
fn a_damaged_solution_costs_only_the_figures_that_need_it() {
    let workshop = short_run();
    let whole = files(&workshop, &["--out", "whole"]);
    let database = crate::common::database(workshop.path("results/results.db"));
    let of_branch =
        "UPDATE solution SET multipliers = x'00' WHERE id >> 33 = (SELECT id FROM start WHERE branch = 1)";
    assert!(database.execute(of_branch, []).unwrap() > 0);
    database.close().unwrap();
    let output = workshop.hammerbeam(&["figure", "results", "--out", "drawn", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let drawn = document["files"].as_array().unwrap();
    let missing: Vec<&String> = whole.iter().filter(|name| !drawn.contains(&name.as_str().into())).collect();
    assert!(missing.iter().all(|name| name.starts_with("multipliers-1")), "{missing:?}");
    assert!(!missing.is_empty());
    let sentence = "side of branch 1 is damaged: the stored multipliers has 1 bytes";
    for name in ["multipliers-1", "multipliers on the page"] {
        let is_named = stderr(&output).lines().any(|line| line.starts_with(name) && line.contains(sentence));
        assert!(is_named, "{name}: {}", stderr(&output));
    }
}

/// Rows of solutions that are gone: what needs them is named with their numbers, everything else is drawn.
#[test]
fn missing_solutions_are_named_and_cost_only_the_figures_that_need_them() {
    let workshop = short_run();
    let database = crate::common::database(workshop.path("results/results.db"));
    // Keys hold the start above bit 33, the side in bit 32, and the number on that side.
    let of =
        |side: u8| format!("id >> 33 = (SELECT id FROM start WHERE branch = 1) AND id >> 32 & 1 = {side}");
    let remove = |side: u8| {
        let between =
            format!("DELETE FROM solution WHERE {} AND (id & 4294967295) BETWEEN 3 AND 5", of(side));
        database.execute(&between, []).unwrap()
    };
    let side = if remove(0) == 3 { "up" } else { "down" };
    assert!(side == "up" || remove(1) == 3);
    database.close().unwrap();
    let output = workshop.hammerbeam(&["figure", "results", "--out", "drawn", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let drawn = document["files"].as_array().unwrap();
    assert!(
        ["structure.svg", "modes.svg", "excitation.svg"].iter().all(|name| drawn.contains(&(*name).into()))
    );
    let sentence = format!(
        "solutions 3 to 5 on the {side} side of branch 1 are missing from results.db; a run of the study"
    );
    for name in ["response", "page", "multipliers-1"] {
        let is_named = stderr(&output).lines().any(|line| line.starts_with(name) && line.contains(&sentence));
        assert!(is_named, "{name}: {}", stderr(&output));
    }
    let needing = ["response_displacement.svg", "page.html", "multipliers-1.svg"];
    assert!(!needing.iter().any(|name| drawn.contains(&(*name).into())), "{drawn:?}");
    let alone = workshop.hammerbeam(&["figure", "results", "--kind", "response", "--out", "alone"]);
    assert_eq!(alone.status.code(), Some(1), "there is nothing else to draw");
}

/// Two commands that draw into one folder at once both come to their end.
#[test]
fn one_folder_may_be_drawn_into_by_two_commands_at_once() {
    let workshop = short_run();
    let draw = || {
        std::process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(["figure", "results", "--out", "drawn"])
            .current_dir(workshop.path(""))
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap()
    };
    for child in [draw(), draw(), draw()] {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
    }
    let names = fs::read_dir(workshop.path("drawn")).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(names.into_iter().all(|name| !name.to_string_lossy().ends_with(".part")));
}

/// What the font lacks is reported, on the terminal and in the document.
#[test]
fn characters_that_the_font_lacks_are_told() {
    let workshop = Workshop::changed(&short_study(), "title = \"", "title = \"振動 Größe: ");
    assert_success(&workshop.hammerbeam(&RUN));
    let output =
        workshop.hammerbeam(&["figure", "results", "--kind", "structure", "--out", "drawn", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["characters_not_in_font"], serde_json::json!(["動", "振"]));
    assert!(
        stderr(&output).contains("lacks these characters, \u{fffd} stands for each: 動 振"),
        "{}",
        stderr(&output)
    );
}

/// Of a long branch not every solution is drawn. One that is not drawn and is damaged is reported as well.
#[test]
fn a_damaged_solution_between_those_that_are_drawn_is_told() {
    let workshop = Workshop::with(&short_study().replace("max_step_hz = 0.005", "max_step_hz = 0.0001"));
    assert_success(&workshop.hammerbeam(&RUN));
    let database = crate::common::database(workshop.path("results/results.db"));
    let one = |query: &str| database.query_row(query, [], |row| row.get::<_, i64>(0)).unwrap();
    // Keys hold the start above bit 33, the side in bit 32, and the number on that side; the down side comes
    // first, reversed.
    let of_branch = "id >> 33 = (SELECT id FROM start WHERE branch = 1)";
    let count =
        |side: u8| one(&format!("SELECT count(*) FROM solution WHERE {of_branch} AND id >> 32 & 1 = {side}"));
    let (down, up) = (count(1), count(0));
    assert!(down + up > 4000, "only {} solutions, of which every one is drawn", down + up);
    let (side, number) = if up > 10 { ("up", 2 + (down + 1) % 2) } else { ("down", 2 + down % 2) };
    let first = one(&format!(
        "SELECT min(id) FROM solution WHERE {of_branch} AND id >> 32 & 1 = {}",
        u8::from(side == "down")
    ));
    let damage = format!("UPDATE solution SET multipliers = x'00' WHERE id = {}", first + number);
    assert_eq!(database.execute(&damage, []).unwrap(), 1);
    database.close().unwrap();
    let output = workshop.hammerbeam(&["figure", "results", "--kind", "multipliers", "--out", "drawn"]);
    assert_eq!(output.status.code(), Some(1), "there is one branch");
    let sentence = format!("solution {number} on the {side} side of branch 1 is damaged");
    assert!(stderr(&output).contains(&sentence), "{sentence}: {}", stderr(&output));
}
