//! Every command of the how-to pages, the reference, the validation and the README is run: blocks of the
//! language `sh`.
//!
//! A command is run as the page has it, in a folder with the studies of the project and a `study.toml`. Words
//! in capitals stand for what the reader has; they are put in. Where a command takes long on the page, a
//! number of it is made smaller, or the run gets a narrower range by `--set`. What the program prints is
//! compared on the pages that show all of it.

use std::fs;

use super::{blocks, copy_files, missing, root, snippets::is_about};
use crate::common::{Workshop, stderr, stdout};

const STUDY: &str = include_str!("../../../../studies/beam-between-stops.toml");

/// Commands that are not run, by their first words, and why. Each stands in the book: the list can only get
/// shorter.
const NOT_RUN: [(&str, &str); 7] = [
    ("cargo test --workspace --locked", "this is that"),
    ("cargo run --release -p hammerbeam-verification", "hours; the test `completeness` does a part of it"),
    ("python -m hammerbeam.batch", "needs the Python package, whose test of the book follows the page"),
    ("node test/bench.mjs", "a clock cannot stand in a test"),
    ("dakota -i", "needs Dakota; the test of the Python package runs it where it is there"),
    (
        "cargo run --release -p hammerbeam --example book_figures",
        "a test of the crate `hammerbeam` does this",
    ),
    (
        "hammerbeam rig studies/virtual-rig.toml",
        "the test `rig` takes the same study through a shorter sweep",
    ),
];

/// Pages in none of the folders that are gone through.
const OF_THEIR_OWN: [&str; 2] = ["README.md", "docs/performance.md"];

/// Words that stand for what the reader has. Options in brackets are left out.
const READERS_OWN: [(&str, &str); 9] = [
    (" STUDY ", " study.toml "),
    (" RESULTS ", " own "),
    (" FOLDER", " results"),
    (" DIR", " other"),
    (" HZ ", " 31 "),
    (" FILE ", " own-rig/measured.csv "),
    (" MEASURED...", " measured.csv --frequency-factor 1 --amplitude-factor 1"),
    (" tap.csv", " decay/samples.csv"),
    ("cargo run --release -- ", "hammerbeam "),
];

/// Numbers that make a command long, and smaller ones.
const SHORTER: [(&str, &str); 5] = [
    ("--periods 2000", "--periods 40"),
    ("--grid 200", "--grid 3"),
    ("--step 0.1 --starts 20", "--step 4 --starts 2"),
    ("--from 20 --to 60 --step 0.5", "--from 30 --to 32 --step 1"),
    ("--from 41 --to 60 --step 0.5", "--from 41 --to 42 --step 0.5"),
];

/// Ranges [Hz] to which a study is narrowed.
const NARROWED: [(&str, [f64; 2]); 5] = [
    ("study.toml", [30.5, 31.5]),
    ("studies/beam-with-stop.toml", [40.0, 40.2]),
    ("studies/beam-with-stop-low-damping.toml", [40.0, 40.2]),
    ("studies/beam-with-stop-one-dof.toml", [20.0, 21.0]),
    ("studies/beam-with-stop-completeness.toml", [40.0, 40.2]),
];

/// What a reader of a page has done before.
const DONE_BEFORE: [(&str, &[&str]); 5] = [
    (
        "docs/how-to/choose-damping.md",
        &["simulate studies/free-decay.toml --set stop.1.gap_m=1 --initial mass.y=-0.01 --duration 10 \
             --sampling 100 --out decay"],
    ),
    (
        "docs/how-to/compare-with-measurements.md",
        &[
            "run study.toml --out own",
            "simulate study.toml --frequency 31 --transient-periods 300 --periods 30 --out own-motion",
            "signal chain own-motion/samples.csv --periodic --low-pass 500 --noise 0.01 --seed 1 \
             --out own-rig",
        ],
    ),
    ("docs/reference/figures.md", &["run study.toml --out own"]),
    ("docs/reference/verify.md", &["run studies/beam-with-stop.toml --out results/beam-with-stop"]),
    ("docs/validation/chaos.md", &["run studies/beam-with-stop.toml --out own"]),
];

