//! "Did you mean": the candidate closest to a word that is not known.

/// Words that others use, and ours for them.
const SYNONYMS: [(&str, &str); 17] = [
    ("fixed", "clamped"),
    ("built-in", "clamped"),
    ("encastre", "clamped"),
    ("hinged", "pinned"),
    ("simply-supported", "pinned"),
    ("guided", "sliding"),
    ("craig-bampton", "fixed-interface"),
    ("rubin", "free-interface"),
    ("macneal", "free-interface"),
    ("spring", "linear"),
    ("elastic", "linear"),
    ("impact", "rigid"),
    ("upper", "above"),
    ("lower", "below"),
    ("ground", "space"),
    ("base-motion", "support-motion"),
    ("displacement", "support-motion"),
];

/// The candidate that `word` was probably meant to be.
///
/// In this order: the one that differs by few edits, ours for a word that others use, and a key that has the
/// word for its stem (`density` or `density_g_cm3` for `density_kg_m3`) or its end (`ratio` for
/// `modal_ratio`).
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // No key is nearly as long, and each edit of a long word is looked for.
    if word.len() > 200 {
        return None;
    }
    let candidates: Vec<&str> = candidates.into_iter().collect();
    by_edits(word, &candidates)
        .or_else(|| by_meaning(word, &candidates))
        .or_else(|| by_stem(word, &candidates))
}

fn by_edits<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    candidates
        .iter()
        .map(|candidate| (edit_distance(word, candidate), *candidate))
        .filter(|(distance, candidate)| *distance <= candidate.chars().count().max(3) / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

fn by_meaning<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let ours = |theirs: &str| SYNONYMS.iter().find(|(other, _)| *other == theirs).map(|(_, ours)| *ours);
    let meant = ours(&word.to_lowercase().replace([' ', '_'], "-"))?;
    candidates.iter().copied().find(|candidate| *candidate == meant)
}

/// Parts of keys stand between underscores, the unit last: the longest stem of the word that a key has as
/// well.
fn by_stem<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let has_stem = |key: &str, stem: &str| key.strip_prefix(stem).is_some_and(|rest| rest.starts_with('_'));
    let has_end = |key: &str| key.strip_suffix(word).is_some_and(|rest| rest.ends_with('_'));
    let mut stem = word;
    while !stem.is_empty() {
        if let Some(found) = candidates.iter().find(|key| has_stem(key, stem)) {
            return Some(found);
        }
        stem = stem.rfind('_').map_or("", |end| &stem[..end]);
    }
    candidates.iter().copied().find(|key| has_end(key))
}

/// Number of inserted, deleted and replaced characters between two words (Levenshtein).
fn edit_distance(first: &str, second: &str) -> usize {
    let second: Vec<char> = second.chars().collect();
    let mut row: Vec<usize> = (0..=second.len()).collect();
    for (i, a) in first.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in second.iter().enumerate() {
            let replaced = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[second.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_of_known_words() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("gap_m", "gap_m"), 0);
    }

    #[test]
    fn a_slip_is_recognised_and_another_word_is_not() {
        assert_eq!(closest("lenght_m", ["length_m", "elements"]), Some("length_m"));
        assert_eq!(closest("colour", ["length_m", "elements"]), None);
    }

    #[test]
    fn a_key_is_recognised_by_its_stem_and_by_its_end() {
        let keys = ["length_m", "youngs_modulus_pa", "density_kg_m3", "modal_ratio", "rayleigh"];
        assert_eq!(closest("density", keys), Some("density_kg_m3"));
        assert_eq!(closest("density_g_cm3", keys), Some("density_kg_m3"));
        assert_eq!(closest("youngs_modulus_in_gpa", keys), Some("youngs_modulus_pa"));
        assert_eq!(closest("ratio", keys), Some("modal_ratio"));
        assert_eq!(closest("length_mm", keys), Some("length_m"));
    }

    #[test]
    fn words_of_other_programs_are_known_where_ours_is_allowed() {
        assert_eq!(closest("fixed", ["clamped", "pinned", "sliding", "free"]), Some("clamped"));
        assert_eq!(closest("Simply supported", ["clamped", "pinned"]), Some("pinned"));
        assert_eq!(closest("fixed", ["left", "right"]), None);
    }
}
