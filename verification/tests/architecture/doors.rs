//! No room with many doors: a type whose methods lie in many files is owned by none of them.

use std::collections::{BTreeMap, BTreeSet};

use super::{assert_only_exempted, crate_folders, exemptions::DOORS, modules::Modules};

/// Files with `impl` blocks of one type.
const MOST_FILES: usize = 4;

#[test]
fn no_type_has_impl_blocks_in_more_than_four_files() {
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for folder in crate_folders() {
        let modules = Modules::read(&folder);
        let mut files: BTreeMap<(String, String), BTreeSet<&str>> = BTreeMap::new();
        for (file, items) in modules.files() {
            for path in &items.implemented {
                let Some(declaring) = modules.declares(file, path) else { continue };
                let name = path.last().expect("a path has a name").clone();
                files.entry((declaring.to_owned(), name)).or_default().insert(file);
            }
        }
        let many = files.into_iter().filter(|(_, files)| files.len() > MOST_FILES);
        found.extend(many.map(|((file, name), files)| (format!("{file} {name}"), files.len())));
    }
    let found = found.iter().map(|(name, count)| (name.as_str(), *count)).collect();
    assert_only_exempted("files with impl blocks of a type", &found, DOORS);
}
