//! The numerics of the orbit crate, as a run needs them.

mod places;

use hammerbeam_orbit::{
    BranchWalk, Crossing, FoundOrbits, Interruption, Matcher, OrbitError, OrbitSettings, PathError,
    PeriodicSolution, ProbeStarts, Response, Segments, Side, SurveyEffort, SurveyedMotions, TrialEffort,
    Wanted, find_orbits, find_start_unless, free_vibration, newton_trials, probe, reach_orbit, settled_orbit,
    survey,
};
use hammerbeam_results::{end::BranchEnd, row::SolvedRow};
use hammerbeam_study::{
    Model,
    file::{self, Study},
};

use crate::{
    run::{BranchOrigin, OrbitMatcher, Solver, Surveyed, Walk},
    settled::SettledState,
};

/// Frequencies in the part of the range of a survey at which Newton's method is tried.
const TRIED_IN_A_PART: u32 = 8;
/// Places in the range that have random numbers of their own.
const PLACES: f64 = 1_048_576.0;

/// Motions of a search at a single frequency.
const PROBE: ProbeStarts<'_> = ProbeStarts { about_linear: 4, on_backbones: 3, known: &[], unsettled: &[] };
/// Motions from large amplitudes that a survey begins besides.
const FAR: ProbeStarts<'_> = ProbeStarts { about_linear: 0, on_backbones: 4, known: &[], unsettled: &[] };

/// Periodic solutions of one model and their branches.
#[derive(Debug)]
pub struct OrbitSolver<'m> {
    model: &'m Model,
    range_hz: (f64, f64),
    settings: OrbitSettings,
    budget: usize,
    effort: SurveyEffort,
    /// Period multiples that are looked for.
    multiples: Vec<u32>,
    /// Distance of the frequencies at which all orbits are looked for [Hz].
    spacing_hz: f64,
    /// Trials of Newton's method without a new harmonic solution.
    trials: usize,
}

impl<'m> OrbitSolver<'m> {
    /// For a study and its model.
    #[must_use]
    pub fn new(model: &'m Model, study: &Study) -> Self {
        let [low, high] = study.excitation.range_hz();
        let unstable_starts = study.search.unstable_starts;
        let wanted = if unstable_starts { Wanted::Any } else { Wanted::StableNearby };
        Self {
            model,
            range_hz: (low, high),
            settings: settings(&study.continuation),
            budget: study.continuation.budget_solutions,
            effort: effort(&study.search, wanted),
            multiples: study.response.period_multiples.clone(),
            spacing_hz: (high - low) / f64::from(study.search.frequencies.max(1)),
            trials: if unstable_starts { study.search.trials as usize } else { 0 },
        }
    }

    /// All periodic solutions of minimal period `period_multiple` that are found at a frequency: stable ones
    /// first, then the largest maximum displacement.
    ///
    /// * `interrupted`: asked now and then; the search ends with an error when it says true.
    ///
    /// # Errors
    /// Why the search failed, in words.
    pub fn find_orbits(
        &self,
        frequency_hz: f64,
        period_multiple: u32,
        interrupted: Interruption<'_>,
    ) -> Result<FoundOrbits, String> {
        let orbit = (frequency_hz, period_multiple);
        let settings = OrbitSettings { max_solutions: self.budget, ..self.settings };
        find_orbits(&self.model.system, self.response(), orbit, self.range_hz, &settings, interrupted)
            .map_err(|error| error.to_string())
    }

    /// The periodic solutions on which motions move that have settled; those that Newton's method does not
    /// find are left out.
    #[must_use]
    pub fn settled(&self, motions: &[SettledState]) -> Vec<PeriodicSolution> {
        motions.iter().filter_map(|motion| self.orbit_at(motion)).filter(PeriodicSolution::stable).collect()
    }

    /// The periodic solution, stable or not, that is found from the first of these states that leads to one.
    #[must_use]
    pub fn near(&self, motions: &[SettledState]) -> Vec<PeriodicSolution> {
        motions.iter().find_map(|motion| self.orbit_at(motion)).into_iter().collect()
    }

    /// The periodic solution that Newton's method finds from a state; none outside of the range, and of
    /// another structure.
    fn orbit_at(&self, motion: &SettledState) -> Option<PeriodicSolution> {
        let [low, high] = [self.range_hz.0, self.range_hz.1];
        let fits =
            motion.state.len() == 2 * self.model.system.dof() && (low..=high).contains(&motion.frequency_hz);
        let orbit = (motion.frequency_hz, motion.period_multiple);
        let found =
            || settled_orbit(&self.model.system, self.response(), &motion.state, orbit, &self.settings);
        fits.then(found)?.ok()?
    }

