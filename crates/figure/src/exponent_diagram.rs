//! Lyapunov exponents over the frequency, and how they converge.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    style::{INK, PALE_INK, Pattern, Style, line_pattern},
};

/// Largest number of exponents whose convergence is drawn.
const MOST: usize = 6;

/// The largest exponent and the dimension over the frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExponentDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// By rising frequency.
    pub points: Vec<ExponentPoint>,
}

/// The largest exponent at a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ExponentPoint {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Largest exponent (1/s).
    pub largest_per_s: f64,
    /// Half of the width of its interval of 95 per cent (1/s).
    pub half_width_per_s: f64,
    /// Dimension after Kaplan and Yorke, of the section.
    pub dimension: f64,
}

impl ExponentDiagram {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no exponent, or no dimension, is finite.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let dot = Dot { shape: Shape::Circle, colour: INK, full: true, radius: style.mark_radius };
        let pale = Pattern { colour: PALE_INK, dashes: None };
        let values = |value: fn(&ExponentPoint) -> f64| -> Vec<(f64, f64)> {
            self.points.iter().map(|point| (point.frequency_hz, value(point))).collect()
        };
        let interval = |point: &ExponentPoint| {
            let (low, high) =
                (point.largest_per_s - point.half_width_per_s, point.largest_per_s + point.half_width_per_s);
            (point.frequency_hz, low, high)
        };
        let (largest, dimension) = (values(|point| point.largest_per_s), values(|point| point.dimension));
        let exponents = vec![
            Layer::Levels { at: vec![0.0] },
            Layer::Line { points: largest.clone(), pattern: pale },
            Layer::Whiskers { intervals: self.points.iter().map(interval).collect(), colour: INK },
            Layer::Dots { points: largest, dot },
        ];
        let dimensions = vec![
            Layer::Line { points: dimension.clone(), pattern: pale },
            Layer::Dots { points: dimension, dot },
        ];
        let panel = |quantity, label: &str, layers| ChartPanel {
            quantity,
            y: Measure::new(label),
            layers,
            heading: String::new(),
        };
        let panels = vec![
            panel("largest exponent", "Largest exponent (1/s)", exponents),
            panel("dimension", "Kaplan–Yorke dimension (–)", dimensions),
        ];
        let legend = vec![vec![LegendEntry {
            sample: LegendSample::Dot(dot),
            name: "mean, with its interval of 95 per cent".to_owned(),
        }]];
        let frequencies = self.points.iter().map(|point| point.frequency_hz);
        let x = Measure::frequency("Excitation frequency", style, frequencies);
        let count = self.points.len();
        let description =
            format!("largest Lyapunov exponent and Kaplan-Yorke dimension at {count} frequencies");
        Chart { title: self.title.clone(), x, panels, legend, description, aspect: None }.draw(style)
    }
}

/// Exponents over the averaging time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ConvergenceDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Times (s), each with the exponents after it (1/s), the largest first.
    pub places: Vec<(f64, Vec<f64>)>,
}

impl ConvergenceDiagram {
    /// The figure, in that style; of many exponents the six largest are drawn.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no exponent is finite.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let all = self.places.iter().map(|(_, exponents)| exponents.len()).max().unwrap_or(0);
        let drawn = all.min(MOST);
        let line = |k: usize| Layer::Line {
            points: self
                .places
                .iter()
                .map(|(time, exponents)| (*time, exponents.get(k).copied().unwrap_or(f64::NAN)))
                .collect(),
            pattern: line_pattern(k),
        };
        let mut layers = vec![Layer::Levels { at: vec![0.0] }];
        layers.extend((0..drawn).map(line));
        let name = |k: usize| if k == 0 { "1 (largest)".to_owned() } else { (k + 1).to_string() };
        let entry = |k: usize| LegendEntry { sample: LegendSample::Pattern(line_pattern(k)), name: name(k) };
        let legend = vec![(0..drawn).map(entry).collect()];
        let y = Measure::new("Lyapunov exponent (1/s)");
        let panels = vec![ChartPanel { quantity: "exponent", y, layers, heading: String::new() }];
        let description = format!(
            "convergence of the {drawn} largest of {all} Lyapunov exponents at {}",
            style.frequency_unit.words(self.frequency_hz)
        );
        let x = Measure::logarithmic("Averaging time (s)");
        Chart { title: self.title.clone(), x, panels, legend, description, aspect: None }.draw(style)
    }
}
