//! One name, one type: a reader who searches for a public type finds one.

use std::collections::BTreeMap;

use super::{assert_only_exempted, crate_folders, exemptions::NAMES, modules::Modules};

#[test]
fn names_of_public_types_are_unique_in_the_project() {
    let mut files: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for folder in crate_folders() {
        for (file, items) in Modules::read(&folder).files() {
            for declared in items.declared.iter().filter(|declared| declared.is_type && declared.is_public) {
                files.entry(declared.name.clone()).or_default().push(file.clone());
            }
        }
    }
    files.retain(|_, files| files.len() > 1);
    let shown: Vec<String> =
        files.iter().map(|(name, files)| format!("{name}: {}", files.join(", "))).collect();
    let found = files.iter().map(|(name, files)| (name.as_str(), files.len())).collect();
    let rule = format!("public types of one name\n  {}\n", shown.join("\n  "));
    assert_only_exempted(&rule, &found, NAMES);
}
