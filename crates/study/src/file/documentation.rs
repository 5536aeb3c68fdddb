//! The documentation says what the readers do: every law stands in it, and every example of it is understood.
//! Its tables of keys are written by the program, see `keys.rs`.

use hammerbeam_motion::law::{DESCRIPTIONS, LawDescription, LawKey, LawSides};

use super::{StudyFile, beam_section::FORMS, reduction::METHODS};
use crate::Model;

const PAGE: &str = include_str!("../../../../docs/reference/study-file.md");

/// The TOML examples of the page.
fn examples() -> Vec<&'static str> {
    PAGE.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
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

/// Cells of the rows of the table with this head.
fn table(head: &str) -> Vec<Vec<&'static str>> {
    let (_, behind) = PAGE.split_once(head).unwrap_or_else(|| panic!("no table {head}"));
    let rows = behind.lines().skip(2).take_while(|line| line.starts_with('|'));
    rows.map(|line| line.trim_matches('|').split(" | ").map(str::trim).collect()).collect()
}

/// The table of methods against the list of methods; a second name stands below the first.
#[test]
fn every_method_of_reduction_has_its_row() {
    let method = |name: &str| METHODS.iter().find(|(known, _)| format!("`\"{known}\"`") == name);
    let rows = table("| method | basis |");
    assert_eq!(rows.len(), METHODS.len());
    let described: Vec<_> =
        rows.iter().map(|row| method(row[0]).unwrap_or_else(|| panic!("{row:?}"))).collect();
    for (name, _) in METHODS {
        assert_eq!(described.iter().filter(|(other, _)| other == name).count(), 1, "{name}");
    }
    for (place, row) in rows.iter().enumerate() {
        let is_second = place > 0 && described[place].1 == described[place - 1].1;
        assert_eq!(row[1] == "another name of it", is_second, "{row:?}");
    }
}

/// A beam with a section of these keys.
fn with_section(keys: &[&str]) -> String {
    let size = |key: &str| match key {
        "width_m" | "outer_diameter_m" => "0.02",
        "height_m" | "wall_m" => "0.002",
        "area_m2" => "4e-5",
        "second_moment_m4" => "1.3e-11",
        other => panic!("{other} has no size here"),
    };
    let section: Vec<String> = keys.iter().map(|key| format!("{key} = {}", size(key))).collect();
    format!(
        "[structure]\nkind = \"beam\"\nlength_m = 0.5\nelements = 10\nsection = {{ {} }}\n\
         youngs_modulus_pa = 2.1e11\ndensity_kg_m3 = 7800.0\nleft = \"clamped\"\nright = \"free\"\n\
         [reduction]\nmethod = \"guyan\"\ncut_off_hz = 500.0\n",
        section.join(", ")
    )
}

/// The forms of a section that the page has are those that are read, with all keys and with one alone.
#[test]
fn every_form_of_a_section_has_its_row() {
    let rows = table("| form of `section` | is |");
    let on_page: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    let mut accepted = Vec::new();
    for (_, [first, second]) in FORMS {
        for keys in [&[first, second][..], &[first], &[second]] {
            if StudyFile::parse("section", with_section(keys)).is_ok() {
                accepted.push(format!("`{{ {} }}`", keys.join(", ")));
            }
        }
    }
    assert_eq!(accepted.len(), on_page.len(), "{accepted:?}");
    for form in accepted {
        assert!(on_page.contains(&form.as_str()), "{form} is not in {on_page:?}");
    }
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
