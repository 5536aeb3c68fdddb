//! Periodic, aperiodic, doubtful: motions whose kind is known.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::PI;

use hammerbeam_signal::{
    SignalError,
    classify::{
        Classification, ClassificationDoubt, ClassifySettings, MotionClass, classify, excitation_frequency,
    },
    random::RandomSource,
};

const RATE: f64 = 2000.0;
const EXCITATION: f64 = 31.37;

/// A motion of parts (order over the excitation frequency, amplitude, phase), with noise.
fn motion(parts: &[(f64, f64, f64)], noise: f64, seconds: f64) -> Vec<f64> {
    let mut random = RandomSource::new(11);
    (0..(seconds * RATE) as usize)
        .map(|k| {
            let t = 2.0 * PI * EXCITATION * k as f64 / RATE;
            parts.iter().map(|(order, a, p)| a * (order * t + p).cos()).sum::<f64>() + noise * random.normal()
        })
        .collect()
}

fn of(series: &[f64]) -> Classification {
    classify(series, RATE, EXCITATION, &ClassifySettings::default()).unwrap()
}

#[track_caller]
fn assert_periodic(series: &[f64], period_multiple: usize) {
    let found = of(series);
    assert_eq!(found.motion, MotionClass::Periodic { period_multiple }, "{:?}", found.repetitions);
}

#[test]
fn period_is_found_with_and_without_noise() {
    for noise in [0.0, 0.02, 0.2] {
        assert_periodic(&motion(&[(1.0, 1.0, 0.3), (2.0, 0.5, 1.0), (5.0, 0.2, 2.0)], noise, 20.0), 1);
        assert_periodic(&motion(&[(1.0, 1.0, 0.3), (0.5, 0.5, 1.0), (1.5, 0.2, 2.0)], noise, 20.0), 2);
        assert_periodic(&motion(&[(1.0, 1.0, 0.3), (1.0 / 3.0, 0.7, 1.0)], noise, 20.0), 3);
        assert_periodic(&motion(&[(1.0, 0.1, 0.3), (0.2, 0.7, 1.0), (0.6, 0.3, 0.0)], noise, 20.0), 5);
        // Half and third orders at once repeat after six periods.
        assert_periodic(&motion(&[(1.0, 1.0, 0.3), (0.5, 0.5, 1.0), (1.0 / 3.0, 0.5, 1.0)], noise, 20.0), 6);
    }
}

#[test]
fn weak_subharmonic_counts_from_its_limit_on() {
    assert_periodic(&motion(&[(1.0, 1.0, 0.3), (0.5, 0.03, 1.0)], 0.01, 20.0), 2);
    assert_periodic(&motion(&[(1.0, 1.0, 0.3), (0.5, 0.002, 1.0)], 0.01, 20.0), 1);
    let between = of(&motion(&[(1.0, 1.0, 0.3), (0.5, 0.01, 1.0)], 0.01, 20.0)).motion;
    assert!(
        matches!(
            between,
            MotionClass::Doubtful { reason: ClassificationDoubt::WeakSubharmonic { period_multiple: 2, .. } }
        ),
        "{between:?}"
    );
}

#[test]
fn quasi_periodic_motion_is_aperiodic() {
    let series = motion(&[(1.0, 1.0, 0.3), ((5.0_f64.sqrt() - 1.0) / 2.0, 0.5, 1.0)], 0.01, 20.0);
    assert_eq!(of(&series).motion, MotionClass::Aperiodic);
}

