//! The sketch of lumped masses on a line. In each space between two masses, before the first and after the
//! last one, elements are drawn in lanes on top of each other. An element between a mass and the ground ends
//! at its own post.

mod arrangement;

use super::{
    data::{SketchLumped, StructureDiagram},
    layout::{MARGIN, MAX_MASSES, Sketch},
    stop,
};
use crate::{
    error::FigureError,
    font::CAPITAL_HEIGHT,
    sketch::{Behind, HATCH, arrow, at, block, body, damper, label, line, spring, variable, wall},
    style::Style,
    svg::{Anchor, PagePoint, SvgWriter, points},
    text::Text,
};
use arrangement::{Bridge, Element, Foot, Lane, arrange};

/// Height of a lane, and least height of a mass (pt).
const LANE: f64 = 13.0;
const LEAST: f64 = 26.0;
/// Widest space between masses (pt).
const WIDEST: f64 = 64.0;
/// Room next to a wall for its hatching and the arrow of its motion (pt).
const BESIDE: f64 = 20.0;
/// Thickness of a wall that moves (pt).
const THICK: f64 = 4.0;

struct LumpedLayout<'a> {
    diagram: &'a StructureDiagram,
    lumped: &'a SketchLumped,
    style: &'a Style,
    /// Lanes in the spaces: before the first mass, between masses, after the last.
    spaces: Vec<Vec<Lane>>,
    bridges: Vec<Bridge>,
    /// Left edge of each mass, their width, and top and bottom of them.
    masses: Vec<f64>,
    width: f64,
    walls: [f64; 2],
    top: f64,
    bottom: f64,
}

/// Lays masses out below `top`.
pub(super) fn sketch<'a>(
    diagram: &'a StructureDiagram,
    lumped: &'a SketchLumped,
    top: f64,
    style: &'a Style,
) -> Result<Sketch<'a>, FigureError> {
    let count = lumped.masses.len();
    if count == 0 {
        return Err(FigureError::Empty { quantity: "mass", curves: 0, points: 0 });
    }
    if count > MAX_MASSES {
        return Err(FigureError::Crowded { masses: count, most: MAX_MASSES });
    }
    let (spaces, bridges) = arrange(diagram, lumped);
    let lanes = spaces.iter().map(Vec::len).max().unwrap_or(0);
    let height = (LANE * lanes as f64).max(LEAST);
    let room = points(style.width_mm) - 2.0 * (MARGIN + BESIDE);
    let names = lumped.masses.iter().map(|name| Text::upright(name).width(style.tick_size) + 6.0);
    let widest = names.fold(22.0, f64::max);
    let outer = [0, count].map(|k| if spaces[k].is_empty() { 0.0 } else { 1.0 });
    let gaps = count as f64 - 1.0 + outer[0] + outer[1];
    let width = widest.min(0.5 * room / count as f64);
    let gap = ((room - width * count as f64) / gaps.max(1.0)).min(WIDEST);
    let start = MARGIN + BESIDE + 0.5 * (room - width * count as f64 - gap * gaps);
    let first = start + outer[0] * gap;
    let masses: Vec<f64> = (0..count).map(|k| first + (width + gap) * k as f64).collect();
    let end = masses[count - 1] + width + outer[1] * gap;
    let head = LANE * bridges.len() as f64 + 14.0;
    let top = top + head;
    let place = LumpedLayout {
        diagram,
        lumped,
        style,
        spaces,
        bridges,
        masses,
        width,
        walls: [start, end],
        top,
        bottom: top + height,
    };
    let bottom = place.bottom + 14.0 + HATCH;
    Ok(Sketch { bottom, draw: Box::new(move |svg| place.draw(svg)) })
}

