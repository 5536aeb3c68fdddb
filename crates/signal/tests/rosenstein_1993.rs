//! Rosenstein, Collins and De Luca, Physica D 65 (1993), 117-134, tables 2 and 3: their method on their
//! examples, with their lengths, delays and dimensions.
//!
//! | system | samples | delay | their errors, one record each | ours, the median of nine initial states |
//! |---|---|---|---|---|
//! | logistic, dimension 1 to 5 | 500 | 1 | -2.6, -1.7, -1.9, -1.9, -6.1 % | +0.5, -0.0, -0.5, -1.3, -2.6 % |
//! | Hénon, 2 to 5 | 500 | 1 | -2.2, -2.9, -4.5, -6.2 % | -2.6, -3.3, -4.8, -5.7 % |
//! | Lorenz, 3, 5, 7, 9 | 5000 | 11 | +2.1, -0.1, +4.1, +4.0 % | +0.5, -2.5, +1.0, +2.1 % |
//!
//! Their accuracy, the largest error of a system, is met for these systems in every dimension. They chose the
//! straight part by eye. Here it is found automatically.
//!
//! For Rössler (2000 samples, delay 8, dimensions 3, 5, 7, 9; their errors -2.3, -4.0, -5.2, -7.2 %) it is
//! **missed**. Over the mean period of steepest growth the median of nine initial states depends on their
//! choice: the first nine give -6.4, -6.3, -3.6, -6.3 %, but 60 others have medians of -10.8, -11.3, -11.2,
//! -11.5 %. Medians of nine are within 7.2 % for only 26 to 38 % of the choices. Even medians of 60 scatter:
//! three more sets have -1 to -14 %. With the automatic part, Rössler's exponent comes out a seventh to a
//! fifth too small. Single records of 2000 samples scatter by tens of per cent, as do theirs in their table
//! 3.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::ops::Range;

use crate::systems::{henon, logistic, lorenz, roessler};
use hammerbeam_signal::exponent::{DivergenceSettings, EmbeddingChoice, StraightPart, embedding, rosenstein};

/// A system with what the authors used for it.
#[derive(Clone, Copy)]
struct Example {
    /// The series of a system from an initial state, and its length.
    series: fn(f64, usize) -> Vec<f64>,
    /// Samples.
    length: usize,
    /// Samples per unit of time.
    rate: f64,
    /// Samples.
    delay: usize,
    /// Per unit of time.
    exponent: f64,
}

const ROESSLER: Example = Example { series: roessler, length: 2000, rate: 10.0, delay: 8, exponent: 0.090 };

/// Relative errors of exponents from several initial states, the smallest first.
///
/// * `starts`: numbers of the initial states.
/// * `part`: fraction of the samples for which neighbours are followed at most; `None` for the default.
fn errors(
    example: Example,
    dimension: usize,
    (fit, part): (StraightPart, Option<f64>),
    starts: Range<u32>,
) -> Vec<f64> {
    let Example { series, length, rate, delay, exponent } = example;
    let choice = EmbeddingChoice { delay: Some(delay), dimension: Some(dimension), theiler_window: None };
    let error = |start: u32| {
        let series = series(0.137 * f64::from(start), length);
        let embedding = embedding(&series, &choice).unwrap();
        let most = part.map(|part| (part * length as f64) as usize);
        let steps = most.map(|most| most.min((7.0 * embedding.mean_period) as usize));
        let found = rosenstein(&series, rate, &embedding, &DivergenceSettings { steps, fit }).unwrap();
        found.exponent.value / exponent - 1.0
    };
    let mut errors: Vec<f64> = starts.map(error).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// The median of nine initial states.
fn median(example: Example, dimension: usize, fit: StraightPart) -> f64 {
    errors(example, dimension, (fit, None), 0..9)[4]
}

#[test]
fn logistic_map_henon_and_lorenz_are_within_the_authors_accuracy_in_every_dimension() {
    let systems: [(Example, &[usize], f64); 3] = [
        (
            Example { series: logistic, length: 500, rate: 1.0, delay: 1, exponent: 0.693 },
            &[1, 2, 3, 4, 5],
            0.061,
        ),
        (Example { series: henon, length: 500, rate: 1.0, delay: 1, exponent: 0.418 }, &[2, 3, 4, 5], 0.062),
        (
            Example { series: lorenz, length: 5000, rate: 100.0, delay: 11, exponent: 1.50 },
            &[3, 5, 7, 9],
            0.041,
        ),
    ];
    for (example, dimensions, accuracy) in systems {
        for &dimension in dimensions {
            let error = median(example, dimension, StraightPart::Found);
            assert!(error.abs() <= accuracy, "{} samples, dimension {dimension}: {error}", example.length);
        }
    }
}

/// The 7.2 % of the authors is missed, or met by chance. Medians of sixty initial states scatter, too: the
/// quartiles of single ones are 14 % on each side of the median, so a median of sixty has a standard error of
/// 3.3 %. The tolerance is three times that about -8 %, the median of 180, rounded up.
#[test]
fn roessler_over_the_period_of_steepest_growth_is_within_a_fifth_in_the_median_of_sixty_initial_states() {
    for dimension in [3, 5, 7, 9] {
        let found = errors(ROESSLER, dimension, (StraightPart::SteepestPeriod, None), 9..69);
        let median = 0.5 * (found[29] + found[30]);
        assert!((-0.20..0.05).contains(&median), "dimension {dimension}: {median}");
    }
}

/// Their table 3: exponents from one record each, of 800 to 2000 samples in three dimensions. Ours scatter,
/// and theirs lie among them. (Of 400 samples, not seven periods, they print 0.0351; five of nine of our
/// curves have no straight part there.)
#[test]
fn exponents_that_the_authors_print_for_roessler_lie_among_nine_initial_states() {
    for (length, printed) in [(800, 0.0655), (1200, 0.0918), (1600, 0.0984), (2000, 0.0879)] {
        let example = Example { length, ..ROESSLER };
        let found = errors(example, 3, (StraightPart::SteepestPeriod, Some(0.5)), 0..9);
        let printed = printed / 0.090 - 1.0;
        assert!(found[0] <= printed && printed <= found[8], "{length} samples: {printed:.3} {found:.3?}");
    }
}

/// Between 30 % and 70 % of the rise, the default, their accuracy is missed.
#[test]
fn roessler_comes_out_a_seventh_to_a_fifth_too_small_where_the_part_is_not_a_period() {
    for dimension in [3, 5, 7, 9] {
        let error = median(ROESSLER, dimension, StraightPart::Found);
        assert!((-0.21..-0.12).contains(&error), "dimension {dimension}: {error}");
    }
}
