//! What the figures of motions, multipliers and orbits promise to those who draw them.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::{f64::consts::TAU, io::Read};

use hammerbeam_figure::{
    BasinMap, ConvergenceDiagram, Destination, ExponentDiagram, ExponentPoint, Figure, FigureError,
    FilteredAcceleration, MotionKind, MultiplierDiagram, Multipliers, OrbitDiagram, OrbitImpulse,
    OrbitSample, Origin, Quantity, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseSettings,
    ScaleChoice, SectionDiagram, Style, SweepDiagram, SweptMotion,
};

fn basins() -> BasinMap {
    let destination = |kind, branch, places| Destination { kind, branch, places };
    BasinMap {
        title: "Basins".to_owned(),
        x_label: "Initial displacement (mm)".to_owned(),
        y_label: "Initial velocity (m/s)".to_owned(),
        x_range: (-1.0, 1.0),
        y_range: (0.0, 2.0),
        cells_along: 2,
        cells: vec![1, 2, 1, 0],
        attractors: vec![
            destination(MotionKind::Periodic { period: 3 }, Some(2), vec![(0.5, 0.5)]),
            destination(MotionKind::Chaotic, None, vec![]),
        ],
    }
}

fn sweep() -> SweepDiagram {
    let motion = |origin, frequency_hz: f64, kind, samples_m: &[f64]| SweptMotion {
        origin,
        frequency_hz,
        kind,
        samples_m: samples_m.to_vec(),
        max_displacement_m: 2e-3,
    };
    let periodic = MotionKind::Periodic { period: 1 };
    let cloud: Vec<f64> = (0..100).map(|k| 1e-3 * f64::from(k) / 100.0).collect();
    SweepDiagram {
        title: "Sweep".to_owned(),
        motions: vec![
            motion(Origin::Up, 20.0, periodic, &[1e-3]),
            motion(Origin::Up, 21.0, MotionKind::Chaotic, &cloud),
            motion(Origin::Down, 21.0, periodic, &[0.5e-3, f64::NAN]),
        ],
    }
}

fn exponents() -> ExponentDiagram {
    let point = |frequency_hz, largest_per_s| ExponentPoint {
        frequency_hz,
        largest_per_s,
        half_width_per_s: 1.0,
        dimension: 2.0,
    };
    ExponentDiagram { title: String::new(), points: vec![point(40.0, -3.0), point(41.0, 8.0)] }
}

fn convergence() -> ConvergenceDiagram {
    let places = (1..50).map(f64::from).map(|time| (time, vec![1.0 + 1.0 / time, -1.0, f64::NAN]));
    ConvergenceDiagram { title: String::new(), frequency_hz: 40.0, places: places.collect() }
}

fn section() -> SectionDiagram {
    SectionDiagram { title: String::new(), frequency_hz: 40.0, points: vec![(1e-3, 0.1), (2e-3, -0.1)] }
}

fn multipliers() -> MultiplierDiagram {
    let solution = |frequency_hz: f64| {
        let (re, im) = (0.02 * frequency_hz, 0.3);
        let multipliers = vec![[re, im], [re, -im]];
        Multipliers { frequency_hz, stable: re.hypot(im) < 1.0, multipliers }
    };
    let solutions = (20..70).map(f64::from).map(solution).collect();
    MultiplierDiagram { title: String::new(), solutions }
}

/// A motion with two harmonics, of 10 and 30 Hz.
fn orbit() -> OrbitDiagram {
    let sample = |j: i32| {
        let t = TAU * f64::from(j) / 256.0;
        OrbitSample {
            displacement_m: 1e-3 * t.cos(),
            velocity_m_s: -t.sin(),
            acceleration_m_s2: 100.0 * t.cos() + 10.0 * (3.0 * t).cos(),
            forces_n: vec![t.cos().max(0.0), 0.0],
            support_m: Some(1e-4 * t.cos()),
        }
    };
    OrbitDiagram {
        title: "Orbit".to_owned(),
        frequency_hz: 10.0,
        period_multiple: 1,
        samples: (0..256).map(sample).collect(),
        impulses: Vec::new(),
        filtered: None,
        eigenfrequencies_hz: vec![18.0],
    }
}

