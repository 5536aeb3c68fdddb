//! Waveforms over the periods of an excitation, and the alignment of two waveforms.
//!
//! **Folding.** A record is interpolated at phases of its excitation and averaged over all its pieces of `n`
//! periods. The scatter of the pieces about their mean is the uncertainty of the measurement.
//!
//! **Lines.** The mean keeps the lines of its spectrum that both the record and the samples of the waveform
//! represent. These are below 0.4 of the sampling rate of the record, where interpolation is accurate
//! ([`resample`](crate::resample)), and below half of the samples in a period. The mean is evaluated at no
//! fewer phases than the record has samples, so that no aliasing occurs. A waveform to be compared with it
//! has to be limited to the same lines ([`band_limited`]): an orbit has more harmonics than a record.
//!
//! **Alignment.** Two waveforms `a`, `b` of one length, about their means: with the coefficients `A_k`,
//! `B_k` of their Fourier series
//!
//! `r(s) = sum a(t) b(t - s) = (2/N) Re sum_{k = 1}^{k < N/2} A_k conj(B_k) exp(2 pi i k s/N)`
//!
//! is the product of `a` with `b` delayed by `s` samples. The shift is where `r` is largest: on the grid of
//! samples, then between them by Newton's method on `r'`, which is exact for band-limited series; a step that
//! overshoots is halved. With `aa`, `bb` the squares of both, the correlation is
//! `r/sqrt(aa bb)`, the factor that brings `a` closest to `b` is `r/aa`, and a factor `g` leaves the residual
//! `sqrt((g^2 aa - 2 g r + bb)/bb)` of the root mean square of `b`.
//!
//! | file | what |
//! |---|---|
//! | `folding.rs` | records folded onto periods |
//! | `alignment.rs` | one waveform shifted onto another |
//! | `band_limit.rs` | a limited number of harmonics |

mod alignment;
mod band_limit;
mod folding;

pub use alignment::{Alignment, Shifts, align, delayed};
pub use band_limit::band_limited;
pub use folding::{Waveform, folded};

#[cfg(test)]
mod tests;