/// Pages that show what their commands print.
const PRINTED: [&str; 2] = ["docs/how-to/compare-with-measurements.md", "docs/how-to/process-signals.md"];

/// Commands of a block: lines that go on are joined, remarks left out.
fn commands(block: &str) -> Vec<String> {
    let joined = block.replace("\\\n", " ");
    let lines = joined.lines().map(|line| line.split(" #").next().unwrap_or_default().trim());
    lines.filter(|line| !line.is_empty()).map(str::to_owned).collect()
}

/// The command line without options in brackets, with what the reader has, and shorter.
fn shortened(command: &str) -> String {
    let mut depth = 0;
    let without = command.chars().filter(|character| {
        depth += i32::from(*character == '[');
        let is_kept = depth == 0;
        depth -= i32::from(*character == ']');
        is_kept
    });
    let mut line = format!("{} ", without.collect::<String>());
    for (old, new) in READERS_OWN.into_iter().chain(SHORTER) {
        line = line.replace(old, new);
    }
    line.trim().to_owned()
}

/// Words of a command line; quotation marks keep spaces together.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut is_quoted) = (vec![String::new()], false);
    for character in line.chars() {
        match character {
            '"' => is_quoted = !is_quoted,
            ' ' if !is_quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(character),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Settings that shorten what is stored of a study, for one folder holds one study, or a fit.
fn narrowing(words: &[String]) -> Vec<String> {
    let [command, study, ..] = words else { return Vec::new() };
    if command == "update" && study == "studies/beam-with-stop.toml" {
        // Of 44: a fit has the matrices assembled many times.
        return ["--set", "structure.elements=16"].map(str::to_owned).to_vec();
    }
    let range = NARROWED.iter().find(|(name, _)| name == study).map(|(_, range)| range);
    let Some([low, high]) = range.filter(|_| ["run", "sweep", "basins"].contains(&command.as_str())) else {
        return Vec::new();
    };
    let settings = [
        format!("excitation.frequency_hz=[{low:?}, {high:?}]"),
        "search.frequencies=1".to_owned(),
        "search.starts=1".to_owned(),
        "search.trials=0".to_owned(),
        "response.period_multiples=[1]".to_owned(),
        "response.period_doubling_depth=0".to_owned(),
        "continuation.max_step_hz=0.02".to_owned(),
    ];
    settings.into_iter().flat_map(|setting| ["--set".to_owned(), setting]).collect()
}

/// Runs a command line without its first word, and gives what it prints.
#[track_caller]
fn run(workshop: &Workshop, line: &str) -> String {
    let mut words = words(line);
    words.extend(narrowing(&words));
    let arguments: Vec<&str> = words.iter().map(String::as_str).collect();
    let output = workshop.hammerbeam(&arguments);
    assert!(output.status.success(), "hammerbeam {arguments:?}\n{}", stderr(&output));
    stdout(&output)
}

/// Runs a script for a scheduler as that does, with this build's command, one core, and a shorter study.
#[track_caller]
fn run_script(workshop: &Workshop, text: &str) {
    let narrowed = narrowing(&["run".to_owned(), "study.toml".to_owned()]).join("' '");
    fs::write(workshop.path("job.sh"), format!("{} '{narrowed}'\n", text.trim_end())).unwrap();
    let program = assert_cmd::cargo::cargo_bin!("hammerbeam");
    let known = std::env::var_os("PATH").unwrap();
    let path = [program.parent().unwrap().to_owned()].into_iter().chain(std::env::split_paths(&known));
    let mut script = std::process::Command::new("bash");
    script.arg("job.sh").current_dir(workshop.path("")).env("SLURM_CPUS_PER_TASK", "1");
    let output = script.env("PATH", std::env::join_paths(path).unwrap()).output().unwrap();
    assert!(output.status.success(), "{text}\n{}", stderr(&output));
    assert!(workshop.path("results/results.db").is_file());
}

/// A folder with the studies, files of the page, and what its reader has done before.
fn prepared(page: &str, text: &str) -> Workshop {
    let first_study = blocks(text).into_iter().find(|block| block.language == "toml");
    let of_matrices = first_study.filter(|block| block.text.contains("kind = \"matrices\""));
    let workshop = Workshop::with(of_matrices.as_ref().map_or(STUDY, |block| &block.text));
    for folder in ["studies", "studies/bracket", "studies/measurements"] {
        fs::create_dir(workshop.path(folder)).unwrap();
        for entry in fs::read_dir(root().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, workshop.path(folder).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
    copy_files(&root().join("crates/matrices/tests/fixtures"), &workshop.path(""));
    if let Some(table) = blocks(text).into_iter().find(|block| block.language == "csv") {
        fs::write(workshop.path("measured.csv"), table.text).unwrap();
    }
    for (_, commands) in DONE_BEFORE.iter().filter(|(known, _)| *known == page) {
        commands.iter().for_each(|command| drop(run(&workshop, command)));
    }
    workshop
}

/// Runs what a page has; how many commands that are.
#[track_caller]
fn run_page(page: &str) -> usize {
    let text = fs::read_to_string(root().join(page)).unwrap();
    let (mut count, mut printed, mut workshop) = (0, String::new(), None);
    for block in blocks(&text) {
        let is_command = block.language == "sh";
        let known = ["hammerbeam ", "cargo ", "python ", "dakota "];
        let is_like_one = known.iter().any(|word| block.text.starts_with(word));
        assert!(
            is_command || !is_like_one,
            "{page}: a command in a block that is not of `sh`\n{}",
            block.text
        );
        if is_command {
            printed.clear();
        }
        if block.language == "bash" {
            run_script(workshop.get_or_insert_with(|| prepared(page, &text)), &block.text);
            count += 1;
        }
        for command in commands(&block.text).iter().filter(|_| is_command) {
            if NOT_RUN.iter().any(|(start, _)| command.starts_with(start)) {
                continue;
            }
            let line = shortened(command);
            let line = line.strip_prefix("hammerbeam ").unwrap_or_else(|| panic!("{page}: {command}"));
            let workshop = workshop.get_or_insert_with(|| prepared(page, &text));
            printed += &run(workshop, line);
            count += 1;
        }
        if block.language == "text" && PRINTED.contains(&page) {
            let lines: Vec<String> = block.text.lines().map(str::to_owned).collect();
            let line = missing(&lines, &printed, is_about);
            assert!(line.is_none(), "{page}: \"{}\" is not in\n{printed}", line.unwrap_or_default());
        }
    }
    count
}

/// Pages of a folder.
fn pages(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".md")).collect();
    names.sort();
    // Followed as they are, by tests of their own.
    names.retain(|name| name != "readers.md");
    names.into_iter().map(|name| format!("{folder}/{name}")).collect()
}

fn run_folder(folder: &str) -> usize {
    pages(folder).iter().map(|page| run_page(page)).sum()
}

#[test]
fn commands_of_the_how_to_pages_run() {
    let count = run_folder("docs/how-to");
    assert!(count >= 25, "{count}");
}

#[test]
fn commands_of_the_reference_run() {
    let count = run_folder("docs/reference");
    assert!(count >= 6, "{count}");
}

#[test]
fn commands_of_the_validation_the_theory_and_the_readme_run() {
    let count = run_folder("docs/validation") + run_folder("docs/theory");
    let count = count + OF_THEIR_OWN.into_iter().map(run_page).sum::<usize>();
    assert!(count >= 6, "{count}");
}

#[test]
fn what_is_not_run_stands_in_the_book() {
    let folders = ["docs/how-to", "docs/reference", "docs/validation", "docs/theory"];
    let pages = folders.into_iter().flat_map(pages).chain(OF_THEIR_OWN.map(str::to_owned));
    let texts: Vec<String> = pages.map(|page| fs::read_to_string(root().join(page)).unwrap()).collect();
    for (start, reason) in NOT_RUN {
        let stands = texts.iter().any(|text| text.lines().any(|line| line.starts_with(start)));
        assert!(stands, "\"{start}\", not run since \"{reason}\", is in no page: take it off the list");
    }
}
