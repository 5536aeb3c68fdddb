//! The orbits that a page carries, each computed from its stored nodes over one orbit period.

use std::thread;

use hammerbeam_figure::{OrbitRecords, OrbitSample, PageOrbit};
use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::{Model, Store, StoreError, store::BranchRecord};

use super::{Placed, choice};
use crate::{initial, ticker::Ticker};

/// Orbits that are computed between two looks at whether the page is full.
const ROUND: usize = 512;
/// Modes whose coordinates are carried: what is seen of a structure in motion.
const DRAWN_MODES: usize = 8;
/// Relative size from which a mode is worth drawing.
const VISIBLE: f64 = 1e-4;

/// Orbits of the solutions that are wanted most, as many as fit.
///
/// * `most`: length of their records (bytes).
///
/// An orbit whose motion cannot be computed is left out: the page shows the nearest one.
pub fn carried(
    store: &Store,
    model: &Model,
    (records, stored): (&[BranchRecord], &[Vec<Placed>]),
    most: usize,
) -> Result<OrbitRecords, StoreError> {
    let order = choice::order(stored);
    let mut ticker = Ticker::new(order.len() as u64, "orbits of the page");
    let mut carried = OrbitRecords::default();
    let drawing = Drawing::of(model);
    let mut full = false;
    for round in order.chunks(ROUND) {
        let solutions = round.iter().map(|&number| solution(store, records, stored, number));
        let solutions = solutions.collect::<Result<Vec<_>, _>>()?;
        for (number, orbit) in round.iter().zip(drawing.orbits(&solutions)) {
            full |= orbit.is_some_and(|orbit| !carried.insert(*number, &orbit, most));
        }
        if full {
            break;
        }
        ticker.at(carried.count() as u64, String::new);
    }
    ticker.clear();
    Ok(carried)
}

/// The stored solution with that number, counted over all branches end to end.
fn solution(
    store: &Store,
    records: &[BranchRecord],
    stored: &[Vec<Placed>],
    number: u32,
) -> Result<PeriodicSolution, StoreError> {
    let mut place = number as usize;
    let mut branch = 0;
    while place >= stored[branch].len() {
        place -= stored[branch].len();
        branch += 1;
    }
    let placed = &stored[branch][place];
    store.solution(records[branch].start, placed.side, placed.number)
}

/// What is written down of an orbit.
struct Drawing<'m> {
    model: &'m Model,
    is_moved: bool,
}

impl<'m> Drawing<'m> {
    fn of(model: &'m Model) -> Self {
        Self { model, is_moved: model.system.model().support.is_some() }
    }

    /// Orbits of solutions, on all cores, in their order; `None` where the motion cannot be computed.
    fn orbits(&self, solutions: &[PeriodicSolution]) -> Vec<Option<PageOrbit>> {
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let share = solutions.len().div_ceil(threads).max(1);
        thread::scope(|scope| {
            let work = |part| move || self.part(part);
            let workers: Vec<_> = solutions.chunks(share).map(|part| scope.spawn(work(part))).collect();
            workers.into_iter().flat_map(|worker| worker.join().unwrap_or_default()).collect()
        })
    }

    fn part(&self, solutions: &[PeriodicSolution]) -> Vec<Option<PageOrbit>> {
        let Ok(mut integrator) = ExactIntegrator::new(self.model.system.clone(), ExactSettings::default())
        else {
            return vec![None; solutions.len()];
        };
        solutions.iter().map(|solution| self.orbit(&mut integrator, solution).ok()).collect()
    }

    fn orbit(
        &self,
        integrator: &mut ExactIntegrator,
        solution: &PeriodicSolution,
    ) -> Result<PageOrbit, MotionError> {
        let (a_period, stride) = sampling(solution.period_multiple);
        let states = states(integrator, solution, a_period)?;
        let (model, frequency_hz) = (self.model, solution.frequency_hz);
        let sample = |(k, (state, forces)): (usize, &(Vec<f64>, Vec<f64>))| {
            let phase = (k % a_period) as f64 / a_period as f64;
            let [displacement_m, velocity_m_s, acceleration_m_s2] =
                initial::response(model, frequency_hz, phase, state);
            let support = model.system.support_motion(frequency_hz, phase)[0];
            OrbitSample {
                displacement_m,
                velocity_m_s,
                acceleration_m_s2,
                forces_n: forces.clone(),
                support_m: self.is_moved.then_some(support),
            }
        };
        Ok(PageOrbit {
            samples: states.iter().enumerate().map(sample).collect(),
            modes: modes(&states, stride),
            multipliers: solution.floquet_multipliers.clone(),
        })
    }
}

/// Samples in an excitation period, and how many of them there are to one of a mode: 192 samples in an orbit period of one excitation period, more in a
/// longer one, never more than about a thousand.
fn sampling(period_multiple: u32) -> (usize, usize) {
    match period_multiple {
        0 | 1 => (192, 3),
        2 => (128, 2),
        3..=10 => (96, 3),
        multiple => ((960 / multiple as usize).max(4) / 4 * 4, 2),
    }
}

/// States and forces at equal steps from phase 0 on, each from the node before it.
fn states(
    integrator: &mut ExactIntegrator,
    solution: &PeriodicSolution,
    a_period: usize,
) -> Result<Vec<(Vec<f64>, Vec<f64>)>, MotionError> {
    let count = a_period * solution.period_multiple as usize;
    let (begin, periods) = (solution.phase, f64::from(solution.period_multiple));
    let first = (begin * a_period as f64).ceil() as usize;
    let phase = |k: usize| k as f64 / a_period as f64;
    let segments = solution.nodes.len();
    let mut found = vec![(Vec::new(), Vec::new()); count];
    let mut next = first;
    for (segment, node) in solution.nodes.iter().enumerate() {
        let at = |segment: usize| begin + periods * segment as f64 / segments as f64;
        let (start, end) = (at(segment), at(segment + 1));
        let within = |k: &usize| phase(*k) < end || segment + 1 == segments;
        let numbers: Vec<usize> = (next..first + count).take_while(within).collect();
        let phases: Vec<f64> = numbers.iter().map(|&k| phase(k).clamp(start, end)).collect();
        let trace =
            integrator.trace(&Stretch { frequency_hz: solution.frequency_hz, start, end }, node, &phases)?;
        for ((number, state), forces) in numbers.iter().zip(trace.samples).zip(trace.forces) {
            found[number % count] = (state, forces);
        }
        next += numbers.len();
    }
    Ok(found)
}

/// Coordinates of the modes up to the last one that moves visibly.
fn modes(states: &[(Vec<f64>, Vec<f64>)], stride: usize) -> Vec<Vec<f64>> {
    let dof = states.first().map_or(0, |(state, _)| state.len() / 2);
    let series =
        |mode: usize| states.iter().step_by(stride).map(|(state, _)| state[mode]).collect::<Vec<f64>>();
    let mut modes: Vec<Vec<f64>> = (0..dof.min(DRAWN_MODES)).map(series).collect();
    let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let largest = modes.iter().map(|values| size(values)).fold(0.0, f64::max);
    while modes.last().is_some_and(|values| size(values) < VISIBLE * largest) {
        modes.pop();
    }
    modes
}
