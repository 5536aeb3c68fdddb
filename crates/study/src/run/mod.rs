//! Running a study: finding starts, following branches, storing as it goes, and going on after an end of any kind.
//!
//! The order of work is fixed by the study alone: for each period multiple the searches of the [`Plan`], for each new
//! branch its up side and then its down side. Whatever the store already holds is skipped, so a resumed run does
//! exactly what is left of the same work.

mod done;
mod follow;
mod known;
mod plan;
mod progress;
mod runner;
mod solver;

pub use plan::{Plan, Target};
pub use progress::{Observer, Progress, Quiet};
pub use runner::{RunError, RunOutcome, run};
pub use solver::{Solver, Walk};

#[cfg(test)]
mod fake;
#[cfg(test)]
mod tests;
