//! The book beside the readers: examples on all its pages are understood, and the ranges of the study file
//! are those that its reader allows.

use std::{fs, path::Path};

use super::{StudyError, StudyFile};
use crate::Model;

const PAGE: &str = include_str!("../../../../docs/reference/study-file.md");
const BEAM: &str = include_str!("../../../../studies/beam-between-stops.toml");
const LUMPED: &str = include_str!("../../../../studies/two-masses.toml");

/// The TOML examples of a page.
fn examples(page: &str) -> Vec<&str> {
    page.split("```toml\n").skip(1).map(|rest| rest.split("\n```").next().unwrap()).collect()
}

/// Whether an example is a whole study, which then is one that is understood. Others are TOML, and so are
/// those whose matrices the commands of their page make: the tests of the command follow them.
fn is_study(example: &str) -> bool {
    let is_whole = ["[structure]", "[excitation]"].iter().all(|table| example.contains(table));
    if !is_whole || example.contains("kind = \"matrices\"") {
        toml::de::DeTable::parse(example).unwrap();
        return false;
    }
    let file = StudyFile::parse("example", example.to_owned()).unwrap_or_else(|error| panic!("{error}"));
    Model::build(&file).unwrap_or_else(|error| panic!("{error}"));
    true
}

#[test]
fn examples_of_all_pages_of_the_book_are_understood() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let mut complete = 0;
    for folder in ["tutorials", "how-to", "reference", "validation"] {
        for entry in fs::read_dir(docs.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|end| end == "md") {
                let page = fs::read_to_string(path).unwrap();
                complete += examples(&page).into_iter().filter(|example| is_study(example)).count();
            }
        }
    }
    assert!(complete >= 8, "{complete}");
}

/// What a reader allows instead of a number of a study that is far too large or too small.
fn allowed(study: &str) -> Vec<String> {
    let Err(StudyError::Invalid(report)) = StudyFile::parse("study.toml", study.to_owned()) else {
        return Vec::new();
    };
    let help = report.problems.iter().flat_map(|problem| &problem.help);
    help.filter_map(|help| help.strip_prefix("allowed: ")).map(str::to_owned).collect()
}

/// Rows of the tables of the page that are about a key, with ranges as the reader writes them.
fn rows(key: &str) -> String {
    let rows = PAGE.lines().filter(|line| line.starts_with('|') && line.contains(&format!("`{key}`")));
    rows.collect::<String>().replace(", to ", " to ")
}

#[test]
fn every_range_is_documented_as_it_is_read() {
    let added = [
        "[[stop]]\nlaw = \"linear\"\nstiffness_n_m = 1\ndamping_n_s_m = 1\nside = \"above\"\nat = \"tip\"\n",
        "[[stop]]\nlaw = \"hertz\"\nstiffness_n_m15 = 1.0\npreload_n = 1.0\nside = \"above\"\nat = \"tip\"\n",
        "[[stop]]\nlaw = \"cubic\"\nstiffness_n_m3 = 1.0\nstiffness_n_m2 = 1.0\nat = \"tip\"\n",
        "[[load]]\nkind = \"gravity\"\nacceleration_m_s2 = 1.0\n",
        "[[load]]\nkind = \"force\"\nat = \"tip\"\namplitude_n = 1.0\norder = 1\nphase_rad = 1.0\n",
        "[search]\nfrequencies = 1\nstarts = 1\nsettling_periods = 1\ntrials = 1\n",
        "[continuation]\nmax_step_hz = 1.0\ntolerance = 1e-9\nsegments = 1\nbudget_solutions = 1\n",
    ]
    .map(|added| format!("{BEAM}\n{added}"));
    let mut ranges = 0;
    for study in added.iter().map(String::as_str).chain([BEAM, LUMPED]) {
        for line in study.lines() {
            let Some((key, value)) = line.split_once(" = ") else { continue };
            // The place of a point is bounded by the length of the beam, for which the page has a name.
            if key == "at_m" || value.split(" #").next().unwrap().trim().parse::<f64>().is_err() {
                continue;
            }
            for extreme in ["1e301", "-1e301"] {
                for range in allowed(&study.replacen(line, &format!("{key} = {extreme}"), 1)) {
                    let rows = rows(key);
                    assert!(rows.contains(&range), "`{key}`: \"{range}\" is not in\n{rows}");
                    ranges += 1;
                }
            }
        }
    }
    assert!(ranges > 150, "{ranges}");
}
