//! Periodic orbits by multiple shooting, their Floquet multipliers and their branches.

mod solution;

pub use solution::{BranchRow, Events, OrbitMaxima, PeriodicSolution, Side, StopReason};
