//! Decisions, in the order of the agenda and as far as the work for them is done.

use hammerbeam_orbit::{Side, StopReason};
use hammerbeam_results::{
    end::BranchEnd,
    store::{JobOutcome, Store, StoreError},
};

use super::{
    Plan, Solver, again,
    agenda::{Agenda, Start},
    follow_ups, joins, known,
};
use crate::Observer;

/// What the decisions are taken on.
pub(super) struct Decisions<'a> {
    pub store: &'a mut Store,
    pub solver: &'a dyn Solver,
    pub plan: &'a Plan,
    pub observer: &'a mut dyn Observer,
}

/// Whether a job is finished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Finished,
    /// Work is missing.
    Waits,
}

/// What is known of a start.
enum Finding {
    New,
    OnBranch(u32),
}

impl Decisions<'_> {
    /// Takes all decisions that can be taken now.
    pub fn take(&mut self, agenda: &mut Agenda) -> Result<(), StoreError> {
        let mut index = 0;
        while index < agenda.jobs.len() || self.looks_again(agenda)? {
            let job = &agenda.jobs[index];
            if job.record.outcome.is_some() {
                index += 1;
                continue;
            }
            match self.job(agenda, index)? {
                Verdict::Finished => index += 1,
                Verdict::Waits => return Ok(()),
            }
        }
        Ok(())
    }

    /// Once all jobs are done, adds those that look again; whether there are any.
    fn looks_again(&mut self, agenda: &mut Agenda) -> Result<bool, StoreError> {
        let jobs = again::jobs(agenda, self.plan);
        self.store.add_jobs(&jobs)?;
        agenda.add_new_jobs(self.store)?;
        Ok(!jobs.is_empty())
    }

    fn job(&mut self, agenda: &mut Agenda, index: usize) -> Result<Verdict, StoreError> {
        let record = agenda.jobs[index].record.clone();
        let has_branch = agenda.jobs[index].starts.iter().any(|start| start.branch.is_some());
        if Plan::only_if_not_covered(&record) && !has_branch && agenda.is_covered(record.frequency_hz) {
            while let Some(start) = agenda.jobs[index].starts.first() {
                let key = start.key;
                self.drop_start(agenda, index, key)?;
            }
            return self.finish(agenda, index, JobOutcome::Covered);
        }
        if !record.evaluated {
            return Ok(Verdict::Waits);
        }
        let mut place = 0;
        while let Some(start) = agenda.jobs[index].starts.get(place) {
            if start.branch.is_none() {
                let key = start.key;
                match self.find(agenda, key)? {
                    Finding::New => self.accept(agenda, key)?,
                    Finding::OnBranch(branch) => {
                        self.drop_start(agenda, index, key)?;
                        agenda.jobs[index].on_branch = Some(branch);
                        continue;
                    }
                }
            }
            if !self.follow(agenda, index, place)? {
                return Ok(Verdict::Waits);
            }
            place += 1;
        }
        self.conclude(agenda, index)
    }

    /// Whether a start lies on a branch that was decided on.
    fn find(&self, agenda: &Agenda, key: u32) -> Result<Finding, StoreError> {
        let solution = self.store.solution(key, Side::Up, 0)?;
        let start = agenda.starts().find(|start| start.key == key);
        let root = start.is_some_and(|start| start.up.rows.first().is_some_and(|row| row.branch_point));
        let left_from = agenda.left_from(key);
        for other in agenda.accepted() {
            let known = if root {
                known::has_branch_point(self.store, self.solver, other, (&solution, left_from))?
            } else {
                known::goes_on_to(other, &solution)
                    || known::lies_on(self.store, self.solver, other, &solution)?
            };
            if let (true, Some(branch)) = (known, other.branch) {
                return Ok(Finding::OnBranch(branch));
            }
        }
        Ok(Finding::New)
    }

    fn accept(&mut self, agenda: &mut Agenda, key: u32) -> Result<(), StoreError> {
        let branch = self.store.accept_start(key)?;
        if let Some(start) = agenda.start_mut(key) {
            start.branch = Some(branch);
            self.observer.branch_begun(branch, start.period_multiple);
        }
        Ok(())
    }

    fn drop_start(&mut self, agenda: &mut Agenda, index: usize, key: u32) -> Result<(), StoreError> {
        if let Some(start) = agenda.start_mut(key) {
            start.up.cancel();
            start.down.cancel();
        }
        agenda.jobs[index].starts.retain(|start| start.key != key);
        self.store.drop_start(key)
    }

    /// Whether both sides of a new branch are followed; a closed one has but one side, the upper one if that
    /// came round.
    fn follow(&mut self, agenda: &mut Agenda, index: usize, place: usize) -> Result<bool, StoreError> {
        for side in [Side::Up, Side::Down] {
            let end = joins::cut(self.store, self.solver, agenda, (index, place, side))?;
            self.tell_of_end(&agenda.jobs[index].starts[place], side, end);
        }
        let start = &mut agenda.jobs[index].starts[place];
        let has_up = start.up.rows.len() > 1;
        if start.up.is_closed() && has_up && !(start.down.is_closed() && start.down.rows.is_empty()) {
            self.drop_side(start, Side::Down)?;
        } else if start.down.is_closed() && start.up.end.is_some() && !start.up.is_closed() {
            self.drop_side(start, Side::Up)?;
        }
        let is_finished = start.is_finished(self.plan);
        if is_finished {
            let end = joins::cut_at_upper_side(self.store, self.solver, start)?;
            self.tell_of_end(&agenda.jobs[index].starts[place], Side::Down, end);
        }
        Ok(is_finished)
    }

    /// Leaves nothing of a side but the start, which the upper one has: the other one is all of the branch.
    fn drop_side(&mut self, start: &mut Start, side: Side) -> Result<(), StoreError> {
        let solutions = usize::from(side == Side::Up);
        joins::cut_at(self.store, start, side, (solutions, StopReason::Closed.into()))?;
        Ok(())
    }

    fn tell_of_end(&mut self, start: &Start, side: Side, end: Option<BranchEnd>) {
        if let (Some(branch), Some(end)) = (start.branch, end) {
            self.observer.walk_ended(branch, side, &end);
        }
    }

    /// The events of the new branches become jobs.
    fn conclude(&mut self, agenda: &mut Agenda, index: usize) -> Result<Verdict, StoreError> {
        let job = &agenda.jobs[index];
        let has_branch = job.starts.iter().any(|start| start.branch.is_some());
        let outcome = match job.on_branch {
            _ if has_branch => JobOutcome::NewBranches,
            Some(branch) => JobOutcome::OnBranch(branch),
            None => JobOutcome::Nothing,
        };
        for start in &agenda.jobs[index].starts {
            let jobs = follow_ups::of_branch(start, agenda.jobs[index].record.depth, self.plan);
            self.store.add_jobs(&jobs)?;
        }
        agenda.add_new_jobs(self.store)?;
        self.finish(agenda, index, outcome)
    }

    fn finish(
        &mut self,
        agenda: &mut Agenda,
        index: usize,
        outcome: JobOutcome,
    ) -> Result<Verdict, StoreError> {
        let record = &mut agenda.jobs[index].record;
        self.store.finish_job(record.id, outcome)?;
        record.outcome = Some(outcome);
        self.observer.job_ended(record, outcome);
        Ok(Verdict::Finished)
    }
}
