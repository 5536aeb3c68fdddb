//! How fast whole diagrams are computed: searches, every branch, its bifurcations, and storage.
//!
//! Runs each study once with one thread and once with all cores and prints solutions per second; then, on a
//! sample of the stored solutions, what one of each kind of work costs (an orbit, its sensitivities, its
//! maxima), and the shares of flight, contact, linear algebra and storage in the time of a solution. Flight
//! is what the parts of an orbit without contact take on their own, without what beginning and ending them
//! takes, contact the rest of an evaluation; linear algebra is a bordered system factorised and solved twice
//! with each evaluation and the multipliers with each solution; what is left are maxima and the path's own
//! checks. With `-- --test` only a small study runs.
#![allow(clippy::unwrap_used, reason = "a benchmark ends where its study is wrong")]
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::{hint::black_box, path::Path, thread::available_parallelism, time::Instant};

use hammerbeam_jobs::{
    OrbitSolver, Quiet,
    run::{Plan, run},
};
use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{BranchWalk, OrbitSettings, PeriodicSolution, Side, eigenvalues};
use hammerbeam_path::DenseLu;
use hammerbeam_results::{Store, store::JobKind};
use hammerbeam_study::{Model, StudyFile};

/// Solutions on which the costs are measured, about.
const SAMPLE: u64 = 400;
/// Walks from some of them, and steps of each.
const WALKS: usize = 20;
const STEPS: usize = 50;

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
        "{name}, {threads} thread(s): {solutions} solutions on {} branches in {elapsed:.1} s, {:.0} \
        solutions/s",
        branches.len(),
        solutions as f64 / elapsed
    );
    if costs {
        print_costs(&model, &file, &sample(&store, solutions));
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

/// What the parts of a solution cost on average [s].
struct Costs {
    state: f64,
    /// An evaluation: the state with its sensitivities,
    evaluation: f64,
    /// and what of it falls to free flight.
    flight: f64,
    maxima: f64,
    /// A bordered system, factorised and solved twice,
    system: f64,
    /// and the multipliers of a monodromy matrix.
    multipliers: f64,
    /// A solution of a walk, with everything but storage,
    walked: f64,
    /// and the evaluations that it takes.
    evaluations: f64,
    storage: f64,
}

impl Costs {
    /// Shares of a solution's time, in percent: flight, contact, linear algebra, the rest (maxima, checks of
    /// the path), storage.
    fn shares(&self) -> [f64; 5] {
        let flight = self.evaluations * self.flight;
        let contact = self.evaluations * (self.evaluation - self.flight);
        let algebra = self.evaluations * self.system + self.multipliers;
        let others = self.walked - flight - contact - algebra;
        let whole = self.walked + self.storage;
        [flight, contact, algebra, others, self.storage].map(|part| 100.0 * part / whole)
    }
}

fn print_costs(model: &Model, file: &StudyFile, orbits: &[PeriodicSolution]) {
    let contacts: u32 = orbits.iter().map(|orbit| orbit.maxima.contacts).sum();
    let costs = costs(model, file, orbits);
    let microseconds = |seconds: f64| seconds * 1e6;
    println!(
        "  one orbit, {:.1} contacts on average: state alone {:.0} us, with sensitivities {:.0} us, of \
        which in flight {:.0} us; with maxima {:.0} us",
        f64::from(contacts) / orbits.len().max(1) as f64,
        microseconds(costs.state),
        microseconds(costs.evaluation),
        microseconds(costs.flight),
        microseconds(costs.maxima)
    );
    let [flight, contact, algebra, others, storage] = costs.shares();
    println!(
        "  a solution of a walk, {:.2} evaluations: {:.0} us: flight {flight:.0} %, contact {contact:.0} %, \
        linear algebra {algebra:.1} %, maxima and path {others:.0} %, storage {storage:.0} %",
        costs.evaluations,
        microseconds(costs.walked + costs.storage)
    );
}

fn costs(model: &Model, file: &StudyFile, orbits: &[PeriodicSolution]) -> Costs {
    let watched = Some((model.response.shape.as_slice(), model.response.support_ratios.as_slice()));
    let settings = ExactSettings { tolerance: 1e-11 };
    let mut integrator = ExactIntegrator::watching(model.system.clone(), settings, watched).unwrap();
    let flights: Vec<Vec<(Stretch, Vec<f64>)>> =
        orbits.iter().map(|orbit| flights(&mut integrator, orbit)).collect();
    let mut time = |work: &mut dyn FnMut(&mut ExactIntegrator, usize)| -> f64 {
        let begun = Instant::now();
        (0..orbits.len()).for_each(|index| work(&mut integrator, index));
        begun.elapsed().as_secs_f64() / orbits.len().max(1) as f64
    };
    let state = time(&mut |integrator, index| {
        black_box(integrator.advance(&stretch(&orbits[index]), &orbits[index].nodes[0]).unwrap());
    });
    let evaluation = time(&mut |integrator, index| {
        black_box(integrator.flow(&stretch(&orbits[index]), &orbits[index].nodes[0]).unwrap());
    });
    let mut flights_over = |part: f64| {
        time(&mut |integrator, index| {
            for (stretch, state) in &flights[index] {
                let end = stretch.start + part * (stretch.end - stretch.start);
                black_box(integrator.flow(&Stretch { end, ..*stretch }, state).unwrap());
            }
        })
    };
    // Beginning and ending a stretch is no flight: an evaluation does that once.
    let flight = (flights_over(1.0) - flights_over(1e-6)).max(0.0);
    let maxima = time(&mut |integrator, index| {
        black_box(integrator.observe(&[(stretch(&orbits[index]), &orbits[index].nodes[0])]).unwrap());
    });
    let matrices: Vec<Vec<f64>> = orbits.iter().map(|orbit| monodromy(&mut integrator, orbit)).collect();
    let [system, multipliers] = linear_algebra(&matrices);
    let (walked, evaluations) = walk(model, file, orbits);
    let storage = store(file, orbits);
    Costs { state, evaluation, flight, maxima, system, multipliers, walked, evaluations, storage }
}

/// Monodromy matrix of an orbit, by rows.
fn monodromy(integrator: &mut ExactIntegrator, orbit: &PeriodicSolution) -> Vec<f64> {
    let by_state = integrator.flow(&stretch(orbit), &orbit.nodes[0]).unwrap().by_state;
    let size = by_state.nrows();
    (0..size * size).map(|k| by_state[(k / size, k % size)]).collect()
}

/// Times [s] of a bordered system of `A - I`, factorised and solved twice, and of the eigenvalues of `A`, on
/// average over these.
fn linear_algebra(matrices: &[Vec<f64>]) -> [f64; 2] {
    let count = matrices.len().max(1) as f64;
    let mut lu = DenseLu::new();
    let begun = Instant::now();
    for matrix in matrices {
        let size = matrix.len().isqrt();
        // One row and one column more, as for the frequency.
        let entry = |i: usize, j: usize| match (i < size, j < size) {
            (true, true) => matrix[i * size + j] - f64::from(i == j),
            _ => 1.0 / (1 + i + j) as f64,
        };
        let bordered: Vec<f64> =
            (0..(size + 1) * (size + 1)).map(|k| entry(k / (size + 1), k % (size + 1))).collect();
        lu.factorise(size + 1, &bordered).unwrap();
        for _ in 0..2 {
            let mut right_hand_side = vec![1.0; size + 1];
            lu.solve(&mut right_hand_side);
            black_box(right_hand_side);
        }
    }
    let system = begun.elapsed().as_secs_f64() / count;
    let begun = Instant::now();
    for matrix in matrices {
        black_box(eigenvalues(matrix.len().isqrt(), matrix).unwrap());
    }
    [system, begun.elapsed().as_secs_f64() / count]
}

fn stretch(orbit: &PeriodicSolution) -> Stretch {
    Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: f64::from(orbit.period_multiple) }
}

