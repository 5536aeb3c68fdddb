//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use hammerbeam_jobs::{run::RunOrigin, verify::TOLERANCE};
use hammerbeam_orbit::BranchEventKind;
use hammerbeam_results::arrays::TableFormat;
use hammerbeam_study::Setting;

use crate::{
    compare_args::{CompareOptions, RigOptions},
    figure_args::FigureOptions,
    input_args::{StudyInput, excitation_frequency, positive},
    motion_args::{BasinsOptions, LyapunovOptions, SimulateOptions, SweepOptions},
    overlay_args::OverlayOptions,
    signal_args::SignalCommand,
};

const AFTER: &str = "Exit codes: 0 done, 1 no result, 2 bad input, 3 verify found disagreements, 130 \
interrupted (what is finished is kept).";

/// The version and, of a release, the commit that it was built from.
const VERSION: &str = env!("HAMMERBEAM_VERSION");

/// Steady states of structures that hit things.
///
/// Describe a linear structure with stops, gaps and local springs in a study file, and compute all of its
/// periodic responses over the excitation frequency, stable and unstable.
#[derive(Debug, Parser)]
#[command(name = "hammerbeam", version = VERSION, after_help = AFTER, arg_required_else_help = true)]
pub struct Arguments {
    /// Print one JSON document on standard output and nothing else there
    #[arg(long, global = true)]
    pub json: bool,

    /// Show frequencies in rad/s in texts and figures; tables, documents and page.html keep hertz
    #[arg(long, global = true)]
    pub angular: bool,

    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write a commented starter study into a folder
    New(NewOptions),
    /// Read and validate a study, and print what was understood
    Check(StudyOptions),
    /// Print the eigenfrequencies: unreduced, of the reduction basis, and reduced
    Modes(ModesOptions),
    /// Convert matrices of a finite element program, or the structure of a study, into a bundle of files
    Import(ImportOptions),
    /// Compute everything a study asks for into a results folder; started again, it goes on where it was
    Run(RunOptions),
    /// Compute the periodic solutions at one frequency
    Orbit(OrbitOptions),
    /// Follow a motion in time, with every contact; started again, it goes on where it was
    Simulate(SimulateOptions),
    /// Settled motions over the frequency: stepped sweeps, or from many initial states
    Sweep(SweepOptions),
    /// Compute the Lyapunov exponents of a motion
    Lyapunov(LyapunovOptions),
    /// Compute which attractor each of a grid of initial states leads to; started again, it goes on where it
    /// was
    Basins(BasinsOptions),
    /// Fit parameters of a study to measured eigenfrequencies, damping ratios and responses
    Update(UpdateOptions),
    /// Measured or exported time series: filter, spectrum, damping, kind of motion, exponent
    #[command(subcommand)]
    Signal(SignalCommand),
    /// Hold measured points against computed branches
    Compare(CompareOptions),
    /// Lay a recorded motion over the computed orbit that is most alike
    Overlay(OverlayOptions),
    /// Measure a virtual rig, another model than that of the study, and hold it against the study's branches
    Rig(RigOptions),
    /// Draw everything that a results folder holds, as SVG and PNG
    Figure(FigureOptions),
    /// Write stored results for other programs
    Export(ExportOptions),
    /// Compute stored solutions again with the independent integrator, and report every disagreement
    Verify(VerifyOptions),
    /// Print what a shell needs to complete commands and flags
    Completions(CompletionsOptions),
    /// Print the manual page, or write the pages of all commands into a folder
    Man(ManOptions),
}

#[derive(Debug, Args)]
pub struct NewOptions {
    /// Folder, made if it is not there; study.toml is written into it
    pub folder: PathBuf,
}

#[derive(Debug, Args)]
pub struct StudyOptions {
    #[command(flatten)]
    pub study: StudyInput,
}

