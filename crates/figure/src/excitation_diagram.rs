//! The amplitude of the excitation over the frequency, as it is computed with and as it was measured.

use crate::{
    Figure, FigureError, Style,
    chart::{Chart, Measure, Panel},
    dots::{Dot, Shape},
    layer::Layer,
    legend::{Entry, Sample},
    scale::extent,
    style::{INK, line_pattern},
};

/// Amplitudes of an excitation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExcitationDiagram {
    /// Title above the figure; empty for none.
    pub title: String,
    /// What the amplitude is of, with the unit: the label of the vertical axis.
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
    /// The figure; its vertical axis begins at zero.
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
            let (line, dots) = (Sample::Pattern(line_pattern(0)), Sample::Dot(dot));
            legend.push(Entry { sample: line, name: "computed with".to_owned() });
            legend.push(Entry { sample: dots, name: "measured".to_owned() });
        }
        let named = self.names.iter().enumerate();
        legend.extend(
            named.map(|(k, name)| Entry { sample: Sample::Pattern(line_pattern(k)), name: name.clone() }),
        );
        let mut layers = vec![Layer::Line { points: self.rows.clone(), pattern: line_pattern(0) }];
        for (k, values) in self.further.iter().enumerate() {
            let points = self.rows.iter().zip(values).map(|((frequency, _), value)| (*frequency, *value));
            layers.push(Layer::Line { points: points.collect(), pattern: line_pattern(k + 1) });
        }
        layers.push(Layer::Dots { points: self.measured.clone(), dot });
        let y = Measure::new(self.quantity.clone());
        let y = if largest > 0.0 { y.between((0.0, 1.06 * largest)) } else { y };
        let panels = vec![Panel { quantity: "amplitude", y, layers, heading: String::new() }];
        let measured = match self.measured.len() {
            0 => String::new(),
            count => format!(", {count} measured"),
        };
        let rows = self.rows.len();
        let description = format!("amplitude of the excitation over its frequency, {rows} rows{measured}");
        let x = Measure::frequency("Excitation frequency", style);
        let frequencies = self.rows.iter().chain(&self.measured).map(|(frequency, _)| *frequency);
        let ends = extent(frequencies.filter(|frequency| frequency.is_finite()));
        let x = ends.filter(|(from, to)| from < to).map_or_else(|| x.clone(), |ends| x.clone().between(ends));
        Chart { title: self.title.clone(), x, panels, legend: vec![legend], description, aspect: Some(0.6) }
            .draw(style)
    }
}
