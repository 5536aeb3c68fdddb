//! Access to the agenda of a run: jobs, pieces of the study, starts, and the walks from them.

use hammerbeam_orbit::{PeriodicSolution, Side};

use super::{
    Continuation, JobKind, JobOutcome, JobRecord, Piece, PieceRecord, StartRecord, Store, StoreError, jobs,
    pieces, schema, starts, write::write_walk,
};
use crate::{end::BranchEnd, row::SolvedRow};

/// Key of the part that a stopped run showed as done.
const PART_DONE: &str = "part_done";

impl Store {
    /// All jobs in their order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn jobs(&self) -> Result<Vec<JobRecord>, StoreError> {
        jobs::jobs(&self.connection)
    }

    /// Adds jobs to the end of the agenda; those whose source has one already are left out.
    ///
    /// # Errors
    /// The database refuses.
    pub fn add_jobs(&mut self, jobs: &[(JobKind, f64, Option<i64>, u32)]) -> Result<(), StoreError> {
        jobs::add_jobs(self.write()?, jobs)
    }

    /// Adds jobs of stable solutions that were met elsewhere, to the end of the agenda; as many as there are
    /// at a frequency already are left out.
    ///
    /// # Errors
    /// The database refuses.
    pub fn add_met(&mut self, solutions: &[PeriodicSolution]) -> Result<(), StoreError> {
        let there = self.jobs()?.into_iter().filter(|job| job.kind == JobKind::Met);
        let mut there: Vec<f64> = there.map(|job| job.frequency_hz).collect();
        for solution in solutions {
            if let Some(place) = there.iter().position(|at| *at == solution.frequency_hz) {
                there.swap_remove(place);
                continue;
            }
            self.add_jobs(&[(JobKind::Met, solution.frequency_hz, None, 0)])?;
            if let Some(job) = self.jobs()?.last() {
                self.note_starts(job, std::slice::from_ref(solution), None)?;
            }
        }
        Ok(())
    }

    /// Notes that a job is finished, and what came of it.
    ///
    /// # Errors
    /// The database refuses.
    pub fn finish_job(&mut self, job: u32, outcome: JobOutcome) -> Result<(), StoreError> {
        jobs::finish_job(self.write()?, job, outcome)
    }

    /// Takes everything back that was decided after a start: its job is looked at again, later ones are as if
    /// they had never been started, and those that came of later branches go.
    ///
    /// # Errors
    /// The database refuses.
    pub fn take_back_to(&mut self, start: u32) -> Result<(), StoreError> {
        jobs::take_back_to(self.write()?, start)
    }

    /// Part of the work that a stopped run showed as done, 0 to 1; 0 where none was stopped in order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn part_done(&self) -> Result<f64, StoreError> {
        let noted = self.about(PART_DONE)?.parse().unwrap_or(0.0);
        Ok(if (0.0..=1.0).contains(&noted) { noted } else { 0.0 })
    }

    /// Notes it, or that there is nothing to note.
    ///
    /// # Errors
    /// The database refuses.
    pub fn note_part_done(&mut self, part: Option<f64>) -> Result<(), StoreError> {
        let noted = part.map_or_else(String::new, |part| part.to_string());
        if self.about(PART_DONE)? != noted {
            let transaction = self.write()?;
            schema::note(&transaction, PART_DONE, &noted)?;
            transaction.commit()?;
        }
        Ok(())
    }

    /// Starts of all jobs, in their order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn starts(&self) -> Result<Vec<StartRecord>, StoreError> {
        starts::starts(&self.connection)
    }

    /// Notes what came of a job: its starts, each with the walks that will begin there.
    ///
    /// * `message`: why there are none.
    ///
    /// Those beyond the first 1024 are left out.
    ///
    /// A branch of doubled period is walked away from its flip only: the other way it is its own copy, a
    /// period later.
    ///
    /// # Errors
    /// The database refuses.
    pub fn note_starts(
        &mut self,
        job: &JobRecord,
        starts: &[PeriodicSolution],
        message: Option<&str>,
    ) -> Result<(), StoreError> {
        starts::note_starts(self.write()?, job, starts, message)
    }

    /// A start is that of a new branch.
    ///
    /// # Returns
    /// The number of the branch; within its piece, where it is of one.
    /// # Errors
    /// The database refuses.
    pub fn accept_start(&mut self, key: u32) -> Result<u32, StoreError> {
        starts::accept_start(self.write()?, key)
    }

    /// A start lies on another branch: it goes, with everything that was walked from it.
    ///
    /// # Errors
    /// The database refuses.
    pub fn drop_start(&mut self, key: u32) -> Result<(), StoreError> {
        starts::drop_start(self.write()?, key)
    }

    /// Throws away pieces that the study does not ask for any more, notes new ones, and gives all the numbers
    /// of their places in it.
    ///
    /// # Errors
    /// The database refuses; nothing is changed then.
    pub fn keep_pieces(&mut self, wanted: &[Piece]) -> Result<(), StoreError> {
        pieces::keep_pieces(self.write()?, wanted)
    }

    /// Notes what came of the search of a piece: its starts, each with the walks that will begin there.
    ///
    /// * `parameter`: its value there, in the unit of its name.
    /// * `message`: why there are none, or not all.
    ///
    /// # Errors
    /// The database refuses.
    pub fn note_piece_starts(
        &mut self,
        piece: u32,
        parameter: f64,
        starts: &[PeriodicSolution],
        message: Option<&str>,
    ) -> Result<(), StoreError> {
        pieces::note_piece_starts(self.write()?, piece, parameter, starts, message)
    }

    /// Notes that nothing of a piece is left to compute.
    ///
    /// * `message`: why there is nothing, or not everything; `None` leaves what was noted before.
    ///
    /// # Errors
    /// The database refuses.
    pub fn finish_piece(&mut self, piece: u32, message: Option<&str>) -> Result<(), StoreError> {
        pieces::finish_piece(self.write()?, piece, message)
    }

    /// Starts of a piece, by its key, in their order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn starts_of_piece(&self, piece: u32) -> Result<Vec<StartRecord>, StoreError> {
        pieces::starts(&self.connection, piece)
    }

    /// The pieces whose starts are known, in the order of the study.
    ///
    /// # Errors
    /// The database refuses.
    pub fn pieces(&self) -> Result<Vec<PieceRecord>, StoreError> {
        pieces::pieces(&self.connection)
    }

    /// All pieces, in the order of the study, those too of which nothing is known yet.
    ///
    /// # Errors
    /// The database refuses.
    pub fn all_pieces(&self) -> Result<Vec<PieceRecord>, StoreError> {
        pieces::all_pieces(&self.connection)
    }

    /// Appends solutions to a walk, together with how it goes on.
    ///
    /// # Errors
    /// The database refuses; nothing is appended then.
    pub fn append(
        &mut self,
        start: u32,
        side: Side,
        rows: &[SolvedRow],
        continuation: Continuation<'_>,
    ) -> Result<(), StoreError> {
        write_walk(self.write()?, (start, side), None, rows, continuation)
    }

    /// Stores the first solutions of a walk in the place of the start that was noted, together with how it
    /// goes on.
    ///
    /// # Errors
    /// The database refuses; nothing is changed then.
    pub fn begin_walk(
        &mut self,
        start: u32,
        side: Side,
        rows: &[SolvedRow],
        continuation: Continuation<'_>,
    ) -> Result<(), StoreError> {
        write_walk(self.write()?, (start, side), Some(0), rows, continuation)
    }

    /// Ends a side after so many solutions; what was walked beyond is deleted.
    ///
    /// # Errors
    /// The database refuses.
    pub fn cut_walk(
        &mut self,
        start: u32,
        side: Side,
        solutions: u32,
        end: &BranchEnd,
    ) -> Result<(), StoreError> {
        write_walk(self.write()?, (start, side), Some(solutions), &[], Continuation::Ended(end))
    }
}
