//! All orbits that can be found at one frequency.
//!
//! Three sources, none of which needs a guess, the cheap ones first: motion that has settled, from several starts; near-returns of motion that has not settled,
//! which Newton's method takes to unstable orbits; and the crossings of that frequency by the branch of any orbit found within the range.
//! If nothing is found at the frequency itself, motions are followed there for longer, then branches are begun elsewhere in the range.
//!
//! The work is bounded: motion ends where it has settled, and the branches may take [`MOST_SOLUTIONS`] together. A search that was bounded by that, or by motion that
//! could not be computed, says so.

use hammerbeam_motion::{Stretch, System};

use crate::{
    BranchWalk, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response, Side, StopReason,
    find_start_unless,
    solve::{integrator, state_scale},
    start::{
        Effort, SETTLED, STARTS, attempt, attempt_nodes, check_multiple, search_start, simulate,
        starting_states,
    },
    survey::nearest_returns,
};

/// Periods after which a motion is taken as settled or as never settling,
const SETTLING: usize = 256;
/// looked at so often.
const LOOKS: usize = 8;
/// Periods searched for near-returns.
const RETURNS: usize = 160;
/// Near-returns tried per start.
const TRIED: usize = 8;
/// Steps of the branches followed are this many times longer than those of a run; corrector and contacts shorten them where needed.
const COARSER: f64 = 20.0;
/// Solutions on one side of a branch,
const MOST_ON_A_SIDE: usize = 5000;
/// and on all branches of a search.
const MOST_SOLUTIONS: usize = 20_000;
/// Frequencies at which a start of the branch is looked for, as parts of the range.
const LADDER: [f64; 9] = [0.5, 0.25, 0.75, 0.125, 0.875, 0.375, 0.625, 0.0, 1.0];
/// Motion spent at each of them.
const ELSEWHERE_EFFORT: Effort = Effort { starts: 3, attempts: 3 };
/// Frequencies from which [`reach_orbit`] tries to reach another one, relative to it.
const ELSEWHERE: [f64; 8] = [0.75, 0.5, 0.35, 0.25, 0.18, 1.3, 1.7, 2.5];

/// What a search has found.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundOrbits {
    /// The orbits: stable before unstable, then largest displacement first.
    pub orbits: Vec<PeriodicSolution>,
    /// What kept the search from looking everywhere it meant to look: motion that could not be computed, or its bound.
    pub incomplete: Option<OrbitError>,
}

/// Finds the orbits of minimal period `period_multiple` at `frequency_hz`.
///
/// * `range_hz`: the frequencies within which branches are followed.
///
/// # Errors
/// [`OrbitError::Interrupted`]; [`OrbitError::PeriodMultiple`] unless the multiple is from 1 to 64; [`OrbitError::Motion`] if not even the integrator can be made.
/// Finding nothing is an empty list.
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
    let orbit = (frequency_hz, period_multiple);
    let solutions_left = MOST_SOLUTIONS.min(settings.max_solutions);
    let (found, followed, incomplete) = (Vec::new(), Vec::new(), None);
    let mut search = Search {
        system,
        response,
        orbit,
        range_hz,
        settings,
        interrupted,
        found,
        followed,
        solutions_left,
        incomplete,
    };
    for start in starting_states(system, response, frequency_hz, STARTS, settings)? {
        let searched = search.search_motion(&start);
        search.heed(searched)?;
    }
    search.search_branches()?;
    let (mut orbits, incomplete) = (search.found, search.incomplete);
    orbits.sort_by(|x, y| {
        y.stable().cmp(&x.stable()).then(y.maxima.displacement.total_cmp(&x.maxima.displacement))
    });
    Ok(FoundOrbits { orbits, incomplete })
}

