//! The page as a whole: its size, and that it is a function of what it is given.

use hammerbeam_figure::{
    MultiplierRecords, OrbitRecords, Page, PageBranch, PageFigure, PageFigures, PageOrbit, PageSection,
    PageSolution, ReducedMode, ReductionDiagram, Style,
};

/// What the page of the full response diagram of the paper may take.
const MOST_BYTES: usize = 15_000_000;

/// As many solutions and branches as figure 3 has, with numbers that do not compress by accident.
fn figure_3(solutions: usize) -> Page {
    let branches = 35;
    let of_branch = solutions / branches;
    let solution = |k: usize| PageSolution {
        frequency_hz: 19.0 + 91.0 * k as f64 / of_branch as f64,
        displacement_m: 1e-3 * (1.0 + (0.01 * k as f64).sin().abs()),
        acceleration_m_s2: 300.0,
        leading_multiplier: [-1.5, 0.2],
        stable: k.is_multiple_of(3),
        flip: k.is_multiple_of(29),
        ..PageSolution::default()
    };
    let branch = |id| PageBranch {
        id,
        period_multiple: id % 3 + 1,
        over: 0,
        ends: ["end of the frequency range at 110 Hz".to_owned(), "not finished".to_owned()],
        solutions: (0..of_branch).map(solution).collect(),
    };
    // Twelve, all of them real: none is longer.
    let mut multipliers = MultiplierRecords::default();
    (0..of_branch * branches).for_each(|_| multipliers.push(&[[-1.5, 0.0]; 12]));
    Page {
        title: "as many solutions as in figure 3".to_owned(),
        frequency_range_hz: (19.0, 110.0),
        branches: (1..=branches as u32).map(branch).collect(),
        multipliers,
        ..Page::default()
    }
}

/// Orbits until there is no room for another one. They are no motions: nothing in them follows from anything
/// else, so that they take twice as much as those of figure 3.
fn orbits(room: usize) -> OrbitRecords {
    let wave = |count: usize, rate: f64| (0..count).map(|k| (rate * k as f64).sin()).collect::<Vec<f64>>();
    let pairs = |rate| wave(384, rate).iter().map(|value| [*value, value + 0.3]).collect::<Vec<_>>();
    let orbit = PageOrbit {
        duration_s: 0.02,
        displacement_m: wave(384, 0.02),
        velocity_m_s: wave(384, 0.06),
        in_contacts: vec![(7, 0.1, 0.2); 24],
        acceleration_m_s2: pairs(0.7),
        impulses: Vec::new(),
        forces_n: vec![pairs(0.0)],
        support_m: wave(120, 0.05),
        modes: (1..7).map(|mode| wave(120, 0.05 * f64::from(mode))).collect(),
        spectrum_m_s2: wave(200, 0.4).iter().map(|value| value.exp()).collect(),
    };
    let mut records = OrbitRecords::default();
    let mut number = 0;
    while records.insert(number, orbit.record(), room) {
        number += 1;
    }
    records
}

#[test]
fn the_page_of_figure_3_is_under_15_megabytes_with_all_multipliers_and_many_orbits() {
    let page = figure_3(65_000).pack();
    let orbits = orbits(page.room_for_orbits());
    assert!(orbits.count() > 2400, "{}", orbits.count());
    let html = page.html(&orbits);
    assert!(html.len() < MOST_BYTES, "{}", html.len());
    assert!(html == figure_3(65_000).pack().html(&orbits), "drawn twice it is the same");
}

#[test]
fn a_hundred_thousand_solutions_leave_room_for_orbits() {
    let page = figure_3(100_000).pack();
    let orbits = orbits(page.room_for_orbits());
    assert!(orbits.count() > 1300, "{}", orbits.count());
    assert!(page.html(&orbits).len() < MOST_BYTES);
}

/// More sections and printed figures than any folder has.
#[test]
fn a_page_with_sections_and_figures_is_under_15_megabytes_too() {
    let mut page = figure_3(65_000);
    let points = (0..5000).map(|k| (f64::from(k).sin(), f64::from(k).cos())).collect();
    page.sections = vec![PageSection { points, ..PageSection::default() }; 200];
    let modes = (1..200).map(|k| ReducedMode {
        full_hz: f64::from(k),
        relative_error: f64::from(k).exp2() * 1e-60,
        below_cut_off: k < 100,
    });
    let diagram = ReductionDiagram { title: String::new(), modes: modes.collect() };
    let figure = diagram.draw(&Style::single_column()).expect("it has modes");
    page.figures = PageFigures::default();
    for number in 0..300 {
        page.figures.push(PageFigure::new(&format!("figure-{number}"), "Many", &figure));
    }
    let page = page.pack();
    let orbits = orbits(page.room_for_orbits());
    assert!(orbits.count() > 1500, "{}", orbits.count());
    let html = page.html(&orbits);
    assert!(html.len() < MOST_BYTES, "{}", html.len());
    assert!(html.contains(r#""noRoom":["figure-"#), "what has no room is named");
}
