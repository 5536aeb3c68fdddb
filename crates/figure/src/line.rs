//! Stable, marginal and unstable lines.
//!
//! Marginal lines are as broad as stable ones, and dotted. Unstable lines are dashed *and* thinner: a line
//! shorter than a dash still reads as unstable. The pattern is scaled to fit a whole number of times, and
//! starts and ends with half a gap, so that both ends of a line are visible. Strokes across a line show its
//! period, for any stability.

use crate::{
    decimate::distance,
    stretch::LineLook,
    style::{PAPER, PeriodLook, Style},
    svg::{Dashes, PagePoint, Stroke, SvgWriter, number},
};

/// Draws lines of one stability, each through points on the page; a single point becomes a dot.
pub(crate) fn draw_stretches(
    svg: &mut SvgWriter,
    stretches: &[Vec<PagePoint>],
    line: LineLook,
    look: PeriodLook,
    style: &Style,
) {
    let colour = look.colour;
    let (width, pattern) = match line {
        LineLook::Stable => (style.stable_width, None),
        LineLook::Marginal => (style.stable_width, Some(style.dots)),
        LineLook::Unstable => (style.unstable_width, Some(style.dash)),
    };
    let lines = stretches.iter().filter(|points| points.len() > 1);
    let lines = lines.map(|points| (points.as_slice(), pattern.and_then(|pattern| dashes(points, pattern))));
    svg.polylines(lines, Stroke { colour, width });
    let strokes: Vec<[PagePoint; 2]> =
        stretches.iter().flat_map(|points| strokes(points, look.strokes, style)).collect();
    let thin = Stroke { colour, width: style.unstable_width };
    svg.polylines(strokes.iter().map(|ends| (ends.as_slice(), None)), thin);
    for points in stretches {
        if let [lone] = points[..] {
            draw_dot(svg, lone, line, colour, style);
        }
    }
}

/// The dash pattern fitted to a line; `None` for a line without length.
fn dashes(points: &[PagePoint], (dash, gap): (f64, f64)) -> Option<Dashes> {
    let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    let period = dash + gap;
    let stretched = length / (length / period).round().max(1.0);
    let (dash, gap) = (stretched * dash / period, stretched * gap / period);
    (length > 0.0).then_some(Dashes { dash, gap, offset: dash + 0.5 * gap })
}

/// Strokes across a line, in groups at equal distances; none across a line shorter than a stroke.
pub(crate) fn strokes(points: &[PagePoint], in_a_group: usize, style: &Style) -> Vec<[PagePoint; 2]> {
    let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    if in_a_group == 0 || length < 2.0 * style.stroke_reach {
        return Vec::new();
    }
    let (spacing, apart) = style.stroke_spacing;
    let groups = (length / spacing).floor().max(1.0) as usize;
    let centre = |group: usize| (group as f64 + 0.5) / groups as f64 * length;
    let beside = |k: usize| (k as f64 - 0.5 * (in_a_group as f64 - 1.0)) * apart;
    let places = (0..groups).flat_map(|group| (0..in_a_group).map(move |k| centre(group) + beside(k)));
    let (mut strokes, mut pairs) = (Vec::new(), points.windows(2).peekable());
    let mut walked = 0.0;
    for place in places {
        while let Some(pair) = pairs.peek() {
            let step = distance(pair[0], pair[1]);
            if walked + step >= place && step > 0.0 {
                strokes.push(across([pair[0], pair[1]], (place - walked) / step, style.stroke_reach));
                break;
            }
            walked += step;
            pairs.next();
        }
    }
    strokes
}

/// A stroke across a straight line, at a fraction of its length.
fn across([from, to]: [PagePoint; 2], share: f64, reach: f64) -> [PagePoint; 2] {
    let length = distance(from, to);
    let normal = ((from.y - to.y) / length, (to.x - from.x) / length);
    let at = (from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
    [reach, -reach].map(|side| PagePoint { x: at.0 + side * normal.0, y: at.1 + side * normal.1 })
}

/// A single solution: a full dot if stable, an open one if unstable, an open one with a broad line if
/// marginal.
fn draw_dot(svg: &mut SvgWriter, at: PagePoint, line: LineLook, colour: &str, style: &Style) {
    let fill = if line == LineLook::Stable { colour } else { PAPER };
    let width = if line == LineLook::Marginal { style.stable_width } else { style.unstable_width };
    let (r, x) = (number(style.stable_width), number(at.x - style.stable_width));
    let diameter = number(2.0 * style.stable_width);
    let outline = format!("M{x} {}a{r} {r} 0 1 0 {diameter} 0a{r} {r} 0 1 0 -{diameter} 0z", number(at.y));
    svg.path(&outline, fill, Stroke { colour, width });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_number_of_dashes_fits_into_every_stretch() {
        let style = Style::default();
        for length in [0.3, 2.0, 7.0, 399.0] {
            let line = [PagePoint { x: 0.0, y: 0.0 }, PagePoint { x: length, y: 0.0 }];
            let dashes = dashes(&line, style.dash).unwrap();
            let count = length / (dashes.dash + dashes.gap);
            assert!((count - count.round()).abs() < 1e-9 && count >= 0.999);
            assert!(dashes.dash < 1.5 * style.dash.0);
        }
    }
    #[test]
    fn strokes_stand_across_the_line_at_equal_distances() {
        let style = Style::default();
        let at = |x: f64, y: f64| PagePoint { x, y };
        // 3-4-5 triangles: 50 pt to the corner, as many behind it.
        let line = [at(0.0, 0.0), at(30.0, 40.0), at(60.0, 0.0)];
        let strokes = strokes(&line, 2, &style);
        let groups = (100.0 / style.stroke_spacing.0).floor();
        assert_eq!(strokes.len(), 2 * groups as usize);
        for (k, [one, other]) in strokes.iter().enumerate() {
            let middle = at(0.5 * (one.x + other.x), 0.5 * (one.y + other.y));
            let along = ((k / 2) as f64 + 0.5) / groups * 100.0 + (k % 2) as f64 * 1.6 - 0.8;
            let height = 0.8 * along.min(100.0 - along);
            assert!((middle.x - 0.6 * along).abs() < 1e-9 && (middle.y - height).abs() < 1e-9, "{k}");
            assert!((distance(*one, *other) - 2.0 * style.stroke_reach).abs() < 1e-9);
            let slope = if along < 50.0 { 0.8 } else { -0.8 };
            assert!((0.6 * (one.x - other.x) + slope * (one.y - other.y)).abs() < 1e-9, "{k}");
        }
        assert!(super::strokes(&line, 0, &style).is_empty());
        assert!(super::strokes(&[at(0.0, 0.0), at(1.0, 0.0)], 2, &style).is_empty());
        assert!(super::strokes(&[at(0.0, 0.0)], 1, &style).is_empty());
    }
}
