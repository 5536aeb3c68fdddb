//! The documentation says what the readers do: every law stands in it, and every example of it is understood.
//! Its tables of keys are written by the program, see `keys.rs`.

use hammerbeam_motion::law::{DESCRIPTIONS, LawDescription, LawKey, LawSides};

use super::StudyFile;
use crate::Model;

const PAGE: &str = include_str!("../../../../docs/reference/study-file.md");

/// The TOML examples of the page.
fn examples() -> Vec<&'static str> {
    PAGE.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

#[test]
fn complete_examples_are_understood_and_partial_ones_are_toml() {
    let mut complete = 0;
    for example in examples() {
        if example.contains("[structure]") && example.contains("[excitation]") {
            let file =
                StudyFile::parse("example", example.to_owned()).unwrap_or_else(|error| panic!("{error}"));
            Model::build(&file).unwrap_or_else(|error| panic!("{error}"));
            complete += 1;
        } else {
            toml::de::DeTable::parse(example).unwrap();
        }
    }
    assert_eq!(complete, 4);
}

/// Cells of the rows of a table of the page whose first cell has this text.
fn rows_with(first: &str) -> Vec<Vec<&'static str>> {
    let cells = |line: &'static str| line.trim_matches('|').split(" | ").map(str::trim).collect::<Vec<_>>();
    let rows = PAGE.lines().filter(|line| line.starts_with("| ")).map(cells);
    rows.filter(|row| row[0].split(", ").any(|name| name.split(" of ").next() == Some(first))).collect()
}

/// The table of laws against the list of laws: the formula of the force, on which sides it acts, every key.
#[test]
fn every_law_has_its_row() {
    for described in DESCRIPTIONS {
        let rows = rows_with(&format!("`\"{}\"`", described.name));
        // The other law of one word stands in its row by its key, with the force of those below.
        let other = described.alternative.filter(|alternative| !alternative.is_default);
        let is_row = |row: &&Vec<&str>| match other {
            Some(alternative) => row[2].contains(&format!("or `{}`", alternative.own)),
            None => row[1].contains(described.force),
        };
        let Some(row) = rows.iter().find(is_row) else {
            panic!("{} has no row with its force, {}", described.name, described.force)
        };
        // One that says "as `\"hertz\"`" has the keys of that row.
        let keys = if row[2].contains("as `\"hertz\"`") {
            format!("{}; {}", row[2], rows_with("`\"hertz\"`")[0][2])
        } else {
            row[2].to_owned()
        };
        for key in described.keys {
            assert!(keys.contains(&format!("`{}`", key.name)), "{}: {} in {keys}", described.name, key.name);
        }
        let (words, rests) = match described.sides {
            LawSides::One { no_preload: None, .. } => ("one-sided", vec!["`side`", "gap or preload"]),
            LawSides::One { no_preload: Some(_), .. } => ("", vec!["`side`", "gap"]),
            LawSides::Two { .. } => ("on either side", vec!["`gap_m`", "`gap_above_m`", "`gap_measured`"]),
            LawSides::Always { .. } => ("always acting", Vec::new()),
        };
        assert!(row[1].contains(words), "{}: {}", described.name, row[1]);
        for rest in rests {
            assert!(keys.contains(rest), "{}: {rest} in {keys}", described.name);
        }
    }
}

/// The table of keys against the ranges that the laws ask for.
#[test]
fn every_key_of_a_law_has_its_range() {
    let ranges = |key: &'static LawKey, described: &LawDescription| {
        let quantity = key.quantity()?;
        let allowed = quantity.allowed().replacen("more than 0 to", "more than 0, to", 1);
        Some((key.name, allowed, described.name))
    };
    for described in DESCRIPTIONS {
        for (key, allowed, law) in described.keys.iter().filter_map(|key| ranges(key, described)) {
            let rows = rows_with(&format!("`{key}`"));
            assert!(
                rows.iter().any(|row| row[1].contains(&allowed)),
                "{law}: {key} is {allowed}, not as in {rows:?}"
            );
        }
    }
}
