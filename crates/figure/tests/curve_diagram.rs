//! What a diagram of curves promises to those who draw it.
#![allow(clippy::unwrap_used, reason = "tests")]

use hammerbeam_figure::{
    Bifurcation, BifurcationCurve, BifurcationCurvePoint, CurveDiagram, FigureError, FrequencyUnit,
    ParameterAxis, Style,
};

fn point(parameter: f64, frequency_hz: f64, name: &str) -> BifurcationCurvePoint {
    BifurcationCurvePoint { parameter, frequency_hz, name: name.to_owned() }
}

/// Two folds that meet in a cusp, and a flip that crosses one of them.
fn diagram() -> CurveDiagram {
    let folds: Vec<BifurcationCurvePoint> = (-40..=40)
        .map(|k| {
            let s = f64::from(k) / 40.0;
            point(1e-3 * (1.0 + s * s), 30.0 + 3.0 * s * s + s * s * s, if k == 0 { "cusp" } else { "" })
        })
        .collect();
    let flips = vec![point(1e-3, 33.0, ""), point(1.8e-3, 33.1, "fold–flip"), point(2e-3, 33.2, "")];
    let curve = |bifurcation, points| BifurcationCurve { bifurcation, period_multiple: 1, points };
    CurveDiagram {
        title: "Two curves".into(),
        parameter: ParameterAxis { title: "Gap of stop 1".into(), unit: "m".into() },
        curves: vec![curve(Bifurcation::Fold, folds), curve(Bifurcation::Flip, flips)],
    }
}

#[test]
fn every_curve_is_in_the_legend_and_every_point_of_codimension_two_has_its_name() {
    let figure = diagram().draw(&Style::default()).unwrap();
    let svg = figure.svg();
    for text in
        [">fold<", ">flip<", ">cusp<", ">fold–flip<", "Gap of stop 1 (mm)", "Excitation frequency (Hz)"]
    {
        assert!(svg.contains(text), "{text} is missing");
    }
    assert!(!svg.contains("Neimark"));
    assert!(figure.description().contains("marked: cusp, fold–flip"), "{}", figure.description());
    assert!(figure.png(150.0).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(svg, diagram().draw(&Style::default()).unwrap().svg());
}

/// Gaps of nanometres and frequencies of kilohertz are read in these units.
#[test]
fn units_suit_both_ranges() {
    let mut small = diagram();
    for point in small.curves.iter_mut().flat_map(|curve| &mut curve.points) {
        point.parameter *= 1e-5;
        point.frequency_hz *= 2000.0;
    }
    let svg = small.draw(&Style::default()).unwrap().svg().to_owned();
    for text in [">Gap of stop 1 (nm)<", ">12<", ">20<", ">Excitation frequency (kHz)<", ">60<"] {
        assert!(svg.contains(text), "{text} is missing");
    }
    let angular = Style::default().showing(FrequencyUnit::RadPerSecond);
    assert!(small.draw(&angular).unwrap().svg().contains(">Excitation frequency (rad/s)<"));
}

/// A point that two curves share is named once.
#[test]
fn a_point_of_two_curves_has_one_name() {
    let mut both = diagram();
    both.curves[0].points[70].name = "fold–flip".into();
    let at = both.curves[0].points[70].clone();
    both.curves[1].points[1] = at;
    let svg = both.draw(&Style::default()).unwrap().svg();
    assert_eq!(svg.matches(">fold–flip<").count(), 1);
}

#[test]
fn a_diagram_without_a_finite_point_is_refused() {
    let nothing = CurveDiagram { curves: vec![BifurcationCurve::default()], ..CurveDiagram::default() };
    assert!(matches!(nothing.draw(&Style::default()), Err(FigureError::Empty { .. })));
    let mut lost = diagram();
    lost.curves.iter_mut().flat_map(|curve| &mut curve.points).for_each(|point| point.parameter = f64::NAN);
    assert!(matches!(lost.draw(&Style::default()), Err(FigureError::Empty { .. })));
}
