//! Sketches of structures and their mode shapes: everything has its place on the page, and what cannot be
//! drawn is refused.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::TAU;

use hammerbeam_figure::{
    DrawnMode, ExcitationDiagram, Figure, FigureError, FrequencyUnit, ModeDiagram, SketchBeam, SketchCarrier,
    SketchEnd, SketchLayout, SketchLink, SketchLumped, SketchMotion, SketchPoint, SketchStop, StopKind,
    StructureDiagram, Style,
};

const ENDS: [SketchEnd; 4] = [SketchEnd::Clamped, SketchEnd::Pinned, SketchEnd::Sliding, SketchEnd::Free];
const KINDS: [StopKind; 6] = [
    StopKind::Sphere { loses: false },
    StopKind::Sphere { loses: true },
    StopKind::Spring,
    StopKind::Rigid,
    StopKind::TwoSided,
    StopKind::Always,
];

fn point(name: &str, at_m: f64) -> SketchPoint {
    SketchPoint { name: name.to_owned(), at_m, has_mass: true, ..SketchPoint::default() }
}

fn stop(point: &str, carrier: SketchCarrier, kind: StopKind, above: bool) -> SketchStop {
    SketchStop { point: point.to_owned(), carrier, kind, above, has_gap: true }
}

fn following(place: &str, support: usize) -> SketchMotion {
    SketchMotion { place: place.to_owned(), support }
}

/// A beam with a point for each stop.
fn beam(left: SketchEnd, right: SketchEnd, moving: &[&str], stops: Vec<SketchStop>) -> StructureDiagram {
    let points = vec![point("middle", 0.13), point("tip", 0.24)];
    StructureDiagram {
        title: "A beam".to_owned(),
        layout: SketchLayout::Beam(SketchBeam { length_m: 0.26, left, right, points }),
        stops,
        moving: moving.iter().map(|name| following(name, 0)).collect(),
        forces: Vec::new(),
        words: vec!["tip: 0.04 kg.".to_owned()],
    }
}

fn masses(count: usize) -> StructureDiagram {
    let spring = |a, b| SketchLink { between: [a, b], is_damper: false };
    let damper = |a, b| SketchLink { between: [a, b], is_damper: true };
    let mut links = vec![spring(Some(0), None), damper(None, Some(0)), damper(Some(count - 1), None)];
    for k in 1..count {
        links.extend([spring(Some(k - 1), Some(k)), damper(Some(k), Some(k - 1)), spring(Some(k), None)]);
    }
    if count > 2 {
        links.push(spring(Some(0), Some(2)));
    }
    let name = |k: usize| format!("m{k}");
    let between = SketchCarrier::Point(name(1));
    let mut stops = vec![stop("m0", SketchCarrier::Space, StopKind::Rigid, true)];
    if count > 1 {
        stops.push(stop("m0", between, StopKind::Sphere { loses: false }, true));
    }
    StructureDiagram {
        title: String::new(),
        layout: SketchLayout::Lumped(SketchLumped { masses: (0..count).map(name).collect(), links }),
        stops,
        moving: vec![following("ground", 0)],
        forces: vec!["m0".to_owned()],
        words: Vec::new(),
    }
}

