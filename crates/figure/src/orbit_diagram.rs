//! An orbit: its motion, forces and impulses over a period, its phase portrait, and its spectrum. The samples
//! come from the caller.

mod data;
mod impulse;
mod spectrum;

use crate::{
    chart::{ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    style::{INK, PALE_INK, Pattern, Style, line_pattern},
};

pub use data::{FilteredAcceleration, OrbitDiagram, OrbitImpulse, OrbitSample};

impl OrbitDiagram {
    /// Displacement, acceleration, forces of the local elements, impulses of rigid stops and support motion
    /// over the period.
    ///
    /// Where a velocity jumps the displacement has a corner and the acceleration a gap: it is an impulse
    /// there.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there are no finite samples.
    pub fn draw_history(&self, style: &Style) -> Result<Figure, FigureError> {
        let plain = |quantity, label: &str, points, pattern| ChartPanel {
            quantity,
            y: Measure::new(label),
            layers: vec![Layer::Line { points, pattern: line_pattern(pattern) }],
            heading: String::new(),
        };
        let entry = |k: usize, name| LegendEntry { sample: LegendSample::Pattern(line_pattern(k)), name };
        let mut panels = vec![
            plain("displacement", "Displ. (mm)", self.displacement(), 0),
            plain("acceleration", "Accel. (m/s²)", self.acceleration(), 0),
        ];
        if let Some(filtered) = &self.filtered {
            let heading = format!(
                "acceleration behind a low-pass filter of {}",
                style.frequency_unit.words(filtered.cut_off_hz)
            );
            let points = self.closed(&filtered.values_m_s2);
            panels
                .push(ChartPanel { heading, ..plain("filtered acceleration", "Accel. (m/s²)", points, 0) });
        }
        let elements = self.samples.first().map_or(0, |sample| sample.forces_n.len());
        let force = |k: usize| {
            let value = |sample: &OrbitSample| sample.forces_n.get(k).copied().unwrap_or(f64::NAN);
            Layer::Line { points: self.over_time(value), pattern: line_pattern(k) }
        };
        if self.has_forces() {
            let (y, layers) = (Measure::new("Local force (N)"), (0..elements).map(force).collect());
            panels.push(ChartPanel { quantity: "force", y, layers, heading: String::new() });
        }
        let several = elements > 1 && self.has_forces();
        let mut legend: Vec<LegendEntry> =
            (0..elements).filter(|_| several).map(|k| entry(k, self.element_name(k))).collect();
        panels.extend(self.impulse_panel());
        legend.extend(self.impulse_entries());
        let supports = self.samples.first().map_or(0, |sample| sample.supports_m.len());
        if supports > 0 {
            let motion = |k: usize| {
                let value = |sample: &OrbitSample| sample.supports_m.get(k).map_or(f64::NAN, |at| 1e3 * at);
                Layer::Line { points: self.over_time(value), pattern: line_pattern(1 + k) }
            };
            let layers: Vec<Layer> = (0..supports).map(motion).collect();
            // Over the displacement it shows how the contact is reached.
            panels[0].layers.extend(layers.iter().cloned());
            let (y, heading) = (Measure::new("Support (mm)"), String::new());
            panels.push(ChartPanel { quantity: "support motion", y, layers, heading });
            let name = |k: usize| self.support_names.get(k).cloned().unwrap_or_else(|| "support".to_owned());
            let named = (0..supports).map(|k| entry(1 + k, name(k)));
            legend.splice(0..0, [entry(0, "response point".to_owned())].into_iter().chain(named));
        }
        let legend = vec![legend];
        let x = Measure::new("Time over excitation period (–)").between((0.0, self.periods()));
        self.chart(("one period of the orbit", style.frequency_unit), x, panels, legend, Some(0.16))
            .draw(style)
    }

    /// Velocity over displacement, with the points at phase 0; below it these points alone, the Poincaré
    /// section. A velocity that jumps is a gap with dots across it.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there are no finite samples.
    pub fn draw_phase(&self, style: &Style) -> Result<Figure, FigureError> {
        let at = |sample: &OrbitSample| (1e3 * sample.displacement_m, sample.velocity_m_s);
        let points = self.portrait();
        let (count, multiple) = (self.samples.len(), self.period_multiple.max(1) as usize);
        let strobed: Vec<(f64, f64)> =
            (0..multiple).filter_map(|k| self.samples.get(k * count / multiple)).map(at).collect();
        let dot = Dot { shape: Shape::Circle, colour: INK, full: true, radius: 1.6 };
        let dots = Layer::Dots { points: strobed, dot };
        let mut legend = vec![LegendEntry {
            sample: LegendSample::Dot(dot),
            name: "phase 0 of the excitation".to_owned(),
        }];
        let mut layers = vec![Layer::Line { points, pattern: line_pattern(0) }];
        if !self.impulses.is_empty() {
            let pattern = Pattern { colour: PALE_INK, dashes: Some((0.8, 1.2)) };
            layers.push(Layer::Line { points: self.jumps(), pattern });
            legend.push(LegendEntry {
                sample: LegendSample::Pattern(pattern),
                name: "jump at an impact".to_owned(),
            });
        }
        layers.push(dots.clone());
        let panel = |quantity, heading: &str, layers| ChartPanel {
            quantity,
            y: Measure::new("Velocity (m/s)"),
            layers,
            heading: heading.to_owned(),
        };
        let panels = vec![
            panel("velocity", "phase portrait", layers),
            panel("point of the section", "Poincaré section", vec![dots]),
        ];
        let x = Measure::new("Displacement (mm)");
        self.chart(
            ("phase portrait and Poincaré section", style.frequency_unit),
            x,
            panels,
            vec![legend],
            Some(0.62),
        )
        .draw(style)
    }
}
