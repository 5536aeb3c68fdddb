//! What a run of a study answers: branches, events, orbits at some frequencies, and what its verification
//! says; lengths, times and forces in the units of another study, frequencies as parts of the range.

use std::path::Path;

use hammerbeam_jobs::{
    Observer, PreparedStudy, Progress, Quiet,
    verify::{VerifySettings, verify},
};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::{Store, export_csv};
use toml::Table;

use super::Units;
use crate::results::{BoxedError, Results};

/// How much a run may compute, and what of it is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Solutions after which a run is given up.
    pub solutions: u64,
    /// Solutions that are verified; `None` for all.
    pub verified: Option<u64>,
    /// Frequencies at which orbits are compared.
    pub frequencies: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { solutions: 1_000_000, verified: None, frequencies: 7 }
    }
}

/// Why there are no answers to compare.
#[derive(Debug, thiserror::Error)]
pub enum AnswersError {
    /// The run was given up.
    #[error("more than {0} solutions")]
    TooMany(u64),
    /// The study or its store is wrong.
    #[error(transparent)]
    Failed(#[from] BoxedError),
}

/// What a study answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// Period multiple of each branch, and the part of the range that it spans.
    pub branches: Vec<(u32, [f64; 2])>,
    /// Events of all branches.
    pub events: Vec<EventAnswer>,
    /// Orbits at each frequency, a part of the range.
    pub orbits: Vec<(f64, Vec<OrbitAnswer>)>,
    /// Solutions that are stored.
    pub solutions: u64,
    /// What their verification does not agree with.
    pub disagreements: Vec<String>,
}

/// A kind of event at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct EventAnswer {
    /// Of the branch.
    pub period_multiple: u32,
    /// One of the names in `events.csv`.
    pub kind: String,
    /// Part of the range.
    pub at: f64,
    /// Part of the range within which it is known.
    pub uncertainty: f64,
}

/// A periodic solution.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitAnswer {
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Maxima of displacement, velocity of impacts, and contact force.
    pub maxima: [f64; 3],
    /// Number of contacts.
    pub contacts: u32,
    /// Moduli of the multipliers, largest first.
    pub multipliers: Vec<f64>,
}

/// Gives a run up after so many solutions.
struct Limited {
    limit: u64,
    exceeded: bool,
}

impl Observer for Limited {
    fn progress(&mut self, progress: &Progress) {
        self.exceeded |= progress.new_solutions > self.limit;
    }

    fn interrupted(&mut self) -> bool {
        self.exceeded
    }
}

impl Answers {
    /// Runs a study into an empty folder.
    ///
    /// * `units`: those of the study; the answers are in SI units.
    ///
    /// # Errors
    /// [`AnswersError`].
    pub fn of(study: &Table, units: Units, limits: &Limits, folder: &Path) -> Result<Self, AnswersError> {
        let text = study.to_string();
        let mut observer = Limited { limit: limits.solutions, exceeded: false };
        let results = Results::of_watched_run(&text, folder, 1, &mut observer)?;
        if observer.exceeded {
            return Err(AnswersError::TooMany(limits.solutions));
        }
        let (solutions, disagreements) = verified(&results, folder, limits)?;
        Ok(Self {
            branches: branches(&results),
            events: events(&results, folder)?,
            orbits: orbits(&results, units, limits)?,
            solutions,
            disagreements,
        })
    }
}

/// The part of the range at which a frequency stands.
fn part([low, high]: [f64; 2], frequency_hz: f64) -> f64 {
    (frequency_hz - low) / (high - low)
}

fn branches(results: &Results) -> Vec<(u32, [f64; 2])> {
    let of = |branch: &hammerbeam_jobs::StoredBranch| {
        let at = branch.rows.iter().map(|placed| part(results.range_hz, placed.row.frequency_hz));
        let (low, high) = (at.clone().fold(f64::INFINITY, f64::min), at.fold(f64::NEG_INFINITY, f64::max));
        (branch.record.period_multiple, [low, high])
    };
    results.branches().iter().map(of).collect()
}

/// From the table that a user gets.
fn events(results: &Results, folder: &Path) -> Result<Vec<EventAnswer>, BoxedError> {
    let exported = export_csv(&Store::open(folder)?, folder)?;
    let text = std::fs::read_to_string(exported.events_path)?;
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap_or_default();
    let column =
        |name: &str| header.iter().position(|title| *title == name).ok_or(format!("no column {name}"));
    let [multiple, event, frequency, uncertainty] =
        [column("period_multiple")?, column("event")?, column("frequency_hz")?, column("uncertainty_hz")?];
    let width = results.range_hz[1] - results.range_hz[0];
    let mut events = Vec::new();
    for line in lines {
        for kind in line[event].split('+') {
            events.push(EventAnswer {
                period_multiple: line[multiple].parse()?,
                kind: kind.to_owned(),
                at: part(results.range_hz, line[frequency].parse()?),
                uncertainty: line[uncertainty].parse::<f64>()? / width,
            });
        }
    }
    Ok(events)
}

/// At frequencies whose distances from one another are irrational parts of the range.
fn orbits(
    results: &Results,
    units: Units,
    limits: &Limits,
) -> Result<Vec<(f64, Vec<OrbitAnswer>)>, BoxedError> {
    let [low, high] = results.range_hz;
    let mut multiples: Vec<u32> =
        results.branches().iter().map(|branch| branch.record.period_multiple).collect();
    multiples.sort_unstable();
    multiples.dedup();
    let mut orbits = Vec::new();
    for number in 0..limits.frequencies {
        let at = (f64::from(number) * 0.618_033_988_749_894_9 + 0.377).fract();
        let mut there = Vec::new();
        for &multiple in &multiples {
            let crossing = results.crossings(low + at * (high - low), multiple)?;
            there.extend(crossing.iter().map(|(_, orbit)| of_orbit(orbit, units)));
        }
        orbits.push((at, there));
    }
    Ok(orbits)
}

fn of_orbit(orbit: &PeriodicSolution, units: Units) -> OrbitAnswer {
    let maxima = &orbit.maxima;
    OrbitAnswer {
        period_multiple: orbit.period_multiple,
        maxima: [
            maxima.displacement / units.factor([0.0, 1.0, 0.0]),
            maxima.impact_velocity / units.factor([0.0, 1.0, -1.0]),
            maxima.contact_force / units.factor([1.0, 1.0, -2.0]),
        ],
        contacts: maxima.contacts,
        multipliers: orbit.floquet_multipliers.iter().map(|[re, im]| re.hypot(*im)).collect(),
    }
}

/// Number of stored solutions, and what verification does not agree with.
fn verified(results: &Results, folder: &Path, limits: &Limits) -> Result<(u64, Vec<String>), BoxedError> {
    let store = Store::open(folder)?;
    let settings = VerifySettings { sample: limits.verified, ..VerifySettings::default() };
    let verification = verify(&store, &PreparedStudy::of_store(&store)?, &settings, &mut Quiet)?;
    let verification = verification.expect("nothing stops the verification");
    let in_words = verification.disagreements.iter().map(|found| {
        let at = part(results.range_hz, found.place.frequency_hz);
        let (name, branch) = (found.quantity.name(), found.place.branch);
        format!(
            "{name} of branch {branch} at {at:.9} of the range: {:.3e}, allowed {:.3e}",
            found.difference, found.bound
        )
    });
    Ok((verification.stored, in_words.collect()))
}
