//! Reading a TOML document so that everything wrong with it is found, and found where it stands.
//!
//! A derived deserialiser stops at the first fault and loses positions inside tagged tables. Here every table
//! is asked for its keys one by one ([`TomlTable`]), every value is checked against its [`Quantity`], all
//! faults are collected ([`Problem`]), and what was never asked for is unknown by definition.

pub mod key;
mod problem;
pub mod quantity;
mod reading;
mod suggest;
mod table;
pub mod unit;
mod value;

pub use key::{Key, KeyRow};
pub use problem::{FaultReport, Problem};
pub use quantity::Quantity;
pub use reading::{Reading, place};
pub use suggest::closest;
pub(crate) use table::MOST_NAMES;
pub use table::TomlTable;
pub use value::Value;