#[derive(Debug, Args)]
pub struct ModesOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Folder, made if it is not there, into which the structure, its modes, the error of the reduction and
    /// the excitation are drawn
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct ImportOptions {
    /// Files of the program (stiffness, mass, damping, labels of rows, nodes), known by their names and
    /// content; or a study, whose structure is exported
    pub files: Vec<PathBuf>,

    /// Give a key of the study another value, see `hammerbeam check --help`
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<Setting>,

    /// Folder, made if it is not there, for K.mtx, M.mtx, C.mtx, dofs.csv, nodes.csv and lines.csv
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,

    /// The file of the stiffness matrix
    #[arg(long, value_name = "FILE")]
    pub stiffness: Option<PathBuf>,

    /// The file of the mass matrix
    #[arg(long, value_name = "FILE")]
    pub mass: Option<PathBuf>,

    /// The file of the damping matrix
    #[arg(long, value_name = "FILE")]
    pub damping: Option<PathBuf>,

    /// The file that says what rows are: .dof, .csv, or .pch and .asm with EXTRN
    #[arg(long, value_name = "FILE")]
    pub dofs: Option<PathBuf>,

    /// The file of nodes: .csv, .inp, or bulk data with GRID
    #[arg(long, value_name = "FILE")]
    pub nodes: Option<PathBuf>,

    /// Name of the stiffness matrix in its file [default: found out]
    #[arg(long, value_name = "NAME")]
    pub stiffness_matrix: Option<String>,

    /// Name of the mass matrix in its file [default: found out]
    #[arg(long, value_name = "NAME")]
    pub mass_matrix: Option<String>,

    /// Format of the matrices [default: found out]
    #[arg(
        long,
        value_name = "FORMAT",
        value_parser = clap::builder::PossibleValuesParser::new(hammerbeam_matrices::MatrixFormat::names()),
    )]
    pub format: Option<String>,

    /// Factor that brings the stiffness to N/m
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    pub stiffness_factor: f64,

    /// Factor that brings the mass to kg
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    pub mass_factor: f64,

    /// Factor that brings the damping to N s/m
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    pub damping_factor: f64,

    /// Factor that brings places of nodes to m
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    pub length_factor: f64,

    /// Memory that matrices, factors and the search for modes may take [GB]
    #[arg(long, value_name = "GB", default_value_t = 4.0, value_parser = positive)]
    pub memory_gb: f64,
}

#[derive(Debug, Args)]
pub struct RunOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Results folder, made if it is not there; one that holds part of the same study is continued
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,

    /// Run a family of studies, one for each of these values of a key, each into a folder of its own in the
    /// results folder; of several keys all combinations
    #[arg(long, value_name = "KEY=VALUE,VALUE,...")]
    pub vary_set: Vec<Setting>,

    /// Also start branches at the periodic motions that `sweep` and `basins` have stored in this results
    /// folder and that no branch holds; or at a special point of its branches, by the number that page.html
    /// shows: results:12; may be given several times
    #[arg(long, value_name = "DIR[:POINT]", value_parser = origin)]
    pub from: Vec<RunOrigin>,

    /// Draw nothing, as for a family on a cluster; `hammerbeam figure` draws the same later
    #[arg(long)]
    pub no_figures: bool,

    /// Number of threads [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
}

#[derive(Debug, Args)]
pub struct OrbitOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Excitation frequency
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub frequency: f64,

    /// Orbit period over excitation period; solutions of a shorter period are not given
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub period_multiple: u32,

    /// Folder, made if it is not there, into which each solution is drawn: over its period, in the phase
    /// plane, and its spectrum
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Draw the acceleration behind a low-pass filter as well [default: that of the study]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true, requires = "out")]
    pub low_pass: Option<f64>,
}

#[derive(Debug, Args)]
pub struct UpdateOptions {
    #[command(flatten)]
    pub study: StudyInput,

    /// Data file: the parameters to fit, and what was measured; docs/how-to/fit-to-measurements.md has its
    /// keys
    pub data: PathBuf,

    /// Folder, made if it is not there, for the updated study (updated.toml) and the result (update.json)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Probability in percent that an interval holds its parameter
    #[arg(long, value_name = "PERCENT", default_value_t = 95.0, value_parser = percent)]
    pub confidence: f64,

