//! What a figure of one's own data promises.

use hammerbeam_figure::{
    Bifurcation, DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, FigureError,
    LabelSide, Style,
};

/// A panel with series alone.
pub fn panel(series: Vec<DataSeries>) -> DataPanel {
    DataPanel::new(DataAxis::linear("Time (s)"), DataAxis::linear("Displacement (mm)"), series)
}

/// The unit circle beside a branch with all events.
pub fn circle_and_branch() -> DataDiagram {
    let circle = (0..=360).map(|k| f64::from(k).to_radians()).map(|angle| (angle.cos(), angle.sin()));
    let circle = DataPanel {
        equal_units: true,
        shaded: vec![[-1.5, 1.5, -1.5, 0.0]],
        ..DataPanel::new(
            DataAxis::linear("Real part (–)").between(-1.5, 1.5),
            DataAxis::linear("Imaginary part (–)").between(-1.5, 1.5),
            vec![DataSeries::new("unit circle", DataLook::Pale, circle)],
        )
    };
    let line = |from: i32| (from..=from + 10).map(|k| (f64::from(k), f64::from(k)));
    let event = |k: i32, name: &str, event| {
        DataSeries::new(name, DataLook::Events(event), [(f64::from(k), f64::from(k))])
    };
    let branch = DataPanel {
        width: 2.0,
        levels: vec![5.0],
        uprights: vec![5.0],
        labels: vec![DataLabel { at: (5.0, 5.0), text: "half way".into(), side: LabelSide::Above }],
        ..panel(vec![
            DataSeries::new("stable", DataLook::Stable, line(0)),
            DataSeries::new("unstable", DataLook::Unstable, line(10)),
            DataSeries::new("stable", DataLook::Stable, line(20)),
            event(2, "fold", Bifurcation::Fold),
            event(4, "flip", Bifurcation::Flip),
            event(6, "Neimark–Sacker", Bifurcation::NeimarkSacker),
            event(8, "grazing", Bifurcation::Grazing),
            DataSeries::new("dots", DataLook::Dots(1), line(0)),
            DataSeries::new("circles", DataLook::Circles(2), line(10)),
            DataSeries::new("specks", DataLook::Specks(3), line(20)),
        ])
    };
    DataDiagram { panels: vec![circle, branch], description: "a circle and a branch".into() }
}

fn drawn() -> Figure {
    circle_and_branch().draw(&Style::double_column()).unwrap()
}

/// The points of the path with the most of them.
fn longest_path(svg: &str) -> Vec<[f64; 2]> {
    let paths = svg.split("<path d=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    let path = paths.max_by_key(|data| data.matches('L').count()).unwrap();
    let pair = |text: &str| {
        let (x, y) = text.split_once(' ').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    path.trim_start_matches('M').split('L').map(pair).collect()
}

/// Of a frame of 3 by 3 the circle takes two thirds, in both directions.
#[test]
fn with_equal_units_a_circle_is_round() {
    let points = longest_path(&drawn().svg());
    let extent = |k: usize| {
        let values = points.iter().map(|point| point[k]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    assert!((extent(0) - extent(1)).abs() < 0.02, "{} by {}", extent(0), extent(1));
    assert!(extent(0) > 50.0, "{}", extent(0));
}

#[test]
fn every_series_has_one_entry_in_the_legend_and_every_label_is_there() {
    let svg = drawn().svg();
    for name in
        ["stable", "unstable", "fold", "flip", "Neimark–Sacker", "grazing", "dots", "circles", "specks"]
    {
        assert_eq!(svg.matches(&format!(">{name}<")).count(), 1, "{name}");
    }
    assert_eq!(svg.matches(">half way<").count(), 1);
    assert_eq!(svg.matches("<desc>a circle and a branch</desc>").count(), 1);
}

/// Each panel is moved to its place; the frames have one height.
#[test]
fn panels_stand_side_by_side() {
    let series = || vec![DataSeries::new("", DataLook::Line(0), [(0.0, 0.0), (1.0, 1.0)])];
    let diagram = DataDiagram {
        panels: vec![DataPanel { heading: "Higher head".into(), ..panel(series()) }, panel(series())],
        description: "two panels".into(),
    };
    let svg = diagram.draw(&Style::double_column()).unwrap().svg();
    let columns: Vec<&str> = svg.split("<g transform=\"translate(").skip(1).collect();
    let rights = columns.iter().map(|column| column.split(' ').next().unwrap().parse().unwrap());
    let rights: Vec<f64> = rights.collect();
    // 174 mm less a gap of 8 pt, halved, and the gap.
    let second = 0.5 * (174.0 * 72.0 / 25.4 - 8.0) + 8.0;
    assert!(rights.len() == 2 && rights[0] == 0.0 && (rights[1] - second).abs() < 0.01, "{rights:?}");
    let frame = |column: &str| {
        let data = column.split("<path d=\"").map(|rest| rest.split('"').next().unwrap());
        data.into_iter().find(|data| data.contains('H') && data.ends_with('z')).unwrap().to_owned()
    };
    assert_eq!(frame(columns[0]), frame(columns[1]));
}

#[test]
fn a_figure_without_a_panel_is_refused() {
    let refused = DataDiagram::default().draw(&Style::default());
    assert_eq!(refused.unwrap_err(), FigureError::NoQuantity);
}
