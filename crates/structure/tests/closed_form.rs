//! Uniform beams against the wavenumbers of the closed form, `w = beta^2 sqrt(EI / (rho A l^4))`.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::{bare, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{BeamPoint, End};

/// First wavenumbers `beta` of a unit beam, rigid-body modes included as 0.
fn wavenumbers(elements: usize, left: End, right: End) -> Vec<f64> {
    let structure = unit_beam(elements, left, right, vec![]).structure().unwrap();
    structure.eigenfrequencies_hz().unwrap().into_iter().map(|hz| (TAU * hz).sqrt()).collect()
}

/// 2e-6 is above the error `(beta / 44)^4 / 2880` of the third wavenumber.
fn assert_first_three(left: End, right: End, rigid: usize, expected: [f64; 3]) {
    let found = wavenumbers(44, left, right);
    assert!(found[..rigid].iter().all(|beta| *beta == 0.0), "{found:?}");
    for (beta, expected) in found[rigid..].iter().zip(expected) {
        assert_relative_eq!(*beta, expected, max_relative = 2e-6);
    }
}

#[test]
fn cantilever_first_wavenumber_is_1_8751() {
    assert_first_three(End::Clamped, End::Free, 0, [1.875104068711961, 4.694091132974175, 7.854757438237613]);
    assert_first_three(End::Free, End::Clamped, 0, [1.875104068711961, 4.694091132974175, 7.854757438237613]);
}

#[test]
fn pinned_beam_wavenumbers_are_multiples_of_pi() {
    assert_first_three(End::Pinned, End::Pinned, 0, [PI, 2.0 * PI, 3.0 * PI]);
}

#[test]
fn free_beam_has_two_rigid_body_modes_then_4_7300() {
    assert_first_three(End::Free, End::Free, 2, [4.730040744862704, 7.853204624095838, 10.99560783800167]);
}

#[test]
fn clamped_beam_first_wavenumber_is_4_7300() {
    assert_first_three(
        End::Clamped,
        End::Clamped,
        0,
        [4.730040744862704, 7.853204624095838, 10.99560783800167],
    );
}

#[test]
fn propped_cantilever_first_wavenumber_is_3_9266() {
    assert_first_three(
        End::Clamped,
        End::Pinned,
        0,
        [3.926602312047919, 7.068582745628732, 10.210176122813031],
    );
}

#[test]
fn pinned_free_beam_has_one_rigid_body_mode_then_3_9266() {
    assert_first_three(End::Pinned, End::Free, 1, [3.926602312047919, 7.068582745628732, 10.210176122813031]);
}

#[test]
fn sliding_free_beam_has_one_rigid_body_mode_then_2_3650() {
    assert_first_three(End::Sliding, End::Free, 1, [2.365020372431352, 5.497803919000836, 8.639379828699741]);
}

#[test]
fn clamped_sliding_beam_first_wavenumber_is_2_3650() {
    assert_first_three(
        End::Clamped,
        End::Sliding,
        0,
        [2.365020372431352, 5.497803919000836, 8.639379828699741],
    );
}

#[test]
fn pinned_sliding_beam_wavenumbers_are_odd_halves_of_pi() {
    assert_first_three(End::Pinned, End::Sliding, 0, [PI / 2.0, 1.5 * PI, 2.5 * PI]);
}

#[test]
fn sliding_beam_has_one_rigid_body_mode_then_multiples_of_pi() {
    assert_first_three(End::Sliding, End::Sliding, 1, [PI, 2.0 * PI, 3.0 * PI]);
}

/// The error of a cubic element in a frequency falls with the fourth power of its length.
#[test]
fn frequencies_converge_with_order_4() {
    let exact: f64 = 4.694091132974175;
    let error = |elements| (wavenumbers(elements, End::Clamped, End::Free)[1] / exact).powi(2) - 1.0;
    let slope = (error(8) / error(32)).log2() / 2.0;
    assert!((slope - 4.0).abs() < 0.02, "order {slope}");
}

/// Discretisation leaves 2e-9 at 44 elements and 5e-12 at 200; rounding must not add to it.
#[test]
fn low_modes_of_fine_meshes_keep_their_digits() {
    for (elements, tolerance) in [(44, 3e-9), (200, 1e-10)] {
        let first = wavenumbers(elements, End::Clamped, End::Free)[0].powi(2);
        assert_relative_eq!(first, 1.875104068711961_f64.powi(2), max_relative = tolerance);
    }
}

/// `w^2 = k / m` for a heavy tip on a light cantilever, `k = 3 EI / l^3`; the beam adds 33/140 of its mass.
#[test]
fn heavy_tip_on_a_cantilever_is_a_spring_and_a_mass() {
    let tip = BeamPoint { mass: 1e5, ..bare("tip", 1.0) };
    let structure = unit_beam(8, End::Clamped, End::Free, vec![tip]).structure().unwrap();
    let w = TAU * structure.eigenfrequencies_hz().unwrap()[0];
    assert_relative_eq!(w, (3.0_f64 / (1e5 + 33.0 / 140.0)).sqrt(), max_relative = 1e-9);
}

/// A rigid rotation of a pinned beam on a rotational spring and with a rotary inertia at the pin: light beam.
#[test]
fn rotational_spring_and_inertia_at_a_pin_swing_as_one() {
    let pin = BeamPoint { rotary_inertia: 1e4, rotational_spring: 1e-3, ..bare("pin", 0.0) };
    let structure = unit_beam(4, End::Pinned, End::Free, vec![pin]).structure().unwrap();
    let w = TAU * structure.eigenfrequencies_hz().unwrap()[0];
    assert_relative_eq!(w, (1e-3_f64 / (1e4 + 1.0 / 3.0)).sqrt(), max_relative = 1e-3);
}

/// Cantilever under its own weight: `rho A g l^4 / (8 EI)` at the tip; cubic elements are exact at nodes.
#[test]
fn cantilever_sags_by_an_eighth() {
    let structure = unit_beam(10, End::Clamped, End::Free, vec![]).structure().unwrap();
    assert_relative_eq!(structure.static_deflection("right", 2.0).unwrap(), 0.25, max_relative = 1e-10);
    assert_eq!(structure.static_deflection("left", 2.0).unwrap(), 0.0);
}
