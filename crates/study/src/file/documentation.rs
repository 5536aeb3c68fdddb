//! The documentation says what the readers do: every key stands in it, and every example of it is understood.

use hammerbeam_motion::law::{DESCRIPTIONS, LawDescription, LawKey, LawSides};

use super::{StudyError, StudyFile};
use crate::Model;

const PAGE: &str = include_str!("../../../../docs/reference/study-file.md");
const BEAM: &str = include_str!("../../../../studies/beam-between-stops.toml");
const LUMPED: &str = include_str!("../../../../studies/two-masses.toml");

/// The TOML examples of the page.
fn examples() -> Vec<&'static str> {
    PAGE.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// Keys that a reader names as known when it meets an unknown one.
fn known_keys(study: &str) -> Vec<String> {
    let Err(StudyError::Invalid(report)) = StudyFile::parse("study.toml", study.to_owned()) else {
        panic!("the unknown key was accepted in\n{study}");
    };
    let help = report.problems.iter().flat_map(|problem| &problem.help);
    let lists = help.filter_map(|help| help.strip_prefix("known keys: "));
    lists.flat_map(|list| list.split(", ").map(str::to_owned)).collect()
}

#[test]
fn every_key_is_documented() {
    let stop = |law: &str| format!("[[stop]]\nat = \"tip\"\nlaw = \"{law}\"\nwrong_key = 1\n");
    let load = |kind: &str| format!("[[load]]\nkind = \"{kind}\"\nwrong_key = 1\n");
    let mut keys = known_keys(&format!("wrong_key = 1\n{BEAM}"));
    for study in [BEAM, LUMPED] {
        for table in study.lines().filter(|line| line.starts_with('[')) {
            keys.extend(known_keys(&study.replacen(table, &format!("{table}\nwrong_key = 1"), 1)));
        }
    }
    for added in DESCRIPTIONS.map(|described| stop(described.name)) {
        keys.extend(known_keys(&format!("{BEAM}\n{added}")));
    }
    for added in ["gravity", "force", "support-motion"].map(load) {
        keys.extend(known_keys(&format!("{BEAM}\n{added}")));
    }
    let force = "kind = \"force\"\nforce = [{ at = \"tip\", amplitude_n = 1.0, wrong_key = 1 }]\n";
    let shaken = "kind = \"support-motion\"\nat = \"left\"\namplitude_m = 0.2e-3\n";
    assert!(BEAM.contains(shaken));
    keys.extend(known_keys(&BEAM.replace(shaken, force)));
    for table in ["continuation", "search", "figures"] {
        keys.extend(known_keys(&format!("{BEAM}\n[{table}]\nwrong_key = 1\n")));
    }
    for table in ["vary", "curve", "output"] {
        keys.extend(known_keys(&format!("{BEAM}\n[[{table}]]\nwrong_key = 1\n")));
    }
    keys.extend(known_keys(&format!("{BEAM}\n[[figures.orbit]]\nwrong_key = 1\n")));
    keys.extend(known_keys(&BEAM.replace("height_m = 0.003 }", "height_m = 0.003, wrong_key = 1 }")));
    let span = "[[structure.span]]\nlength_m = 0.5\nwrong_key = 1\n\n[[structure.point]]";
    let spans =
        BEAM.replace("length_m = 0.5\n", "theory = \"timoshenko\"\n").replace("[[structure.point]]", span);
    let tube = "{ outer_diameter_m = 0.02, wrong_key = 1 }";
    keys.extend(known_keys(&spans.replace("{ width_m = 0.02, height_m = 0.003 }", tube)));
    assert!(keys.len() > 80, "{}", keys.len());
    for key in keys {
        assert!(
            PAGE.contains(&format!("`{key}`"))
                || PAGE.contains(&format!("{key}, "))
                || PAGE.contains(&format!("{key} }}")),
            "`{key}` is not documented"
        );
    }
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
