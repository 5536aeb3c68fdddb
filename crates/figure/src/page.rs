//! The page: everything in a results folder in one HTML file, which any browser opens without a server or a
//! network.
//!
//! The file holds a short script and the data it shows: what is small as JSON, solutions and their
//! multipliers as little-endian arrays, and orbits as records, in base64. Solutions are decoded when the page
//! opens, multipliers when a solution is selected for the first time. Orbits are decoded one at a time, when
//! they are asked for: each is a record of its own, as long as a multiple of three bytes, so that its place
//! in the base64 text is known. Their values are rounded to less than a pixel of what is drawn of them
//! (`page/orbits/record.rs`).
//!
//! The script is written in TypeScript, in `page/` of this crate. What it is built into is stored beside its
//! sources, so that nobody who builds this crate needs Node; a test says that it is what the sources give.

mod columns;
mod document;
mod figures;
mod measured;
mod motions;
mod multipliers;
mod orbits;

pub use figures::{PageFigure, PageFigures};
pub use measured::{PageMeasured, PageMeasuredPoint};
pub use motions::{PageMotion, PageSection, SectionPlane};
pub use multipliers::MultiplierRecords;
pub use orbits::{OrbitRecord, OrbitRecords, PageImpulse, PageOrbit};

/// Length of a page without the places of its orbits (bytes).
const MOST_BYTES: usize = 14_400_000;

/// Everything that the page shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title of the study.
    pub title: String,
    /// Name of the response point.
    pub point: String,
    /// The range of the frequency that the study asks for (Hz).
    pub frequency_range_hz: (f64, f64),
    /// What a reader has to know before anything else: that a run has not ended; empty for nothing.
    pub notice: String,
    /// Branches, in their order.
    pub branches: Vec<PageBranch>,
    /// Orbits of some of their solutions.
    pub orbits: OrbitRecords,
    /// Multipliers of all of them, or of none.
    pub multipliers: MultiplierRecords,
    /// The structure; `None` if it is not known.
    pub structure: Option<PageStructure>,
    /// Motions of sweeps that did not settle on a periodic one.
    pub motions: Vec<PageMotion>,
    /// Ranges of the frequency with chaotic motion (Hz).
    pub chaotic_ranges_hz: Vec<(f64, f64)>,
    /// Poincaré sections, by their frequencies.
    pub sections: Vec<PageSection>,
    /// Measured points, laid over the response diagram.
    pub measured: Vec<PageMeasured>,
    /// Printed figures of what the page itself does not draw.
    pub figures: PageFigures,
}

/// A branch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageBranch {
    /// Its number.
    pub id: u32,
    /// Orbit period over excitation period, from 1.
    pub period_multiple: u32,
    /// How it ends, at its first and at its last solution, in words.
    pub ends: [String; 2],
    /// Its solutions, end to end.
    pub solutions: Vec<PageSolution>,
}

/// A solution: maxima over its orbit, stability, events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is an event of its own")]
pub struct PageSolution {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Largest displacement of the response point (m).
    pub displacement_m: f64,
    /// Its largest acceleration (m/s²).
    pub acceleration_m_s2: f64,
    /// Largest contact force (N).
    pub force_n: f64,
    /// Largest speed with which a contact is reached (m/s).
    pub impact_velocity_m_s: f64,
    /// Contacts in an orbit period.
    pub contacts: u32,
    /// Multiplier of largest modulus.
    pub leading_multiplier: [f64; 2],
    /// Whether the solution is stable, as far as is known.
    pub stable: bool,
    /// Whether that is not known, since a multiplier is on the unit circle as well as it is known.
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

/// The structure as it is drawn: places from left to right, and what they can hit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageStructure {
    /// Whether its places are joined to a beam; else each is a mass of its own.
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
}

/// A place of a structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PagePlace {
    /// Its name; empty for none.
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

/// What a place of a structure can hit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageStop {
    /// Its name.
    pub name: String,
    /// Number of the local element whose force it has, from 0.
    pub element: u32,
    /// The place that hits it.
    pub place: u32,
    /// The place that it sits on, if it is one.
    pub other: Option<u32>,
    /// The moving support that it rides on, by its number from 0.
    pub rides: Option<u32>,
    /// Where it is touched: displacements (m) of the place relative to what carries the stop, and whether the
    /// stop lies above.
    pub levels: Vec<(f64, bool)>,
}

impl Page {
    /// The whole file.
    ///
    /// The same page gives the same bytes. Numbers that are not finite are kept where they can be; where not
    /// they are left out by the page.
    #[must_use]
    pub fn html(&self) -> String {
        document::html(self)
    }

    /// Length of the records of orbits (bytes) for which the page has room beside what it holds already.
    #[must_use]
    pub fn room_for_orbits(&self) -> usize {
        // Three bytes are four letters.
        (MOST_BYTES.saturating_sub(self.html().len()) / 4 * 3).max(orbits::LEAST_BYTES)
    }
}
