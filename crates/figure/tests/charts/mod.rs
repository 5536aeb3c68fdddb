//! What the figures of motions, multipliers and orbits promise to those who draw them.
#![allow(clippy::unwrap_used, reason = "tests")]

mod data;
mod motions;
mod multipliers;
mod orbits;
mod samples;

use std::io::Read;

use hammerbeam_figure::{
    BasinMap, ConvergenceDiagram, DataDiagram, ExponentDiagram, ExponentPoint, Figure, FigureError,
    HoleDiagram, MultiplierDiagram, OrbitDiagram, SectionDiagram, Style, SweepDiagram,
};

use samples::{basins, convergence, exponents, hole, multipliers, orbit, section, struck, sweep};

/// Every kind of figure, from the data above.
fn all() -> Vec<(&'static str, Figure)> {
    let style = Style::double_column();
    vec![
        ("basins", basins().draw(&style).unwrap()),
        ("sweep", sweep().draw(&style).unwrap()),
        ("exponents", exponents().draw(&style).unwrap()),
        ("convergence", convergence().draw(&style).unwrap()),
        ("section", section().draw(&style).unwrap()),
        ("moduli", multipliers().draw_moduli(&style).unwrap()),
        ("circle", multipliers().draw_circle(&style).unwrap()),
        ("history", orbit().draw_history(&style).unwrap()),
        ("phase", orbit().draw_phase(&style).unwrap()),
        ("spectrum", orbit().draw_spectrum(&style).unwrap()),
        ("hole", hole().draw(&style).unwrap()),
        ("history with impulses", struck().draw_history(&style).unwrap()),
        ("phase with impulses", struck().draw_phase(&style).unwrap()),
        ("spectrum with impulses", struck().draw_spectrum(&style).unwrap()),
        ("data", data::circle_and_branch().draw(&style).unwrap()),
    ]
}

#[test]
fn drawn_twice_every_figure_is_byte_for_byte_the_same() {
    for ((name, first), (_, second)) in all().into_iter().zip(all()) {
        assert_eq!(first.svg(), second.svg(), "{name}");
        assert_eq!(first.png(60.0).unwrap(), second.png(60.0).unwrap(), "{name}");
        assert_eq!(first.pdf().unwrap(), second.pdf().unwrap(), "{name}");
    }
}

/// Of each line of text the PDF has the first letter, at the place where the SVG has it, and of each path one
/// that is painted.
#[test]
fn a_pdf_has_the_texts_and_the_paths_of_the_svg() {
    for (name, figure) in all() {
        let (svg, file) = (figure.svg(), figure.pdf().unwrap());
        let page = page(&file);
        let count = |operator: &str| {
            page.lines().filter(|line| line.split(' ').next_back() == Some(operator)).count()
        };
        assert_eq!(count("BT"), svg.matches("<text").count(), "{name}");
        let painted: usize = ["S", "f", "B", "n"].map(count).iter().sum();
        assert_eq!(painted, svg.matches("<path").count() + svg.matches("<rect").count(), "{name}");
        assert_eq!(count("q"), count("Q"), "{name}");
        assert!(file.len() < svg.len() + 40_000, "{name}: {} and {} bytes", file.len(), svg.len());
    }
}

/// The content of the page of a PDF, inflated.
fn page(file: &[u8]) -> String {
    let find = |start: usize, word: &[u8]| {
        start + file[start..].windows(word.len()).position(|part| part == word).unwrap()
    };
    let object = find(0, b"4 0 obj");
    let stream = find(object, b"stream") + 7;
    let mut page = String::new();
    flate2::read::ZlibDecoder::new(&file[stream..]).read_to_string(&mut page).unwrap();
    page
}

#[test]
fn no_figure_has_a_number_that_is_none_and_every_axis_has_its_unit() {
    for (name, figure) in all() {
        let svg = figure.svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        let labels = ["(mm)", "(m/s)", "(m/s²)", "(1/s)", "(Hz)", "(–)", "(s)"];
        assert!(labels.iter().filter(|unit| svg.contains(*unit)).count() >= 1, "{name}");
        assert!(!figure.description().is_empty(), "{name}");
    }
}

#[test]
fn nothing_to_draw_is_refused_with_a_sentence() {
    let style = Style::default();
    let refused = [
        BasinMap::default().draw(&style),
        SweepDiagram::default().draw(&style),
        ExponentDiagram::default().draw(&style),
        ConvergenceDiagram::default().draw(&style),
        SectionDiagram::default().draw(&style),
        MultiplierDiagram::default().draw_moduli(&style),
        MultiplierDiagram::default().draw_circle(&style),
        OrbitDiagram::default().draw_history(&style),
        OrbitDiagram::default().draw_spectrum(&style),
        HoleDiagram::default().draw(&style),
        DataDiagram { panels: vec![data::panel(Vec::new())], ..DataDiagram::default() }.draw(&style),
    ];
    for result in refused {
        let error = result.unwrap_err();
        assert!(matches!(error, FigureError::Empty { .. }), "{error}");
        assert!(error.to_string().starts_with("nothing to draw: no finite "), "{error}");
    }
    let missing = ExponentPoint { frequency_hz: 40.0, largest_per_s: f64::NAN, ..ExponentPoint::default() };
    let diagram = ExponentDiagram { title: String::new(), points: vec![missing] };
    assert!(diagram.draw(&style).unwrap_err().to_string().contains("largest exponent"));
}
