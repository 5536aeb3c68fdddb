//! A stop, drawn along the line from its carrier to the body that hits it.

use super::data::StopKind;
use crate::{
    sketch::{LINE, at, disc, line, spring},
    style::{GRID, INK, PAPER},
    svg::{PagePoint, Stroke, SvgWriter, number},
};

/// Distance drawn for a gap (pt).
const GAP: f64 = 4.5;
const RADIUS: f64 = 4.2;
/// Thickness of a rigid stop (pt).
const BLOCK: f64 = 8.0;

/// Draws a stop.
///
/// * `foot`: where it is fixed.
/// * `tip`: surface of the body that hits it; the stop ends there, or a gap before it.
pub(super) fn draw(svg: &mut SvgWriter, kind: StopKind, foot: PagePoint, tip: PagePoint, has_gap: bool) {
    let length = (tip.x - foot.x).hypot(tip.y - foot.y).max(1e-9);
    let (dx, dy) = ((tip.x - foot.x) / length, (tip.y - foot.y) / length);
    let place = |along: f64, side: f64| at(foot.x + along * dx - side * dy, foot.y + along * dy + side * dx);
    let end = if has_gap { length - GAP } else { length };
    let plate = |svg: &mut SvgWriter, along: f64| line(svg, &[place(along, -4.0), place(along, 4.0)]);
    match kind {
        StopKind::Sphere { loses } => {
            line(svg, &[foot, place(end - RADIUS, 0.0)]);
            disc(svg, place(end - RADIUS, 0.0), RADIUS, if loses { INK } else { PAPER });
        }
        StopKind::Rigid => {
            let near = (end - BLOCK).max(0.0);
            line(svg, &[foot, place(near, 0.0)]);
            let corners = [place(near, -4.0), place(end, -4.0), place(end, 4.0), place(near, 4.0)];
            let data: Vec<String> =
                corners.iter().map(|corner| format!("{} {}", number(corner.x), number(corner.y))).collect();
            svg.path(&format!("M{}z", data.join("L")), GRID, Stroke { colour: INK, width: LINE });
        }
        StopKind::Spring | StopKind::TwoSided => {
            spring(svg, foot, place(end, 0.0));
            plate(svg, end);
        }
        StopKind::Always => spring(svg, foot, tip),
    }
}
