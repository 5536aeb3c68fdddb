//! Names of points and dimensions of a beam.

use super::place::{BASE, BeamLayout, MASS, ROW};
use crate::{
    sketch::{HATCH, at, dimension, label},
    structure_diagram::data::SketchPoint,
    svg::{Anchor, SvgWriter},
    text::{Text, decimal},
};

impl BeamLayout<'_> {
    /// Rows that the names need so that they do not cover each other.
    pub(super) fn name_rows(&self) -> u32 {
        self.rows_of_names().iter().map(|(_, row)| row + 1).max().unwrap_or(0)
    }

    /// Places and rows of the names, from left to right.
    pub(super) fn rows_of_names(&self) -> Vec<(&SketchPoint, u32)> {
        let mut sorted: Vec<&SketchPoint> = self.beam.points.iter().collect();
        sorted.sort_by(|a, b| a.at_m.total_cmp(&b.at_m));
        let mut ends: Vec<f64> = Vec::new();
        let mut rows = Vec::new();
        for point in sorted {
            let half = 0.5 * Text::upright(&point.name).width(self.style.tick_size);
            let x = self.across(point.at_m);
            let row = ends.iter().position(|end| x - half > *end + 3.0).unwrap_or(ends.len());
            if row == ends.len() {
                ends.push(x + half);
            } else {
                ends[row] = x + half;
            }
            rows.push((point, row as u32));
        }
        rows
    }

    pub(super) fn draw_names(&self, svg: &mut SvgWriter) {
        for (point, row) in self.rows_of_names() {
            let taken =
                self.diagram.stops.iter().any(|stop| stop.point == point.name && self.is_on(stop, true));
            let forced = self.diagram.forces.contains(&point.name);
            let x = self.across(point.at_m);
            let y = self.middle - MASS - 4.0 - 1.6 * self.style.tick_size * f64::from(row);
            if taken {
                label(svg, at(x - 8.0, y), &point.name, Anchor::End, self.style);
            } else {
                label(
                    svg,
                    at(x, y - if forced { 13.0 } else { 0.0 }),
                    &point.name,
                    Anchor::Middle,
                    self.style,
                );
            }
        }
    }

    pub(super) fn draw_dimensions(&self, svg: &mut SvgWriter) {
        let mut y = self.floor + BASE + HATCH + 0.6 * ROW;
        let start = self.floor + BASE + 1.0;
        for at_m in self.measured().into_iter().chain([self.beam.length_m]) {
            let is_clear = at_m == self.beam.length_m && !self.is_taken_below(self.right);
            let tops = (start, if is_clear { self.middle + 13.0 } else { start });
            let text = format!("{} mm", millimetres(at_m));
            dimension(svg, (self.left, self.across(at_m)), y, tops, &text, self.style);
            y += ROW;
        }
    }
}

/// Metres in millimetres, as many digits as they need up to four decimals of a metre.
fn millimetres(metres: f64) -> String {
    let text = decimal(1e3 * metres, 1);
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}
