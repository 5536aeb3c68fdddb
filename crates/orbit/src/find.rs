//! All orbits that can be found at one frequency.
//!
//! Three sources, none of which needs a guess: motion that has settled, from several starts; near-returns of motion that has not settled,
//! which Newton's method takes to unstable orbits; and the crossings of that frequency by the branch of any orbit found within the range.

use hammerbeam_motion::{Stretch, System};

use crate::{
    BranchWalk, OrbitError, OrbitSettings, PeriodicSolution, Response, Side,
    solve::{integrator, state_scale},
    start::{STARTS, attempt, find_start, simulate, starting_states},
};

/// Periods after which a motion is taken as settled or as never settling.
const SETTLING: usize = 256;
/// Periods searched for near-returns.
const RETURNS: usize = 160;
/// Near-returns tried per start.
const TRIED: usize = 8;
/// Steps of the branches followed are this many times longer than those of a run,
const COARSER: f64 = 4.0;
/// and end after so many solutions on either side.
const MOST_SOLUTIONS: usize = 5000;
/// Frequencies at which a start of the branch is looked for, as parts of the range.
const LADDER: [f64; 9] = [0.5, 0.25, 0.75, 0.125, 0.875, 0.375, 0.625, 0.0, 1.0];

/// Finds the orbits of minimal period `period_multiple` at `frequency_hz`: stable before unstable, then largest displacement first.
///
/// * `range_hz`: the frequencies within which branches are followed.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed; finding nothing is an empty list.
pub fn find_orbits(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> Result<Vec<PeriodicSolution>, OrbitError> {
    let mut search = Search {
        system,
        response,
        frequency_hz,
        period_multiple,
        settings,
        found: Vec::new(),
        followed: Vec::new(),
    };
    for start in starting_states(system, response, frequency_hz, STARTS, settings)? {
        search.search_motion(&start)?;
    }
    search.search_branches(range_hz)?;
    let mut found = search.found;
    found.sort_by(|x, y| {
        y.stable().cmp(&x.stable()).then(y.maxima.displacement.total_cmp(&x.maxima.displacement))
    });
    Ok(found)
}

/// Finds an orbit at a frequency where no motion settles on one: from an orbit at another frequency, along its branch.
///
/// # Errors
/// [`OrbitError::NoOrbit`] if no branch that was tried leads there.
pub fn reach_orbit(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
) -> Result<PeriodicSolution, OrbitError> {
    for factor in ELSEWHERE {
        let from = factor * frequency_hz;
        let Ok(start) = find_start(system, response, from, period_multiple, settings) else { continue };
        let (range, side) =
            if factor < 1.0 { ((from, frequency_hz), Side::Up) } else { ((frequency_hz, from), Side::Down) };
        let coarse = OrbitSettings {
            max_step_hz: (range.1 - range.0) / 1000.0,
            max_solutions: MOST_SOLUTIONS,
            ..*settings
        };
        let Ok(mut walk) = BranchWalk::new(system, response, &start, side, range, &coarse) else { continue };
        let mut rows = Vec::new();
        while let Ok(None) = walk.step_without_maxima(&mut rows) {}
        if let Some((reached, state)) = rows.pop()
            && reached == frequency_hz
            && let Some(solution) =
                attempt(system, response, &state, (frequency_hz, period_multiple), settings)?
        {
            return Ok(solution);
        }
    }
    Err(OrbitError::NoOrbit { frequency_hz, period_multiple, starts: ELSEWHERE.len() })
}

/// Frequencies from which [`reach_orbit`] tries to reach another one, relative to it.
const ELSEWHERE: [f64; 8] = [0.75, 0.5, 0.35, 0.25, 0.18, 1.3, 1.7, 2.5];

struct Search<'a> {
    system: &'a System,
    response: &'a Response,
    frequency_hz: f64,
    period_multiple: u32,
    settings: &'a OrbitSettings,
    found: Vec<PeriodicSolution>,
    /// Whether the branch of each orbit found has been followed.
    followed: Vec<bool>,
}

