//! Where the stored branches cross a frequency, and which of them holds a given periodic motion.

use std::path::Path;

use hammerbeam_attractor::{distance, state_scales};
use hammerbeam_orbit::{BranchWalk, OrbitSettings, PeriodicSolution, Side};

use crate::{
    Model, Store, StoreError, StudyFile,
    identity::differences,
    store::{BranchRecord, Row},
};

/// Distance of a motion from an orbit of a branch, relative to it, up to which they are the same.
const SAME: f64 = 1e-4;

/// The stored branches of a study.
#[derive(Debug)]
pub struct StoredBranches<'m> {
    store: Store,
    model: &'m Model,
    branches: Vec<(BranchRecord, Vec<Placed>)>,
}

/// A row with its place in the store.
#[derive(Debug, Clone, Copy)]
struct Placed {
    side: Side,
    number: u32,
    row: Row,
}

impl<'m> StoredBranches<'m> {
    /// Reads the branches of a results folder.
    ///
    /// # Errors
    /// [`StoreError`]: there are no results, or they are those of another study.
    pub fn open(folder: &Path, file: &StudyFile, model: &'m Model) -> Result<Self, StoreError> {
        let store = Store::open(folder)?;
        if store.about("identity")? != file.study.identity() {
            let differences = differences(&store.about("canonical")?, &file.study.canonical(), 12);
            return Err(StoreError::OtherStudy { folder: folder.to_owned(), differences });
        }
        let branches = store.branches()?.into_iter().map(|record| {
            let rows = rows_of(&store, &record)?;
            Ok((record, rows))
        });
        let branches = branches.collect::<Result<_, StoreError>>()?;
        Ok(Self { store, model, branches })
    }

    /// Numbers of all branches.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        self.branches.iter().map(|(record, _)| record.id)
    }

    /// Orbits in which branches cross a frequency, each with the number of its branch: between two rows the state is interpolated and then
    /// corrected at the frequency.
    ///
    /// * `wanted`: of a branch's record, whether it is looked at.
    ///
    /// # Errors
    /// The store refuses.
    pub fn crossings(
        &self,
        frequency_hz: f64,
        wanted: impl Fn(&BranchRecord) -> bool,
    ) -> Result<Vec<(u32, PeriodicSolution)>, StoreError> {
        let mut orbits = Vec::new();
        for (record, rows) in self.branches.iter().filter(|(record, _)| wanted(record)) {
            for pair in rows.windows(2) {
                let [a, b] = [&pair[0], &pair[1]].map(|placed| placed.row.frequency_hz);
                if (a < frequency_hz) != (b < frequency_hz) {
                    let share = (frequency_hz - a) / (b - a);
                    orbits.extend(
                        self.between(record, pair, share, frequency_hz)?.map(|orbit| (record.id, orbit)),
                    );
                }
            }
        }
        Ok(orbits)
    }

    /// The branch that a periodic motion lies on.
    ///
    /// * `states`: at phase 0 of each of its excitation periods.
    ///
    /// # Errors
    /// The store refuses.
    pub fn branch_of(&self, frequency_hz: f64, states: &[Vec<f64>]) -> Result<Option<u32>, StoreError> {
        let scales = state_scales(&self.model.system, frequency_hz);
        let orbits =
            self.crossings(frequency_hz, |record| record.period_multiple as usize == states.len())?;
        let same = |orbit: &PeriodicSolution| {
            states.iter().any(|state| distance(&scales, state, &orbit.nodes[0]) < SAME)
        };
        Ok(orbits.iter().find(|(_, orbit)| same(orbit)).map(|(branch, _)| *branch))
    }

    fn between(
        &self,
        record: &BranchRecord,
        pair: &[Placed],
        share: f64,
        frequency_hz: f64,
    ) -> Result<Option<PeriodicSolution>, StoreError> {
        let stored = |placed: &Placed| self.store.solution(record.start, placed.side, placed.number);
        let (first, second) = (stored(&pair[0])?, stored(&pair[1])?);
        let states = first.nodes[0].iter().zip(&second.nodes[0]);
        let state = states.map(|(a, b)| a + share * (b - a)).collect();
        let guess = PeriodicSolution { frequency_hz, nodes: vec![state], ..first };
        let range_hz = (0.5 * frequency_hz, 2.0 * frequency_hz);
        let (system, response) = (&self.model.system, &self.model.response);
        let settings = OrbitSettings::default();
        let walk = BranchWalk::new(system, response, &guess, Side::Up, range_hz, &settings);
        Ok(walk.ok().and_then(|mut walk| walk.start_row().ok()).map(|row| row.solution))
    }
}

fn rows_of(store: &Store, record: &BranchRecord) -> Result<Vec<Placed>, StoreError> {
    let of = |side: Side| -> Result<Vec<Placed>, StoreError> {
        let rows = store.walked(record.start, side)?.into_iter().enumerate();
        Ok(rows.map(|(number, row)| Placed { side, number: number as u32, row }).collect())
    };
    let mut rows = of(Side::Down)?;
    rows.reverse();
    rows.extend(of(Side::Up)?);
    Ok(rows)
}
