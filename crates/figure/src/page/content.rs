//! Data of the page: branches, solutions, the structure.

use super::{
    figures::PageFigures,
    measured::PageMeasured,
    motions::{PageMotion, PageSection},
    multipliers::MultiplierRecords,
};
use crate::parameter_axis::ParameterAxis;

/// Data of the page, besides the orbits of some of its solutions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title of the study.
    pub title: String,
    /// Name of the response point.
    pub point: String,
    /// Frequency range of the study (Hz).
    pub frequency_range_hz: (f64, f64),
    /// Notice at the top of the page, such as an unfinished run; may be empty.
    pub notice: String,
    /// Name of the results folder, for commands that the page proposes.
    pub folder_name: String,
    /// Branches, in their order: first those over the frequency.
    pub branches: Vec<PageBranch>,
    /// The other parameters over which there are branches.
    pub parameters: Vec<PageParameter>,
    /// Numbers that were read off the solutions besides.
    pub outputs: Vec<PageOutput>,
    /// Multipliers of all solutions, or of none.
    pub multipliers: MultiplierRecords,
    /// The structure; `None` if it is unknown.
    pub structure: Option<PageStructure>,
    /// Aperiodic motions of sweeps.
    pub motions: Vec<PageMotion>,
    /// Ranges of the frequency with chaotic motion (Hz).
    pub chaotic_ranges_hz: Vec<(f64, f64)>,
    /// Poincaré sections, by their frequencies.
    pub sections: Vec<PageSection>,
    /// Measured points in the response diagram.
    pub measured: Vec<PageMeasured>,
    /// Printed figures of results that the page does not draw.
    pub figures: PageFigures,
}

/// A parameter over which branches were followed at a fixed frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageParameter {
    /// What it is, and its SI unit.
    pub axis: ParameterAxis,
    /// The excitation frequency of its branches (Hz).
    pub frequency_hz: f64,
}

/// A number that was read off each solution.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageOutput {
    /// What it is.
    pub title: String,
    /// Its SI unit without prefix.
    pub unit: String,
    /// The values, over the solutions of all branches end to end; NaN where there is none.
    pub values: Vec<f64>,
}

/// A branch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageBranch {
    /// Its number.
    pub id: u32,
    /// Orbit period over excitation period, from 1.
    pub period_multiple: u32,
    /// The parameter along which it was followed: 0 for the frequency, else its place among
    /// [`Page::parameters`], from 1.
    pub over: u32,
    /// Description of both ends, at the first and the last solution.
    pub ends: [String; 2],
    /// Its solutions in order.
    pub solutions: Vec<PageSolution>,
}

/// A solution: maxima over its orbit, stability, events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is an event of its own")]
pub struct PageSolution {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Value of the parameter of its branch, if that is not the frequency.
    pub parameter: f64,
    /// Largest displacement of the response point (m).
    pub displacement_m: f64,
    /// Its largest acceleration (m/s²).
    pub acceleration_m_s2: f64,
    /// Largest contact force (N).
    pub force_n: f64,
    /// Largest speed with which a contact is reached (m/s).
    pub impact_velocity_m_s: f64,
    /// Mechanical energy of the structure at phase 0 of the excitation (J); NaN if it is unknown.
    pub energy_j: f64,
    /// Contacts in an orbit period.
    pub contacts: u32,
    /// Multiplier of largest modulus.
    pub leading_multiplier: [f64; 2],
    /// Whether no multiplier is known to lie outside the unit circle.
    pub stable: bool,
    /// Whether stability is undecided: a multiplier is on the unit circle to its accuracy.
    pub marginal: bool,
    /// The branch turns in frequency.
    pub fold: bool,
    /// A multiplier passes −1.
    pub flip: bool,
    /// A pair of multipliers passes the unit circle.
    pub neimark_sacker: bool,
    /// Branches cross.
    pub branch_point: bool,
    /// A contact is reached with zero velocity.
    pub grazing: bool,
}

/// The structure as drawn: places from left to right, and the stops they can hit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageStructure {
    /// Whether its places form a beam; otherwise each is a separate mass.
    pub is_beam: bool,
    /// Places, with positions in m along a beam.
    pub places: Vec<PagePlace>,
    /// Stops.
    pub stops: Vec<PageStop>,
    /// Springs and dampers between masses.
    pub links: Vec<PageLink>,
    /// Eigenfrequencies without local elements (Hz).
    pub eigenfrequencies_hz: Vec<f64>,
    /// Names of the supports that move.
    pub supports: Vec<String>,
    /// The support that moves the ground, if one does.
    pub ground: Option<u32>,
    /// The mesh that is drawn in place of the places, if it is known.
    pub mesh: Option<PageMesh>,
}

/// A mesh in space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageMesh {
    /// Places of its nodes (m).
    pub nodes: Vec<[f64; 3]>,
    /// Displacement of each node along x, y and z in each mode (kg^-1/2).
    pub shapes: Vec<[Vec<f64>; 3]>,
    /// The same per unit displacement of each support that moves.
    pub support_ratios: Vec<[Vec<f64>; 3]>,
    /// Numbers of nodes that lines join, from 0.
    pub lines: Vec<[usize; 2]>,
    /// The node of each place of the structure, if it is at one.
    pub places: Vec<Option<u32>>,
}

/// A place of a structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PagePlace {
    /// Its name; may be empty.
    pub name: String,
    /// Distance from the left end (m), or number of the mass.
    pub at: f64,
    /// Displacement in each mode (kg^-1/2).
    pub shape: Vec<f64>,
    /// Displacement per unit displacement of each support that moves.
    pub support_ratios: Vec<f64>,
}

/// A spring or a damper between masses.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PageLink {
    /// The places that it joins; `None` is the ground.
    pub ends: [Option<u32>; 2],
    /// Whether it is a damper.
    pub is_damper: bool,
}

/// A stop that a place of a structure can hit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageStop {
    /// Its name.
    pub name: String,
    /// Number of the local element whose force it has, from 0.
    pub element: u32,
    /// The place that hits it.
    pub place: u32,
    /// The place that carries it, if a place does.
    pub other: Option<u32>,
    /// Number of the moving support that carries it, from 0.
    pub rides: Option<u32>,
    /// Contact levels: displacement (m) of the place relative to the carrier of the stop, and whether the
    /// stop lies above.
    pub levels: Vec<(f64, bool)>,
}
