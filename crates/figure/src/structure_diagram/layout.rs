//! A sketch after layout, before it is drawn.

use crate::svg::SvgWriter;

/// Largest number of masses in a sketch.
pub(super) const MAX_MASSES: usize = 20;
/// Margin around the sketch (pt).
pub(super) const MARGIN: f64 = 3.0;

/// A sketch with its lower end on the page (pt) and its drawing function.
pub(super) struct Sketch<'a> {
    pub(super) bottom: f64,
    pub(super) draw: Box<dyn Fn(&mut SvgWriter) + 'a>,
}
