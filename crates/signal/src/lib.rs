//! Measured and computed time series.
//!
//! This crate knows series of numbers in time and nothing of structures, contacts or orbits. A file becomes a
//! [`raw::RawRecord`] (what it says), that becomes a [`Record`] (even sampling, SI units, nothing missing; or
//! a refusal), and functions of plain slices do the rest:
//!
//! ```
//! use hammerbeam_signal::{Terms, filter::{Band, butterworth}, read::parse, spectrum::{Window, amplitude_spectrum}};
//!
//! let text: String = (0..1000).map(|k| format!("{};{}\n", k, (0.1257 * f64::from(k)).sin())).collect();
//! let record = parse(format!("time [ms];a [g]\n{text}").as_bytes())?.judge(&Terms::default())?;
//! let rate = record.sampling_rate_hz;
//! assert!((rate - 1000.0).abs() < 1e-9);
//! let filter = butterworth(4, Band::LowPass { cut_off_hz: 50.0 }, rate)?;
//! let filtered = filter.zero_phase(&record.channels[0].samples)?;
//! let line = amplitude_spectrum(&filtered, rate, Window::Hann)?.lines(1, 3)[0];
//! assert!((line.frequency_hz - 20.0).abs() < 0.1 && (line.value - 9.80665).abs() < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file | what |
//! |---|---|
//! | `unit.rs` | units as people write them |
//! | `limits.rs` | what is read and made at most |
//! | `raw.rs`, `record.rs` | what a file says; what is worked with |
//! | `read/` | CSV, universal files, WAV, NumPy, MATLAB |
//! | `points/` | tables of measured points: maxima over the excitation frequency |
//! | `judge/`, `finding.rs` | is the sampling even, is anything missing or suspicious; what may be repaired |
//! | `filter/` | Butterworth filters, causal and without phase |
//! | `resample/` | by rational factors, by the spectrum, at any place |
//! | `spectrum/`, `fourier.rs` | amplitudes, power, densities; windows |
//! | `envelope.rs` | the analytic signal |
//! | `decay/` | eigenfrequencies and damping of free decays |
//! | `classify/` | periodic or not, and in which period |
//! | `exponent/` | the largest Lyapunov exponent |
//! | `waveform/` | records folded onto periods, one waveform laid over another |
//! | `chain/` | what an instrument would have shown of a computed motion |
//! | `random.rs` | noise from a seed |
//!
//! The formulas stand in these files and, for users, in `docs/how-to/process-signals.md`. Errors are [`SignalError`].

pub mod chain;
pub mod classify;
pub mod decay;
pub mod envelope;
mod error;
pub mod exponent;
pub mod filter;
mod finding;
mod fourier;
pub mod judge;
pub mod limits;
pub mod points;
pub mod random;
pub mod raw;
pub mod read;
mod record;
pub mod resample;
pub mod spectrum;
pub mod unit;
pub mod waveform;

pub use error::SignalError;
pub use finding::{Finding, Repairs};
pub use judge::{RecordError, Terms};
pub use read::{Format, ReadError};
pub use record::{Channel, Record};
pub use unit::Quantity;
