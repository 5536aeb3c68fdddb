//! Figures of orbits.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_figure::{FilteredAcceleration, OrbitDiagram, OrbitSample, Style};

use super::samples::{orbit, struck};

#[test]
fn impulses_stand_in_a_panel_of_their_own_with_their_unit() {
    let history = struck().draw_history(&Style::double_column()).unwrap();
    let (svg, words) = (history.svg(), "impulses of 2 impacts on rigid stops: 0.7, 1.2 N s");
    assert!(svg.contains(">Impulse (N s)<") && !svg.contains("Local force"), "no force acts over a time");
    assert!(svg.contains(words) && history.description().contains(words));
    assert!(svg.contains(">impulse of local element 2<"));
    let element_names = vec!["left stop".to_owned(), "right stop".to_owned()];
    let named = OrbitDiagram { element_names, ..struck() }.draw_history(&Style::default()).unwrap().svg();
    assert!(named.contains(">impulse of right stop<") && !named.contains("local element"));
    let phase = struck().draw_phase(&Style::single_column()).unwrap().svg();
    assert!(phase.contains(">jump at an impact<"));
    let without = orbit().draw_phase(&Style::single_column()).unwrap().svg();
    assert!(!without.contains("jump at an impact"));
}

#[test]
fn a_spectrum_has_the_harmonics_of_the_motion_alone() {
    let svg = orbit().draw_spectrum(&Style::default()).unwrap().svg();
    // Those of 10 and 30 Hz, two arcs for the dot of each; all others are rounding, below 1e-5 of the
    // largest.
    assert_eq!(svg.matches("a0.9 0.9 0 1 0").count(), 4);
    assert!(svg.contains(">harmonic<") && svg.contains(">eigenfrequency<"));
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
    let still = |sample: &OrbitSample| OrbitSample { supports_m: Vec::new(), ..sample.clone() };
    let still = OrbitDiagram { samples: orbit().samples.iter().map(still).collect(), ..orbit() };
    assert!(!still.draw_history(&Style::double_column()).unwrap().svg().contains(">support<"));
}

/// Of an orbit of three excitation periods the section has three points, and they stand in the portrait as
/// well.
#[test]
fn the_section_of_an_orbit_has_as_many_points_as_excitation_periods() {
    let svg =
        OrbitDiagram { period_multiple: 3, ..orbit() }.draw_phase(&Style::single_column()).unwrap().svg();
    assert!(svg.contains(">phase portrait<") && svg.contains(">Poincaré section<"));
    let dots = svg.split(" d=\"").map(|rest| rest.split('"').next().unwrap().matches(" 0 1 0 ").count() / 2);
    assert_eq!(dots.filter(|circles| *circles == 3).count(), 2, "three dots in each of the two frames");
}
