//! Random paths whose folds are known by other means, in random coordinates.

mod support;

use hammerbeam_path::{DenseProblem, Settings};
use proptest::prelude::*;
use support::*;

/// `λ = x + Σ a_k sin(k x + φ_k)`.
fn series(terms: &[(f64, f64)], x: f64) -> (f64, f64) {
    terms.iter().enumerate().fold((x, 1.0), |(value, slope), (k, (a, phase))| {
        let k = (k + 1) as f64;
        (value + a * (k * x + phase).sin(), slope + a * k * (k * x + phase).cos())
    })
}

/// Sign changes of the slope over `x` by bisection, `None` if one comes close to being a double root.
fn expected_folds(terms: &[(f64, f64)], low: f64, high: f64) -> Option<Vec<f64>> {
    let count = 20_000;
    let place = |i: usize| low + (high - low) * i as f64 / count as f64;
    let mut found = Vec::new();
    for i in 0..count {
        let (mut a, mut b) = (place(i), place(i + 1));
        let (sa, sb) = (series(terms, a).1, series(terms, b).1);
        if sa.abs() < 1e-3 && sb.abs() < 1e-3 {
            return None;
        }
        if sa * sb < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if series(terms, middle).1 * sa > 0.0 { a = middle } else { b = middle }
            }
            found.push(series(terms, a).0);
        }
    }
    Some(found)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_series_have_the_same_folds_at_every_step_and_in_all_coordinates(
        terms in prop::collection::vec((-1.0..1.0, 0.0..6.3), 4),
        seed in 0.0..10.0,
    ) {
        let (low, high) = (-3.0, 3.0);
        let expected = expected_folds(&terms, low, high);
        prop_assume!(expected.is_some());
        let expected = expected.unwrap();
        let end = series(&terms, high).0;
        let f = |x: f64, l: f64| {
            let (value, slope) = series(&terms, x);
            (value - l, slope, -1.0, 0)
        };
        for step in [0.05, 0.01] {
            let start = mixed_point(5, seed, low, series(&terms, low).0);
            prop_assume!(series(&terms, low).1.abs() > 0.05);
            let rising = series(&terms, low).1 > 0.0;
            let mut problem = mixed(5, seed, f);
            let branch = if rising {
                up(&mut problem, &start, -20.0, 20.0, steps_of(step))
            } else {
                down(&mut problem, &start, -20.0, 20.0, steps_of(step))
            };
            assert_monotone(&branch, |z| unmixed(5, seed, z));
            let found: Vec<f64> = branch.folds()
                .filter(|point| unmixed(5, seed, &point.point) < high)
                .map(|point| point.parameter())
                .collect();
            prop_assert_eq!(found.len(), expected.len());
            for (a, b) in found.iter().zip(&expected) {
                prop_assert!((a - b).abs() < 1e-10, "{} {}", a, b);
            }
            prop_assert!(branch.points.iter().any(|point| unmixed(5, seed, &point.point) >= high), "{} {:?}", end, branch.stop);
        }
    }

    /// A polygon in three dimensions: corners of all angles, with and without a turn of the parameter.
    #[test]
    fn polygons_are_walked_around_all_corners(
        slopes in prop::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64), 8),
        marked in any::<bool>(),
    ) {
        prop_assume!(slopes.iter().all(|(l, _)| l.abs() > 0.02));
        let corner_value = |k: usize| slopes[..k].iter().fold((0.0, 0.0), |(l, v), (a, b)| (l + 0.1 * a, v + 0.1 * b));
        let piece = |u: f64| {
            let k = ((u / 0.1).floor().max(0.0) as usize).min(slopes.len() - 1);
            let (l, v) = corner_value(k);
            (k, l + slopes[k].0 * (u - 0.1 * k as f64), v + slopes[k].1 * (u - 0.1 * k as f64))
        };
        let mut problem = DenseProblem::new(2, |z: &[f64], r: &mut [f64], j: &mut [f64]| {
            let (k, l, v) = piece(z[0]);
            r.copy_from_slice(&[z[2] - l, z[1] - v]);
            j.copy_from_slice(&[-slopes[k].0, 0.0, 1.0, -slopes[k].1, 1.0, 0.0]);
            if marked { k as u64 } else { 0 }
        });
        let (_, l, v) = piece(0.05);
        let start = [0.05, v, l];
        let branch = if slopes[0].0 > 0.0 {
            up(&mut problem, &start, -6.0, 6.0, Settings::default())
        } else {
            down(&mut problem, &start, -6.0, 6.0, Settings::default())
        };
        let turns = slopes.windows(2).filter(|pair| pair[0].0 * pair[1].0 < 0.0).count();
        assert_monotone(&branch, |z| z[0]);
        prop_assert!(branch.points.last().unwrap().point[0] > 0.75, "{:?} {:?}", branch.stop, branch.points.last());
        prop_assert_eq!(branch.folds().count(), turns);
    }
}
