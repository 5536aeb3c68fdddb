//! Lines and points of one's own, in the look of every other figure.

use crate::{
    bifurcation::Bifurcation,
    chart::{Chart, ChartPanel, Measure},
    chart_row::{ChartColumn, draw_row},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::{LabelSide, Layer},
    legend::{LegendEntry, LegendSample},
    marks::Mark,
    scale::ScaleChoice,
    stretch::LineLook,
    style::{PALE_INK, Pattern, SHADE, Style, line_pattern, period_look},
    text::Text,
};

/// Half the side of the smallest dots (pt).
const SPECK: f64 = 0.4;

/// Panels side by side.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DataDiagram {
    /// From left to right.
    pub panels: Vec<DataPanel>,
    /// What the figure shows, for readers that cannot see it.
    pub description: String,
}

/// A frame with two axes, and the legend above it.
#[derive(Debug, Clone, PartialEq)]
pub struct DataPanel {
    /// Heading above the legend; may be empty.
    pub heading: String,
    /// Horizontal axis.
    pub x: DataAxis,
    /// Vertical axis.
    pub y: DataAxis,
    /// Width relative to the other panels.
    pub width: f64,
    /// Whether units of both axes have the same length on the page.
    pub equal_units: bool,
    /// Lines and points, the first at the bottom.
    pub series: Vec<DataSeries>,
    /// Texts beside points.
    pub labels: Vec<DataLabel>,
    /// Horizontal reference lines.
    pub levels: Vec<f64>,
    /// Vertical reference lines.
    pub uprights: Vec<f64>,
    /// Shaded rectangles behind everything: left, right, bottom, top.
    pub shaded: Vec<[f64; 4]>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DataAxis {
    /// What it measures, with the unit in brackets.
    pub label: String,
    /// Its scale.
    pub scale: ScaleChoice,
    /// Its ends; `None` for a little beyond the data.
    pub ends: Option<(f64, f64)>,
}

/// Points of one look.
#[derive(Debug, Clone, PartialEq)]
pub struct DataSeries {
    /// Name in the legend; none if it is empty. Of equal names the first has the entry.
    pub name: String,
    /// How the points are drawn.
    pub look: DataLook,
    /// In the order of the line; one that is not finite or outside the axes is a gap.
    pub points: Vec<(f64, f64)>,
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DataLook {
    /// A line with the colour and the dashes of a number, from 0: the first is solid.
    Line(usize),
    /// A pale line, for comparison.
    Pale,
    /// A branch of stable solutions.
    Stable,
    /// A branch of unstable solutions.
    Unstable,
    /// Full dots with the colour and the shape of a number, from 0.
    Dots(usize),
    /// Their outlines.
    Circles(usize),
    /// The smallest dots, for clouds, with the colour of a number.
    Specks(usize),
    /// Events on a branch, with their mark.
    Events(Bifurcation),
}

/// A text beside a point.
#[derive(Debug, Clone, PartialEq)]
pub struct DataLabel {
    /// The point, in the units of the axes.
    pub at: (f64, f64),
    /// The text.
    pub text: String,
    /// Where it stands.
    pub side: LabelSide,
}

impl DataAxis {
    /// A linear axis a little longer than the data.
    #[must_use]
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), scale: ScaleChoice::Linear, ends: None }
    }

    /// A logarithmic one.
    #[must_use]
    pub fn logarithmic(label: &str) -> Self {
        Self { scale: ScaleChoice::Logarithmic, ..Self::linear(label) }
    }

    /// The axis between two ends.
    #[must_use]
    pub fn between(self, from: f64, to: f64) -> Self {
        Self { ends: Some((from, to)), ..self }
    }

    fn measure(&self) -> Measure {
        Measure { choice: self.scale, ends: self.ends, ..Measure::new(self.label.as_str()) }
    }
}

impl DataSeries {
    /// Points with a name in the legend and a look.
    pub fn new(name: &str, look: DataLook, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { name: name.to_owned(), look, points: points.into_iter().collect() }
    }
}

