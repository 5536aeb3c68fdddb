//! Spectra: amplitudes of lines, power and spectral densities.
//!
//! With window `w`, `X_k = sum_n w_n x_n exp(-2 pi i k n / N)`, one-sided (`c_k = 2`, but 1 at zero and at
//! half the sampling rate):
//!
//! * amplitude `c_k |X_k| / sum w`: a harmonic signal on a line shows its amplitude [unit];
//! * power `c_k |X_k|² / (sum w)²`: half the square of that amplitude [unit²];
//! * density `c_k |X_k|² / (f_s sum w²)`: its integral over the frequency is the mean square [unit²/Hz].
//!
//! | file | what |
//! |---|---|
//! | `window.rs` | windows |
//! | `amplitude.rs` | amplitudes of a whole record; its lines |
//! | `welch.rs` | averages over overlapping segments |
//!
//! # Source
//! Welch, IEEE Trans. Audio Electroacoust. 15 (1967), 70-73.

mod amplitude;
mod welch;
mod window;

pub use amplitude::{FrequencySpectrum, SpectralLine, amplitude_spectrum};
pub use welch::{Detrend, Scaling, WelchSettings, welch};
pub use window::Window;
