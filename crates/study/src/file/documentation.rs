//! The documentation says what the readers do: every key stands in it, and every example of it is understood.

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
    for added in ["hertz", "linear", "two-sided", "cubic", "formula"].map(stop) {
        keys.extend(known_keys(&format!("{BEAM}\n{added}")));
    }
    for added in ["gravity", "force", "support-motion"].map(load) {
        keys.extend(known_keys(&format!("{BEAM}\n{added}")));
    }
    for table in ["continuation", "search", "figures"] {
        keys.extend(known_keys(&format!("{BEAM}\n[{table}]\nwrong_key = 1\n")));
    }
    for table in ["vary", "curve"] {
        keys.extend(known_keys(&format!("{BEAM}\n[[{table}]]\nwrong_key = 1\n")));
    }
    keys.extend(known_keys(&format!("{BEAM}\n[[figures.orbit]]\nwrong_key = 1\n")));
    keys.extend(known_keys(&BEAM.replace("height_m = 0.003 }", "height_m = 0.003, wrong_key = 1 }")));
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