impl DataPanel {
    /// A panel with two axes and series, without anything else.
    #[must_use]
    pub fn new(x: DataAxis, y: DataAxis, series: Vec<DataSeries>) -> Self {
        Self {
            heading: String::new(),
            x,
            y,
            width: 1.0,
            equal_units: false,
            series,
            labels: Vec::new(),
            levels: Vec::new(),
            uprights: Vec::new(),
            shaded: Vec::new(),
        }
    }

    fn column(&self, style: &Style) -> ChartColumn {
        let references = [
            Layer::Cells { cells: self.shaded.clone(), colour: SHADE },
            Layer::Levels { at: self.levels.clone() },
            Layer::Uprights { at: self.uprights.clone() },
        ];
        let series = self.series.iter().map(|series| series.look.drawn(style).layer(&series.points));
        let labels = self.labels.iter().map(|label| Layer::Label {
            at: label.at,
            text: Text::upright(label.text.as_str()),
            side: label.side,
        });
        let panel = ChartPanel {
            quantity: "point",
            y: self.y.measure(),
            layers: references.into_iter().chain(series).chain(labels).collect(),
            heading: String::new(),
        };
        let mut legend: Vec<LegendEntry> = Vec::new();
        for DataSeries { name, look, .. } in self.series.iter().filter(|series| !series.name.is_empty()) {
            if legend.iter().all(|entry| entry.name != *name) {
                legend.push(LegendEntry { sample: look.drawn(style).sample(), name: name.clone() });
            }
        }
        let chart = Chart {
            title: self.heading.clone(),
            x: self.x.measure(),
            panels: vec![panel],
            legend: vec![legend],
            description: String::new(),
            aspect: None,
        };
        ChartColumn { chart, width: self.width, equal_units: self.equal_units }
    }
}

/// What a look is made of.
#[derive(Debug, Clone, Copy)]
enum Drawn {
    Line(Pattern),
    Branch(LineLook),
    Dots(Dot),
    Events(Mark),
}

impl DataLook {
    fn drawn(self, style: &Style) -> Drawn {
        const SHAPES: [Shape; 4] = [Shape::Circle, Shape::Square, Shape::TriangleUp, Shape::TriangleDown];
        let dots = |number: usize, shape, full, radius| {
            Drawn::Dots(Dot { shape, colour: line_pattern(number).colour, full, radius })
        };
        let shape = |number: usize| SHAPES[number % SHAPES.len()];
        match self {
            Self::Line(number) => Drawn::Line(line_pattern(number)),
            Self::Pale => Drawn::Line(Pattern { colour: PALE_INK, dashes: None }),
            Self::Stable => Drawn::Branch(LineLook::Stable),
            Self::Unstable => Drawn::Branch(LineLook::Unstable),
            Self::Dots(number) => dots(number, shape(number), true, style.mark_radius),
            Self::Circles(number) => dots(number, shape(number), false, style.mark_radius),
            Self::Specks(number) => dots(number, Shape::Speck, true, SPECK),
            Self::Events(Bifurcation::Fold) => Drawn::Events(Mark::Fold),
            Self::Events(Bifurcation::Flip) => Drawn::Events(Mark::Flip),
            Self::Events(Bifurcation::NeimarkSacker) => Drawn::Events(Mark::NeimarkSacker),
            Self::Events(Bifurcation::Grazing) => Drawn::Events(Mark::Grazing),
        }
    }
}

impl Drawn {
    fn layer(self, points: &[(f64, f64)]) -> Layer {
        let points = points.to_vec();
        match self {
            Self::Line(pattern) => Layer::Line { points, pattern },
            Self::Branch(look) => Layer::Stretch { points, look },
            Self::Dots(dot) => Layer::Dots { points, dot },
            Self::Events(mark) => Layer::Events { points, mark },
        }
    }

    fn sample(self) -> LegendSample {
        match self {
            Self::Line(pattern) => LegendSample::Pattern(pattern),
            Self::Branch(line) => LegendSample::Line { look: period_look(1), line },
            Self::Dots(dot) => LegendSample::Dot(dot),
            Self::Events(mark) => LegendSample::Mark(mark),
        }
    }
}

impl DataDiagram {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where a panel has no point with a place on its axes;
    /// [`FigureError::NoQuantity`] without a panel.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let columns: Vec<ChartColumn> = self.panels.iter().map(|panel| panel.column(style)).collect();
        draw_row(&columns, &self.description, style)
    }
}