    /// Stable solutions of large amplitude besides those of a survey; motions that cannot be computed are no
    /// reason to give up what was found.
    fn far(
        &self,
        orbit: (f64, &[u32]),
        surveyed: &SurveyedMotions,
        interrupted: Interruption<'_>,
    ) -> Result<FoundOrbits, String> {
        let (known, unsettled) = (&surveyed.found.orbits, &surveyed.unsettled);
        let starts = (ProbeStarts { known, unsettled, ..FAR }, &self.effort);
        match probe(&self.model.system, self.response(), orbit, starts, &self.settings, interrupted) {
            Err(OrbitError::Interrupted) => Err(OrbitError::Interrupted.to_string()),
            Err(error) => Ok(FoundOrbits { orbits: Vec::new(), incomplete: Some(error) }),
            Ok(found) => Ok(found),
        }
    }

    /// Trials of Newton's method at a frequency. Their random numbers follow from its place in the range,
    /// whatever the unit of time.
    fn trials_at(&self, frequency_hz: f64) -> TrialEffort {
        let (low, high) = self.range_hz;
        let place = PLACES * (frequency_hz - low) / (high - low);
        TrialEffort { trials: self.trials, seed: place.round() as u64 }
    }

    /// What a search gives to begin branches at: no orbits that are of one frequency alone, since free
    /// vibrations may be added to them. Branches pass them.
    fn surveyed(&self, FoundOrbits { mut orbits, incomplete }: FoundOrbits) -> Surveyed {
        orbits.retain(|orbit| free_vibration(&self.model.system, orbit).is_none());
        let incomplete = incomplete.map(|error| format!("the search is not complete: {error}"));
        Surveyed { solutions: orbits, incomplete }
    }

    fn response(&self) -> &Response {
        &self.model.response
    }
}

/// Closest tolerance of a contact step: rounding leaves a few times 1e-15 of the force open.
const CLOSEST_MOTION: f64 = 1e-13;

/// Settings of the orbit crate from those of a study.
///
/// A motion is computed twenty times as closely as its orbit is asked for, down to where rounding decides,
/// and never worse than by default.
pub(crate) fn settings(continuation: &file::ContinuationTable) -> OrbitSettings {
    let usual = OrbitSettings::default();
    OrbitSettings {
        max_step: continuation.max_step_hz,
        tolerance: continuation.tolerance,
        motion_tolerance: (0.05 * continuation.tolerance).clamp(CLOSEST_MOTION, usual.motion_tolerance),
        segments: match continuation.segments {
            file::SegmentChoice::Auto => Segments::Automatic,
            file::SegmentChoice::Given(count) => Segments::Fixed(count as usize),
        },
        // The run itself keeps the budget of a walk, so that it can be raised later.
        max_solutions: usize::MAX,
        ..usual
    }
}

/// The effort of the surveys of a study.
pub(crate) fn effort(search: &file::Search, wanted: Wanted) -> SurveyEffort {
    SurveyEffort {
        starts: search.starts as usize,
        settling: search.settling_periods as usize,
        wanted,
        ..SurveyEffort::default()
    }
}

/// Why a walk does not begin.
fn why_not_begun(error: OrbitError) -> String {
    match error {
        OrbitError::Path(PathError::Start { parameter, cause }) => format!(
            "the motion at {parameter} Hz was not found again to the tolerance of a branch; mostly a contact \
            is so hard that rounding hides its penetration ({cause})"
        ),
        error => error.to_string(),
    }
}

