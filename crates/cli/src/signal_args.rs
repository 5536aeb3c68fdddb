//! Options of the `signal` commands.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

use crate::args::positive;

#[derive(Debug, Subcommand)]
pub enum SignalCommand {
    /// Filter channels, and resample them
    Filter(FilterOptions),
    /// Compute the spectrum of a channel, and its lines
    Spectrum(SpectrumOptions),
}

/// What to read, and how.
#[derive(Debug, Args)]
pub struct InputOptions {
    /// Time series: CSV, universal file (dataset 58), WAV, NumPy (.npy, .npz) or MATLAB (.mat up to -v7)
    pub file: PathBuf,

    /// Channel, by its name or its number from 1 on; may be given several times [default: filter takes all, other commands the first]
    #[arg(long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Sampling rate; times in the file are not used then
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub rate: Option<f64>,

    /// Time of the first sample to take
    #[arg(long, value_name = "S", value_parser = number, allow_negative_numbers = true)]
    pub from: Option<f64>,

    /// Time of the last sample to take
    #[arg(long, value_name = "S", value_parser = number, allow_negative_numbers = true)]
    pub to: Option<f64>,

    /// What may be repaired instead of being refused
    #[arg(long, value_enum, value_name = "WHAT", value_delimiter = ',')]
    pub repair: Vec<Repair>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Repair {
    /// Interpolate missing samples
    Missing,
    /// Fill gaps in time by interpolation
    Gaps,
    /// Interpolate uneven samples to an even grid
    Uneven,
    /// Drop samples with a time that was there before
    Duplicates,
    /// Sort by time
    Order,
    /// Cut channels to the shortest
    Lengths,
}

#[derive(Debug, Args)]
pub struct FilterOptions {
    #[command(flatten)]
    pub input: InputOptions,

    #[command(flatten)]
    pub band: BandOptions,

    /// Filter once, as an instrument does, with its delay [default: forwards and backwards, without phase]
    #[arg(long)]
    pub causal: bool,

    /// Resample to this rate after filtering
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub resample: Option<f64>,

    /// Folder; filtered.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// A Butterworth filter.
#[derive(Debug, Args)]
pub struct BandOptions {
    /// Cut-off of a low-pass filter (Butterworth); with --high-pass a band-pass filter
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub low_pass: Option<f64>,

    /// Cut-off of a high-pass filter
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub high_pass: Option<f64>,

    /// Order of the filter
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=32))]
    pub order: u32,
}

#[derive(Debug, Args)]
pub struct SpectrumOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// What the values are
    #[arg(long, value_enum, default_value_t = SpectrumKind::Amplitude)]
    pub kind: SpectrumKind,

    /// Window
    #[arg(long, value_enum, default_value_t = WindowName::Hann)]
    pub window: WindowName,

    /// Samples of a segment, for density and power [default: an eighth of the record]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(2..))]
    pub segment: Option<u64>,

    /// Part of a segment that the next one shares, 0 to 0.95
    #[arg(long, value_name = "PART", default_value_t = 0.5, value_parser = overlap, allow_negative_numbers = true)]
    pub overlap: f64,

    /// What is taken off each segment, for density and power
    #[arg(long, value_enum, default_value_t = DetrendName::Constant)]
    pub detrend: DetrendName,

    /// Lines to list, the highest first
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub lines: usize,

    /// Folder; spectrum.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SpectrumKind {
    /// Amplitudes of lines, of the whole record
    Amplitude,
    /// Spectral density, averaged over segments (Welch)
    Density,
    /// Power of lines, averaged over segments (Welch)
    Power,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum WindowName {
    Rectangular,
    Hann,
    Hamming,
    Blackman,
    FlatTop,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DetrendName {
    None,
    Constant,
    Linear,
}

pub fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err("must be a finite number".to_owned()),
    }
}

fn overlap(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (0.0..=0.95).contains(&number) => Ok(number),
        _ => Err("must be a number from 0 to 0.95".to_owned()),
    }
}
