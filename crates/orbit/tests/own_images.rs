//! Curves of folds that come to orbits which are their own image: to orbits of half the period, and to
//! symmetric ones.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{
    biased::{RANGE_HZ, biased, flips},
    events::{leaving, side, with},
    independent::{Case, curve, marked, with as with_parameter},
};
use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System, law::PowerSpring,
};
use hammerbeam_orbit::{BranchRow, CurveEnd, CurveKind, OrbitSettings, Response, Side, find_start};
use hammerbeam_structure::{PointOutput, ReducedModel};

const DAMPING: Parameter = Parameter::ADDED_DAMPING_RATIO;
const FORCE: Parameter = Parameter::ExcitationScale;

/// The degenerate flip of the curve of flips, which `criticality.rs` finds again by the orbits that branch
/// off.
#[test]
fn the_folds_of_doubled_orbits_end_at_the_degenerate_flip() {
    let case = biased();
    let (rows, _) = curve(&case, &flips(&case)[1], CurveKind::Flip, (DAMPING, (-0.04, 0.1), RANGE_HZ));
    let degenerate = marked(&rows, "degenerate-flip")[0].clone();
    let beside = with_parameter(&case, DAMPING, degenerate.parameter + 5e-4);
    let settings = OrbitSettings::for_range(RANGE_HZ);
    let (rows, _) = leaving(&beside, &flips(&beside)[1], Side::Up, RANGE_HZ, &settings);
    let fold = with(&rows, |events| events.fold)[0];
    let (rows, ends) = curve(&beside, fold, CurveKind::Fold, (DAMPING, (-0.04, 0.1), RANGE_HZ));
    let [CurveEnd::OwnImage { parameter, mirrored: false }, CurveEnd::RangeEnd] = ends else {
        panic!("{ends:?}");
    };
    let found = marked(&rows, "degenerate-flip");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].parameter, parameter);
    // Derivatives are known to about 1e-8.
    assert!((parameter - degenerate.parameter).abs() < 1e-9, "{parameter} and {}", degenerate.parameter);
    let hertz = [found[0], &degenerate].map(|row| row.solution.frequency_hz);
    assert!((hertz[0] / hertz[1] - 1.0).abs() < 1e-9, "{hertz:?}");
    let orbit = &found[0].solution;
    assert_eq!(orbit.period_multiple, 2);
    let apart = orbit.nodes[0].iter().zip(&orbit.nodes[orbit.nodes.len() / 2]).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-10, "{:?}", orbit.nodes);
}

/// Masses of 0.883 and 1.038 kg on springs of 2.226 N/m to the ground and 2.601 N/m between them, dampers of
/// 0.02 and 0.05 N s/m beside these, a cubic spring of 1.807 N/m^3 and the force at the second.
fn two_masses() -> Case {
    let ([m, n], [k, l], [c, d]) = ([0.883_f64, 1.038_f64], [2.226, 2.601], [0.02, 0.05]);
    // M^-1/2 K M^-1/2 is turned into its axes.
    let (a, b, off) = ((k + l) / m, l / n, -l / (m * n).sqrt());
    let angle = 0.5 * (2.0 * off).atan2(a - b);
    let (cos, sin) = (angle.cos(), angle.sin());
    let squares = [(cos, sin), (-sin, cos)].map(|(x, y)| a * x * x + 2.0 * off * x * y + b * y * y);
    // Shapes of the masses: the second angle comes first, as its mode is the slower one.
    let shapes = [(-sin, cos), (cos, sin)].map(|(x, y)| [x / m.sqrt(), y / n.sqrt()]);
    let stretch = |i: usize| shapes[i][1] - shapes[i][0];
    let damping = Mat::from_fn(2, 2, |i, j| c * shapes[i][0] * shapes[j][0] + d * stretch(i) * stretch(j));
    let second = vec![shapes[0][1], shapes[1][1]];
    let model = ReducedModel {
        natural_frequencies: vec![squares[1].sqrt(), squares[0].sqrt()],
        damping,
        points: vec![PointOutput { name: "second".into(), shape: second.clone(), support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: second.clone(),
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.403, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: second.clone(), harmonic }] };
    let law = Law::Power(PowerSpring::cubic(1.807).unwrap());
    let spring =
        LocalElement { name: "spring".into(), shape: second.clone(), support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![spring]).unwrap(), Response { shape: second, support_ratios: vec![0.0] })
}

const PAIR_HZ: (f64, f64) = (0.103, 0.106);

/// Where the symmetric orbits lose their symmetry, and the fold of the pair that branches off there.
fn branch_point_and_fold(case: &Case) -> [BranchRow; 2] {
    let settings = OrbitSettings::for_range(PAIR_HZ);
    let start = find_start(&case.0, &case.1, PAIR_HZ.1, 1, &settings).unwrap();
    let (rows, _) = side(case, &start, Side::Down, PAIR_HZ, &settings);
    let point = with(&rows, |events| events.branch_point)[0].clone();
    let (rows, _) = leaving(case, &point, Side::Up, PAIR_HZ, &settings);
    let fold = with(&rows, |events| events.fold)[0].clone();
    [point, fold]
}

/// Where the polynomial of x over y through these points has its value for `y = 0`.
fn zero(x: &[f64], y: &[f64]) -> f64 {
    let weight =
        |i: usize| -> f64 { (0..y.len()).filter(|j| *j != i).map(|j| -y[j] / (y[i] - y[j])).product() };
    (0..x.len()).map(|i| weight(i) * x[i]).sum()
}

/// The distance from the branch point to the fold is the square of a function of the force, which has its
/// zero there.
#[test]
fn the_folds_of_mirror_images_end_where_these_branch_off_to_the_other_side() {
    let case = two_masses();
    let fold = &branch_point_and_fold(&case)[1];
    let (rows, ends) = curve(&case, fold, CurveKind::Fold, (FORCE, (0.9, 1.3), PAIR_HZ));
    let [CurveEnd::RangeEnd, CurveEnd::OwnImage { parameter, mirrored: true }] = ends else {
        panic!("{ends:?}");
    };
    let found = marked(&rows, "degenerate-branch-point");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].parameter, parameter);

    let forces = [1.05, 1.06, 1.07, 1.08];
    let distances = forces.map(|force| {
        let [point, fold] =
            branch_point_and_fold(&with_parameter(&case, FORCE, force)).map(|row| row.solution.frequency_hz);
        (fold - point).sqrt()
    });
    let place = zero(&forces, &distances);
    println!("{place} {parameter}");
    assert!((place - parameter).abs() < 1e-5, "{place} and {parameter}");

    let at = with_parameter(&case, FORCE, parameter);
    let settings = OrbitSettings::for_range(PAIR_HZ);
    let start = find_start(&at.0, &at.1, PAIR_HZ.1, 1, &settings).unwrap();
    let (branch, _) = side(&at, &start, Side::Down, PAIR_HZ, &settings);
    let point = &with(&branch, |events| events.branch_point)[0].solution;
    let hertz = [point.frequency_hz, found[0].solution.frequency_hz];
    assert!((hertz[0] / hertz[1] - 1.0).abs() < 1e-8, "{hertz:?}");
}
