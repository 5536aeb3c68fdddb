//! The figures of the book are those that the example `book_figures` draws; it checks the formulas of the
//! book while it draws.

use std::{fs, path::Path};

use crate::book_figures;

/// Figures of whole branches and of chaos: on another machine other points may be drawn, under the same
/// texts at the same places.
const BY_TEXTS: [&str; 4] = ["shooting", "grazing", "exponents-convergence", "exponents-section"];
/// Coordinates have two decimals (pt).
const TOLERANCE: f64 = 0.05;

/// The numbers of a document, and what is between them.
fn numbers(svg: &str) -> (Vec<f64>, Vec<&str>) {
    let is_digit = |character: char| character.is_ascii_digit() || character == '.';
    let parts = svg.split(|character: char| !is_digit(character)).filter(|part| !part.is_empty());
    let between = svg.split(is_digit).filter(|part| !part.is_empty());
    (parts.filter_map(|part| part.parse().ok()).collect(), between.collect())
}

fn texts(svg: &str) -> Vec<&str> {
    svg.lines().filter(|line| line.starts_with("<text")).collect()
}

/// The document without its fonts, whose digits are no numbers.
fn without_fonts(svg: &str) -> String {
    svg.lines().filter(|line| !line.starts_with("<style>")).map(|line| format!("{line}\n")).collect()
}

#[test]
fn the_book_has_the_figures_that_the_example_draws() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let figures = book_figures::figures().unwrap();
    assert_eq!(figures.len(), 11);
    for (file, figure) in figures {
        let committed = fs::read_to_string(docs.join(file)).unwrap();
        let (committed, drawn) = (without_fonts(&committed), without_fonts(&figure.svg()));
        assert!(figure.characters_lacking().next().is_none(), "{file}");
        assert_eq!(texts(&committed), texts(&drawn), "{file}");
        if BY_TEXTS.iter().any(|name| file.ends_with(&format!("{name}.svg"))) {
            continue;
        }
        let ((ours, between), (theirs, of_theirs)) = (numbers(&drawn), numbers(&committed));
        assert!(between == of_theirs && ours.len() == theirs.len(), "{file} has other elements");
        let off = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= TOLERANCE, "{file} is off by {off} pt");
    }
}
