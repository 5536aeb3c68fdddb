//! What each command does: with a study, into its results, out of them.
//!
//! * `prepared`: a study with its model, which every job takes.
//! * `one_call`: each of them in one call, without reports.
//! * `observer`: what a job reports while it works, and how it is stopped.
//! * [`pool`]: the threads of all jobs.
//! * `request`: where the results of a motion are kept.
//! * `initial`, `initial_words`: the state at which a motion begins, and what it is called.
//! * [`check`]: what is known of a study before anything is computed.
//! * [`run`]: the plan of searches, following branches, progress; of the numerics it knows two traits.
//! * `orbit_solver`: these traits, served by the orbit crate.
//! * [`varied`]: branches in other parameters and curves of bifurcations, after the diagram.
//! * [`simulate`], [`sweep`], [`exponents`], [`basins`]: motions in time, settled ones over the frequency,
//!   their exponents, where motions from a grid of states lead.
//! * [`outputs`]: what is read off stored orbits besides their rows.
//! * `piece_parameter`: the parameter over which a stored piece runs.
//! * `walk`: one side of a branch or curve in stretches that are committed together, and taken up again.
//! * `branch`: the same row by row, for whoever follows a branch by hand.
//! * [`orbits`]: all periodic solutions at one frequency.
//! * [`chosen_orbits`]: stored orbits by branch, frequency or event.
//! * [`orbit_history`]: an orbit from phase 0 on: states at equal steps and within contacts, impacts.
//! * `orbit_waveform`: the motion of an orbit over its period.
//! * `part`, `basin_parts`, `basins_part`, `sweep_parts`: parts of basins and sweeps, the whole from them.
//! * [`settled`]: motions that sweeps and basins have met, from which branches begin.
//! * [`special_point`]: special points of stored branches, from which branches begin.
//! * [`update`]: parameters of a study fitted to measured eigenfrequencies, damping ratios and responses.
//! * `crossings`: where stored branches cross a frequency, and which of them holds a periodic motion.
//! * [`comparison`]: measured points held against stored branches.
//! * [`rig`]: a measurement made with another model.
//! * [`verify`]: stored solutions, computed again by the independent integrator.
//!
//! A run is a loop over searches that the study alone decides. Everything it finishes is in the store before
//! it goes on, and what is in the store is skipped, so a run that was killed does exactly what is left, with
//! the same bits.

mod basin_parts;
pub mod basins;
mod basins_part;
mod branch;
pub mod check;
pub mod chosen_orbits;
pub mod comparison;
mod counted;
mod crossings;
mod error;
pub mod exponents;
mod failure_kind;
mod grid_coordinate;
mod initial;
mod initial_error;
mod initial_words;
mod matrix_document;
mod modes_document;
mod observer;
mod one_call;
pub mod orbit_history;
mod orbit_solver;
mod orbit_waveform;
pub mod orbits;
pub mod outputs;
mod part;
mod piece_parameter;
pub mod pool;
mod prepared;
mod request;
pub mod rig;
pub mod run;
pub mod settled;
pub mod simulate;
pub mod special_point;
pub mod sweep;
mod sweep_parts;
mod sweep_report;
pub mod update;
pub mod varied;
pub mod verify;
mod walk;

pub use basins_part::basins_part;
pub use branch::BranchRows;
pub use counted::counted;
pub use crossings::{MirrorImage, StoredBranch, StoredBranches, corrected};
pub use error::JobError;
pub use failure_kind::FailureKind;
pub use initial::InitialState;
pub use initial_error::InitialStateError;
pub use initial_words::{InitialWordsError, MOST_OF_A_STATE};
pub use matrix_document::matrix_document;
pub use modes_document::modes_document;
pub use observer::{CountedProgress, DoneShare, Observer, Progress, Quiet, VariedProgress};
pub use orbit_solver::OrbitSolver;
pub use orbit_waveform::{OrbitWaveform, PointWaveform, orbit_waveform};
pub use part::{JobPart, JobPartError, JobPartReport};
pub use pool::PooledOrder;
pub use prepared::{ManyModes, PreparedStudy};
pub use request::{FrequencySeries, JobFolders};
