//! Periods, exponents and basin cells per second on one core, each against the general integrator.
#![allow(clippy::unwrap_used, missing_docs, reason = "benchmarks")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use faer::Mat;
use hammerbeam_attractor::{
    AttractorError, Axis, Basins, Effort, Grid, InOrder, LyapunovSettings, OneByOne, Part, Patience,
    SectionMap, SystemMap, lyapunov, settle, state_scales,
};
use hammerbeam_motion::{
    Stretch, System,
    exact::ExactSettings,
    general::{GeneralSettings, advance},
};

/// Steps of these tolerances leave monodromies of the beam good to about 1e-9 in both integrators, as in the
/// benchmark of the motion crate.
const EXACT: ExactSettings = ExactSettings { tolerance: 1e-9 };
const GENERAL: f64 = 1e-11;

/// Flight with one contact, with two, and chaos with about eight.
const FREQUENCIES: [f64; 3] = [36.0, 22.0, 53.0];

/// A system by the general integrator; a section is an excitation period.
struct GeneralMap {
    system: System,
    frequency_hz: f64,
}

impl GeneralMap {
    fn run(&self, state: &[f64], sensitivities: bool) -> (Vec<f64>, Mat<f64>) {
        let stretch = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: 1.0 };
        let settings = GeneralSettings { sensitivities, ..GeneralSettings::with_tolerance(GENERAL) };
        let flow = advance(&self.system, &stretch, state, &settings).unwrap().flow;
        (flow.state, flow.by_state)
    }
}

impl SectionMap for GeneralMap {
    fn dimension(&self) -> usize {
        2 * self.system.dof()
    }

    fn duration(&self) -> f64 {
        1.0 / self.frequency_hz
    }

    fn scales(&self) -> Vec<f64> {
        state_scales(&self.system, self.frequency_hz)
    }

    fn advance(&mut self, _: u64, state: &[f64]) -> Result<Vec<f64>, AttractorError> {
        Ok(self.run(state, false).0)
    }

    fn flow(&mut self, _: Part, state: &[f64]) -> Result<(Vec<f64>, Mat<f64>), AttractorError> {
        Ok(self.run(state, true))
    }
}

fn exact(frequency_hz: f64) -> SystemMap {
    SystemMap::new(common::paper_beam(), frequency_hz, 1, EXACT).unwrap()
}

fn general(frequency_hz: f64) -> GeneralMap {
    GeneralMap { system: common::paper_beam(), frequency_hz }
}

fn settled(frequency_hz: f64) -> Vec<f64> {
    let mut map = exact(frequency_hz);
    (0..300).fold(vec![0.0; 12], |state, section| map.advance(section, &state).unwrap())
}

fn follow(map: &mut impl SectionMap, state: &[f64], periods: u64) -> Vec<f64> {
    (0..periods).fold(state.to_vec(), |state, section| map.advance(section, &state).unwrap())
}

/// States alone: 32 periods each.
fn periods(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("periods");
    group.sample_size(10).throughput(Throughput::Elements(32));
    for frequency_hz in FREQUENCIES {
        let state = settled(frequency_hz);
        group.bench_function(BenchmarkId::new("exact", frequency_hz), |bencher| {
            let mut map = exact(frequency_hz);
            bencher.iter(|| follow(&mut map, &state, 32));
        });
        group.bench_function(BenchmarkId::new("general", frequency_hz), |bencher| {
            let mut map = general(frequency_hz);
            bencher.iter(|| follow(&mut map, &state, 32));
        });
    }
    group.finish();
}

/// The whole spectrum of twelve exponents: 40 periods averaged each.
fn exponents(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("periods_with_exponents");
    group.sample_size(10).throughput(Throughput::Elements(40));
    let settings = LyapunovSettings { aligning: 0, averaged: 40 };
    let state = settled(53.0);
    group.bench_function("exact", |bencher| {
        let mut map = exact(53.0);
        bencher.iter(|| lyapunov(&mut map, &state, settings).unwrap());
    });
    group.bench_function("general", |bencher| {
        let mut map = general(53.0);
        bencher.iter(|| lyapunov(&mut map, &state, settings).unwrap());
    });
    group.finish();
}

/// A grid over the displacement and the velocity of the first mode.
fn grid(count: usize) -> Grid {
    let unit = |i: usize| (0..12).map(|k| f64::from(u8::from(k == i))).collect::<Vec<f64>>();
    Grid {
        base: vec![0.0; 12],
        x: Axis { direction: unit(0), low: -1e-3, high: 1e-3, count },
        y: Axis { direction: unit(6), low: -0.2, high: 0.2, count },
    }
}

/// How long a motion may take to repeat at 36 Hz.
const PATIENCE: Patience = Patience { skipped: 0, periods: 400, longest: 8 };

/// Cells of a basin at 36 Hz: an 8 x 8 grid with the attractors found on the way, and one motion from rest
/// until it repeats.
fn cells(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("basin_cells");
    let grid = grid(8);
    group.sample_size(10).throughput(Throughput::Elements(64));
    group.bench_function("exact, 8 x 8", |bencher| {
        bencher.iter(|| {
            let mut basins =
                Basins::new(common::paper_beam(), 36.0, grid.clone(), Effort::default(), EXACT).unwrap();
            while basins.round(&mut OneByOne).is_some() {}
            basins.attractors().len()
        });
    });
    group.throughput(Throughput::Elements(1));
    group.bench_function("exact, one motion", |bencher| {
        let mut map = exact(36.0);
        bencher.iter(|| settle(&mut map, 1, &[0.0; 12], PATIENCE).unwrap());
    });
    group.bench_function("general, one motion", |bencher| {
        let mut map = general(36.0);
        bencher.iter(|| settle(&mut map, 1, &[0.0; 12], PATIENCE).unwrap());
    });
    group.finish();
}

/// Threads of the whole basin.
const CORES: usize = 2;
/// Its cells.
const WHOLE: f64 = 200.0 * 200.0;

/// What a basin of 200 x 200 cells takes on two cores, from cells of the same rectangle by both integrators:
/// a grid of 32 x 32 by the exact one, sixteen cells spread over it by the general one.
fn whole_basin(_: &mut Criterion) {
    let (mut threads, grid) = (common::Threads::of(CORES), grid(32));
    let started = Instant::now();
    let mut basins = Basins::new(common::paper_beam(), 36.0, grid.clone(), Effort::default(), EXACT).unwrap();
    while basins.round(&mut threads).is_some() {}
    report("exact", basins.done(), started.elapsed());
    let spread: Vec<usize> = (0..16).map(|k| 64 * k + 4 * (k % 8)).collect();
    let started = Instant::now();
    let settled = threads.in_order(&spread, &|| general(36.0), &|map, &cell| {
        settle(map, 1, &grid.state(cell), PATIENCE).unwrap()
    });
    report("general", settled.unwrap().len(), started.elapsed());
}

#[allow(clippy::print_stdout, reason = "a benchmark prints what it measures")]
fn report(integrator: &str, cells: usize, taken: Duration) {
    let rate = cells as f64 / taken.as_secs_f64();
    println!(
        "{integrator}: {cells} cells on {CORES} cores in {:.2} s, {rate:.4} cells/s; \
        200 x 200 cells would take {:.2} min",
        taken.as_secs_f64(),
        WHOLE / rate / 60.0
    );
}

criterion_group!(benches, periods, exponents, cells, whole_basin);
criterion_main!(benches);
