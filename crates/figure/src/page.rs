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
pub use document::PackedPage;
pub use figures::{PageFigure, PageFigures};
pub use measured::{PageMeasured, PageMeasuredPoint};
pub use motions::{PageMotion, PageSection, SectionPlane};
pub use multipliers::MultiplierRecords;
pub use orbits::{OrbitRecord, OrbitRecords, PageImpulse, PageOrbit};

impl Page {
    /// Everything but the orbits, which are chosen for the room that this leaves.
    #[must_use]
    pub fn pack(&self) -> PackedPage {
        PackedPage::of(self)
    }
}
