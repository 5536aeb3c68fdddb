//! All orbits that can be found at one frequency.
//!
//! Four sources, none of which needs a guess, the cheap ones first: motion that has settled, from several
//! starts; near-returns of motion that has not settled; Newton's method from many states that motions have
//! passed through (`sampling.rs`); and the crossings of that frequency by the branches of all orbits found,
//! within the range (`crossings.rs`). Where the period is even, orbits of half the period are sought first,
//! and the branches that leave theirs at flips are followed too. If nothing is found at the frequency itself,
//! motions are followed there for longer, then branches are started elsewhere in the range.
//!
//! The work is bounded: motion ends where it has settled, trials of Newton's method end when nothing new has
//! come for long, and the branches may take [`MOST_SOLUTIONS`] together. A search that was bounded by that,
//! or by motion that could not be computed, says so.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response,
    catalogue::Catalogue,
    crossings::Branches,
    cut::search_cut,
    free_vibration::resonance,
    matching::nearest_returns,
    noise::Noise,
    permitted_start::permitted_start_near,
    sampling::{Passed, Patience, Sought, sample},
    start::{Effort, SETTLED, STARTS, check_multiple, search_start, starting_states},
};

/// Periods after which a motion is taken as settled or as never settling,
const SETTLING: usize = 256;
/// looked at so often.
const LOOKS: usize = 8;
/// Periods searched for near-returns.
const RETURNS: usize = 160;
/// Near-returns tried per start.
const TRIED: usize = 8;
/// Reaches of the starts about rest, relative to the motion from rest.
const REACHES: [f64; 6] = [0.01, 0.03, 0.1, 0.3, 1.0, 2.0];
/// First periods of a motion that say nothing of where it goes.
const PASSING: usize = 1;
/// Solutions on all branches of a search.
const MOST_SOLUTIONS: usize = 20_000;
/// Trials from states that were passed,
const PATIENCE: Patience = Patience { trials: 500, for_each: 20, asks_for_two_arrivals: true, most: 4000 };
/// and for orbits of shorter period, which only lead to others.
const PATIENCE_BELOW: Patience =
    Patience { trials: 100, for_each: 4, asks_for_two_arrivals: true, most: 400 };
/// Halvings of the period from which branches are followed to their flips.
const HALVINGS: u32 = 2;
/// Frequencies at which a start of the branch is looked for, as parts of the range.
const LADDER: [f64; 9] = [0.5, 0.25, 0.75, 0.125, 0.875, 0.375, 0.625, 0.0, 1.0];
/// Motion spent at each of them.
const ELSEWHERE_EFFORT: Effort = Effort { starts: 3, attempts: 3 };

/// Finds the orbits of minimal period `period_multiple` at `frequency_hz`: stable before unstable, then
/// largest displacement first.
///
/// * `range_hz`: the frequencies within which branches are followed.
/// * `interrupted`: asked now and then; once it says true the search ends with what it has found.
///
/// # Errors
/// [`OrbitError::PeriodMultiple`] unless the multiple is from 1 to 64; [`OrbitError::Motion`] if not even the
/// integrator can be made. Finding nothing is an empty list.
pub fn find_orbits(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    range_hz: (f64, f64),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<FoundOrbits, OrbitError> {
    check_multiple(period_multiple)?;
    let range_hz = (range_hz.0.min(frequency_hz), range_hz.1.max(frequency_hz));
    let catalogue = Catalogue::new(system, response, settings, frequency_hz)?;
    let branches = Branches::new(range_hz, MOST_SOLUTIONS.min(settings.max_solutions));
    let passed = Passed::default();
    let mut search = OrbitSearch { catalogue, branches, passed, period_multiple, interrupted };
    let starts = starting_states(system, response, frequency_hz, STARTS, settings)?;
    match search.run(starts) {
        // What has been found by then is not lost.
        Err(OrbitError::Interrupted) => search.branches.incomplete = Some(OrbitError::Interrupted),
        searched => searched?,
    }
    let is_wanted = |orbit: &PeriodicSolution| orbit.period_multiple == period_multiple;
    let mut found = search.catalogue.into_found(is_wanted, search.branches.incomplete);
    if found.orbits.is_empty() && found.incomplete.is_none() {
        found.incomplete = resonance(system, frequency_hz);
    }
    found.orbits.sort_by(|x, y| {
        y.may_be_stable()
            .cmp(&x.may_be_stable())
            .then(y.maxima.displacement.total_cmp(&x.maxima.displacement))
    });
    Ok(found)
}

struct OrbitSearch<'a> {
    catalogue: Catalogue<'a>,
    branches: Branches,
    passed: Passed,
    period_multiple: u32,
    interrupted: Interruption<'a>,
}

