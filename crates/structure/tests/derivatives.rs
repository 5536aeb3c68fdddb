//! Derivatives of eigenfrequencies: against closed forms, and against differences.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{bare, paper_beam, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{Beam, BeamChange, BeamPoint, Boundary, End, PointChange, Section};

fn derivatives(beam: &Beam, boundary: Boundary, change: &BeamChange) -> Vec<f64> {
    beam.eigenfrequency_derivatives(&["left"], boundary, change).unwrap().unwrap()
}

fn supported(beam: &Beam) -> Vec<f64> {
    beam.structure().unwrap().with_support_motion(&["left"]).unwrap().eigenfrequencies_hz().unwrap()
}

/// Frequencies of a bare beam go with `sqrt(EI/(rho A))/L^2`, and so do those of its elements.
#[test]
fn a_bare_beam_scales_as_its_formula() {
    let beam = unit_beam(8, End::Clamped, End::Free, vec![]);
    let frequencies = supported(&beam);
    let stiffer = derivatives(
        &beam,
        Boundary::Supported,
        &BeamChange { bending_stiffness: 1.0, ..BeamChange::default() },
    );
    let heavier = derivatives(
        &beam,
        Boundary::Supported,
        &BeamChange { mass_per_length: 1.0, ..BeamChange::default() },
    );
    let longer =
        derivatives(&beam, Boundary::Supported, &BeamChange { length: 1.0, ..BeamChange::default() });
    for (mode, f) in frequencies.iter().enumerate() {
        // Rounding of the modes, 1e-16 times the spread of the frequencies, some 1e3.
        assert_relative_eq!(stiffer[mode], 0.5 * f, max_relative = 1e-10);
        assert_relative_eq!(heavier[mode], -0.5 * f, max_relative = 1e-10);
        assert_relative_eq!(longer[mode], -2.0 * f, max_relative = 1e-10);
    }
}

