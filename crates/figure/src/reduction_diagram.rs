//! The error of a reduction: relative errors of the eigenfrequencies over the frequency.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    stretch::LineLook,
    style::{INK, Style, stability_colour},
};

/// The least error that is drawn; smaller ones are rounding.
const LEAST: f64 = 1e-12;

/// Errors of eigenfrequencies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReductionDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// The modes, in any order.
    pub modes: Vec<ReducedMode>,
}

/// A mode before and after the reduction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReducedMode {
    /// Unreduced eigenfrequency (Hz).
    pub full_hz: f64,
    /// Reduced over unreduced eigenfrequency, less one (–).
    pub relative_error: f64,
    /// Whether the unreduced eigenfrequency is not above the cut-off.
    pub below_cut_off: bool,
}

impl ReductionDiagram {
    /// The figure, in a style; errors below 1e-12 are drawn there as triangles that point down.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no mode has a positive frequency and a finite error.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let place = |mode: &ReducedMode| {
            let error = mode.relative_error.abs();
            (mode.full_hz, if error.is_finite() { error.max(LEAST) } else { f64::NAN })
        };
        let is_rounding = |mode: &ReducedMode| mode.relative_error.abs() < LEAST;
        let mut layers = Vec::new();
        let mut legend = Vec::new();
        for (below, name) in [(true, "up to the cut-off"), (false, "above the cut-off")] {
            let (shape, colour) = (
                if below { Shape::Circle } else { Shape::Square },
                stability_colour(LineLook::of(below, false)),
            );
            let dot = Dot { shape, colour, full: below, radius: 1.3 * style.mark_radius };
            let modes = self.modes.iter().filter(|mode| mode.below_cut_off == below && mode.full_hz > 0.0);
            let points: Vec<(f64, f64)> = modes.filter(|mode| !is_rounding(mode)).map(place).collect();
            if !points.is_empty() {
                legend.push(LegendEntry { sample: LegendSample::Dot(dot), name: name.to_owned() });
            }
            layers.push(Layer::Dots { points, dot });
        }
        let dot =
            Dot { shape: Shape::TriangleDown, colour: INK, full: false, radius: 1.3 * style.mark_radius };
        let lesser = self.modes.iter().filter(|mode| is_rounding(mode) && mode.full_hz > 0.0);
        let points: Vec<(f64, f64)> = lesser.map(place).collect();
        if !points.is_empty() {
            legend
                .push(LegendEntry { sample: LegendSample::Dot(dot), name: "less than 10⁻¹²".to_owned() });
        }
        layers.push(Layer::Dots { points, dot });
        let y = Measure::logarithmic("Error of eigenfrequency (–)");
        let panels = vec![ChartPanel { quantity: "error", y, layers, heading: String::new() }];
        let description =
            format!("relative errors of {} eigenfrequencies by the reduction", self.modes.len());
        let frequencies = self.modes.iter().map(|mode| mode.full_hz);
        let x = Measure::frequency("Unreduced eigenfrequency", style, frequencies).over_decades();
        Chart { title: self.title.clone(), x, panels, legend: vec![legend], description, aspect: None }
            .draw(style)
    }
}
