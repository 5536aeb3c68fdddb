//! What of a results folder is drawn, and how.

use std::path::PathBuf;

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

/// What of a results folder is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureSelection {
    /// What is drawn.
    pub kinds: Vec<FigureKind>,
    /// Scale of the vertical axis of response diagrams.
    pub scale: FigureScale,
    /// Part of the frequency axis of response diagrams that is drawn again below, larger [Hz].
    pub detail_hz: Option<(f64, f64)>,
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
            detail_hz: None,
            with: Vec::new(),
            orbits: figures.orbits.clone(),
            low_pass_hz: figures.low_pass_hz,
        }
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
