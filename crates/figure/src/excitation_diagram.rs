//! The amplitude of the excitation over the frequency, in the computation and as measured.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    scale::extent,
    style::{INK, Style, line_pattern},
};

/// Amplitudes of an excitation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExcitationDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Label of the vertical axis: the quantity with its unit.
    pub quantity: String,
    /// Frequency (Hz) and amplitude, in order.
    pub rows: Vec<(f64, f64)>,
    /// Amplitudes of further supports at the same frequencies.
    pub further: Vec<Vec<f64>>,
    /// Names of these supports, the first one first; empty for one.
    pub names: Vec<String>,
    /// Measured amplitudes: frequency (Hz) and amplitude.
    pub measured: Vec<(f64, f64)>,
}

impl ExcitationDiagram {
    /// The figure; its vertical axis starts at zero.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no row is finite.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let values = self.rows.iter().chain(&self.measured).map(|(_, value)| *value);
        let values = values.chain(self.further.iter().flatten().copied());
        let largest = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
        let dot = Dot { shape: Shape::Square, colour: INK, full: false, radius: 1.3 * style.mark_radius };
        let mut legend = Vec::new();
        if !self.measured.is_empty() {
            let (line, dots) = (LegendSample::Pattern(line_pattern(0)), LegendSample::Dot(dot));
            legend.push(LegendEntry { sample: line, name: "computed with".to_owned() });
            legend.push(LegendEntry { sample: dots, name: "measured".to_owned() });
        }
        let named = self.names.iter().enumerate();
        legend.extend(named.map(|(k, name)| LegendEntry {
            sample: LegendSample::Pattern(line_pattern(k)),
            name: name.clone(),
        }));
        let mut layers = vec![Layer::Line { points: self.rows.clone(), pattern: line_pattern(0) }];
        for (k, values) in self.further.iter().enumerate() {
            let points = self.rows.iter().zip(values).map(|((frequency, _), value)| (*frequency, *value));
            layers.push(Layer::Line { points: points.collect(), pattern: line_pattern(k + 1) });
        }
        layers.push(Layer::Dots { points: self.measured.clone(), dot });
        let y = Measure::new(self.quantity.clone());
        let y = if largest > 0.0 { y.between((0.0, 1.06 * largest)) } else { y };
        let panels = vec![ChartPanel { quantity: "amplitude", y, layers, heading: String::new() }];
        let measured = match self.measured.len() {
            0 => String::new(),
            count => format!(", {count} measured"),
        };
        let rows = self.rows.len();
        let description = format!("amplitude of the excitation over its frequency, {rows} rows{measured}");
        let frequencies = || self.rows.iter().chain(&self.measured).map(|(frequency, _)| *frequency);
        let x = Measure::frequency("Excitation frequency", style, frequencies());
        let ends = extent(frequencies().filter(|frequency| frequency.is_finite()));
        let x = ends.filter(|(from, to)| from < to).map_or_else(|| x.clone(), |ends| x.clone().between(ends));
        Chart { title: self.title.clone(), x, panels, legend: vec![legend], description, aspect: Some(0.6) }
            .draw(style)
    }
}
