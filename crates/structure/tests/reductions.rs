//! Guyan's reduction and MacNeal's, against closed forms and what they have to keep.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{paper_beam, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{Damping, End, Reduced, Reduction, Structure, StructureError};

fn reduced(structure: &Structure, reduction: Reduction, interface: &[&str]) -> Reduced {
    structure.reduce(&reduction, &Damping::none(), interface).unwrap()
}

/// Rayleigh: a cantilever that bends as under a force at its tip, `3 E I/l^3` and 33/140 of its mass. Cubic
/// elements hold that shape exactly.
#[test]
fn guyan_makes_a_cantilever_a_spring_with_33_of_140_parts_of_its_mass() {
    let cantilever = unit_beam(12, End::Clamped, End::Free, vec![]).structure().unwrap();
    let found = reduced(&cantilever, Reduction::Guyan { cut_off_hz: 10.0 }, &["right"]);
    assert_eq!(found.model.dof(), 1);
    let expected = (3.0_f64 * 140.0 / 33.0).sqrt();
    assert_relative_eq!(found.model.natural_frequencies[0], expected, max_relative = 1e-10);
    let flexibility = &found.tables.flexibility_errors[0];
    assert_relative_eq!(flexibility.reduced, 1.0 / 3.0, max_relative = 1e-10);
    // 1.5 % above the exact frequency, and told.
    assert_relative_eq!(found.tables.frequency_errors[0].relative, 0.01465, max_relative = 0.01);
}

#[test]
fn guyan_needs_an_interface_that_holds_the_structure() {
    let beam = unit_beam(12, End::Free, End::Free, vec![]).structure().unwrap();
    let reduce = |interface: &[&str]| {
        beam.reduce(&Reduction::Guyan { cut_off_hz: 10.0 }, &Damping::none(), interface).unwrap_err()
    };
    assert_eq!(reduce(&[]), StructureError::NoInterface);
    assert_eq!(reduce(&["right"]), StructureError::NotHeld { rigid_modes: 1 });
    // Two points hold it: then rigid-body motions are static shapes, and stay exact.
    let found = reduced(&beam, Reduction::Guyan { cut_off_hz: 10.0 }, &["left", "right"]);
    assert_eq!(found.model.natural_frequencies, [0.0, 0.0]);
}

/// Without a moving support the kept modes are eigenmodes in either form, and the residual mode brings the
/// static flexibility; MacNeal's has no inertia, so it stands at a hundred times the highest frequency.
#[test]
fn macneal_keeps_the_static_answer_of_the_residual_modes_alone() {
    let beam = paper_beam().structure().unwrap();
    let cut_off_hz = 1000.0;
    let rubin = reduced(&beam, Reduction::FreeInterface { cut_off_hz }, &["contact"]);
    let macneal = reduced(&beam, Reduction::MacNeal { cut_off_hz }, &["contact"]);
    let kept = rubin.tables.free_interface_hz.len();
    assert_eq!((macneal.model.dof(), macneal.tables.free_interface_hz.len()), (kept + 1, kept));
    let (of_rubin, of_macneal) = (&rubin.model.natural_frequencies, &macneal.model.natural_frequencies);
    for mode in 0..kept {
        assert_relative_eq!(of_macneal[mode], of_rubin[mode], max_relative = 1e-11);
    }
    assert_relative_eq!(of_macneal[kept], 100.0 * of_macneal[kept - 1], max_relative = 1e-9);
    assert!(of_rubin[kept] > TAU * cut_off_hz && of_rubin[kept] < 0.5 * of_macneal[kept]);
    for found in [&rubin, &macneal] {
        assert!(found.tables.flexibility_errors[0].relative.abs() < 1e-8);
    }
}

/// On a moving support the modes change: both forms meet those below the cut-off, that with inertia better.
#[test]
fn inertia_of_residual_modes_brings_frequencies_nearer() {
    let shaken = paper_beam().structure().unwrap().with_support_motion(&["left"]).unwrap();
    let cut_off_hz = 1000.0;
    let worst = |reduction| {
        let found = reduced(&shaken, reduction, &["contact"]);
        assert!(found.tables.flexibility_errors[0].relative.abs() < 1e-8);
        let below = found.tables.frequency_errors.into_iter().filter(|error| error.below_cut_off);
        below.map(|error| error.relative.abs()).fold(0.0, f64::max)
    };
    let rubin = worst(Reduction::FreeInterface { cut_off_hz });
    let macneal = worst(Reduction::MacNeal { cut_off_hz });
    assert!(rubin < macneal && macneal < 0.05, "{rubin:e} {macneal:e}");
}
