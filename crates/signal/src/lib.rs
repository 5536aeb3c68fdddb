//! Measured and computed time series.
pub mod chain;
pub mod classify;
pub mod decay;
pub mod envelope;
mod error;
pub mod exponent;
pub mod filter;
mod finding;
mod fourier;
pub mod judge;
pub mod random;
pub mod raw;
pub mod read;
mod record;
pub mod resample;
pub mod spectrum;
pub mod unit;

pub use error::SignalError;
pub use finding::{Finding, Repairs};
pub use judge::{RecordError, Terms};
pub use read::{Format, ReadError};
pub use record::{Channel, Record};
pub use unit::Quantity;
