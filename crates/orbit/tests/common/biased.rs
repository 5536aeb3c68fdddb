//! A hardening spring under a constant load, whose orbits of one period flip twice.

use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::PowerSpring};
use hammerbeam_orbit::{BranchRow, OrbitSettings, Response, Side, find_start};
use hammerbeam_structure::{PointOutput, ReducedModel};

use super::{
    events::{side, with},
    independent::Case,
};

/// `x'' + 0.1 x' + x + x^3 = 2 + 8 cos(2 pi f t)`: the constant load makes its spring asymmetric, so that the
/// force shakes its stiffness.
pub fn biased() -> Case {
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| 0.1),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let force = |order, amplitude| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![force(0, 2.0), force(1, 8.0)] };
    let law = Law::Power(PowerSpring::cubic(1.0).unwrap());
    let spring = LocalElement { name: "spring".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    (
        System::new(model, &load, vec![spring]).unwrap(),
        Response { shape: vec![1.0], support_ratios: vec![0.0] },
    )
}

/// The two flips of the orbits of one period.
pub fn flips(case: &Case) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(RANGE_HZ);
    let start = find_start(&case.0, &case.1, 0.31, 1, &settings).unwrap();
    let (rows, _) = side(case, &start, Side::Up, RANGE_HZ, &settings);
    with(&rows, |events| events.flip).into_iter().cloned().collect()
}

/// Frequencies over which its branches are followed [Hz].
pub const RANGE_HZ: (f64, f64) = (0.3, 0.4);