/// Finds an orbit at a frequency where no motion settles on one: from an orbit at another frequency, along its branch.
///
/// # Errors
/// [`OrbitError::NoOrbit`] if no branch that was tried leads there, [`OrbitError::Motion`] if none does and some motion could not be computed,
/// [`OrbitError::Interrupted`].
pub fn reach_orbit(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<PeriodicSolution, OrbitError> {
    let mut failure = OrbitError::NoOrbit { frequency_hz, period_multiple, starts: ELSEWHERE.len() };
    for factor in ELSEWHERE {
        let from = factor * frequency_hz;
        let start =
            match find_start_unless(system, response, (from, period_multiple), settings, &mut *interrupted) {
                Ok(start) => start,
                Err(OrbitError::NoOrbit { .. }) => continue,
                Err(error @ OrbitError::Motion(_)) => {
                    failure = error;
                    continue;
                }
                Err(error) => return Err(error),
            };
        let (range, side) =
            if factor < 1.0 { ((from, frequency_hz), Side::Up) } else { ((frequency_hz, from), Side::Down) };
        let coarse = OrbitSettings {
            max_step_hz: (range.1 - range.0) / 1000.0,
            max_solutions: MOST_ON_A_SIDE,
            locates_stability_changes: false,
            ..*settings
        };
        let mut walk = match BranchWalk::new(system, response, &start, side, range, &coarse) {
            Ok(walk) => walk,
            Err(OrbitError::Path(_)) => continue,
            Err(error) => return Err(error),
        };
        let mut reached = Vec::new();
        while walk.step_without_maxima(&mut reached)?.is_none() {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            reached.drain(..reached.len() - 1);
        }
        if let Some((reached_hz, nodes)) = reached.pop()
            && reached_hz == frequency_hz
            && let Some(solution) =
                attempt_nodes(system, response, &nodes, (frequency_hz, period_multiple), settings)?
        {
            return Ok(solution);
        }
    }
    Err(failure)
}

struct Search<'a> {
    system: &'a System,
    response: &'a Response,
    /// Frequency [Hz] and period multiple.
    orbit: (f64, u32),
    range_hz: (f64, f64),
    settings: &'a OrbitSettings,
    interrupted: Interruption<'a>,
    found: Vec<PeriodicSolution>,
    /// Whether the branch of each orbit found has been followed.
    followed: Vec<bool>,
    solutions_left: usize,
    incomplete: Option<OrbitError>,
}

