//! Options of the commands that follow motions: simulate, sweep, lyapunov, basins.

use std::{ops::RangeInclusive, path::PathBuf};

use clap::Args;
use hammerbeam_attractor::{Effort, Patience};
use hammerbeam_jobs::MOST_OF_A_STATE;

use crate::input_args::{StudyInput, excitation_frequency};

const INITIAL: &str = "State at phase 0: `rest`; `linear`, the motion without contacts; the 2n numbers \
q1,..,qn,v1,..,vn of the modal state; POINT.y=METRES,POINT.v=METRES_PER_SECOND,... for points in space, \
everything else moving as little as possible; or `branch:N` for the orbit in which that branch of --results \
crosses the frequency";

#[derive(Debug, Args)]
pub struct SimulateOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Excitation frequency; needed unless the study has no [excitation]
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub frequency: Option<f64>,

    /// Excitation periods that are written down [default: 10]
    #[arg(long, value_name = "N", value_parser = whole(1_u64..=100_000_000), allow_negative_numbers = true)]
    pub periods: Option<u64>,

    /// Time that is written down, in seconds: rounded up to whole excitation periods, or, without
    /// [excitation], to intervals of samples
    #[arg(
        long,
        value_name = "S",
        conflicts_with = "periods",
        value_parser = seconds,
        allow_negative_numbers = true,
    )]
    pub duration: Option<f64>,

    /// Excitation periods that are run first and not written down
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        value_parser = whole(0_u64..=100_000_000),
        allow_negative_numbers = true,
    )]
    pub transient_periods: u64,

    /// Samples in an excitation period [default: 100]
    #[arg(long, value_name = "N", value_parser = whole(1_u32..=1_000_000), allow_negative_numbers = true)]
    pub samples_per_period: Option<u32>,

    /// Samples in a second, for a study without [excitation] [default: 100 in a period of the lowest
    /// eigenfrequency]
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub sampling: Option<f64>,

    #[arg(long, value_name = "STATE", default_value = "rest", help = INITIAL, allow_hyphen_values = true)]
    pub initial: String,

    /// Phase of the stroboscopic section, from 0 to 1 cycles
    #[arg(
        long,
        value_name = "CYCLES",
        default_value_t = 0.0,
        value_parser = phase,
        allow_negative_numbers = true,
    )]
    pub section_phase: f64,

    /// Results folder whose branches are meant by --initial branch:N
    #[arg(long, value_name = "DIR")]
    pub results: Option<PathBuf>,

    /// Results folder, made if it is not there: keeps the motion, so that the same command goes on after an
    /// interruption, with samples.csv, contacts.csv and stroboscopic.csv
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct LyapunovOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Excitation frequency, or the first of a series
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub frequency: f64,

    /// Last frequency of a series, above the first, or the same for that one alone; the motion starts anew at
    /// each
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub to: Option<f64>,

    /// Step of the series [default: a hundredth of the way]
    #[arg(
        long,
        value_name = "HZ",
        requires = "to",
        value_parser = excitation_frequency,
        allow_negative_numbers = true,
    )]
    pub step: Option<f64>,

    /// Excitation periods averaged over, rounded up to a multiple of 20
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1000,
        value_parser = whole(20_u64..=100_000_000),
        allow_negative_numbers = true,
    )]
    pub periods: u64,

    /// Excitation periods that are run first
    #[arg(
        long,
        value_name = "N",
        default_value_t = 200,
        value_parser = whole(0_u64..=100_000_000),
        allow_negative_numbers = true,
    )]
    pub transient_periods: u64,

    /// Sections in a period to start with; each is cut further where tangent vectors grow too differently
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        value_parser = whole(1_u64..=1024),
        allow_negative_numbers = true,
    )]
    pub sections_per_period: u64,

    #[arg(long, value_name = "STATE", default_value = "rest", help = INITIAL, allow_hyphen_values = true)]
    pub initial: String,

    /// Results folder whose branches are meant by --initial branch:N
    #[arg(long, value_name = "DIR")]
    pub results: Option<PathBuf>,

    /// Results folder, made if it is not there: keeps the exponents, so that the same series goes on after an
    /// interruption, with spectra.csv, exponents.csv, convergence.csv and section.csv
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// What is spent on telling a motion's kind.
#[derive(Debug, Args)]
pub struct EffortOptions {
    /// Excitation periods in which a motion is not looked at
    #[arg(
        long,
        value_name = "N",
        default_value_t = 50,
        value_parser = whole(0_u64..=100_000_000),
        allow_negative_numbers = true,
    )]
    pub transient_periods: u64,

    /// Excitation periods after those in which a motion has to repeat
    #[arg(
        long,
        value_name = "N",
        default_value_t = 500,
        value_parser = whole(1_u64..=100_000_000),
        allow_negative_numbers = true,
    )]
    pub patience_periods: u64,

    /// Longest period looked for, in excitation periods
    #[arg(
        long,
        value_name = "N",
        default_value_t = 32,
        value_parser = whole(1_u16..=1024),
        allow_negative_numbers = true,
    )]
    pub longest_period: u16,

    /// Excitation periods over which exponents and the 0-1 test of a motion that does not repeat are taken
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1000,
        value_parser = whole(240_u64..=10_000_000),
        allow_negative_numbers = true,
    )]
    pub averaged_periods: u64,
}

