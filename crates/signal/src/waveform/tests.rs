//! Waveforms in closed form.

use std::f64::consts::TAU;

use super::*;
use crate::error::SignalError;

/// Harmonics up to the sixth, at a phase in cycles.
fn wave(phase: f64) -> f64 {
    (1..=6).map(|k| (TAU * f64::from(k) * phase + f64::from(k * k)).cos() / f64::from(k)).sum::<f64>() + 0.7
}

fn sampled(count: usize, from: f64) -> Vec<f64> {
    (0..count).map(|k| wave(k as f64 / count as f64 + from)).collect()
}

#[test]
fn shift_factor_and_residual_are_recovered() {
    let b = sampled(64, 0.0);
    // Delayed by 13.37 samples, half as large, on another level.
    let a: Vec<f64> = sampled(64, -13.37 / 64.0).iter().map(|value| 0.5 * value + 3.0).collect();
    let found = align(&a, &b, Shifts::Any).unwrap();
    assert!((found.shift - 13.37).abs() < 1e-9, "{found:?}");
    assert!((found.correlation - 1.0).abs() < 1e-12 && (found.factor - 2.0).abs() < 1e-12, "{found:?}");
    // Without the factor the residual is 1 - 1/2 of the size.
    assert!((found.residual(1.0) - 0.5).abs() < 1e-12 && found.residual(2.0) < 1e-6, "{found:?}");
    let moved = delayed(&b, found.shift).unwrap();
    assert!(moved.iter().zip(&a).all(|(b, a)| (0.5 * b + 3.0 - a).abs() < 1e-3), "{moved:?}");
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let level = mean(&a) - 0.5 * mean(&moved);
    assert!(moved.iter().zip(&a).all(|(b, a)| (0.5 * b + level - a).abs() < 1e-9));
}

#[test]
fn mirror_image_has_a_negative_factor_only_where_no_shift_is_better() {
    let b: Vec<f64> = (0..32).map(|k| if k == 5 { 1.0 } else { 0.0 }).collect();
    let a: Vec<f64> = b.iter().map(|value| -value).collect();
    let still = Shifts::NearWhole { period: 32, most: 0.0 };
    let found = align(&a, &b, still).unwrap();
    assert!((found.factor + 1.0).abs() < 1e-12 && found.shift == 0.0, "{found:?}");
}

#[test]
fn shifts_are_kept_near_whole_periods() {
    let b = sampled(64, 0.0);
    let a = sampled(64, -20.0 / 64.0);
    let near = Shifts::NearWhole { period: 32, most: 3.0 };
    let found = align(&a, &b, near).unwrap();
    assert!((29.0..=35.0).contains(&found.shift) || found.shift <= 3.0 || found.shift >= 61.0, "{found:?}");
    let wide = Shifts::NearWhole { period: 32, most: 12.5 };
    assert!((align(&a, &b, wide).unwrap().shift - 20.0).abs() < 1e-9);
}

#[test]
fn record_is_folded_from_the_given_time() {
    // 2 Hz, whose waveform repeats after two periods, from 1.3 s on at 1 kHz; pieces start at whole
    // ones of the clock.
    let value = |t: f64| (TAU * 2.0 * t).cos() + 0.5 * (TAU * t + 0.3).sin();
    let samples: Vec<f64> = (0..9_000).map(|k| value(1.3 + f64::from(k) * 1e-3)).collect();
    let found = folded(&samples, (1000.0, -1.3), 2.0, (2, 512)).unwrap();
    // From 2 to 10 s.
    assert_eq!((found.pieces, found.samples.len()), (8, 1024));
    for (k, sample) in found.samples.iter().enumerate() {
        // The interpolation's own error is 2e-5.
        assert!((sample - value(k as f64 / 1024.0)).abs() < 1e-4, "{k}: {sample}");
    }
    assert!(found.scatter < 1e-4);
}