/// Duffing's equation of Ueda, `x'' + 0.05 x' + x³ = 7.5 cos t`, is chaotic (Ueda, J. Stat. Phys. 20 (1979),
/// 181-196).
#[test]
fn chaotic_motion_is_aperiodic() {
    let acceleration = |t: f64, x: f64, v: f64| 7.5 * t.cos() - 0.05 * v - x.powi(3);
    let (mut x, mut v) = (1.0, 0.0);
    let h = 2.0 * PI / 200.0;
    let mut series = Vec::new();
    for k in 0..200 * 400 {
        let t = f64::from(k) * h;
        let (k1x, k1v) = (v, acceleration(t, x, v));
        let (k2x, k2v) = (v + h / 2.0 * k1v, acceleration(t + h / 2.0, x + h / 2.0 * k1x, v + h / 2.0 * k1v));
        let (k3x, k3v) = (v + h / 2.0 * k2v, acceleration(t + h / 2.0, x + h / 2.0 * k2x, v + h / 2.0 * k2v));
        let (k4x, k4v) = (v + h * k3v, acceleration(t + h, x + h * k3x, v + h * k3v));
        x += h / 6.0 * (k1x + 2.0 * k2x + 2.0 * k3x + k4x);
        v += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
        if k >= 200 * 100 {
            series.push(x);
        }
    }
    let found = classify(&series, 200.0, 1.0, &ClassifySettings::default()).unwrap();
    assert_eq!(found.motion, MotionClass::Aperiodic, "{:?}", found.repetitions);
}

#[test]
fn doubtful_motions_are_doubtful_with_their_reason() {
    let between = of(&motion(&[(1.0, 1.0, 0.3), (0.618_034, 0.1, 1.0)], 0.0, 20.0)).motion;
    assert!(
        matches!(between, MotionClass::Doubtful { reason: ClassificationDoubt::BetweenLimits { .. } }),
        "{between:?}"
    );
    let noisy = of(&motion(&[(1.0, 1.0, 0.3)], 1.0, 20.0)).motion;
    assert!(
        matches!(noisy, MotionClass::Doubtful { reason: ClassificationDoubt::Noise { .. } }),
        "{noisy:?}"
    );
    let mut falling = motion(&[(1.0, 1.0, 0.3)], 0.01, 20.0);
    falling.iter_mut().enumerate().for_each(|(k, value)| *value *= (-2e-5 * k as f64).exp());
    let unsettled = of(&falling).motion;
    assert!(
        matches!(unsettled, MotionClass::Doubtful { reason: ClassificationDoubt::NotSettled { .. } }),
        "{unsettled:?}"
    );
}

#[test]
fn frequency_that_is_a_little_off_is_corrected_and_reported() {
    let series = motion(&[(1.0, 1.0, 0.3), (0.5, 0.5, 1.0)], 0.01, 20.0);
    let found = classify(&series, RATE, EXCITATION + 0.01, &ClassifySettings::default()).unwrap();
    assert_eq!(found.motion, MotionClass::Periodic { period_multiple: 2 });
    // Noise of 0.01 over 40 000 samples leaves 1e-6 cycles per part.
    assert!(
        (found.correction_hz + 0.01).abs() < 1e-4 && (found.frequency_hz - EXCITATION).abs() < 1e-4,
        "{found:?}"
    );
}

#[test]
fn excitation_frequency_is_found_in_a_reference() {
    let found = excitation_frequency(&motion(&[(1.0, 3.0, 0.3), (2.0, 0.3, 0.0)], 0.1, 10.0), RATE).unwrap();
    assert!((found - EXCITATION).abs() < 1e-4, "{found}");
    let noise = motion(&[(1.0, 0.3, 0.3)], 1.0, 10.0);
    assert!(matches!(excitation_frequency(&noise, RATE), Err(SignalError::NoReferenceLine { .. })));
}

#[test]
fn bad_input_is_refused() {
    let series = motion(&[(1.0, 1.0, 0.3)], 0.0, 1.0);
    let settings = ClassifySettings::default();
    assert!(matches!(classify(&series, RATE, 300.0, &settings), Err(SignalError::Input { .. })));
    assert!(matches!(classify(&series, RATE, 2.0, &settings), Err(SignalError::TooShort { .. })));
    assert!(matches!(classify(&[1.0; 2000], RATE, 30.0, &settings), Err(SignalError::Constant)));
}