/// All coordinates of lines and texts of a figure, in points on the page.
fn places(figure: &Figure) -> Vec<(f64, f64)> {
    let svg = figure.svg();
    let mut places = Vec::new();
    for data in svg.split(" d=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        // Absolute moves and lines alone; what is relative begins at one of them.
        for command in data.split_inclusive(|c: char| c.is_ascii_alphabetic()).collect::<Vec<_>>().windows(2)
        {
            let (kind, numbers) = (command[0].chars().last(), command[1]);
            if !matches!(kind, Some('M' | 'L')) {
                continue;
            }
            let numbers: Vec<f64> = numbers
                .trim_end_matches(|c: char| c.is_ascii_alphabetic())
                .split_whitespace()
                .filter_map(|number| number.parse().ok())
                .collect();
            if let [x, y] = numbers[..] {
                places.push((x, y));
            }
        }
    }
    let value = |tag: &str, key: &str| -> f64 {
        tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    places.extend(svg.split("<text ").skip(1).map(|tag| (value(tag, "x"), value(tag, "y"))));
    places
}

#[track_caller]
fn assert_on_the_page(figure: &Figure) {
    let (width, height) = (figure.width_mm() * 72.0 / 25.4, figure.height_mm() * 72.0 / 25.4);
    let places = places(figure);
    assert!(places.len() > 5);
    for (x, y) in places {
        assert!(
            (0.0..=width).contains(&x) && (0.0..=height).contains(&y),
            "({x}, {y}) of {width} x {height}"
        );
    }
}

#[test]
fn every_end_and_every_kind_of_stop_has_a_symbol_on_the_page() {
    let style = Style::single_column();
    let mut drawn: Vec<String> = Vec::new();
    for left in ENDS {
        for right in ENDS {
            let figure = beam(left, right, &[], Vec::new()).draw(&style).unwrap();
            assert_on_the_page(&figure);
            assert!(!drawn.contains(&figure.svg()), "{left:?} and {right:?} look like another pair");
            drawn.push(figure.svg());
        }
    }
    for kind in KINDS {
        for (carrier, moving) in [(SketchCarrier::Space, &[][..]), (SketchCarrier::Support(0), &["left"])] {
            for above in [false, true] {
                let stops = vec![stop("tip", carrier.clone(), kind, above)];
                let figure = beam(SketchEnd::Clamped, SketchEnd::Free, moving, stops).draw(&style).unwrap();
                assert_on_the_page(&figure);
            }
        }
    }
}

#[test]
fn supports_between_the_ends_have_a_symbol_each_whether_or_not_they_move() {
    let style = Style::single_column();
    let mut drawn: Vec<String> = Vec::new();
    for moving in [&[][..], &["middle"]] {
        for support in ENDS {
            let mut diagram = beam(SketchEnd::Pinned, SketchEnd::Pinned, moving, Vec::new());
            let SketchLayout::Beam(beam) = &mut diagram.layout else { panic!("it is a beam") };
            beam.points[0].support = support;
            let figure = diagram.draw(&style).unwrap();
            assert_on_the_page(&figure);
            assert!(!drawn.contains(&figure.svg()), "{support:?} looks like another support");
            drawn.push(figure.svg());
        }
    }
}

#[test]
fn a_stop_above_and_one_below_are_different_pictures_and_so_are_their_carriers() {
    let style = Style::single_column();
    let svg = |carrier: SketchCarrier, above: bool, has_gap: bool| {
        let stops = vec![SketchStop { has_gap, ..stop("tip", carrier, StopKind::Rigid, above) }];
        beam(SketchEnd::Clamped, SketchEnd::Free, &["left"], stops).draw(&style).unwrap().svg()
    };
    let below = svg(SketchCarrier::Support(0), false, true);
    assert_ne!(below, svg(SketchCarrier::Support(0), true, true));
    assert_ne!(below, svg(SketchCarrier::Space, false, true));
    assert_ne!(below, svg(SketchCarrier::Support(0), false, false));
    assert_ne!(below, svg(SketchCarrier::Point("middle".to_owned()), false, true));
    assert_eq!(below, svg(SketchCarrier::Support(0), false, true), "drawn twice it is the same");
}

#[test]
fn lengths_stand_on_the_sketch_in_millimetres_and_the_words_below() {
    let figure = beam(SketchEnd::Clamped, SketchEnd::Free, &["left"], Vec::new());
    let svg = figure.draw(&Style::single_column()).unwrap().svg();
    for label in [">130 mm<", ">240 mm<", ">260 mm<", ">middle<", ">tip<", ">tip: 0.04 kg.<", "A beam"] {
        assert!(svg.contains(label), "{label}");
    }
}

#[test]
fn masses_stay_on_the_page_up_to_twenty_and_more_are_refused() {
    for count in [1, 2, 3, 7, 20] {
        for style in [Style::single_column(), Style::double_column()] {
            assert_on_the_page(&masses(count).draw(&style).unwrap());
        }
    }
    let refused = masses(21).draw(&Style::double_column()).unwrap_err();
    assert_eq!(refused.to_string(), "a sketch has room for 20 masses, the structure has 21");
    let nothing = StructureDiagram { layout: SketchLayout::Lumped(SketchLumped::default()), ..masses(1) };
    assert!(matches!(nothing.draw(&Style::default()), Err(FigureError::Empty { .. })));
}

#[test]
fn a_beam_without_a_length_is_refused() {
    let mut diagram = beam(SketchEnd::Clamped, SketchEnd::Free, &[], Vec::new());
    for length_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        diagram.layout = SketchLayout::Beam(SketchBeam {
            length_m,
            left: SketchEnd::Free,
            right: SketchEnd::Free,
            points: Vec::new(),
        });
        assert!(matches!(diagram.draw(&Style::default()), Err(FigureError::Empty { .. })), "{length_m}");
    }
}

fn modes(count: usize) -> ModeDiagram {
    let places: Vec<f64> = (0..=20).map(|k| 0.013 * f64::from(k)).collect();
    let mode = |k: usize| DrawnMode {
        frequency_hz: 17.5 * (k as f64).powi(2),
        unreduced_hz: Some(17.4 * (k as f64).powi(2)),
        shape: places.iter().map(|x| (k as f64 * 6.0 * x).cos()).collect(),
    };
    let modes = (0..count).map(mode).collect();
    ModeDiagram {
        title: "Modes".to_owned(),
        is_beam: true,
        places: places.clone(),
        ends: [(true, true), (false, false)],
        points: vec![(0.24, "contact".to_owned())],
        stops: vec![(0.24, false)],
        modes,
    }
}

