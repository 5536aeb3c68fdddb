//! van de Vorst, Fey, de Kraker, van Campen, "Experimental and numerical analysis of the steady state
//! behaviour of a beam system with impact": the three tables of eigenfrequencies.
//!
//! | parameter | value | |
//! |---|---|---|
//! | width, height | 0.0298 m, 0.0020 m | printed |
//! | Young's modulus, density | 2.1e11 N/m^2, 7800 kg/m^3 | printed |
//! | contact mass | 0.03756 kg | printed |
//! | clamp to contact, overhang | 0.2432157 m, 0.0147665 m | fitted to the 16 printed frequencies |
//! | rotary inertia of the contact mass | 1.59e-8 kg m^2 | fitted |
//! | elements | 44 | 40 to the contact, 4 beyond |
//!
//! Tolerances are the residuals of the fit where these exceed the digits printed.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use hammerbeam_structure::{Beam, BeamPoint, Damping, End, Reduced, Reduction, Section, Structure};

/// Residual of the fit, clamped table.
const CLAMPED: f64 = 6e-5;
/// Residual of the fit, free-interface table.
const FREE_INTERFACE: f64 = 1.2e-4;
/// Residual of the fit, reduced table, modes 1 to 5.
const REDUCED: f64 = 5e-5;
/// Residual of the fit, reduced table, mode 6: 3945.3 Hz where 3940.9 is printed.
const REDUCED_SIXTH: f64 = 1.15e-3;

fn shaken_beam() -> Structure {
    let contact = BeamPoint {
        name: "contact".into(),
        at: 0.2432157,
        mass: 0.03756,
        rotary_inertia: 1.59e-8,
        ..BeamPoint::default()
    };
    let beam = Beam {
        length: 0.2579822,
        elements: 44,
        section: Section::rectangle(0.0298, 0.0020).unwrap(),
        youngs_modulus: 2.1e11,
        density: 7800.0,
        left: End::Clamped,
        right: End::Free,
        points: vec![contact],
    };
    beam.structure().unwrap().with_support_motion(&["left"]).unwrap()
}

fn reduced() -> Reduced {
    let reduction = Reduction::FreeInterface { cut_off_hz: 1000.0 };
    shaken_beam().reduce(&reduction, &Damping::modal(0.015), &["contact"]).unwrap()
}

/// One test a printed number.
macro_rules! printed {
    ($($name:ident: $table:ident[$index:literal] = $printed:literal within $tolerance:ident;)*) => {
        $(#[test]
        fn $name() {
            assert_relative_eq!(reduced().tables.$table[$index], $printed, max_relative = $tolerance);
        })*
    };
}

printed! {
    clamped_table_mode_1_is_17_495_hz: clamped_hz[0] = 17.495 within CLAMPED;
    clamped_table_mode_2_is_137_28_hz: clamped_hz[1] = 137.28 within CLAMPED;
    clamped_table_mode_3_is_414_33_hz: clamped_hz[2] = 414.33 within CLAMPED;
    clamped_table_mode_4_is_842_91_hz: clamped_hz[3] = 842.91 within CLAMPED;
    clamped_table_mode_5_is_1419_7_hz: clamped_hz[4] = 1419.7 within CLAMPED;
    clamped_table_mode_6_is_2136_1_hz: clamped_hz[5] = 2136.1 within CLAMPED;
    free_interface_table_mode_1_is_30_51_hz: free_interface_hz[1] = 30.51 within FREE_INTERFACE;
    free_interface_table_mode_2_is_192_68_hz: free_interface_hz[2] = 192.68 within FREE_INTERFACE;
    free_interface_table_mode_3_is_507_26_hz: free_interface_hz[3] = 507.26 within FREE_INTERFACE;
    free_interface_table_mode_4_is_973_45_hz: free_interface_hz[4] = 973.45 within FREE_INTERFACE;
    reduced_table_mode_1_is_17_495_hz: reduced_hz[0] = 17.495 within REDUCED;
    reduced_table_mode_2_is_137_28_hz: reduced_hz[1] = 137.28 within REDUCED;
    reduced_table_mode_3_is_414_33_hz: reduced_hz[2] = 414.33 within REDUCED;
    reduced_table_mode_4_is_843_26_hz: reduced_hz[3] = 843.26 within REDUCED;
    reduced_table_mode_5_is_1538_8_hz: reduced_hz[4] = 1538.8 within REDUCED;
    reduced_table_mode_6_is_3940_9_hz: reduced_hz[5] = 3940.9 within REDUCED_SIXTH;
}

#[test]
fn free_interface_table_has_one_rigid_body_mode_and_four_elastic_ones() {
    let tables = reduced().tables;
    assert_eq!(tables.free_interface_hz.len(), 5);
    assert_eq!(tables.free_interface_hz[0], 0.0);
}

#[test]
fn reduced_beam_has_six_degrees_of_freedom() {
    assert_eq!(reduced().model.dof(), 6);
}

/// Frequencies, shapes and inertias of the reduced clamped beam, half a unit of the last digit printed.
#[test]
fn modal_coordinates_of_the_reduced_beam_agree_to_every_digit() {
    let expected = [
        (17.49546, 3.719882, 0.326581),
        (137.27615, 1.767674, -0.160943),
        (414.31135, 1.071971, 0.092436),
        (843.22742, 0.656816, -0.064797),
        (1538.84987, 0.374580, 0.065038),
        (3945.26664, 1.326146, -0.029896),
    ];
    let model = reduced().model;
    let contact = model.point("contact").unwrap();
    let support = &model.supports[0];
    assert_eq!(contact.support_ratios[0], 1.0);
    for (i, (hz, shape, inertia)) in expected.into_iter().enumerate() {
        assert_abs_diff_eq!(model.natural_frequencies[i] / TAU, hz, epsilon = 0.51e-5);
        assert_abs_diff_eq!(contact.shape[i], shape, epsilon = 0.51e-6);
        assert_abs_diff_eq!(support.inertia[i], inertia, epsilon = 0.51e-6);
        assert_relative_eq!(model.damping[(i, i)], 0.03 * model.natural_frequencies[i], max_relative = 1e-14);
    }
}

/// Printed as 8 % and 84 % off: what the two residual modes stand for lies above the cut-off.
#[test]
fn reduction_is_off_by_8_and_84_percent_above_the_cut_off() {
    let errors = reduced().tables.frequency_errors;
    assert_eq!(errors.iter().filter(|error| error.below_cut_off).count(), 4);
    assert!(errors[..4].iter().all(|error| error.relative.abs() < 5e-4));
    assert_abs_diff_eq!(errors[4].relative, 0.084, epsilon = 0.0005);
    assert_abs_diff_eq!(errors[5].relative, 0.847, epsilon = 0.0005);
}

/// Under its own weight the beam sags by 0.98 mm at the contact, unreduced and reduced.
#[test]
fn beam_sags_0_98_mm_at_the_contact() {
    let full = shaken_beam().static_deflection("contact", 9.81).unwrap();
    assert_abs_diff_eq!(full, 0.98e-3, epsilon = 0.005e-3);
    let model = reduced().model;
    assert_relative_eq!(
        model.static_deflection("contact", 9.81).unwrap().unwrap(),
        full,
        max_relative = 1e-9
    );
}
