//! Curves of bifurcations: the excitation frequency over a second parameter, with the points of codimension
//! two.
//!
//! Colour and dashes show the bifurcation. A point of codimension two has a dot with its name next to it,
//! where it overlaps neither the frame nor a curve nor another name, if there is such a position.

use crate::{
    axis::PlotAxis,
    bifurcation::Bifurcation,
    decimate::decimate,
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    legend::{Legend, LegendEntry, LegendSample},
    marks::Mark,
    parameter_axis::ParameterAxis,
    plot::{Area, Plot, lettering, room_below, room_left, room_right},
    scale::{Scale, ScaleChoice, ScaleKind, extent, span_of},
    style::{Pattern, Style, bifurcation_pattern},
    svg::{Anchor, Dashes, PagePoint, Stroke, SvgWriter, points},
    text::{Text, wrap},
};

/// Space around everything, and between head and plot (pt).
const MARGIN: f64 = 2.0;
const GAP: f64 = 5.0;
/// Distance of tick labels on the horizontal and vertical axis (pt).
const TICK_SPACING: (f64, f64) = (42.0, 27.0);
/// Distance of a name from its dot (pt).
const NAME_GAP: f64 = 4.0;

/// Curves of bifurcations over one parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurveDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// What the horizontal axis shows.
    pub parameter: ParameterAxis,
    /// The curves, in the order in which they are drawn.
    pub curves: Vec<BifurcationCurve>,
}

/// A curve of bifurcations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BifurcationCurve {
    /// The bifurcation.
    pub bifurcation: Bifurcation,
    /// Period of the solutions over the period of the excitation, from 1.
    pub period_multiple: u32,
    /// Its points in order.
    pub points: Vec<BifurcationCurvePoint>,
}

/// A point of a curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BifurcationCurvePoint {
    /// Value of the parameter, in SI.
    pub parameter: f64,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Name of the point of codimension two; empty for other points.
    pub name: String,
}

impl CurveDiagram {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no curve has a finite point.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let finite = || {
            self.curves.iter().flat_map(|curve| &curve.points).filter(|point| {
                ScaleKind::Linear.shows(point.parameter) && ScaleKind::Linear.shows(point.frequency_hz)
            })
        };
        let empty = || FigureError::Empty { quantity: "frequency", curves: self.curves.len(), points: 0 };
        let kind = ScaleChoice::Automatic.decide(finite().map(|point| point.parameter));
        let across = extent(finite().map(|point| point.parameter)).ok_or_else(empty)?;
        let up = extent(finite().map(|point| point.frequency_hz)).ok_or_else(empty)?;
        let scales = (close_around(kind, across), close_around(ScaleKind::Linear, up));
        let (plot, legend, title) = self.laid_out(scales, style);
        let height_mm = (plot.area.bottom + room_below(style)) * 25.4 / 72.0;
        let description = self.description();
        let mut svg = SvgWriter::new(style.width_mm, height_mm, &self.title, &description);
        for (i, line) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(PagePoint { x: plot.area.left, y }, line, lettering(style.label_size, Anchor::Start));
        }
        let below_title = MARGIN + 1.5 * title.len() as f64 * style.label_size;
        legend.draw(&mut svg, PagePoint { x: plot.area.left, y: below_title }, style);
        plot.draw_grid(&mut svg, style);
        plot.draw_axes(&mut svg, style);
        for curve in &self.curves {
            draw_curve(&mut svg, &plot, curve, style);
        }
        self.draw_names(&mut svg, &plot, style);
        Ok(Figure::new(svg.finish(), description, style.width_mm, height_mm))
    }

    fn laid_out(&self, (across, up): (Scale, Scale), style: &Style) -> (Plot, Legend, Vec<Text>) {
        let plot_height = points(style.height_mm) - room_below(style);
        let unit = style.frequency_unit.up_to(up.to);
        let label = Text::upright(format!("Excitation frequency ({})", unit.symbol));
        let y = PlotAxis::in_unit((up, unit.factor), label, 0.85 * plot_height, TICK_SPACING.1);
        let left = room_left(style, y.label_width(style.tick_size));
        let unit = self.parameter.unit_up_to(across.from.abs().max(across.to.abs()));
        let room = room_right(style, (&across, unit.factor), left, TICK_SPACING.0);
        let right = points(style.width_mm) - MARGIN - room;
        let label = Text::upright(self.parameter.label(&unit));
        let x = PlotAxis::in_unit((across, unit.factor), label, right - left, TICK_SPACING.0);
        let title = wrap(&self.title, style.label_size, right - left);
        let legend = Legend::new(vec![self.entries()], style, right - left);
        let top = MARGIN + 1.5 * title.len() as f64 * style.label_size + legend.height(style) + GAP;
        let area = Area { left, right, top, bottom: plot_height.max(top + 50.0) };
        (Plot { area, x, y, labelled_below: true }, legend, title)
    }

    /// Entries of the legend, one per kind of curve.
    fn entries(&self) -> Vec<LegendEntry> {
        let mut entries: Vec<LegendEntry> = Vec::new();
        for curve in self.curves.iter().filter(|curve| !curve.points.is_empty()) {
            let kind = curve.bifurcation.name();
            let name = match curve.period_multiple {
                0 | 1 => kind.to_owned(),
                multiple => format!("{kind} of the 1/{multiple} subharmonic"),
            };
            let entry =
                LegendEntry { sample: LegendSample::Pattern(bifurcation_pattern(curve.bifurcation)), name };
            if !entries.contains(&entry) {
                entries.push(entry);
            }
        }
        entries
    }

    fn description(&self) -> String {
        let names: Vec<&str> = self.named().map(|point| point.name.as_str()).collect();
        let curves = self.curves.len();
        let what = if curves == 1 { "curve" } else { "curves" };
        let marked = if names.is_empty() { String::new() } else { format!("; marked: {}", names.join(", ")) };
        format!("excitation frequency over {}, {curves} {what} of bifurcations{marked}", self.parameter.title)
    }

    fn named(&self) -> impl Iterator<Item = &BifurcationCurvePoint> {
        self.curves.iter().flat_map(|curve| &curve.points).filter(|point| !point.name.is_empty())
    }

    /// Draws dots and names of the points of codimension two; coinciding ones with the same name are drawn
    /// once.
    fn draw_names(&self, svg: &mut SvgWriter, plot: &Plot, style: &Style) {
        let lines: Vec<Vec<PagePoint>> = self.curves.iter().map(|curve| line(plot, curve, style)).collect();
        let mut taken: Vec<Area> = Vec::new();
        let mut done: Vec<(PagePoint, &str)> = Vec::new();
        for point in self.named() {
            let at = plot.place(point.parameter, point.frequency_hz);
            let is_same = |(other, name): &(PagePoint, &str)| {
                *name == point.name && (other.x - at.x).hypot(other.y - at.y) < style.mark_distance
            };
            if done.iter().any(is_same) {
                continue;
            }
            done.push((at, &point.name));
            Mark::Fold.draw(svg, &[at], 1.3 * style.mark_radius);
            let text = Text::upright(&point.name);
            let size = (text.width(style.tick_size), CAPITAL_HEIGHT * style.tick_size);
            let boxes = places(at, size);
            let is_free = |place: &&Area| {
                is_inside(place, &plot.area)
                    && !taken.iter().any(|other| overlap(place, other))
                    && !lines.iter().any(|line| crosses(line, place))
            };
            let place = boxes.iter().find(is_free).unwrap_or(&boxes[0]);
            svg.text(
                PagePoint { x: place.left, y: place.bottom },
                &text,
                lettering(style.tick_size, Anchor::Start),
            );
            taken.push(*place);
        }
    }
}

