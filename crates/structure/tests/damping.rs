//! Damping: modal, Rayleigh and discrete dampers.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{bare, lumped, paper_beam, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{BeamPoint, Damping, End, ModalRatios, ReducedModel, Reduction, StructureError};

fn two_masses(damping: &Damping, dampers: &[(&str, &str, f64)]) -> Result<ReducedModel, StructureError> {
    let springs = [("a", "ground", 3.0), ("a", "b", 2.0)];
    let structure = lumped(&[("a", 1.0), ("b", 1.0)], &springs, dampers).structure()?;
    Ok(structure.reduce(&Reduction::None, damping, &["a"])?.model)
}

/// `C = diag(2 z w)`; `w = 1, sqrt(6)` for these two masses.
#[test]
fn modal_ratios_fill_the_diagonal() {
    let ratios = Damping { modal: ModalRatios::PerMode(vec![0.01, 0.5]), ..Damping::none() };
    let model = two_masses(&ratios, &[]).unwrap();
    assert_relative_eq!(model.damping[(0, 0)], 0.02, max_relative = 1e-14);
    assert_relative_eq!(model.damping[(1, 1)], 6.0_f64.sqrt(), max_relative = 1e-14);
    assert_eq!(model.damping[(0, 1)], 0.0);
}

#[test]
fn rayleigh_damping_adds_mass_and_stiffness() {
    let model = two_masses(&Damping::rayleigh(0.3, 0.1), &[]).unwrap();
    assert_relative_eq!(model.damping[(0, 0)], 0.4, max_relative = 1e-14);
    assert_relative_eq!(model.damping[(1, 1)], 0.9, max_relative = 1e-14);
}

/// One damper at `b`: `C = c phi_b phi_b^T`, coupled, symmetric, and added to the modal one.
#[test]
fn discrete_damper_couples_the_modes() {
    let model = two_masses(&Damping::modal(0.1), &[("ground", "b", 7.0)]).unwrap();
    let b = &model.point("b").unwrap().shape;
    for i in 0..2 {
        for j in 0..2 {
            let modal = if i == j { 0.2 * model.natural_frequencies[i] } else { 0.0 };
            assert_relative_eq!(model.damping[(i, j)], 7.0 * b[i] * b[j] + modal, max_relative = 1e-13);
        }
    }
    assert_eq!(model.damping[(0, 1)], model.damping[(1, 0)]);
}

#[test]
fn dampers_of_beam_points_act_on_displacement_and_rotation() {
    let point = BeamPoint { damper: 2.0, rotational_damper: 3.0, ..bare("tip", 1.0) };
    let beam = unit_beam(4, End::Clamped, End::Free, vec![point]).structure().unwrap();
    let model = beam.reduce(&Reduction::None, &Damping::none(), &["tip"]).unwrap().model;
    let across = 2.0 * model.point("tip").unwrap().shape[0].powi(2);
    // The slope at the tip of the first cantilever mode is 1.3765 of its deflection over the length.
    assert_relative_eq!(
        model.damping[(0, 0)],
        across * (1.0 + 1.5 * 1.3765_f64.powi(2)),
        max_relative = 1e-3
    );
}

#[test]
fn ratios_must_be_one_for_each_mode_and_not_negative() {
    let three = Damping { modal: ModalRatios::PerMode(vec![0.1; 3]), ..Damping::none() };
    assert_eq!(
        two_masses(&three, &[]).unwrap_err(),
        StructureError::DampingRatioCount { found: 3, modes: 2 }
    );
    assert!(matches!(two_masses(&Damping::modal(-0.1), &[]), Err(StructureError::Negative { .. })));
    assert!(matches!(
        two_masses(&Damping::rayleigh(0.0, f64::NAN), &[]),
        Err(StructureError::NotFinite { .. })
    ));
}

#[test]
fn rigid_body_modes_have_no_modal_damping() {
    let beam = paper_beam();
    let floating = hammerbeam_structure::Beam { left: End::Free, ..beam }.structure().unwrap();
    let reduction = Reduction::FreeInterface { cut_off_hz: 1000.0 };
    let model = floating.reduce(&reduction, &Damping::modal(0.02), &["contact"]).unwrap().model;
    assert_eq!((model.damping[(0, 0)], model.damping[(1, 1)]), (0.0, 0.0));
    assert!(model.damping[(2, 2)] > 0.0);
}
