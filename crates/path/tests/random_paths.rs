//! Random paths whose folds are known by other means, in random coordinates.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::*;
use hammerbeam_path::{DenseProblem, PathStop, Settings};
use proptest::prelude::*;

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
        if sa.abs() < 1e-5 && sb.abs() < 1e-5 {
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

/// Slopes of either sign from 0.01 to 100.
fn slope() -> impl Strategy<Value = f64> {
    (-2.0..2.0, any::<bool>())
        .prop_map(|(power, falls)| 10.0_f64.powf(power) * if falls { -1.0 } else { 1.0 })
}

/// `λ` and `v` piecewise linear in `u`; the first and last pieces go on beyond their ends.
struct Polygon<'a> {
    pieces: &'a [(f64, f64, f64)],
    knots: Vec<f64>,
    values: Vec<(f64, f64)>,
}

impl<'a> Polygon<'a> {
    /// Pieces of length `10^a`, slopes `dλ/du` and `dv/du`.
    fn new(pieces: &'a [(f64, f64, f64)]) -> Self {
        let (mut knots, mut values) = (vec![0.0], vec![(0.0, 0.0)]);
        for (k, (power, l, v)) in pieces.iter().enumerate() {
            let length = 10.0_f64.powf(*power);
            knots.push(knots[k] + length);
            values.push((values[k].0 + l * length, values[k].1 + v * length));
        }
        Self { pieces, knots, values }
    }

    /// `(piece, λ, v)` at `u`.
    fn at(&self, u: f64) -> (usize, f64, f64) {
        let k = (0..self.pieces.len()).rev().find(|k| u >= self.knots[*k]).unwrap_or(0);
        let (l, v) = self.values[k];
        (k, l + self.pieces[k].1 * (u - self.knots[k]), v + self.pieces[k].2 * (u - self.knots[k]))
    }
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
            let arrives = branch.points.iter().any(|point| unmixed(5, seed, &point.point) >= high);
            prop_assert!(arrives, "{} {:?}", end, branch.stop);
        }
    }

    /// A polygon in three dimensions: corners of all angles, with and without a turn of the parameter, pieces
    /// from 0.1 down to 1e-6 long. Pieces shorter than the steps are seen by their signature alone.
    #[test]
    fn polygons_are_walked_around_all_corners(
        pieces in prop::collection::vec((-6.0..-1.0, slope(), slope()), 8),
        step in prop::sample::select(vec![0.05, 0.01, 0.001]),
        marked in any::<bool>(),
    ) {
        let polygon = Polygon::new(&pieces);
        let mut problem = DenseProblem::new(2, |z: &[f64], r: &mut [f64], j: &mut [f64]| {
            let (k, l, v) = polygon.at(z[0]);
            r.copy_from_slice(&[z[2] - l, z[1] - v]);
            j.copy_from_slice(&[-pieces[k].1, 0.0, 1.0, -pieces[k].2, 1.0, 0.0]);
            if marked { k as u64 } else { 0 }
        });
        let middle = 0.5 * polygon.knots[1];
        let (_, l, v) = polygon.at(middle);
        let settings = Settings { max_points: 20_000, ..steps_of(step) };
        let follow_up_or_down = if pieces[0].1 > 0.0 { up } else { down };
        let branch = follow_up_or_down(&mut problem, &[middle, v, l], -100.0, 100.0, settings);
        assert_monotone(&branch, |z| z[0]);
        let last = polygon.knots[pieces.len() - 1];
        let reached = branch.points.last().unwrap().point[0] >= last;
        let last = branch.points.last();
        prop_assert!(reached || branch.stop == PathStop::Budget, "{:?} {:?}", branch.stop, last);
        if marked && reached {
            let turns = pieces.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0).count();
            prop_assert_eq!(branch.folds().count(), turns);
        }
    }
}
