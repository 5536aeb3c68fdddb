//! Free decays: eigenfrequencies and damping with their uncertainty.
//!
//! A structure that is let go moves as a sum of damped oscillations, `y(t) = y0 + sum_m exp(-s_m t) (a_m cos
//! w_m t + b_m sin w_m t)`. From the decay rate `s` [1/s] and the damped frequency `w` [rad/s] follow the
//! eigenfrequency `f = sqrt(s² + w²) / 2 pi`, the damping ratio `D = s / sqrt(s² + w²)` and the logarithmic
//! decrement `2 pi s / w`, the logarithm of the ratio of two successive maxima.
//!
//! Two ways:
//!
//! * [`free_decay`] fits the whole sum to all samples by least squares (`fit.rs`), starting from the lines
//!   that stand out of the noise (`search.rs`). With white noise no unbiased method does better (the fit
//!   reaches the Cramér-Rao bound). Intervals are of 95 %.
//! * [`decrement`] takes the classical way for one mode: the slope of the logarithms of successive maxima
//!   (`decrement.rs`), and says whether it changes over the decay, which the first way takes as excluded.
//!
//! **Uncertainty.** The covariance of the parameters is `S (J^T J)^-1`, `J` the derivatives of the samples by
//! the parameters. For white noise `S` is its variance. Where neighbouring residuals are correlated (the
//! record was filtered, or something else is in it), `S` for a mode is instead the spectral density of the
//! residual about that mode's frequency times half the sampling rate, which is what the fit of a narrow line
//! sees.
//!
//! | file | what |
//! |---|---|
//! | `search.rs` | where the modes are, roughly |
//! | `model.rs` | the sum, its derivatives |
//! | `fit.rs` | least squares, covariance |
//! | `modes.rs` | [`free_decay`]: modes one after the other, and their figures |
//! | `decrement.rs` | [`decrement`] |
//!
//! # Source
//! Ewins, *Modal Testing*, 2nd ed. 2000, section 3.3; Kay, *Fundamentals of Statistical Signal Processing:
//! Estimation Theory*, 1993, chapters 3 and 8; Levenberg, Q. Appl. Math. 2 (1944), 164-168; Marquardt, J.
//! SIAM 11 (1963), 431-441.

mod decrement;
mod fit;
mod model;
mod modes;
mod search;

pub use decrement::{Decrement, decrement};
pub use modes::{Decay, DecayMode, DecaySettings, Estimate, free_decay};

pub(crate) use fit::fit;
pub(crate) use model::Oscillation;
