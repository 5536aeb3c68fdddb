//! Periodic attractors by plain simulation from random states.
//!
//! A motion has settled when its state repeats after N excitation periods, N up to the longest period that is
//! looked for; one that does not within the given number of periods is aperiodic, longer, or slow.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_study::{Model, PointStart, PointStartKind};

use crate::{
    plain::{Coordinates, Equations, PlainMotion},
    results::BoxedError,
};

/// How much is simulated.
#[derive(Debug, Clone, Copy)]
pub struct SimulationEffort {
    /// Random states at a frequency.
    pub states: usize,
    /// Longest period looked for, in excitation periods.
    pub longest: usize,
    /// Excitation periods after which a motion counts as not settling.
    pub patience: usize,
}

/// A motion that repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyedAttractor {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Its states at phase 0, one for each of its excitation periods.
    pub states: Vec<Vec<f64>>,
    /// Motions that came to it.
    pub motions: usize,
}

impl SurveyedAttractor {
    /// Orbit period over excitation period.
    #[must_use]
    pub fn period(&self) -> usize {
        self.states.len()
    }
}

/// What follows motion, at one frequency.
#[derive(Debug)]
pub enum Simulator<'a> {
    /// The library's own integrator.
    Exact(Box<ExactIntegrator>, Stretch),
    /// One that shares nothing with it.
    Plain(PlainMotion<'a>, &'a Model, f64),
}

impl<'a> Simulator<'a> {
    /// The library's own at a frequency [Hz].
    ///
    /// # Errors
    /// The system has something that it cannot follow.
    pub fn exact(system: &System, frequency_hz: f64) -> Result<Self, BoxedError> {
        let integrator = ExactIntegrator::new(system.clone(), ExactSettings::default())?;
        Ok(Self::Exact(Box::new(integrator), Stretch { frequency_hz, start: 0.0, end: 1.0 }))
    }

    /// The other one at a frequency [Hz].
    #[must_use]
    pub fn plain(equations: &'a Equations, model: &'a Model, frequency_hz: f64) -> Self {
        Self::Plain(PlainMotion::new(equations, frequency_hz), model, frequency_hz)
    }

    /// The state `[q; q']` of the modes one excitation period later.
    ///
    /// # Errors
    /// The motion cannot be computed.
    pub fn period(&mut self, state: &[f64]) -> Result<Vec<f64>, BoxedError> {
        match self {
            Self::Exact(integrator, stretch) => Ok(integrator.advance(stretch, state)?),
            Self::Plain(motion, model, frequency_hz) => {
                let next = motion.period(&of_equations(motion, model, state));
                of_modes(motion, model, *frequency_hz, next)
            }
        }
    }

    /// Whether motion may begin at a state: not beyond a rigid stop.
    #[must_use]
    pub fn may_begin(&self, state: &[f64]) -> bool {
        match self {
            Self::Exact(..) => true,
            Self::Plain(motion, model, _) => motion.may_begin(&of_equations(motion, model, state)),
        }
    }
}

/// A state of the modes in the coordinates of the equations.
fn of_equations(motion: &PlainMotion, model: &Model, state: &[f64]) -> Vec<f64> {
    let Coordinates::Masses(names) = motion.coordinates() else { return state.to_vec() };
    let n = model.system.dof();
    let points = names.iter().filter_map(|name| model.system.model().point(name));
    let moved = |modes: &[f64], ground: f64| -> Vec<f64> {
        let of_point = |shape: &[f64]| shape.iter().zip(modes).map(|(a, b)| a * b).sum::<f64>();
        let of_ground = |ratios: &[f64]| ratios.first().map_or(0.0, |ratio| ratio * ground);
        points.clone().map(|point| of_point(&point.shape) + of_ground(&point.support_ratios)).collect()
    };
    let [u, v] = motion.ground();
    [moved(&state[..n], u), moved(&state[n..], v)].concat()
}

