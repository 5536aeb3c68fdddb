//! How fast the harmonic branch of the paper's beam is computed, multipliers and maxima included.
//!
//! * one evaluation of the shooting equations (flow over a period with sensitivities) against the general
//!   integrator at the same accuracy;
//! * solutions per second along the branch, at the default steps and at 0.001 Hz, in the smooth part and
//!   among the dense folds.
//!
//! With `-- --test` each case runs once, on short ranges.
#![allow(clippy::unwrap_used, reason = "a benchmark ends where its system is wrong")]
#![allow(clippy::print_stdout, reason = "work counts stand beside the times")]
#![allow(missing_docs, reason = "the macros of the benchmark library generate functions")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;

use common::{beam, orbit_at, walk};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hammerbeam_motion::{
    Flow, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
};
use hammerbeam_orbit::{OrbitSettings, Side};

/// Whether only a trial run is asked for.
fn trial() -> bool {
    std::env::args().any(|argument| argument == "--test")
}

/// Largest difference of the fundamental matrices in the energy norm's units, relative to the largest entry.
fn error(system: &System, found: &Flow, expected: &Flow) -> f64 {
    let n = system.dof();
    let scale = |i: usize| if i < n { system.model().natural_frequencies[i] } else { 1.0 };
    let entries = || (0..2 * n).flat_map(|i| (0..2 * n).map(move |j| (i, j)));
    let scaled = |flow: &Flow, (i, j): (usize, usize)| flow.by_state[(i, j)] * scale(i) / scale(j);
    let difference = entries().map(|at| (scaled(found, at) - scaled(expected, at)).abs()).fold(0.0, f64::max);
    difference / entries().map(|at| scaled(expected, at).abs()).fold(0.0, f64::max)
}

fn evaluation(criterion: &mut Criterion) {
    let beam = beam();
    let mut group = criterion.benchmark_group("evaluation");
    group.sample_size(20);
    for frequency_hz in [36.2, 33.6, 27.55] {
        let orbit = orbit_at(&beam, frequency_hz);
        let (system, state) = (&beam.0, &orbit.nodes[0]);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-11 }).unwrap();
        let reference =
            advance(system, &stretch, state, &GeneralSettings::with_tolerance(1e-14)).unwrap().flow;
        let reached = error(system, &exact.flow(&stretch, state).unwrap(), &reference);
        let general = |exponent: i32| GeneralSettings::with_tolerance(10f64.powi(exponent));
        let general_error = |exponent| {
            error(system, &advance(system, &stretch, state, &general(exponent)).unwrap().flow, &reference)
        };
        let exponent = (-13..=-8).rev().find(|&exponent| general_error(exponent) <= reached).unwrap_or(-13);
        println!(
            "{frequency_hz} Hz, {} contacts: exact {reached:.1e}, general {:.1e} at tolerance 1e{exponent}",
            orbit.maxima.contacts,
            general_error(exponent)
        );
        group.bench_function(format!("exact/{frequency_hz}"), |bencher| {
            bencher.iter(|| exact.flow(black_box(&stretch), state).unwrap());
        });
        group.bench_function(format!("general/{frequency_hz}"), |bencher| {
            bencher.iter(|| advance(system, black_box(&stretch), state, &general(exponent)).unwrap());
        });
    }
    group.finish();
}

/// Walks from the first frequency to the second.
fn stretch_of_branch(criterion: &mut Criterion, (from_hz, to_hz): (f64, f64), max_step: f64) {
    let beam = beam();
    let settings = OrbitSettings { max_step, ..OrbitSettings::default() };
    let start = orbit_at(&beam, from_hz);
    let side = if to_hz > from_hz { Side::Up } else { Side::Down };
    let range = (from_hz.min(to_hz), from_hz.max(to_hz));
    let go = || walk(&beam.0, &beam.1, &start, side, range, &settings);
    let (rows, evaluations) = go();
    let solutions = rows.len() - 1;
    println!(
        "{from_hz} to {to_hz} Hz at {max_step} Hz: {solutions} solutions, {:.3} evaluations each",
        evaluations as f64 / solutions as f64
    );
    let mut group = criterion.benchmark_group("solutions");
    group.sample_size(10).throughput(Throughput::Elements(solutions as u64));
    group.bench_function(format!("{from_hz} to {to_hz} Hz at {max_step} Hz"), |bencher| bencher.iter(go));
    group.finish();
}

/// Walks once over a whole range, from `from_hz` to both ends, and prints the solutions per second.
fn whole_range((from_hz, range): (f64, (f64, f64)), max_step: f64) {
    let beam = beam();
    let settings = OrbitSettings { max_step, ..OrbitSettings::default() };
    let start = orbit_at(&beam, from_hz);
    let started = std::time::Instant::now();
    let (mut solutions, mut evaluations) = (0, 0);
    for side in [Side::Down, Side::Up] {
        let (rows, count) = walk(&beam.0, &beam.1, &start, side, range, &settings);
        solutions += rows.len();
        evaluations += count;
    }
    let seconds = started.elapsed().as_secs_f64();
    println!(
        "{} to {} Hz at {max_step} Hz: {solutions} solutions, {:.3} evaluations each, {:.0} per second",
        range.0,
        range.1,
        evaluations as f64 / solutions as f64,
        solutions as f64 / seconds
    );
}

fn branch(criterion: &mut Criterion) {
    if trial() {
        stretch_of_branch(criterion, (50.0, 50.2), 0.02);
        stretch_of_branch(criterion, (50.0, 50.02), 0.001);
        return;
    }
    stretch_of_branch(criterion, (30.0, 110.0), 0.02);
    stretch_of_branch(criterion, (30.0, 25.0), 0.02);
    stretch_of_branch(criterion, (25.0, 19.0), 0.02);
    stretch_of_branch(criterion, (50.0, 52.0), 0.001);
    stretch_of_branch(criterion, (37.0, 35.0), 0.001);
    stretch_of_branch(criterion, (20.5, 19.9), 0.001);
    for max_step in [0.0182, 0.001] {
        whole_range((30.0, (25.0, 110.0)), max_step);
        whole_range((21.0, (19.0, 25.0)), max_step);
    }
}

criterion_group!(benches, evaluation, branch);
criterion_main!(benches);
