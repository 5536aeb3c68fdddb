//! The agenda of a run: jobs, and the starts that came of them.

use hammerbeam_orbit::Side;
use rusqlite::{Connection, Row as SqlRow, Transaction, params};

use super::{
    StoreError,
    keys::{MOST_STARTS, OF_PIECES, first_key, walk_id},
    outputs::forget_outputs,
};

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
    /// Attractors at a frequency at which a contact of a stable solution appears or vanishes.
    ContactChange,
    /// A stable solution that a sweep or basins have come to.
    Met,
    /// The branch of doubled period at a flip.
    Doubling,
    /// The branch that crosses at a branch point.
    Crossing,
}

/// What came of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JobOutcome {
    /// A harmonic branch passes there by now, so that there was nothing to look for.
    Covered,
    /// New branches.
    NewBranches,
    /// Nothing but orbits of branches that are known, the last one of this.
    OnBranch(u32),
    /// Nothing at all.
    Nothing,
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
    pub outcome: Option<JobOutcome>,
}

impl JobOutcome {
    /// Its word in the table, and the branch.
    fn columns(self) -> (&'static str, Option<u32>) {
        match self {
            Self::Covered => ("covered", None),
            Self::NewBranches => ("new-branches", None),
            Self::OnBranch(branch) => ("on-branch", Some(branch)),
            Self::Nothing => ("nothing", None),
        }
    }

    /// Of the column with the word and the one behind it.
    fn read(row: &SqlRow<'_>, column: usize) -> Result<Option<Self>, StoreError> {
        let (word, branch): (Option<String>, Option<u32>) = (row.get(column)?, row.get(column + 1)?);
        let Some(word) = word else { return Ok(None) };
        match (word.as_str(), branch) {
            ("covered", None) => Ok(Some(Self::Covered)),
            ("new-branches", None) => Ok(Some(Self::NewBranches)),
            ("on-branch", Some(branch)) => Ok(Some(Self::OnBranch(branch))),
            ("nothing", None) => Ok(Some(Self::Nothing)),
            _ => Err(StoreError::Unknown { what: "outcome of a job", found: word }),
        }
    }
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
            Self::ContactChange => "contact-change",
            Self::Met => "met",
            Self::Doubling => "doubling",
            Self::Crossing => "crossing",
        }
    }

    fn named(name: &str) -> Option<Self> {
        const ALL: [JobKind; 8] = [
            JobKind::Harmonic,
            JobKind::Survey,
            JobKind::Resonance,
            JobKind::NoneStable,
            JobKind::ContactChange,
            JobKind::Met,
            JobKind::Doubling,
            JobKind::Crossing,
        ];
        ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// All jobs in their order.
pub fn jobs(connection: &Connection) -> Result<Vec<JobRecord>, StoreError> {
    let select = "SELECT id, kind, frequency_hz, source, depth, evaluated, message, outcome, outcome_branch
        FROM job ORDER BY id";
    let mut statement = connection.prepare(select)?;
    let mut rows = statement.query([])?;
    let mut jobs = Vec::new();
    while let Some(row) = rows.next()? {
        let name: String = row.get(1)?;
        let kind = JobKind::named(&name).ok_or(StoreError::Unknown { what: "kind of job", found: name })?;
        jobs.push(JobRecord {
            id: row.get(0)?,
            kind,
            frequency_hz: row.get(2)?,
            source: row.get(3)?,
            depth: row.get(4)?,
            evaluated: row.get(5)?,
            message: row.get(6)?,
            outcome: JobOutcome::read(row, 7)?,
        });
    }
    Ok(jobs)
}

/// Adds jobs to the end of the agenda; those whose source has one already are left out.
pub fn add_jobs(
    transaction: Transaction<'_>,
    jobs: &[(JobKind, f64, Option<i64>, u32)],
) -> Result<(), StoreError> {
    for (kind, frequency_hz, source, depth) in jobs {
        let insert = "INSERT OR IGNORE INTO job (id, kind, frequency_hz, source, depth)
            SELECT coalesce(max(id) + 1, 0), ?1, ?2, ?3, ?4 FROM job";
        transaction.execute(insert, params![kind.name(), frequency_hz, source, depth])?;
    }
    transaction.commit()?;
    Ok(())
}

/// Notes that a job is finished, and what came of it.
pub fn finish_job(transaction: Transaction<'_>, job: u32, outcome: JobOutcome) -> Result<(), StoreError> {
    let (word, branch) = outcome.columns();
    let update = "UPDATE job SET outcome = ?2, outcome_branch = ?3 WHERE id = ?1";
    transaction.execute(update, params![job, word, branch])?;
    transaction.commit()?;
    Ok(())
}

/// Takes everything back that was decided after a start: its job is looked at again, later ones are as if
/// they had never been started, and those that came of later branches go.
pub fn take_back_to(transaction: Transaction<'_>, start: u32) -> Result<(), StoreError> {
    let job = start / MOST_STARTS;
    // Up to those of pieces, which do not follow from jobs.
    let (later, end) = (walk_id(start + 1, Side::Up), walk_id(OF_PIECES, Side::Up));
    let keys = [first_key(later), first_key(end)];
    transaction.execute("DELETE FROM event WHERE solution >= ?1 AND solution < ?2", keys)?;
    transaction.execute("DELETE FROM solution WHERE id >= ?1 AND id < ?2", keys)?;
    forget_outputs(&transaction, keys)?;
    transaction.execute("DELETE FROM journal WHERE walk >= ?1 AND walk < ?2", [later, end])?;
    transaction.execute("DELETE FROM walk WHERE id >= ?1 AND id < ?2", [later, end])?;
    transaction.execute("DELETE FROM start WHERE id > ?1 AND id < ?2", [start, OF_PIECES])?;
    // The jobs that branches of this job and of later ones gave, those that all branches together gave,
    // and what was added behind them: their numbers are to follow one another.
    let own = first_key(walk_id(job * MOST_STARTS, Side::Up));
    let given = "SELECT min(id) FROM job
         WHERE (source >= ?1 OR kind IN ('none-stable', 'contact-change', 'met')) AND id > ?2";
    let first: Option<u32> = transaction.query_row(given, params![own, job], |row| row.get(0))?;
    if let Some(first) = first {
        transaction.execute("DELETE FROM job WHERE id >= ?1", [first])?;
    }
    // A solution that was met is known without looking.
    let update =
        "UPDATE job SET evaluated = (kind = 'met'), message = NULL, outcome = NULL, outcome_branch = NULL
            WHERE id >= ?1";
    transaction.execute(update, [job])?;
    transaction.commit()?;
    Ok(())
}