impl Search<'_> {
    /// Keeps in mind that something could not be searched; other failures end the search.
    fn heed<T>(&mut self, result: Result<T, OrbitError>) -> Result<Option<T>, OrbitError> {
        match result {
            Ok(value) => Ok(Some(value)),
            Err(error @ (OrbitError::Motion(_) | OrbitError::SearchBudget { .. })) => {
                self.incomplete.get_or_insert(error);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    fn check_interrupted(&mut self) -> Result<(), OrbitError> {
        if (self.interrupted)() { Err(OrbitError::Interrupted) } else { Ok(()) }
    }

    fn try_state(&mut self, state: &[f64]) -> Result<Option<usize>, OrbitError> {
        let solution = attempt(self.system, self.response, state, self.orbit, self.settings)?;
        solution.map(|solution| self.enter(solution)).transpose()
    }

    /// The place of the orbit in the list, to which it is added if it is new.
    fn enter(&mut self, solution: PeriodicSolution) -> Result<usize, OrbitError> {
        if let Some(known) = self.place(&solution)? {
            return Ok(known);
        }
        self.found.push(solution);
        self.followed.push(false);
        Ok(self.found.len() - 1)
    }

    /// Where the orbit is in the list, perhaps from another excitation period on.
    fn place(&self, solution: &PeriodicSolution) -> Result<Option<usize>, OrbitError> {
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let scale = state_scale(self.system, &solution.nodes[0], self.orbit.0);
        let mut state = solution.nodes[0].clone();
        for _ in 0..self.orbit.1 {
            let same = |known: &PeriodicSolution| scale.distance(&known.nodes[0], &state) < 1e-6;
            if let Some(place) = self.found.iter().position(same) {
                return Ok(Some(place));
            }
            simulate(&mut integrator, &mut state, self.orbit.0, 1)?;
        }
        Ok(None)
    }

    /// Where a motion settles, and its near-returns.
    fn search_motion(&mut self, start: &[f64]) -> Result<(), OrbitError> {
        let (frequency_hz, lag) = (self.orbit.0, self.orbit.1 as usize);
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let mut state = start.to_vec();
        if lag == 1 {
            self.try_state(start)?;
        }
        for _ in 0..LOOKS {
            self.check_interrupted()?;
            simulate(&mut integrator, &mut state, frequency_hz, SETTLING / LOOKS)?;
            let mut later = state.clone();
            simulate(&mut integrator, &mut later, frequency_hz, lag)?;
            if state_scale(self.system, &state, frequency_hz).distance(&state, &later) < SETTLED {
                self.try_state(&later)?;
                return Ok(());
            }
        }
        let mut states = vec![state];
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        for k in 0..RETURNS {
            states.push(integrator.advance(&stretch, &states[k])?);
        }
        self.search_returns(&states)
    }

    /// Newton's method from the closest returns of a motion, one state per excitation period.
    fn search_returns(&mut self, states: &[Vec<f64>]) -> Result<(), OrbitError> {
        let lag = self.orbit.1 as usize;
        let scale = state_scale(self.system, &states[0], self.orbit.0);
        for nodes in nearest_returns(states, &scale, lag, TRIED) {
            self.check_interrupted()?;
            // Newton's method from all states and from the first one alone go different ways; either may arrive.
            let found = attempt_nodes(self.system, self.response, nodes, self.orbit, self.settings)?;
            found.map(|solution| self.enter(solution)).transpose()?;
            if lag > 1 {
                self.try_state(&nodes[0])?;
            }
        }
        Ok(())
    }

    /// Crossings of the frequency by the branches of all orbits found, those found on the way included.
    fn search_branches(&mut self) -> Result<(), OrbitError> {
        if self.found.is_empty()
            && let Some(start) = self.start_elsewhere()?
        {
            self.follow(&start)?;
        }
        while let Some(next) = self.followed.iter().position(|followed| !followed) {
            self.followed[next] = true;
            let start = self.found[next].clone();
            self.follow(&start)?;
        }
        Ok(())
    }

    fn follow(&mut self, start: &PeriodicSolution) -> Result<(), OrbitError> {
        for side in [Side::Up, Side::Down] {
            let crossed = self.crossings(start, side);
            self.heed(crossed)?;
        }
        Ok(())
    }

    /// An orbit where a branch can begin: by a longer look at the frequency itself, then at others.
    fn start_elsewhere(&mut self) -> Result<Option<PeriodicSolution>, OrbitError> {
        let (low, high) = self.range_hz;
        let (system, response) = (self.system, self.response);
        let here = std::iter::once((self.orbit.0, Effort::FULL));
        let elsewhere = LADDER.iter().map(|part| (low + part * (high - low), ELSEWHERE_EFFORT));
        for (frequency_hz, effort) in here.chain(elsewhere) {
            let orbit = (frequency_hz, self.orbit.1);
            let start = search_start(system, response, orbit, effort, self.settings, &mut *self.interrupted);
            match start {
                Err(OrbitError::NoOrbit { .. }) => {}
                start => {
                    if let Some(start) = self.heed(start)? {
                        return Ok(Some(start));
                    }
                }
            }
        }
        Ok(None)
    }

    fn crossings(&mut self, start: &PeriodicSolution, side: Side) -> Result<(), OrbitError> {
        // Crossings are corrected once found: the walk itself may be coarse, and is bounded.
        let settings = OrbitSettings {
            max_step_hz: COARSER * self.settings.max_step_hz,
            max_solutions: self.solutions_left.min(MOST_ON_A_SIDE),
            locates_stability_changes: false,
            ..*self.settings
        };
        let (range_hz, target) = (self.range_hz, self.orbit.0);
        let mut walk = match BranchWalk::new(self.system, self.response, start, side, range_hz, &settings) {
            Ok(walk) => walk,
            // A start at a fold, or one that leaves the range at once.
            Err(OrbitError::Path(_)) => return Ok(()),
            Err(error) => return Err(error),
        };
        let mut rows = Vec::new();
        let mut before = (start.frequency_hz, start.nodes.clone());
        loop {
            self.check_interrupted()?;
            if let Some(reason) = walk.step_without_maxima(&mut rows)? {
                return self.end_of_walk(&walk, &reason);
            }
            let Some(after) = rows.pop() else { continue };
            self.solutions_left = self.solutions_left.saturating_sub(1);
            let (from, to) = (before.0 - target, after.0 - target);
            if from != 0.0 && from * to <= 0.0 {
                self.cross(&before.1, &after.1, from / (from - to))?;
            }
            before = after;
        }
    }

    /// Corrects the orbit at a share of the way between two solutions; its branch then counts as followed if it is near them.
    fn cross(&mut self, before: &[Vec<f64>], after: &[Vec<f64>], share: f64) -> Result<(), OrbitError> {
        let between = |(a, b): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
        };
        // Just cut anew, the orbit before has fewer nodes.
        let guess: Vec<Vec<f64>> = if before.len() == after.len() {
            before.iter().zip(after).map(between).collect()
        } else {
            after.to_vec()
        };
        let found = match attempt_nodes(self.system, self.response, &guess, self.orbit, self.settings)? {
            Some(solution) => Some(solution),
            // The motion from the first node may be a better guess than nodes on a chord.
            None => attempt(self.system, self.response, &guess[0], self.orbit, self.settings)?,
        };
        let Some(solution) = found else { return Ok(()) };
        let scale = state_scale(self.system, &solution.nodes[0], self.orbit.0);
        let near = scale.distance(&solution.nodes[0], &guess[0]) <= scale.distance(&before[0], &after[0]);
        let place = self.enter(solution)?;
        self.followed[place] |= near;
        Ok(())
    }

    /// What the end of a walk means for the search.
    fn end_of_walk(&self, walk: &BranchWalk, reason: &StopReason) -> Result<(), OrbitError> {
        match reason {
            StopReason::Motion { .. } => walk.motion_failure().map_or(Ok(()), Err),
            StopReason::Budget { .. } => {
                let frequency_hz = self.orbit.0;
                Err(OrbitError::SearchBudget {
                    frequency_hz,
                    solutions: MOST_SOLUTIONS - self.solutions_left,
                })
            }
            _ => Ok(()),
        }
    }
}