#[test]
fn modes_have_their_frequencies_and_a_rigid_body_says_that_it_is_one() {
    let figure = modes(3).draw(&Style::single_column()).unwrap();
    assert_on_the_page(&figure);
    let svg = figure.svg();
    for label in
        ["Mode 1: 0 Hz, moves as a rigid body", "Mode 2: 17.500 Hz (unreduced 17.400 Hz)", ">contact<"]
    {
        assert!(svg.contains(label), "{label}");
    }
    assert_eq!(figure, modes(3).draw(&Style::single_column()).unwrap());
    let mut fast = modes(3);
    (fast.modes[2].frequency_hz, fast.modes[2].unreduced_hz) = (64_602.6, Some(64_600.0));
    let svg = fast.draw(&Style::single_column()).unwrap().svg();
    for label in ["Mode 2: 17.500 Hz", "Mode 3: 64.603 kHz (unreduced 64.600 kHz)"] {
        assert!(svg.contains(label), "{label}");
    }
}

#[test]
fn of_many_modes_the_lowest_are_drawn_and_said_so() {
    let figure = modes(24).draw(&Style::single_column()).unwrap();
    assert_on_the_page(&figure);
    assert!(figure.svg().contains("The lowest 8 of 24 modes.") && !figure.svg().contains("Mode 9"));
    let masses = ModeDiagram { is_beam: false, ..modes(2) };
    assert_on_the_page(&masses.draw(&Style::single_column()).unwrap());
}

/// Labels and names that have no room would run over the edge of the paper.
#[test]
fn long_names_and_long_last_numbers_stay_on_the_page() {
    let long = "première masse with a very very long name indeed, longer than any frame of any figure in a \
                column of a journal";
    let mut named = modes(2);
    named.points = vec![(0.0, long.to_owned())];
    let figure = named.draw(&Style::single_column()).unwrap();
    assert!(figure.svg().contains("…<"), "the name is cut and says so");
    assert_in_the_width(&figure);
    // In rad/s, which take no prefix.
    let rows = [(300_000.0, 1.0), (600_000.1, 2.0)].map(|(angular, value)| (angular / TAU, value)).to_vec();
    let excitation =
        ExcitationDiagram { rows, quantity: "Amplitude (N)".to_owned(), ..ExcitationDiagram::default() };
    for mut style in [Style::single_column(), Style::double_column()] {
        style.frequency_unit = FrequencyUnit::RadPerSecond;
        let figure = excitation.draw(&style).unwrap();
        assert!(figure.svg().contains(">600\u{2009}000<"));
        assert_in_the_width(&figure);
    }
}

/// Every text ends before the edge, by the advances of Arial: no glyph of its letters and digits is wider
/// than 0.834 of the type size but M, W and m, digits are 0.556 wide.
fn assert_in_the_width(figure: &Figure) {
    let width = figure.width_mm() * 72.0 / 25.4;
    let svg = figure.svg();
    for text in svg.split("<text ").skip(1).filter(|text| !text.contains("rotate")) {
        let of = |name: &str| text.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap();
        let number = |name: &str| of(name).parse::<f64>().unwrap();
        let content = text.split('>').nth(1).unwrap().split('<').next().unwrap();
        let advance = |character: char| match character {
            '0'..='9' => 0.556,
            '\u{2009}' => 0.2,
            'i' | 'l' | 'j' | ' ' | '.' | ',' | 'f' | 't' => 0.222,
            _ => 0.5,
        };
        let long: f64 = content.chars().map(advance).sum::<f64>() * number("font-size");
        let right = number("x")
            + match of("text-anchor") {
                "start" => long,
                "middle" => 0.5 * long,
                _ => 0.0,
            };
        assert!(right <= width, "{content:?} ends at {right} of {width}");
    }
}

#[test]
fn modes_without_a_shape_are_refused() {
    let mut diagram = modes(2);
    diagram.modes.iter_mut().for_each(|mode| mode.shape[3] = f64::NAN);
    assert!(matches!(diagram.draw(&Style::default()), Err(FigureError::Empty { .. })));
    assert!(matches!(ModeDiagram::default().draw(&Style::default()), Err(FigureError::Empty { .. })));
}

#[test]
fn the_amplitude_is_drawn_from_zero_with_what_was_measured_over_it() {
    let rows: Vec<(f64, f64)> = (20..=70).map(|f| (f64::from(f), 0.02 * f64::from(f).powi(2))).collect();
    let computed = ExcitationDiagram {
        quantity: "Acceleration (m/s²)".to_owned(),
        rows,
        ..ExcitationDiagram::default()
    };
    let plain = computed.draw(&Style::single_column()).unwrap().svg();
    assert!(
        plain.contains(">Acceleration (m/s²)<") && plain.contains(">0<") && !plain.contains(">measured<")
    );
    let measured = ExcitationDiagram { measured: vec![(30.0, 17.0), (70.0, f64::NAN)], ..computed };
    assert!(measured.draw(&Style::single_column()).unwrap().svg().contains(">measured<"));
    assert!(matches!(ExcitationDiagram::default().draw(&Style::default()), Err(FigureError::Empty { .. })));
}
