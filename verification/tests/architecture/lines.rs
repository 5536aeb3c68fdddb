//! Lines of code and comment end by column 110.

use std::collections::BTreeMap;

use super::{assert_only_exempted, crate_folders, exemptions::LONG_LINES, files_below, folder_of, read};

/// Columns of a line.
const MOST_COLUMNS: usize = 110;

#[test]
fn lines_end_by_column_110() {
    let folders: Vec<&str> = LONG_LINES.iter().map(|(folder, ..)| *folder).collect();
    let crates = crate_folders();
    let mut found: BTreeMap<&str, usize> = BTreeMap::new();
    let mut shown = Vec::new();
    for folder in &crates {
        for file in [".rs", ".ts"].iter().flat_map(|ending| files_below(folder, ending)) {
            for (number, line) in read(&file).lines().enumerate() {
                if line.chars().count() > MOST_COLUMNS {
                    *found.entry(folder_of(&file, &folders).unwrap_or(folder)).or_default() += 1;
                    shown.push(format!("{file}:{}", number + 1));
                }
            }
        }
    }
    assert_only_exempted(&format!("lines beyond column 110\n  {}\n", shown.join("\n  ")), &found, LONG_LINES);
}
