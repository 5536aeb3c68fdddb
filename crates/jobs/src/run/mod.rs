//! Running a study: finding starts, following branches, storing as it goes, on all cores, and going on after
//! an end of any kind.
//!
//! # The order of work
//! The *agenda* is a list of jobs: a search at a frequency, or a flip or branch point at which another branch
//! leaves. Each gives *starts*. What a run computes is defined by doing the jobs one after the other: each
//! start of a job that does not lie on a known branch is the start of a new one, which is followed to both
//! ends, or to where it comes upon an earlier branch that was lost there, before the next start is looked at;
//! the flips and branch points of the new branches are added to the end of the agenda. When it is done,
//! searches are added at frequencies at which a contact of a stable solution appears or vanishes and at which
//! no stable solution is known by then, and there again, as long as they find branches (`again.rs`). So
//! branches, their numbers and every bit of them follow from the study alone.
//!
//! # All cores
//! Searching and walking are pure functions of their input, so they may be done ahead of their turn: threads
//! evaluate later jobs and walk from starts that are likely to be new. Only the *decision* whether a start is
//! new is made in order. What was walked for nothing is thrown away. The threads compute and send; one thread
//! decides and writes.
//!
//! # Going on
//! Everything that comes in is committed at once, with the checkpoint of its walk, whether decided or not. A
//! run that is started again reads the agenda and does what is left.
//!
//! | file | what it does |
//! |---|---|
//! | `plan.rs` | the first jobs, and the limits |
//! | `agenda.rs` | jobs, starts and walks, as they are in the store |
//! | `decide.rs` | takes decisions in order, as far as the work is done |
//! | `known.rs` | whether a start lies on a known branch |
//! | `joins.rs` | where a branch comes upon the end of an earlier one |
//! | `follow_ups.rs` | the jobs that the events of a branch give |
//! | `again.rs` | jobs of all branches together: where no stable solution is known or contacts change |
//! | `schedule.rs` | what an idle thread does next |
//! | `worker.rs` | what a thread does |
//! | `estimate.rs` | how much of it is done |
//! | `runner.rs` | the loop over all of it |
//! | `whole.rs` | that, and after it branches in other parameters and curves |
//! | `report.rs` | what came of it, branch by branch |

mod again;
mod agenda;
mod decide;
mod estimate;
mod follow_ups;
mod joins;
mod known;
mod plan;
mod report;
mod runner;
mod schedule;
mod solver;
mod whole;
mod worker;

pub use crate::walk::Walk;
pub use plan::Plan;
pub use report::{BranchReport, RunReport, end_of_side, peak_stability};
pub use runner::{RunError, RunOutcome, run};
pub use solver::{BranchOrigin, OrbitMatcher, Solver, Surveyed};
pub use whole::{RunOrigin, RunRequest, WholeRun, run_study};

#[cfg(test)]
mod fake;
#[cfg(test)]
mod tests;
