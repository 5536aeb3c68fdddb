use super::*;
use crate::filter::{Band, butterworth};

const RATE: f64 = 20_000.0;

/// Two periods of 50 Hz with a third harmonic: displacement.
fn record() -> Record {
    let value = |k: usize| {
        let t = 2.0 * PI * 50.0 * k as f64 / RATE;
        1e-3 * t.cos() + 2e-4 * (3.0 * t + 0.5).sin()
    };
    let samples = (0..800).map(value).collect();
    let channel =
        Channel { name: "x".to_owned(), unit: None, quantity: MeasuredQuantity::Displacement, samples };
    Record { sampling_rate_hz: RATE, start_s: 0.0, channels: vec![channel], findings: Vec::new() }
}

fn acceleration(t: f64) -> f64 {
    let w = 2.0 * PI * 50.0;
    -1e-3 * w * w * (w * t).cos() - 2e-4 * 9.0 * w * w * (3.0 * w * t + 0.5).sin()
}

fn chain() -> MeasuringChain {
    MeasuringChain {
        sensor: MeasuredQuantity::Acceleration,
        filter: None,
        sampling_rate_hz: None,
        noise: 0.0,
        seed: 1,
        converter: None,
    }
}

#[test]
fn acceleration_follows_from_displacement_over_whole_periods() {
    let measured = chain().measure(&record(), RecordCoverage::WholePeriods).unwrap();
    for (k, value) in measured.channels[0].samples.iter().enumerate() {
        // Differences of rounding times (w_max)^2: 1e-19 m * (6e4 1/s)^2 is 4e-10.
        assert!((value - acceleration(k as f64 / RATE)).abs() < 1e-8, "sample {k}");
    }
    let refused = chain().measure(&record(), RecordCoverage::Excerpt).unwrap_err();
    assert!(matches!(refused, SignalError::NoSuchQuantity { .. }), "{refused}");
    let back = differentiated(&differentiated(&record().channels[0].samples, RATE, 2), RATE, -2);
    assert!(back.iter().zip(&record().channels[0].samples).all(|(a, b)| (a - b).abs() < 1e-15));
}

/// In the settled state a harmonic is scaled by the gain of the filter and shifted by its phase.
#[test]
fn causal_filter_acts_on_a_periodic_record_in_its_settled_state() {
    let filter = butterworth(4, Band::LowPass { cut_off_hz: 100.0 }, RATE).unwrap();
    let mut chain = MeasuringChain { sensor: MeasuredQuantity::Displacement, ..chain() };
    chain.filter = Some((filter.clone(), false));
    let measured = chain.measure(&record(), RecordCoverage::WholePeriods).unwrap();
    let before = forward(record().channels[0].samples.clone());
    let after = forward(measured.channels[0].samples.clone());
    for (bin, frequency) in [(2, 50.0), (6, 150.0)] {
        assert!((after[bin].norm() / before[bin].norm() / filter.gain(frequency, RATE) - 1.0).abs() < 1e-10);
    }
}

#[test]
fn resampling_gives_the_signal_at_the_new_times() {
    let chain = MeasuringChain { sampling_rate_hz: Some(3_000.0), ..chain() };
    let measured = chain.measure(&record(), RecordCoverage::WholePeriods).unwrap();
    assert_eq!((measured.len(), measured.sampling_rate_hz), (120, 3_000.0));
    for (k, value) in measured.channels[0].samples.iter().enumerate() {
        // The interpolation's own error is 2e-5 of the amplitude, about 280 m/s².
        assert!((value - acceleration(k as f64 / 3_000.0)).abs() < 6e-3, "sample {k}");
    }
}

/// The alias of 150 Hz sampled at 200 Hz is 50 Hz.
#[test]
fn aliasing_is_reported() {
    let slow = |rate| MeasuringChain { sampling_rate_hz: Some(rate), ..chain() };
    let aliased = slow(200.0).measure(&record(), RecordCoverage::WholePeriods).unwrap().findings;
    // Accelerations of 50 and 150 Hz are as 1 to 0.2 * 9: 87 % of the root mean square.
    let [RecordFinding::Folded { half_rate_hz: 100.0, percent }] = aliased[..] else { panic!("{aliased:?}") };
    assert!((percent - 87.4).abs() < 0.1, "{aliased:?}");
    assert_eq!(slow(400.0).measure(&record(), RecordCoverage::WholePeriods).unwrap().findings, []);
}

#[test]
fn noise_has_its_size_and_follows_from_the_seed() {
    let noisy = |seed| {
        MeasuringChain { noise: 2.0, seed, ..chain() }
            .measure(&record(), RecordCoverage::WholePeriods)
            .unwrap()
    };
    let clean = chain().measure(&record(), RecordCoverage::WholePeriods).unwrap();
    assert_eq!(noisy(7), noisy(7));
    assert_ne!(noisy(7), noisy(8));
    let difference = noisy(7).channels[0]
        .samples
        .iter()
        .zip(&clean.channels[0].samples)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>();
    // 800 samples: the standard error of the variance is 5 %.
    assert!((difference / 800.0 / 4.0 - 1.0).abs() < 0.2);
}

#[test]
fn converter_rounds_to_its_steps_and_clips() {
    let converter = Converter { range: 100.0, bits: 8 };
    let measured = MeasuringChain { converter: Some(converter), ..chain() }
        .measure(&record(), RecordCoverage::WholePeriods)
        .unwrap();
    let step = 200.0 / 256.0;
    for (k, value) in measured.channels[0].samples.iter().enumerate() {
        let expected = acceleration(k as f64 / RATE).clamp(-100.0, 100.0 - step);
        assert!(
            (value - expected).abs() <= step / 2.0 + 1e-9 && (value / step).fract().abs() < 1e-9,
            "sample {k}"
        );
    }
    // Each end separately, with the value at which it is clipped.
    let beyond =
        |holds: &dyn Fn(f64) -> bool| (0..800).filter(|k| holds(acceleration(f64::from(*k) / RATE))).count();
    let expected = [
        (100.0 - step, beyond(&|value| value > 100.0 - 0.5 * step)),
        (-100.0, beyond(&|value| value < -100.0 - 0.5 * step)),
    ];
    let found: Vec<(f64, usize)> = measured
        .findings
        .iter()
        .filter_map(|finding| match finding {
            RecordFinding::Clipped { level, samples, .. } => Some((*level, *samples)),
            _ => None,
        })
        .collect();
    assert_eq!(found, expected);
    let wide = MeasuringChain { converter: Some(Converter { range: 1e3, bits: 8 }), ..chain() };
    assert_eq!(wide.measure(&record(), RecordCoverage::WholePeriods).unwrap().findings, []);
    let wrong = Converter { range: 0.0, bits: 8 };
    assert!(
        MeasuringChain { converter: Some(wrong), ..chain() }
            .measure(&record(), RecordCoverage::WholePeriods)
            .is_err()
    );
}
