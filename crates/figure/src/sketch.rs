//! Symbols of sketches of structures: walls, springs, dampers, arrows, dimension lines, in points on the
//! page.
//!
//! The symbols are standard in mechanics textbooks, so that a sketch needs no legend.

use crate::{
    font::CAPITAL_HEIGHT,
    plot::lettering,
    style::{GRID, INK, PALE_INK, PAPER, Style},
    svg::{Anchor, PagePoint, Stroke, SvgWriter, number},
    text::Text,
};

/// Line width of a sketch (pt).
pub(crate) const LINE: f64 = 0.7;
/// Line width of auxiliary lines (pt).
const THIN: f64 = 0.4;
/// Length of hatching behind a wall (pt).
pub(crate) const HATCH: f64 = 3.0;

/// Side of the hatching of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Behind {
    Left,
    Right,
    Below,
    Above,
}

pub(crate) fn at(x: f64, y: f64) -> PagePoint {
    PagePoint { x, y }
}

fn ink(width: f64) -> Stroke<'static> {
    Stroke { colour: INK, width }
}

/// A line in ink.
pub(crate) fn line(svg: &mut SvgWriter, points: &[PagePoint]) {
    svg.polyline(points, ink(LINE));
}

/// A fixed wall: a line with hatching behind it.
pub(crate) fn wall(svg: &mut SvgWriter, from: PagePoint, to: PagePoint, behind: Behind) {
    let length = (to.x - from.x).hypot(to.y - from.y);
    let count = (length / 3.0).ceil().max(2.0);
    let (dx, dy) = match behind {
        Behind::Left => (-HATCH, HATCH),
        Behind::Right => (HATCH, -HATCH),
        Behind::Below => (-HATCH, HATCH),
        Behind::Above => (HATCH, -HATCH),
    };
    let strokes: Vec<[PagePoint; 2]> = (0..count as u32)
        .map(|k| {
            let share = (f64::from(k) + 0.5) / count;
            let foot = at(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
            [foot, at(foot.x + dx, foot.y + dy)]
        })
        .collect();
    svg.polylines(strokes.iter().map(|stroke| (stroke.as_slice(), None)), ink(THIN));
    svg.polyline(&[from, to], ink(1.4 * LINE));
}

/// A body that moves with the support: a grey block.
pub(crate) fn block(svg: &mut SvgWriter, corner: PagePoint, opposite: PagePoint) {
    filled(svg, corner, opposite, GRID);
}

/// A body on paper.
pub(crate) fn body(svg: &mut SvgWriter, corner: PagePoint, opposite: PagePoint) {
    filled(svg, corner, opposite, PAPER);
}

fn filled(svg: &mut SvgWriter, a: PagePoint, b: PagePoint, fill: &str) {
    let (x, y) = (number(b.x), number(b.y));
    let data = format!("M{} {}H{x}V{y}H{}z", number(a.x), number(a.y), number(a.x));
    svg.path(&data, fill, ink(LINE));
}

/// A spring between two places: a zigzag with straight ends.
pub(crate) fn spring(svg: &mut SvgWriter, from: PagePoint, to: PagePoint) {
    let place = along(from, to);
    let coils = share_of(from, to, 24.0);
    let zigzag = (0..9).map(|k| {
        let side = if k == 0 || k == 8 { 0.0 } else { 2.6 * if k % 2 == 0 { 1.0 } else { -1.0 } };
        place(0.5 + coils * (f64::from(k) / 8.0 - 0.5), side)
    });
    let points: Vec<PagePoint> = std::iter::once(from).chain(zigzag).chain([to]).collect();
    line(svg, &points);
}

/// A damper between two places: a piston in a cylinder.
pub(crate) fn damper(svg: &mut SvgWriter, from: PagePoint, to: PagePoint) {
    let place = along(from, to);
    let half = 0.5 * share_of(from, to, 10.0);
    line(svg, &[from, place(0.5, 0.0)]);
    line(svg, &[place(0.5, -1.7), place(0.5, 1.7)]);
    let (open, closed) = (0.5 - half, 0.5 + half);
    line(svg, &[place(open, -3.0), place(closed, -3.0), place(closed, 3.0), place(open, 3.0)]);
    line(svg, &[place(closed, 0.0), to]);
}

/// Share of the way between two places that a symbol of a length takes, at most six tenths.
fn share_of(from: PagePoint, to: PagePoint, length: f64) -> f64 {
    (length / (to.x - from.x).hypot(to.y - from.y).max(1e-9)).min(0.6)
}

/// A place by its share of the way between two places and its distance to the side.
fn along(from: PagePoint, to: PagePoint) -> impl Fn(f64, f64) -> PagePoint {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let length = dx.hypot(dy).max(1e-9);
    move |share, side| at(from.x + share * dx - side * dy / length, from.y + share * dy + side * dx / length)
}

/// A circle, full or open.
pub(crate) fn disc(svg: &mut SvgWriter, centre: PagePoint, radius: f64, fill: &str) {
    svg.path(&crate::marks::circle(centre, radius), fill, ink(LINE));
}

/// The spiral of a rotational spring or damper around a point.
pub(crate) fn turn(svg: &mut SvgWriter, centre: PagePoint, radius: f64) {
    let points: Vec<PagePoint> = (0..=18)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 24.0;
            at(centre.x + radius * angle.cos(), centre.y - radius * angle.sin())
        })
        .collect();
    line(svg, &points);
}