impl Search<'_> {
    /// Newton's method from `state`; the place of the orbit in the list, to which it is added if it is new.
    fn try_state(&mut self, state: &[f64]) -> Result<Option<usize>, OrbitError> {
        let orbit = (self.frequency_hz, self.period_multiple);
        let Some(solution) = attempt(self.system, self.response, state, orbit, self.settings)? else {
            return Ok(None);
        };
        let known = self.place(&solution)?;
        if known.is_none() {
            self.found.push(solution);
            self.followed.push(false);
        }
        Ok(known.or(Some(self.found.len() - 1)))
    }

    /// Where the orbit is in the list, perhaps from another excitation period on.
    fn place(&self, solution: &PeriodicSolution) -> Result<Option<usize>, OrbitError> {
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let scale = state_scale(self.system, &solution.nodes[0], self.frequency_hz);
        let mut state = solution.nodes[0].clone();
        for _ in 0..self.period_multiple {
            let same = |known: &PeriodicSolution| scale.distance(&known.nodes[0], &state) < 1e-6;
            if let Some(place) = self.found.iter().position(same) {
                return Ok(Some(place));
            }
            simulate(&mut integrator, &mut state, self.frequency_hz, 1)?;
        }
        Ok(None)
    }

    /// Where a motion settles, and its near-returns.
    fn search_motion(&mut self, start: &[f64]) -> Result<(), OrbitError> {
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let mut state = start.to_vec();
        if self.period_multiple == 1 {
            self.try_state(start)?;
        }
        if simulate(&mut integrator, &mut state, self.frequency_hz, SETTLING).is_err() {
            return Ok(());
        }
        let mut states = vec![state];
        let stretch = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: 1.0 };
        for k in 0..RETURNS {
            let Ok(next) = integrator.advance(&stretch, &states[k]) else { return Ok(()) };
            states.push(next);
        }
        let scale = state_scale(self.system, &states[0], self.frequency_hz);
        let lag = self.period_multiple as usize;
        let distance = |k: usize| scale.distance(&states[k + lag], &states[k]);
        let mut returns: Vec<(f64, usize)> = (0..states.len() - lag).map(|k| (distance(k), k)).collect();
        returns.sort_by(|x, y| x.0.total_cmp(&y.0));
        let tried = if returns[0].0 < 1e-6 { 1 } else { TRIED };
        for &(_, k) in returns.iter().take(tried) {
            self.try_state(&states[k])?;
        }
        Ok(())
    }

    /// Crossings of the frequency by the branches of all orbits found, those found on the way included.
    fn search_branches(&mut self, range_hz: (f64, f64)) -> Result<(), OrbitError> {
        if self.found.is_empty() {
            for start in self.start_elsewhere(range_hz) {
                self.follow(&start, range_hz)?;
            }
        }
        while let Some(next) = self.followed.iter().position(|followed| !followed) {
            self.followed[next] = true;
            let start = self.found[next].clone();
            self.follow(&start, range_hz)?;
        }
        Ok(())
    }

    fn follow(&mut self, start: &PeriodicSolution, range_hz: (f64, f64)) -> Result<(), OrbitError> {
        self.crossings(start, Side::Up, range_hz)?;
        self.crossings(start, Side::Down, range_hz)
    }

    fn start_elsewhere(&self, (low, high): (f64, f64)) -> Vec<PeriodicSolution> {
        let start = |part: &f64| {
            let frequency_hz = low + part * (high - low);
            find_start(self.system, self.response, frequency_hz, self.period_multiple, self.settings).ok()
        };
        LADDER.iter().find_map(start).into_iter().collect()
    }

    fn crossings(
        &mut self,
        start: &PeriodicSolution,
        side: Side,
        range_hz: (f64, f64),
    ) -> Result<(), OrbitError> {
        let range = (range_hz.0.min(self.frequency_hz), range_hz.1.max(self.frequency_hz));
        // Crossings are corrected once found: the walk itself may be coarse, and is bounded.
        let settings = OrbitSettings {
            max_step_hz: COARSER * self.settings.max_step_hz,
            max_solutions: self.settings.max_solutions.min(MOST_SOLUTIONS),
            locates_stability_changes: false,
            ..*self.settings
        };
        let Ok(mut walk) = BranchWalk::new(self.system, self.response, start, side, range, &settings) else {
            return Ok(());
        };
        let mut rows = Vec::new();
        let mut before = (start.frequency_hz, start.nodes[0].clone());
        while let Ok(None) = walk.step_without_maxima(&mut rows) {
            let Some((frequency, state)) = rows.pop() else { continue };
            let (from, to) = (before.0 - self.frequency_hz, frequency - self.frequency_hz);
            if from * to <= 0.0 && from != to {
                let share = from / (from - to);
                let guess: Vec<f64> = before.1.iter().zip(&state).map(|(a, b)| a + share * (b - a)).collect();
                if let Some(place) = self.try_state(&guess)? {
                    self.followed[place] = true;
                }
            }
            before = (frequency, state);
        }
        Ok(())
    }
}
