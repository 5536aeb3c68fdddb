//! The stroboscopic (Poincaré) section: displacement and velocity of the response point at one phase of every
//! period.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    style::{PERIOD_COLOUR, Style},
};

/// Points up to which they are drawn larger.
const FEW: usize = 100;

/// A section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SectionDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Displacement (m) and velocity (m/s) at phase 0 of every period.
    pub points: Vec<(f64, f64)>,
}

impl SectionDiagram {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no point is finite.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let (shape, radius) =
            if self.points.len() <= FEW { (Shape::Circle, style.mark_radius) } else { (Shape::Speck, 0.3) };
        let dot = Dot { shape, colour: PERIOD_COLOUR, full: true, radius };
        let points =
            self.points.iter().map(|&(displacement, velocity)| (1e3 * displacement, velocity)).collect();
        let layers = vec![Layer::Dots { points, dot }];
        let y = Measure::new("Velocity (m/s)");
        let panels = vec![ChartPanel { quantity: "point of the section", y, layers, heading: String::new() }];
        let count = self.points.len();
        let description = format!(
            "Poincaré section at phase 0 at {}, {count} points",
            style.frequency_unit.words(self.frequency_hz)
        );
        let x = Measure::new("Displacement (mm)");
        let title = self.title.clone();
        Chart { title, x, panels, legend: Vec::new(), description, aspect: Some(0.8) }.draw(style)
    }
}
