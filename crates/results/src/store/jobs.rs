//! The agenda of a run: jobs, and the starts that came of them.

use hammerbeam_orbit::{Events, LocatedEvent, PeriodicSolution, Side};
use rusqlite::{Row as SqlRow, Transaction, params};

use super::{
    Store, StoreError, StoredReason, event::insert_event, first_key, walk_id, write::insert_solution,
};

/// Most starts of one job: the numbers of starts leave no room for more.
pub const MOST_STARTS: u32 = 1024;

/// What a job is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JobKind {
    /// A harmonic orbit at a frequency, where no harmonic branch passes yet.
    Harmonic,
    /// All orbits that simulation leads to at a frequency.
    Survey,
    /// Attractors at a frequency near which the linear response reaches a contact, or at a resonance.
    Resonance,
    /// Attractors at a frequency at which no stable solution is known.
    NoneStable,
    /// A stable solution that a sweep or basins have come to.
    Met,
    /// The branch of doubled period at a flip.
    Doubling,
    /// The branch that crosses at a branch point.
    Crossing,
}

/// A job.
#[derive(Debug, Clone, PartialEq)]
pub struct JobRecord {
    /// Its place in the order of work.
    pub id: u32,
    /// What it is.
    pub kind: JobKind,
    /// Where [Hz].
    pub frequency_hz: f64,
    /// Key of the solution at the flip or branch point, or with which a branch ends that goes to infinity
    /// where the search begins beyond.
    pub source: Option<i64>,
    /// Period doublings that lead to the branches it finds.
    pub depth: u32,
    /// Whether its starts are known.
    pub evaluated: bool,
    /// Why it has no starts, if it has none.
    pub message: Option<String>,
    /// What came of it, once it is finished.
    pub outcome: Option<String>,
}

/// A solution from which a branch may begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartRecord {
    /// Its key.
    pub key: u32,
    /// The job it came of.
    pub job: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Number of the branch, once it is known to be a new one.
    pub branch: Option<u32>,
}

impl JobKind {
    /// Whether what it finds leaves the branch of its source.
    #[must_use]
    pub fn leaves_source(self) -> bool {
        matches!(self, Self::Doubling | Self::Crossing)
    }