/// An arrow; with heads at both ends for a motion.
pub(crate) fn arrow(svg: &mut SvgWriter, from: PagePoint, to: PagePoint, both: bool) {
    arrow_of(svg, (from, to), both, LINE);
}

fn arrow_of(svg: &mut SvgWriter, (from, to): (PagePoint, PagePoint), both: bool, width: f64) {
    let size = 3.4;
    let place = along(from, to);
    let length = (to.x - from.x).hypot(to.y - from.y).max(1e-9);
    let share = size / length;
    let mut data = head(place(1.0, 0.0), place(1.0 - share, 0.4 * size), place(1.0 - share, -0.4 * size));
    if both {
        data += &head(place(0.0, 0.0), place(share, 0.4 * size), place(share, -0.4 * size));
    }
    let first = if both { place(0.5 * share, 0.0) } else { from };
    svg.polyline(&[first, place(1.0 - 0.5 * share, 0.0)], ink(width));
    svg.path(&data, INK, Stroke { colour: INK, width: 0.0 });
}

fn head(tip: PagePoint, left: PagePoint, right: PagePoint) -> String {
    let pair = |point: PagePoint| format!("{} {}", number(point.x), number(point.y));
    format!("M{}L{}L{}z", pair(tip), pair(left), pair(right))
}

/// A dimension line between two horizontal positions, with its label in the middle and thin extension lines.
pub(crate) fn dimension(
    svg: &mut SvgWriter,
    (from, to): (f64, f64),
    y: f64,
    tops: (f64, f64),
    label: &str,
    style: &Style,
) {
    let thin = Stroke { colour: PALE_INK, width: THIN };
    let lines = [[at(from, tops.0), at(from, y + 2.0)], [at(to, tops.1), at(to, y + 2.0)]];
    svg.polylines(lines.iter().map(|line| (line.as_slice(), None)), thin);
    arrow_of(svg, (at(from, y), at(to, y)), true, THIN);
    let text = Text::upright(label);
    let (half, middle) = (0.5 * text.width(style.tick_size) + 1.5, 0.5 * (from + to));
    let height = 0.5 * CAPITAL_HEIGHT * style.tick_size;
    let gap = Stroke { colour: PAPER, width: 0.0 };
    let (left, right) = (number(middle - half), number(middle + half));
    let (top, bottom) = (number(y - height), number(y + height));
    svg.path(&format!("M{left} {top}H{right}V{bottom}H{left}z"), PAPER, gap);
    svg.text(at(middle, y + height), &text, lettering(style.tick_size, Anchor::Middle));
}

/// A short label.
pub(crate) fn label(svg: &mut SvgWriter, place: PagePoint, text: &str, anchor: Anchor, style: &Style) {
    svg.text(place, &Text::upright(text), lettering(style.tick_size, anchor));
}

/// A variable as a label.
pub(crate) fn variable(svg: &mut SvgWriter, place: PagePoint, text: &str, anchor: Anchor, style: &Style) {
    svg.text(place, &Text::default().variable(text), lettering(style.tick_size, anchor));
}
