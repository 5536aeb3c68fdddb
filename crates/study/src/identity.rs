//! What makes a study the same study: everything that its solutions depend on.
//!
//! Title, budgets and comments are not part of it; a default that is written out is the same as one that is
//! not.

use std::borrow::Cow;

use crate::file::{MatricesTable, MatrixPointEntry, Place, StructureTable, Study};

/// Version of the computed data: counted up when the same study gives other numbers, so that a results folder
/// is never continued with another program's numbers.
pub const DATA_VERSION: u32 = 23;

impl Study {
    /// Everything the solutions depend on, as text: one `path = value` line for each number and word.
    #[must_use]
    pub fn canonical(&self) -> String {
        let value =
            serde_json::to_value(self.without_idle_points()).expect("a study is plain data with text keys");
        let mut lines = Vec::new();
        flatten("", &value, &mut lines);
        lines.sort_unstable();
        lines.join("\n")
    }

    /// The study without the points of a structure of matrices at which nothing acts and nothing is observed
    /// but outputs: they change neither modes nor motions.
    fn without_idle_points(&self) -> Cow<'_, Self> {
        let StructureTable::Matrices(matrices) = &self.structure else { return Cow::Borrowed(self) };
        let mut used: Vec<&str> = self.force_points().chain([self.response.point.as_str()]).collect();
        for stop in &self.stops {
            match &stop.place {
                Place::At { point, .. } => used.push(point),
                Place::Around { first, second, .. } | Place::Between { first, second } => {
                    used.extend([first.as_str(), second]);
                }
            }
        }
        let is_used = |point: &MatrixPointEntry| used.contains(&point.name.as_str());
        if matrices.points.iter().all(is_used) {
            return Cow::Borrowed(self);
        }
        let points = matrices.points.iter().filter(|point| is_used(point)).cloned().collect();
        let structure = StructureTable::Matrices(MatricesTable { points, ..matrices.clone() });
        Cow::Owned(Self { structure, ..self.clone() })
    }

    /// 128-bit fingerprint of [`Study::canonical`], as 32 hexadecimal digits.
    #[must_use]
    pub fn identity(&self) -> String {
        format!("{:032x}", fnv1a(self.canonical().as_bytes()))
    }
}

fn flatten(path: &str, value: &serde_json::Value, lines: &mut Vec<String>) {
    use serde_json::Value::{Array, Object};
    match value {
        Object(entries) => {
            for (key, value) in entries {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                flatten(&path, value, lines);
            }
        }
        Array(elements) => {
            for (index, value) in elements.iter().enumerate() {
                flatten(&format!("{path}[{index}]"), value, lines);
            }
        }
        scalar => lines.push(format!("{path} = {scalar}")),
    }
}

/// FNV-1a with 128 bits.
///
/// # Source
/// Fowler, Noll, Vo, Eastlake, *The FNV non-cryptographic hash algorithm* (IETF draft).
fn fnv1a(bytes: &[u8]) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.iter().fold(OFFSET, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

/// What differs between two canonical texts: lines `path: value there, value here`, `limit` at most.
#[must_use]
pub fn differences(there: &str, here: &str, limit: usize) -> Vec<String> {
    let table = |text: &str| -> std::collections::BTreeMap<String, String> {
        text.lines()
            .filter_map(|line| line.split_once(" = "))
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect()
    };
    let (there, here) = (table(there), table(here));
    let keys: std::collections::BTreeSet<&String> = there.keys().chain(here.keys()).collect();
    let shown = |value: Option<&String>| value.map_or("nothing", String::as_str).to_owned();
    keys.into_iter()
        .filter(|key| there.get(*key) != here.get(*key))
        .map(|key| format!("{key}: {} there, {} here", shown(there.get(key)), shown(here.get(key))))
        .take(limit)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::StudyFile;

    const PAPER: &str = include_str!("../../../studies/beam-with-stop.toml");

    fn identity_with(old: &str, new: &str) -> String {
        assert!(PAPER.contains(old), "{old} is not in the study");
        StudyFile::parse("study.toml", PAPER.replacen(old, new, 1)).unwrap().study.identity()
    }

    fn identity() -> String {
        identity_with("title", "title")
    }

    #[test]
    fn hash_of_a_known_word_is_the_published_one() {
        assert_eq!(fnv1a(b""), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(fnv1a(b"foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }

    #[test]
    fn title_comments_budget_and_written_out_defaults_do_not_change_it() {
        assert_eq!(identity_with("title = \"Clamped", "# a remark\ntitle = \"Another"), identity());
        assert_eq!(
            identity_with("[response]", "[continuation]\nbudget_solutions = 7\n[response]"),
            identity()
        );
        assert_eq!(identity_with("low_pass_hz = 850.0", "low_pass_hz = 1000.0"), identity());
        assert_eq!(identity_with("gap_m = 0.0", ""), identity());
        assert_eq!(identity_with("2.1e11", "210e9"), identity());
    }

    #[test]
    fn what_the_solutions_depend_on_changes_it() {
        for (old, new) in [
            ("2.1e11", "2.1000000001e11"),
            ("\"below\"", "\"above\""),
            ("[1, 2, 3]", "[1, 2]"),
            ("[response]", "[continuation]\ntolerance = 1e-11\n[response]"),
        ] {
            assert_ne!(identity_with(old, new), identity(), "{old} -> {new}");
        }
    }

    #[test]
    fn differences_name_what_changed_with_both_values() {
        assert_eq!(
            differences("a = 1\nb = 2", "a = 1\nb = 3\nc = 4", 9),
            ["b: 2 there, 3 here", "c: nothing there, 4 here"]
        );
    }
}
