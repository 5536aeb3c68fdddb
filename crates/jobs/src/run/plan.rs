//! What a run is to do: where it looks for branches first, and how far it goes.

use std::time::Duration;

use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::store::{JobKind, JobRecord};
use hammerbeam_study::file::Study;

/// What a run is to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Where harmonic branches are looked for one after the other, as long as none passes there [Hz].
    pub harmonic_hz: Vec<f64>,
    /// Where all orbits that simulation leads to are looked for [Hz].
    pub survey_hz: Vec<f64>,
    /// Stable solutions that are known from elsewhere, from which branches begin where none holds them.
    pub met: Vec<PeriodicSolution>,
    /// Range of the excitation frequency [Hz].
    pub range_hz: [f64; 2],
    /// Orbit periods over excitation period that are looked for.
    pub multiples: Vec<u32>,
    /// Period doublings that are followed from branches that were found by a search.
    pub depth: u32,
    /// Whether branches begin at unstable solutions and leave at their flips.
    pub unstable: bool,
    /// Largest number of solutions of a walk.
    pub budget: u64,
    /// Time after which no new piece of work is started.
    pub time: Option<Duration>,
    /// Solutions after which a walk that takes turns makes room for another one; what is computed does not
    /// depend on it.
    pub turn: u64,
}

/// Some seconds of the paper's beam: long beside what it costs to take a walk up again.
const TURN: u64 = 4096;

/// Frequencies, as parts of the range from its upper end, at which harmonic starts are sought one after the
/// other where no harmonic branch passes yet.
const HARMONIC: [f64; 9] = [0.0, 1.0, 0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875];

impl Plan {
    /// The plan of a study: harmonic branches that together span the range, and every branch that is met.
    #[must_use]
    pub fn of(study: &Study) -> Self {
        let [low, high] = study.excitation.range_hz();
        let at = |part: f64| (high + part * (low - high)).clamp(low, high);
        let harmonic = study.response.period_multiples.contains(&1);
        let count = study.search.frequencies;
        let middle = |index: u32| at((f64::from(index) + 0.5) / f64::from(count));
        Self {
            harmonic_hz: HARMONIC.iter().filter(|_| harmonic).map(|&part| at(part)).collect(),
            survey_hz: (0..count).map(middle).collect(),
            met: Vec::new(),
            range_hz: [low, high],
            multiples: study.response.period_multiples.clone(),
            depth: study.response.period_doubling_depth,
            unstable: study.search.unstable_starts,
            budget: study.continuation.budget_solutions as u64,
            time: study.continuation.budget_time_s.map(Duration::from_secs_f64),
            turn: TURN,
        }
    }

    /// Width of the part of the range that a survey looks at [Hz].
    pub(super) fn survey_width_hz(&self) -> f64 {
        (self.range_hz[1] - self.range_hz[0]) / self.survey_hz.len().max(1) as f64
    }

    /// The first jobs, in their order.
    ///
    /// * `resonances_hz`: where the linear system suggests to look; no more of them are looked at than the
    ///   survey has frequencies.
    pub(super) fn first_jobs(&self, resonances_hz: &[f64]) -> Vec<(JobKind, f64, Option<i64>, u32)> {
        let harmonic = self.harmonic_hz.iter().map(|&at| (JobKind::Harmonic, at, None, 0));
        let survey = self.survey_hz.iter().map(|&at| (JobKind::Survey, at, None, 0));
        let most = self.survey_hz.len();
        let resonance = resonances_hz.iter().take(most).map(|&at| (JobKind::Resonance, at, None, 0));
        harmonic.chain(survey).chain(resonance).collect()
    }

    /// Whether the branch that a job at a flip leads to is wanted.
    pub(super) fn wants_doubling(&self, period_multiple: u32, depth: u32) -> bool {
        let doubled = 2 * period_multiple;
        doubled <= 1024 && (depth < self.depth || self.multiples.contains(&doubled))
    }

    /// Whether a job has nothing to do when something covers its frequency already.
    pub(super) fn only_if_not_covered(job: &JobRecord) -> bool {
        job.kind == JobKind::Harmonic
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hammerbeam_study::StudyFile;

    fn plan(multiples: &str) -> Plan {
        let text = include_str!("../../../../studies/duffing.toml").replace("[0.08, 0.5]", "[19.0, 110.0]");
        let text = format!("{text}\n[response]\nperiod_multiples = {multiples}\n[search]\nfrequencies = 4\n");
        Plan::of(&StudyFile::parse("study.toml", text).expect("a study").study)
    }

    #[test]
    fn the_harmonic_branch_is_sought_at_the_upper_end_first() {
        assert_eq!(plan("[1]").harmonic_hz[..5], [110.0, 19.0, 64.5, 87.25, 41.75]);
        assert!(plan("[2, 3]").harmonic_hz.is_empty());
    }

    #[test]
    fn the_survey_looks_at_the_middles_of_equal_parts() {
        assert_eq!(plan("[1]").survey_hz, [98.625, 75.875, 53.125, 30.375]);
    }

    #[test]
    fn doublings_are_wanted_to_the_depth_or_if_their_multiple_is_asked_for() {
        let plan = Plan { depth: 1, ..plan("[1, 2, 3, 8]") };
        assert!(plan.wants_doubling(1, 0) && plan.wants_doubling(3, 0));
        assert!(plan.wants_doubling(1, 7) && plan.wants_doubling(4, 7), "2 and 8 are asked for");
        assert!(!plan.wants_doubling(2, 1) && !plan.wants_doubling(6, 1));
    }
}
