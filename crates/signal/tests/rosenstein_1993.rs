//! Rosenstein, Collins and De Luca, Physica D 65 (1993), 117-134, table 2: their method on their examples, with their lengths, delays and dimensions.
//!
//! | system | samples | delay | their errors, one record each | ours, the middle of nine beginnings |
//! |---|---|---|---|---|
//! | logistic, dimension 1 to 5 | 500 | 1 | -2.6, -1.7, -1.9, -1.9, -6.1 % | +0.6, +0.4, -0.1, -0.8, -2.0 % |
//! | Hénon, 2 to 5 | 500 | 1 | -2.2, -2.9, -4.5, -6.2 % | -4.6, -6.0, -7.7, -9.9 % |
//! | Lorenz, 3, 5, 7, 9 | 5000 | 11 | +2.1, -0.1, +4.1, +4.0 % | +0.5, -2.5, +1.0, +2.1 % |
//! | Rössler, 3, 5, 7, 9 | 2000 | 8 | -2.3, -4.0, -5.2, -7.2 % | **-19.5, -18.1, -16.2, -14.1 %** |
//!
//! Their accuracy, the largest error of a system, is met for the logistic map and Lorenz, for Hénon up to three coordinates, and missed for Rössler. They chose the straight part by eye; here it is found automatically. Single
//! records of 2000 samples of Rössler scatter from -47 % to 0, wherever the part is taken.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod systems;

use hammerbeam_signal::exponent::{DivergenceSettings, EmbeddingChoice, embedding, rosenstein};
use systems::{henon, logistic, lorenz, roessler};

/// A system: series, samples, sampling rate, delay, exponent.
type Example = (fn(f64, usize) -> Vec<f64>, usize, f64, usize, f64);

/// The middle error of nine beginnings.
fn middle((series, length, rate, delay, exponent): Example, dimension: usize) -> f64 {
    let choice = EmbeddingChoice { delay: Some(delay), dimension: Some(dimension), theiler_window: None };
    let error = |start: u32| {
        let series = series(0.137 * f64::from(start), length);
        let embedding = embedding(&series, &choice).unwrap();
        let found = rosenstein(&series, rate, &embedding, &DivergenceSettings::default()).unwrap();
        found.exponent.value / exponent - 1.0
    };
    let mut errors: Vec<f64> = (0..9).map(error).collect();
    errors.sort_by(f64::total_cmp);
    errors[4]
}

#[test]
fn logistic_map_and_lorenz_are_within_the_authors_accuracy_in_every_dimension() {
    for dimension in 1..=5 {
        let error = middle((logistic, 500, 1.0, 1, 0.693), dimension);
        assert!(error.abs() <= 0.061, "dimension {dimension}: {error}");
    }
    for dimension in [3, 5, 7, 9] {
        let error = middle((lorenz, 5000, 100.0, 11, 1.50), dimension);
        assert!(error.abs() <= 0.041, "dimension {dimension}: {error}");
    }
}

#[test]
fn henon_is_within_the_authors_accuracy_in_two_and_three_dimensions_and_up_to_a_tenth_low_in_more() {
    for (dimension, accuracy) in [(2, 0.062), (3, 0.062), (4, 0.085), (5, 0.105)] {
        let error = middle((henon, 500, 1.0, 1, 0.418), dimension);
        assert!((-accuracy..0.0).contains(&error), "dimension {dimension}: {error}");
    }
}

/// Missed: their accuracy is 7.2 %.
#[test]
fn roessler_comes_out_a_seventh_to_a_fifth_too_small() {
    for dimension in [3, 5, 7, 9] {
        let error = middle((roessler, 2000, 10.0, 8, 0.090), dimension);
        assert!((-0.21..-0.12).contains(&error), "dimension {dimension}: {error}");
    }
}
