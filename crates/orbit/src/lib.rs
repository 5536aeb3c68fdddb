//! Periodic orbits by multiple shooting, their Floquet multipliers and their branches.

mod checkpoint;
mod eigenvalues;
mod error;
mod find;
mod free;
mod resegment;
mod settings;
mod shooting;
mod solution;
mod solve;
mod start;
mod walk;

pub use eigenvalues::NoEigenvalues;
pub use error::OrbitError;
pub use find::find_orbits;
pub use free::{FreeOrbit, free_orbit};
pub use settings::{OrbitSettings, Response, Segments};
pub use solution::{BranchRow, Events, OrbitMaxima, PeriodicSolution, Side, StopReason};
pub use start::find_start;
pub use walk::BranchWalk;
