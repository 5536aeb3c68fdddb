//! The orbits that a page carries, each computed from its stored nodes over one orbit period.

mod spectrum;

use std::{
    collections::VecDeque,
    f64::consts::TAU,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use hammerbeam_figure::{OrbitRecord, OrbitRecords, PageImpulse, PageOrbit};
use hammerbeam_jobs::orbit_history::{OrbitHistory, OrbitImpact, OrbitInstant, orbit_history};
use hammerbeam_motion::{
    PointMotion,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::{
    Store, StoreError,
    store::{BranchRecord, PlacedRow},
};
use hammerbeam_study::Model;

use spectrum::spectrum;

use super::{Album, Drawn, choice};

/// Orbits that one integrator computes one after the other. It keeps what it did last, so that these do
/// not depend on the number of threads.
const PART: usize = 64;
/// Parts between two looks at whether the page is full: what is short may still fit where something else did
/// not.
const ROUND: usize = 8;
/// Parts that are under way for each thread.
const UNDER_WAY: usize = 2;
/// Samples in each of the steps in which a contact is integrated, unless as many regular ones lie in it.
const IN_A_STEP: usize = 6;
/// Modes whose coordinates are carried: what is seen of a structure in motion.
const DRAWN_MODES: usize = 8;
/// Relative size from which a mode is worth drawing.
const VISIBLE: f64 = 2e-3;

/// Orbits of the solutions that are wanted most, as many as fit, or as were done when the observer says stop.
///
/// * `most`: length of their records (bytes).
/// * `drawn`: whose threads compute them.
///
/// An orbit whose motion cannot be computed is left out: the page shows the nearest one. Records are taken in
/// in the order in which they are wanted, whichever is done first.
pub fn carried(
    store: &Store,
    model: &Model,
    (records, stored): (&[BranchRecord], &[Vec<PlacedRow>]),
    (most, drawn): (usize, &mut Drawn<'_>),
) -> Result<OrbitRecords, StoreError> {
    let order = choice::order(stored);
    let mut carried = OrbitRecords::default();
    let drawing = Arc::new(OrbitDrawing::of(model, drawn.stop()));
    let mut parts = order.chunks(PART);
    let mut under_way = VecDeque::new();
    let (mut taken, mut full) = (0, false);
    while !drawn.is_stopped() {
        for part in parts.by_ref().take(UNDER_WAY * drawn.pool().threads().max(1) - under_way.len()) {
            let mut solutions = Vec::with_capacity(part.len());
            for &number in part {
                match solution(store, records, stored, number) {
                    Err(error) if error.is_of_solutions() => {
                        drawn.refuse("an orbit of the page", error.to_string());
                        solutions.push(None);
                    }
                    found => solutions.push(Some(found?)),
                }
            }
            let drawing = Arc::clone(&drawing);
            under_way.push_back((part, drawn.pool().hand(move || drawing.records(&solutions))));
        }
        let Some((part, pending)) = under_way.pop_front() else { break };
        for (number, record) in part.iter().zip(drawn.wait(&pending)) {
            full |= record.is_some_and(|record| !carried.insert(*number, record, most));
        }
        taken += 1;
        if full && taken % ROUND == 0 {
            break;
        }
        drawn.count(carried.count() as u64, Some(order.len() as u64), "orbits of the page");
    }
    Ok(carried)
}

/// The stored solution with that number, counted over all branches end to end.
fn solution(
    store: &Store,
    records: &[BranchRecord],
    stored: &[Vec<PlacedRow>],
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
struct OrbitDrawing {
    model: Model,
    /// The highest eigenfrequency.
    highest_hz: f64,
    stop: Arc<AtomicBool>,
}

impl OrbitDrawing {
    fn of(model: &Model, stop: Arc<AtomicBool>) -> Self {
        let eigenfrequencies = model.system.model().natural_frequencies.iter();
        let highest_hz = eigenfrequencies.fold(0.0_f64, |most, rate| most.max(rate / TAU));
        Self { model: model.clone(), highest_hz, stop }
    }

    /// Orbits of solutions, in their order, by an integrator of their own; `None` where the motion cannot be
    /// computed, fewer when the observer says stop.
    fn records(&self, solutions: &[Option<PeriodicSolution>]) -> Vec<Option<OrbitRecord>> {
        let settings = ExactSettings::default();
        let Ok(mut integrator) = ExactIntegrator::new(self.model.system.clone(), settings) else {
            return vec![None; solutions.len()];
        };
        let is_wanted = |_: &&Option<PeriodicSolution>| !self.stop.load(Ordering::Relaxed);
        let record = |solution: &Option<PeriodicSolution>| {
            Some(self.orbit(&mut integrator, solution.as_ref()?).ok()?.record())
        };
        solutions.iter().take_while(is_wanted).map(record).collect()
    }

    fn orbit(
        &self,
        integrator: &mut ExactIntegrator,
        solution: &PeriodicSolution,
    ) -> Result<PageOrbit, MotionError> {
        let (samples, stride) = sampling(solution.period_multiple);
        let count = samples * solution.period_multiple as usize;
        let OrbitHistory { instants, impulses } =
            orbit_history(integrator, solution, (2 * samples, IN_A_STEP))?;
        let (model, frequency_hz) = (&self.model, solution.frequency_hz);
        let response = model.response_motion(frequency_hz);
        let mut orbit = PageOrbit {
            duration_s: f64::from(solution.period_multiple) / frequency_hz,
            acceleration_m_s2: vec![NOTHING; count],
            forces_n: vec![vec![NOTHING; count]; model.system.elements().len()],
            support_m: self.supports(frequency_hz, samples / stride),
            impulses: impulses.iter().map(|impulse| page_impulse(impulse, &response)).collect(),
            ..PageOrbit::default()
        };
        let (mut regular, mut states) = (Vec::new(), Vec::new());
        for OrbitInstant { cycles, place, state, forces } in &instants {
            let [displacement, velocity, acceleration] = response.at(*cycles, state, forces);
            let step = ((cycles * samples as f64) as usize).min(count - 1);
            widen(&mut orbit.acceleration_m_s2[step], acceleration);
            for (series, force) in orbit.forces_n.iter_mut().zip(forces) {
                widen(&mut series[step], *force);
            }
            let Some(place) = place else {
                orbit.in_contacts.push((step, displacement, velocity));
                continue;
            };
            regular.push(displacement);
            if place.is_multiple_of(2) {
                orbit.displacement_m.push(displacement);
                orbit.velocity_m_s.push(velocity);
                if (place / 2).is_multiple_of(stride) {
                    states.push(state);
                }
            }
        }
        orbit.modes = modes(&states);
        let base_hz = frequency_hz / f64::from(solution.period_multiple);
        orbit.spectrum_m_s2 = spectrum(&regular, base_hz, 1.2 * self.highest_hz.max(10.0 * frequency_hz));
        Ok(orbit)
    }

    /// Displacements of the supports over an excitation period, one after the other.
    fn supports(&self, frequency_hz: f64, count: usize) -> Vec<f64> {
        let system = &self.model.system;
        let at = |k: usize| system.support_motions(frequency_hz, k as f64 / count as f64);
        let instants: Vec<Vec<[f64; 3]>> = (0..count).map(at).collect();
        let of_support = |support: usize| instants.iter().map(move |motions| motions[support][0]);
        (0..system.model().supports.len()).flat_map(of_support).collect()
    }
}

fn page_impulse(impulse: &OrbitImpact, response: &PointMotion) -> PageImpulse {
    let OrbitImpact { element, cycles, impulse_n_s, before, after } = impulse;
    let [displacement_m, velocity, _] = response.at(*cycles, before, &[]);
    let [_, velocity_after, _] = response.at(*cycles, after, &[]);
    PageImpulse {
        element: *element,
        cycles: *cycles,
        impulse_n_s: *impulse_n_s,
        displacement_m,
        velocity_m_s: [velocity, velocity_after],
    }
}

/// A step of which nothing is known yet.
const NOTHING: [f64; 2] = [f64::NAN; 2];

/// Takes a value, later than those before, into the least and the largest of a step, which stay in their
/// order in time.
fn widen(pair: &mut [f64; 2], value: f64) {
    let [first, second] = *pair;
    *pair = if first.is_nan() {
        [value, value]
    } else if value > first.max(second) {
        [first.min(second), value]
    } else if value < first.min(second) {
        [first.max(second), value]
    } else {
        return;
    };
}

/// Samples in an excitation period, and from one of a mode to the next, which divides them. A phase portrait
/// bends within each excitation period as it does in one: 192 samples in each, where an orbit has more than
/// about a thousand of them fewer.
fn sampling(period_multiple: u32) -> (usize, usize) {
    let samples = (960 / period_multiple.max(1) as usize).clamp(12, 192) / 12 * 12;
    (samples, if period_multiple > 2 { 4 } else { 3 })
}

/// Coordinates of the modes up to the last one that moves visibly.
fn modes(states: &[&Vec<f64>]) -> Vec<Vec<f64>> {
    let dof = states.first().map_or(0, |state| state.len() / 2);
    let series = |mode: usize| states.iter().map(|state| state[mode]).collect::<Vec<f64>>();
    let mut modes: Vec<Vec<f64>> = (0..dof.min(DRAWN_MODES)).map(series).collect();
    let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let largest = modes.iter().map(|values| size(values)).fold(0.0, f64::max);
    while modes.last().is_some_and(|values| size(values) < VISIBLE * largest) {
        modes.pop();
    }
    modes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_and_largest_stay_in_their_order_in_time() {
        let mut pair = NOTHING;
        for value in [1.0, 3.0, 2.0, -1.0, 0.0] {
            widen(&mut pair, value);
        }
        assert_eq!(pair, [3.0, -1.0]);
        widen(&mut pair, 4.0);
        assert_eq!(pair, [-1.0, 4.0]);
    }
}
