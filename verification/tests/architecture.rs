//! The house of `ARCHITECTURE.md`, held by reading the sources: what a reader minds and a compiler does not.
//!
//! | rule | where |
//! |---|---|
//! | crates depend on lower ones only | `layers.rs` |
//! | no circle of modules within a crate | `circles.rs` |
//! | no type with `impl` blocks in more than four files | `doors.rs` |
//! | names of public types are unique in the project | `names.rs` |
//! | lines end by column 110 | `lines.rs` |
//! | no crate that computes reads a clock | `clocks.rs` |
//!
//! What breaks a rule today is listed in `exemptions.rs`, with a reason. The list only shrinks: an exemption
//! that allows more than there is fails the test too, and the message says what to write instead.

mod circles;
mod clocks;
mod doors;
mod exemptions;
mod items;
mod layers;
mod lines;
mod modules;
mod names;
mod tokens;

use std::{
    collections::BTreeMap,
    fmt::Debug,
    fs,
    path::{Path, PathBuf},
};

/// The folder of the whole project.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap()
}

/// Folders of all crates, relative to the root, in the order of their names.
fn crate_folders() -> Vec<String> {
    let mut folders: Vec<String> = fs::read_dir(root().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.path().join("Cargo.toml").exists())
        .map(|entry| format!("crates/{}", entry.file_name().to_str().unwrap()))
        .collect();
    folders.push("verification".to_owned());
    folders.sort();
    folders
}

/// Files below a folder whose names end like this, relative to the root, in order; none that were built or
/// installed.
fn files_below(folder: &str, ending: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut left = vec![folder.to_owned()];
    while let Some(folder) = left.pop() {
        for entry in fs::read_dir(root().join(&folder)).unwrap().map(|entry| entry.unwrap()) {
            let name = entry.file_name().into_string().unwrap();
            let path = format!("{folder}/{name}");
            if entry.file_type().unwrap().is_dir() {
                if !["target", "node_modules", "dist"].contains(&name.as_str()) {
                    left.push(path);
                }
            } else if name.ends_with(ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Fails unless what breaks a rule is what its exemptions allow, neither more nor less.
///
/// * `found`: each offender with its count.
/// * `allowed`: the same, as the list of exemptions has it; the last is the reason.
fn assert_only_exempted<K: Ord + Debug + Copy>(
    rule: &str,
    found: &BTreeMap<K, usize>,
    allowed: &[(K, usize, &str)],
) {
    let mut faults = Vec::new();
    for (offender, count) in found {
        match allowed.iter().find(|(name, ..)| name == offender) {
            None => faults.push(format!("{offender:?}: {count}, none is exempted")),
            Some((_, most, _)) if count > most => {
                faults.push(format!("{offender:?}: {count}, exempted are {most}"));
            }
            Some((_, most, _)) if count < most => {
                faults.push(format!("{offender:?}: lower its exemption from {most} to {count}"));
            }
            Some(_) => {}
        }
    }
    for (offender, _, reason) in allowed {
        assert!(!reason.is_empty(), "{offender:?} is exempted without a reason");
        if !found.contains_key(offender) {
            faults.push(format!("{offender:?}: remove its exemption"));
        }
    }
    assert!(faults.is_empty(), "{rule}:\n  {}", faults.join("\n  "));
}

/// The folder of the list that a file lies in: the longest that fits.
fn folder_of(path: &str, folders: &[&'static str]) -> Option<&'static str> {
    let fitting = folders.iter().filter(|folder| {
        path.strip_prefix(**folder).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    });
    fitting.max_by_key(|folder| folder.len()).copied()
}
