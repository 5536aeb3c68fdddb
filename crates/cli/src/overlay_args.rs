//! Options of `overlay`.

use std::path::PathBuf;

use clap::Args;

use crate::{
    input_args::positive,
    numbers::{not_zero, positive_number, within},
    signal_args::{InputOptions, Sensor},
};

#[derive(Debug, Args)]
pub struct OverlayOptions {
    /// Results folder of a run
    pub results: PathBuf,

    #[command(flatten)]
    pub input: InputOptions,

    /// Excitation frequency of the measurement [default: the number before "Hz" in the file's name]
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

    /// Orbit period over excitation period [default: that of the measurement, if it is periodic]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub period: Option<u32>,

    /// What the sensor measures, where the unit of the channel does not say
    #[arg(long, value_enum)]
    pub sensor: Option<Sensor>,

    /// Point of the structure where the sensor is [default: the response point of the study]
    #[arg(long, value_name = "NAME")]
    pub point: Option<String>,

    /// Put the orbits behind the low-pass filter of the measurement (Butterworth)
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub low_pass: Option<f64>,

    /// Order of that filter
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=32))]
    pub order: u32,

    /// That filter acted forwards and backwards, without phase [default: causal, as in an instrument]
    #[arg(long, requires = "low_pass")]
    pub zero_phase: bool,

    /// Frequencies of the model over those of the measurement, as `compare` fits it
    #[arg(
        long,
        value_name = "C",
        default_value_t = 1.0,
        value_parser = positive_number,
        allow_negative_numbers = true,
    )]
    pub frequency_factor: f64,

    /// How far from that frequency orbits are tried, in percent of it
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 8.0,
        value_parser = within,
        allow_negative_numbers = true,
    )]
    pub within: f64,

    /// Frequency of the orbit, instead
    #[arg(
        long,
        value_name = "HZ",
        value_parser = positive,
        allow_negative_numbers = true,
        conflicts_with_all = ["frequency_factor", "within"],
    )]
    pub at: Option<f64>,

    /// Branch of the orbit, by its number [default: all]
    #[arg(long, value_name = "N")]
    pub branch: Option<u32>,

    /// Factor on measured values; negative for a sensor turned around [default: fitted, and positive]
    #[arg(long, value_name = "A", value_parser = not_zero, allow_negative_numbers = true)]
    pub amplitude_factor: Option<f64>,

    /// Folder; overlay.csv is written into it
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
