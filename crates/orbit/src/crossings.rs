//! Where branches cross a frequency.
//!
//! A branch is followed to both sides with steps that are as coarse as corrector and contacts allow. Where it
//! passes the frequency, Newton's method begins between the two solutions. On a branch whose doubled period
//! is wanted the flips are located, and the branch that leaves there is followed as well: to one side only,
//! since the other one holds the same orbits half a period later.

use std::collections::VecDeque;

use crate::{
    BranchWalk, Crossing, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Side, StopReason,
    catalogue::Catalogue, walk::Walked,
};

/// Steps of the branches followed are this many times longer than in a run; corrector and contacts shorten
/// them where needed.
const COARSER: f64 = 20.0;
/// Solutions on one side of a branch, at most
const MOST_ON_A_SIDE: usize = 5000;
/// and at least, as long as there are any left.
const LEAST_ON_A_SIDE: usize = 250;

/// Operations on all branches of a search, as a walk counts them: some minutes.
const MOST_OPERATIONS: u64 = 100_000_000_000;

/// Branches that are followed, and what may be spent on them.
#[derive(Debug)]
pub(crate) struct Branches {
    pub range_hz: (f64, f64),
    pub solutions_left: usize,
    pub solutions_spent: usize,
    /// Operations spent on walks that have ended.
    operations: u64,
    /// Flips that have not been left yet.
    flips: VecDeque<Crossing>,
    /// What could not be followed, or not to its end.
    pub incomplete: Option<OrbitError>,
}

impl Branches {
    pub fn new(range_hz: (f64, f64), solutions_left: usize) -> Self {
        Self {
            range_hz,
            solutions_left,
            solutions_spent: 0,
            operations: 0,
            flips: VecDeque::new(),
            incomplete: None,
        }
    }

    /// Follows the branches of all orbits of this period, of those found on the way too, and leaves the flips
    /// at which it is reached.
    pub fn follow_all(
        &mut self,
        catalogue: &mut Catalogue<'_>,
        period_multiple: u32,
        doubles: bool,
        interrupted: Interruption<'_>,
    ) -> Result<(), OrbitError> {
        loop {
            let wanted =
                |k: &crate::catalogue::Known| !k.followed && k.solution.period_multiple == period_multiple;
            let start = catalogue.known.iter().position(wanted);
            if let Some(place) = start {
                catalogue.known[place].followed = true;
                let start = catalogue.known[place].solution.clone();
                self.follow(catalogue, &start, doubles, &mut *interrupted)?;
            } else if let Some(at) =
                self.flips.iter().position(|f| f.orbit.period_multiple * f.factor == period_multiple)
            {
                let flip = self.flips.remove(at).expect("it is in the list");
                self.leave(catalogue, &flip, doubles, &mut *interrupted)?;
            } else {
                return Ok(());
            }
        }
    }

    /// Follows the branch of an orbit, at this frequency or another one, to both sides.
    pub fn follow(
        &mut self,
        catalogue: &mut Catalogue<'_>,
        start: &PeriodicSolution,
        doubles: bool,
        interrupted: Interruption<'_>,
    ) -> Result<(), OrbitError> {
        for side in [Side::Up, Side::Down] {
            let settings = self.settings(catalogue, start.period_multiple, doubles);
            let (system, response) = (catalogue.system, catalogue.response);
            let walk = BranchWalk::new(system, response, start, side, self.range_hz, &settings);
            let before = Walked::of(start);
            self.walk(catalogue, walk, before, doubles, &mut *interrupted)?;
        }
        Ok(())
    }

    /// Follows the branch of doubled period from a flip.
    fn leave(
        &mut self,
        catalogue: &mut Catalogue<'_>,
        flip: &Crossing,
        doubles: bool,
        interrupted: Interruption<'_>,
    ) -> Result<(), OrbitError> {
        let settings = self.settings(catalogue, flip.orbit.period_multiple * flip.factor, doubles);
        let (system, response) = (catalogue.system, catalogue.response);
        let walk = BranchWalk::from_crossing(system, response, flip, Side::Up, self.range_hz, &settings);
        let before = Walked::of(&flip.orbit);
        self.walk(catalogue, walk, before, doubles, interrupted)
    }

    /// Settings of the next walk: what is left is shared among the branches that are still to be followed.
    fn settings(&self, catalogue: &Catalogue<'_>, period_multiple: u32, doubles: bool) -> OrbitSettings {
        let open = catalogue
            .known
            .iter()
            .filter(|k| !k.followed && k.solution.period_multiple == period_multiple)
            .count();
        let share = self.solutions_left / (open + 1);
        OrbitSettings {
            max_step: COARSER * catalogue.settings.max_step,
            max_solutions: share.clamp(LEAST_ON_A_SIDE, MOST_ON_A_SIDE).min(self.solutions_left),
            locates_stability_changes: doubles,
            ..*catalogue.settings
        }
    }

