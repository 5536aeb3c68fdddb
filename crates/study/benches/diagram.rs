//! How fast whole diagrams are computed: searches, every branch, its bifurcations, and storage.
//!
//! Runs each study once with one thread and once with all cores and prints solutions per second; then, on a sample of the stored solutions, what
//! one of each kind of work costs: an orbit, its sensitivities, its maxima. With `-- --test` only a small study runs.
#![allow(clippy::unwrap_used, reason = "a benchmark ends where its study is wrong")]
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::{
    hint::black_box,
    path::Path,
    thread::available_parallelism,
    time::{Duration, Instant},
};

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{PeriodicSolution, Side};
use hammerbeam_study::{
    Model, OrbitSolver, Store, StudyFile,
    run::{Plan, Quiet, run},
};

/// Solutions on which the costs are measured, about.
const SAMPLE: u64 = 400;

fn main() {
    let trial = std::env::args().any(|argument| argument == "--test");
    let names: &[&str] = if trial {
        &["duffing"]
    } else {
        &["beam-with-stop-one-dof", "beam-with-stop", "beam-with-stop-low-damping"]
    };
    for name in names {
        let cores = available_parallelism().map_or(1, usize::from);
        measure(name, cores, false);
        measure(name, 1, true);
    }
}

fn measure(name: &str, threads: usize, costs: bool) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../studies/{name}.toml"));
    let file = StudyFile::read(&path).unwrap();
    let model = Model::build(&file).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::open_for_run(folder.path(), &file).unwrap();
    let solver = OrbitSolver::new(&model, &file.study);
    let begun = Instant::now();
    run(&mut store, &solver, &Plan::of(&file.study), threads, &mut Quiet).unwrap();
    let elapsed = begun.elapsed().as_secs_f64();
    let branches = store.branches().unwrap();
    let solutions: u64 = branches.iter().map(|branch| branch.up.solutions + branch.down.solutions).sum();
    println!(
        "{name}, {threads} thread(s): {solutions} solutions on {} branches in {elapsed:.1} s, {:.0} solutions/s",
        branches.len(),
        solutions as f64 / elapsed
    );
    if costs {
        print_costs(&model, &sample(&store, solutions));
    }
}

/// Solutions spread evenly over all branches.
fn sample(store: &Store, solutions: u64) -> Vec<PeriodicSolution> {
    let stride = (solutions / SAMPLE).max(1);
    let mut chosen = Vec::new();
    for branch in store.branches().unwrap() {
        for (side, count) in [(Side::Up, branch.up.solutions), (Side::Down, branch.down.solutions)] {
            let numbers = (stride / 2..count).step_by(stride as usize);
            chosen.extend(numbers.map(|number| store.solution(branch.start, side, number as u32).unwrap()));
        }
    }
    chosen
}

fn print_costs(model: &Model, orbits: &[PeriodicSolution]) {
    let watched = Some((model.response.shape.as_slice(), model.response.support_ratio));
    let settings = ExactSettings { tolerance: 1e-11 };
    let mut integrator = ExactIntegrator::watching(model.system.clone(), settings, watched).unwrap();
    let stretch = |orbit: &PeriodicSolution| Stretch {
        frequency_hz: orbit.frequency_hz,
        start: 0.0,
        end: f64::from(orbit.period_multiple),
    };
    let mut time = |work: &mut dyn FnMut(&mut ExactIntegrator, &PeriodicSolution)| -> Duration {
        let begun = Instant::now();
        orbits.iter().for_each(|orbit| work(&mut integrator, orbit));
        begun.elapsed() / orbits.len().max(1) as u32
    };
    let state = time(&mut |integrator, orbit| {
        black_box(integrator.advance(&stretch(orbit), &orbit.nodes[0]).unwrap());
    });
    let flow = time(&mut |integrator, orbit| {
        black_box(integrator.flow(&stretch(orbit), &orbit.nodes[0]).unwrap());
    });
    let maxima = time(&mut |integrator, orbit| {
        black_box(integrator.observe(&[(stretch(orbit), &orbit.nodes[0])]).unwrap());
    });
    let contacts: u32 = orbits.iter().map(|orbit| orbit.maxima.contacts).sum();
    println!(
        "  one orbit, {:.1} contacts on average: state alone {:.0} us, with sensitivities {:.0} us, with maxima {:.0} us",
        f64::from(contacts) / orbits.len().max(1) as f64,
        state.as_secs_f64() * 1e6,
        flow.as_secs_f64() * 1e6,
        maxima.as_secs_f64() * 1e6
    );
}