    fn name(self) -> &'static str {
        match self {
            Self::Harmonic => "harmonic",
            Self::Survey => "survey",
            Self::Resonance => "resonance",
            Self::NoneStable => "none-stable",
            Self::Met => "met",
            Self::Doubling => "doubling",
            Self::Crossing => "crossing",
        }
    }

    fn named(name: &str) -> Option<Self> {
        const ALL: [JobKind; 7] = [
            JobKind::Harmonic,
            JobKind::Survey,
            JobKind::Resonance,
            JobKind::NoneStable,
            JobKind::Met,
            JobKind::Doubling,
            JobKind::Crossing,
        ];
        ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// What is known of the event at which a branch leaves another one, as an event of the new branch: it lies as
/// closely as on the old one, the direction is that in which the branch leaves, and the critical multiplier
/// is the one at +1 of the orbit with the periods of the new branch.
fn seen_from_new_branch(source: &LocatedEvent, root: &PeriodicSolution) -> LocatedEvent {
    let from_one = |[re, im]: &[f64; 2]| (1.0 - re).hypot(*im);
    let multipliers = root.floquet_multipliers.iter().copied();
    let multiplier = multipliers.min_by(|a, b| from_one(a).total_cmp(&from_one(b)));
    LocatedEvent { multiplier, contacts: Vec::new(), ..source.clone() }
}

impl Store {
    /// All jobs in their order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn jobs(&self) -> Result<Vec<JobRecord>, StoreError> {
        let select =
            "SELECT id, kind, frequency_hz, source, depth, evaluated, message, outcome FROM job ORDER BY id";
        let mut statement = self.connection.prepare(select)?;
        let mut rows = statement.query([])?;
        let mut jobs = Vec::new();
        while let Some(row) = rows.next()? {
            let name: String = row.get(1)?;
            let kind =
                JobKind::named(&name).ok_or(StoreError::Unknown { what: "kind of job", found: name })?;
            jobs.push(JobRecord {
                id: row.get(0)?,
                kind,
                frequency_hz: row.get(2)?,
                source: row.get(3)?,
                depth: row.get(4)?,
                evaluated: row.get(5)?,
                message: row.get(6)?,
                outcome: row.get(7)?,
            });
        }
        Ok(jobs)
    }

    /// Adds jobs to the end of the agenda; those whose source has one already are left out.
    ///
    /// # Errors
    /// The database refuses.
    pub fn add_jobs(&mut self, jobs: &[(JobKind, f64, Option<i64>, u32)]) -> Result<(), StoreError> {
        let transaction = self.write()?;
        for (kind, frequency_hz, source, depth) in jobs {
            let insert = "INSERT OR IGNORE INTO job (id, kind, frequency_hz, source, depth)
                SELECT coalesce(max(id) + 1, 0), ?1, ?2, ?3, ?4 FROM job";
            transaction.execute(insert, params![kind.name(), frequency_hz, source, depth])?;
        }
        transaction.commit()?;
        Ok(())
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

    /// Starts of all jobs, in their order.
    ///
    /// # Errors
    /// The database refuses.
    pub fn starts(&self) -> Result<Vec<StartRecord>, StoreError> {
        let mut statement =
            self.connection.prepare("SELECT id, job, period_multiple, branch FROM start ORDER BY id")?;
        let read = |row: &SqlRow<'_>| {
            Ok(StartRecord {
                key: row.get(0)?,
                job: row.get(1)?,
                period_multiple: row.get(2)?,
                branch: row.get(3)?,
            })
        };
        Ok(statement.query_map([], read)?.collect::<Result<_, _>>()?)
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
        let one_sided = (job.kind == JobKind::Doubling).then(|| StoredReason::of_crossing(job.frequency_hz));
        let left = job.source.filter(|_| job.kind.leaves_source());
        let source = left.map(|key| self.event(key)).transpose()?.flatten();
        let transaction = self.write()?;
        let update = "UPDATE job SET evaluated = 1, message = ?2 WHERE id = ?1";
        transaction.execute(update, params![job.id, message])?;
        for (start, key) in starts.iter().zip(job.id * MOST_STARTS..(job.id + 1) * MOST_STARTS) {
            let insert = "INSERT OR IGNORE INTO start (id, job, period_multiple) VALUES (?1, ?2, ?3)";
            if transaction.execute(insert, params![key, job.id, start.period_multiple])? == 0 {
                // It is there since before the job was taken back, with what was walked.
                continue;
            }
            for (side, name, solutions) in [(Side::Up, "up", 1), (Side::Down, "down", 0)] {
                let reason = one_sided.as_ref().filter(|_| side == Side::Down);
                let insert = "INSERT INTO walk (id, start, side, solutions, stop_kind, stop_frequency_hz,
                    stop_message) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";
                let values = params![
                    walk_id(key, side),
                    key,
                    name,
                    solutions,
                    reason.map(|reason| &reason.kind),
                    reason.and_then(|reason| reason.frequency_hz),
                    reason.map(|reason| &reason.message),
                ];
                transaction.execute(insert, values)?;
            }
            let events = Events { branch_point: left.is_some(), ..Events::default() };
            let first = first_key(walk_id(key, Side::Up));
            insert_solution(&transaction, first, start, events)?;
            if let Some(source) = &source {
                insert_event(&transaction, ("event", &[first]), &seen_from_new_branch(source, start))?;
            }
        }
        transaction.commit()?;
        Ok(())
    }

    /// A start is that of a new branch.
    ///
    /// # Returns
    /// Its number, counted from 1.
    /// # Errors
    /// The database refuses.
    pub fn accept_start(&mut self, key: u32) -> Result<u32, StoreError> {
        let transaction = self.write()?;
        let newest: Option<u32> =
            transaction.query_row("SELECT max(branch) FROM start", [], |row| row.get(0))?;
        let branch = newest.unwrap_or(0) + 1;
        transaction.execute("UPDATE start SET branch = ?2 WHERE id = ?1", params![key, branch])?;
        transaction.commit()?;
        Ok(branch)
    }

    /// A start lies on another branch: it goes, with everything that was walked from it.
    ///
    /// # Errors
    /// The database refuses.
    pub fn drop_start(&mut self, key: u32) -> Result<(), StoreError> {
        let transaction = self.write()?;
        for side in [Side::Up, Side::Down] {
            forget_walked(&transaction, walk_id(key, side), 0)?;
        }
        transaction.execute("DELETE FROM walk WHERE start = ?1", [key])?;
        transaction.execute("DELETE FROM start WHERE id = ?1", [key])?;
        transaction.commit()?;
        Ok(())
    }

    /// Ends a side after so many solutions; what was walked beyond is deleted.
    ///
    /// # Errors
    /// The database refuses.
    pub fn cut_walk(
        &mut self,
        key: u32,
        side: Side,
        solutions: u32,
        reason: &StoredReason,
    ) -> Result<(), StoreError> {
        let walk = walk_id(key, side);
        let transaction = self.write()?;
        forget_walked(&transaction, walk, solutions)?;
        let update = "UPDATE walk SET solutions = ?2, checkpoint = NULL, stop_kind = ?3,
            stop_frequency_hz = ?4, stop_message = ?5 WHERE id = ?1";
        let values = params![walk, solutions, reason.kind, reason.frequency_hz, reason.message];
        transaction.execute(update, values)?;
        transaction.commit()?;
        Ok(())
    }

    /// Notes that a job is finished, and what came of it.
    ///
    /// # Errors
    /// The database refuses.
    pub fn finish_job(&mut self, job: u32, outcome: &str) -> Result<(), StoreError> {
        let transaction = self.write()?;
        transaction.execute("UPDATE job SET outcome = ?2 WHERE id = ?1", params![job, outcome])?;
        transaction.commit()?;
        Ok(())
    }

    /// Takes everything back that was decided after a start: its job is looked at again, later ones are as if
    /// they had never been begun, and those that came of later branches go.
    ///
    /// # Errors
    /// The database refuses.
    pub fn take_back_to(&mut self, start: u32) -> Result<(), StoreError> {
        let transaction = self.write()?;
        let job = start / MOST_STARTS;
        let later = first_key(walk_id(start + 1, Side::Up));
        transaction.execute("DELETE FROM event WHERE solution >= ?1", [later])?;
        transaction.execute("DELETE FROM solution WHERE id >= ?1", [later])?;
        transaction.execute("DELETE FROM journal WHERE walk >= ?1", [walk_id(start + 1, Side::Up)])?;
        transaction.execute("DELETE FROM walk WHERE start > ?1", [start])?;
        transaction.execute("DELETE FROM start WHERE id > ?1", [start])?;
        // The jobs that branches of this job and of later ones gave, those that all branches together gave,
        // and what was added behind them: their numbers are to follow one another.
        let own = first_key(walk_id(job * MOST_STARTS, Side::Up));
        let given =
            "SELECT min(id) FROM job WHERE (source >= ?1 OR kind IN ('none-stable', 'met')) AND id > ?2";
        let first: Option<u32> = transaction.query_row(given, params![own, job], |row| row.get(0))?;
        if let Some(first) = first {
            transaction.execute("DELETE FROM job WHERE id >= ?1", [first])?;
        }
        // A solution that was met is known without looking.
        let update =
            "UPDATE job SET evaluated = (kind = 'met'), message = NULL, outcome = NULL WHERE id >= ?1";
        transaction.execute(update, [job])?;
        transaction.commit()?;
        Ok(())
    }
}

/// Deletes what was walked beyond so many solutions, and what is needed to go on.
fn forget_walked(transaction: &Transaction<'_>, walk: i64, solutions: u32) -> Result<(), StoreError> {
    let (first, last) = (first_key(walk) + i64::from(solutions), first_key(walk + 1));
    transaction.execute("DELETE FROM event WHERE solution >= ?1 AND solution < ?2", [first, last])?;
    transaction.execute("DELETE FROM solution WHERE id >= ?1 AND id < ?2", [first, last])?;
    transaction.execute("DELETE FROM journal WHERE walk = ?1", [walk])?;
    Ok(())
}
