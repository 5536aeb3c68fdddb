//! Orbits that the record cannot tell from the most alike one.
//!
//! With the measured waveform `a` and what an orbit leaves of it, `u = |g a - b|^2/(g^2 aa)`, noise of the record changes the difference of two `u` like one degree of freedom: orbits are told apart with 95 % where `u' - u`
//! is above 3.84 times the variance of a degree of freedom. Pieces scatter by `s` (root mean square), their mean over `P` pieces by `s/sqrt(P)`, in `2 L` degrees for `L` lines: the variance is
//! `s^2/(2 L P)` over the mean square of `a`.

use hammerbeam_signal::waveform::Waveform;

use super::{Overlay, candidates::SPACING};

/// Chi-squared of one freedom that is exceeded with 5 %.
const CHI_SQUARED: f64 = 3.84;
/// Difference of squares that is none: folding a record knows values between its samples to some 1e-5.
const NONE: f64 = 1e-9;

/// Orbits that are as alike as the most alike one.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// How many.
    pub count: usize,
    /// Their branches, rising, each once.
    pub branches: Vec<u32>,
    /// Their lowest and highest frequency [Hz].
    pub frequency_hz: (f64, f64),
}

pub(super) fn alike(laid: &[Overlay], best: &Overlay, measured: &Waveform) -> Option<Alike> {
    let most = left(best) + told(measured, best.alignment.sizes.0);
    // Neighbours on a branch are nearly the same orbit.
    let apart = |one: &&Overlay| {
        let distance = (one.frequency_hz / best.frequency_hz - 1.0).abs();
        one.branch != best.branch || distance > 2.0 * SPACING
    };
    let others: Vec<&Overlay> = laid.iter().filter(apart).filter(|one| left(one) <= most).collect();
    let mut branches: Vec<u32> = others.iter().map(|one| one.branch).collect();
    branches.sort_unstable();
    branches.dedup();
    let frequencies = others.iter().map(|one| one.frequency_hz);
    let frequency_hz =
        frequencies.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(f), high.max(f)));
    (!others.is_empty()).then_some(Alike { count: others.len(), branches, frequency_hz })
}

/// Difference of squares that a record can tell, over the mean square of its waveform.
///
/// * `size`: root mean square of the waveform.
pub(super) fn told(measured: &Waveform, size: f64) -> f64 {
    let freedom = 2.0 * measured.lines as f64 * measured.pieces as f64;
    NONE.max(CHI_SQUARED * (measured.scatter / size).powi(2) / freedom)
}

/// Square of what an orbit leaves of the measured waveform, over the square of that.
fn left(one: &Overlay) -> f64 {
    let (measured, computed) = one.alignment.sizes;
    (one.residual_after * computed / (one.factor * measured)).powi(2)
}
