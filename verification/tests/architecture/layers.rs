//! Crates depend on lower ones only.

use std::collections::BTreeMap;

use super::{crate_folders, read};

/// All crates by their folders, the lowest first: each may depend on those before it.
const LAYERS: &[&str] = &[
    "structure",
    "matrices",
    "fit",
    "signal",
    "motion",
    "path",
    "orbit",
    "attractor",
    "study",
    "results",
    "figure",
    "jobs",
    "drawing",
    "hammerbeam",
    "cli",
    "testkit",
    "verification",
];

/// Crates that must not know others though these are lower, for the reason of the table in `ARCHITECTURE.md`.
const STRANGERS: &[(&str, &[&str])] = &[
    ("fit", &["structure"]),
    ("signal", &["structure", "matrices"]),
    ("motion", &["fit", "signal"]),
    ("path", &["structure", "fit", "signal", "motion"]),
    ("orbit", &["fit", "signal"]),
    ("attractor", &["fit", "signal"]),
    ("figure", &["structure", "motion", "path", "orbit", "attractor"]),
];

/// Names of the crates of the project that a crate is built of, with its own name first.
fn dependencies(manifest: &str) -> (String, Vec<String>) {
    let (mut section, mut name, mut found) = ("", String::new(), Vec::new());
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            section = line;
        }
        let key = line.split(['.', ' ', '=']).next().unwrap_or("");
        let is_dependency = section.ends_with("dependencies]") && !section.contains("dev-dependencies");
        if section == "[package]" && key == "name" {
            name = line.split('"').nth(1).unwrap_or("").to_owned();
        } else if is_dependency && key.starts_with("hammerbeam") {
            found.push(key.to_owned());
        }
    }
    (name, found)
}

#[test]
fn crates_depend_on_lower_ones_only() {
    let folder_name = |folder: &str| folder.rsplit('/').next().unwrap_or(folder).to_owned();
    let crates: Vec<(String, (String, Vec<String>))> = crate_folders()
        .iter()
        .map(|folder| (folder_name(folder), dependencies(&read(&format!("{folder}/Cargo.toml")))))
        .collect();
    let folders: BTreeMap<&str, &str> =
        crates.iter().map(|(folder, (name, _))| (name.as_str(), folder.as_str())).collect();
    let layer = |folder: &str| {
        let found = LAYERS.iter().position(|other| *other == folder);
        found.unwrap_or_else(|| panic!("{folder} is not in the list of layers: add a line"))
    };
    for (folder, (_, needed)) in &crates {
        for other in needed.iter().map(|name| folders[name.as_str()]) {
            assert!(layer(other) < layer(folder), "{folder} depends on {other}, which is not below it");
            let strangers = STRANGERS.iter().find(|(name, _)| name == folder);
            let is_stranger = strangers.is_some_and(|(_, others)| others.contains(&other));
            assert!(!is_stranger, "{folder} depends on {other}, which it must not know");
        }
    }
}

#[test]
fn dependencies_are_read_but_those_of_tests() {
    let manifest = "[package]\nname = \"hammerbeam-a\"\n[dependencies]\nhammerbeam-b.workspace = true\n\
        serde = \"1\"\n\
        [dev-dependencies]\nhammerbeam-c.workspace = true\n\
        [target.'cfg(unix)'.dependencies]\nhammerbeam-d = { path = \"d\" }";
    let (name, found) = dependencies(manifest);
    assert_eq!(name, "hammerbeam-a");
    assert_eq!(found, ["hammerbeam-b", "hammerbeam-d"]);
}
