//! Each job in one call, on all cores, without reports of its progress.

use std::path::Path;

use hammerbeam_orbit::PeriodicSolution;

use crate::{
    JobError, JobFolders, PreparedStudy, Quiet,
    basins::{BasinsReport, BasinsRequest, basins},
    exponents::{ExponentsReport, ExponentsRequest, exponents},
    orbits::orbits,
    pool::threads,
    run::{RunReport, RunRequest, WholeRun, run_study},
    simulate::{SimulationReport, SimulationRequest, simulate},
    sweep::{SweepReport, SweepRequest, sweep},
};

impl PreparedStudy {
    /// Runs everything the study asks for into a results folder, on all cores: see
    /// [`run_study`](crate::run::run_study).
    ///
    /// # Errors
    /// [`JobError`]; what was stored before stays, and the same run goes on from there.
    pub fn run(&self, out: impl AsRef<Path>) -> Result<RunReport, JobError> {
        let request = RunRequest { out: out.as_ref(), from: &[], threads: threads(None) };
        let WholeRun { store, report } = run_study(self, request, &mut Quiet)?;
        store.finish()?;
        Ok(report)
    }

    /// All periodic solutions of a period at a frequency that are found.
    ///
    /// # Errors
    /// [`JobError`]: nothing could be looked for.
    pub fn orbits(&self, frequency_hz: f64, period_multiple: u32) -> Result<Vec<PeriodicSolution>, JobError> {
        Ok(orbits(self, frequency_hz, period_multiple, &mut Quiet)?.orbits)
    }

    /// A motion in time: see [`simulate`](crate::simulate::simulate).
    ///
    /// # Errors
    /// [`JobError`].
    pub fn simulate(&self, request: &SimulationRequest) -> Result<SimulationReport, JobError> {
        simulate(self, request, JobFolders::default(), &mut Quiet)
    }

    /// Settled motions over the frequency: see [`sweep`](crate::sweep::sweep).
    ///
    /// # Errors
    /// [`JobError`].
    pub fn sweep(&self, request: &SweepRequest) -> Result<SweepReport, JobError> {
        sweep(self, request, JobFolders::default(), threads(None), &mut Quiet)
    }

    /// Lyapunov exponents: see [`exponents`](crate::exponents::exponents).
    ///
    /// # Errors
    /// [`JobError`].
    pub fn exponents(&self, request: &ExponentsRequest) -> Result<ExponentsReport, JobError> {
        exponents(self, request, JobFolders::default(), &mut Quiet)
    }

    /// Basins of attraction: see [`basins`](crate::basins::basins).
    ///
    /// # Errors
    /// [`JobError`].
    pub fn basins(&self, request: &BasinsRequest) -> Result<BasinsReport, JobError> {
        basins(self, request, JobFolders::default(), threads(None), &mut Quiet)
    }
}
