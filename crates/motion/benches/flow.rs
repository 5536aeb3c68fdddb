//! Flows over one period, against the general integrator at the same accuracy and against the number of
//! modes.
#![allow(clippy::unwrap_used, missing_docs, reason = "benchmarks")]

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
};

/// Steps of this tolerance leave monodromies of the beam good to about 1e-9 in both integrators.
const EXACT: ExactSettings = ExactSettings { tolerance: 1e-9 };
const GENERAL: f64 = 1e-11;

/// A period of the motion of the paper's beam after some periods from rest.
fn period(system: &System, frequency_hz: f64, periods: u32) -> (Stretch, Vec<f64>) {
    (Stretch { frequency_hz, start: 0.0, end: 1.0 }, common::settled(system, frequency_hz, periods, 0.0))
}

/// State, fundamental matrix and frequency column: one contact at 36 Hz, two at 22 Hz, about eight at 53 Hz,
/// where motion is chaotic: after a few periods it is still the same whatever the rounding.
fn sensitivities(criterion: &mut Criterion) {
    let system = common::paper_beam();
    let mut group = criterion.benchmark_group("flow_with_sensitivities");
    group.sample_size(10);
    for (frequency_hz, periods) in [(36.0, 150), (22.0, 150), (53.0, 8)] {
        let (stretch, state) = period(&system, frequency_hz, periods);
        let mut exact = ExactIntegrator::new(system.clone(), EXACT).unwrap();
        group.bench_function(BenchmarkId::new("exact", frequency_hz), |bencher| {
            bencher.iter(|| exact.flow(&stretch, &state).unwrap());
        });
        group.bench_function(BenchmarkId::new("general", frequency_hz), |bencher| {
            bencher.iter(|| {
                advance(&system, &stretch, &state, &GeneralSettings::with_tolerance(GENERAL)).unwrap()
            });
        });
    }
    group.finish();
}

/// States alone, for uniform beams with more and more modes.
fn modes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("state_by_modes");
    group.sample_size(10);
    for modes in [6, 12, 24, 48, 96] {
        let system = common::uniform_beam(modes);
        let (stretch, state) = period(&system, 31.0, 150);
        let mut exact = common::integrator(&system);
        group.bench_function(BenchmarkId::from_parameter(modes), |bencher| {
            bencher.iter(|| exact.advance(&stretch, &state).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, sensitivities, modes);
criterion_main!(benches);