/// 4000 samples a period, read at 64 phases: the fortieth harmonic is above their limit, and its alias
/// would be the 24th.
#[test]
fn harmonics_above_the_samples_of_a_waveform_are_left_out() {
    let slow = |t: f64| (TAU * t).cos() + 0.3 * (TAU * 31.0 * t).sin();
    let samples: Vec<f64> = (0..20_001)
        .map(|k| f64::from(k) / 4000.0)
        .map(|t| slow(t) + 0.7 * (TAU * 40.0 * t + 0.2).cos())
        .collect();
    let found = folded(&samples, (4000.0, 0.0), 1.0, (1, 64)).unwrap();
    assert_eq!(found.lines, 31);
    for (k, sample) in found.samples.iter().enumerate() {
        // The interpolation's own error is 2e-5.
        assert!((sample - slow(k as f64 / 64.0)).abs() < 5e-5, "{k}: {sample}");
    }
}

/// Ten samples per period represent four lines to the interpolation's accuracy; a computed waveform with more
/// is cut to them.
#[test]
fn harmonics_above_the_record_are_left_out_of_both() {
    let lines = |most: u32, t: f64| {
        (1..=most).map(|k| (TAU * f64::from(k) * t + f64::from(k * k)).cos()).sum::<f64>()
    };
    let samples: Vec<f64> = (0..1000).map(|k| lines(4, f64::from(k) / 10.0)).collect();
    let found = folded(&samples, (10.0, 0.0), 1.0, (1, 64)).unwrap();
    assert_eq!(found.lines, 4);
    let computed: Vec<f64> = (0..512).map(|k| lines(200, f64::from(k) / 512.0)).collect();
    let cut = band_limited(&computed, 64, found.lines).unwrap();
    for (k, (sample, cut)) in found.samples.iter().zip(&cut).enumerate() {
        let expected = lines(4, k as f64 / 64.0);
        assert!((cut - expected).abs() < 1e-10 && (sample - expected).abs() < 2e-4, "{k}: {sample} {cut}");
    }
    assert!(matches!(band_limited(&computed, 64, 32), Err(SignalError::Input { .. })));
}

/// A pulse of all lines with its maximum half a sample from the nearest one: there the first Newton step
/// overshoots to a lower value.
#[test]
fn maximum_far_from_the_samples_is_found() {
    let mut pulse = vec![0.0; 64];
    pulse[0] = 1.0;
    let pulse = band_limited(&pulse, 64, 31).unwrap();
    for shift in [5.49, 5.495, 5.51, 5.3] {
        let found = align(&delayed(&pulse, shift).unwrap(), &pulse, Shifts::Any).unwrap();
        assert!((found.shift - shift).abs() < 1e-9, "{shift}: {found:?}");
        assert!((found.correlation - 1.0).abs() < 1e-12, "{shift}: {found:?}");
    }
}

/// The best shift is outside the allowed interval: the result is its end, between samples.
#[test]
fn shift_stops_at_the_end_of_the_allowed_interval() {
    let b = sampled(64, 0.0);
    let a = delayed(&b, 34.9).unwrap();
    let found = align(&a, &b, Shifts::NearWhole { period: 32, most: 2.6 }).unwrap();
    assert!((found.shift - 34.6).abs() < 1e-9, "{found:?}");
}

#[test]
fn scatter_is_the_noise() {
    let mut random = crate::random::RandomSource::new(5);
    let samples: Vec<f64> = (0..40_000).map(|k| wave(f64::from(k) / 100.0) + 0.2 * random.normal()).collect();
    let found = folded(&samples, (100.0, 0.0), 1.0, (1, 100)).unwrap();
    // 400 pieces of 100 samples: 0.4 % standard error.
    assert!((found.scatter / 0.2 - 1.0).abs() < 0.02, "{}", found.scatter);
}

#[test]
fn waveforms_that_cannot_be_aligned_are_refused() {
    let refused = |first: &[f64], second: &[f64]| align(first, second, Shifts::Any).unwrap_err();
    assert!(matches!(refused(&[1.0; 8], &sampled(8, 0.0)), SignalError::Constant));
    assert!(matches!(refused(&sampled(8, 0.0), &sampled(9, 0.0)), SignalError::Input { .. }));
    let never = align(&sampled(8, 0.0), &sampled(8, 0.0), Shifts::NearWhole { period: 8, most: -1.0 });
    assert!(matches!(never, Err(SignalError::Input { .. })), "{never:?}");
    let short = folded(&sampled(64, 0.0), (64.0, 0.0), 1.0, (1, 8)).unwrap_err();
    assert!(matches!(short, SignalError::TooShort { .. }), "{short}");
}
