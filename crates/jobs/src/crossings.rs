//! Where the stored branches cross a frequency, and which of them holds a given periodic motion.

mod images;
mod mirror;

pub use images::MirrorImage;

use std::path::Path;

use hammerbeam_attractor::{distance, state_scales};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings};
use hammerbeam_orbit::{
    BranchWalk, OrbitSettings, PeriodicSolution, Side, neighbouring_orbit, states_at_phase,
};
use hammerbeam_results::{
    Store, StoreError,
    store::{BranchRecord, PlacedRow},
};
use hammerbeam_study::{Model, StudyFile, identity::differences};

use images::SAME;

/// The stored branches of a study.
#[derive(Debug)]
pub struct StoredBranches {
    store: Store,
    branches: Vec<StoredBranch>,
}

/// A branch with its rows end to end.
#[derive(Debug)]
pub struct StoredBranch {
    /// As it is stored.
    pub record: BranchRecord,
    /// Its rows.
    pub rows: Vec<PlacedRow>,
}

/// Opens a results folder for reading, if it holds results of this study.
pub(crate) fn open_for_study(folder: &Path, file: &StudyFile) -> Result<Store, StoreError> {
    let store = Store::open(folder)?;
    if store.about("identity")? == file.study.identity() {
        return Ok(store);
    }
    let differences = differences(&store.about("canonical")?, &file.study.canonical(), 12);
    Err(StoreError::OtherStudy { folder: folder.to_owned(), differences })
}

impl StoredBranches {
    /// Reads the branches of a results folder.
    ///
    /// # Errors
    /// [`StoreError`]: there are no results, or they are those of another study.
    pub fn open(folder: &Path, file: &StudyFile) -> Result<Self, StoreError> {
        let store = open_for_study(folder, file)?;
        let branches = store.branches()?.into_iter().map(|record| {
            let rows = store.placed_rows(&record)?;
            Ok(StoredBranch { record, rows })
        });
        let branches = branches.collect::<Result<_, StoreError>>()?;
        Ok(Self { store, branches })
    }

    /// All branches, in their order.
    #[must_use]
    pub fn branches(&self) -> &[StoredBranch] {
        &self.branches
    }

    /// The store they are in.
    pub(crate) fn store(&self) -> &Store {
        &self.store
    }

    /// The range of the frequency [Hz] of each branch that is wanted, of those that have a solution.
    pub fn ranges(&self, wanted: impl Fn(&BranchRecord) -> bool) -> Vec<(f64, f64)> {
        let range = |branch: &StoredBranch| {
            let frequencies = branch.rows.iter().map(|placed| placed.row.frequency_hz);
            let (low, high) =
                (frequencies.clone().fold(f64::INFINITY, f64::min), frequencies.fold(0.0, f64::max));
            (low <= high).then_some((low, high))
        };
        self.branches.iter().filter(|branch| wanted(&branch.record)).filter_map(range).collect()
    }

    /// The stored solution of a row.
    ///
    /// # Errors
    /// The store refuses.
    pub fn solution(
        &self,
        branch: &StoredBranch,
        placed: &PlacedRow,
    ) -> Result<PeriodicSolution, StoreError> {
        self.store.solution(branch.record.start, placed.side, placed.number)
    }

    /// Orbits in which branches cross a frequency, each with the number of its branch: between two rows the
    /// state is interpolated and then corrected at the frequency. In a symmetric system the mirror image of
    /// an orbit is one, too, and counts to its branch unless a branch holds it.
    ///
    /// * `model`: that of the study.
    /// * `wanted`: of a branch's record, whether it is looked at.
    ///
    /// # Errors
    /// The store refuses.
    pub fn crossings(
        &self,
        model: &Model,
        frequency_hz: f64,
        wanted: impl Fn(&BranchRecord) -> bool,
    ) -> Result<Vec<(u32, PeriodicSolution)>, StoreError> {
        let mut orbits = self.stored_crossings(model, frequency_hz, wanted)?;
        if model.system.is_symmetric() {
            images::add_to(&mut orbits, model);
        }
        Ok(orbits)
    }

