//! The layout of title, legend and panels.

use super::{
    data::{
        MeasuredMotion, OverlaidBranches, ResponseDiagram, ResponseQuantity, ResponseSettings, period_name,
    },
    panel::ResponsePanel,
};
use crate::{
    axis::PlotAxis,
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    layer::Layer,
    legend::{Legend, LegendEntry, LegendSample},
    marks::Mark,
    plot::{Area, Plot, lettering, room_below, room_left, room_right},
    scale::{Scale, ScaleKind, extent, span_of},
    stretch::LineLook,
    style::{INK, PALE_INK, PeriodLook, SHADE, Style, overlaid_look, period_look},
    svg::{Anchor, Dashes, PagePoint, Stroke, SvgWriter, points},
    text::{Text, wrap},
};

/// Space around everything (pt).
const MARGIN: f64 = 2.0;
/// Space between title, legend and panels (pt).
const GAP: f64 = 5.0;
/// Distance of tick labels on the horizontal and vertical axis (pt).
const TICK_SPACING: (f64, f64) = (42.0, 27.0);

/// Draws a panel for each quantity.
pub(super) fn draw(
    diagram: &ResponseDiagram,
    quantities: &[ResponseQuantity],
    settings: &ResponseSettings,
) -> Result<Figure, FigureError> {
    let range_hz = frequency_range(diagram)?;
    let panels_of = |range_hz| {
        quantities.iter().map(move |&quantity| ResponsePanel::new(diagram, quantity, range_hz, settings))
    };
    let mut panels = panels_of(range_hz).collect::<Result<Vec<_>, _>>()?;
    let detail = settings.detail.map(in_order).transpose()?;
    let wholes = panels.len();
    for panel in detail.into_iter().flat_map(panels_of) {
        match panel {
            // A branch that is elsewhere, or a quantity that has no values there.
            Err(FigureError::Empty { .. }) => {}
            panel => panels.push(panel?),
        }
    }
    let detail = detail.filter(|_| panels.len() > wholes);
    if panels.is_empty() {
        return Err(FigureError::NoQuantity);
    }
    // Only marks that have room have an entry in the legend, above the plots where that shows.
    let all = ResponseLayout::new(diagram, (&panels, detail), settings, &Mark::ALL);
    let drawn = all.drawn_marks();
    Ok(ResponseLayout::new(diagram, (&panels, detail), settings, &drawn).draw())
}

/// Ends of an axis that are in order.
fn in_order((from, to): (f64, f64)) -> Result<(f64, f64), FigureError> {
    let shown = [from, to].into_iter().all(|end| ScaleKind::Linear.shows(end));
    if shown && from < to { Ok((from, to)) } else { Err(FigureError::AxisRange { from, to }) }
}

/// Ends of the frequency axis: the given ones, else the range of the finite frequencies with a small margin.
fn frequency_range(diagram: &ResponseDiagram) -> Result<(f64, f64), FigureError> {
    if let Some(range_hz) = diagram.frequency_range_hz {
        return in_order(range_hz);
    }
    let frequencies = diagram.all_points().map(|point| point.frequency_hz);
    let (least, greatest) =
        extent(frequencies.filter(|&frequency| ScaleKind::Linear.shows(frequency))).unwrap_or((0.0, 1.0));
    let margin = match span_of((least, greatest)) {
        0.0 => 0.05 * if greatest == 0.0 { 1e-3 } else { greatest.abs() },
        span => 0.015 * span,
    };
    Ok((least - margin, greatest + margin))
}

/// The parts of the figure with their positions.
struct ResponseLayout<'a> {
    diagram: &'a ResponseDiagram,
    style: &'a Style,
    detail: Option<(f64, f64)>,
    panels: &'a [ResponsePanel],
    title: Vec<Text>,
    legend: Legend,
    plots: Vec<Plot>,
    left: f64,
    height: f64,
}

