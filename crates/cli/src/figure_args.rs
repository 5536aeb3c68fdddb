//! Flags of `figure`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hammerbeam_drawing::{FigureDetail, FigureFormat, FigureKind, FigureScale, RESOLUTION};
use hammerbeam_study::file::DrawnOrbit;

use crate::input_args::{hertz, positive};

#[derive(Debug, Args)]
pub struct FigureOptions {
    /// Results folder
    pub results: PathBuf,

    /// Folder to draw into, made if it is not there [default: RESULTS]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Draw these alone; may be given several times [default: all]
    #[arg(long, value_enum, value_delimiter = ',')]
    pub kind: Vec<KindName>,

    /// Formats of the figures; may be given several times
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = FormatName::USUAL)]
    pub format: Vec<FormatName>,

    /// Scale of the vertical axis of response diagrams
    #[arg(long, value_enum, default_value_t = ScaleName::Automatic)]
    pub scale: ScaleName,

    /// Draw a crowded part of response diagrams again below, larger: 84:93 of the frequency in hertz,
    /// excitation.amplitude_n=0.2:0.3 of a `[[vary]]`, in the unit of its key; once for each axis
    #[arg(long, value_name = "[PARAMETER=]FROM:TO", value_parser = detail)]
    pub detail: Vec<FigureDetail>,

    /// Lay the response diagrams of a further results folder over these, as thin lines; may be given several
    /// times
    #[arg(long, value_name = "DIR")]
    pub with: Vec<PathBuf>,

    /// Draw the orbit in which a branch crosses a frequency: HZ, or HZ:N for one of N excitation periods; may
    /// be given several times [default: those of the study]
    #[arg(long, value_name = "HZ[:N]", value_parser = orbit)]
    pub orbit: Vec<DrawnOrbit>,

    /// Resolution of the PNG files, in pixels per inch
    #[arg(long, value_name = "PPI", default_value_t = RESOLUTION, value_parser = resolution)]
    pub resolution: f64,

    /// Draw accelerations of orbits behind a low-pass filter as well [default: that of the study]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub low_pass: Option<f64>,

    /// Number of threads [default: all cores]; the files do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
}

/// Format of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FormatName {
    /// Scalable Vector Graphics
    Svg,
    /// Portable Network Graphics, of pixels
    Png,
    /// Portable Document Format
    Pdf,
}

impl FormatName {
    /// What is drawn where none is asked for.
    pub const USUAL: [Self; 2] = [Self::Svg, Self::Png];
}

impl From<FormatName> for FigureFormat {
    fn from(name: FormatName) -> Self {
        match name {
            FormatName::Svg => Self::Svg,
            FormatName::Png => Self::Png,
            FormatName::Pdf => Self::Pdf,
        }
    }
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ScaleName {
    /// Logarithmic where the values are positive and span a factor of more than 40
    Automatic,
    /// Linear
    Linear,
    /// Logarithmic
    Logarithmic,
}

/// What a figure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum KindName {
    /// The structure with its stops, its modes, the error of its reduction, the amplitude of its excitation
    Structure,
    /// Branches: maximum displacement, acceleration, contact force and impact velocity over the frequency
    Response,
    /// Branches over another parameter than the frequency
    Vary,
    /// Curves of bifurcations in two parameters
    Curves,
    /// Floquet multipliers of each branch, over the frequency and in the complex plane
    Multipliers,
    /// Orbits at the frequencies of --orbit, else at those of the study
    Orbits,
    /// Settled motions of sweeps over the frequency
    Sweeps,
    /// Lyapunov exponents, their convergence, and stroboscopic sections
    Exponents,
    /// Basins of attraction
    Basins,
    /// One HTML file to look through all of it, page.html
    Page,
}

impl From<ScaleName> for FigureScale {
    fn from(name: ScaleName) -> Self {
        match name {
            ScaleName::Automatic => Self::Automatic,
            ScaleName::Linear => Self::Linear,
            ScaleName::Logarithmic => Self::Logarithmic,
        }
    }
}

impl From<KindName> for FigureKind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::Structure => Self::Structure,
            KindName::Response => Self::Response,
            KindName::Vary => Self::Vary,
            KindName::Curves => Self::Curves,
            KindName::Multipliers => Self::Multipliers,
            KindName::Orbits => Self::Orbits,
            KindName::Sweeps => Self::Sweeps,
            KindName::Exponents => Self::Exponents,
            KindName::Basins => Self::Basins,
            KindName::Page => Self::Page,
        }
    }
}

fn resolution(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (24.0..=1200.0).contains(&number) => Ok(number),
        _ => Err("must be 24 to 1200 pixels per inch".to_owned()),
    }
}

/// `FROM:TO` in hertz, or `PARAMETER=FROM:TO`.
fn detail(text: &str) -> Result<FigureDetail, String> {
    let (name, ends) = text.rsplit_once('=').map_or((None, text), |(name, ends)| (Some(name.trim()), ends));
    let parameter = name.filter(|name| *name != "excitation.frequency_hz").map(str::to_owned);
    let number = |end: &str| match parameter {
        Some(_) => end.trim().parse().ok(),
        None => hertz(end).filter(|&end| end > 0.0),
    };
    match ends.split_once(':').and_then(|(from, to)| Some((number(from)?, number(to)?))) {
        Some((from, to)) if name != Some("") && from < to && from.is_finite() && to.is_finite() => {
            Ok(FigureDetail { parameter, range: (from, to) })
        }
        _ => Err("must be two frequencies in hertz, the lower one first, 84:93, or two values of a varied \
            parameter, excitation.amplitude_n=0.2:0.3"
            .to_owned()),
    }
}

/// `HZ`, or `HZ:N` for an orbit of N excitation periods.
fn orbit(text: &str) -> Result<DrawnOrbit, String> {
    let (frequency, multiple) = text.split_once(':').unwrap_or((text, "1"));
    let frequency_hz = positive(frequency)?;
    match multiple.parse::<u32>() {
        Ok(period_multiple) if (1..=64).contains(&period_multiple) => {
            Ok(DrawnOrbit { frequency_hz, period_multiple })
        }
        _ => Err("must be a frequency, or a frequency and a whole number from 1 to 64: 53:2".to_owned()),
    }
}
