#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use faer::c64;
use hammerbeam_motion::{Law, Stretch, exact::ExactSettings, law::PowerSpring};
use hammerbeam_path::PathProblem;

use super::*;
use crate::{OrbitSettings, eigenvalues::eigenvalues, solve::correct, test_oscillator::oscillator};

/// `x'' + 0.1 x' + x - x^3/10 = 1e-6 cos(2 pi f t)`: on the hill at `x = sqrt(10)` motions part like `exp(l
/// t)`, `l^2 + 0.1 l - 2 = 0`.
fn on_the_hill(frequency_hz: f64, segments: usize) -> Result<(ShootingProblem, Vec<f64>), OrbitError> {
    let (system, _) = oscillator(0.1, 1e-6, Law::Power(PowerSpring::cubic(-0.1).unwrap()));
    let hill = vec![10.0_f64.sqrt(), 0.0];
    let scale = StateScale::new(&[1.0], 1.0, hill[0]);
    let integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let mut problem = ShootingProblem::new(integrator, (1, segments), scale, 1.0);
    let mut point = problem.point(&vec![hill; segments], frequency_hz);
    correct(&mut problem, &mut point, &OrbitSettings::default())?;
    Ok((problem, point))
}

/// The orbit stays within 1e-6 m of the top, so its larger multiplier is `exp(l/f)` to some 1e-12.
#[test]
fn multipliers_of_1e4_to_1e12_are_those_of_the_hill() {
    let growth = -0.05 + (0.0025_f64 + 2.0).sqrt();
    for segments in [4, 16, 64] {
        for power in [4, 6, 8, 10, 12] {
            let expected = 10.0_f64.powi(power);
            let (problem, _) = on_the_hill(growth / expected.ln(), segments).unwrap();
            let [found, _] = eigenvalues(2, problem.monodromy()).unwrap()[0];
            assert!((found / expected - 1.0).abs() < 1e-8, "{found:e} with {segments} segments");
        }
    }
}

/// The orbit is `x = sqrt(10) + Re[a exp(2 pi i f t)]`, `a = 1e-6/(-2 - w^2 + 0.1 i w)`, but for 1e-12 m. A
/// tangent from the condensed equations would be off by as many of its sizes as the multiplier has digits
/// more than a number.
#[test]
fn tangents_beside_multipliers_of_1e4_to_1e24_are_those_of_the_hill() {
    let growth = -0.05 + (0.0025_f64 + 2.0).sqrt();
    for (power, is_condensed) in [(4, true), (6, true), (8, false), (12, false), (24, false)] {
        let frequency_hz = growth / (10.0_f64.powi(power)).ln();
        let (mut problem, point) = on_the_hill(frequency_hz, 16).unwrap();
        problem.evaluate(&point).unwrap();
        let mut tangent = vec![0.0; point.len()];
        *tangent.last_mut().unwrap() = 1.0;
        let row = tangent.clone();
        let determinant = problem.factorise(&row).unwrap();
        assert_eq!(problem.is_condensed, is_condensed);
        let width = problem.put_whole(&row);
        let whole = DenseLu::new().factorise(width, &problem.matrix).unwrap();
        assert_eq!(whole.sign, determinant.sign);
        assert!((whole.log_magnitude - determinant.log_magnitude).abs() < 1e-6, "1e{power}");
        problem.solve(&mut tangent);
        let w = TAU * frequency_hz;
        let stiffness = c64::new(-2.0 - w * w, 0.1 * w);
        let slope = c64::new(2.0 * w, -0.1) * 1e-6 / (stiffness * stiffness) * TAU;
        for (node, found) in tangent.chunks_exact(2).enumerate() {
            let phase = TAU * node as f64 / 16.0;
            let expected = (slope * c64::new(phase.cos(), phase.sin())).re / problem.scale().values()[0];
            // What the error of the motion leaves; the tangent is 1e-7 large.
            assert!((found[0] - expected).abs() < 1e-10, "1e{power}: {} {expected}", found[0]);
        }
    }
}

/// `x'' + 0.2 x' + x + x^3 = 15 cos(2 pi f t)`, which loses its symmetry between 0.099 and 0.153 Hz.
fn duffing(segments: usize, start: [f64; 2], periods: u32) -> (ShootingProblem, Vec<f64>) {
    let (system, _) = oscillator(0.2, 15.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let scale = StateScale::new(&[1.0], 1.0, 3.0);
    let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let part = f64::from(periods) / segments as f64;
    let mut nodes = vec![start.to_vec()];
    for k in 1..segments {
        let (start, end) = ((k - 1) as f64 * part, k as f64 * part);
        nodes.push(integrator.advance(&Stretch { frequency_hz: 0.12, start, end }, &nodes[k - 1]).unwrap());
    }
    let mut problem = ShootingProblem::new(integrator, (periods, segments), scale, 0.5);
    let mut point = problem.point(&nodes, 0.12);
    correct(&mut problem, &mut point, &OrbitSettings::default()).unwrap();
    (problem, point)
}

/// Where an orbit that differs from its mirror image begins, and a symmetric one, at 0.12 Hz.
fn pair_and_symmetric() -> [[f64; 2]; 2] {
    let subject = oscillator(0.2, 15.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let orbit = (0.12, 1);
    let settings = OrbitSettings::default();
    let found =
        crate::find_orbits(&subject.0, &subject.1, orbit, (0.11, 0.13), &settings, &mut || false).unwrap();
    let starts: Vec<[f64; 2]> =
        found.orbits.iter().map(|orbit| [orbit.nodes[0][0], orbit.nodes[0][1]]).collect();
    let off = |start: &[f64; 2]| {
        let (mut problem, point) = duffing(1, *start, 1);
        problem.distance_to_symmetric(&point)
    };
    let farthest = starts.iter().max_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    let nearest = starts.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    [*farthest, *nearest]
}

/// By the nodes, of which two lie half a period apart, and by the motion of the first one, if none do: with
/// two nodes or one it is the same number. That of a symmetric orbit is rounding.
#[test]
fn the_distance_from_symmetric_orbits_is_that_from_the_mirror_image() {
    let [asymmetric, symmetric] = pair_and_symmetric();
    let of = |start: [f64; 2], segments: usize, periods: u32| {
        let (mut problem, point) = duffing(segments, start, periods);
        let distance = problem.distance_to_symmetric(&point);
        problem.note_symmetry(&point);
        (distance, problem.is_asymmetric())
    };
    let (by_motion, by_nodes) = (of(asymmetric, 1, 1), of(asymmetric, 2, 1));
    assert!(by_motion.0 > 1e-2, "{by_motion:?}");
    assert!((by_motion.0 / by_nodes.0 - 1.0).abs() < 1e-7, "{by_motion:?} {by_nodes:?}");
    assert!(by_motion.1 && by_nodes.1 && of(asymmetric, 3, 1).1 && of(asymmetric, 4, 1).1);
    // Gone through three times it has its image one and a half periods later, and twice none.
    assert!((of(asymmetric, 3, 3).0 / by_motion.0 - 1.0).abs() < 1e-6);
    assert!(!of(asymmetric, 2, 2).1);
    for (segments, periods) in [(1, 1), (2, 1), (3, 1), (4, 1), (3, 3), (6, 3)] {
        let (distance, is_asymmetric) = of(symmetric, segments, periods);
        assert!(distance < 1e-7 && !is_asymmetric, "{distance:e}, {segments} segments");
    }
}
