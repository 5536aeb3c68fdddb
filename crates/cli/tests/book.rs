//! The book says what the command does: tutorials are followed to the letter, and its commands exist.
//!
//! `HAMMERBEAM_UPDATE=1` writes the pictures of the tutorials, the page of commands and the tables of keys
//! anew.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod commands;
mod keys;
mod links;
mod readers;
mod snippets;

use std::{
    collections::BTreeMap,
    env, fs,
    path::{Path, PathBuf},
};

use crate::common::{Workshop, assert_success, stdout};
use snippets::{Snippet, blocks, is_same, missing, pictures, snippets};

/// The head of the page of commands; what follows is what the command says of itself.
const COMMANDS: &str = "\
# Commands

This page is what `hammerbeam COMMAND --help` prints.
`hammerbeam man --out FOLDER` writes manual pages, and `hammerbeam completions SHELL` what a shell needs to
complete commands.

| exit code | meaning |
|---|---|
| 0 | done |
| 1 | no result |
| 2 | bad input |
| 3 | `verify` found disagreements |
| 130 | interrupted; what is finished is kept |
";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn is_to_be_updated() -> bool {
    env::var_os("HAMMERBEAM_UPDATE").is_some()
}

/// Does what a tutorial says, in a folder of its own that has the files beside the page.
#[track_caller]
fn followed(tutorial: &str) -> Workshop {
    let page = fs::read_to_string(root().join(format!("docs/tutorials/{tutorial}.md"))).unwrap();
    let workshop = Workshop::with("");
    copy_files(&root().join("docs/tutorials").join(tutorial), &workshop.path(""));
    follow(&workshop, &page, tutorial);
    for picture in pictures(&page, tutorial) {
        keep_picture(
            &workshop.path(picture),
            &root().join("docs/images/tutorials").join(tutorial).join(picture),
        );
    }
    workshop
}

/// Copies the files of a folder, if there is one.
fn copy_files(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).into_iter().flatten() {
        let path = entry.unwrap().path();
        fs::copy(&path, to.join(path.file_name().unwrap())).unwrap();
    }
}

/// Saves, runs and compares what a page has, from top to bottom.
#[track_caller]
fn follow(workshop: &Workshop, page: &str, name: &str) {
    let mut printed = String::new();
    for snippet in snippets(page) {
        match snippet {
            Snippet::File { name, text } => save(&workshop.path(&name), &text),
            Snippet::Commands(commands) => {
                printed = commands.iter().map(|command| output(workshop, command)).collect();
            }
            Snippet::Output(lines) => {
                let line = missing(&lines, &printed, is_same);
                assert!(line.is_none(), "{name}: \"{}\" is not in\n{printed}", line.unwrap_or_default());
            }
        }
    }
}

/// Saves a file, or compares it where a command has written it.
fn save(path: &Path, text: &str) {
    match fs::read_to_string(path) {
        Ok(written) => assert!(written == text, "{} is not what the page shows:\n{written}", path.display()),
        Err(_) => fs::write(path, text).unwrap(),
    }
}

/// What a command line prints.
#[track_caller]
fn output(workshop: &Workshop, line: &str) -> String {
    let mut words = line.split_whitespace();
    let program = words.next();
    if program == Some("ccx") {
        // What CalculiX writes is beside the page.
        return String::new();
    }
    assert!(program == Some("hammerbeam") && !line.contains(['"', '\'', '|', '>']), "{line}");
    let output = workshop.hammerbeam(&words.collect::<Vec<_>>());
    assert_success(&output);
    stdout(&output)
}

/// The commands of the page draw what it shows.
fn keep_picture(drawn: &Path, shown: &Path) {
    if is_to_be_updated() {
        fs::create_dir_all(shown.parent().unwrap()).unwrap();
        fs::copy(drawn, shown).unwrap();
    }
    assert!(drawn.exists() && shown.exists(), "{}", shown.display());
}

#[test]
fn the_bump_stop_is_as_its_tutorial_says() {
    followed("bump-stop");
}

#[test]
fn the_tube_in_a_hole_is_as_its_tutorial_says() {
    followed("tube-in-a-hole");
}

#[test]
fn the_plate_of_calculix_is_as_its_tutorial_says() {
    followed("calculix");
}

