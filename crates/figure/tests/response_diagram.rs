//! What a response diagram promises to those who draw it.

use proptest::prelude::*;

use hammerbeam_figure::{
    Figure, FigureError, MeasuredMark, MeasuredMotion, ResponseCurve, ResponseDiagram, ResponsePoint,
    ResponseQuantity, ResponseSettings, ScaleChoice, Style,
};

fn point(frequency_hz: f64, displacement_mm: f64) -> ResponsePoint {
    let (displacement_m, acceleration_m_s2) = (1e-3 * displacement_mm, 1e2 * displacement_mm);
    ResponsePoint {
        frequency_hz,
        displacement_m,
        acceleration_m_s2,
        stable: true,
        ..ResponsePoint::default()
    }
}

fn diagram(curves: &[(u32, &[ResponsePoint])]) -> ResponseDiagram {
    let curve = |&(period_multiple, points): &(u32, &[ResponsePoint])| ResponseCurve {
        period_multiple,
        points: points.to_vec(),
    };
    ResponseDiagram {
        title: String::new(),
        curves: curves.iter().map(curve).collect(),
        frequency_range_hz: None,
        ..ResponseDiagram::default()
    }
}

/// Up to a fold at 40 Hz, back to 36 Hz unstable, a grazing touch, a fold, and on.
fn folded_branch() -> Vec<ResponsePoint> {
    let unstable = |point| ResponsePoint { stable: false, ..point };
    vec![
        point(20.0, 0.5),
        point(30.0, 1.5),
        ResponsePoint { fold: true, ..point(40.0, 5.0) },
        ResponsePoint { grazing: true, ..unstable(point(38.0, 3.0)) },
        ResponsePoint { fold: true, ..unstable(point(36.0, 2.0)) },
        point(45.0, 1.0),
        point(60.0, 0.8),
    ]
}

fn displacement(diagram: &ResponseDiagram) -> Figure {
    diagram.draw(ResponseQuantity::Displacement).expect("there is something to draw")
}

#[test]
fn drawn_twice_a_figure_is_byte_for_byte_the_same() {
    let diagram = diagram(&[(1, &folded_branch()), (2, &folded_branch())]);
    let (first, second) = (diagram.draw_both().unwrap(), diagram.draw_both().unwrap());
    assert_eq!(first.svg(), second.svg());
    assert_eq!(first.png(150.0).unwrap(), second.png(150.0).unwrap());
}

/// The document without its fonts.
fn without_fonts(svg: &str) -> String {
    let (head, rest) = svg.split_once("<style>@font-face").expect("the fonts that it uses");
    let (_, rest) = rest.split_once("</style>\n").expect("their end");
    [head, rest].concat()
}

#[test]
fn svg_of_a_folded_branch() {
    insta::assert_snapshot!(without_fonts(&displacement(&diagram(&[(1, &folded_branch())])).svg()));
}

#[test]
fn the_legend_explains_what_is_drawn_and_nothing_else() {
    let svg = displacement(&diagram(&[(1, &folded_branch())])).svg();
    for name in ["stable", "unstable", "fold", "grazing"] {
        assert!(svg.contains(&format!(">{name}</text>")), "{name}");
    }
    for name in ["harmonic", "flip", "Neimark–Sacker", "branch point"] {
        assert!(!svg.contains(&format!(">{name}</text>")), "{name}");
    }
    let svg = displacement(&diagram(&[(1, &[point(20.0, 1.0)]), (3, &[point(30.0, 1.0)])])).svg();
    assert!(svg.contains(">harmonic</text>") && svg.contains(">1/3 subharmonic</text>"));
    assert!(!svg.contains(">unstable</text>") && !svg.contains(">1/2 subharmonic</text>"));
}

