//! A chart: panels on top of each other, each a frame with layers, under one title and one legend.
//!
//! Every figure but the response diagram and the curves is a function from its data to one of these. A value
//! without a position on an axis (not finite, not positive on a logarithmic one, outside the ends) is a gap
//! in a line and left out of a cloud. A panel without any value is refused.

use crate::{
    axis::PlotAxis,
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    layer::Layer,
    legend::{Legend, LegendEntry},
    plot::{Area, Plot, lettering, room_below, room_left, room_right},
    scale::{Scale, ScaleChoice, ScaleKind, extent, span_of},
    style::Style,
    svg::{Anchor, PagePoint, SvgWriter, points},
    text::{Text, wrap},
};

/// Space around everything, between head and plot, and between panels (pt).
const MARGIN: f64 = 2.0;
const GAP: f64 = 5.0;
const PANEL_GAP: f64 = 10.0;
/// Distance of tick labels on the horizontal and vertical axis (pt).
const TICK_SPACING: (f64, f64) = (42.0, 24.0);

/// Quantity and scale of an axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measure {
    /// Label with the unit.
    pub(crate) label: Text,
    pub(crate) choice: ScaleChoice,
    /// Ends of the axis; `None` for slightly beyond the data.
    pub(crate) ends: Option<(f64, f64)>,
    /// Factor from the values of the data to the numbers on the axis.
    pub(crate) factor: f64,
}

impl Measure {
    /// A linear axis a little longer than the data.
    pub(crate) fn new(label: impl Into<String>) -> Self {
        Self { label: Text::upright(label), choice: ScaleChoice::Linear, ends: None, factor: 1.0 }
    }

    pub(crate) fn logarithmic(label: impl Into<String>) -> Self {
        Self { choice: ScaleChoice::Logarithmic, ..Self::new(label) }
    }

    /// A linear axis of frequencies in hertz, shown in the unit of the style with the prefix that suits them.
    pub(crate) fn frequency(what: &str, style: &Style, frequencies_hz: impl Iterator<Item = f64>) -> Self {
        let finite = frequencies_hz.filter(|frequency| frequency.is_finite());
        let unit = style.frequency_unit.up_to(finite.fold(0.0, f64::max));
        Self { factor: unit.factor, ..Self::new(format!("{what} ({})", unit.symbol)) }
    }

    pub(crate) fn over_decades(self) -> Self {
        Self { choice: ScaleChoice::Logarithmic, ..self }
    }

    pub(crate) fn between(self, ends: (f64, f64)) -> Self {
        Self { ends: Some(ends), ..self }
    }

    fn kind(&self, values: impl Iterator<Item = f64>) -> ScaleKind {
        self.choice.decide(values.filter(|value| ScaleKind::Linear.shows(*value)))
    }

    /// The scale for values; `None` if no value has a position on it.
    fn scale(&self, kind: ScaleKind, values: impl Iterator<Item = f64>) -> Option<Scale> {
        let (least, greatest) = extent(values.filter(|value| kind.shows(*value)))?;
        Some(match (self.ends, kind) {
            (Some(ends), _) => Scale::exact(kind, ends),
            (None, ScaleKind::Linear) if span_of((least, greatest)) > 0.0 => {
                let margin = 0.05 * (greatest - least);
                Scale::exact(kind, (least - margin, greatest + margin))
            }
            (None, ScaleKind::Linear) => {
                let margin = if least == 0.0 { 1.0 } else { 0.1 * least.abs() };
                Scale::exact(kind, (least - margin, greatest + margin))
            }
            (None, ScaleKind::Logarithmic) => Scale::around(kind, (least, greatest)),
        })
    }
}

/// A frame with layers, the first at the bottom.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChartPanel {
    /// Name of the quantity in messages and descriptions.
    pub(crate) quantity: &'static str,
    pub(crate) y: Measure,
    pub(crate) layers: Vec<Layer>,
    /// Heading above the upper left corner of the frame; may be empty.
    pub(crate) heading: String,
}

/// Panels over one horizontal axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x: Measure,
    pub(crate) panels: Vec<ChartPanel>,
    pub(crate) legend: Vec<Vec<LegendEntry>>,
    /// Description in words, for screen readers.
    pub(crate) description: String,
    /// Height of a panel over its width; by default that of the style.
    pub(crate) aspect: Option<f64>,
}

