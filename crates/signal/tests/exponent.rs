//! Largest exponents from series of the systems that the authors of the methods used.
//!
//! | system | parameters | sampling | largest exponent |
//! |---|---|---|---|
//! | logistic map | 4 | 1 | 0.693 (ln 2, exact) |
//! | Hénon | 1.4, 0.3 | 1 | 0.418 (0.603 bits) |
//! | Lorenz | 16, 45.92, 4 | 0.01 s | 1.50 1/s (2.16 bits/s) |
//! | Rössler | 0.15, 0.2, 10 | 0.1 s | 0.090 1/s (0.13 bits/s) |
//!
//! Exponents by Wolf et al. 1985, table 1; delays, dimensions and lengths by Rosenstein et al. 1993. The
//! exponent of a single record of these lengths depends on its initial state by several per cent, so each
//! case is run from five initial states.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::PI;

use hammerbeam_signal::{
    SignalError,
    exponent::{
        DivergenceSettings, EmbeddingChoice, StraightPart, WolfSettings, embedding, kantz, rosenstein, wolf,
    },
};

use crate::systems::{henon, logistic, lorenz, roessler};

/// A system: series, sampling rate, delay and dimension, exponent.
type System = (fn(f64, usize) -> Vec<f64>, f64, (usize, usize), f64);

const LOGISTIC: System = (logistic, 1.0, (1, 2), 0.693);
const HENON: System = (henon, 1.0, (1, 2), 0.418);
const LORENZ: System = (lorenz, 100.0, (11, 3), 1.50);
const ROESSLER: System = (roessler, 10.0, (8, 3), 0.090);

#[derive(Clone, Copy)]
enum Method {
    Wolf,
    Rosenstein,
    Kantz,
}

