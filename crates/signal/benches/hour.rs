//! An hour of a signal at 10 kHz, 36 million samples: filters, spectra, classification.
//!
//! With `-- --test` each case runs once, on ten seconds.
#![allow(missing_docs, reason = "the macros of the benchmark library generate functions")]
#![allow(clippy::unwrap_used, reason = "a benchmark ends where its input is wrong")]

use std::{f64::consts::PI, hint::black_box, time::Duration};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hammerbeam_signal::{
    classify::{ClassifySettings, classify},
    filter::{Band, butterworth},
    random::RandomSource,
    spectrum::{WelchSettings, Window, amplitude_spectrum, welch},
};

const RATE: f64 = 10_000.0;
/// A period is not a whole number of samples.
const EXCITATION: f64 = 34.7;

fn seconds() -> usize {
    if std::env::args().any(|argument| argument == "--test") { 10 } else { 3600 }
}

/// A motion of period two with higher harmonics and noise.
fn series() -> Vec<f64> {
    let mut random = RandomSource::new(1);
    (0..seconds() * RATE as usize)
        .map(|k| {
            let t = 2.0 * PI * EXCITATION * k as f64 / RATE;
            t.cos() + 0.4 * (0.5 * t).sin() + 0.2 * (7.0 * t).cos() + 0.05 * random.normal()
        })
        .collect()
}

fn hour(criterion: &mut Criterion) {
    let series = series();
    let mut group = criterion.benchmark_group("hour");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .throughput(Throughput::Elements(series.len() as u64));
    let filter = butterworth(4, Band::LowPass { cut_off_hz: 850.0 }, RATE).unwrap();
    group.bench_function("filter, causal", |bencher| bencher.iter(|| filter.causal(black_box(&series))));
    group.bench_function("filter, zero phase", |bencher| {
        bencher.iter(|| filter.zero_phase(black_box(&series)).unwrap());
    });
    group.bench_function("spectrum, whole", |bencher| {
        bencher.iter(|| amplitude_spectrum(black_box(&series), RATE, Window::Hann).unwrap());
    });
    let settings = WelchSettings::with_segment(1 << 14);
    group.bench_function("spectrum, segments", |bencher| {
        bencher.iter(|| welch(black_box(&series), RATE, &settings).unwrap());
    });
    group.bench_function("classification", |bencher| {
        bencher
            .iter(|| classify(black_box(&series), RATE, EXCITATION, &ClassifySettings::default()).unwrap());
    });
    group.finish();
}

criterion_group!(benches, hour);
criterion_main!(benches);
