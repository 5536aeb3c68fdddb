//! Texts of the licences of packages, from the files that come with the packages.
//!
//! A text is written once for all packages that bring the same words, whatever the blanks and line ends
//! between them. A package without a file of its own gets a line with its licence and its authors.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use serde_json::Value;

const HEAD: &str = "Licences of what is built into Hammerbeam, made by the test `licences` of\n\
    `verification` (HAMMERBEAM_UPDATE=1). Each text is headed by the packages that bring it.\n";
/// Beginnings of the names of files that hold a licence or a notice.
const BEGINNINGS: [&str; 5] = ["LICEN", "COPY", "NOTICE", "UNLICENSE", "AUTHORS"];
/// What the program holds besides packages: name and text.
const OTHERS: [(&str, &str); 2] = [
    ("Arimo, the font of the figures", "crates/figure/fonts/OFL.txt"),
    ("uPlot, in the results page", "crates/figure/page/dist/LICENCE-uPlot.txt"),
];

/// What `cargo metadata` says of a package.
struct Package {
    /// Name and version.
    title: String,
    folder: PathBuf,
    licence: String,
    /// In words that follow the licence; empty if the package names none.
    authors: String,
}

/// Everything that has to be said of these packages, given by name and version, and of the other parts.
pub fn texts(root: &Path, wanted: &BTreeSet<[String; 3]>) -> String {
    let mut texts: BTreeMap<String, (String, Vec<String>)> = BTreeMap::new();
    let mut keep = |title: &str, text: &str| {
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let tidy = text.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
        texts
            .entry(words)
            .or_insert((tidy.trim_matches('\n').to_owned(), Vec::new()))
            .1
            .push(title.to_owned());
    };
    for (title, path) in OTHERS {
        keep(title, &fs::read_to_string(root.join(path)).unwrap());
    }
    let mut without = String::new();
    for package in packages(root, wanted) {
        let files = files(&package.folder);
        if files.is_empty() {
            without += &format!("{}: {}{}\n", package.title, package.licence, package.authors);
        }
        for file in files {
            keep(&package.title, &String::from_utf8_lossy(&fs::read(file).unwrap()));
        }
    }
    let mut texts: Vec<_> = texts.into_values().collect();
    texts.sort_by(|one, other| one.1.cmp(&other.1));
    let rule = "=".repeat(100);
    let parts = texts.iter().map(|(text, titles)| format!("\n{rule}\n{}\n\n{text}\n", wrapped(titles)));
    let heading = "Packages that bring no text of their own; those of their licences stand above";
    format!("{HEAD}{}\n{rule}\n{heading}\n\n{without}", parts.collect::<String>())
}

/// What cargo prints in the project's folder.
pub fn cargo(root: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(root).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The wanted ones, as cargo describes them. It is asked for this machine's packages alone: those of other
/// systems are not here unless something has fetched them.
fn packages(root: &Path, wanted: &BTreeSet<[String; 3]>) -> Vec<Package> {
    let about = cargo(root, &["-vV"]);
    let system = about.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    let here = ["metadata", "--locked", "--offline", "--format-version", "1", "--filter-platform", system];
    let all: Value = serde_json::from_str(&cargo(root, &here)).unwrap();
    let package = |package: &Value| {
        let text = |key: &str| package[key].as_str().unwrap_or_default().to_owned();
        let (name, version) = (text("name"), text("version"));
        let is_wanted = wanted.iter().any(|[wanted, of, _]| *wanted == name && *of == version);
        let authors = package["authors"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let authors: Vec<_> = authors.map(|author| author.trim_end_matches(" <>")).collect();
        let by = if authors.is_empty() { "" } else { ", by " };
        is_wanted.then(|| Package {
            title: format!("{name} {version}"),
            folder: Path::new(&text("manifest_path")).parent().unwrap().to_owned(),
            licence: text("license"),
            authors: format!("{by}{}", authors.join(", ")),
        })
    };
    let mut packages: Vec<_> = all["packages"].as_array().unwrap().iter().filter_map(package).collect();
    packages.sort_by(|one, other| one.title.cmp(&other.title));
    assert_eq!(packages.len(), wanted.len());
    packages
}

/// Files of a package with licences, by name.
fn files(folder: &Path) -> Vec<PathBuf> {
    let is_text = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().to_uppercase();
        path.is_file() && BEGINNINGS.iter().any(|beginning| name.starts_with(beginning))
    };
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(is_text);
    files.sort();
    files
}

/// Names with commas between them, in lines of a hundred letters.
fn wrapped(titles: &[String]) -> String {
    let (mut text, mut length) = (String::new(), 0);
    for (place, title) in titles.iter().enumerate() {
        let comma = if place + 1 < titles.len() { "," } else { "" };
        if length > 0 && length + title.len() + 2 > 100 {
            text += "\n";
            length = 0;
        } else if length > 0 {
            text += " ";
            length += 1;
        }
        text += title;
        text += comma;
        length += title.len() + 1;
    }
    text
}
