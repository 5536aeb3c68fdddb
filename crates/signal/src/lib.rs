//! Measured and computed time series.
//!
//! This crate handles series of numbers over time and does not depend on structures, contacts or orbits. The
//! content of a file is a [`raw::RawRecord`]. Validation makes it a [`Record`] (even sampling, SI units,
//! nothing missing) or refuses it. All evaluations are functions of plain slices:
//!
//! ```
//! use hammerbeam_signal::{
//!     RecordOptions,
//!     filter::{Band, butterworth},
//!     read::parse,
//!     spectrum::{Window, amplitude_spectrum},
//! };
//!
//! let text: String = (0..1000).map(|k| format!("{};{}\n", k, (0.1257 * f64::from(k)).sin())).collect();
//! let raw = parse(format!("time [ms];a [g]\n{text}").as_bytes())?;
//! let record = raw.validate(&RecordOptions::default())?;
//! let rate = record.sampling_rate_hz;
//! assert!((rate - 1000.0).abs() < 1e-9);
//! let filter = butterworth(4, Band::LowPass { cut_off_hz: 50.0 }, rate)?;
//! let filtered = filter.zero_phase(&record.channels[0].samples)?;
//! let line = amplitude_spectrum(&filtered, rate, Window::Hann)?.lines(1, 3)[0];
//! assert!((line.frequency_hz - 20.0).abs() < 0.1 && (line.value - 9.80665).abs() < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Modules depend on those above them in this table only, and on files of their own folder:
//!
//! | file | what |
//! |---|---|
//! | `limits.rs`, `text.rs` | largest files and records; text of messages |
//! | `error/` | all errors |
//! | `unit.rs`, `title.rs` | units and quantities; titles of columns with units |
//! | `random.rs` | random numbers from a seed |
//! | `fourier.rs` | discrete Fourier transforms |
//! | `finding.rs` | findings about a record, permitted repairs |
//! | `raw.rs`, `record.rs` | content of a file; validated record |
//! | `validation/` | from the one to the other: even sampling, gaps, missing samples, clipping |
//! | `read/` | CSV, universal files, WAV, NumPy, MATLAB |
//! | `points/` | tables of measured points: maxima over the excitation frequency |
//! | `filter/` | Butterworth filters, causal and zero-phase |
//! | `resample/` | by rational factors, by the spectrum, at arbitrary times |
//! | `spectrum/` | amplitudes, power, densities; windows |
//! | `envelope.rs` | the analytic signal |
//! | `decay/` | eigenfrequencies and damping of free decays |
//! | `classify/` | whether a motion is periodic, and its period |
//! | `exponent/` | the largest Lyapunov exponent |
//! | `waveform/` | records folded onto periods, alignment of waveforms |
//! | `chain/` | the response of a measuring chain to a computed motion |
//!
//! The formulas are in these files and, for users, in `docs/how-to/process-signals.md`. Errors are
//! [`SignalError`].

pub mod chain;
pub mod classify;
pub mod decay;
pub mod envelope;
mod error;
pub mod exponent;
pub mod filter;
mod finding;
mod fourier;
pub mod limits;
pub mod points;
pub mod random;
pub mod raw;
pub mod read;
mod record;
pub mod resample;
pub mod spectrum;
pub mod text;
mod title;
pub mod unit;
pub mod validation;
pub mod waveform;

pub use error::{PointsError, ReadError, RecordError, SignalError};
pub use finding::{RecordFinding, Repairs};
pub use read::RecordFormat;
pub use record::{Channel, Record};
pub use unit::MeasuredQuantity;
pub use validation::RecordOptions;