/// A scale close around the data, which need not include zero.
fn close_around(kind: ScaleKind, (least, greatest): (f64, f64)) -> Scale {
    if kind == ScaleKind::Linear && span_of((least, greatest)) > 0.0 {
        let margin = 0.05 * (greatest - least);
        return Scale::exact(kind, (least - margin, greatest + margin));
    }
    Scale::around(kind, (least, greatest))
}

fn draw_curve(svg: &mut SvgWriter, plot: &Plot, curve: &BifurcationCurve, style: &Style) {
    let Pattern { colour, dashes } = bifurcation_pattern(curve.bifurcation);
    let line = line(plot, curve, style);
    let dashes = dashes.map(|(dash, gap)| Dashes { dash, gap, offset: 0.0 });
    let stroke = Stroke { colour, width: style.stable_width };
    svg.polylines(std::iter::once((line.as_slice(), dashes)), stroke);
}

/// A curve on the page, in as few points as give the same line.
fn line(plot: &Plot, curve: &BifurcationCurve, style: &Style) -> Vec<PagePoint> {
    let shown = |point: &&BifurcationCurvePoint| {
        plot.x.scale.kind.shows(point.parameter) && plot.y.scale.kind.shows(point.frequency_hz)
    };
    let visible: Vec<&BifurcationCurvePoint> = curve.points.iter().filter(shown).collect();
    let line: Vec<PagePoint> =
        visible.iter().map(|point| plot.place(point.parameter, point.frequency_hz)).collect();
    let keep: Vec<bool> = visible.iter().map(|point| !point.name.is_empty()).collect();
    decimate(&line, &keep, style.line_tolerance).into_iter().map(|k| line[k]).collect()
}

/// Whether a line crosses a box, checked in steps of half a point.
fn crosses(line: &[PagePoint], place: &Area) -> bool {
    line.windows(2).any(|pair| {
        let (dx, dy) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        let steps = (2.0 * dx.hypot(dy)).ceil().max(1.0) as u32;
        (0..=steps).any(|k| {
            let part = f64::from(k) / f64::from(steps);
            let (x, y) = (pair[0].x + part * dx, pair[0].y + part * dy);
            (place.left..=place.right).contains(&x) && (place.top..=place.bottom).contains(&y)
        })
    })
}

/// Possible positions of a name next to its dot, the best first.
fn places(at: PagePoint, (width, height): (f64, f64)) -> [Area; 6] {
    let box_at = |left: f64, bottom: f64| Area { left, right: left + width, top: bottom - height, bottom };
    let (right, left) = (at.x + NAME_GAP, at.x - NAME_GAP - width);
    let (above, below) = (at.y - NAME_GAP, at.y + NAME_GAP + height);
    let middle = at.x - 0.5 * width;
    [
        box_at(right, above),
        box_at(left, above),
        box_at(right, below),
        box_at(left, below),
        box_at(middle, above - NAME_GAP),
        box_at(middle, below + NAME_GAP),
    ]
}

fn is_inside(place: &Area, area: &Area) -> bool {
    place.left > area.left + 1.0
        && place.right < area.right - 1.0
        && place.top > area.top + 1.0
        && place.bottom < area.bottom - 1.0
}

fn overlap(a: &Area, b: &Area) -> bool {
    a.left < b.right + 1.0 && b.left < a.right + 1.0 && a.top < b.bottom + 1.0 && b.top < a.bottom + 1.0
}
