//! The sketch of a beam, to scale along its length.

use super::{
    MARGIN, Sketch, SketchBeam, SketchCarrier, SketchEnd, SketchPoint, SketchStop, StopKind,
    StructureDiagram, stop,
};
use crate::{
    FigureError, Style,
    sketch::{
        Behind, HATCH, arrow, at, block, body, damper, dimension, disc, label, line, spring, turn, variable,
        wall,
    },
    style::{INK, PAPER},
    svg::{Anchor, SvgWriter, points},
    text::decimal,
};

/// Half the depth of the beam, and radius of a mass (pt).
const HALF: f64 = 1.8;
const MASS: f64 = 3.6;
/// Room for stops on a side, and for what holds an end (pt).
const REACH: f64 = 26.0;
const END: f64 = 26.0;
/// Half the height of what holds an end (pt).
const END_HALF: f64 = 11.0;
/// Thickness of what moves with the support, and distance of dimension lines (pt).
const BASE: f64 = 5.0;
const ROW: f64 = 11.0;
/// Distance of what stands still from what moves (pt).
const CLEAR: f64 = 7.0;
/// Most points whose distances are drawn.
const MEASURED: usize = 3;

/// Where everything is on the page.
struct Place<'a> {
    diagram: &'a StructureDiagram,
    beam: &'a SketchBeam,
    style: &'a Style,
    left: f64,
    right: f64,
    middle: f64,
    /// Where stops above and below are fixed.
    ceiling: f64,
    floor: f64,
}

/// Lays a beam out below `top`.
pub(super) fn sketch<'a>(
    diagram: &'a StructureDiagram,
    beam: &'a SketchBeam,
    top: f64,
    style: &'a Style,
) -> Result<Sketch<'a>, FigureError> {
    if !(beam.length_m > 0.0 && beam.length_m.is_finite()) {
        return Err(FigureError::Empty {
            quantity: "length of the beam",
            curves: 0,
            points: beam.points.len(),
        });
    }
    let mut place = Place {
        diagram,
        beam,
        style,
        left: MARGIN + END,
        right: points(style.width_mm) - MARGIN - END,
        middle: 0.0,
        ceiling: 0.0,
        floor: 0.0,
    };
    let names = 1.6 * style.tick_size * f64::from(place.name_rows()) + 4.0;
    let above = if place.has_above() { REACH + BASE + HATCH } else { 0.0 };
    let forces = if diagram.forces.is_empty() { 0.0 } else { 8.0 };
    place.middle = top + above.max(names + MASS + forces).max(16.0);
    place.ceiling = place.middle - REACH;
    place.floor = place.middle + if place.has_below() { REACH } else { 14.0 };
    let rows = place.measured().len() as f64 + 1.0;
    let bottom = place.floor + BASE + HATCH + ROW * rows + 3.0;
    Ok(Sketch { bottom, draw: Box::new(move |svg| place.draw(svg)) })
}

