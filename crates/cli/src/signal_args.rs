//! Options of the `signal` commands.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use hammerbeam_signal::exponent::StraightPart;

use crate::{
    input_args::positive,
    numbers::{not_negative, number, overlap, part, straight_part},
};

#[derive(Debug, Subcommand)]
pub enum SignalCommand {
    /// Filter channels, and resample them
    Filter(FilterOptions),
    /// Compute the spectrum of a channel, and its lines
    Spectrum(SpectrumOptions),
    /// Find eigenfrequencies and damping of a free decay, with intervals of 95 %
    Decrement(DecrementOptions),
    /// Classify a motion: whether it is periodic, and in which multiple of the excitation period
    Classify(ClassifyOptions),
    /// Compute the largest Lyapunov exponent of a channel
    Lyapunov(ExponentOptions),
    /// Compute the envelope of a channel
    Envelope(EnvelopeOptions),
    /// Put a computed motion through a measuring chain: sensor, filter, sampling, noise
    Chain(ChainOptions),
}

/// What to read, and how.
#[derive(Debug, Args)]
pub struct InputOptions {
    /// Time series: CSV, universal file (dataset 58), WAV, NumPy (.npy, .npz) or MATLAB (.mat up to -v7)
    pub file: PathBuf,

    /// Channel, by its name or its number from 1 on; may be given several times [default: filter takes all,
    /// other commands the first displacement, velocity, acceleration or force]
    #[arg(long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Sampling rate; times in the file are not used then
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub rate: Option<f64>,

    /// Column that is the time, by its name or number [default: one that is named so, or in a unit of time]
    #[arg(long, value_name = "NAME", conflicts_with = "rate")]
    pub time: Option<String>,

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
    #[arg(
        long,
        value_name = "PART",
        default_value_t = 0.5,
        value_parser = overlap,
        allow_negative_numbers = true,
    )]
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

#[derive(Debug, Args)]
pub struct DecrementOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// Number of modes to fit [default: all that stand out of the noise, up to 6]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20))]
    pub modes: Option<u32>,

    /// Lowest frequency to look at
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub above: Option<f64>,

    /// Highest frequency to look at
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub below: Option<f64>,
}

#[derive(Debug, Args)]
pub struct ClassifyOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// Excitation frequency
    #[arg(
        long,
        value_name = "HZ",
        value_parser = positive,
        allow_negative_numbers = true,
        conflicts_with = "reference",
    )]
    pub frequency: Option<f64>,

    /// Channel that shows the excitation; its strongest line is the excitation frequency
    #[arg(long, value_name = "NAME")]
    pub reference: Option<String>,

    /// Largest period multiple that is looked at
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub multiples: u32,

    /// Deviation up to which a motion is periodic; docs/how-to/process-signals.md has the formula
    #[arg(long, value_name = "D", default_value_t = 0.05, value_parser = part, allow_negative_numbers = true)]
    pub periodic_below: f64,

    /// Deviation from which on a motion is aperiodic
    #[arg(long, value_name = "D", default_value_t = 0.2, value_parser = part, allow_negative_numbers = true)]
    pub aperiodic_above: f64,
}

#[derive(Debug, Args)]
pub struct ExponentOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// Method
    #[arg(long, value_enum, default_value_t = Method::All)]
    pub method: Method,

    /// Delay between coordinates, in samples [default: from mutual information and autocorrelation]
    #[arg(long, value_name = "SAMPLES", value_parser = clap::value_parser!(u32).range(1..))]
    pub delay: Option<u32>,

    /// Number of coordinates [default: by false nearest neighbours]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20))]
    pub dimension: Option<u32>,

    /// Neighbours have to be further apart in time than this, in samples [default: the mean period]
    #[arg(long, value_name = "SAMPLES")]
    pub theiler_window: Option<u32>,

    /// Samples for which neighbours are followed [default: seven mean periods, doubled until distances grow
    /// no more; 25 samples of a map]
    #[arg(long, value_name = "SAMPLES", value_parser = clap::value_parser!(u32).range(4..))]
    pub steps: Option<u32>,

    /// First and last sample of the straight part, as in 40:150, or "period" for the steepest mean period
    /// after the first [default: it is looked for]
    #[arg(long, value_name = "FROM:TO", value_parser = straight_part)]
    pub fit: Option<StraightPart>,

    /// Evolution time of Wolf's method, in samples [default: a part of the mean period]
    #[arg(long, value_name = "SAMPLES", value_parser = clap::value_parser!(u32).range(1..))]
    pub evolution: Option<u32>,

    /// Folder; divergence.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// All three
    All,
    /// Wolf et al. 1985, fixed evolution time
    Wolf,
    /// Rosenstein et al. 1993
    Rosenstein,
    /// Kantz 1994
    Kantz,
}

#[derive(Debug, Args)]
pub struct EnvelopeOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// The filter before it, forwards and backwards
    #[command(flatten)]
    pub band: BandOptions,

    /// Folder; envelope.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct ChainOptions {
    #[command(flatten)]
    pub input: InputOptions,

    /// What the sensor measures
    #[arg(long, value_enum, default_value_t = Sensor::Acceleration)]
    pub sensor: Sensor,

    /// The file holds whole periods of a motion that repeats, as an orbit does
    #[arg(long)]
    pub periodic: bool,

    #[command(flatten)]
    pub band: BandOptions,

    /// Filter forwards and backwards, without phase [default: causal, as an instrument does]
    #[arg(long)]
    pub zero_phase: bool,

    /// Sampling rate of the measurement [default: that of the file]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub sampling: Option<f64>,

    /// Standard deviation of the noise, in the sensor's SI unit
    #[arg(
        long,
        value_name = "RMS",
        default_value_t = 0.0,
        value_parser = not_negative,
        allow_negative_numbers = true,
    )]
    pub noise: f64,

    /// Another seed is other noise
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,

    /// Range of the converter, in the sensor's SI unit; what is beyond is clipped
    #[arg(
        long,
        value_name = "MAX",
        value_parser = not_negative,
        allow_negative_numbers = true,
        requires = "bits",
    )]
    pub range: Option<f64>,

    /// Bits of the converter
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=32), requires = "range")]
    pub bits: Option<u32>,

    /// Folder; measured.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sensor {
    Displacement,
    Velocity,
    Acceleration,
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
