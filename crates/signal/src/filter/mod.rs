//! Butterworth filters as second-order sections, causal and without phase.
//!
//! The analogue low-pass filter of order `n` has `|H|² = 1 / (1 + (f/f_c)^{2n})`: half the power at the
//! cut-off, no ripple. It is made digital by the bilinear transformation with the cut-off put right
//! beforehand (`tan(pi f_c / f_s)`), so half the power is exact at `f_c`, and the gain is zero at half the
//! sampling rate. The filter is run as a chain of sections of second order, which stays accurate where one
//! polynomial of high order does not.
//!
//! * **Causal** ([`Sections::causal`]): as an instrument filters; delays, and turns phases.
//! * **Without phase** ([`Sections::zero_phase`]): forwards, then backwards. The gain acts twice: at the
//!   cut-off a quarter of the power is left, not half. The record is continued at both ends by its own mirror
//!   image, turned about the end point ("odd"), and the sections begin in the steady state of the first
//!   value.
//!
//! | file | what |
//! |---|---|
//! | `butterworth.rs` | poles, and sections of them |
//! | `sections.rs` | running sections, gain |
//! | `zero_phase.rs` | forwards and backwards |
//! | `periodic.rs` | the analogue low-pass filter on a motion that repeats, without transient |
//!
//! # Source
//! Oppenheim and Schafer, *Discrete-Time Signal Processing*, 3rd ed. 2010, sections 6.3, 7.2; Gustafsson,
//! IEEE Trans. Signal Process. 44 (1996), 988-992, on the beginning of forward-backward filters (the simpler
//! variant with the steady state of the first value is used here, as in SciPy's `sosfiltfilt`).

mod butterworth;
mod periodic;
mod sections;
mod zero_phase;

pub use butterworth::{Band, butterworth};
pub use periodic::{low_pass_response, periodic_low_pass, periodic_zero_phase};
pub use sections::{Section, Sections};