impl From<&EffortOptions> for Effort {
    fn from(options: &EffortOptions) -> Self {
        let patience = Patience {
            skipped: options.transient_periods,
            periods: options.patience_periods,
            longest: usize::from(options.longest_period),
        };
        Self { patience, averaged: options.averaged_periods, ..Self::default() }
    }
}

impl EffortOptions {
    /// What of it is asked of the study, as lines `key = value`.
    pub fn words(&self) -> [String; 4] {
        [
            format!("transient_periods = {}", self.transient_periods),
            format!("patience_periods = {}", self.patience_periods),
            format!("longest_period = {}", self.longest_period),
            format!("averaged_periods = {}", self.averaged_periods),
        ]
    }
}

#[derive(Debug, Args)]
pub struct SweepOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// First frequency [default: the low end of the study's range]
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub from: Option<f64>,

    /// Last frequency, above the first, or the same for that one alone [default: the high end of the study's
    /// range]
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub to: Option<f64>,

    /// Step of the frequency [default: a hundredth of the way]
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub step: Option<f64>,

    /// Sweep down as well, from where the sweep up has ended
    #[arg(long)]
    pub down: bool,

    /// Instead of a sweep: start at N states at every frequency, the same ones each time
    #[arg(
        long,
        value_name = "N",
        conflicts_with_all = ["down", "initial"],
        value_parser = whole(1_u32..=100_000),
        allow_negative_numbers = true,
    )]
    pub starts: Option<u32>,

    #[arg(long, value_name = "STATE", default_value = "rest", help = INITIAL, allow_hyphen_values = true)]
    pub initial: String,

    /// Samples of a motion that does not repeat
    #[arg(
        long,
        value_name = "N",
        default_value_t = 64,
        value_parser = whole(1_u32..=100_000),
        allow_negative_numbers = true,
    )]
    pub samples: u32,

    #[command(flatten)]
    pub effort: EffortOptions,

    /// Results folder with which periodic motions are compared: the branch that each lies on
    #[arg(long, value_name = "DIR")]
    pub results: Option<PathBuf>,

    /// Results folder, made if it is not there: keeps the motions, so that the same command goes on after an
    /// interruption, with sweep.csv and sweep_samples.csv
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Number of threads with --starts [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = whole(1_u16..=u16::MAX), allow_negative_numbers = true)]
    pub jobs: Option<u16>,
}

#[derive(Debug, Args)]
pub struct BasinsOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Excitation frequency
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub frequency: f64,

    /// First coordinate and its range: q1 .. qn or v1 .. vn for modal displacements and velocities,
    /// displacement or velocity for those of the response point in the first mode
    #[arg(long, value_name = "NAME=LOW..HIGH", value_parser = axis)]
    pub x: AxisOption,

    /// Second coordinate and its range
    #[arg(long, value_name = "NAME=LOW..HIGH", value_parser = axis)]
    pub y: AxisOption,

    /// Cells along each coordinate
    #[arg(
        long,
        value_name = "N",
        default_value_t = 50,
        value_parser = whole(1_u32..=10_000),
        allow_negative_numbers = true,
    )]
    pub grid: u32,

    #[command(flatten)]
    pub effort: EffortOptions,

    /// Results folder whose branches the attractors are compared with [default: that of --out, if it holds
    /// branches]
    #[arg(long, value_name = "DIR")]
    pub results: Option<PathBuf>,

    /// Results folder, made if it is not there: keeps the cells, so that the same command goes on after an
    /// interruption, with basins.csv and attractors.csv
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Number of threads [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = whole(1_u16..=u16::MAX), allow_negative_numbers = true)]
    pub jobs: Option<u16>,
}

/// A coordinate and its range.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisOption {
    /// As it was given.
    pub name: String,
    /// Low end, in SI.
    pub low: f64,
    /// High end.
    pub high: f64,
}

fn axis(text: &str) -> Result<AxisOption, String> {
    let form = || {
        format!(
            "must be NAME=LOW..HIGH, as in q1=-1e-3..1e-3, with numbers from -{MOST_OF_A_STATE:e} to \
            {MOST_OF_A_STATE:e}"
        )
    };
    let (name, range) = text.split_once('=').ok_or_else(form)?;
    let (low, high) = range.split_once("..").ok_or_else(form)?;
    let number =
        |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.abs() <= MOST_OF_A_STATE);
    let (low, high) = number(low).zip(number(high)).ok_or_else(form)?;
    if high <= low {
        return Err(format!("the range {low}..{high} is empty; LOW must be below HIGH"));
    }
    Ok(AxisOption { name: name.trim().to_owned(), low, high })
}

/// A whole number in a range; a negative one is refused by that range as well.
fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: Copy + Into<i128> + TryFrom<i128>,
{
    let [low, high]: [i128; 2] = [(*range.start()).into(), (*range.end()).into()];
    move |text| {
        let number =
            text.parse::<i128>().map_err(|_| format!("must be a whole number from {low} to {high}"))?;
        let inside = (low..=high).contains(&number).then(|| T::try_from(number).ok()).flatten();
        inside.ok_or_else(|| format!("{number} is not in {low}..={high}"))
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (1e-15..=1e15).contains(&number) => Ok(number),
        _ => Err("must be a number of seconds from 1e-15 to 1e15".to_owned()),
    }
}

fn phase(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("must be a number of cycles from 0 to 1".to_owned()),
    }
}