    /// Those of them that branches hold.
    fn stored_crossings(
        &self,
        model: &Model,
        frequency_hz: f64,
        wanted: impl Fn(&BranchRecord) -> bool,
    ) -> Result<Vec<(u32, PeriodicSolution)>, StoreError> {
        let mut orbits = Vec::new();
        for StoredBranch { record, rows } in self.branches.iter().filter(|branch| wanted(&branch.record)) {
            let begin = orbits.len();
            for pair in rows.windows(2) {
                let [a, b] = [&pair[0], &pair[1]].map(|placed| placed.row.frequency_hz);
                if (a < frequency_hz) != (b < frequency_hz) {
                    let share = (frequency_hz - a) / (b - a);
                    let known = &orbits[begin..];
                    let orbit = self.orbit_between(model, (record, known), pair, (share, frequency_hz))?;
                    orbits.extend(orbit.map(|orbit| (record.id, orbit)));
                }
            }
            // Between rows the higher end counts; a branch that ends at the frequency and lies above it has
            // no such pair there.
            for (end, beside) in [(rows.first(), rows.get(1)), (rows.last(), rows.iter().rev().nth(1))] {
                let Some((end, beside)) = end.zip(beside) else { continue };
                if end.row.frequency_hz == frequency_hz && beside.row.frequency_hz >= frequency_hz {
                    let guess = self.store.solution(record.start, end.side, end.number)?;
                    orbits.extend(corrected(model, &guess).map(|orbit| (record.id, orbit)));
                }
            }
        }
        Ok(orbits)
    }

    /// The branch that a periodic motion lies on.
    ///
    /// * `states`: at phase 0 of each of its excitation periods, or of some of them over and over: of an
    ///   orbit that is in contact at phase 0 under an impact-speed-dependent law, not all may be known. One
    ///   in common with an orbit of as many periods is enough.
    ///
    /// # Errors
    /// The store refuses.
    pub fn branch_of(
        &self,
        model: &Model,
        frequency_hz: f64,
        states: &[Vec<f64>],
    ) -> Result<Option<u32>, StoreError> {
        let scales = state_scales(&model.system, frequency_hz);
        let orbits =
            self.crossings(model, frequency_hz, |record| record.period_multiple as usize == states.len())?;
        let motion = ExactIntegrator::new(model.system.clone(), ExactSettings::default());
        let Ok(mut integrator) = motion else { return Ok(None) };
        let mut same = |orbit: &PeriodicSolution| {
            let there = states_at_phase(&mut integrator, orbit, 0.0).unwrap_or_default();
            there.iter().any(|there| states.iter().any(|state| distance(&scales, state, there) < SAME))
        };
        Ok(orbits.iter().find(|(_, orbit)| same(orbit)).map(|(branch, _)| *branch))
    }

    /// Pairs of branches, or a branch with itself, that hold the same orbit at a frequency, as it is, started
    /// some excitation periods later, or gone through several times: there should be none. Orbits are the
    /// same within 1e-4, which two beside a fold or a flip may be as well.
    ///
    /// * `model`: that of the study.
    ///
    /// # Errors
    /// The store refuses.
    pub fn held_twice(&self, model: &Model, frequency_hz: f64) -> Result<Vec<[u32; 2]>, StoreError> {
        let scales = state_scales(&model.system, frequency_hz);
        let motion = ExactIntegrator::new(model.system.clone(), ExactSettings::default());
        let Ok(mut integrator) = motion else { return Ok(Vec::new()) };
        let orbits: Vec<(u32, Vec<Vec<f64>>)> = self
            .stored_crossings(model, frequency_hz, |_| true)?
            .into_iter()
            .filter_map(|(branch, orbit)| Some((branch, states_at_phase(&mut integrator, &orbit, 0.0).ok()?)))
            .collect();
        let mut twice = Vec::new();
        for (place, (first, states)) in orbits.iter().enumerate() {
            for (second, others) in &orbits[place + 1..] {
                let same = |state: &Vec<f64>| distance(&scales, &states[0], state) < SAME;
                if others.iter().any(same) {
                    twice.push([*first, *second]);
                }
            }
        }
        Ok(twice)
    }

