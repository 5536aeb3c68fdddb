//! What of a results folder is drawn, and how.

use std::{fmt, path::PathBuf};

use hammerbeam_study::{StudyFile, file::DrawnOrbit};

/// Format of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics, of pixels.
    Png,
    /// Portable Document Format.
    Pdf,
}

impl FigureFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];
    /// What is drawn where none is asked for.
    pub const USUAL: [Self; 2] = [Self::Svg, Self::Png];

    /// Last part of the name of a file.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }
}

/// Scale of the vertical axis of response diagrams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureScale {
    /// Logarithmic where the values are positive and span a factor of more than 40.
    Automatic,
    /// Linear.
    Linear,
    /// Logarithmic.
    Logarithmic,
}

/// What a figure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureKind {
    /// The structure with its stops, its modes, the error of its reduction, the amplitude of its excitation.
    Structure,
    /// Branches: maximum displacement, acceleration, contact force and impact velocity over the frequency.
    Response,
    /// Branches over another parameter than the frequency.
    Vary,
    /// Curves of bifurcations in two parameters.
    Curves,
    /// Floquet multipliers of each branch, over the frequency and in the complex plane.
    Multipliers,
    /// Orbits at some frequencies.
    Orbits,
    /// Settled motions of sweeps over the frequency.
    Sweeps,
    /// Lyapunov exponents, their convergence, and stroboscopic sections.
    Exponents,
    /// Basins of attraction.
    Basins,
    /// One HTML file to look through all of it, `page.html`.
    Page,
}

impl FigureKind {
    /// All of them, in the order in which they are drawn but for the page, which comes first.
    pub const ALL: [Self; 10] = [
        Self::Structure,
        Self::Response,
        Self::Vary,
        Self::Curves,
        Self::Multipliers,
        Self::Orbits,
        Self::Sweeps,
        Self::Exponents,
        Self::Basins,
        Self::Page,
    ];
}

/// Part of the horizontal axis of response diagrams that is drawn again below, larger.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureDetail {
    /// Key path of the parameter of a `[[vary]]`; none where the axis is the frequency.
    pub parameter: Option<String>,
    /// Lower and upper end, in Hz or in the unit of the parameter's key.
    pub range: (f64, f64),
}

impl FigureDetail {
    /// The diagrams that show it.
    #[must_use]
    pub fn kind(&self) -> FigureKind {
        if self.parameter.is_some() { FigureKind::Vary } else { FigureKind::Response }
    }
}

impl fmt::Display for FigureDetail {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(parameter) = &self.parameter {
            write!(f, "{parameter}=")?;
        }
        write!(f, "{}:{}", self.range.0, self.range.1)
    }
}

/// What of a results folder is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureSelection {
    /// What is drawn.
    pub kinds: Vec<FigureKind>,
    /// Scale of the vertical axis of response diagrams.
    pub scale: FigureScale,
    /// Parts of response diagrams that are drawn again below, larger; one for each horizontal axis:
    /// [`ensure_details`](crate::ensure_details) refuses others.
    pub details: Vec<FigureDetail>,
    /// Further results folders, whose branches lie behind those of response diagrams.
    pub with: Vec<PathBuf>,
    /// Orbits at frequencies.
    pub orbits: Vec<DrawnOrbit>,
    /// Cut-off of the filter behind which accelerations of orbits are drawn as well [Hz].
    pub low_pass_hz: Option<f64>,
}

impl FigureSelection {
    /// Everything that a folder holds, and the orbits of the study.
    #[must_use]
    pub fn of(file: &StudyFile) -> Self {
        let figures = &file.study.figures;
        Self {
            kinds: FigureKind::ALL.to_vec(),
            scale: FigureScale::Automatic,
            details: Vec::new(),
            with: Vec::new(),
            orbits: figures.orbits.clone(),
            low_pass_hz: figures.low_pass_hz,
        }
    }

    /// The part of diagrams over a parameter, or over the frequency, that is drawn again.
    pub(crate) fn detail_over(&self, parameter: Option<&str>) -> Option<(f64, f64)> {
        let over = |detail: &&FigureDetail| detail.parameter.as_deref() == parameter;
        self.details.iter().find(over).map(|detail| detail.range)
    }

    /// What a run draws at its end: all but the multipliers, two figures for each branch, which take longer
    /// than all the others.
    #[must_use]
    pub fn of_run(file: &StudyFile) -> Self {
        let mut selection = Self::of(file);
        selection.kinds.retain(|kind| *kind != FigureKind::Multipliers);
        selection
    }
}