impl LumpedLayout<'_> {
    fn draw(&self, svg: &mut SvgWriter) {
        for space in 0..self.spaces.len() {
            self.draw_space(svg, space);
        }
        self.draw_bridges(svg);
        for (k, name) in self.lumped.masses.iter().enumerate() {
            let x = self.masses[k];
            body(svg, at(x, self.top), at(x + self.width, self.bottom));
            let text = Text::upright(name);
            if text.width(self.style.tick_size) < self.width {
                let y = 0.5 * (self.top + self.bottom + CAPITAL_HEIGHT * self.style.tick_size);
                label(svg, at(x + 0.5 * self.width, y), name, Anchor::Middle, self.style);
            }
            let middle = x + 0.5 * self.width;
            let (y, reach) = (self.bottom + 7.0, (0.5 * self.width).min(9.0));
            if self.diagram.forces.contains(name) {
                arrow(svg, at(middle - reach, y), at(middle + reach, y), true);
                variable(svg, at(middle + 12.0, y + 2.4), "F", Anchor::Start, self.style);
            }
            if let Some(support) = self.diagram.support_of(name) {
                arrow(svg, at(middle - reach, y), at(middle + reach, y), true);
                let motion = self.diagram.motion_of(support);
                variable(svg, at(middle + 12.0, y + 2.4), &motion, Anchor::Start, self.style);
            }
        }
    }

    /// Left and right end of a space.
    fn ends(&self, space: usize) -> [f64; 2] {
        let left = if space == 0 { self.walls[0] } else { self.masses[space - 1] + self.width };
        let right = self.masses.get(space).copied().unwrap_or(self.walls[1]);
        [left, right]
    }

    fn draw_space(&self, svg: &mut SvgWriter, space: usize) {
        let lanes = &self.spaces[space];
        let [left, right] = self.ends(space);
        let is_outer = [space == 0, space + 1 == self.spaces.len()];
        let pitch = (self.bottom - self.top) / lanes.len().max(1) as f64;
        // Lanes that end at a post are lowest, so that the post crosses no others.
        let mut order: Vec<&Lane> = lanes.iter().collect();
        order.sort_by_key(|lane| lane.ends.iter().any(|foot| *foot != Foot::Mass));
        let ground = |side: usize| lanes.iter().any(|lane| lane.ends[side] != Foot::Mass);
        let is_shared = ground(0) && ground(1) && !is_outer[0] && !is_outer[1];
        for (k, lane) in order.into_iter().enumerate() {
            let y = self.top + (k as f64 + 0.5) * pitch;
            let mut ends = [left, right];
            for side in 0..2 {
                let Foot::Ground { support } = lane.ends[side] else { continue };
                let moves = support.is_some();
                if is_outer[side] {
                    self.draw_wall(svg, ends[side], y, (side == 0, pitch), moves);
                } else {
                    // Two posts are next to each other, the post of the left mass on the left.
                    let share = if is_shared { 0.12 } else { -0.12 };
                    let share = if side == 1 { 0.5 - share } else { 0.5 + share };
                    ends[side] = left + share * (right - left);
                    let half = if is_shared { 0.1 * (right - left) } else { 5.0 };
                    self.draw_post(svg, at(ends[side], y), half.min(5.0), moves);
                }
            }
            draw_element(svg, lane.element, ends, y);
        }
        for (side, x) in [(0, left), (1, right)] {
            let moving = lanes.iter().filter_map(|lane| match lane.ends[side] {
                Foot::Ground { support } => support,
                Foot::Mass => None,
            });
            let mut supports: Vec<usize> = moving.collect();
            supports.sort_unstable();
            supports.dedup();
            if is_outer[side] && !supports.is_empty() {
                let sign = if side == 0 { -1.0 } else { 1.0 };
                let middle = x + sign * (THICK + 7.0);
                let y = self.bottom + 7.0;
                arrow(svg, at(middle - 8.0, y), at(middle + 8.0, y), true);
                let motions: Vec<String> = supports.iter().map(|k| self.diagram.motion_of(*k)).collect();
                variable(svg, at(middle, y + 8.5), &motions.join(", "), Anchor::Middle, self.style);
            }
        }
    }

    /// The part of the wall at the end of a lane.
    fn draw_wall(&self, svg: &mut SvgWriter, x: f64, y: f64, (is_left, pitch): (bool, f64), moves: bool) {
        let (top, bottom) = (y - 0.5 * pitch, y + 0.5 * pitch);
        if moves {
            block(svg, at(x, top), at(x + if is_left { -THICK } else { THICK }, bottom));
        } else {
            wall(svg, at(x, top), at(x, bottom), if is_left { Behind::Left } else { Behind::Right });
        }
    }

    fn draw_post(&self, svg: &mut SvgWriter, head: PagePoint, half: f64, moves: bool) {
        let floor = self.bottom + 3.0;
        line(svg, &[at(head.x, head.y - 4.0), at(head.x, floor)]);
        if moves {
            block(svg, at(head.x - half, floor), at(head.x + half, floor + THICK));
        } else {
            wall(svg, at(head.x - half, floor), at(head.x + half, floor), Behind::Below);
        }
    }

    fn draw_bridges(&self, svg: &mut SvgWriter) {
        for (k, bridge) in self.bridges.iter().enumerate() {
            let y = self.top - LANE * (k as f64 + 0.8);
            let shift = 2.5 * k as f64;
            let [low, high] = bridge.masses.map(|mass| self.masses[mass] + 0.5 * self.width);
            let ends = [low + shift, high - shift];
            for x in ends {
                line(svg, &[at(x, self.top), at(x, y)]);
            }
            draw_element(svg, bridge.element, ends, y);
        }
    }
}

fn draw_element(svg: &mut SvgWriter, element: Element, [left, right]: [f64; 2], y: f64) {
    let (from, to) = (at(left, y), at(right, y));
    match element {
        Element::Spring => spring(svg, from, to),
        Element::Damper => damper(svg, from, to),
        Element::Stop { kind, has_gap, from_left } => {
            let (foot, tip) = if from_left { (to, from) } else { (from, to) };
            stop::draw(svg, kind, foot, tip, has_gap);
        }
    }
}