    /// The orbit between two rows at a frequency, a share of the way from the first: from all nodes between
    /// them, unless they were chosen anew there, then from those of the nearer row. Where many orbits lie
    /// side by side, Newton's method may come to that of another crossing, which is known, or to one with
    /// other contacts: then the branch is walked from either row. `None` where that does not lead there.
    fn orbit_between(
        &self,
        model: &Model,
        (record, known): (&BranchRecord, &[(u32, PeriodicSolution)]),
        pair: &[PlacedRow],
        (share, frequency_hz): (f64, f64),
    ) -> Result<Option<PeriodicSolution>, StoreError> {
        let stored = |placed: &PlacedRow| self.store.solution(record.start, placed.side, placed.number);
        let (first, second) = (stored(&pair[0])?, stored(&pair[1])?);
        let is_cut_alike = first.phase == second.phase && first.nodes.len() == second.nodes.len();
        let between =
            |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect();
        let nodes = is_cut_alike.then(|| first.nodes.iter().zip(&second.nodes).map(between).collect());
        let [nearer, farther] = if share < 0.5 { [first, second] } else { [second, first] };
        let nodes = nodes.unwrap_or_else(|| nearer.nodes.clone());
        let guess = PeriodicSolution { frequency_hz, nodes, ..nearer.clone() };
        let scales = state_scales(&model.system, frequency_hz);
        let is_known = |orbit: &PeriodicSolution| {
            let begins_alike = |other: &PeriodicSolution| {
                orbit.phase == other.phase && distance(&scales, &orbit.nodes[0], &other.nodes[0]) < ALIKE
            };
            known.iter().any(|(_, other)| begins_alike(other))
        };
        let fits = |orbit: &PeriodicSolution| has_contacts_of(pair, orbit) && !is_known(orbit);
        let corrected = corrected(model, &guess).filter(fits);
        let walked =
            || [&nearer, &farther].into_iter().find_map(|row| walked(model, row, frequency_hz).filter(fits));
        Ok(corrected.or_else(walked))
    }
}

/// Relative difference of states that the tolerance of orbits leaves.
const ALIKE: f64 = 1e-9;

/// Most steps of a walk from a row to a frequency beside it.
const MOST_STEPS: usize = 200;

/// The orbit at a frequency on the branch of a row beside it, by following that.
fn walked(model: &Model, row: &PeriodicSolution, frequency_hz: f64) -> Option<PeriodicSolution> {
    if row.frequency_hz == frequency_hz {
        return Some(row.clone());
    }
    let side = if frequency_hz < row.frequency_hz { Side::Down } else { Side::Up };
    let range_hz = (frequency_hz.min(row.frequency_hz), frequency_hz.max(row.frequency_hz));
    let settings = OrbitSettings { max_step: range_hz.1 - range_hz.0, ..OrbitSettings::default() };
    let mut walk = BranchWalk::new(&model.system, &model.response, row, side, range_hz, &settings).ok()?;
    let mut rows = Vec::new();
    for _ in 0..MOST_STEPS {
        if walk.step(&mut rows).ok()?.is_some() {
            break;
        }
    }
    rows.pop().map(|row| row.solution).filter(|orbit| orbit.frequency_hz == frequency_hz)
}

/// Whether an orbit touches as often as one of two rows, or as often as something between: where several
/// branches meet in a grazing, Newton's method may go from between two rows of one to another.
fn has_contacts_of(pair: &[PlacedRow], orbit: &PeriodicSolution) -> bool {
    let [one, other] = [&pair[0], &pair[1]].map(|placed| placed.row.maxima.contacts);
    (one.min(other)..=one.max(other)).contains(&orbit.maxima.contacts)
}

/// The orbit near a guess at its frequency, with the segments of the guess; `None` if there is none of its
/// period that Newton's method finds.
#[must_use]
pub fn corrected(model: &Model, guess: &PeriodicSolution) -> Option<PeriodicSolution> {
    let (system, response) = (&model.system, &model.response);
    neighbouring_orbit(system, response, guess, &OrbitSettings::default()).ok().flatten()
}
