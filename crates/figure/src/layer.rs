//! Layers of a panel of a chart.

use crate::{
    decimate::decimate,
    dots::{Dot, Shape},
    font::CAPITAL_HEIGHT,
    line::draw_stretches,
    marks::Mark,
    plot::{Plot, lettering},
    scale::Scale,
    stretch::LineLook,
    style::{PALE_INK, Pattern, SHADE, Style, period_look},
    svg::{Anchor, Dashes, PagePoint, Stroke, SvgWriter, number},
    text::Text,
};

/// Distance of a label from its point (pt).
const LABEL_DISTANCE: f64 = 3.5;

/// A layer, in the units of the axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Layer {
    /// A line through points; one that is not finite is a gap, one alone between gaps a dot.
    Line { points: Vec<(f64, f64)>, pattern: Pattern },
    /// Dots.
    Dots { points: Vec<(f64, f64)>, dot: Dot },
    /// Intervals: abscissa, low end, high end.
    Whiskers { intervals: Vec<(f64, f64, f64)>, colour: &'static str },
    /// Shaded ranges of the horizontal axis, behind everything.
    Shade { ranges: Vec<(f64, f64)> },
    /// Horizontal reference lines.
    Levels { at: Vec<f64> },
    /// Vertical reference lines.
    Uprights { at: Vec<f64> },
    /// A part of a branch of one stability.
    Stretch { points: Vec<(f64, f64)>, look: LineLook },
    /// Events on a branch.
    Events { points: Vec<(f64, f64)>, mark: Mark },
    /// A text beside a point.
    Label { at: (f64, f64), text: Text, side: LabelSide },
    /// Rectangles of one colour, behind the frame: left, right, bottom, top.
    Cells { cells: Vec<[f64; 4]>, colour: &'static str },
}

/// Side of a point on which its label stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LabelSide {
    /// Left of the point, at its height.
    Left,
    /// Right of it.
    Right,
    /// Above it, centred.
    Above,
    /// Below it, centred.
    Below,
}

impl Layer {
    /// Whether it is drawn behind the frame.
    pub(crate) fn is_ground(&self) -> bool {
        matches!(self, Self::Shade { .. } | Self::Cells { .. } | Self::Levels { .. } | Self::Uprights { .. })
    }

    /// Points that the axes must include, unless their ends are given.
    pub(crate) fn extremes(&self) -> Vec<(f64, f64)> {
        match self {
            Self::Line { points, .. }
            | Self::Dots { points, .. }
            | Self::Stretch { points, .. }
            | Self::Events { points, .. } => {
                points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
            }
            Self::Whiskers { intervals, .. } => {
                let ends = intervals.iter().flat_map(|&(x, low, high)| [(x, low), (x, high)]);
                ends.filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
            }
            Self::Cells { cells, .. } => {
                cells.iter().flat_map(|&[left, right, bottom, top]| [(left, bottom), (right, top)]).collect()
            }
            Self::Shade { .. } | Self::Levels { .. } | Self::Uprights { .. } | Self::Label { .. } => {
                Vec::new()
            }
        }
    }

    pub(crate) fn draw(&self, svg: &mut SvgWriter, plot: &Plot, style: &Style) {
        let is_in = |(x, y): (f64, f64)| shows(&plot.x.scale, x) && shows(&plot.y.scale, y);
        match self {
            Self::Line { points, pattern } => draw_line(svg, plot, (points, *pattern), style),
            Self::Dots { points, dot } => {
                let places: Vec<PagePoint> =
                    points.iter().filter(|at| is_in(**at)).map(|&(x, y)| plot.place(x, y)).collect();
                dot.draw(svg, &places);
            }
            Self::Whiskers { intervals, colour } => {
                let inside =
                    intervals.iter().filter(|(x, low, high)| is_in((*x, *low)) && is_in((*x, *high)));
                let lines: Vec<[PagePoint; 2]> =
                    inside.map(|&(x, low, high)| [plot.place(x, low), plot.place(x, high)]).collect();
                let stroke = Stroke { colour, width: style.unstable_width };
                svg.polylines(lines.iter().map(|line| (line.as_slice(), None)), stroke);
            }
            Self::Shade { ranges } => {
                let (bottom, top) = (plot.y.scale.from, plot.y.scale.to);
                let cells: Vec<[f64; 4]> = ranges.iter().map(|&(from, to)| [from, to, bottom, top]).collect();
                draw_cells(svg, plot, &cells, SHADE);
            }
            Self::Levels { at } => {
                let ends = (plot.x.scale.from, plot.x.scale.to);
                let inside = at.iter().filter(|y| shows(&plot.y.scale, **y));
                let lines = inside.map(|&y| [plot.place(ends.0, y), plot.place(ends.1, y)]);
                draw_references(svg, lines.collect(), style);
            }
            Self::Uprights { at } => {
                let ends = (plot.y.scale.from, plot.y.scale.to);
                let inside = at.iter().filter(|x| shows(&plot.x.scale, **x));
                let lines = inside.map(|&x| [plot.place(x, ends.0), plot.place(x, ends.1)]);
                draw_references(svg, lines.collect(), style);
            }
            Self::Stretch { points, look } => {
                let parts = parts_on_page(plot, points, style);
                draw_stretches(svg, &parts, *look, period_look(1), style);
            }
            Self::Events { points, mark } => {
                let places: Vec<PagePoint> =
                    points.iter().filter(|at| is_in(**at)).map(|&(x, y)| plot.place(x, y)).collect();
                mark.draw(svg, &places, style.mark_radius);
            }
            Self::Label { at, text, side } => draw_label(svg, plot.place(at.0, at.1), text, *side, style),
            Self::Cells { cells, colour } => draw_cells(svg, plot, cells, colour),
        }
    }
}

