//! The page: everything in a results folder in one HTML file, which any browser opens without a server or a
//! network.
//!
//! The file contains a short script and its data: small data as JSON, solutions and their multipliers as
//! deflated columns, and orbits as records, in base64. Solutions are decoded when the page opens,
//! multipliers when a solution is selected for the first time. Orbits are decoded individually on demand: the
//! length of each record is a multiple of three bytes, so that its position in the base64 text is known.
//! Their values are rounded to less than a pixel of the drawings (`page/orbits/record.rs`).
//!
//! The script is written in TypeScript, in `page/` of this crate. The built script is stored with its
//! sources, so that building this crate does not need Node; a test verifies that it matches the sources.

mod columns;
mod content;
mod document;
mod figures;
mod measured;
mod motions;
mod multipliers;
mod orbits;
mod packed;

pub use content::{
    Page, PageBranch, PageLink, PageMesh, PageOutput, PageParameter, PagePlace, PageSolution, PageStop,
    PageStructure,
};
pub use figures::{PageFigure, PageFigures};
pub use measured::{PageMeasured, PageMeasuredPoint};
pub use motions::{PageMotion, PageSection, SectionPlane};
pub use multipliers::MultiplierRecords;
pub use orbits::{OrbitRecord, OrbitRecords, PageImpulse, PageOrbit};

/// Largest length of a page (bytes).
const MOST_BYTES: usize = 14_400_000;

impl Page {
    /// The whole file.
    ///
    /// Equal pages give equal bytes. Numbers that are not finite are kept where the format allows; the page
    /// leaves them out.
    #[must_use]
    pub fn html(&self) -> String {
        document::html(self)
    }

    /// Largest length of the records of orbits (bytes) that fits on the page with its other data.
    #[must_use]
    pub fn room_for_orbits(&self) -> usize {
        // Three bytes are four letters in base64.
        (MOST_BYTES.saturating_sub(self.html().len()) / 4 * 3).max(orbits::LEAST_BYTES)
    }
}