#[test]
fn measured_points_beyond_the_axes_are_counted() {
    let mark = |frequency_hz: f64, motion: MeasuredMotion| MeasuredMark {
        frequency_hz,
        displacement_m: Some(1e-3),
        acceleration_m_s2: None,
        motion,
    };
    let periodic = [20.0, 30.0, 60.0, 61.0, 19.0].map(|f| mark(f, MeasuredMotion::Periodic));
    let aperiodic = [mark(70.0, MeasuredMotion::Aperiodic)];
    let mut over = diagram(&[(1, &folded_branch())]);
    over.frequency_range_hz = Some((20.0, 60.0));
    over.measured = [&periodic[..3], &[mark(40.0, MeasuredMotion::Unknown)]].concat();
    let all = displacement(&over).svg().to_owned();
    assert!(all.contains(">measured, periodic<") && !all.contains("beyond"));
    over.measured.extend(periodic[3..].iter().chain(&aperiodic));
    let figure = displacement(&over);
    for entry in
        ["periodic (2 beyond the axes)<", "aperiodic (1 beyond the axes)<", ">measured, kind unknown<"]
    {
        assert!(figure.svg().contains(entry), "{entry}");
    }
    let words = "measured, periodic: 3 of maximum displacement, 2 more beyond the axes; \
                 measured, aperiodic: 0 of maximum displacement, 1 more";
    assert!(figure.svg().contains(words), "{}", figure.svg());
    // What was not measured is not beyond anything.
    let acceleration = over.draw(ResponseQuantity::Acceleration).unwrap();
    assert!(!acceleration.svg().contains("beyond"));
}

#[test]
fn axes_have_units_and_unstable_lines_are_dashed() {
    let diagram = diagram(&[(1, &folded_branch())]);
    let both = diagram.draw_both().unwrap().svg();
    for unit in ["frequency (Hz)", "| (mm)", "| (m/s²)"] {
        assert!(both.contains(unit), "{unit}");
    }
    assert_eq!(
        displacement(&diagram).svg().matches("stroke-dasharray").count(),
        2,
        "one line and its sample"
    );
}

#[test]
fn nothing_to_draw_is_an_error_that_says_so() {
    let empty = diagram(&[]).draw(ResponseQuantity::Displacement).unwrap_err();
    assert!(matches!(empty, FigureError::Empty { curves: 0, points: 0, .. }));
    let nan = diagram(&[(1, &[point(20.0, f64::NAN), point(f64::INFINITY, 1.0)])]).draw_both().unwrap_err();
    assert_eq!(
        nan.to_string(),
        "nothing to draw: no finite maximum displacement inside the axes (points given: 2, branches: 1)"
    );
    let elsewhere =
        ResponseDiagram { frequency_range_hz: Some((70.0, 90.0)), ..diagram(&[(1, &folded_branch())]) };
    assert!(matches!(
        elsewhere.draw(ResponseQuantity::Acceleration),
        Err(FigureError::Empty { points: 7, .. })
    ));
    assert_eq!(elsewhere.draw_with(&[], &ResponseSettings::default()), Err(FigureError::NoQuantity));
}

#[test]
fn a_frequency_axis_that_is_no_axis_is_refused() {
    for range in [(50.0, 50.0), (60.0, 20.0), (f64::NAN, 20.0), (0.0, f64::INFINITY)] {
        let diagram =
            ResponseDiagram { frequency_range_hz: Some(range), ..diagram(&[(1, &folded_branch())]) };
        assert!(matches!(diagram.draw_both(), Err(FigureError::AxisRange { .. })), "{range:?}");
    }
}

