//! Is a motion periodic in the period of its excitation or a multiple of it, and in which?
//!
//! **Folding.** With the excitation frequency `f` the record is interpolated to a whole number of samples a
//! period and cut into `K` pieces of `n` periods. Their mean is the waveform that repeats after `n` periods;
//! the pieces scatter about it with the variance `v_n` (unbiased: `K - 1` in the denominator), which contains
//! everything that is not a harmonic of `f/n`. The total variance is `v`. Measuring noise is part of `v_n`;
//! what of it may be white noise has at most the smallest density that the scatter has anywhere: the record
//! of the scatter is averaged over segments, and the quietest of 16 bands of equal width (and three standard
//! errors), times half the sampling rate, is the variance `v_w`. The *deviation* is
//!
//! `d_n = sqrt((v_n - v_w) / (v - v_w))`, an amplitude ratio.
//!
//! **Criterion** ([`ClassifySettings`] has the limits):
//!
//! 1. With `n` the smallest number for which `d_n` is at most `periodic_below` (0.05), the motion is
//!    *periodic*, and its period is the smallest multiple `m` of `n` whose additional harmonics hold an
//!    amplitude part of at least `weakest_subharmonic` (0.02) and stand out of the scatter fourfold; `m = n`
//!    if none does.
//! 2. If all `d_n` are at least `aperiodic_above` (0.2), it is *aperiodic*: quasi-periodic, chaotic, or
//!    driven by something else.
//! 3. Otherwise the answer is *doubtful*, with the reason: between the limits, a weak subharmonic (0.005 to
//!    0.02), a record that grows or falls by more than a fifth from one half to the other, or more white
//!    noise than motion.
//!
//! **Frequency.** A frequency that is off by `e` turns the phase by `e T` cycles over a record of length `T`;
//! already 0.01 cycles would look like scatter. So the phase of the fundamental is followed over 16 parts of
//! the record: if it runs straight, the frequency is corrected by its slope, and told.
//!
//! | file | what |
//! |---|---|
//! | `fold.rs` | interpolating to periods, scatter, drift of the phase |
//! | `judge.rs` | the criterion |
//! | `reference.rs` | the excitation frequency from a reference channel |
//!
//! # Source
//! Folding is the phase-average of Whittaker and Robinson's periodogram, *The Calculus of Observations*,
//! 1924, chapter 13, and of Stellingwerf, Astrophys. J. 224 (1978), 953-960. The limits are this crate's
//! choice.

mod fold;
mod judge;
mod reference;

pub use judge::{Classification, ClassifySettings, Doubt, Motion, Repetition, classify};
pub use reference::excitation_frequency;
