//! Reading a TOML document so that everything wrong with it is found, and found where it stands.
//!
//! A derived deserialiser stops at the first fault and loses positions inside tagged tables. Here every table
//! is asked for its keys one by one ([`Table`]), every value is checked against its [`Quantity`], all faults
//! are collected ([`Problem`]), and what was never asked for is unknown by definition.

mod problem;
pub(crate) mod quantity;
mod reading;
mod suggest;
mod table;
pub(crate) mod unit;
mod value;

pub use problem::{Problem, Report};
pub(crate) use quantity::Quantity;
pub(crate) use reading::{Reading, place};
pub(crate) use suggest::closest;
pub(crate) use table::Table;
pub(crate) use value::Value;
