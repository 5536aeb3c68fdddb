//! Figures of multipliers.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_figure::{MultiplierDiagram, Multipliers, Style};

use super::samples::multipliers;

#[test]
fn multipliers_that_are_infinite_are_left_out_and_counted() {
    let mut diagram = multipliers();
    diagram.solutions[3].multipliers[0] = [f64::INFINITY, 0.0];
    diagram.solutions[4].multipliers[1] = [f64::NAN, 0.0];
    diagram.solutions[5].multipliers = vec![[50.0, 0.0], [1e-9, 0.0]];
    let style = Style::single_column();
    for figure in [diagram.draw_moduli(&style).unwrap(), diagram.draw_circle(&style).unwrap()] {
        assert!(figure.description().contains("not finite: 2"), "{}", figure.description());
        let drawing = without_fonts(&figure.svg());
        assert!(!drawing.contains("inf") && !drawing.contains("NaN"));
    }
    let circle = diagram.draw_circle(&style).unwrap();
    assert!(circle.svg().contains("1 of 98 multipliers lie outside the frame"));
}

/// The document without its fonts.
fn without_fonts(svg: &str) -> String {
    let (head, rest) = svg.split_once("<style>@font-face").expect("the fonts that it uses");
    let (_, rest) = rest.split_once("</style>\n").expect("their end");
    [head, rest].concat()
}

/// Three real multipliers and a pair behind them: the pair stays whole.
#[test]
fn of_a_pair_both_are_drawn() {
    let multipliers = vec![[0.9, 0.0], [-0.8, 0.0], [0.7, 0.0], [0.1, 0.5], [0.1, -0.5], [0.2, 0.0]];
    let solution = Multipliers { frequency_hz: 40.0, stable: true, marginal: false, multipliers };
    let diagram = MultiplierDiagram { title: String::new(), solutions: vec![solution] };
    let svg = diagram.draw_circle(&Style::single_column()).unwrap().svg();
    assert_eq!(svg.matches("a0.6 0.6 0 1 0").count(), 10, "two arcs for each of five dots");
}

#[test]
fn a_branch_of_one_point_is_dots() {
    let mut diagram = multipliers();
    diagram.solutions.truncate(1);
    let svg = diagram.draw_moduli(&Style::default()).unwrap().svg();
    assert!(svg.contains("0 1 0"), "an arc of a circle");
}

/// The circle of radius one about the origin has the same size across and up.
#[test]
fn the_unit_circle_is_round() {
    let svg = multipliers().draw_circle(&Style::single_column()).unwrap().svg();
    let is_circle = |line: &&str| line.starts_with("<path d=\"M") && line.matches('L').count() > 20;
    let line = svg.lines().find(is_circle).unwrap();
    let data = line.split('"').nth(1).unwrap();
    let points: Vec<(f64, f64)> = data[1..]
        .split('L')
        .map(|pair| pair.split_once(' ').unwrap())
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    let size = |values: Vec<f64>| {
        values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
    };
    let (width, height) =
        (size(points.iter().map(|p| p.0).collect()), size(points.iter().map(|p| p.1).collect()));
    // Coordinates have two decimals, and the line is simplified to 0.024 pt.
    assert!((width - height).abs() < 0.07 && width > 50.0, "{width} {height}");
}
