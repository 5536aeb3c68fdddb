//! Butterworth filters as second-order sections, causal and with zero phase.
//!
//! The analogue low-pass filter of order `n` has `|H|² = 1 / (1 + (f/f_c)^{2n})`: half the power at the
//! cut-off, no ripple. The bilinear transformation makes it digital, with a prewarped cut-off (`tan(pi f_c /
//! f_s)`): half the power is exact at `f_c`, and the gain is zero at half the sampling rate. The filter runs
//! as a sequence of second-order sections, which stays accurate where one polynomial of high order does not.
//!
//! * **Causal** ([`DigitalFilter::causal`]): as an instrument filters, with delay and phase shift.
//! * **Zero phase** ([`DigitalFilter::zero_phase`]): forwards, then backwards. The gain acts twice: at the
//!   cut-off a quarter of the power remains, not half. The record is extended at both ends by its mirror
//!   image about the end point ("odd" extension), and the sections start in the steady state of the first
//!   value.
//!
//! | file | what |
//! |---|---|
//! | `butterworth.rs` | design: poles, and sections of them |
//! | `sections.rs` | the filter: running, gain |
//! | `zero_phase.rs` | filtering forwards and backwards |
//! | `periodic.rs` | the analogue low-pass filter on a periodic motion, without transient |
//!
//! # Source
//! Oppenheim and Schafer, *Discrete-Time Signal Processing*, 3rd ed. 2010, sections 6.3, 7.2; Gustafsson,
//! IEEE Trans. Signal Process. 44 (1996), 988-992, on initial states of forward-backward filters (here the
//! simpler variant with the steady state of the first value, as in SciPy's `sosfiltfilt`).

mod butterworth;
mod periodic;
mod sections;
mod zero_phase;

pub use butterworth::{Band, butterworth};
pub use periodic::{low_pass_response, periodic_low_pass, periodic_zero_phase};
pub use sections::{DigitalFilter, SecondOrderSection};
