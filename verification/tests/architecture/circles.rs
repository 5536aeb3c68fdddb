//! No circle of modules: what a file needs does not need it.

use std::collections::{BTreeMap, BTreeSet};

use super::{assert_only_exempted, crate_folders, exemptions::CIRCLES, folder_of, modules::Modules};

type Needs<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// Files that can be reached from each file.
fn reached<'a>(needs: &Needs<'a>) -> Needs<'a> {
    let from = |file: &'a str| {
        let mut seen = BTreeSet::new();
        let mut left: Vec<&str> = needs[file].iter().copied().collect();
        while let Some(next) = left.pop() {
            if seen.insert(next) {
                left.extend(&needs[next]);
            }
        }
        seen
    };
    needs.keys().map(|file| (*file, from(file))).collect()
}

/// Largest sets of files each of which needs all the others, by way of others.
fn circles<'a>(needs: &Needs<'a>) -> BTreeSet<Vec<&'a str>> {
    let reached = reached(needs);
    let circle = |file: &&'a str| -> Vec<&'a str> {
        reached[file].iter().copied().filter(|other| reached[other].contains(file)).collect()
    };
    needs.keys().map(circle).filter(|circle| circle.len() > 1).collect()
}

#[test]
fn no_modules_of_a_crate_need_one_another() {
    let crates: Vec<(String, Modules)> =
        crate_folders().into_iter().map(|folder| (folder.clone(), Modules::read(&folder))).collect();
    let folders: Vec<&str> = CIRCLES.iter().map(|(folder, ..)| *folder).collect();
    let mut found: BTreeMap<&str, usize> = BTreeMap::new();
    let mut shown = Vec::new();
    for (folder, modules) in &crates {
        for circle in circles(&modules.needs()) {
            for file in &circle {
                let place = folder_of(file, &folders).unwrap_or(folder.as_str());
                *found.entry(place).or_default() += 1;
            }
            shown.push(format!("{} files:\n    {}", circle.len(), circle.join("\n    ")));
        }
    }
    let rule = format!("files in circles of modules\n  {}\n", shown.join("\n  "));
    assert_only_exempted(&rule, &found, CIRCLES);
}

#[test]
fn a_circle_over_three_files_is_seen_and_a_chain_is_none() {
    let needs = |pairs: &[(&'static str, &'static str)]| -> Needs<'static> {
        let mut needs: Needs<'static> = ["a", "b", "c", "d"].map(|file| (file, BTreeSet::new())).into();
        pairs.iter().for_each(|(file, other)| {
            needs.get_mut(file).unwrap().insert(other);
        });
        needs
    };
    let circle = circles(&needs(&[("a", "b"), ("b", "c"), ("c", "a"), ("c", "d")]));
    assert_eq!(circle, BTreeSet::from([vec!["a", "b", "c"]]));
    assert!(circles(&needs(&[("a", "b"), ("a", "c"), ("b", "c"), ("c", "d")])).is_empty());
}