/// Stretches of an orbit in which no force acts, and the states at their starts.
fn flights(integrator: &mut ExactIntegrator, orbit: &PeriodicSolution) -> Vec<(Stretch, Vec<f64>)> {
    let always = integrator.system().elements().iter().any(|element| element.law.contacts().is_empty());
    if always {
        return Vec::new();
    }
    let whole = stretch(orbit);
    let trace = integrator.trace(&whole, &orbit.nodes[0], &[]).unwrap();
    let phase = |time: f64| time * orbit.frequency_hz;
    let mut closed: Vec<(f64, f64)> = trace
        .contacts
        .iter()
        .map(|piece| {
            (piece.begin.as_ref().map_or(0.0, |begin| phase(begin.time)), piece.end.map_or(whole.end, phase))
        })
        .collect();
    closed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut free, mut from) = (Vec::new(), 0.0);
    for (begin, end) in closed.into_iter().chain([(whole.end, whole.end)]) {
        if begin > from {
            free.push(Stretch { start: from, end: begin, ..whole });
        }
        from = f64::max(from, end);
    }
    let starts: Vec<f64> = free.iter().map(|stretch| stretch.start).collect();
    let states = integrator.trace(&whole, &orbit.nodes[0], &starts).unwrap().samples;
    free.into_iter().zip(states).collect()
}

/// Time [s] and evaluations of a solution, over short walks from some of the orbits.
fn walk(model: &Model, file: &StudyFile, orbits: &[PeriodicSolution]) -> (f64, f64) {
    let [low, high] = file.study.excitation.range_hz();
    let settings = OrbitSettings::default();
    let (mut rows, mut evaluations, mut elapsed) = (Vec::new(), 0, 0.0);
    for orbit in orbits.iter().step_by(orbits.len().div_ceil(WALKS).max(1)) {
        let begun = BranchWalk::new(&model.system, &model.response, orbit, Side::Up, (low, high), &settings);
        let Ok(mut walk) = begun else { continue };
        let begun = Instant::now();
        for _ in 0..STEPS {
            match walk.step(&mut rows) {
                Ok(None) => {}
                Ok(Some(_)) | Err(_) => break,
            }
        }
        elapsed += begun.elapsed().as_secs_f64();
        evaluations += walk.evaluations();
    }
    let count = rows.len().max(1) as f64;
    (elapsed / count, evaluations as f64 / count)
}

/// Time to store a solution [s].
fn store(file: &StudyFile, orbits: &[PeriodicSolution]) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::open_for_run(folder.path(), file).unwrap();
    store.add_jobs(&[(JobKind::Survey, 1.0, None, 0)]).unwrap();
    let job = store.jobs().unwrap().remove(0);
    let begun = Instant::now();
    store.note_starts(&job, orbits, None).unwrap();
    begun.elapsed().as_secs_f64() / orbits.len().max(1) as f64
}