#[test]
fn the_gear_pair_is_as_its_tutorial_says_and_its_columns_are_explained() {
    let workshop = followed("gear-pair");
    let page = fs::read_to_string(root().join("docs/reference/results-tables.md")).unwrap();
    for name in ["branches", "events", "ends", "curves", "curve_ends"] {
        let table = fs::read_to_string(workshop.path(&format!("gears/export/{name}.csv"))).unwrap();
        for column in table.lines().next().unwrap().split(',') {
            assert!(page.contains(&format!("`{column}`")), "{name}.csv: `{column}`");
        }
    }
}

#[test]
fn the_measured_beam_is_as_its_tutorial_says() {
    followed("measured-beam");
}

/// What a command says of itself.
fn help(workshop: &Workshop, command: &[&str]) -> String {
    let output = workshop.hammerbeam(&[command, &["--help"]].concat());
    assert_success(&output);
    stdout(&output)
}

/// Names in the list of commands of a help text.
fn names(help: &str) -> Vec<String> {
    let list = help.split_once("Commands:\n").map_or("", |(_, list)| list);
    let list = list.split("\n\n").next().unwrap_or_default();
    let name = |line: &str| Some(line.strip_prefix("  ")?.split(' ').next()?.to_owned());
    list.lines().filter_map(name).filter(|name| !name.is_empty() && name != "help").collect()
}

/// Help texts of all commands, in the order in which the command lists them.
fn helps(workshop: &Workshop) -> Vec<(String, String)> {
    let mut helps = Vec::new();
    for name in names(&help(workshop, &[])) {
        let text = help(workshop, &[&name]);
        let parts = names(&text);
        helps.push((name.clone(), text));
        for part in parts {
            helps.push((format!("{name} {part}"), help(workshop, &[&name, &part])));
        }
    }
    helps
}

#[test]
fn the_page_of_commands_is_what_they_say_of_themselves() {
    let workshop = Workshop::with("");
    let sections = helps(&workshop)
        .into_iter()
        .map(|(name, help)| format!("\n## `hammerbeam {name}`\n\n```text\n{}\n```\n", help.trim_end()));
    let expected = format!("{COMMANDS}{}", sections.collect::<String>());
    let path = root().join("docs/reference/commands.md");
    if is_to_be_updated() {
        fs::write(&path, &expected).unwrap();
    }
    let page = fs::read_to_string(&path).unwrap();
    assert!(page == expected, "docs/reference/commands.md is old; HAMMERBEAM_UPDATE=1 writes it");
}

/// All pages of the book, and those beside it.
fn pages() -> Vec<PathBuf> {
    let (mut pages, mut folders) = (vec![root().join("README.md")], vec![root().join("docs")]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "md") {
                pages.push(path);
            }
        }
    }
    pages
}

/// Lines of a page that call the command, without what calls it and with lines that go on joined.
fn calls(page: &str) -> Vec<String> {
    let fenced = blocks(page).into_iter().filter(|block| ["", "sh"].contains(&block.language.as_str()));
    let text = fenced.map(|block| block.text.replace("\\\n", " ")).collect::<String>();
    let call = |line: &str| {
        let line = line.replacen("cargo run --release -- ", "hammerbeam ", 1);
        line.strip_prefix("hammerbeam ").map(str::to_owned)
    };
    text.lines().filter_map(call).chain(calls_in_sentences(page)).collect()
}

/// The same in backquotes within sentences and tables.
fn calls_in_sentences(page: &str) -> Vec<String> {
    let sentences = page.split("```").step_by(2);
    let quoted = sentences.flat_map(|text| text.split('`').skip(1).step_by(2));
    let calls = quoted.filter_map(|words| words.strip_prefix("hammerbeam "));
    // A word in capitals stands for any command.
    calls.filter(|call| !call.starts_with("COMMAND")).map(str::to_owned).collect()
}

#[test]
fn every_command_and_option_in_the_book_exists() {
    let helps: BTreeMap<String, String> = helps(&Workshop::with("")).into_iter().collect();
    let mut count = 0;
    for path in pages() {
        for call in calls(&fs::read_to_string(&path).unwrap()) {
            let mut words = call.split_whitespace();
            let (first, second) = (words.next().unwrap(), words.next().unwrap_or_default());
            if first == "--version" {
                continue;
            }
            let help = helps.get(&format!("{first} {second}")).or_else(|| helps.get(first));
            let help = help.unwrap_or_else(|| panic!("{}: hammerbeam {call}", path.display()));
            for option in call.split(|c: char| c.is_whitespace() || c == '[').filter(|w| w.starts_with("--"))
            {
                let option = option.trim_end_matches(']');
                assert!(help.contains(option), "{}: {option} of hammerbeam {call}", path.display());
                count += 1;
            }
        }
    }
    assert!(count > 100, "{count}");
}
