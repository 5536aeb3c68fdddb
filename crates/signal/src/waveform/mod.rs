//! Waveforms over the periods of an excitation, and one laid over another.
//!
//! **Folding.** A record is read at phases of its excitation and averaged over all its pieces of `n` periods.
//! The pieces scatter about their mean; that is what the measurement itself leaves open.
//!
//! **Lines.** The mean is kept by the lines of its spectrum that both the record and the samples of the
//! waveform hold: below 0.4 of the record's sampling rate, up to where values between its samples are known
//! ([`resample`](crate::resample)), and below half of the samples in a period. It is read at no fewer phases
//! than the record has samples, so that nothing is folded down from above. What is to be compared with it has
//! to be cut to the same lines ([`within_lines`]): an orbit shows more than a record does.
//!
//! **Laying over.** Two waveforms `a`, `b` of one length, about their means: with the coefficients `A_k`,
//! `B_k` of their Fourier series
//!
//! `r(s) = sum a(t) b(t - s) = (2/N) Re sum_{k = 1}^{k < N/2} A_k conj(B_k) exp(2 pi i k s/N)`
//!
//! is the product of `a` with `b` delayed by `s` samples. The shift is where `r` is largest: on the grid of
//! samples, then between them by Newton's method on `r'`, which is exact for series that their samples
//! determine; a step that overshoots is halved. With `aa`, `bb` the squares of both, the correlation is
//! `r/sqrt(aa bb)`, the factor that brings `a` closest to `b` is `r/aa`, and a factor `g` leaves the residual
//! `sqrt((g^2 aa - 2 g r + bb)/bb)` of the root mean square of `b`.
//!
//! | file | what |
//! |---|---|
//! | `folding.rs` | records folded onto periods |
//! | `laying.rs` | one waveform laid over another |

mod folding;
mod laying;

pub use folding::{Waveform, folded};
pub use laying::{Alignment, Shifts, align, delayed};

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
};

/// A periodic series at another number of samples, with no more than some lines of its spectrum.
///
/// * `length`: samples of the same stretch of time afterwards.
/// * `lines`: the highest line that is kept, in cycles over the stretch.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`]; [`SignalError::Input`] if half of the samples,
/// before or afterwards, do not hold so many lines.
pub fn within_lines(series: &[f64], length: usize, lines: usize) -> Result<Vec<f64>, SignalError> {
    ensure_series("cutting a waveform to lines", series, 1)?;
    let most = (series.len().min(length).max(1) - 1) / 2;
    ensure("the number of lines", lines as f64, format!("at most {most}"), lines <= most)?;
    let mut spectrum = forward(series.to_vec());
    spectrum.truncate(lines + 1);
    spectrum.resize(length / 2 + 1, Complex::new(0.0, 0.0));
    let scale = length as f64 / series.len() as f64;
    Ok(backward(spectrum, length).into_iter().map(|value| value * scale).collect())
}

#[cfg(test)]
mod tests;
