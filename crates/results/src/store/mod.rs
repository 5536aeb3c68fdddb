//! The results folder: one database with every solution, which survives being killed at any instant.
//!
//! `results.db` is written in transactions (write-ahead log), each of which holds some solutions of a walk
//! together with the checkpoint from which the walk goes on: after a kill, what was committed is there, what
//! was not is computed again, and both agree to the last bit. `run.lock` is held while a run writes.
//!
//! Branches over the frequency, branches over another parameter and curves of bifurcations lie in the same
//! tables: each has a start with two walks, and each walk its solutions, its checkpoint and how it ended.
//!
//! Solutions are keyed by walk and number, so that a walk only ever appends, and read one after the other, so
//! that no branch has to fit into memory; [`Store::open_with_rows`] is for those who have room for all rows.

mod agenda;
mod basins;
mod blob;
mod checksum;
mod class;
mod closed;
mod error;
mod event;
mod exponents;
mod folder;
mod jobs;
mod kept_rows;
mod keys;
mod lock;
mod motions;
mod outputs;
mod pieces;
mod place;
mod read;
mod requests;
mod schema;
mod settled;
mod simulated;
mod simulation_layout;
mod stability;
mod starts;
mod values;
mod write;

pub use checksum::add_checksums;
pub use error::{DATABASE, StoreError};
pub use exponents::ExponentRecord;
pub use folder::Store;
pub use jobs::{JobKind, JobOutcome, JobRecord};
pub use keys::{MOST_STARTS, solution_key, start_of_key};
pub use outputs::{StoredOutputs, keep_outputs, put_outputs};
pub use pieces::{Piece, PieceKind, PieceRecord};
pub use read::{BranchRecord, PlacedRow, StoredMemory, WalkRecord};
pub use requests::{RequestKind, RequestRecord};
pub use schema::SCHEMA_VERSION;
pub use settled::{SettledMotion, SettledOrigin};
pub use simulated::{SimulatedChunk, SimulatedContact, SimulatedTouch};
pub use simulation_layout::SimulationLayout;
pub use starts::StartRecord;
pub use write::{Continuation, Memory};

#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod simulated_tests;
#[cfg(test)]
pub(crate) mod tests;
