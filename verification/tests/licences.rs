//! Licences of everything that is built into the program: allowed by `deny.toml`, listed in
//! `docs/third-party.md`, with their texts in `THIRD-PARTY.txt`.
//!
//! The list is what `cargo tree` says of the lock file, without a network. With `HAMMERBEAM_UPDATE=1` the
//! test writes both files anew instead of comparing.

mod texts;

use std::{collections::BTreeSet, env, fs, path::Path};

const HEAD: &str = "# Third-party code\n\n\
    What is built into the program besides this repository, with its licence; made by the test `licences`\n\
    of `verification` (`HAMMERBEAM_UPDATE=1`). The texts of the licences are in `THIRD-PARTY.txt`. The\n\
    figures hold the font Arimo (SIL Open Font License), the page holds uPlot (MIT).\n\n\
    | package | version | licence |\n|---|---|---|\n";

/// Licences that `deny.toml` allows.
fn allowed(root: &Path) -> Vec<String> {
    let table: toml::Table = fs::read_to_string(root.join("deny.toml")).unwrap().parse().unwrap();
    let names = table["licenses"]["allow"].as_array().unwrap();
    names.iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

/// Whether all parts of an expression are allowed: of `OR` one side, of `AND` both.
fn is_allowed(expression: &str, allowed: &[String]) -> bool {
    let plain = expression.replace(['(', ')'], "").replace('/', " OR ");
    let holds = |name: &str| allowed.iter().any(|allowed| allowed == name.trim());
    plain.split(" AND ").all(|part| part.split(" OR ").any(holds))
}

/// Package, version and licence of everything that is linked or runs while building.
fn packages(root: &Path) -> BTreeSet<[String; 3]> {
    let all = ["tree", "--locked", "--offline", "--workspace", "--no-dedupe", "-e", "normal,build"];
    let text = texts::cargo(root, &[&all[..], &["--prefix", "none", "--format", "{p}|{l}"]].concat());
    let package = |line: &str| {
        let (package, licence) = line.split_once('|').unwrap();
        let mut words = package.split_whitespace();
        let (name, version) = (words.next().unwrap(), words.next().unwrap().trim_start_matches('v'));
        [name, version, licence].map(str::to_owned)
    };
    let others = text.lines().filter(|line| !line.starts_with("hammerbeam") && line.contains('|'));
    others.map(package).collect()
}

/// Holds a file to what it has to be, or writes it where that is asked for.
fn hold(path: &Path, wanted: &str) {
    if env::var_os("HAMMERBEAM_UPDATE").is_some() {
        fs::write(path, wanted).unwrap();
    }
    let written = fs::read_to_string(path).unwrap();
    let what = path.display();
    assert!(written == wanted, "{what} is not what the lock file gives; HAMMERBEAM_UPDATE=1 writes it");
}

#[test]
fn what_is_built_in_has_a_licence_that_allows_it_and_is_listed_with_its_text() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (packages, allowed) = (packages(&root), allowed(&root));
    assert!(packages.len() > 50, "{}", packages.len());
    for [name, version, licence] in &packages {
        assert!(is_allowed(licence, &allowed), "{name} {version}: \"{licence}\"");
    }
    let rows = packages.iter().map(|package| format!("| {} |\n", package.join(" | ")));
    hold(&root.join("docs/third-party.md"), &format!("{HEAD}{}", rows.collect::<String>()));
    hold(&root.join("THIRD-PARTY.txt"), &texts::texts(&root, &packages));
}

#[test]
fn of_two_licences_one_has_to_be_allowed_and_of_two_that_both_hold_both() {
    let allowed = ["MIT", "Apache-2.0", "Unicode-3.0"].map(str::to_owned);
    let is_allowed = |expression| is_allowed(expression, &allowed);
    assert!(is_allowed("MIT OR GPL-3.0") && is_allowed("(MIT OR Apache-2.0) AND Unicode-3.0"));
    assert!(is_allowed("MIT/Apache-2.0"));
    assert!(!is_allowed("GPL-3.0") && !is_allowed("MIT AND GPL-3.0") && !is_allowed(""));
}
