use super::*;
use crate::{finding::Repairs, text::time_difference};

fn sine(length: usize) -> Vec<f64> {
    (0..length).map(|k| (0.37 * k as f64).sin()).collect()
}

fn raw(times: Vec<f64>, samples: Vec<f64>) -> RawRecord {
    let channel = RawChannel { name: "a".to_owned(), unit: Some("g".to_owned()), samples };
    RawRecord::single(TimeAxis::Times(times), vec![channel], Vec::new())
}

fn even_times(length: usize) -> Vec<f64> {
    (0..length).map(|k| 0.5 + k as f64 / 1000.0).collect()
}

fn allowing(repairs: Repairs) -> RecordOptions {
    RecordOptions { repairs, ..RecordOptions::default() }
}

#[test]
fn even_record_is_taken_in_si_without_findings() {
    let record = raw(even_times(100), sine(100)).validate(&RecordOptions::default()).unwrap();
    assert!((record.sampling_rate_hz - 1000.0).abs() < 1e-9, "{}", record.sampling_rate_hz);
    assert_eq!(record.start_s, 0.5);
    assert_eq!(record.channels[0].quantity, MeasuredQuantity::Acceleration);
    assert_eq!(record.channels[0].samples[1], 9.80665 * 0.37_f64.sin());
    assert_eq!(record.findings, []);
}

#[test]
fn rounded_times_are_even_and_coarser_ones_are_reported() {
    let rounded = |digits: f64| even_times(100).iter().map(|t| (t * digits).round() / digits).collect();
    // 1024 Hz would stray by half a unit of the last digit: 0.5e-6 s is 0.05 % of a step, 0.5e-4 s is 5 %.
    let times = |digits: f64| -> Vec<f64> {
        (0..100).map(|k| (f64::from(k) / 1024.0 * digits).round() / digits).collect()
    };
    let findings = |times| raw(times, sine(100)).validate(&RecordOptions::default()).unwrap().findings;
    assert_eq!(findings(rounded(1e3)), []);
    assert_eq!(findings(times(1e6)), []);
    let found = findings(times(1e4));
    let [RecordFinding::Jitter { percent }] = found[..] else { panic!("{found:?}") };
    assert!((1.0..10.0).contains(&percent));
}

#[test]
fn uneven_sampling_is_refused_or_evened() {
    let times: Vec<f64> =
        even_times(400).iter().enumerate().map(|(k, t)| t + 3e-4 * (k as f64).sin()).collect();
    let signal = |t: f64| (2.0 * std::f64::consts::PI * 12.0 * t).sin();
    let samples: Vec<f64> = times.iter().map(|t| signal(*t)).collect();
    let refused = raw(times.clone(), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::Uneven { .. }), "{refused}");
    let options = allowing(Repairs { uneven: true, ..Repairs::default() });
    let record = raw(times, samples).validate(&options).unwrap();
    assert!(matches!(record.findings[..], [RecordFinding::Evened { .. }]));
    for (k, value) in record.channels[0].samples.iter().enumerate() {
        let time = record.start_s + k as f64 / record.sampling_rate_hz;
        // Cubic interpolation over four samples: (2 pi 12 / 1000)^4 * 3/128 is 8e-7; steps here differ by
        // half.
        assert!((value / 9.80665 - signal(time)).abs() < 1e-5, "sample {k}");
    }
}

#[test]
fn time_that_runs_back_is_refused_or_sorted() {
    let (mut times, mut samples) = (even_times(50), sine(50));
    times.swap(20, 21);
    samples.swap(20, 21);
    let refused = raw(times.clone(), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::TimeDecreases { count: 1, first: 21, .. }), "{refused}");
    let options = allowing(Repairs { order: true, ..Repairs::default() });
    let record = raw(times, samples).validate(&options).unwrap();
    let plain = raw(even_times(50), sine(50)).validate(&RecordOptions::default()).unwrap();
    assert_eq!(record.channels, plain.channels);
    assert_eq!(record.findings, [RecordFinding::Sorted { count: 1 }]);
}

