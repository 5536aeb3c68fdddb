//! The sketch of a beam, to scale along its length.

mod holders;
mod labels;
mod place;

use super::{
    data::{SketchBeam, SketchCarrier, SketchPoint, SketchStop, StructureDiagram},
    layout::{MARGIN, Sketch},
    stop,
};
use crate::{
    error::FigureError,
    sketch::{Behind, HATCH, arrow, at, block, body, damper, disc, line, spring, turn, variable, wall},
    style::{INK, PAPER, Style},
    svg::{Anchor, SvgWriter, points},
};
use place::{BASE, BeamLayout, CLEAR, END, HALF, MASS, REACH, ROW};

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
    let mut place = BeamLayout {
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

impl BeamLayout<'_> {
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
        self.draw_support(svg, point);
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
            // Fixed parts keep a distance from moving parts.
            let is_still = drawn.carrier == SketchCarrier::Space;
            let foot = if is_still && self.has_bar(above) { level - sign * CLEAR } else { level };
            stop::draw(svg, drawn.kind, at(x, foot), at(x, self.middle + sign * surface), drawn.has_gap);
            if is_still {
                let behind = if above { Behind::Above } else { Behind::Below };
                wall(svg, at(x - 7.0, foot), at(x + 7.0, foot), behind);
            } else if let (SketchCarrier::Support(support), true) =
                (&drawn.carrier, self.diagram.supports_differ())
            {
                block(svg, at(x - 7.0, foot), at(x + 7.0, foot + sign * BASE));
                let motion = self.diagram.motion_of(*support);
                variable(svg, at(x + 10.0, foot + 3.0), &motion, Anchor::Start, self.style);
            }
        }
    }
}
