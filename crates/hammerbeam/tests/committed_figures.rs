//! The figures of the book are those that the example `book_figures` draws; it checks the formulas of the
//! book while it draws.

use std::{fs, path::Path};

use crate::book_figures;

/// Figures of whole branches and of chaos: another machine may take other points of the same curve or set.
/// With each the largest distance (pt) of a point of one picture from the lines and dots of the other. The
/// branches are dense. Of four chaotic motions, with transients of 200, 3000, 5000 and 12 000 periods, the
/// averages come as far as 15 pt from those of the first, and the section 4.2 pt.
const BY_DISTANCE: [(&str, f64); 4] =
    [("shooting", 2.0), ("grazing", 2.0), ("exponents-convergence", 20.0), ("exponents-section", 6.0)];
/// Coordinates of all others have two decimals (pt).
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

/// The places of a path that its data name absolutely: those of a line, or where a mark starts.
fn places(data: &str) -> Vec<[f64; 2]> {
    let starts = data.split(['M', 'L']).skip(1);
    let pair = |text: &str| {
        let mut numbers =
            text.split(|character: char| !(character.is_ascii_digit() || "-.".contains(character)));
        let mut next = || numbers.next().and_then(|number| number.parse().ok());
        [next().unwrap(), next().unwrap()]
    };
    starts.map(pair).collect()
}

/// Lines and marks of a panel, as pairs of places.
fn strokes(panel: &str) -> Vec<[[f64; 2]; 2]> {
    let paths = panel.split("<path d=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
    let subpaths = paths.flat_map(|data| data.split('M').skip(1).map(|part| places(&format!("M{part}"))));
    let lines = subpaths.flat_map(|places| match places[..] {
        [place] => vec![[place, place]],
        _ => places.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
    });
    lines.collect()
}

/// The distance of a place from a stroke.
fn distance([x, y]: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let (along, place) = ([to[0] - from[0], to[1] - from[1]], [x - from[0], y - from[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 { (along[0] * place[0] + along[1] * place[1]) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (place[0] - share * along[0]).hypot(place[1] - share * along[1])
}

/// The largest distance of an end of a stroke of one picture from the strokes of another, panel by panel.
fn largest_distance(one: &str, other: &str) -> f64 {
    let panels = one.split("<g transform=").zip(other.split("<g transform="));
    let of_panels = panels.flat_map(|(one, other)| {
        let (one, other) = (strokes(one), strokes(other));
        let nearest =
            move |place| other.iter().map(|stroke| distance(place, *stroke)).fold(f64::INFINITY, f64::min);
        one.into_iter().flatten().map(nearest)
    });
    of_panels.fold(0.0, f64::max)
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
        if let Some((_, most)) = BY_DISTANCE.iter().find(|(name, _)| file.ends_with(&format!("{name}.svg"))) {
            let off = largest_distance(&committed, &drawn).max(largest_distance(&drawn, &committed));
            assert!(off <= *most, "{file} is off by {off} pt");
            continue;
        }
        let ((ours, between), (theirs, of_theirs)) = (numbers(&drawn), numbers(&committed));
        assert!(between == of_theirs && ours.len() == theirs.len(), "{file} has other elements");
        let off = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= TOLERANCE, "{file} is off by {off} pt");
    }
}

#[test]
fn a_line_that_is_moved_is_found() {
    let picture = |height: f64| format!("<path d=\"M0 {height}L10 {height}\"/><path d=\"M5 7l1 1z\"/>");
    assert_eq!(largest_distance(&picture(2.0), &picture(2.5)), 0.5);
    assert_eq!(largest_distance("<path d=\"M5 2\"/>", &picture(2.5)), 0.5);
}
