//! Input that is no structure, and what the user is told.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{bare, lumped, paper_beam, unit_beam};
use hammerbeam_structure::{Beam, BeamPoint, Damping, End, Lumped, Reduction, StructureError};

fn message(beam: &Beam) -> String {
    beam.structure().unwrap_err().to_string()
}

#[test]
fn point_off_the_beam_is_refused_with_its_place_and_the_length() {
    let beam = unit_beam(4, End::Clamped, End::Free, vec![bare("far", 1.5)]);
    assert_eq!(message(&beam), "point \"far\" is at 1.5 m, must be between 0 and 1 m");
}

#[test]
fn names_must_be_unique_and_not_reserved() {
    let points = |a: &str, b: &str| unit_beam(4, End::Clamped, End::Free, vec![bare(a, 0.2), bare(b, 0.7)]);
    assert_eq!(message(&points("a", "a")), "the name \"a\" is used twice");
    for name in ["left", "right", "ground", "space", "support"] {
        assert_eq!(
            message(&points("a", name)),
            format!("the name \"{name}\" is reserved, choose another one")
        );
    }
}

#[test]
fn numbers_must_be_finite_and_have_the_right_sign() {
    let beam = || unit_beam(4, End::Clamped, End::Free, vec![]);
    assert!(matches!(Beam { length: 0.0, ..beam() }.structure(), Err(StructureError::NotPositive { .. })));
    assert!(matches!(Beam { density: -1.0, ..beam() }.structure(), Err(StructureError::NotPositive { .. })));
    let modulus = Beam { youngs_modulus: f64::INFINITY, ..beam() };
    assert_eq!(message(&modulus), "Young's modulus is inf, must be finite");
    let point = BeamPoint { mass: -0.5, ..bare("a", 0.5) };
    assert_eq!(
        message(&Beam { points: vec![point], ..beam() }),
        "mass of point \"a\" is -0.5, must be 0 or greater"
    );
}

#[test]
fn elements_must_be_enough_for_the_points() {
    let beam = unit_beam(2, End::Clamped, End::Free, vec![bare("a", 0.2), bare("b", 0.7)]);
    assert_eq!(beam.structure().unwrap_err(), StructureError::TooFewElements { found: 2, needed: 3 });
}

#[test]
fn beam_with_every_coordinate_held_is_refused() {
    let beam = unit_beam(1, End::Clamped, End::Clamped, vec![]).structure().unwrap();
    assert_eq!(beam.eigenfrequencies_hz(), Err(StructureError::NothingFree));
}

#[test]
fn lumped_system_needs_masses_that_are_positive() {
    assert_eq!(Lumped::default().structure().unwrap_err(), StructureError::NoMass);
    let error = lumped(&[("a", 0.0)], &[], &[]).structure().unwrap_err();
    assert_eq!(error.to_string(), "mass \"a\" is 0, must be greater than 0");
}

#[test]
fn springs_must_end_at_two_known_places() {
    let refused = |spring| lumped(&[("a", 1.0)], &[spring], &[]).structure().unwrap_err().to_string();
    assert_eq!(
        refused(("a", "b", 1.0)),
        "spring between \"a\" and \"b\" refers to \"b\", the structure has a, ground"
    );
    assert_eq!(refused(("a", "a", 1.0)), "spring between \"a\" and \"a\" connects \"a\" to itself");
    assert_eq!(
        refused(("a", "ground", -2.0)),
        "spring between \"a\" and \"ground\" is -2, must be 0 or greater"
    );
}

#[test]
fn support_motion_and_interface_must_name_points() {
    let beam = paper_beam().structure().unwrap();
    let error = beam.clone().with_support_motion(&["top"]).unwrap_err().to_string();
    assert_eq!(error, "support motion refers to \"top\", the structure has contact, left, right");
    let error = beam.reduce(&Reduction::None, &Damping::none(), &["tip"]).unwrap_err().to_string();
    assert_eq!(error, "the interface refers to \"tip\", the structure has contact, left, right");
}

#[test]
fn cut_off_below_the_first_elastic_mode_is_refused() {
    let shaken = paper_beam().structure().unwrap().with_support_motion(&["left"]).unwrap();
    let reduction = Reduction::FreeInterface { cut_off_hz: 20.0 };
    let error = shaken.reduce(&reduction, &Damping::none(), &["contact"]).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("the cut-off frequency is 20 Hz, below the first elastic mode at 30.51")
    );
    let negative = Reduction::FixedInterface { cut_off_hz: -1.0 };
    assert!(matches!(
        shaken.reduce(&negative, &Damping::none(), &[]),
        Err(StructureError::NotPositive { .. })
    ));
}

#[test]
fn lumped_system_is_not_reduced() {
    let structure = lumped(&[("a", 1.0)], &[("a", "ground", 1.0)], &[]).structure().unwrap();
    let reduction = Reduction::FreeInterface { cut_off_hz: 1.0 };
    let error = structure.reduce(&reduction, &Damping::none(), &["a"]).unwrap_err();
    assert_eq!(error, StructureError::LumpedIsNotReduced);
}

#[test]
fn weight_of_a_floating_structure_has_no_static_answer() {
    let beam = unit_beam(4, End::Free, End::Free, vec![]).structure().unwrap();
    assert!(matches!(
        beam.static_deflection("left", 9.81),
        Err(StructureError::RigidBodyModeNotRestrained { .. })
    ));
    let model = beam.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model;
    assert!(model.static_deflection("left", 9.81).is_err());
}

/// Numbers beyond any material end in an error, not in a hang or in NaN.
#[test]
fn absurd_sizes_are_refused() {
    for (youngs_modulus, density) in [(1e300, 1e-300), (1e-300, 1e300), (f64::MAX, f64::MAX), (1.0, 1e-320)] {
        let beam = Beam { youngs_modulus, density, ..unit_beam(6, End::Clamped, End::Free, vec![]) };
        let reduced = beam.structure().and_then(|s| s.reduce(&Reduction::None, &Damping::none(), &["right"]));
        if let Ok(reduced) = reduced {
            assert!(reduced.tables.clamped_hz.iter().all(|hz| hz.is_finite()));
        }
    }
}
