//! Resampling to another rate.
//!
//! | file | how | for |
//! |---|---|---|
//! | `polyphase.rs` | low-pass filter (windowed sinc), by a rational factor | long records |
//! | `fourier.rs` | the spectrum is cut or continued by zeros | whole periods; a record is taken as periodic |
//! | `sinc.rs` | the value between samples, for any place | uneven places; no filter against aliasing |

mod fourier;
mod polyphase;
mod sinc;

pub use fourier::resample_periodic;
pub use polyphase::{Ratio, resample};
pub use sinc::Interpolation;
pub(crate) use sinc::{KNOWN_BELOW, REACH};
