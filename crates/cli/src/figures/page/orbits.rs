//! The orbits that a page carries, each computed from its stored nodes over one orbit period.

mod samples;

use std::{f64::consts::TAU, thread};

use hammerbeam_figure::{OrbitRecords, PageOrbit};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings, MotionError};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::{Model, Store, StoreError, store::BranchRecord};

use samples::Instant;

use super::{Placed, choice};
use crate::{initial, ticker::Ticker};

/// Orbits that are computed between two looks at whether the page is full.
const ROUND: usize = 512;
/// Orbits that one integrator computes one after the other; a round of them is work for eight threads.
const PART: usize = 64;
/// Modes whose coordinates are carried: what is seen of a structure in motion.
const DRAWN_MODES: usize = 8;
/// Harmonics that are carried at most.
const MOST_HARMONICS: usize = 300;
/// Relative size from which a mode is worth drawing.
const VISIBLE: f64 = 1e-3;

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
    /// The frequency up to which spectra are carried.
    highest_hz: f64,
}

impl<'m> Drawing<'m> {
    fn of(model: &'m Model) -> Self {
        let eigenfrequencies = model.system.model().natural_frequencies.iter();
        let highest_hz = 1.2 * eigenfrequencies.fold(0.0_f64, |most, rate| most.max(rate / TAU));
        Self { model, is_moved: model.system.model().support.is_some(), highest_hz }
    }

    /// Orbits of solutions, in their order; `None` where the motion cannot be computed.
    ///
    /// Each part of them has a thread and an integrator of its own. An integrator remembers what it did last, so that the parts do not depend on the number of cores.
    fn orbits(&self, solutions: &[PeriodicSolution]) -> Vec<Option<PageOrbit>> {
        thread::scope(|scope| {
            let work = |part| move || self.part(part);
            let workers: Vec<_> = solutions.chunks(PART).map(|part| scope.spawn(work(part))).collect();
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
        let Sampling { steps, stride } = sampling(solution.period_multiple);
        let count = steps * solution.period_multiple as usize;
        let instants = samples::of_orbit(integrator, solution, steps)?;
        let (model, frequency_hz) = (self.model, solution.frequency_hz);
        let mut orbit = PageOrbit {
            acceleration_m_s2: vec![NOTHING; count],
            forces_n: vec![vec![NOTHING; count]; model.system.elements().len()],
            multipliers: solution.floquet_multipliers.clone(),
            ..PageOrbit::default()
        };
        let mut regular = Vec::with_capacity(2 * count);
        let mut states = Vec::with_capacity(count.div_ceil(stride));
        for Instant { cycles, place, state, forces } in &instants {
            let phase = cycles.rem_euclid(1.0);
            let [displacement, velocity, acceleration] = initial::response(model, frequency_hz, phase, state);
            let step = ((cycles * steps as f64).floor() as usize).min(count - 1);
            widen(&mut orbit.acceleration_m_s2[step], acceleration);
            for (series, force) in orbit.forces_n.iter_mut().zip(forces) {
                widen(&mut series[step], *force);
            }
            let Some(place) = place else { continue };
            regular.push(displacement);
            if place.is_multiple_of(2) {
                orbit.displacement_m.push(displacement);
                orbit.velocity_m_s.push(velocity);
                if (place / 2).is_multiple_of(stride) {
                    states.push(state);
                    let support = model.system.support_motion(frequency_hz, phase)[0];
                    orbit.support_m.push(if self.is_moved { support } else { 0.0 });
                }
            }
        }
        orbit.modes = modes(&states);
        let base_hz = frequency_hz / f64::from(solution.period_multiple);
        orbit.spectrum_m_s2 = spectrum(&regular, base_hz, self.highest_hz);
        Ok(orbit)
    }
}

/// A step of which nothing is known yet.
const NOTHING: [f64; 2] = [f64::NAN; 2];

/// Takes a value, later than those before, into the least and the largest of a step, which stay in their order in time.
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

/// How finely an orbit is carried.
struct Sampling {
    /// Steps in an excitation period.
    steps: usize,
    /// Steps between two samples of a mode.
    stride: usize,
}

/// 192 steps in an orbit period of one excitation period, more in a longer one, up to about a thousand; a stride divides the steps.
fn sampling(period_multiple: u32) -> Sampling {
    let (steps, stride) = match period_multiple {
        0 | 1 => (192, 3),
        2 => (112, 2),
        3..=10 => (80, 2),
        multiple => ((800 / multiple as usize).max(8) / 4 * 4, 2),
    };
    Sampling { steps, stride }
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

/// Amplitudes of the harmonics of the acceleration up to a frequency, from samples of the displacement `y` at equal steps: `(2 pi k f)^2 |y_k|`.
///
/// The displacement is smoother than the acceleration by two orders, so that what aliasing adds is smaller by as much; the harmonics of a Hertz contact fall like `k^-3.5`.
fn spectrum(samples: &[f64], base_hz: f64, highest_hz: f64) -> Vec<f64> {
    let count = samples.len();
    let harmonics =
        ((highest_hz / base_hz) as usize).clamp(20, MOST_HARMONICS).min(count.saturating_sub(1) / 2);
    let turns: Vec<(f64, f64)> = (0..count).map(|k| (TAU * k as f64 / count as f64).sin_cos()).collect();
    let amplitude = |harmonic: usize| {
        let (mut re, mut im, mut place) = (0.0, 0.0, 0);
        for sample in samples {
            let (sin, cos) = turns[place];
            re += sample * cos;
            im += sample * sin;
            place = (place + harmonic) % count;
        }
        2.0 * f64::hypot(re, im) / count as f64 * (TAU * harmonic as f64 * base_hz).powi(2)
    };
    (1..=harmonics).map(amplitude).collect()
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

    /// `y = cos(2 pi f t) + 1e-3 cos(2 pi 5 f t + 1)`: harmonics 1 and 5 of the acceleration, and no other.
    #[test]
    fn amplitudes_are_those_of_the_acceleration() {
        let at = |k: usize| TAU * k as f64 / 128.0;
        let samples: Vec<f64> = (0..128).map(|k| at(k).cos() + 1e-3 * (5.0 * at(k) + 1.0).cos()).collect();
        let found = spectrum(&samples, 2.0, 60.0);
        assert_eq!(found.len(), 30);
        for (harmonic, amplitude) in (1..).zip(found) {
            let rate = TAU * 2.0 * f64::from(harmonic);
            let meant = match harmonic {
                1 => rate * rate,
                5 => 1e-3 * rate * rate,
                _ => 0.0,
            };
            // Rounding of 128 terms, relative to the larger amplitude of the displacement.
            assert!((amplitude - meant).abs() < 1e-13 * rate * rate, "{harmonic}: {amplitude}");
        }
    }
}