/// Relative errors from five initial states, the smallest first.
fn errors(
    (series, rate, (delay, dimension), exponent): System,
    length: usize,
    method: Method,
    fit: StraightPart,
) -> Vec<f64> {
    let choice = EmbeddingChoice { delay: Some(delay), dimension: Some(dimension), theiler_window: None };
    let settings = DivergenceSettings { fit, ..DivergenceSettings::default() };
    let error = |start: u32| {
        let series = series(0.137 * f64::from(start), length);
        let embedding = embedding(&series, &choice).unwrap();
        let found = match method {
            Method::Wolf => wolf(&series, rate, &embedding, &WolfSettings::default()).unwrap().exponent,
            Method::Rosenstein => rosenstein(&series, rate, &embedding, &settings).unwrap().exponent,
            Method::Kantz => kantz(&series, rate, &embedding, &settings).unwrap().exponent,
        };
        found.value / exponent - 1.0
    };
    let mut errors: Vec<f64> = (0..5).map(error).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// The median within one bound, all within another.
#[track_caller]
fn assert_within(errors: &[f64], middle: f64, all: f64) {
    assert!(errors[2].abs() <= middle && errors.iter().all(|error| error.abs() <= all), "{errors:.3?}");
}

#[test]
fn rosenstein_1993_maps() {
    assert_within(&errors(LOGISTIC, 500, Method::Rosenstein, StraightPart::Found), 0.02, 0.05);
    assert_within(&errors(HENON, 500, Method::Rosenstein, StraightPart::Found), 0.08, 0.16);
    assert_within(&errors(HENON, 5000, Method::Rosenstein, StraightPart::Found), 0.03, 0.06);
}

#[test]
fn rosenstein_1993_lorenz() {
    assert_within(&errors(LORENZ, 5000, Method::Rosenstein, StraightPart::Found), 0.05, 0.10);
}

/// Missed when the part is found automatically. Distances to nearest neighbours have a component along the
/// motion, which does not grow. So the curve is flatter than the exponent until the component across the
/// motion dominates; by then the size of the attractor limits it. (Distances across the motion alone give 0.9
/// to 1.0 of the exponent here, but 1.15 of Lorenz'.)
#[test]
fn rosenstein_1993_roessler_comes_out_a_sixth_too_small() {
    let errors = errors(ROESSLER, 20_000, Method::Rosenstein, StraightPart::Found);
    assert!((-0.20..-0.08).contains(&errors[2]), "{errors:.3?}");
}

/// The authors give 0.0879 from a record of 2000 samples, 2 % too small, with the part chosen by eye
/// (`rosenstein_1993.rs`). With ten times as many samples the error is larger, both over the part in which
/// the mean of several curves is steepest and over the period of steepest growth.
#[test]
fn rosenstein_1993_roessler_with_the_straight_part_given() {
    assert_within(&errors(ROESSLER, 20_000, Method::Rosenstein, StraightPart::Given(230, 320)), 0.15, 0.25);
    let period = errors(ROESSLER, 20_000, Method::Rosenstein, StraightPart::SteepestPeriod);
    assert_within(&period, 0.15, 0.25);
    assert!(period.iter().all(|error| *error < 0.0), "{period:.3?}");
}

#[test]
fn wolf_1985_henon() {
    assert_within(&errors(HENON, 5000, Method::Wolf, StraightPart::Found), 0.03, 0.05);
    assert_within(&errors(LOGISTIC, 5000, Method::Wolf, StraightPart::Found), 0.03, 0.05);
}

#[test]
fn wolf_1985_lorenz_and_roessler() {
    assert_within(&errors(LORENZ, 20_000, Method::Wolf, StraightPart::Found), 0.05, 0.15);
    assert_within(&errors(ROESSLER, 20_000, Method::Wolf, StraightPart::Found), 0.05, 0.10);
}

/// The straight part of Lorenz' curve is given, as the authors choose it by eye; the part found
/// automatically gives up to 15 % too much.
#[test]
fn kantz_1994() {
    assert_within(&errors(LOGISTIC, 5000, Method::Kantz, StraightPart::Found), 0.04, 0.06);
    assert_within(&errors(HENON, 5000, Method::Kantz, StraightPart::Found), 0.05, 0.08);
    assert_within(&errors(LORENZ, 5000, Method::Kantz, StraightPart::Given(40, 120)), 0.05, 0.15);
}

/// Rosenstein et al. use 11 and 3 for Lorenz, 1 and 2 for Hénon. One coordinate of the logistic map is its
/// state.
#[test]
fn delay_and_dimension_are_those_of_the_authors() {
    let chosen = |series: Vec<f64>| {
        let found = embedding(&series, &EmbeddingChoice::default()).unwrap();
        (found.delay, found.dimension)
    };
    assert!(matches!(chosen(lorenz(0.0, 5000)), (10 | 11, 3)));
    assert!(matches!(chosen(roessler(0.0, 5000)), (8 | 9, 3)));
    assert_eq!(chosen(henon(0.0, 2000)), (1, 2));
    assert_eq!(chosen(logistic(0.0, 2000)), (1, 1));
}

/// With all choices automatic, whether the rate of sampling is a multiple of the frequency or not.
#[test]
fn motion_that_repeats_exactly_is_refused_without_exponent() {
    let sine = |k: f64| (2.0 * PI * 0.013 * k).sin();
    // An impact once a period of 200 samples: a short pulse on a harmonic.
    let impacts = |k: f64| {
        let phase = 2.0 * PI * k / 200.0;
        phase.cos() + 30.0 * (8.0 * ((phase + 1.0).cos() - 1.0)).exp() + 0.3 * (9.0 * phase).sin()
    };
    let period_three = |k: f64| [0.1, 0.9, 0.4][k as usize % 3] + 1e-13 * k.sin();
    let signals: [(&dyn Fn(f64) -> f64, usize); 3] = [(&sine, 1000), (&impacts, 200), (&period_three, 3)];
    for (signal, period) in signals {
        let series: Vec<f64> = (0..5000).map(|k| signal(f64::from(k))).collect();
        let refused = embedding(&series, &EmbeddingChoice::default());
        assert!(
            matches!(refused, Err(SignalError::Repeats { samples, .. }) if samples == period),
            "{refused:?}"
        );
    }
}

/// Nearly coinciding states: a false neighbour is false, however near the true one is.
#[test]
fn dimension_of_a_motion_that_nearly_repeats_is_not_one() {
    // A drift of 1e-4 of the amplitude in each period of 100 samples.
    let series: Vec<f64> =
        (0..5000).map(|k| (1.0 + 4e-5 * f64::from(k)) * (2.0 * PI * 0.01 * f64::from(k)).sin()).collect();
    let found = embedding(&series, &EmbeddingChoice::default()).unwrap();
    assert!(found.dimension >= 2, "{found:?}");
}

#[test]
fn motion_with_two_frequencies_or_one_that_the_sampling_misses_has_no_positive_exponent() {
    // Incommensurate with each other or the sampling: neighbours stay neighbours.
    let two = |k: f64| (0.1 * k).sin() + 0.5 * (0.0618 * k).cos();
    let one = |k: f64| (0.11 * k).cos() + 0.4 * (0.055 * k).sin();
    let signals: [&dyn Fn(f64) -> f64; 2] = [&two, &one];
    for signal in signals {
        let series: Vec<f64> = (0..5000).map(|k| signal(f64::from(k))).collect();
        let embedding = embedding(&series, &EmbeddingChoice::default()).unwrap();
        for method in [rosenstein, kantz] {
            let refused = method(&series, 1.0, &embedding, &DivergenceSettings::default());
            assert!(matches!(refused, Err(SignalError::NoScaling { .. })), "{refused:?}");
        }
        // Of the mean period's inverse, 1/60.
        let found = wolf(&series, 1.0, &embedding, &WolfSettings::default()).unwrap();
        assert!(found.exponent.value.abs() < 2e-3, "{found:?}");
    }
}

#[test]
fn states_that_have_neighbours_are_counted() {
    // Noise in ten dimensions: some states have neighbours within the largest radius, most have not.
    let mut random = hammerbeam_signal::random::RandomSource::new(3);
    let series: Vec<f64> = (0..400).map(|_| random.normal()).collect();
    let choice = EmbeddingChoice { delay: Some(1), dimension: Some(6), theiler_window: Some(1) };
    let embedding = embedding(&series, &choice).unwrap();
    let refused = kantz(&series, 1.0, &embedding, &DivergenceSettings::default());
    assert!(
        matches!(refused, Err(SignalError::TooFewNeighbours { found, asked }) if found < asked),
        "{refused:?}"
    );
}

#[test]
fn bad_input_is_refused() {
    let short = henon(0.0, 50);
    let default = EmbeddingChoice::default();
    assert!(matches!(embedding(&short, &default), Err(SignalError::TooShort { .. })));
    assert!(matches!(embedding(&[1.0; 500], &default), Err(SignalError::Constant)));
    let series = henon(0.0, 500);
    let wide = EmbeddingChoice { dimension: Some(30), ..default };
    assert!(matches!(embedding(&series, &wide), Err(SignalError::Input { .. })));
    let found = embedding(&series, &default).unwrap();
    let fit = DivergenceSettings { fit: StraightPart::Given(3, 500), ..DivergenceSettings::default() };
    assert!(matches!(rosenstein(&series, 1.0, &found, &fit), Err(SignalError::Input { .. })));
    // A map has no mean period to fit.
    let period = DivergenceSettings { fit: StraightPart::SteepestPeriod, ..DivergenceSettings::default() };
    assert!(matches!(rosenstein(&series, 1.0, &found, &period), Err(SignalError::Input { .. })));
    let never = WolfSettings { evolution: Some(400), ..WolfSettings::default() };
    assert!(matches!(wolf(&series, 1.0, &found, &never), Err(SignalError::TooFewNeighbours { .. })));
}
