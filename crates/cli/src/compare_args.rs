//! Options of the commands that hold measurements against branches: compare, rig.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::{
    input_args::{StudyInput, positive},
    numbers::{above_one, number, positive_number},
};

#[derive(Debug, Args)]
pub struct CompareOptions {
    /// Results folder of a run
    pub results: PathBuf,

    /// Tables of measured points (CSV with units in its titles), records of single frequencies, or folders of
    /// records
    #[arg(required = true)]
    pub measured: Vec<PathBuf>,

    /// Quantities that are compared [default: all that were measured]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT")]
    pub quantity: Vec<QuantityName>,

    /// Factor on measured frequencies [default: fitted]
    #[arg(long, value_name = "C", value_parser = positive_number, allow_negative_numbers = true)]
    pub frequency_factor: Option<f64>,

    /// Offset added to measured frequencies, instead of a factor
    #[arg(long, value_name = "HZ", conflicts_with = "frequency_factor", value_parser = number, allow_negative_numbers = true)]
    pub frequency_offset: Option<f64>,

    /// Fit an offset of the frequency instead of a factor, from -15 to 18 % of the median frequency of the
    /// points
    #[arg(long, conflicts_with_all = ["frequency_factor", "frequency_offset"])]
    pub fit_offset: bool,

    /// Factor on measured values [default: fitted]
    #[arg(long, value_name = "A", value_parser = positive_number, allow_negative_numbers = true)]
    pub amplitude_factor: Option<f64>,

    /// Ratio of values up to which a branch explains a point
    #[arg(long, value_name = "RATIO", default_value_t = 1.5, value_parser = above_one, allow_negative_numbers = true)]
    pub reach: f64,

    /// Point of the structure where the sensor is [default: the response point of the study, whose maxima are
    /// stored]; needs --out, since RESULTS/compare is what the page lays over the response point
    #[arg(long, value_name = "NAME", requires = "out")]
    pub point: Option<String>,

    /// Compare with an output of the study ([[output]]): measured values of its quantity with its largest
    /// magnitudes; needs --out, as --point does
    #[arg(
        long,
        value_name = "NAME",
        requires = "out",
        conflicts_with_all = ["point", "quantity", "low_pass"]
    )]
    pub output: Option<String>,

    /// Put the branches behind the low-pass filter of the measurement (Butterworth)
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub low_pass: Option<f64>,

    /// Order of that filter
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=32))]
    pub order: u32,

    /// Of records: channel, by name or number from 1 on, that is excited; its strongest line is the
    /// excitation frequency [default: the number before "Hz" in the file's name is]
    #[arg(long, value_name = "NAME")]
    pub reference: Option<String>,

    /// Folder to write into [default: RESULTS/compare]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct RigOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Results folder, made if it is not there; branches of the same study that it holds are taken as they
    /// are
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,

    /// Number of threads [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
}

/// A quantity that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum QuantityName {
    /// Maximum displacement
    Displacement,
    /// Maximum velocity, computed again from stored orbits
    Velocity,
    /// Maximum acceleration
    Acceleration,
    /// Maximum contact force
    Force,
}
