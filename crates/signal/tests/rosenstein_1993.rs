//! Rosenstein, Collins and De Luca, Physica D 65 (1993), 117-134, tables 2 and 3: their method on their
//! examples, with their lengths, delays and dimensions.
//!
//! | system | samples | delay | their errors, one record each | ours, the middle of nine beginnings |
//! |---|---|---|---|---|
//! | logistic, dimension 1 to 5 | 500 | 1 | -2.6, -1.7, -1.9, -1.9, -6.1 % | +0.5, -0.0, -0.5, -1.3, -2.6 % |
//! | Hénon, 2 to 5 | 500 | 1 | -2.2, -2.9, -4.5, -6.2 % | -2.6, -3.3, -4.8, -5.7 % |
//! | Lorenz, 3, 5, 7, 9 | 5000 | 11 | +2.1, -0.1, +4.1, +4.0 % | +0.5, -2.5, +1.0, +2.1 % |
//!
//! Their accuracy, the largest error of a system, is met for these systems in every dimension. They chose the
//! straight part by eye. Here it is looked for automatically.
//!
//! For Rössler (2000 samples, delay 8, dimensions 3, 5, 7, 9; their errors -2.3, -4.0, -5.2, -7.2 %) it is
//! **missed**. Over the mean period of steepest growth the middle of nine beginnings is a draw: the first
//! nine give -6.4, -6.3, -3.6, -6.3 %, but 60 others have medians of -10.8, -11.3, -11.2, -11.5 %, and
//! middles of nine meet 7.2 % in only 26 to 38 % of draws. Even medians of 60 scatter: three more draws have
//! -1 to -14 %. Without that part, Rössler's exponent comes out a seventh to a fifth too small. Single
//! records of 2000 samples scatter by tens of per cent, theirs, too, as their table 3 shows.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::ops::Range;

use crate::systems::{henon, logistic, lorenz, roessler};
use hammerbeam_signal::exponent::{DivergenceSettings, EmbeddingChoice, StraightPart, embedding, rosenstein};

/// A system: series, samples, sampling rate, delay, exponent.
type Example = (fn(f64, usize) -> Vec<f64>, usize, f64, usize, f64);

const ROESSLER: Example = (roessler, 2000, 10.0, 8, 0.090);

/// Exponents of some beginnings over the true one, less one, the smallest first.
///
/// * `beginnings`: their numbers.
/// * `part`: of the states, for which neighbours are followed at most; `None` as it is usual.
fn errors(
    (series, length, rate, delay, exponent): Example,
    dimension: usize,
    (fit, part): (StraightPart, Option<f64>),
    beginnings: Range<u32>,
) -> Vec<f64> {
    let choice = EmbeddingChoice { delay: Some(delay), dimension: Some(dimension), theiler_window: None };
    let error = |start: u32| {
        let series = series(0.137 * f64::from(start), length);
        let embedding = embedding(&series, &choice).unwrap();
        let most = part.map(|part| (part * length as f64) as usize);
        let steps = most.map(|most| most.min((7.0 * embedding.mean_period) as usize));
        let found = rosenstein(&series, rate, &embedding, &DivergenceSettings { steps, fit }).unwrap();
        found.exponent.value / exponent - 1.0
    };
    let mut errors: Vec<f64> = beginnings.map(error).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// The middle of nine beginnings.
fn middle(example: Example, dimension: usize, fit: StraightPart) -> f64 {
    errors(example, dimension, (fit, None), 0..9)[4]
}

#[test]
fn logistic_map_henon_and_lorenz_are_within_the_authors_accuracy_in_every_dimension() {
    let systems: [(Example, &[usize], f64); 3] = [
        ((logistic, 500, 1.0, 1, 0.693), &[1, 2, 3, 4, 5], 0.061),
        ((henon, 500, 1.0, 1, 0.418), &[2, 3, 4, 5], 0.062),
        ((lorenz, 5000, 100.0, 11, 1.50), &[3, 5, 7, 9], 0.041),
    ];
    for (example, dimensions, accuracy) in systems {
        for &dimension in dimensions {
            let error = middle(example, dimension, StraightPart::Found);
            assert!(error.abs() <= accuracy, "{} samples, dimension {dimension}: {error}", example.1);
        }
    }
}

/// The authors' 7.2 % is missed, or met by chance. The tolerance is what is left: middles of sixty beginnings
/// are a draw, too (quartiles of single ones are 14 % to each side of the middle, so that a middle of sixty
/// has a standard error of 3.3 %). About -8 %, the middle of 180, three times that is allowed, and rounded
/// up.
#[test]
fn roessler_over_the_period_of_steepest_growth_is_within_a_fifth_in_the_middle_of_sixty_beginnings() {
    for dimension in [3, 5, 7, 9] {
        let found = errors(ROESSLER, dimension, (StraightPart::SteepestPeriod, None), 9..69);
        let middle = 0.5 * (found[29] + found[30]);
        assert!((-0.20..0.05).contains(&middle), "dimension {dimension}: {middle}");
    }
}

/// Their table 3: exponents from one record each, of 800 to 2000 samples in three dimensions. Ours scatter,
/// and theirs lie among them. (Of 400 samples, not seven periods, they print 0.0351; five of nine of our
/// curves have no straight part there.)
#[test]
fn exponents_that_the_authors_print_for_roessler_lie_among_those_of_nine_beginnings() {
    for (length, printed) in [(800, 0.0655), (1200, 0.0918), (1600, 0.0984), (2000, 0.0879)] {
        let example = (roessler as fn(f64, usize) -> Vec<f64>, length, 10.0, 8, 0.090);
        let found = errors(example, 3, (StraightPart::SteepestPeriod, Some(0.5)), 0..9);
        let printed = printed / 0.090 - 1.0;
        assert!(found[0] <= printed && printed <= found[8], "{length} samples: {printed:.3} {found:.3?}");
    }
}

/// Between 30 % and 70 % of the rise, which is what is taken if nothing is said, their accuracy is missed.
#[test]
fn roessler_comes_out_a_seventh_to_a_fifth_too_small_where_the_part_is_not_a_period() {
    for dimension in [3, 5, 7, 9] {
        let error = middle(ROESSLER, dimension, StraightPart::Found);
        assert!((-0.21..-0.12).contains(&error), "dimension {dimension}: {error}");
    }
}