#[test]
fn repeated_times_are_refused_or_dropped() {
    let (mut times, mut samples) = (even_times(50), sine(50));
    times.insert(10, times[10]);
    samples.insert(11, 99.0);
    let refused = raw(times.clone(), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::DuplicateTimes { count: 1, first: 11, .. }), "{refused}");
    let options = allowing(Repairs { duplicates: true, ..Repairs::default() });
    let record = raw(times, samples).validate(&options).unwrap();
    assert_eq!(record.len(), 50);
    assert_eq!(record.findings, [RecordFinding::DuplicatesDropped { count: 1 }]);
}

#[test]
fn gaps_are_refused_or_filled() {
    let (mut times, mut samples): (Vec<f64>, Vec<f64>) =
        (even_times(50), (0..50).map(|k| 3.0 * f64::from(k)).collect());
    times.drain(20..24);
    samples.drain(20..24);
    let refused = raw(times.clone(), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::Gaps { count: 1, .. }), "{refused}");
    let step_s = times[1] - times[0];
    let expected =
        format!("the longest {} s at a step of {} s", time_difference(5.0 * step_s), time_difference(step_s));
    assert!(refused.to_string().contains(&expected), "{refused}");
    let options = allowing(Repairs { gaps: true, ..Repairs::default() });
    let record = raw(times, samples).validate(&options).unwrap();
    assert_eq!(record.len(), 50);
    assert!((record.channels[0].samples[22] / 9.80665 - 66.0).abs() < 1e-9);
    assert!(matches!(record.findings[..], [RecordFinding::GapsFilled { count: 1, .. }]));
}

/// Random times, off by a fifth of a step: steps of more than 1.5 among them are no gaps.
#[test]
fn jitter_is_uneven_sampling_and_not_gaps() {
    let mut random = crate::random::RandomSource::new(5);
    let mut times: Vec<f64> = (0..500).map(|k| (f64::from(k) + 0.2 * random.normal()) / 1000.0).collect();
    times.sort_by(f64::total_cmp);
    let long = times.windows(2).filter(|pair| pair[1] - pair[0] > 1.5e-3).count();
    assert!((5..50).contains(&long), "{long}");
    let samples: Vec<f64> = times.iter().map(|t| (60.0 * t).sin()).collect();
    let refused = raw(times.clone(), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::Uneven { .. }), "{refused}");
    let options = allowing(Repairs { uneven: true, ..Repairs::default() });
    let record = raw(times, samples).validate(&options).unwrap();
    assert_eq!(record.len(), 500);
    assert!(matches!(record.findings[..], [RecordFinding::Evened { .. }]), "{:?}", record.findings);
}

#[test]
fn a_hole_in_a_record_with_jitter_is_a_gap() {
    let mut random = crate::random::RandomSource::new(5);
    let kept = (0..700).filter(|k| !(300..500).contains(k));
    let mut times: Vec<f64> = kept.map(|k| (f64::from(k) + 0.2 * random.normal()) / 1000.0).collect();
    times.sort_by(f64::total_cmp);
    let samples: Vec<f64> = times.iter().map(|t| (60.0 * t).sin()).collect();
    let options = allowing(Repairs { uneven: true, ..Repairs::default() });
    let refused = raw(times, samples).validate(&options).unwrap_err();
    assert!(matches!(refused, RecordError::Gaps { longest_s, .. } if longest_s > 0.19), "{refused}");
}

#[test]
fn missing_samples_are_refused_or_interpolated() {
    let mut samples: Vec<f64> = (0..50).map(f64::from).collect();
    samples[0] = f64::NAN;
    samples[7] = f64::NAN;
    samples[8] = f64::INFINITY;
    let refused = raw(even_times(50), samples.clone()).validate(&RecordOptions::default()).unwrap_err();
    assert_eq!(refused, RecordError::Missing { channel: "a".to_owned(), count: 3, of: 50, first: 0 });
    let options = allowing(Repairs { missing: true, ..Repairs::default() });
    let record = raw(even_times(50), samples).validate(&options).unwrap();
    let value = |k: usize| record.channels[0].samples[k] / 9.80665;
    assert!(
        (value(0) - 1.0).abs() < 1e-12 && (value(7) - 7.0).abs() < 1e-12 && (value(8) - 8.0).abs() < 1e-12
    );
    assert!(matches!(record.findings[..], [RecordFinding::MissingInterpolated { count: 3, .. }, ..]));
}

