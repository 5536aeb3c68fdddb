//! Free decays: eigenfrequencies and damping with their uncertainty.
//!
//! A released structure moves as a sum of damped oscillations, `y(t) = y0 + sum_m exp(-s_m t) (a_m cos
//! w_m t + b_m sin w_m t)`. From the decay rate `s` [1/s] and the damped frequency `w` [rad/s] follow the
//! eigenfrequency `f = sqrt(s² + w²) / 2 pi`, the damping ratio `D = s / sqrt(s² + w²)` and the logarithmic
//! decrement `2 pi s / w`, the logarithm of the ratio of two successive maxima.
//!
//! Two ways:
//!
//! * [`free_decay`] fits the whole sum to all samples by least squares (`fit.rs`), starting from the lines
//!   above the noise (`search.rs`). With white noise no unbiased method is better (the fit reaches the
//!   Cramér-Rao bound). Intervals are of 95 %.
//! * [`decrement`] is the classical method for one mode: the slope of the logarithms of successive maxima
//!   (`decrement.rs`). It also reports whether the decrement changes, which the fit assumes not to happen.
//!
//! **Uncertainty.** The covariance of the parameters is `S (J^T J)^-1`, with the derivatives `J` of the
//! samples by the parameters. For white noise `S` is its variance. Neighbouring residuals may be correlated,
//! because the record was filtered or holds other signals. Then `S` of a mode is the spectral density of the
//! residual about its frequency times half the sampling rate, the part of the noise that affects a narrow
//! line.
//!
//! | file | what |
//! |---|---|
//! | `search.rs` | initial values of the modes |
//! | `model.rs` | the sum and its derivatives |
//! | `fit.rs` | least squares, covariance |
//! | `modes.rs` | [`free_decay`]: modes one by one, with their uncertainty |
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
pub use modes::{Decay, DecayEstimate, DecayMode, DecaySettings, free_decay};

pub(crate) use fit::fit;
pub(crate) use model::Oscillation;
