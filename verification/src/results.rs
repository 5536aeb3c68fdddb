//! Whole runs of a study, and where their branches cross a frequency.

use std::path::Path;

use hammerbeam_orbit::{BranchWalk, OrbitSettings, PeriodicSolution, Side};
use hammerbeam_study::{
    Model, OrbitSolver, Store, StoreError, StudyFile,
    run::{Plan, Quiet, run},
    store::{BranchRecord, Row},
};

/// What ends a check before it has a result.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// A row with its place in the store.
#[derive(Debug, Clone, Copy)]
pub struct Placed {
    /// Its side,
    pub side: Side,
    /// and its number there.
    pub number: u32,
    /// What its tables show.
    pub row: Row,
}

/// A branch with its rows end to end.
#[derive(Debug)]
pub struct Branch {
    /// As it is stored.
    pub record: BranchRecord,
    /// Its rows.
    pub rows: Vec<Placed>,
}

/// Stored branches of a study, with its model.
#[derive(Debug)]
pub struct Results {
    /// The equations of motion.
    pub model: Model,
    /// Range of the excitation frequency [Hz].
    pub range_hz: [f64; 2],
    /// The branches, in their order.
    pub branches: Vec<Branch>,
    store: Store,
}

impl Results {
    /// Runs a study into a folder on so many threads, and reads what came of it.
    ///
    /// # Errors
    /// The study is wrong, or the store refuses.
    pub fn of_run(text: &str, folder: &Path, threads: usize) -> Result<Self, Failure> {
        let file = StudyFile::parse("study.toml", text.to_owned())?;
        let model = Model::build(&file)?;
        let mut store = Store::open_for_run(folder, &file)?;
        let solver = OrbitSolver::new(&model, &file.study);
        run(&mut store, &solver, &Plan::of(&file.study), threads, &mut Quiet)?;
        store.finish()?;
        Self::read(text, folder)
    }

    /// Reads the results of a study.
    ///
    /// # Errors
    /// The study is wrong, or the store refuses.
    pub fn read(text: &str, folder: &Path) -> Result<Self, Failure> {
        let file = StudyFile::parse("study.toml", text.to_owned())?;
        let model = Model::build(&file)?;
        let store = Store::open(folder)?;
        let branches = store.branches()?.into_iter().map(|record| rows_of(&store, record));
        let branches = branches.collect::<Result<_, StoreError>>()?;
        Ok(Self { model, range_hz: file.study.excitation.frequency_hz, branches, store })
    }

    /// Orbits in which the branches of a period multiple cross a frequency, each with the index of its branch.
    ///
    /// Between two rows the state is interpolated and then corrected at the frequency.
    ///
    /// # Errors
    /// The store refuses.
    pub fn crossings(
        &self,
        frequency_hz: f64,
        period_multiple: u32,
    ) -> Result<Vec<(usize, PeriodicSolution)>, Failure> {
        let mut orbits = Vec::new();
        for (index, branch) in self.branches.iter().enumerate() {
            if branch.record.period_multiple != period_multiple {
                continue;
            }
            for pair in branch.rows.windows(2) {
                let [a, b] = [&pair[0], &pair[1]].map(|placed| placed.row.frequency_hz);
                if (a < frequency_hz) != (b < frequency_hz) {
                    let share = (frequency_hz - a) / (b - a);
                    orbits
                        .extend(self.between(branch, pair, share, frequency_hz)?.map(|orbit| (index, orbit)));
                }
            }
        }
        Ok(orbits)
    }

    fn between(
        &self,
        branch: &Branch,
        pair: &[Placed],
        share: f64,
        frequency_hz: f64,
    ) -> Result<Option<PeriodicSolution>, Failure> {
        let stored = |placed: &Placed| self.store.solution(branch.record.start, placed.side, placed.number);
        let (first, second) = (stored(&pair[0])?, stored(&pair[1])?);
        let states = first.nodes[0].iter().zip(&second.nodes[0]);
        let state = states.map(|(a, b)| a + share * (b - a)).collect();
        Ok(self.corrected(PeriodicSolution { frequency_hz, nodes: vec![state], ..first }))
    }

    /// The orbit near a guess at its frequency; `None` if there is none that Newton's method finds.
    #[must_use]
    pub fn corrected(&self, guess: PeriodicSolution) -> Option<PeriodicSolution> {
        let range_hz = (0.5 * guess.frequency_hz, 2.0 * guess.frequency_hz);
        let (system, response) = (&self.model.system, &self.model.response);
        let settings = OrbitSettings::default();
        let walk = BranchWalk::new(system, response, &guess, Side::Up, range_hz, &settings);
        Some(walk.ok()?.start_row().ok()?.solution)
    }
}

fn rows_of(store: &Store, record: BranchRecord) -> Result<Branch, StoreError> {
    let of = |side: Side| -> Result<Vec<Placed>, StoreError> {
        let rows = store.walked(record.start, side)?.into_iter().enumerate();
        Ok(rows.map(|(number, row)| Placed { side, number: number as u32, row }).collect())
    };
    let mut rows = of(Side::Down)?;
    rows.reverse();
    rows.extend(of(Side::Up)?);
    Ok(Branch { record, rows })
}
