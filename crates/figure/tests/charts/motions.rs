//! Response diagrams, sweeps and basins.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_figure::{
    BasinMap, ParameterAxis, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity,
    ResponseSettings, ScaleChoice, Style, SweepDiagram,
};

use super::samples::{basins, exponents, sweep};

#[test]
fn basins_name_class_period_branch_and_fraction() {
    let svg = basins().draw(&Style::single_column()).unwrap().svg();
    for words in
        ["1: period 3, branch 2, 50.0\u{2009}%", "2: chaotic, 25.0\u{2009}%", "not computed, 25.0\u{2009}%"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert!(svg.contains("attractor at phase 0") && !svg.contains("rigid stop"));
    let cells = vec![0, 2, 1, 0];
    let stopped = BasinMap { cells, behind_stop: vec![true, false, false, false], ..basins() };
    let svg = stopped.draw(&Style::single_column()).unwrap().svg();
    for words in ["not computed, 25.0\u{2009}%", "starts behind a rigid stop, 25.0\u{2009}%"] {
        assert!(svg.contains(words), "{words}");
    }
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

/// 60 kHz to 70 kHz are 60 to 70 on an axis in kilohertz.
#[test]
fn sweeps_and_exponents_have_the_unit_that_suits_their_frequencies() {
    let mut diagram = sweep();
    let of_motions = |diagram: &SweepDiagram| diagram.draw(&Style::default()).unwrap().svg();
    assert!(of_motions(&diagram).contains(">Excitation frequency (Hz)<"));
    diagram.motions.iter_mut().for_each(|motion| motion.frequency_hz *= 1e3);
    assert!(of_motions(&diagram).contains(">Excitation frequency (kHz)<"));
    let mut diagram = exponents();
    diagram.points.iter_mut().zip([60e3, 70e3]).for_each(|(point, at)| point.frequency_hz = at);
    let svg = diagram.draw(&Style::default()).unwrap().svg();
    for text in [">Excitation frequency (kHz)<", ">60<", ">70<"] {
        assert!(svg.contains(text), "{text}");
    }
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
    let [plain, shaded] =
        [plain, shaded].map(|diagram| diagram.draw(ResponseQuantity::Displacement).unwrap());
    assert!(!plain.svg().contains("chaotic") && shaded.svg().contains(">chaotic motion found<"));
    assert!(shaded.description().contains("chaotic motion found at 22.000 to 24.000 Hz"));
    // What lies outside the axis is cut off: one rectangle, and the sample of the legend.
    assert_eq!(shaded.svg().matches("fill=\"#f8ebd5\"").count(), 2);
}

/// Contact forces and impact velocities have their axes; without a contact there is nothing on a logarithmic
/// one.
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
    assert!(
        diagram(5.0)
            .draw(ResponseQuantity::ContactForce)
            .unwrap()
            .svg()
            .contains("Largest contact force (N)")
    );
    // 5 mm/s, and 5 m/s: units suit the values.
    let velocity = |force| diagram(force).draw(ResponseQuantity::ImpactVelocity).unwrap();
    assert!(velocity(5.0).svg().contains("impact velocity (mm/s)"));
    assert!(velocity(5000.0).svg().contains("impact velocity (m/s)"));
    let settings =
        ResponseSettings { contact_scale: ScaleChoice::Logarithmic, ..ResponseSettings::default() };
    assert!(diagram(0.0).draw_with(&[ResponseQuantity::ContactForce], &settings).is_err());
}

#[test]
fn branches_over_another_parameter_say_which() {
    let point = |k: i32| ResponsePoint {
        frequency_hz: 1e-8 * f64::from(k),
        displacement_m: 1e-3 * (1.0 + 1e-13 * f64::from(k % 3)),
        ..ResponsePoint::default()
    };
    let curve = ResponseCurve { period_multiple: 1, points: (1..9).map(point).collect() };
    let diagram = ResponseDiagram {
        parameter: Some(ParameterAxis { title: "Gap of stop 1".to_owned(), unit: "m".to_owned() }),
        curves: vec![curve],
        ..ResponseDiagram::default()
    };
    let figure = diagram.draw(ResponseQuantity::Displacement).unwrap();
    let svg = figure.svg();
    assert!(svg.contains(">Gap of stop 1 (nm)<") && svg.contains(">60<"), "a range in nanometres");
    assert!(!svg.contains("Excitation frequency"));
    // Rounding is no range: the labels are 0.95, 1.00, ..., and not 1.0000000000001.
    assert!(svg.contains(">1.00<"), "few digits");
    assert!(figure.description().contains("over Gap of stop 1"));
}
