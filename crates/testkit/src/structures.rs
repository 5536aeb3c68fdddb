//! Structures and their models.

use std::f64::consts::TAU;

use faer::Mat;
use hammerbeam_structure::{
    Beam, BeamPoint, Connection, Damping, End, GROUND, Lumped, LumpedMass, PointOutput, ReducedModel,
    Reduction, Section, SupportInput,
};

/// The beam of van de Vorst, Fey, de Kraker and van Campen with its contact mass, in 44 elements.
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

/// The beam of the paper, shaken at its clamped end, with the modes up to 1 kHz and residual flexibility.
pub fn paper_beam_model(damping_ratio: f64) -> ReducedModel {
    let shaken = paper_beam().structure().unwrap().with_support_motion(&["left"]).unwrap();
    let reduction = Reduction::FreeInterface { cut_off_hz: 1000.0 };
    shaken.reduce(&reduction, &Damping::modal(damping_ratio), &["contact"]).unwrap().model
}

/// The paper's beam in its six modal coordinates, from the printed digits of the reference table "In modal
/// coordinates of the reduced clamped beam".
pub fn paper_modes(damping_ratio: f64) -> ReducedModel {
    let frequencies = [17.49546, 137.27615, 414.31135, 843.22742, 1538.84987, 3945.26664];
    let shape = vec![3.719882, 1.767674, 1.071971, 0.656816, 0.374580, 1.326146];
    let inertia = vec![0.326581, -0.160943, 0.092436, -0.064797, 0.065038, -0.029896];
    let natural_frequencies: Vec<f64> = frequencies.iter().map(|f| TAU * f).collect();
    let damping = modal_damping(&natural_frequencies, damping_ratio);
    ReducedModel {
        points: vec![PointOutput { name: "contact".into(), shape, support_ratios: vec![1.0] }],
        supports: vec![SupportInput { inertia, damping: vec![0.0; 6] }],
        ..modes(&natural_frequencies, damping)
    }
}

/// Uniform beam of unit `EI`, `rho A` and length, so that its eigenfrequencies are `beta^2` rad/s.
pub fn unit_beam(elements: usize, left: End, right: End, points: Vec<BeamPoint>) -> Beam {
    let section = Section::general(1.0, 1.0).unwrap();
    Beam { length: 1.0, elements, section, youngs_modulus: 1.0, density: 1.0, left, right, points }
}

/// A point of a beam that carries nothing.
pub fn bare(name: &str, at: f64) -> BeamPoint {
    BeamPoint { name: name.into(), at, ..BeamPoint::default() }
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

/// The model of masses along a line with springs and dampers between them.
pub fn masses(
    masses: &[(&str, f64)],
    springs: &[(&str, &str, f64)],
    dampers: &[(&str, &str, f64)],
    ground_moves: bool,
) -> ReducedModel {
    let structure = lumped(masses, springs, dampers).structure().unwrap();
    let structure = if ground_moves { structure.with_support_motion(&[GROUND]).unwrap() } else { structure };
    structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model
}

/// One mass with a spring and a damper to the ground, which can move if `ground_moves`.
pub fn single_mass(mass: f64, stiffness: f64, damping: f64, ground_moves: bool) -> ReducedModel {
    masses(&[("mass", mass)], &[("mass", GROUND, stiffness)], &[("mass", GROUND, damping)], ground_moves)
}

/// A model of these modes, in rad/s, without points and without support motion.
pub fn modes(natural_frequencies: &[f64], damping: Mat<f64>) -> ReducedModel {
    ReducedModel {
        natural_frequencies: natural_frequencies.to_vec(),
        damping,
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0; natural_frequencies.len()],
    }
}

/// `x'' + damping x' + stiffness x = 0`, with the point "mass" that rides on no support.
pub fn unit_mass(stiffness: f64, damping: f64) -> ReducedModel {
    ReducedModel {
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        uniform_acceleration: vec![1.0],
        ..modes(&[stiffness.sqrt()], Mat::from_fn(1, 1, |_, _| damping))
    }
}

/// A diagonal matrix.
pub fn diagonal(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), values.len(), |i, j| if i == j { values[i] } else { 0.0 })
}

/// Diagonal damping matrix of one damping ratio for all modes, given in rad/s.
pub fn modal_damping(natural_frequencies: &[f64], ratio: f64) -> Mat<f64> {
    let values: Vec<f64> = natural_frequencies.iter().map(|frequency| 2.0 * ratio * frequency).collect();
    diagonal(&values)
}