#[test]
fn a_single_solution_is_a_dot_and_a_solution_between_gaps_too() {
    let dots = |svg: &str| svg.matches("a0.9 0.9 0 1 0").count();
    assert_eq!(dots(&displacement(&diagram(&[(1, &[point(20.0, 1.0)])])).svg()), 2, "two halves of a circle");
    let mut points = folded_branch();
    points.extend([point(f64::NAN, 1.0), point(62.0, 0.7), point(63.0, f64::NAN)]);
    let svg = displacement(&diagram(&[(1, &points)])).svg();
    assert_eq!(dots(&svg), 2);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn zero_is_a_gap_on_a_logarithmic_axis() {
    let points = [point(20.0, 1.0), point(21.0, 2.0), point(22.0, 0.0), point(23.0, 3.0), point(24.0, 2.0)];
    let settings =
        ResponseSettings { displacement_scale: ScaleChoice::Logarithmic, ..ResponseSettings::default() };
    let draw = |settings| {
        diagram(&[(1, &points)]).draw_with(&[ResponseQuantity::Displacement], settings).unwrap().svg()
    };
    let lines = |svg: &str| svg.matches("<path d=\"M").count();
    let (gap, no_gap) = (draw(&settings), draw(&ResponseSettings::default()));
    let data = |svg: &str| svg.split("stroke=\"#23276a\"").last().map(lines);
    assert_eq!((data(&gap), data(&no_gap)), (Some(2), Some(1)));
}

#[test]
fn markup_in_the_title_is_only_text() {
    let title = "a < b & \"c\" <script>\u{1}</svg>".to_owned();
    let figure = displacement(&ResponseDiagram { title, ..diagram(&[(1, &folded_branch())]) });
    assert!(figure.svg().contains("a &lt; b &amp; &quot;c&quot; &lt;script&gt;\u{fffd}&lt;/svg&gt;"));
    figure.png(72.0).unwrap();
}

#[test]
fn a_png_has_the_size_on_paper_times_the_resolution_and_says_so() {
    let png = displacement(&diagram(&[(1, &folded_branch())])).png(300.0).unwrap();
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!((number(16), number(20)), (2055, 1122), "174 mm by 95 mm at 300 pixels per inch");
    assert_eq!(&png[37..41], b"pHYs");
    assert_eq!((number(41), number(45), png[49]), (11811, 11811, 1), "pixels per metre");
}

#[test]
fn the_font_is_found_for_the_png() {
    let with_title = |title: &str| {
        let diagram = ResponseDiagram { title: title.to_owned(), ..diagram(&[(1, &folded_branch())]) };
        displacement(&diagram).png(100.0).unwrap()
    };
    assert_ne!(with_title("W"), with_title("i"));
}

#[test]
fn a_hundred_thousand_solutions_and_thousands_of_events_stay_small() {
    let wave = |i: u32| {
        let s = f64::from(i) / 1e5;
        let fine = (5e3 * s).sin();
        let folded = point(20.0 + 80.0 * s + 0.1 * fine, 1.0 + 0.9 * (40.0 * s).sin() + 0.02 * fine);
        ResponsePoint {
            stable: !(i / 20).is_multiple_of(3),
            fold: i.is_multiple_of(63),
            grazing: i.is_multiple_of(50),
            ..folded
        }
    };
    let points: Vec<ResponsePoint> = (0..100_000).map(wave).collect();
    let figure = displacement(&diagram(&[(1, &points)]));
    assert!(figure.svg().len() < 1_000_000, "{} bytes", figure.svg().len());
    assert!(figure.description().contains("grazing of maximum displacement: 2000, marked at "));
}

#[test]
fn a_single_column_is_as_wide_as_one() {
    let settings = ResponseSettings { style: Style::single_column(), ..ResponseSettings::default() };
    let quantities = [ResponseQuantity::Displacement];
    let figure = diagram(&[(1, &folded_branch())]).draw_with(&quantities, &settings).unwrap();
    assert_eq!((figure.width_mm(), figure.height_mm().round()), (84.0, 66.0));
    assert!(figure.svg().contains("width=\"84mm\""));
}

proptest! {
    /// Whatever numbers come in, what comes out is drawn inside the page and read by the renderer, or is an
    /// error.
    #[test]
    fn no_number_breaks_a_figure(
        numbers in prop::collection::vec((prop::num::f64::ANY, prop::num::f64::ANY, prop::bool::ANY), 1..20),
        offset in prop::sample::select(vec![0.0, 1.0, 1e15]),
        logarithmic in prop::bool::ANY,
    ) {
        let tame = |value: f64| if offset == 0.0 { value } else { offset + value % 1.0 };
        let point = |&(x, y, event): &(f64, f64, bool)| {
            ResponsePoint { stable: !event, fold: event, ..point(tame(x), tame(y)) }
        };
        let points: Vec<ResponsePoint> = numbers.iter().map(point).collect();
        let displacement_scale = if logarithmic { ScaleChoice::Logarithmic } else { ScaleChoice::Linear };
        let settings = ResponseSettings { displacement_scale, ..ResponseSettings::default() };
        if let Ok(figure) = diagram(&[(1, &points)]).draw_with(&[ResponseQuantity::Displacement], &settings) {
            let svg = figure.svg();
            prop_assert!(!svg.contains("NaN") && !svg.contains("inf\"") && svg.len() < 200_000);
            prop_assert!(figure.png(24.0).is_ok());
        }
    }
}

/// A branch of period 2 with many flips close to each other, stable on one side of the middle only.
fn crowd() -> Vec<ResponsePoint> {
    let flip = |k: u32| ResponsePoint {
        flip: k % 2 == 1,
        stable: k > 300,
        ..point(30.0 + 0.01 * f64::from(k), 1.0 + 1e-3 * f64::from(k))
    };
    (0..=400).map(flip).collect()
}

/// Places of the diamonds of a figure (pt).
fn diamonds(svg: &str) -> Vec<(f64, f64)> {
    // The first one is in the legend.
    let paths = svg.split("<path d=\"").filter(|path| path.contains("l2.08 2.08l-2.08 2.08"));
    let path = paths.last().unwrap_or_default();
    let start = |one: &str| {
        let (x, rest) = one.split_once(' ')?;
        Some((x.parse().ok()?, rest.split('l').next()?.parse().ok()?))
    };
    path.split('M').filter_map(start).collect()
}

#[test]
fn marks_keep_a_distance_and_those_of_stable_solutions_come_first() {
    let figure = displacement(&diagram(&[(2, &crowd())]));
    let places = diamonds(&figure.svg());
    assert!(places.len() > 5, "{}", figure.svg().len());
    for (k, one) in places.iter().enumerate() {
        for other in &places[..k] {
            let away = (one.0 - other.0).hypot(one.1 - other.1);
            assert!(away >= 4.6, "{away} pt");
        }
    }
    // Flips of unstable solutions have another mark: a diamond is right of where stability begins.
    let left = places.iter().map(|place| place.0).fold(f64::INFINITY, f64::min);
    let right = places.iter().map(|place| place.0).fold(0.0, f64::max);
    assert!(right - left < 0.3 * 174.0 / 25.4 * 72.0, "{left} {right}");
    assert!(figure.description().contains("marked at"), "what is left out is counted");
}

#[test]
fn a_detail_is_drawn_again_below_with_its_own_axis() {
    let whole = diagram(&[(1, &folded_branch())]);
    let settings = ResponseSettings { detail: Some((35.0, 41.0)), ..ResponseSettings::default() };
    let figure = whole.draw_with(&[ResponseQuantity::Displacement], &settings).unwrap();
    assert_eq!(figure.svg().matches(">Excitation frequency (Hz)<").count(), 2);
    assert!(figure.svg().contains(">36<") && figure.svg().contains(">40<"));
    let alone = displacement(&whole);
    assert!(figure.height_mm() > 1.5 * alone.height_mm());
    for detail in [(41.0, 35.0), (f64::NAN, 40.0)] {
        let settings = ResponseSettings { detail: Some(detail), ..ResponseSettings::default() };
        let error = whole.draw_with(&[ResponseQuantity::Displacement], &settings);
        assert!(matches!(error, Err(FigureError::AxisRange { .. })));
    }
    assert!(figure.description().ends_with("; drawn again below from 35 to 41"));
    assert_eq!(figure.description().matches("maximum displacement over").count(), 1);
    let beyond = ResponseSettings { detail: Some((1e6, 2e6)), ..ResponseSettings::default() };
    let figure = whole.draw_with(&[ResponseQuantity::Displacement], &beyond).unwrap();
    assert_eq!(figure.svg(), alone.svg(), "a detail without anything is left out");
}

#[test]
fn units_suit_the_range_of_both_axes() {
    let small = |k: u32| ResponsePoint {
        frequency_hz: 64_600.0 + f64::from(k),
        displacement_m: 7.3e-9 * f64::from(k),
        stable: true,
        ..ResponsePoint::default()
    };
    let points: Vec<ResponsePoint> = (1..11).map(small).collect();
    let svg = displacement(&diagram(&[(1, &points)])).svg();
    assert!(svg.contains("frequency (kHz)") && svg.contains("| (nm)"));
    assert!(svg.contains(">64.602<") || svg.contains(">64.605<"), "numbers of the axis are in kHz");
}

#[test]
fn lines_of_several_periods_are_named_beside_them() {
    let at = |height: f64| -> Vec<ResponsePoint> {
        (0..20).map(|k| point(20.0 + f64::from(k), height + 0.01 * f64::from(k))).collect()
    };
    let svg = displacement(&diagram(&[(1, &at(1.0)), (2, &at(4.0))])).svg();
    assert_eq!(svg.matches(">1/2 subharmonic<").count(), 2, "in the legend and beside its line");
}

/// A grazing at the place of a flip has no room, and then no entry in the legend; the description counts it.
#[test]
fn the_legend_has_no_mark_that_is_drawn_nowhere() {
    let mut points = folded_branch();
    points.retain(|point| !point.grazing);
    points[1] = ResponsePoint { flip: true, ..points[1] };
    let beside = ResponsePoint { grazing: true, ..point(30.01, 1.501) };
    points.insert(2, beside);
    let figure = displacement(&diagram(&[(1, &points)]));
    assert!(figure.svg().contains(">flip</text>") && !figure.svg().contains(">grazing</text>"));
    assert!(figure.description().contains("grazing of maximum displacement: 1, marked at 0 places"));
}
