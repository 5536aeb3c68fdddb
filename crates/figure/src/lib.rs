//! Figures from stored results: SVG for print and screen, PDF for print, PNG for everything else.
//!
//! A figure depends on its data only: not on the clock, the locale, system fonts or hash order. Drawn twice,
//! it is the same file byte for byte. This crate defines the plain data of its figures, so it depends neither
//! on the results store nor on solvers.
//!
//! ```
//! use hammerbeam_figure::{ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity};
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
//! let figure = diagram.draw(ResponseQuantity::Displacement)?;
//! assert!(figure.svg().starts_with("<svg"));
//! assert!(figure.png(300.0)?.starts_with(b"\x89PNG"));
//! # Ok::<(), hammerbeam_figure::FigureError>(())
//! ```
//!
//! # Modules
//! Data flow from the diagram to the page. [`ResponseDiagram`], [`CurveDiagram`], [`StructureDiagram`] and
//! [`ModeDiagram`] draw themselves; every other kind is a file that turns its data into a `chart`, panels of
//! layers over one axis:
//!
//! * `style`: the look: sizes for a journal column, line widths, colours; the only place to change it.
//! * `scale`, `ticks`, `axis`, `axis_unit`, `parameter_axis`, `plot`: linear and logarithmic scales, their
//!   ticks, units that suit them, a frame with two axes.
//! * `stretch`: a branch divided where its stability changes.
//! * `decimate`, `line`: fewer points for the same line, dashes.
//! * `chart`, `chart_row`: panels on top of each other under one legend; such charts side by side.
//! * `data_diagram`: lines and points of one's own.
//! * `layer`: lines, dots, intervals, cells, shades, reference lines, labels.
//! * `sketch`: symbols of mechanics: walls, springs, dampers, arrows, dimension lines.
//! * `marks`, `dots`, `legend`: a mark for each kind of event; the legend.
//! * `text`, `font`: lines with italic parts, numbers as printed, widths of the bundled font's glyphs.
//! * `page`: the page that shows a results folder: contents, coding, HTML file; its script is in `page/`.
//! * `svg`: the few elements we need, in points.
//! * `png`: the renderer with the bundled font alone; the PNG file is written by `png/file.rs`.
//! * `pdf`: from what the renderer reads to a PDF; its faces are in `pdf/face.rs`.
//!
//! # Decisions
//! - **Own SVG writer, not a plotting library.** The figures need dashes that fit their line, decimation and
//!   thinning of marks on the page, which plotting libraries do not have; their other functions take 200
//!   lines here.
//! - **Line style and width show stability, lightness and strokes across the line show the period, shape
//!   shows the event**, so a grey copy has the same information.
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
//! - **The font is Arimo**, bundled. An SVG embeds the glyphs that it uses, some 10 kB, so that no font has
//!   to be installed; text can be searched and edited. A program that ignores embedded fonts uses Arial or
//!   Helvetica, which have the same widths.

mod axis;
mod axis_unit;
mod base64;
mod basin_map;
mod bifurcation;
mod chart;
mod chart_row;
mod curve_diagram;
mod data_diagram;
mod decimate;
mod dots;
mod error;
mod excitation_diagram;
mod exponent_diagram;
mod figure;
mod font;
mod frequency_unit;
mod hole_diagram;
mod layer;
mod legend;
mod line;
mod marks;
mod mesh_diagram;
mod mode_diagram;
mod motion;
mod motion_section;
mod multiplier_diagram;
mod orbit_diagram;
mod page;
mod parameter_axis;
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

pub use basin_map::{BasinAttractor, BasinMap};
pub use bifurcation::Bifurcation;
pub use curve_diagram::{BifurcationCurve, BifurcationCurvePoint, CurveDiagram};
pub use data_diagram::{DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries};
pub use error::FigureError;
pub use excitation_diagram::ExcitationDiagram;
pub use exponent_diagram::{ConvergenceDiagram, ExponentDiagram, ExponentPoint};
pub use figure::Figure;
pub use frequency_unit::FrequencyUnit;
pub use hole_diagram::HoleDiagram;
pub use layer::LabelSide;
pub use mesh_diagram::{MeshMode, MeshModeDiagram};
pub use mode_diagram::{DrawnMode, ModeDiagram};
pub use motion::MotionKind;
pub use motion_section::SectionDiagram;
pub use multiplier_diagram::{MultiplierDiagram, Multipliers};
pub use orbit_diagram::{FilteredAcceleration, OrbitDiagram, OrbitImpulse, OrbitSample};
pub use page::{
    MultiplierRecords, OrbitRecord, OrbitRecords, PackedPage, Page, PageBranch, PageFigure, PageFigures,
    PageImpulse, PageLink, PageMeasured, PageMeasuredPoint, PageMesh, PageMotion, PageOrbit, PageOutput,
    PageParameter, PagePlace, PageSection, PageSolution, PageStop, PageStructure, SectionPlane,
};
pub use parameter_axis::ParameterAxis;
pub use reduction_diagram::{ReducedMode, ReductionDiagram};
pub use response_diagram::{
    MeasuredMark, MeasuredMotion, OutputAxis, OverlaidBranches, ResponseCurve, ResponseDiagram,
    ResponsePoint, ResponseQuantity, ResponseSettings,
};
pub use scale::ScaleChoice;
pub use structure_diagram::{
    SketchBeam, SketchCarrier, SketchEnd, SketchLayout, SketchLink, SketchLumped, SketchMotion, SketchPoint,
    SketchStop, StopKind, StructureDiagram,
};
pub use style::Style;
pub use sweep_diagram::{DrawnMotion, SweepDiagram, SweepOrigin};
pub use text::plain_number;
