//! Results of studies: the folder that holds them, tables for export, branches in few numbers.
//!
//! | room | what it knows |
//! |---|---|
//! | [`row`] | one row of a branch, over the frequency or any other parameter |
//! | [`columns`] | the one list of columns, from which store, tables and reference follow |
//! | [`end`], [`end_text`] | how a side of a branch ended; that in a sentence |
//! | [`store`] | the results folder: walks with their checkpoints, motions by request, in one database |
//! | [`export`] | what is stored as CSV |
//! | [`arrays`] | what is stored as columns of numbers: records in NumPy's layout, NPZ, JSON |
//! | [`summary`] | a branch in few numbers: its range, its events, its peaks |
//! | [`whole_file`] | files that appear whole or not at all |
//!
//! How a result is computed is not known here: whoever computes hands over rows, and reads them again.

pub mod arrays;
pub mod columns;
pub mod end;
pub mod end_text;
pub mod export;
mod lines;
pub mod row;
pub mod store;
pub mod summary;
pub mod whole_file;

pub use export::{export_csv, export_states};
pub use store::{Store, StoreError};
