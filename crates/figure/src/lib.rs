//! Figures from stored results: SVG for print and screen, PDF for print, PNG for everything else.
//!
//! A figure is a function of the data it is given and of nothing else: no clock, no locale, no system font,
//! no hash order. Drawn twice, it is the same file byte for byte. This crate owns the plain data that its
//! figures take, so it knows neither the results store nor anything that solves.
//!
//! ```
//! use hammerbeam_figure::{Quantity, ResponseCurve, ResponseDiagram, ResponsePoint};
//!
//! let points = (20..110).map(f64::from).map(|frequency_hz| ResponsePoint {
//!     frequency_hz,
//!     displacement_m: 5e-3 / (1.0 + (frequency_hz - 36.0).powi(2)),
//!     acceleration_m_s2: 300.0,
//!     stable: frequency_hz < 60.0,
//!     ..ResponsePoint::default()
//! });
//! let curve = ResponseCurve { period_multiple: 1, points: points.collect() };
//! let diagram = ResponseDiagram { curves: vec![curve], ..ResponseDiagram::default() };
//! let figure = diagram.draw(Quantity::Displacement)?;
//! assert!(figure.svg().starts_with("<svg"));
//! assert!(figure.png(300.0)?.starts_with(b"\x89PNG"));
//! # Ok::<(), hammerbeam_figure::FigureError>(())
//! ```
//!
//! # The rooms
//! Data run from the diagram to the page. [`ResponseDiagram`], [`CurveDiagram`], [`StructureDiagram`] and
//! [`ModeDiagram`] draw themselves; every other kind is a file that turns its data into a `chart`, panels of
//! layers over one axis:
//!
//! | room | what it knows |
//! |---|---|
//! | `style` | the look: sizes for a journal column, line widths, colours; the only place to change it |
//! | `scale`, `ticks`, `axis`, `plot` | a linear or logarithmic scale, where its ticks are, a frame with two axes |
//! | `stretch`, `decimate`, `line` | a branch cut where its stability changes, fewer points for the same line, dashes |
//! | `chart`, `layer` | panels on top of each other under one legend; lines, dots, intervals, cells, shades, reference lines |
//! | `sketch` | symbols of mechanics: walls, springs, dampers, arrows, dimension lines |
//! | `marks`, `dots`, `legend` | one mark for each kind of event, thinned where they overlap; samples with their names |
//! | `text`, `font` | lines with italic parts, numbers as printed, widths of the glyphs of the bundled font |
//! | `page` | the page that shows a whole results folder: what it is given, how that is packed, the HTML file; its script is TypeScript, in `page/` of this crate |
//! | `svg`, `png`, `pdf` | the few elements we need, in points; the renderer with the bundled font alone; the PNG file in `png/file.rs`; from what the renderer reads to a PDF, its faces in `pdf/face.rs` |
//!
//! # Decisions
//! - **Own SVG writer, not a plotting library.** What makes these figures good (dashes that fit their
//!   stretch, decimation on the page, marks thinned on the page) is not what a plotting library has, and what
//!   it has is 200 lines here.
//! - **Line style and width tell stability, lightness and strokes across the line tell the period, shape
//!   tells the event**, so a grey copy still says it all.
//! - **A tenth of a pixel.** Lines are simplified on the page to 0.024 pt, a tenth of a pixel at 300 per
//!   inch; folds, ends of stretches and the ends of the axis stay. A hundred thousand solutions become some
//!   tens of kilobytes.
//! - **Own PNG files, not the renderer's.** Figures are opaque and have few colours: one or three bytes a
//!   pixel, without filters, are deflated in half the time of the four filtered ones that the renderer
//!   writes, into files that are a quarter smaller.
//! - **Own PDF, by `pdf-writer`, from the tree that the renderer reads.** Of the libraries that turn SVG into
//!   PDF, `svg2pdf` 0.13 and `krilla-svg` 0.8 are made for other versions of that tree than our renderer's:
//!   they would bring a second parser of SVG (11 and 48 further crates, without text and images in the
//!   first). `pdf-writer` brings two besides itself, and our figures are paths and text.
//! - **The font is Arimo**, bundled. An SVG carries the glyphs that it uses, some 10 kB, so that nothing has
//!   to be installed where it is opened; text stays text, to be searched and changed. A program that does not
//!   read such fonts takes Arial or Helvetica, whose widths are the same.

mod axis;
mod base64;
mod basin_map;
mod chart;
mod curve_diagram;
mod decimate;
mod dots;
mod error;
mod excitation_diagram;
mod exponent_diagram;
mod figure;
mod font;
mod frequency_unit;
mod layer;
mod legend;
mod line;
mod marks;
mod mode_diagram;
mod motion;
mod motion_section;
mod multiplier_diagram;
mod orbit_diagram;
mod page;
mod pdf;
mod plot;
mod png;
mod reduction_diagram;
mod response_diagram;
mod scale;
mod sketch;
mod stretch;
mod structure_diagram;
mod style;
mod svg;
mod sweep_diagram;
mod text;
mod ticks;

pub use basin_map::{BasinMap, Destination};
pub use curve_diagram::{Bifurcation, BifurcationCurve, CurveDiagram, CurvePoint};
pub use error::FigureError;
pub use excitation_diagram::ExcitationDiagram;
pub use exponent_diagram::{ConvergenceDiagram, ExponentDiagram, ExponentPoint};
pub use figure::Figure;
pub use frequency_unit::FrequencyUnit;
pub use mode_diagram::{DrawnMode, ModeDiagram};
pub use motion::MotionKind;
pub use motion_section::SectionDiagram;
pub use multiplier_diagram::{MultiplierDiagram, Multipliers};
pub use orbit_diagram::{FilteredAcceleration, OrbitDiagram, OrbitImpulse, OrbitSample};
pub use page::{
    MultiplierRecords, OrbitRecord, OrbitRecords, Page, PageBranch, PageFigure, PageFigures, PageImpulse,
    PageLink, PageMeasured, PageMeasuredPoint, PageMotion, PageOrbit, PagePlace, PageSection, PageSolution,
    PageStop, PageStructure, SectionPlane,
};
pub use reduction_diagram::{ReducedMode, ReductionDiagram};
pub use response_diagram::{
    MeasuredMark, MeasuredMotion, Quantity, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseSettings,
};
pub use scale::ScaleChoice;
pub use structure_diagram::{
    SketchBeam, SketchCarrier, SketchEnd, SketchLayout, SketchLink, SketchLumped, SketchMotion, SketchPoint,
    SketchStop, StopKind, StructureDiagram,
};
pub use style::Style;
pub use sweep_diagram::{Origin, SweepDiagram, SweptMotion};
pub use text::plain_number;