impl OrbitSearch<'_> {
    fn run(&mut self, starts: Vec<Vec<f64>>) -> Result<(), OrbitError> {
        let linear = starts[0].clone();
        for start in starts {
            self.search_motion(start)?;
        }
        self.search_about_rest(&linear)?;
        self.search_periods()
    }

    fn check_interrupted(&mut self) -> Result<(), OrbitError> {
        if (self.interrupted)() { Err(OrbitError::Interrupted) } else { Ok(()) }
    }

    /// Motions from rest and from states about it, as far away as the motion from rest goes: the linear
    /// response may be far from where the system moves, as for a ball that falls freely. Where no motion can
    /// start, it starts beside: for rest between it and the linear response.
    fn search_about_rest(&mut self, linear: &[f64]) -> Result<(), OrbitError> {
        let dof = self.catalogue.system.dof();
        self.search_motion_near(vec![0.0; 2 * dof], linear)?;
        let motion = self.passed.motions.last().expect("the motion from rest is there");
        let unit = self.catalogue.scale(&vec![0.0; 2 * dof]);
        let largest = motion.iter().max_by(|a, b| unit.size(a).total_cmp(&unit.size(b))).expect("not empty");
        let scale = self.catalogue.scale(largest);
        let mut noise = Noise::new(2);
        for reach in REACHES {
            let add = |i: usize, noise: f64| scale.values()[i] * reach * noise / (1 + i % dof) as f64;
            let start = (0..2 * dof).map(|i| add(i, noise.signed())).collect();
            self.search_motion_near(start, linear)?;
        }
        Ok(())
    }

    fn search_motion_near(&mut self, start: Vec<f64>, other: &[f64]) -> Result<(), OrbitError> {
        let frequency_hz = self.catalogue.frequency_hz;
        let start = permitted_start_near(self.catalogue.integrator(), frequency_hz, start, other);
        self.search_motion(start)
    }

    /// Where a motion settles, and its near-returns.
    fn search_motion(&mut self, start: Vec<f64>) -> Result<(), OrbitError> {
        self.catalogue.probe((0.0, std::slice::from_ref(&start)), self.period_multiple)?;
        let mut states = vec![start];
        let settled = match self.simulate(&mut states) {
            Err(OrbitError::Motion(error)) => {
                self.branches.note_unsearched(OrbitError::Motion(error))?;
                None
            }
            settled => settled?,
        };
        if settled == Some(true) {
            self.search_settled(&states[states.len() - 1])?;
        } else if settled == Some(false) {
            self.search_returns(&states[SETTLING..])?;
        }
        let passing = PASSING.min(states.len() - 1);
        states.drain(..passing);
        self.passed.motions.push(states);
        Ok(())
    }

    /// Newton's method from the state with which the last motion has ended, at a phase without contact where
    /// a law asks for that.
    fn search_settled(&mut self, last: &[f64]) -> Result<(), OrbitError> {
        let orbit = (self.catalogue.frequency_hz, self.period_multiple);
        match search_cut(self.catalogue.integrator(), last, orbit) {
            Ok((start, _)) => {
                self.catalogue.probe((start.phase, &[start.state]), self.period_multiple)?;
                Ok(())
            }
            Err(error) => self.branches.note_unsearched(error),
        }
    }

    /// Appends the states of a motion period by period; true if it settles.
    fn simulate(&mut self, states: &mut Vec<Vec<f64>>) -> Result<Option<bool>, OrbitError> {
        let stretch = Stretch { frequency_hz: self.catalogue.frequency_hz, start: 0.0, end: 1.0 };
        let lag = self.period_multiple as usize;
        for period in 1..=SETTLING + RETURNS {
            self.check_interrupted()?;
            let next = self.catalogue.integrator().advance(&stretch, &states[period - 1])?;
            states.push(next);
            if !period.is_multiple_of(SETTLING / LOOKS) {
                continue;
            }
            let scale = self.catalogue.scale_of_motion(&states[period])?;
            let comes_back = |lag: usize| {
                lag <= period && scale.distance(&states[period], &states[period - lag]) < SETTLED
            };
            if comes_back(lag) || (1..=RETURNS / 8).any(comes_back) {
                return Ok(Some(true));
            }
        }
        Ok(Some(false))
    }

    /// Newton's method from the closest returns of a motion, one state per excitation period.
    fn search_returns(&mut self, states: &[Vec<f64>]) -> Result<(), OrbitError> {
        let multiple = self.period_multiple;
        let scale = self.catalogue.scale_of_motion(&states[0])?;
        for nodes in nearest_returns(states, &scale, multiple as usize, TRIED) {
            self.check_interrupted()?;
            // Newton's method from all states and from the first one alone go different ways; either may
            // arrive.
            self.catalogue.probe((0.0, nodes), multiple)?;
            if multiple > 1 {
                self.catalogue.probe((0.0, &nodes[..1]), multiple)?;
            }
        }
        Ok(())
    }

    /// Trials and branches, of orbits whose doubled period is wanted first.
    fn search_periods(&mut self) -> Result<(), OrbitError> {
        let wanted = self.period_multiple;
        let sought = Sought::all(wanted);
        let ended = sample(&mut self.catalogue, &self.passed, sought, PATIENCE, &mut *self.interrupted)?;
        if !ended {
            let frequency_hz = self.catalogue.frequency_hz;
            self.branches.note_unsearched(OrbitError::SearchTrials { frequency_hz })?;
        }
        let halvings = wanted.trailing_zeros().min(HALVINGS);
        for halving in (1..=halvings).rev() {
            let shorter = wanted >> halving;
            let sought = Sought::all(shorter);
            sample(&mut self.catalogue, &self.passed, sought, PATIENCE_BELOW, &mut *self.interrupted)?;
            self.branches.follow_all(&mut self.catalogue, shorter, true, &mut *self.interrupted)?;
        }
        self.branches.follow_all(&mut self.catalogue, wanted, false, &mut *self.interrupted)?;
        if self.catalogue.count(wanted) == 0
            && let Some(start) = self.start_elsewhere()?
        {
            self.branches.follow(&mut self.catalogue, &start, false, &mut *self.interrupted)?;
            self.branches.follow_all(&mut self.catalogue, wanted, false, &mut *self.interrupted)?;
        }
        Ok(())
    }

    /// An orbit where a branch can start: by a longer look at the frequency itself, then at others.
    fn start_elsewhere(&mut self) -> Result<Option<PeriodicSolution>, OrbitError> {
        let (low, high) = self.branches.range_hz;
        let Catalogue { system, response, settings, frequency_hz, .. } = self.catalogue;
        let here = std::iter::once((frequency_hz, Effort::FULL));
        let elsewhere = LADDER.iter().map(|part| (low + part * (high - low), ELSEWHERE_EFFORT));
        for (from_hz, effort) in here.chain(elsewhere) {
            let orbit = (from_hz, self.period_multiple);
            match search_start(system, response, orbit, effort, settings, &mut *self.interrupted) {
                Ok(start) => return Ok(Some(start)),
                Err(OrbitError::NoOrbit { .. }) => {}
                Err(error) => self.branches.note_unsearched(error)?,
            }
        }
        Ok(None)
    }
}
