//! Whether computed branches hold every periodic attractor that simulation finds.
//!
//! At random frequencies random states are simulated until they repeat. Each attractor must be one of the
//! orbits in which the branches of its period cross that frequency. What is not found is what a run misses,
//! or where simulation and shooting disagree.

use hammerbeam_jobs::corrected;
use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{OrbitMaxima, PeriodicSolution, states_at_phase};

use crate::{
    attractors::{Random, SimulationEffort, Simulator, SurveyedAttractor, attractors, distance},
    plain::Equations,
    results::{BoxedError, Results},
};

/// Distance of an attractor from an orbit of a branch, relative to it, up to which they are the same.
const SAME: f64 = 1e-4;

/// What came of a check.
#[derive(Debug, Default)]
pub struct Report {
    /// Frequencies looked at.
    pub frequencies: usize,
    /// Motions simulated.
    pub motions: usize,
    /// Motions that did not settle to a period that was looked for.
    pub restless: usize,
    /// Attractors found, by period.
    pub found: Vec<usize>,
    /// Attractors that are on no branch.
    pub missing: Vec<SurveyedAttractor>,
}

impl Report {
    /// Number of attractors.
    #[must_use]
    pub fn attractors(&self) -> usize {
        self.found.iter().sum()
    }
}

/// Compares the branches of some results with what simulation finds at `frequencies` random frequencies.
///
/// * `plain`: equations for the integrator that shares nothing with the library; its own without.
///
/// # Errors
/// A motion cannot be computed, or the store refuses.
pub fn check(
    results: &Results,
    plain: Option<&Equations>,
    frequencies: usize,
    effort: &SimulationEffort,
    seed: u64,
) -> Result<Report, BoxedError> {
    let mut random = Random::new(seed);
    let [low, high] = results.range_hz;
    let mut report = Report::of(effort);
    for _ in 0..frequencies {
        let frequency_hz = low + (high - low) * random.part();
        report.look_at(results, plain, frequency_hz, effort, &mut random)?;
    }
    Ok(report)
}

/// The same at given frequencies [Hz].
///
/// # Errors
/// A motion cannot be computed, or the store refuses.
pub fn check_at(
    results: &Results,
    plain: Option<&Equations>,
    frequencies_hz: &[f64],
    effort: &SimulationEffort,
    seed: u64,
) -> Result<Report, BoxedError> {
    let mut random = Random::new(seed);
    let mut report = Report::of(effort);
    for frequency_hz in frequencies_hz {
        report.look_at(results, plain, *frequency_hz, effort, &mut random)?;
    }
    Ok(report)
}

impl Report {
    fn of(effort: &SimulationEffort) -> Self {
        Self { found: vec![0; effort.longest + 1], ..Self::default() }
    }

    fn look_at(
        &mut self,
        results: &Results,
        plain: Option<&Equations>,
        frequency_hz: f64,
        effort: &SimulationEffort,
        random: &mut Random,
    ) -> Result<(), BoxedError> {
        let mut orbits: Vec<Vec<PeriodicSolution>> = vec![Vec::new()];
        for multiple in 1..=effort.longest {
            let crossing = results.crossings(frequency_hz, multiple as u32)?;
            orbits.push(crossing.into_iter().map(|(_, orbit)| orbit).collect());
        }
        let size = orbits.iter().flatten().map(|orbit| energy_norm(results, orbit)).fold(0.0, f64::max);
        let system = &results.model.system;
        let mut simulator = match plain {
            Some(equations) => Simulator::plain(equations, &results.model, frequency_hz),
            None => Simulator::exact(system, frequency_hz)?,
        };
        let (found, restless) = attractors(system, &mut simulator, frequency_hz, size, effort, random)?;
        self.frequencies += 1;
        self.motions += effort.states;
        self.restless += restless;
        for attractor in found {
            let attractor = shortest(results, attractor);
            let period = attractor.period();
            self.found[period] += 1;
            let same = |orbit: &PeriodicSolution| {
                let there = at_phase_0(system, orbit);
                attractor.states.iter().any(|state| distance(system, state, &there) < SAME)
            };
            if !orbits[period].iter().any(same) {
                self.missing.push(attractor);
            }
        }
        Ok(())
    }
}

/// The state of an orbit at phase 0, infinitely far away if its motion cannot be computed.
fn at_phase_0(system: &System, orbit: &PeriodicSolution) -> Vec<f64> {
    let states = ExactIntegrator::new(system.clone(), ExactSettings::default())
        .and_then(|mut integrator| states_at_phase(&mut integrator, orbit, 0.0));
    states.map_or_else(|_| vec![f64::INFINITY; orbit.nodes[0].len()], |mut states| states.swap_remove(0))
}

fn energy_norm(results: &Results, orbit: &PeriodicSolution) -> f64 {
    let n = results.model.system.dof();
    let frequencies = &results.model.system.model().natural_frequencies;
    let unit = |i: usize| if i < n { frequencies[i] } else { 1.0 };
    orbit.nodes[0].iter().enumerate().map(|(i, z)| (z * unit(i)).powi(2)).sum::<f64>().sqrt()
}

/// A motion that creeps alternately towards an orbit seems to have a multiple of its period: shooting from
/// there decides.
fn shortest(results: &Results, attractor: SurveyedAttractor) -> SurveyedAttractor {
    let guess = |state: &[f64], period: usize| PeriodicSolution {
        frequency_hz: attractor.frequency_hz,
        period_multiple: period as u32,
        phase: 0.0,
        nodes: vec![state.to_vec()],
        floquet_multipliers: Vec::new(),
        on_circle: Vec::new(),
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    };
    let period = attractor.period();
    for shorter in (1..period).filter(|shorter| period.is_multiple_of(*shorter)) {
        if let Some(orbit) = corrected(&results.model, &guess(&attractor.states[0], shorter)) {
            let there = at_phase_0(&results.model.system, &orbit);
            let off = distance(&results.model.system, &attractor.states[0], &there);
            if off < SAME {
                let states = attractor.states[..shorter].to_vec();
                return SurveyedAttractor { states, ..attractor };
            }
        }
    }
    attractor
}
