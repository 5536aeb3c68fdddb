//! Supports of a beam and carriers of its stops.

use super::place::{BASE, BeamLayout, END_HALF, HALF};
use crate::{
    sketch::{Behind, arrow, at, block, disc, line, variable, wall},
    structure_diagram::data::{SketchCarrier, SketchEnd, SketchPoint, SketchStop},
    style::PAPER,
    svg::{Anchor, SvgWriter},
};

impl BeamLayout<'_> {
    /// Bodies that move with the support: bars that carry stops, and columns from moving parts to them. If
    /// supports move differently, each stop has its own block.
    pub(super) fn draw_carriers(&self, svg: &mut SvgWriter) {
        let places = self.diagram.moving.iter().filter_map(|moving| self.of(&moving.place));
        let moving: Vec<f64> = places.collect();
        let has_bar = [false, true].map(|above| self.draw_bar(svg, &moving, above));
        for &x in &moving {
            let (side, end) = match x {
                x if x == self.left => (-BASE, self.beam.left),
                x if x == self.right => (BASE, self.beam.right),
                _ => (0.5 * BASE, SketchEnd::Free),
            };
            if end == SketchEnd::Clamped {
                let top = if has_bar[1] { self.ceiling } else { self.middle - END_HALF };
                let bottom = if has_bar[0] { self.floor } else { self.middle + END_HALF };
                block(svg, at(x, top), at(x + side, bottom));
            } else if has_bar[0] || (end == SketchEnd::Free && self.diagram.supports_differ()) {
                let top = if end == SketchEnd::Pinned { self.middle + HALF + 7.0 } else { self.middle };
                block(svg, at(x - 0.5 * BASE, top), at(x + 0.5 * BASE, self.floor));
            }
        }
    }

    /// The stops on a side that are carried by a support.
    pub(super) fn riding(&self, above: bool) -> impl Iterator<Item = &SketchStop> {
        let riding =
            self.diagram.stops.iter().filter(|stop| matches!(stop.carrier, SketchCarrier::Support(_)));
        riding.filter(move |stop| self.is_on(stop, above))
    }

    /// Whether there is a moving bar on a side.
    pub(super) fn has_bar(&self, above: bool) -> bool {
        if self.diagram.supports_differ() {
            return false;
        }
        let is_needed =
            self.riding(above).next().is_some() || (!above && self.inner_moving().next().is_some());
        is_needed && self.diagram.moving.iter().any(|moving| self.of(&moving.place).is_some())
    }

    /// Draws the bar above or below the beam.
    ///
    /// # Returns
    /// Whether there is one.
    pub(super) fn draw_bar(&self, svg: &mut SvgWriter, moving: &[f64], above: bool) -> bool {
        if !self.has_bar(above) {
            return false;
        }
        let stops = self.riding(above).filter_map(|stop| self.of(&stop.point));
        let stops: Vec<f64> = stops.flat_map(|x| [x - 7.0, x + 7.0]).collect();
        let outer = moving.iter().map(|&x| match x {
            x if x == self.left => x - BASE,
            x if x == self.right => x + BASE,
            x => x,
        });
        let places: Vec<f64> = stops.into_iter().chain(outer).collect();
        let from = places.iter().copied().fold(f64::INFINITY, f64::min);
        let to = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let near = if above { self.ceiling } else { self.floor };
        block(svg, at(from, near), at(to, if above { near - BASE } else { near + BASE }));
        true
    }

    /// The support of a point between the ends: a triangle that it turns on, walls on both sides that it is
    /// clamped between, or rollers that it slides between.
    pub(super) fn draw_support(&self, svg: &mut SvgWriter, point: &SketchPoint) {
        let (x, moves) = (self.across(point.at_m), self.diagram.moves(&point.name));
        let (above, below) = (self.middle - HALF, self.middle + HALF);
        match point.support {
            SketchEnd::Free => {}
            SketchEnd::Pinned => {
                let foot = below + 7.0;
                line(svg, &[at(x, below), at(x - 4.0, foot), at(x + 4.0, foot), at(x, below)]);
                if !moves {
                    wall(svg, at(x - 6.0, foot), at(x + 6.0, foot), Behind::Below);
                }
            }
            SketchEnd::Clamped => {
                wall(svg, at(x - 6.0, above), at(x + 6.0, above), Behind::Above);
                if !moves {
                    wall(svg, at(x - 6.0, below), at(x + 6.0, below), Behind::Below);
                }
            }
            SketchEnd::Sliding => {
                let half = 0.5 * END_HALF;
                for (side, behind) in [(-1.0, Behind::Left), (1.0, Behind::Right)] {
                    for y in [self.middle - half, self.middle + half] {
                        disc(svg, at(x + side * 2.0, y), 2.0, PAPER);
                    }
                    let out = x + side * 4.0;
                    wall(svg, at(out, self.middle - END_HALF), at(out, self.middle + END_HALF), behind);
                }
                line(svg, &[at(x, self.middle - END_HALF), at(x, self.middle + END_HALF)]);
            }
        }
    }

    pub(super) fn draw_end(&self, svg: &mut SvgWriter, end: SketchEnd, is_left: bool) {
        let (x, side, behind) =
            if is_left { (self.left, -1.0, Behind::Left) } else { (self.right, 1.0, Behind::Right) };
        let support = self.diagram.support_of(if is_left { "left" } else { "right" });
        let moves = support.is_some();
        let (top, bottom) = (self.middle - END_HALF, self.middle + END_HALF);
        match (end, moves) {
            (SketchEnd::Clamped, false) => wall(svg, at(x, top), at(x, bottom), behind),
            (SketchEnd::Clamped, true) | (SketchEnd::Free, _) => {}
            (SketchEnd::Pinned, _) => {
                let foot = self.middle + HALF + 7.0;
                line(
                    svg,
                    &[
                        at(x, self.middle + HALF),
                        at(x - 4.0, foot),
                        at(x + 4.0, foot),
                        at(x, self.middle + HALF),
                    ],
                );
                if moves {
                    block(svg, at(x - 6.0, foot), at(x + 6.0, foot + BASE));
                } else {
                    wall(svg, at(x - 6.0, foot), at(x + 6.0, foot), Behind::Below);
                }
            }
            (SketchEnd::Sliding, _) => {
                line(svg, &[at(x, top + 3.0), at(x, bottom - 3.0)]);
                for y in [self.middle - 5.0, self.middle + 5.0] {
                    disc(svg, at(x + side * 2.0, y), 2.0, PAPER);
                }
                wall(svg, at(x + side * 4.0, top), at(x + side * 4.0, bottom), behind);
            }
        }
        if let Some(support) = support {
            let out = x + side * 14.0;
            arrow(svg, at(out, self.middle + 9.0), at(out, self.middle - 9.0), true);
            let anchor = if is_left { Anchor::End } else { Anchor::Start };
            let motion = self.diagram.motion_of(support);
            variable(svg, at(out + side * 3.0, self.middle + 2.5), &motion, anchor, self.style);
        }
    }
}
