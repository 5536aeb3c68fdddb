//! What each command does: with a study, into its results, out of them.
//!
//! | room | what it knows |
//! |---|---|
//! | [`run`] | the plan of searches, following branches, progress; of the numerics it knows two traits |
//! | `orbit_solver` | these traits, served by the orbit crate |
//! | [`varied`] | branches in other parameters and curves of bifurcations, after the diagram |
//! | [`settled`] | motions that sweeps and basins have met, from which branches begin |
//! | [`update`] | parameters of a study fitted to measured eigenfrequencies, damping ratios and responses |
//! | `crossings` | where stored branches cross a frequency, and which of them holds a periodic motion |
//! | [`comparison`] | measured points held against stored branches |
//! | [`rig`] | a measurement made with another model |
//! | [`verify`] | stored solutions, computed again by the independent integrator |
//!
//! A run is a loop over searches that the study alone decides. Everything it finishes is in the store before
//! it goes on, and what is in the store is skipped, so a run that was killed does exactly what is left, with
//! the same bits.

pub mod comparison;
mod crossings;
mod orbit_solver;
pub mod rig;
pub mod run;
pub mod settled;
pub mod update;
pub mod varied;
pub mod verify;

pub use crossings::{MirrorImage, PlacedRow, StoredBranch, StoredBranches, corrected};
pub use orbit_solver::OrbitSolver;