/// The same with two rigid stops, of which each is struck once.
fn struck() -> OrbitDiagram {
    let impulse = |element: usize, cycles: f64| OrbitImpulse {
        element,
        cycles,
        impulse_n_s: -0.5 - cycles,
        displacement_m: 1e-3 * (TAU * cycles).cos(),
        velocity_m_s: [-(TAU * cycles).sin(), 0.4],
        acceleration_m_s2: [50.0, 40.0],
    };
    let samples = orbit().samples.into_iter();
    let samples = samples.map(|sample| OrbitSample { forces_n: vec![0.0; 2], ..sample }).collect();
    OrbitDiagram { samples, impulses: vec![impulse(0, 0.2), impulse(1, 0.7)], ..orbit() }
}

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
        ("history with impulses", struck().draw_history(&style).unwrap()),
        ("phase with impulses", struck().draw_phase(&style).unwrap()),
        ("spectrum with impulses", struck().draw_spectrum(&style).unwrap()),
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

/// Of each line of text the PDF has the first letter, at the place where the SVG has it, and of each path one that is painted.
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
fn impulses_stand_in_a_panel_of_their_own_with_their_unit() {
    let history = struck().draw_history(&Style::double_column()).unwrap();
    let (svg, words) = (history.svg(), "impulses of 2 impacts on rigid stops: 0.7, 1.2 N s");
    assert!(svg.contains(">Impulse (N s)<") && !svg.contains("Local force"), "no force acts over a time");
    assert!(svg.contains(words) && history.description().contains(words));
    assert!(svg.contains(">impulse of local element 2<"));
    let phase = struck().draw_phase(&Style::single_column()).unwrap().svg();
    assert!(phase.contains(">jump at an impact<"));
    let without = orbit().draw_phase(&Style::single_column()).unwrap().svg();
    assert!(!without.contains("jump at an impact"));
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
fn basins_name_class_period_branch_and_fraction() {
    let svg = basins().draw(&Style::single_column()).unwrap().svg();
    for words in
        ["1: period 3, branch 2, 50.0\u{2009}%", "2: chaotic, 25.0\u{2009}%", "not computed, 25.0\u{2009}%"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert!(svg.contains("attractor at phase 0"));
    let unfinished = BasinMap { cells: vec![1, 2, 1], ..basins() }.draw(&Style::default()).unwrap();
    assert!(unfinished.description().ends_with("1 cells are not done yet"), "{}", unfinished.description());
}

#[test]
fn each_direction_of_a_sweep_has_its_panel_and_each_kind_its_name() {
    let svg = sweep().draw(&Style::default()).unwrap().svg();
    for words in
        ["frequency rising", "frequency falling", ">periodic<", ">chaotic<", "maximum, frequency falling"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert!(!svg.contains("quasi-periodic") && !svg.contains("several initial states"));
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
    let solution = Multipliers { frequency_hz: 40.0, stable: true, multipliers };
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

#[test]
fn a_spectrum_has_the_harmonics_of_the_motion_alone() {
    let svg = orbit().draw_spectrum(&Style::default()).unwrap().svg();
    // Those of 10 and 30 Hz, two arcs for the dot of each; all others are rounding, below 1e-5 of the largest.
    assert_eq!(svg.matches("a0.9 0.9 0 1 0").count(), 4);
    assert!(svg.contains(">harmonic<") && svg.contains(">eigenfrequency<"));
}

#[test]
fn chaotic_ranges_are_shaded_and_named() {
    let point = |frequency_hz| ResponsePoint {
        frequency_hz,
        displacement_m: 1e-3,
        stable: true,
        ..ResponsePoint::default()
    };
    let curve = ResponseCurve { period_multiple: 1, points: vec![point(20.0), point(30.0)] };
    let plain = ResponseDiagram { curves: vec![curve], ..ResponseDiagram::default() };
    let shaded = ResponseDiagram { chaotic_ranges_hz: vec![(22.0, 24.0), (90.0, 95.0)], ..plain.clone() };
    let [plain, shaded] = [plain, shaded].map(|diagram| diagram.draw(Quantity::Displacement).unwrap());
    assert!(!plain.svg().contains("chaotic") && shaded.svg().contains(">chaotic motion found<"));
    assert!(shaded.description().contains("chaotic motion found at 22.000 to 24.000 Hz"));
    // What lies outside the axis is cut off: one rectangle, and the sample of the legend.
    assert_eq!(shaded.svg().matches("fill=\"#f8ebd5\"").count(), 2);
}

#[test]
fn a_filtered_acceleration_has_a_panel_of_its_own_with_the_cut_off() {
    let plain = orbit().draw_history(&Style::double_column()).unwrap();
    let filtered = FilteredAcceleration { cut_off_hz: 20.0, values_m_s2: vec![7.0; 256] };
    let with =
        OrbitDiagram { filtered: Some(filtered), ..orbit() }.draw_history(&Style::double_column()).unwrap();
    assert!(with.svg().contains("low-pass filter of 20 Hz") && !plain.svg().contains("low-pass"));
    assert!(with.height_mm() > plain.height_mm());
    let other = FilteredAcceleration { cut_off_hz: 20.0, values_m_s2: Vec::new() };
    let refused = OrbitDiagram { filtered: Some(other), ..orbit() }.draw_history(&Style::double_column());
    assert!(refused.unwrap_err().to_string().contains("no finite filtered acceleration"));
}

#[test]
fn the_support_is_drawn_over_the_displacement_and_named() {
    let svg = orbit().draw_history(&Style::double_column()).unwrap().svg();
    assert!(svg.contains(">response point<") && svg.contains(">support<"));
    let still = |sample: &OrbitSample| OrbitSample { support_m: None, ..sample.clone() };
    let still = OrbitDiagram { samples: orbit().samples.iter().map(still).collect(), ..orbit() };
    assert!(!still.draw_history(&Style::double_column()).unwrap().svg().contains(">support<"));
}

/// Of an orbit of three excitation periods the section has three points, and they stand in the portrait as well.
#[test]
fn the_section_of_an_orbit_has_as_many_points_as_excitation_periods() {
    let svg =
        OrbitDiagram { period_multiple: 3, ..orbit() }.draw_phase(&Style::single_column()).unwrap().svg();
    assert!(svg.contains(">phase portrait<") && svg.contains(">Poincaré section<"));
    let dots = svg.split(" d=\"").map(|rest| rest.split('"').next().unwrap().matches(" 0 1 0 ").count() / 2);
    assert_eq!(dots.filter(|circles| *circles == 3).count(), 2, "three dots in each of the two frames");
}

/// Contact forces and impact velocities have their axes; without a contact there is nothing on a logarithmic one.
#[test]
fn contact_forces_and_impact_velocities_have_their_diagrams() {
    let point = |k: i32, force: f64| ResponsePoint {
        frequency_hz: f64::from(k),
        contact_force_n: force,
        impact_velocity_m_s: 1e-3 * force,
        stable: true,
        ..ResponsePoint::default()
    };
    let diagram = |force: f64| ResponseDiagram {
        curves: vec![ResponseCurve { period_multiple: 1, points: (1..9).map(|k| point(k, force)).collect() }],
        ..ResponseDiagram::default()
    };
    assert!(diagram(5.0).draw(Quantity::ContactForce).unwrap().svg().contains("Largest contact force (N)"));
    assert!(diagram(5.0).draw(Quantity::ImpactVelocity).unwrap().svg().contains("impact velocity (m/s)"));
    let settings =
        ResponseSettings { contact_scale: ScaleChoice::Logarithmic, ..ResponseSettings::default() };
    assert!(diagram(0.0).draw_with(&[Quantity::ContactForce], &settings).is_err());
}

#[test]
fn branches_over_another_parameter_say_which() {
    let point = |k: i32| ResponsePoint {
        frequency_hz: 0.1 * f64::from(k),
        displacement_m: 1e-3,
        ..ResponsePoint::default()
    };
    let curve = ResponseCurve { period_multiple: 1, points: (1..9).map(point).collect() };
    let diagram = ResponseDiagram {
        parameter: "Gap of stop 1 (m)".to_owned(),
        curves: vec![curve],
        ..ResponseDiagram::default()
    };
    let figure = diagram.draw(Quantity::Displacement).unwrap();
    assert!(figure.svg().contains(">Gap of stop 1 (m)<") && !figure.svg().contains("Excitation frequency"));
    assert!(figure.description().contains("over Gap of stop 1 (m)"));
}
