//! Stable and unstable lines.
//!
//! Unstable lines are dashed *and* thinner: a stretch shorter than a dash still reads as unstable. The
//! pattern is stretched to fit a whole number of times, and starts and ends with half a gap, so that both
//! ends of a stretch can be seen.

use crate::{
    decimate::distance,
    style::{PAPER, Style},
    svg::{Dashes, Point, Stroke, SvgWriter, number},
};

/// Draws stretches of one stability, each through points on the page; a single point becomes a dot.
pub(crate) fn draw_stretches(
    svg: &mut SvgWriter,
    stretches: &[Vec<Point>],
    stable: bool,
    colour: &str,
    style: &Style,
) {
    let width = if stable { style.stable_width } else { style.unstable_width };
    let lines = stretches.iter().filter(|points| points.len() > 1);
    let lines = lines.map(|points| (points.as_slice(), if stable { None } else { dashes(points, style) }));
    svg.polylines(lines, Stroke { colour, width });
    for points in stretches {
        if let [lone] = points[..] {
            draw_dot(svg, lone, stable, colour, style);
        }
    }
}

/// The pattern that fits a line; none for one without length.
fn dashes(points: &[Point], style: &Style) -> Option<Dashes> {
    let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    let period = style.dash.0 + style.dash.1;
    let stretched = length / (length / period).round().max(1.0);
    let (dash, gap) = (stretched * style.dash.0 / period, stretched * style.dash.1 / period);
    (length > 0.0).then_some(Dashes { dash, gap, offset: dash + 0.5 * gap })
}

/// A solution alone: full where stable, open where unstable.
fn draw_dot(svg: &mut SvgWriter, at: Point, stable: bool, colour: &str, style: &Style) {
    let fill = if stable { colour } else { PAPER };
    let (r, x) = (number(style.stable_width), number(at.x - style.stable_width));
    let diameter = number(2.0 * style.stable_width);
    let outline = format!("M{x} {}a{r} {r} 0 1 0 {diameter} 0a{r} {r} 0 1 0 -{diameter} 0z", number(at.y));
    svg.path(&outline, fill, Stroke { colour, width: style.unstable_width });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_number_of_dashes_fits_into_every_stretch() {
        let style = Style::default();
        for length in [0.3, 2.0, 7.0, 399.0] {
            let dashes = dashes(&[Point { x: 0.0, y: 0.0 }, Point { x: length, y: 0.0 }], &style).unwrap();
            let count = length / (dashes.dash + dashes.gap);
            assert!((count - count.round()).abs() < 1e-9 && count >= 0.999);
            assert!(dashes.dash < 1.5 * style.dash.0);
        }
    }
}