#[test]
fn missing_times_are_refused_unless_the_rate_is_given() {
    let mut times = even_times(50);
    times[4] = f64::NAN;
    let refused = raw(times.clone(), sine(50)).validate(&RecordOptions::default()).unwrap_err();
    assert_eq!(refused, RecordError::TimeMissing { count: 1, first: 4 });
    let options = RecordOptions { sampling_rate_hz: Some(1000.0), ..RecordOptions::default() };
    assert_eq!(raw(times, sine(50)).validate(&options).unwrap().findings, []);
}

#[test]
fn rate_that_disagrees_with_the_times_is_reported() {
    let options = RecordOptions { sampling_rate_hz: Some(2000.0), ..RecordOptions::default() };
    let record = raw(even_times(50), sine(50)).validate(&options).unwrap();
    assert!(matches!(record.findings[..], [RecordFinding::RateDisagrees { given_hz: 2000.0, .. }]));
}

#[test]
fn clipped_channel_is_reported_and_a_quantised_sine_is_not() {
    let clipped: Vec<f64> = sine(200).iter().map(|value| value.clamp(-0.8, 2.0)).collect();
    let findings = raw(even_times(200), clipped).validate(&RecordOptions::default()).unwrap().findings;
    assert!(
        matches!(&findings[..], [RecordFinding::Clipped { level, .. }] if *level == -0.8),
        "{findings:?}"
    );
    // A slow sine in steps of 1/50 stays on its largest value for many samples.
    let quantised: Vec<f64> =
        (0..2000).map(|k| (50.0 * (0.01 * f64::from(k)).sin()).round() / 50.0).collect();
    assert_eq!(raw(even_times(2000), quantised).validate(&RecordOptions::default()).unwrap().findings, []);
}

/// 20 Hz at 1 kHz: no two successive samples differ by little, whole periods repeat.
#[test]
fn clean_sine_is_clipped_wherever_the_range_ends() {
    for level in [1.0, 2.0, 2.9] {
        let clipped: Vec<f64> = (0..2000)
            .map(|k| (3.0 * (0.04 * std::f64::consts::PI * f64::from(k)).sin()).clamp(-level, level))
            .collect();
        let findings = raw(even_times(2000), clipped).validate(&RecordOptions::default()).unwrap().findings;
        let levels: Vec<f64> = findings
            .iter()
            .filter_map(|finding| match finding {
                RecordFinding::Clipped { level, places: 40, .. } => Some(*level),
                _ => None,
            })
            .collect();
        assert_eq!(levels, [level, -level], "{findings:?}");
    }
    // Not clipped, whole periods, with a sample on each maximum.
    let whole: Vec<f64> = (0..2000).map(|k| (0.04 * std::f64::consts::PI * f64::from(k)).cos()).collect();
    assert_eq!(raw(even_times(2000), whole).validate(&RecordOptions::default()).unwrap().findings, []);
}

/// Written with significant digits, or in single precision, a record is much finer near zero than at its
/// tops, which are flat for many samples.
#[test]
fn smooth_tops_of_numbers_with_few_digits_are_not_clipped() {
    let sine =
        |k: u32, hertz: f64, rate: f64| 3.0 * (std::f64::consts::TAU * hertz * f64::from(k) / rate).sin();
    for (digits, rate) in [(3, 5e3), (4, 2e4), (5, 51.2e3)] {
        let text = |value: f64| format!("{value:.digits$e}").parse::<f64>().unwrap();
        let written: Vec<f64> = (0..50_000).map(|k| text(sine(k, 10.3, rate))).collect();
        let times = (0..50_000).map(|k| f64::from(k) / rate).collect();
        assert_eq!(
            raw(times, written).validate(&RecordOptions::default()).unwrap().findings,
            [],
            "{digits} digits"
        );
    }
    let single: Vec<f64> = (0..100_000).map(|k| f64::from(sine(k, 1.3, 51.2e3) as f32)).collect();
    let times = (0..100_000).map(|k| f64::from(k) / 51.2e3).collect();
    assert_eq!(raw(times, single).validate(&RecordOptions::default()).unwrap().findings, []);
}