    /// Further starts around that of the data file; the lowest minimum is taken [default: 6, or 0 with
    /// responses]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(..=10_000))]
    pub starts: Option<u32>,

    /// Also take intervals from the profile of chi-squared, which holds where the model bends; takes many
    /// more fits
    #[arg(long)]
    pub profile: bool,
}

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("orbits").args(["frequency", "event"]).multiple(true))]
pub struct ExportOptions {
    /// Results folder
    pub results: PathBuf,

    /// Format: csv writes branches.csv, one row per solution, and a file for each further table; json and npz
    /// write one file, by columns; MAT, Parquet and HDF5 are written from Python
    #[arg(long, value_enum)]
    pub format: Format,

    /// Write states.csv as well, and parameter_states.csv and curve_states.csv where there are such branches
    /// and curves: the state and all multipliers of every solution
    #[arg(long)]
    pub states: bool,

    /// Write the orbits in which branches cross this frequency, with their motion at all points, states and
    /// multipliers, as orbits and waveforms; may be given several times
    #[arg(long, value_name = "HZ", value_parser = excitation_frequency, allow_negative_numbers = true)]
    pub frequency: Vec<f64>,

    /// Write the orbits with this event in the same way: fold, flip, neimark-sacker, branch-point, grazing,
    /// start or end; may be given several times
    #[arg(long, value_name = "NAME", value_parser = event_kind)]
    pub event: Vec<BranchEventKind>,

    /// Of these orbits, only those of this branch; may be given several times
    #[arg(long, value_name = "N", requires = "orbits")]
    pub branch: Vec<u32>,

    /// Samples of each of these orbits in an excitation period
    #[arg(
        long,
        value_name = "N",
        requires = "orbits",
        default_value_t = 256,
        value_parser = clap::value_parser!(u32).range(1..=1_000_000),
    )]
    pub samples: u32,

    /// Folder to write into [default: RESULTS/export]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// An event by its name.
fn event_kind(text: &str) -> Result<BranchEventKind, String> {
    BranchEventKind::of_branches(text).ok_or_else(|| {
        let known = BranchEventKind::OF_BRANCHES.map(BranchEventKind::name);
        format!("must be one of {}", known.join(", "))
    })
}

#[derive(Debug, Args)]
pub struct VerifyOptions {
    /// Results folder
    pub results: PathBuf,

    /// Number of solutions, chosen at random over all branches
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..))]
    pub sample: u64,

    /// Verify every solution
    #[arg(long, conflicts_with_all = ["sample", "seed"])]
    pub all: bool,

    /// Another seed is another sample
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,

    /// Largest relative difference; docs/reference/verify.md has the formulae
    #[arg(long, value_name = "T", default_value_t = TOLERANCE, value_parser = tolerance)]
    pub tolerance: f64,

    /// Number of threads; the result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: u16,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Format {
    /// Comma-separated values
    Csv,
    /// One JSON document
    Json,
    /// Record arrays of NumPy
    Npz,
}

impl From<Format> for TableFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Csv => Self::Csv,
            Format::Json => Self::Json,
            Format::Npz => Self::Npz,
        }
    }
}

fn origin(text: &str) -> Result<RunOrigin, std::convert::Infallible> {
    Ok(RunOrigin::of(text))
}

fn percent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (1.0..100.0).contains(&number) => Ok(number),
        _ => Err("must be a number of percent, from 1 to less than 100".to_owned()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (1e-11..=1e-2).contains(&number) => Ok(number),
        _ => Err("must be a number from 1e-11 to 1e-2".to_owned()),
    }
}

#[derive(Debug, Args)]
pub struct CompletionsOptions {
    /// Shell, whose documentation says where the script belongs
    pub shell: Shell,
}

#[derive(Debug, Args)]
pub struct ManOptions {
    /// Folder, made if it is not there, into which the pages of all commands are written, for `man`
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