impl Place<'_> {
    fn across(&self, at_m: f64) -> f64 {
        self.left + (self.right - self.left) * at_m / self.beam.length_m
    }

    /// Where a point or an end is; none for the ground.
    fn of(&self, name: &str) -> Option<f64> {
        match name {
            "left" => Some(self.left),
            "right" => Some(self.right),
            _ => {
                let point = self.beam.points.iter().find(|point| point.name == name)?;
                Some(self.across(point.at_m))
            }
        }
    }

    fn is_on(&self, stop: &SketchStop, above: bool) -> bool {
        let is_free = !matches!(stop.carrier, SketchCarrier::Point(_));
        is_free
            && match stop.kind {
                StopKind::TwoSided => true,
                StopKind::Always => !above,
                _ => stop.above == above,
            }
    }

    fn has_above(&self) -> bool {
        self.diagram.stops.iter().any(|stop| self.is_on(stop, true))
    }

    fn has_below(&self) -> bool {
        let held = |point: &SketchPoint| point.has_spring || point.has_damper;
        self.diagram.stops.iter().any(|stop| self.is_on(stop, false))
            || self.diagram.stops.iter().any(|stop| matches!(stop.carrier, SketchCarrier::Point(_)))
            || self.beam.points.iter().any(held)
            || self.inner_moving().next().is_some()
    }

    /// Whether something stands below the beam so near to a place that a line down from there would cross it.
    fn is_taken_below(&self, x: f64) -> bool {
        let stops = self.diagram.stops.iter().filter(|stop| self.is_on(stop, false));
        let held = self.beam.points.iter().filter(|point| point.has_spring || point.has_damper);
        let places = stops.filter_map(|stop| self.of(&stop.point));
        let mut places = places.chain(held.map(|point| self.across(point.at_m)));
        (x == self.right && self.diagram.moves("right")) || places.any(|place| (place - x).abs() < 9.0)
    }

    /// Points between the ends that follow the support.
    fn inner_moving(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = self.diagram.moving.iter().filter(|name| *name != "left" && *name != "right");
        inner.filter_map(|name| self.of(name))
    }

    /// Points whose distance is drawn.
    fn measured(&self) -> Vec<f64> {
        let inner = self.beam.points.iter().map(|point| point.at_m);
        let mut all: Vec<f64> = inner.filter(|at| *at > 0.0 && *at < self.beam.length_m).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        if all.len() > MEASURED { Vec::new() } else { all }
    }

    fn draw(&self, svg: &mut SvgWriter) {
        self.draw_carriers(svg);
        self.draw_end(svg, self.beam.left, true);
        self.draw_end(svg, self.beam.right, false);
        body(svg, at(self.left, self.middle - HALF), at(self.right, self.middle + HALF));
        for point in &self.beam.points {
            self.draw_point(svg, point);
        }
        for stop in &self.diagram.stops {
            self.draw_stop(svg, stop);
        }
        for name in &self.diagram.forces {
            if let Some(x) = self.of(name) {
                arrow(svg, at(x, self.middle - MASS - 15.0), at(x, self.middle - MASS - 1.0), true);
                variable(svg, at(x + 3.0, self.middle - MASS - 6.0), "F", Anchor::Start, self.style);
            }
        }
        self.draw_names(svg);
        self.draw_dimensions(svg);
    }

    /// The bodies that move with the support: bars that carry the stops which ride on it, and columns from what moves to them.
    fn draw_carriers(&self, svg: &mut SvgWriter) {
        let moving: Vec<f64> = self.diagram.moving.iter().filter_map(|name| self.of(name)).collect();
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
            } else if has_bar[0] {
                let top = if end == SketchEnd::Pinned { self.middle + HALF + 7.0 } else { self.middle };
                block(svg, at(x - 0.5 * BASE, top), at(x + 0.5 * BASE, self.floor));
            }
        }
    }

    /// The stops on a side that ride on the support.
    fn riding(&self, above: bool) -> impl Iterator<Item = &SketchStop> {
        let riding = self.diagram.stops.iter().filter(|stop| stop.carrier == SketchCarrier::Support);
        riding.filter(move |stop| self.is_on(stop, above))
    }

    /// Whether a bar that moves stands on a side.
    fn has_bar(&self, above: bool) -> bool {
        let is_needed =
            self.riding(above).next().is_some() || (!above && self.inner_moving().next().is_some());
        is_needed && self.diagram.moving.iter().any(|name| self.of(name).is_some())
    }

    /// The bar above or below the beam; false if nothing needs it.
    fn draw_bar(&self, svg: &mut SvgWriter, moving: &[f64], above: bool) -> bool {
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

    fn draw_end(&self, svg: &mut SvgWriter, end: SketchEnd, is_left: bool) {
        let (x, side, behind) =
            if is_left { (self.left, -1.0, Behind::Left) } else { (self.right, 1.0, Behind::Right) };
        let moves = self.diagram.moves(if is_left { "left" } else { "right" });
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
        if moves {
            let out = x + side * 14.0;
            arrow(svg, at(out, self.middle + 9.0), at(out, self.middle - 9.0), true);
            let anchor = if is_left { Anchor::End } else { Anchor::Start };
            variable(svg, at(out + side * 3.0, self.middle + 2.5), "u", anchor, self.style);
        }
    }

    fn draw_point(&self, svg: &mut SvgWriter, point: &SketchPoint) {
        let x = self.across(point.at_m);
        let taken = self.diagram.stops.iter().any(|stop| stop.point == point.name && self.is_on(stop, false));
        let shift = if taken { 10.0 } else { 0.0 };
        let both = point.has_spring && point.has_damper;
        let ground = |svg: &mut SvgWriter, x: f64| {
            wall(svg, at(x - 5.0, self.floor), at(x + 5.0, self.floor), Behind::Below);
        };
        if point.has_spring {
            let x = x - shift - if both && !taken { 5.0 } else { 0.0 };
            spring(svg, at(x, self.floor), at(x, self.middle + HALF));
            ground(svg, x);
        }
        if point.has_damper {
            let x = x + shift + if both && !taken { 5.0 } else { 0.0 };
            damper(svg, at(x, self.floor), at(x, self.middle + HALF));
            ground(svg, x);
        }
        if point.has_rotational {
            turn(svg, at(x, self.middle), MASS + 3.0);
        }
        if self.diagram.moves(&point.name) {
            disc(svg, at(x, self.middle), MASS, PAPER);
            arrow(svg, at(x + 9.0, self.floor - 2.0), at(x + 9.0, self.floor - 18.0), true);
            variable(svg, at(x + 12.0, self.floor - 7.0), "u", Anchor::Start, self.style);
        } else {
            disc(
                svg,
                at(x, self.middle),
                if point.has_mass { MASS } else { 1.5 },
                if point.has_mass { INK } else { PAPER },
            );
        }
    }

    fn draw_stop(&self, svg: &mut SvgWriter, drawn: &SketchStop) {
        let Some(x) = self.of(&drawn.point) else { return };
        let has_mass = self.beam.points.iter().any(|point| point.name == drawn.point && point.has_mass);
        let surface = if has_mass { MASS } else { HALF };
        if let SketchCarrier::Point(other) = &drawn.carrier {
            let Some(far) = self.of(other) else { return };
            let y = self.middle + 0.6 * REACH;
            line(svg, &[at(x, self.middle + HALF), at(x, y)]);
            line(svg, &[at(far, self.middle + HALF), at(far, y)]);
            stop::draw(svg, drawn.kind, at(far, y), at(x, y), drawn.has_gap);
            return;
        }
        for above in [false, true] {
            if !self.is_on(drawn, above) {
                continue;
            }
            let (level, sign) = if above { (self.ceiling, -1.0) } else { (self.floor, 1.0) };
            // What stands still keeps clear of what moves.
            let is_still = drawn.carrier == SketchCarrier::Space;
            let foot = if is_still && self.has_bar(above) { level - sign * CLEAR } else { level };
            stop::draw(svg, drawn.kind, at(x, foot), at(x, self.middle + sign * surface), drawn.has_gap);
            if is_still {
                let behind = if above { Behind::Above } else { Behind::Below };
                wall(svg, at(x - 7.0, foot), at(x + 7.0, foot), behind);
            }
        }
    }

    /// Rows that the names need so that they do not cover each other.
    fn name_rows(&self) -> u32 {
        self.rows_of_names().iter().map(|(_, row)| row + 1).max().unwrap_or(0)
    }

    /// Places and rows of the names, from left to right.
    fn rows_of_names(&self) -> Vec<(&SketchPoint, u32)> {
        let mut sorted: Vec<&SketchPoint> = self.beam.points.iter().collect();
        sorted.sort_by(|a, b| a.at_m.total_cmp(&b.at_m));
        let mut ends: Vec<f64> = Vec::new();
        let mut rows = Vec::new();
        for point in sorted {
            let half = 0.5 * crate::text::Text::upright(&point.name).width(self.style.tick_size);
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

    fn draw_names(&self, svg: &mut SvgWriter) {
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

    fn draw_dimensions(&self, svg: &mut SvgWriter) {
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