impl Chart {
    /// The figure.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where a panel has no value with a place; [`FigureError::NoQuantity`] without a
    /// panel.
    pub(crate) fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let plots = self.plots(style, 0.0)?;
        let last = plots.last().ok_or(FigureError::NoQuantity)?;
        let height_mm = (last.area.bottom + room_below(style)) * 25.4 / 72.0;
        let mut svg = SvgWriter::new(style.width_mm, height_mm, &self.title, &self.description);
        self.paint(&mut svg, &plots, style);
        Ok(Figure::new(svg.finish(), self.description.clone(), style.width_mm, height_mm))
    }

    /// Draws title, legend and panels.
    ///
    /// * `plots`: the frames of the panels.
    pub(crate) fn paint(&self, svg: &mut SvgWriter, plots: &[Plot], style: &Style) {
        let Some(area) = plots.first().map(|plot| plot.area) else { return };
        let title = wrap(&self.title, style.label_size, area.right - area.left);
        for (i, line) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(PagePoint { x: area.left, y }, line, lettering(style.label_size, Anchor::Start));
        }
        let y = MARGIN + 1.5 * title.len() as f64 * style.label_size;
        let legend = Legend::new(self.legend.clone(), style, area.right - area.left);
        legend.draw(svg, PagePoint { x: area.left, y }, style);
        for (plot, panel) in plots.iter().zip(&self.panels) {
            plot.draw_grid(svg, style);
            let (ground, above): (Vec<&Layer>, Vec<&Layer>) =
                panel.layers.iter().partition(|layer| layer.is_ground());
            ground.into_iter().for_each(|layer| layer.draw(svg, plot, style));
            plot.draw_axes(svg, style);
            above.into_iter().for_each(|layer| layer.draw(svg, plot, style));
            if !panel.heading.is_empty() {
                let at = PagePoint { x: plot.area.left, y: plot.area.top - 2.5 };
                svg.text(at, &Text::upright(&panel.heading), lettering(style.tick_size, Anchor::Start));
            }
        }
    }

    /// The frames of the panels.
    ///
    /// * `least_top`: room above the first one (pt), more where title and legend need it.
    ///
    /// # Errors
    /// See [`Chart::draw`].
    pub(crate) fn plots(&self, style: &Style, least_top: f64) -> Result<Vec<Plot>, FigureError> {
        let values = || self.panels.iter().flat_map(|panel| &panel.layers).flat_map(Layer::extremes);
        let empty = |panel: &ChartPanel| FigureError::Empty {
            quantity: panel.quantity,
            curves: panel.layers.len(),
            points: panel.layers.iter().map(|layer| layer.extremes().len()).sum(),
        };
        let first = self.panels.first().ok_or(FigureError::NoQuantity)?;
        let kind = self.x.kind(values().map(|(x, _)| x));
        let across = self.x.scale(kind, values().map(|(x, _)| x)).ok_or_else(|| empty(first))?;
        let scales = self.panels.iter().map(|panel| panel.scale(&across).ok_or_else(|| empty(panel)));
        let scales: Vec<Scale> = scales.collect::<Result<_, _>>()?;
        let guess = points(style.height_mm) * if scales.len() > 1 { 0.5 } else { 0.7 };
        let axis = |(scale, panel): (&Scale, &ChartPanel), height: f64| {
            PlotAxis::new(*scale, panel.y.label.clone(), height, TICK_SPACING.1)
        };
        let axes: Vec<PlotAxis> = scales.iter().zip(&self.panels).map(|pair| axis(pair, guess)).collect();
        let labels = axes.iter().map(|axis| axis.label_width(style.tick_size)).fold(0.0, f64::max);
        let left = room_left(style, labels);
        let right = points(style.width_mm)
            - MARGIN
            - room_right(style, (&across, self.x.factor), left, TICK_SPACING.0);
        let title = wrap(&self.title, style.label_size, right - left).len() as f64;
        let legend = Legend::new(self.legend.clone(), style, right - left).height(style);
        let head = (MARGIN + 1.5 * title * style.label_size + legend + GAP).max(least_top);
        let longest = axes.iter().map(|axis| axis.label.width(style.label_size)).fold(0.0, f64::max);
        let height = self.aspect.map_or(guess, |aspect| aspect * (right - left)).max(longest);
        let x =
            PlotAxis::in_unit((across, self.x.factor), self.x.label.clone(), right - left, TICK_SPACING.0);
        let last = self.panels.len() - 1;
        let mut top = head;
        Ok(scales
            .iter()
            .zip(&self.panels)
            .enumerate()
            .map(|(i, pair)| {
                top += if pair.1.heading.is_empty() { 0.0 } else { style.tick_size };
                let area = Area { left, right, top, bottom: top + height };
                top = area.bottom + PANEL_GAP;
                Plot { area, x: x.clone(), y: axis(pair, height), labelled_below: i == last }
            })
            .collect())
    }
}

impl ChartPanel {
    /// The scale for what lies between the ends of the horizontal axis.
    fn scale(&self, across: &Scale) -> Option<Scale> {
        let inside = |x: f64| across.kind.shows(x) && (across.from..=across.to).contains(&x);
        let values = || {
            let all = self.layers.iter().flat_map(Layer::extremes);
            all.filter(|(x, _)| inside(*x)).map(|(_, y)| y)
        };
        self.y.scale(self.y.kind(values()), values())
    }
}
