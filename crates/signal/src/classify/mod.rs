//! Whether a motion is periodic, and with which multiple of the excitation period.
//!
//! **Folding.** With the excitation frequency `f` the record is interpolated to a whole number of samples per
//! period and divided into `K` pieces of `n` periods. Their mean is the waveform that repeats after `n`
//! periods. The pieces scatter about it with the variance `v_n` (unbiased: `K - 1` in the denominator), which
//! contains everything that is not a harmonic of `f/n`. The total variance is `v`. The variance `v_w` is an
//! upper limit of the white noise in `v_n`, since white noise cannot exceed the spectral density anywhere. It
//! is the density of the scatter in the lowest of 16 bands of equal width, plus three standard errors, times
//! half the sampling rate. The *deviation* is an amplitude ratio:
//!
//! `d_n = sqrt((v_n - v_w) / (v - v_w))`
//!
//! **Criterion** ([`ClassifySettings`] has the limits):
//!
//! 1. With `n` the smallest number for which `d_n` is at most `periodic_below` (0.05), the motion is
//!    *periodic*. Its period is the smallest multiple `m` of `n` whose additional harmonics have an amplitude
//!    fraction of at least `weakest_subharmonic` (0.02) and four times the power of the scatter; `m = n` if
//!    there is none.
//! 2. If all `d_n` are at least `aperiodic_above` (0.2), it is *aperiodic*: quasi-periodic, chaotic, or with
//!    another excitation.
//! 3. Otherwise the result is *doubtful*, for one of these reasons: a deviation between the limits, a weak
//!    subharmonic (0.005 to 0.02), a change by more than a fifth from one half of the record to the other, or
//!    more white noise than motion.
//!
//! **Frequency.** An error `e` of the frequency shifts the phase by `e T` cycles over a record of duration
//! `T`; even 0.01 cycles would look like scatter. So the phase of the fundamental is evaluated in 16 parts of
//! the record. If it changes linearly, the frequency is corrected by its slope, and the correction is
//! reported.
//!
//! | file | what |
//! |---|---|
//! | `fold.rs` | interpolating to periods, scatter, drift of the phase |
//! | `criterion.rs` | the criterion |
//! | `reference.rs` | the excitation frequency from a reference channel |
//!
//! # Source
//! Folding is the phase-average of Whittaker and Robinson's periodogram, *The Calculus of Observations*,
//! 1924, chapter 13, and of Stellingwerf, Astrophys. J. 224 (1978), 953-960. The limits are this crate's
//! choice.

mod criterion;
mod fold;
mod reference;

pub use criterion::{
    Classification, ClassificationDoubt, ClassifySettings, MotionClass, Repetition, classify,
};
pub use reference::excitation_frequency;
