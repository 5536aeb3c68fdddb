//! Licences of everything that is built into the program: allowed ones, and listed in `docs/third-party.md`.
//!
//! The list is what `cargo tree` says of the lock file, without a network. With `HAMMERBEAM_UPDATE=1` the
//! test writes it anew instead of comparing.

use std::{collections::BTreeSet, env, fs, path::Path, process::Command};

/// Licences under which code may be given on with a program under MIT or Apache-2.0.
const ALLOWED: [&str; 11] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "0BSD",
    "ISC",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

const HEAD: &str = "# Third-party code\n\nWhat is built into the program besides this repository, with its \
licence; made by \
    the test `licences`\nof `verification` (`HAMMERBEAM_UPDATE=1`). The texts of the licences are in the \
    packages. \
    The figures\nhold the font Arimo (SIL Open Font License), the page holds uPlot (MIT).\n\n\
    | package | version | licence |\n|---|---|---|\n";

/// Whether all parts of an expression are allowed: of `OR` one side, of `AND` both.
fn is_allowed(expression: &str) -> bool {
    let plain = expression.replace(['(', ')'], "").replace('/', " OR ");
    plain.split(" AND ").all(|part| part.split(" OR ").any(|name| ALLOWED.contains(&name.trim())))
}

/// Package, version and licence of everything that is linked or runs while building.
fn packages(root: &Path) -> BTreeSet<[String; 3]> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["tree", "--locked", "--offline", "--workspace", "--no-dedupe", "-e", "normal,build"]);
    cargo.args(["--prefix", "none", "--format", "{p}|{l}"]).current_dir(root);
    let output = cargo.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let package = |line: &str| {
        let (package, licence) = line.split_once('|').unwrap();
        let mut words = package.split_whitespace();
        let (name, version) = (words.next().unwrap(), words.next().unwrap().trim_start_matches('v'));
        [name, version, licence].map(str::to_owned)
    };
    let others = text.lines().filter(|line| !line.starts_with("hammerbeam") && line.contains('|'));
    others.map(package).collect()
}

#[test]
fn what_is_built_in_has_a_licence_that_allows_it_and_is_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let packages = packages(&root);
    assert!(packages.len() > 50, "{}", packages.len());
    for [name, version, licence] in &packages {
        assert!(is_allowed(licence), "{name} {version}: \"{licence}\"");
    }
    let rows = packages.iter().map(|package| format!("| {} |\n", package.join(" | ")));
    let list = format!("{HEAD}{}", rows.collect::<String>());
    let page = root.join("docs/third-party.md");
    if env::var_os("HAMMERBEAM_UPDATE").is_some() {
        fs::write(&page, &list).unwrap();
    }
    let written = fs::read_to_string(&page).unwrap();
    assert!(
        written == list,
        "docs/third-party.md is not what the lock file gives; HAMMERBEAM_UPDATE=1 writes it"
    );
}

#[test]
fn of_two_licences_one_has_to_be_allowed_and_of_two_that_both_hold_both() {
    assert!(is_allowed("MIT OR GPL-3.0") && is_allowed("(MIT OR Apache-2.0) AND Unicode-3.0"));
    assert!(is_allowed("MIT/Apache-2.0"));
    assert!(!is_allowed("GPL-3.0") && !is_allowed("MIT AND GPL-3.0") && !is_allowed(""));
}