impl Solver for OrbitSolver<'_> {
    fn find_harmonic(
        &self,
        frequency_hz: f64,
        interrupted: Interruption<'_>,
    ) -> Result<PeriodicSolution, String> {
        let (system, response) = (&self.model.system, self.response());
        let orbit = (frequency_hz, 1);
        let found = find_start_unless(system, response, orbit, &self.settings, &mut *interrupted);
        // A harmonic branch passes every frequency; where it is unstable it is reached from elsewhere.
        let found = match found {
            Err(OrbitError::NoOrbit { .. }) => {
                reach_orbit(system, response, orbit, &self.settings, interrupted)
            }
            found => found,
        };
        let found = found.map_err(|error| error.to_string())?;
        free_vibration(system, &found).map_or(Ok(found), |error| Err(error.to_string()))
    }

    fn survey(
        &self,
        frequency_hz: f64,
        width_hz: f64,
        multiples: &[u32],
        interrupted: Interruption<'_>,
    ) -> Result<Surveyed, String> {
        let (system, response, settings) = (&self.model.system, self.response(), &self.settings);
        let found =
            survey(system, response, frequency_hz, multiples, &self.effort, settings, &mut *interrupted)
                .map_err(|error| error.to_string())?;
        let far = self.far((frequency_hz, multiples), &found, &mut *interrupted)?;
        let FoundOrbits { orbits: mut found, mut incomplete } = found.found;
        if self.trials > 0 {
            for part in 0..TRIED_IN_A_PART {
                let place = (f64::from(part) + 0.5) / f64::from(TRIED_IN_A_PART) - 0.5;
                let at_hz = frequency_hz + place * width_hz;
                let (orbit, effort) = ((at_hz, multiples), self.trials_at(at_hz));
                let tried = newton_trials(system, response, orbit, effort, settings, &mut *interrupted);
                let tried = tried.map_err(|error| error.to_string())?;
                found.extend(tried.orbits);
                incomplete = incomplete.or(tried.incomplete);
            }
        }
        found.extend(far.orbits);
        incomplete = incomplete.or(far.incomplete);
        Ok(self.surveyed(FoundOrbits { orbits: found, incomplete }))
    }

    fn resonances_hz(&self) -> Vec<f64> {
        let surveyed = places::Surveyed { range_hz: self.range_hz, spacing_hz: self.spacing_hz };
        places::resonances_hz(self.model, self.response(), &surveyed, &self.multiples, &self.settings)
    }

    fn probe(
        &self,
        frequency_hz: f64,
        multiples: &[u32],
        interrupted: Interruption<'_>,
    ) -> Result<Surveyed, String> {
        let (system, response, orbit) = (&self.model.system, self.response(), (frequency_hz, multiples));
        let found = probe(system, response, orbit, (PROBE, &self.effort), &self.settings, interrupted);
        found.map(|found| self.surveyed(found)).map_err(|error| error.to_string())
    }

    fn root(&self, crossing: &Crossing) -> Result<PeriodicSolution, String> {
        let root = crossing.root(&self.model.system, self.response(), &self.settings);
        root.map_err(|error| error.to_string())
    }

    fn begin<'a>(&'a self, origin: &BranchOrigin, side: Side) -> Result<Box<dyn Walk + 'a>, String> {
        let (system, range_hz) = (&self.model.system, self.range_hz);
        let walk = match origin {
            BranchOrigin::Found(start) => {
                BranchWalk::new(system, self.response(), start, side, range_hz, &self.settings)
            }
            BranchOrigin::Crossing(crossing) => {
                BranchWalk::from_crossing(system, self.response(), crossing, side, range_hz, &self.settings)
            }
        };
        Ok(Box::new(walk.map_err(why_not_begun)?))
    }

    fn resume<'a>(&'a self, checkpoint: &[u8], journal: &[u8]) -> Result<Box<dyn Walk + 'a>, String> {
        let stored = (checkpoint, journal);
        let walk =
            BranchWalk::resume(&self.model.system, self.response(), stored, self.range_hz, &self.settings);
        Ok(Box::new(walk.map_err(|error| error.to_string())?))
    }

    fn matcher<'a>(&'a self, solution: &'a PeriodicSolution) -> Result<Box<dyn OrbitMatcher + 'a>, String> {
        let matcher = Matcher::new(&self.model.system, self.response(), solution, &self.settings);
        Ok(Box::new(matcher.map_err(|error| error.to_string())?))
    }
}

impl OrbitMatcher for Matcher<'_> {
    fn distance(&self, state: (f64, &[f64])) -> f64 {
        self.distance(state)
    }

    fn is_near(&self, guess: (f64, &[f64])) -> bool {
        self.is_near(guess)
    }
}

impl Walk for BranchWalk {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        let mut found = Vec::new();
        let reason = self.step(&mut found).map_err(|error| error.to_string());
        rows.extend(found.into_iter().map(SolvedRow::from));
        Ok(reason?.map(BranchEnd::from))
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        Some(self.checkpoint())
    }

    fn take_journal(&mut self) -> Vec<u8> {
        self.take_journal()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion_tolerance_at(tolerance: f64) -> f64 {
        let continuation = file::ContinuationTable {
            max_step_hz: 0.01,
            tolerance,
            segments: file::SegmentChoice::Auto,
            budget_solutions: 1,
            budget_time_s: None,
        };
        settings(&continuation).motion_tolerance
    }

    #[test]
    fn motion_is_computed_twenty_times_as_closely_as_its_orbit_is_asked_for() {
        assert!((motion_tolerance_at(1e-11) / 5e-13 - 1.0).abs() < 1e-12);
        assert_eq!(motion_tolerance_at(1e-13), CLOSEST_MOTION);
    }

    #[test]
    fn loose_and_default_tolerances_leave_the_motion_as_it_is() {
        let usual = OrbitSettings::default();
        for tolerance in [usual.tolerance, 1e-4] {
            assert_eq!(motion_tolerance_at(tolerance).to_bits(), usual.motion_tolerance.to_bits());
        }
    }
}
