//! Resampling to another rate.
//!
//! | file | how | for |
//! |---|---|---|
//! | `polyphase.rs` | low-pass filter (windowed sinc), by a rational factor | long records |
//! | `fourier.rs` | the spectrum is truncated or padded with zeros | whole periods |
//! | `sinc.rs` | interpolation between samples | arbitrary times; no filter against aliasing |

mod bessel;
mod fourier;
mod polyphase;
mod sinc;

pub use fourier::resample_periodic;
pub use polyphase::{Ratio, resample};
pub use sinc::Interpolation;
pub(crate) use sinc::{ACCURATE_BELOW, REACH};
