//! Rosenstein, Collins and De Luca, Physica D 65 (1993), 117-134, tables 2 and 3: their method on their examples, with their lengths, delays and dimensions.
//!
//! | system | samples | delay | their errors, one record each | ours, the middle of nine beginnings |
//! |---|---|---|---|---|
//! | logistic, dimension 1 to 5 | 500 | 1 | -2.6, -1.7, -1.9, -1.9, -6.1 % | +0.5, -0.0, -0.5, -1.3, -2.6 % |
//! | Hénon, 2 to 5 | 500 | 1 | -2.2, -2.9, -4.5, -6.2 % | -2.6, -3.3, -4.8, -5.7 % |
//! | Lorenz, 3, 5, 7, 9 | 5000 | 11 | +2.1, -0.1, +4.1, +4.0 % | +0.5, -2.5, +1.0, +2.1 % |
//! | Rössler, 3, 5, 7, 9 | 2000 | 8 | -2.3, -4.0, -5.2, -7.2 % | -6.4, -6.3, -3.6, -6.3 % |
//!
//! Their accuracy, the largest error of a system, is met in every dimension. They chose the straight part by eye. Here it is looked for automatically; for Rössler it is the mean period of
//! steepest growth. Without that, Rössler's exponent comes out a seventh to a fifth too small. Single records of 2000 samples of Rössler scatter by tens of per cent, theirs, too, as their table 3 shows.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod systems;

use hammerbeam_signal::exponent::{DivergenceSettings, EmbeddingChoice, StraightPart, embedding, rosenstein};
use systems::{henon, logistic, lorenz, roessler};

/// A system: series, samples, sampling rate, delay, exponent.
type Example = (fn(f64, usize) -> Vec<f64>, usize, f64, usize, f64);

const ROESSLER: Example = (roessler, 2000, 10.0, 8, 0.090);

/// Exponents of nine beginnings over the true one, less one, the smallest first.
///
/// * `part`: of the states, for which neighbours are followed at most; `None` as it is usual.
fn errors(
    (series, length, rate, delay, exponent): Example,
    dimension: usize,
    (fit, part): (StraightPart, Option<f64>),
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
    let mut errors: Vec<f64> = (0..9).map(error).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// The middle of nine beginnings.
fn middle(example: Example, dimension: usize, fit: StraightPart) -> f64 {
    errors(example, dimension, (fit, None))[4]
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

#[test]
fn roessler_is_within_the_authors_accuracy_over_the_period_of_steepest_growth() {
    for dimension in [3, 5, 7, 9] {
        let error = middle(ROESSLER, dimension, StraightPart::SteepestPeriod);
        assert!(error.abs() <= 0.072, "dimension {dimension}: {error}");
    }
}

/// Their table 3: exponents from one record each, of 800 to 2000 samples in three dimensions. Ours scatter, and theirs lie among them. (Of 400 samples, not seven periods, they print 0.0351; five of nine of our curves have no straight part there.)
#[test]
fn exponents_that_the_authors_print_for_roessler_lie_among_those_of_nine_beginnings() {
    for (length, printed) in [(800, 0.0655), (1200, 0.0918), (1600, 0.0984), (2000, 0.0879)] {
        let example = (roessler as fn(f64, usize) -> Vec<f64>, length, 10.0, 8, 0.090);
        let found = errors(example, 3, (StraightPart::SteepestPeriod, Some(0.5)));
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
