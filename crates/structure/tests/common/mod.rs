//! Structures that several tests share.
#![allow(dead_code, reason = "each test file uses its own part")]

use hammerbeam_structure::{Beam, BeamPoint, Connection, End, Lumped, LumpedMass, Section};

/// Uniform beam of unit `EI`, `rho A` and length, so that its eigenfrequencies are `beta^2` rad/s.
pub fn unit_beam(elements: usize, left: End, right: End, points: Vec<BeamPoint>) -> Beam {
    let section = Section::general(1.0, 1.0).unwrap();
    Beam { length: 1.0, elements, section, youngs_modulus: 1.0, density: 1.0, left, right, points }
}

/// A point that carries nothing.
pub fn bare(name: &str, at: f64) -> BeamPoint {
    BeamPoint { name: name.into(), at, ..BeamPoint::default() }
}

/// The beam of the paper with its contact mass, 44 elements.
pub fn paper_beam() -> Beam {
    let contact = BeamPoint { mass: 0.03756, rotary_inertia: 1.59e-8, ..bare("contact", 0.2432157) };
    Beam {
        length: 0.2579822,
        elements: 44,
        section: Section::rectangle(0.0298, 0.0020).unwrap(),
        youngs_modulus: 2.1e11,
        density: 7800.0,
        left: End::Clamped,
        right: End::Free,
        points: vec![contact],
    }
}

/// Masses, springs and dampers from short lists.
pub fn lumped(
    masses: &[(&str, f64)],
    springs: &[(&str, &str, f64)],
    dampers: &[(&str, &str, f64)],
) -> Lumped {
    let connection =
        |&(a, b, constant): &(&str, &str, f64)| Connection { between: [a.into(), b.into()], constant };
    Lumped {
        masses: masses.iter().map(|&(name, mass)| LumpedMass { name: name.into(), mass }).collect(),
        springs: springs.iter().map(connection).collect(),
        dampers: dampers.iter().map(connection).collect(),
    }
}