/// A number of a beam: its name, the change by it, and how it is made larger by a part of itself.
type Number = (&'static str, BeamChange, fn(&mut Beam, f64));

/// All numbers of a beam with everything on it, each as a change of it.
fn everything() -> (Beam, Vec<Number>) {
    let contact = BeamPoint { mass: 0.03756, rotary_inertia: 2e-6, ..bare("contact", 0.2432157) };
    let middle = BeamPoint { spring: 2e3, rotational_spring: 3.0, mass: 0.01, ..bare("middle", 0.11) };
    let beam = Beam { points: vec![contact, middle], ..paper_beam() };
    let (area, moment) = (beam.section.area(), beam.section.second_moment());
    let first = |point: PointChange| BeamChange {
        points: vec![point, PointChange::default()],
        ..BeamChange::default()
    };
    let second = |point: PointChange| BeamChange {
        points: vec![PointChange::default(), point],
        ..BeamChange::default()
    };
    let none = PointChange::default();
    let changes: Vec<Number> = vec![
        ("length", BeamChange { length: 1.0, ..BeamChange::default() }, |beam, by| beam.length *= 1.0 + by),
        ("modulus", BeamChange { bending_stiffness: moment, ..BeamChange::default() }, |beam, by| {
            beam.youngs_modulus *= 1.0 + by;
        }),
        ("area", BeamChange { mass_per_length: beam.density, ..BeamChange::default() }, |beam, by| {
            let (area, moment) = (beam.section.area(), beam.section.second_moment());
            beam.section = Section::general(area * (1.0 + by), moment).unwrap();
        }),
        ("density", BeamChange { mass_per_length: area, ..BeamChange::default() }, |beam, by| {
            beam.density *= 1.0 + by;
        }),
        ("at", first(PointChange { at: 1.0, ..none }), |beam, by| beam.points[0].at *= 1.0 + by),
        ("mass", first(PointChange { mass: 1.0, ..none }), |beam, by| beam.points[0].mass *= 1.0 + by),
        ("rotary inertia", first(PointChange { rotary_inertia: 1.0, ..none }), |beam, by| {
            beam.points[0].rotary_inertia *= 1.0 + by;
        }),
        ("at", second(PointChange { at: 1.0, ..none }), |beam, by| beam.points[1].at *= 1.0 + by),
        ("spring", second(PointChange { spring: 1.0, ..none }), |beam, by| beam.points[1].spring *= 1.0 + by),
        ("rotational spring", second(PointChange { rotational_spring: 1.0, ..none }), |beam, by| {
            beam.points[1].rotational_spring *= 1.0 + by;
        }),
    ];
    (beam, changes)
}

fn value(beam: &Beam, name: &str, second: bool) -> f64 {
    let point = &beam.points[usize::from(second)];
    match name {
        "length" => beam.length,
        "modulus" => beam.youngs_modulus,
        "area" => beam.section.area(),
        "density" => beam.density,
        "at" => point.at,
        "mass" => point.mass,
        "rotary inertia" => point.rotary_inertia,
        "spring" => point.spring,
        _ => point.rotational_spring,
    }
}

#[test]
fn every_number_of_a_beam_agrees_with_differences() {
    let (beam, changes) = everything();
    let frequencies = supported(&beam);
    for (place, (name, change, apply)) in changes.into_iter().enumerate() {
        let second = place >= 7;
        let exact = derivatives(&beam, Boundary::Supported, &change);
        let step = 1e-5;
        let moved = |by: f64| {
            let mut other = beam.clone();
            apply(&mut other, by);
            supported(&other)
        };
        let (low, high) = (moved(-step), moved(step));
        for mode in 0..8 {
            let difference = (high[mode] - low[mode]) / (2.0 * step * value(&beam, name, second));
            // Relative to what the parameter does to a frequency at most: rounding 1e-12/1e-5, truncation
            // (1e-5)^2 times the squared number of half waves.
            let tolerance = 1e-6 * (difference.abs() + 1e-2 * frequencies[mode] / value(&beam, name, second));
            assert!(
                (exact[mode] - difference).abs() < tolerance,
                "{name}, mode {mode}: {} {difference}",
                exact[mode]
            );
        }
    }
}

#[test]
fn with_its_support_let_go_the_beam_keeps_its_rigid_body_mode() {
    let beam = paper_beam();
    let change = BeamChange { bending_stiffness: 1.0, ..BeamChange::default() };
    let exact = derivatives(&beam, Boundary::Released, &change);
    let sliding = Beam { left: End::Sliding, ..paper_beam() };
    let frequencies = sliding.structure().unwrap().eigenfrequencies_hz().unwrap();
    assert_eq!(exact[0], 0.0);
    let stiffness = beam.youngs_modulus * beam.section.second_moment();
    for mode in 1..6 {
        // Without springs every frequency goes with the root of the stiffness.
        assert_relative_eq!(exact[mode], 0.5 * frequencies[mode] / stiffness, max_relative = 1e-9);
    }
}

#[test]
fn points_at_one_place_that_part_have_no_derivative() {
    let beam = unit_beam(8, End::Clamped, End::Free, vec![bare("a", 0.5), bare("b", 0.5), bare("tip", 1.0)]);
    let at = |a: f64, b: f64, tip: f64| BeamChange {
        points: [a, b, tip].map(|at| PointChange { at, ..PointChange::default() }).to_vec(),
        ..BeamChange::default()
    };
    let of = |change: &BeamChange| beam.eigenfrequency_derivatives(&[], Boundary::Supported, change).unwrap();
    assert_eq!(of(&at(1.0, 0.0, 0.0)), None);
    assert_eq!(of(&at(0.0, 0.0, -1.0)), None);
    assert!(of(&at(1.0, 1.0, 0.0)).is_some());
    assert!(of(&BeamChange { length: 1.0, ..at(0.0, 0.0, 1.0) }).is_some());
}
