//! Results of studies: the folder that holds them, tables for export, branches in few numbers.
//!
//! | room | what it knows |
//! |---|---|
//! | [`store`] | the results folder: one database in transactions, the checkpoint of each walk beside its rows; motions in time, sweeps, exponents and basins by request |
//! | [`columns`] | what is stored as columns of numbers: records in NumPy's layout, NPZ, JSON |
//! | [`export`] | what is stored as CSV |
//! | [`summary`] | a branch in few numbers: its range, its peaks |
//! | [`reason`] | why a branch ended, in words |
//! | [`whole_file`] | files that appear whole or not at all |
//!
//! How a result is computed is not known here: whoever computes hands over rows, and reads them again.

pub mod columns;
pub mod export;
pub mod reason;
pub mod store;
pub mod summary;
pub mod whole_file;

pub use export::{export_csv, export_states};
pub use store::{Store, StoreError};