    fn walk(
        &mut self,
        catalogue: &mut Catalogue<'_>,
        walk: Result<BranchWalk, OrbitError>,
        mut before: Walked,
        doubles: bool,
        interrupted: Interruption<'_>,
    ) -> Result<(), OrbitError> {
        let mut walk = match walk {
            Ok(walk) => walk,
            // A start at a fold, one that leaves the range at once, or nothing beside a flip.
            Err(OrbitError::Path(_) | OrbitError::NoCrossing { .. }) => return Ok(()),
            Err(error) => return self.note_unsearched(error),
        };
        let multiple = walk.period_multiple();
        let target = catalogue.frequency_hz;
        let mut rows = Vec::new();
        loop {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            let spent = self.operations + walk.operations();
            let ended = if spent > MOST_OPERATIONS {
                Ok(Some(StopReason::Budget { solutions: self.solutions_spent }))
            } else {
                walk.step_without_maxima(&mut rows)
            };
            match ended {
                Ok(None) => {}
                Ok(Some(reason)) => {
                    self.operations = spent;
                    return self.end_of_walk(&walk, &reason, target);
                }
                Err(error) => return self.note_unsearched(error),
            }
            let Some(after) = rows.pop() else { continue };
            self.solutions_left = self.solutions_left.saturating_sub(1);
            self.solutions_spent += 1;
            if doubles && let Some(flip) = walk.flip_here()? {
                self.flips.push_back(flip);
            }
            let (from, to) = (before.frequency_hz - target, after.frequency_hz - target);
            if from != 0.0 && from * to <= 0.0 {
                cross(catalogue, (&before, &after), from / (from - to), multiple)?;
            }
            before = after;
        }
    }

    /// Notes that something could not be searched; other failures end the search.
    pub fn note_unsearched(&mut self, error: OrbitError) -> Result<(), OrbitError> {
        match error {
            OrbitError::Motion(_)
            | OrbitError::NeverOpens { .. }
            | OrbitError::SearchBudget { .. }
            | OrbitError::SearchTrials { .. }
            | OrbitError::Eigenvalues(_) => {
                self.incomplete.get_or_insert(error);
                Ok(())
            }
            error => Err(error),
        }
    }

    /// What the end of a walk means for the search.
    fn end_of_walk(
        &mut self,
        walk: &BranchWalk,
        reason: &StopReason,
        frequency_hz: f64,
    ) -> Result<(), OrbitError> {
        match reason {
            StopReason::Motion { .. } => {
                walk.motion_failure().map_or(Ok(()), |error| self.note_unsearched(error))
            }
            StopReason::Budget { .. } | StopReason::TooMuchWork { .. } => {
                let solutions = self.solutions_spent;
                self.note_unsearched(OrbitError::SearchBudget { frequency_hz, solutions })
            }
            _ => Ok(()),
        }
    }
}

/// Corrects the orbit at a share of the way between two solutions; its branch then counts as followed if it
/// is near them.
fn cross(
    catalogue: &mut Catalogue<'_>,
    (before, after): (&Walked, &Walked),
    share: f64,
    period_multiple: u32,
) -> Result<(), OrbitError> {
    let between = |(a, b): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
    };
    // Just cut anew, or left at a flip, the orbit before has fewer nodes or another phase.
    let phase = after.phase;
    let alike = before.nodes.len() == after.nodes.len() && before.phase == phase;
    let guess: Vec<Vec<f64>> = if alike {
        before.nodes.iter().zip(&after.nodes).map(between).collect()
    } else {
        after.nodes.clone()
    };
    let found = match catalogue.probe((phase, &guess), period_multiple)? {
        Some(found) => Some(found),
        // The motion from the first node may be a better guess than nodes on a chord.
        None => catalogue.probe((phase, &guess[..1]), period_multiple)?,
    };
    let Some(found) = found else { return Ok(()) };
    let scale = catalogue.scale(&guess[0]);
    let known = &mut catalogue.known[found.place];
    let near = before.phase == phase
        && known.solution.phase == phase
        && scale.distance(&known.solution.nodes[0], &guess[0])
            <= scale.distance(&before.nodes[0], &after.nodes[0]);
    known.followed |= near && known.solution.period_multiple == period_multiple;
    Ok(())
}