/// Whether a value lies on an axis; its ends may be off by rounding.
fn shows(scale: &Scale, value: f64) -> bool {
    scale.kind.shows(value) && (-1e-9..=1.0 + 1e-9).contains(&scale.share(value))
}

fn draw_references(svg: &mut SvgWriter, lines: Vec<[PagePoint; 2]>, style: &Style) {
    let dashes = Some(Dashes { dash: 1.5, gap: 1.5, offset: 0.0 });
    let stroke = Stroke { colour: PALE_INK, width: 1.2 * style.frame_width };
    svg.polylines(lines.iter().map(|line| (line.as_slice(), dashes)), stroke);
}

fn draw_label(svg: &mut SvgWriter, at: PagePoint, text: &Text, side: LabelSide, style: &Style) {
    let half = 0.5 * CAPITAL_HEIGHT * style.tick_size;
    let (dx, dy, anchor) = match side {
        LabelSide::Left => (-LABEL_DISTANCE, half, Anchor::End),
        LabelSide::Right => (LABEL_DISTANCE, half, Anchor::Start),
        LabelSide::Above => (0.0, -LABEL_DISTANCE, Anchor::Middle),
        LabelSide::Below => (0.0, LABEL_DISTANCE + 2.0 * half, Anchor::Middle),
    };
    let place = PagePoint { x: at.x + dx, y: at.y + dy };
    svg.text(place, text, lettering(style.tick_size, anchor));
}

/// The parts of a line between gaps, simplified on the page.
fn parts_on_page(plot: &Plot, line: &[(f64, f64)], style: &Style) -> Vec<Vec<PagePoint>> {
    let parts = line.split(|&(x, y)| !(shows(&plot.x.scale, x) && shows(&plot.y.scale, y)));
    let on_page = |part: &[(f64, f64)]| -> Vec<PagePoint> {
        let places: Vec<PagePoint> = part.iter().map(|&(x, y)| plot.place(x, y)).collect();
        decimate(&places, &vec![false; places.len()], style.line_tolerance)
            .into_iter()
            .map(|k| places[k])
            .collect()
    };
    parts.filter(|part| !part.is_empty()).map(on_page).collect()
}

fn draw_line(svg: &mut SvgWriter, plot: &Plot, (line, pattern): (&[(f64, f64)], Pattern), style: &Style) {
    let (lines, lone): (Vec<Vec<PagePoint>>, Vec<Vec<PagePoint>>) =
        parts_on_page(plot, line, style).into_iter().partition(|part| part.len() > 1);
    let dot = Dot { shape: Shape::Circle, colour: pattern.colour, full: true, radius: style.stable_width };
    dot.draw(svg, &lone.concat());
    let dashes = pattern.dashes.map(|(dash, gap)| Dashes { dash, gap, offset: 0.0 });
    let stroke = Stroke { colour: pattern.colour, width: style.stable_width };
    svg.polylines(lines.iter().map(|line| (line.as_slice(), dashes)), stroke);
}

/// Rectangles, clipped at the ends of the axes; neighbours overlap slightly, so that no gap shows between
/// them.
fn draw_cells(svg: &mut SvgWriter, plot: &Plot, cells: &[[f64; 4]], colour: &'static str) {
    let area = plot.area;
    let mut data = String::new();
    for &[left, right, bottom, top] in cells {
        let (low, high) = (plot.place(left, bottom), plot.place(right, top));
        let [x, end] = [low.x, high.x].map(|x| x.clamp(area.left, area.right));
        let [y, floor] = [high.y, low.y].map(|y| y.clamp(area.top, area.bottom));
        if end > x && floor > y {
            let [from, to] = [number(x), number(end)];
            data.push_str(&format!("M{from} {}H{to}V{}H{from}z", number(y), number(floor)));
        }
    }
    if !data.is_empty() {
        svg.path(&data, colour, Stroke { colour, width: 0.0 });
    }
}