impl<'a> ResponseLayout<'a> {
    /// * `panels`: of the whole, and then of the detail, if there is one.
    /// * `marks`: those that are in the legend if there are such events.
    fn new(
        diagram: &'a ResponseDiagram,
        (panels, detail): (&'a [ResponsePanel], Option<(f64, f64)>),
        settings: &'a ResponseSettings,
        marks: &[Mark],
    ) -> Self {
        let style = &settings.style;
        let panel_height = panel_share(panels.len()) * points(style.height_mm) - room_below(style);
        let axes: Vec<PlotAxis> = panels
            .iter()
            .map(|panel| PlotAxis::new(panel.scale, panel.label(), 0.85 * panel_height, TICK_SPACING.1))
            .collect();
        let label_width = axes.iter().map(|axis| axis.label_width(style.tick_size)).fold(0.0, f64::max);
        let left = room_left(style, label_width);
        let across = |panel: &ResponsePanel| Scale::exact(ScaleKind::Linear, panel.range_hz);
        let (label, factor) = horizontal(diagram, panels, style);
        let room = |panel| room_right(style, (&across(panel), factor), left, TICK_SPACING.0);
        let right = points(style.width_mm) - MARGIN - panels.iter().map(room).fold(0.0, f64::max);
        let title = wrap(&diagram.title, style.label_size, right - left);
        let legend = Legend::new(entries(panels, diagram, marks), style, right - left);
        let mut top = MARGIN + title.len() as f64 * title_height(style) + legend.height(style) + GAP;
        let labels = axes.iter().map(|axis| axis.label.width(style.label_size));
        let plot_height = labels.fold(panel_height - top, f64::max);
        let mut plots = Vec::new();
        for (i, (y, panel)) in axes.into_iter().zip(panels).enumerate() {
            // Panels above each other with one range have their numbers once, below.
            let labelled_below = panels.get(i + 1).is_none_or(|next| next.range_hz != panel.range_hz);
            let area = Area { left, right, top, bottom: top + plot_height };
            let label = Text::upright(label.clone());
            let x = PlotAxis::in_unit((across(panel), factor), label, right - left, TICK_SPACING.0);
            plots.push(Plot { area, x, y, labelled_below });
            top = area.bottom + 2.0 * GAP + if labelled_below { room_below(style) } else { 0.0 };
        }
        let height = plots[plots.len() - 1].area.bottom + room_below(style);
        Self { diagram, style, detail, panels, title, legend, plots, left, height }
    }

    /// The kinds of marks of which at least one has room.
    fn drawn_marks(&self) -> Vec<Mark> {
        let panels = self.panels.iter().zip(&self.plots);
        let drawn: Vec<(Mark, Vec<PagePoint>)> =
            panels.flat_map(|(panel, plot)| panel.marks(plot, self.style)).collect();
        let has_room = |mark: &Mark| drawn.iter().any(|(kind, places)| kind == mark && !places.is_empty());
        Mark::ALL.into_iter().filter(has_room).collect()
    }

    fn draw(&self) -> Figure {
        let style = self.style;
        let description = self.description();
        let height_mm = self.height * 25.4 / 72.0;
        let mut svg = SvgWriter::new(style.width_mm, height_mm, &self.diagram.title, &description);
        self.draw_head(&mut svg);
        for (panel, plot) in self.panels.iter().zip(&self.plots) {
            let ranges = self.diagram.chaotic_ranges_hz.clone();
            Layer::Shade { ranges }.draw(&mut svg, plot, style);
            plot.draw_grid(&mut svg, style);
            self.frame_detail(&mut svg, panel, plot);
            plot.draw_axes(&mut svg, style);
            panel.draw(&mut svg, plot, style);
        }
        Figure::new(svg.finish(), description, style.width_mm, height_mm)
    }

    /// Lines at the ends of the part that is drawn again, larger, in the panels of the whole.
    fn frame_detail(&self, svg: &mut SvgWriter, panel: &ResponsePanel, plot: &Plot) {
        let Some((from, to)) = self.detail.filter(|detail| *detail != panel.range_hz) else { return };
        let stroke = Stroke { colour: PALE_INK, width: self.style.frame_width };
        let dashes = Some(Dashes { dash: 1.5, gap: 1.5, offset: 0.0 });
        let value = plot.y.scale.from;
        let ends = [from, to].map(|end| {
            let x = plot.place(end, value).x;
            [PagePoint { x, y: plot.area.top }, PagePoint { x, y: plot.area.bottom }]
        });
        let within = |ends: &&[PagePoint; 2]| (plot.area.left..=plot.area.right).contains(&ends[0].x);
        svg.polylines(ends.iter().filter(within).map(|ends| (ends.as_slice(), dashes)), stroke);
    }

    fn draw_head(&self, svg: &mut SvgWriter) {
        let style = self.style;
        for (i, line) in self.title.iter().enumerate() {
            let y = MARGIN + i as f64 * title_height(style) + CAPITAL_HEIGHT * style.label_size;
            svg.text(PagePoint { x: self.left, y }, line, lettering(style.label_size, Anchor::Start));
        }
        let y = MARGIN + self.title.len() as f64 * title_height(style);
        self.legend.draw(svg, PagePoint { x: self.left, y }, style);
    }

    /// Description of the figure.
    fn description(&self) -> String {
        let is_whole = |panel: &&ResponsePanel| panel.range_hz == self.panels[0].range_hz;
        let wholes: Vec<&ResponsePanel> = self.panels.iter().filter(is_whole).collect();
        let names: Vec<&str> = wholes.iter().map(|panel| panel.quantity.name()).collect();
        let curves = self.diagram.curves.len();
        let solutions: usize = self.diagram.curves.iter().map(|curve| curve.points.len()).sum();
        let (branches, names) = (if curves == 1 { "branch" } else { "branches" }, names.join(" and "));
        let has_marginal = self.panels.iter().any(|panel| panel.has(LineLook::Marginal));
        let mut description = format!(
            "{names} over {}, {curves} {branches} with {solutions} solutions; \
             stable solid, {}unstable dashed",
            self.diagram.parameter.as_ref().map_or("excitation frequency", |parameter| &parameter.title),
            if has_marginal { "marginal dotted, " } else { "" }
        );
        if !self.diagram.chaotic_ranges_hz.is_empty() {
            let unit = self.style.frequency_unit.up_to(largest(self.panels));
            let words = |(from, to): &(f64, f64)| {
                let [from, to] = [from, to].map(|end| unit.factor * end);
                format!("{from:.3} to {to:.3} {}", unit.symbol)
            };
            let ranges: Vec<String> = self.diagram.chaotic_ranges_hz.iter().map(words).collect();
            description.push_str(&format!("; chaotic motion found at {}", ranges.join(", ")));
        }
        if !self.diagram.overlaid.is_empty() {
            let names: Vec<&str> = self.diagram.overlaid.iter().map(|other| other.name.as_str()).collect();
            description.push_str(&format!("; behind the branches of {}, thin, those of ", self.diagram.name));
            description.push_str(&names.join(", "));
        }
        for panel in &wholes {
            for of in panel.measured() {
                let (name, count) = (of.motion.name(), of.places.len());
                description.push_str(&format!("; {name}: {count} of {}", panel.quantity.name()));
                if of.beyond > 0 {
                    description.push_str(&format!(", {} more beyond the axes", of.beyond));
                }
            }
        }
        for (panel, plot) in wholes.iter().zip(&self.plots) {
            for (mark, places) in panel.marks(plot, self.style) {
                let (all, drawn) = (panel.count(mark), places.len());
                description.push_str(&format!("; {} of {}: {all}", mark.name(), panel.quantity.name()));
                if drawn < all {
                    description.push_str(&format!(", marked at {drawn} places"));
                }
            }
            if panel.branches_at_flips() > 0 {
                let (count, quantity) = (panel.branches_at_flips(), panel.quantity.name());
                description
                    .push_str(&format!("; branch point of {quantity}, marked as the flip it is: {count}"));
            }
        }
        if let Some((from, to)) = self.detail {
            description.push_str(&format!("; drawn again below from {from} to {to}"));
        }
        description
    }
}

/// Label of the horizontal axis, and the factor of its numbers.
fn horizontal(diagram: &ResponseDiagram, panels: &[ResponsePanel], style: &Style) -> (String, f64) {
    match &diagram.parameter {
        Some(parameter) => {
            let unit = parameter.unit_up_to(largest(panels));
            (parameter.label(&unit), unit.factor)
        }
        None => {
            let unit = style.frequency_unit.up_to(largest(panels));
            (format!("Excitation frequency ({})", unit.symbol), unit.factor)
        }
    }
}

/// Largest value of the horizontal axes, whatever its sign.
fn largest(panels: &[ResponsePanel]) -> f64 {
    let ends = panels.iter().map(|panel| panel.range_hz);
    ends.fold(0.0, |most: f64, (low, high)| most.max(low.abs()).max(high.abs()))
}

/// Height of a panel over the height of a single one: several panels are lower.
fn panel_share(panels: usize) -> f64 {
    if panels == 1 { 1.0 } else { 0.85 }
}

fn title_height(style: &Style) -> f64 {
    1.5 * style.label_size
}

/// Entries of the legend, for the lines and marks that are drawn.
fn entries(panels: &[ResponsePanel], diagram: &ResponseDiagram, marks: &[Mark]) -> Vec<Vec<LegendEntry>> {
    let mut multiples: Vec<u32> = panels.iter().flat_map(ResponsePanel::period_multiples).collect();
    multiples.sort_unstable();
    multiples.dedup();
    let any = PeriodLook { colour: INK, strokes: 0 };
    let look = if let [single] = multiples[..] { period_look(single) } else { any };
    let colours = multiples.iter().filter(|_| multiples.len() > 1).map(|&multiple| LegendEntry {
        sample: LegendSample::Period(period_look(multiple)),
        name: period_name(multiple),
    });
    let lines = LineLook::ALL
        .into_iter()
        .filter(|line| panels.iter().any(|panel| panel.has(*line)))
        .map(|line| LegendEntry { sample: LegendSample::Line { look, line }, name: line.name().to_owned() });
    let marks = marks
        .iter()
        .copied()
        .filter(|mark| panels.iter().any(|panel| panel.has_mark(*mark)))
        .map(|mark| LegendEntry { sample: LegendSample::Mark(mark), name: mark_name(mark, panels) });
    let is_shaded = !diagram.chaotic_ranges_hz.is_empty();
    let shade = is_shaded
        .then(|| LegendEntry { sample: LegendSample::Cell(SHADE), name: "chaotic motion found".to_owned() });
    let measured = MeasuredMotion::ALL.into_iter().filter_map(|motion| {
        let there = panels.iter().flat_map(ResponsePanel::measured).filter(|of| of.motion == motion);
        let beyond = there.map(|of| of.beyond).max()?;
        let name = match beyond {
            0 => motion.name().to_owned(),
            beyond => format!("{} ({beyond} beyond the axes)", motion.name()),
        };
        Some(LegendEntry { sample: LegendSample::Dot(motion.dot(0.0)), name })
    });
    vec![results(diagram), colours.chain(lines).collect(), marks.chain(shade).collect(), measured.collect()]
}

/// Which results the lines are of, where others are behind them.
fn results(diagram: &ResponseDiagram) -> Vec<LegendEntry> {
    if diagram.overlaid.is_empty() {
        return Vec::new();
    }
    let own = LegendSample::Line { look: period_look(1), line: LineLook::Stable };
    let own = LegendEntry { sample: own, name: diagram.name.clone() };
    let other = |(place, other): (usize, &OverlaidBranches)| LegendEntry {
        sample: LegendSample::Overlaid(overlaid_look(place)),
        name: other.name.clone(),
    };
    std::iter::once(own).chain(diagram.overlaid.iter().enumerate().map(other)).collect()
}

/// The name of a mark, with its second meaning.
fn mark_name(mark: Mark, panels: &[ResponsePanel]) -> String {
    let stands_for_both = mark == Mark::Flip && panels.iter().any(|panel| panel.branches_at_flips() > 0);
    if stands_for_both { "flip, branch point of twice the period".to_owned() } else { mark.name().to_owned() }
}