#[test]
fn contact_force_is_not_clipped_at_zero() {
    let force: Vec<f64> = sine(200).iter().map(|value| value.max(0.0)).collect();
    assert_eq!(raw(even_times(200), force).validate(&RecordOptions::default()).unwrap().findings, []);
}

#[test]
fn constant_channel_is_reported() {
    let findings = raw(even_times(20), vec![1.5; 20]).validate(&RecordOptions::default()).unwrap().findings;
    assert_eq!(findings, [RecordFinding::Constant { channel: "a".to_owned() }]);
}

#[test]
fn unequal_lengths_are_refused_or_cut() {
    let mut record = raw(even_times(50), sine(50));
    record.groups[0].channels.push(RawChannel { name: "b".to_owned(), unit: None, samples: sine(40) });
    let refused = record.clone().validate(&RecordOptions::default()).unwrap_err();
    assert_eq!(refused, RecordError::UnequalLengths { lengths: "time 50, a 50, b 40".to_owned() });
    let options = allowing(Repairs { lengths: true, ..Repairs::default() });
    let cut = record.clone().validate(&options).unwrap();
    assert_eq!(
        (cut.len(), &cut.findings[..]),
        (40, &[RecordFinding::Shortened { length: 40, longest: 50 }][..])
    );
    // A channel that is not asked for is not validated.
    let one = RecordOptions { channels: vec!["a".to_owned()], ..RecordOptions::default() };
    assert_eq!(record.validate(&one).unwrap().len(), 50);
}

#[test]
fn channels_of_different_rates_are_refused_unless_one_is_chosen() {
    let mut record = raw(even_times(50), sine(50));
    let slow = RawChannel { name: "slow".to_owned(), unit: None, samples: sine(25) };
    record.add(TimeAxis::Even { step_s: 0.002, start_s: 0.0 }, slow);
    let refused = record.clone().validate(&RecordOptions::default()).unwrap_err();
    assert!(matches!(refused, RecordError::DifferentSampling { .. }), "{refused}");
    let one = RecordOptions { channels: vec!["slow".to_owned()], ..RecordOptions::default() };
    assert_eq!(record.validate(&one).unwrap().sampling_rate_hz, 500.0);
}

#[test]
fn unknown_channel_is_refused_and_numbers_count_from_one() {
    let refused = raw(even_times(50), sine(50))
        .validate(&RecordOptions { channels: vec!["b".to_owned()], ..RecordOptions::default() });
    assert_eq!(refused, Err(RecordError::NoSuchChannel { name: "b".to_owned(), names: "a".to_owned() }));
    let first = RecordOptions { channels: vec!["1".to_owned()], ..RecordOptions::default() };
    assert_eq!(raw(even_times(50), sine(50)).validate(&first).unwrap().channels[0].name, "a");
}

#[test]
fn record_without_rate_or_samples_is_refused() {
    let channel = RawChannel { name: "a".to_owned(), unit: None, samples: sine(5) };
    let record = RawRecord::single(TimeAxis::Unknown, vec![channel], Vec::new());
    assert_eq!(record.clone().validate(&RecordOptions::default()).unwrap_err(), RecordError::NoSamplingRate);
    assert_eq!(RawRecord::default().validate(&RecordOptions::default()).unwrap_err(), RecordError::Empty);
    let zero = RawRecord {
        groups: vec![RawGroup {
            axis: TimeAxis::Even { step_s: 0.0, start_s: 0.0 },
            ..record.groups[0].clone()
        }],
        ..record
    };
    assert_eq!(zero.validate(&RecordOptions::default()).unwrap_err(), RecordError::Step { step_s: 0.0 });
}