fn of_modes(
    motion: &PlainMotion,
    model: &Model,
    frequency_hz: f64,
    state: Vec<f64>,
) -> Result<Vec<f64>, BoxedError> {
    let Coordinates::Masses(names) = motion.coordinates() else { return Ok(state) };
    let (y, v) = state.split_at(names.len());
    let starts = |values: &[f64], kind: PointStartKind| -> Vec<PointStart> {
        let start = |(name, value): (&String, &f64)| PointStart { point: name.clone(), kind, value: *value };
        names.iter().zip(values).map(start).collect()
    };
    let starts = [starts(y, PointStartKind::Displacement), starts(v, PointStartKind::Velocity)].concat();
    Ok(model.state_of_points(frequency_hz, &starts)?)
}

/// The same numbers from the same seed (a linear congruence, Knuth's constants).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// From a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Evenly from 0 to 1.
    pub fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Distance, relative to the motion, at which it counts as having repeated.
const REPEATED: f64 = 1e-8;
/// Distance at which a motion counts as having come to an attractor that is already known.
const ARRIVED: f64 = 1e-5;
/// Excitation periods between two looks.
const BETWEEN_LOOKS: usize = 48;

/// Energy norm of the difference of two states relative to the first.
#[must_use]
pub fn distance(system: &System, a: &[f64], b: &[f64]) -> f64 {
    let n = system.dof();
    let unit = |i: usize| if i < n { system.model().natural_frequencies[i] } else { 1.0 };
    let norm =
        |value: &dyn Fn(usize) -> f64| (0..2 * n).map(|i| (value(i) * unit(i)).powi(2)).sum::<f64>().sqrt();
    norm(&|i| a[i] - b[i]) / norm(&|i| a[i]).max(f64::MIN_POSITIVE)
}

/// Attractors that random states settle to, and the number of motions that did not settle.
///
/// * `size`: energy norm of the largest motions to be expected [kg^1/2 m/s]; states reach to one and a half
///   times of it.
///
/// # Errors
/// A motion cannot be computed.
pub fn attractors(
    system: &System,
    simulator: &mut Simulator,
    frequency_hz: f64,
    size: f64,
    effort: &SimulationEffort,
    random: &mut Random,
) -> Result<(Vec<SurveyedAttractor>, usize), BoxedError> {
    let (mut found, mut restless): (Vec<SurveyedAttractor>, usize) = (Vec::new(), 0);
    for _ in 0..effort.states {
        let mut start = random_state(system, size, random);
        while !simulator.may_begin(&start) {
            start = random_state(system, size, random);
        }
        let mut states = vec![start];
        let mut settled = false;
        for _ in 0..effort.patience / BETWEEN_LOOKS {
            states = followed(simulator, states, effort.longest)?;
            let last = states.len() - 1;
            if let Some(known) = found.iter_mut().find(|known| is_on(system, known, &states[last])) {
                known.motions += 1;
                settled = true;
                break;
            }
            let repeats = |period: &usize| distance(system, &states[last], &states[last - period]) < REPEATED;
            if let Some(period) = (1..=effort.longest).find(repeats) {
                let states = states[last + 1 - period..].to_vec();
                found.push(SurveyedAttractor { frequency_hz, states, motions: 1 });
                settled = true;
                break;
            }
        }
        restless += usize::from(!settled);
    }
    Ok((found, restless))
}

/// The last states, one more than the longest period, after some more periods.
fn followed(
    simulator: &mut Simulator,
    mut states: Vec<Vec<f64>>,
    longest: usize,
) -> Result<Vec<Vec<f64>>, BoxedError> {
    for _ in 0..BETWEEN_LOOKS {
        let next = simulator.period(&states[states.len() - 1])?;
        states.push(next);
    }
    let surplus = states.len().saturating_sub(longest + 1);
    states.drain(..surplus);
    Ok(states)
}

fn is_on(system: &System, attractor: &SurveyedAttractor, state: &[f64]) -> bool {
    attractor.states.iter().any(|known| distance(system, known, state) < ARRIVED)
}

/// Displacements and velocities of the modes, evenly within a size that falls with the order of the mode.
fn random_state(system: &System, size: f64, random: &mut Random) -> Vec<f64> {
    let n = system.dof();
    let reach = 1.5 * size * random.part();
    let mut state = vec![0.0; 2 * n];
    for i in 0..n {
        let part = reach / (1 + i) as f64;
        state[i] = part * (2.0 * random.part() - 1.0) / system.model().natural_frequencies[i].max(1e-3);
        state[n + i] = part * (2.0 * random.part() - 1.0);
    }
    state
}
