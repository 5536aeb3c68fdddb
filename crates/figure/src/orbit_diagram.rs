//! An orbit: its motion, forces and impulses over a period, its phase portrait, and its spectrum. The samples
//! come from the caller.

mod impulse;

use std::f64::consts::TAU;

use crate::{
    Figure, FigureError, FrequencyUnit, Style,
    chart::{Chart, Measure, Panel},
    dots::{Dot, Shape},
    layer::Layer,
    legend::{Entry, Sample},
    style::{INK, PALE_INK, Pattern, line_pattern},
};

pub use impulse::OrbitImpulse;

/// Ratio of the largest amplitude of a spectrum to the least that is drawn.
const DEPTH: f64 = 1e5;

/// An orbit in samples at equal steps over its period, both ends of which are the same instant and are given
/// once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitDiagram {
    /// Title above the figures; empty for none.
    pub title: String,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Orbit period over excitation period, from 1.
    pub period_multiple: u32,
    /// The samples.
    pub samples: Vec<OrbitSample>,
    /// Impacts on rigid stops, in their order in time.
    pub impulses: Vec<OrbitImpulse>,
    /// The acceleration behind a low-pass filter, as an instrument shows it.
    pub filtered: Option<FilteredAcceleration>,
    /// Names of the local elements; those without one are numbered.
    pub element_names: Vec<String>,
    /// Eigenfrequencies of the structure without its local elements (Hz), marked in the spectrum.
    pub eigenfrequencies_hz: Vec<f64>,
    /// Names of the supports that move, where there are several.
    pub support_names: Vec<String>,
}

/// An acceleration behind a low-pass filter that has settled.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FilteredAcceleration {
    /// Cut-off frequency (Hz).
    pub cut_off_hz: f64,
    /// One value for each sample of the orbit (m/s²).
    pub values_m_s2: Vec<f64>,
}

/// A sample of an orbit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitSample {
    /// Displacement of the response point (m).
    pub displacement_m: f64,
    /// Its velocity (m/s).
    pub velocity_m_s: f64,
    /// Its acceleration (m/s²).
    pub acceleration_m_s2: f64,
    /// Forces of the local elements (N), with the same number of them in each sample.
    pub forces_n: Vec<f64>,
    /// Displacements of the supports that move (m), with the same number of them in each sample.
    pub supports_m: Vec<f64>,
}

impl OrbitDiagram {
    fn element_name(&self, element: usize) -> String {
        let name = self.element_names.get(element).filter(|name| !name.is_empty());
        name.cloned().unwrap_or_else(|| format!("local element {}", element + 1))
    }

    /// Displacement, acceleration, forces of the local elements, impulses of rigid stops and support motion
    /// over the period.
    ///
    /// Where a velocity jumps the displacement has a corner and the acceleration a gap: it is an impulse
    /// there.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there are no finite samples.
    pub fn draw_history(&self, style: &Style) -> Result<Figure, FigureError> {
        let plain = |quantity, label: &str, points, pattern| Panel {
            quantity,
            y: Measure::new(label),
            layers: vec![Layer::Line { points, pattern: line_pattern(pattern) }],
            heading: String::new(),
        };
        let entry = |k: usize, name| Entry { sample: Sample::Pattern(line_pattern(k)), name };
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
            panels.push(Panel { heading, ..plain("filtered acceleration", "Accel. (m/s²)", points, 0) });
        }
        let elements = self.samples.first().map_or(0, |sample| sample.forces_n.len());
        let force = |k: usize| {
            let value = |sample: &OrbitSample| sample.forces_n.get(k).copied().unwrap_or(f64::NAN);
            Layer::Line { points: self.over_time(value), pattern: line_pattern(k) }
        };
        if self.has_forces() {
            let (y, layers) = (Measure::new("Local force (N)"), (0..elements).map(force).collect());
            panels.push(Panel { quantity: "force", y, layers, heading: String::new() });
        }
        let several = elements > 1 && self.has_forces();
        let mut legend: Vec<Entry> =
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
            panels.push(Panel { quantity: "support motion", y, layers, heading });
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
        let mut legend =
            vec![Entry { sample: Sample::Dot(dot), name: "phase 0 of the excitation".to_owned() }];
        let mut layers = vec![Layer::Line { points, pattern: line_pattern(0) }];
        if !self.impulses.is_empty() {
            let pattern = Pattern { colour: PALE_INK, dashes: Some((0.8, 1.2)) };
            layers.push(Layer::Line { points: self.jumps(), pattern });
            legend.push(Entry { sample: Sample::Pattern(pattern), name: "jump at an impact".to_owned() });
        }
        layers.push(dots.clone());
        let panel = |quantity, heading: &str, layers| Panel {
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

    /// Amplitudes of the harmonics of the acceleration, with the eigenfrequencies marked.
    ///
    /// The samples `x_j` of an orbit have the harmonics `c_k = 2/n |sum_j x_j exp(-2 pi i j k/n) + n/T sum_i
    /// dv_i exp(-2 pi i k t_i/T)|`, with the jumps `dv_i` of the velocity at the times `t_i` of impacts, in
    /// the period T; those up to a quarter of the samples are drawn.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there are no finite samples.
    pub fn draw_spectrum(&self, style: &Style) -> Result<Figure, FigureError> {
        let values: Vec<f64> = self.samples.iter().map(|sample| sample.acceleration_m_s2).collect();
        let highest = self.eigenfrequencies_hz.iter().copied().fold(10.0 * self.frequency_hz, f64::max);
        let step = self.frequency_hz / self.periods();
        let wanted = (1.2 * highest / step).ceil().max(1.0) as usize;
        let lines: Vec<(f64, f64)> = (1..=wanted.min(values.len() / 4))
            .map(|k| (k as f64 * step, self.amplitude(&values, k)))
            .collect();
        let largest = lines.iter().map(|line| line.1).filter(|size| size.is_finite()).fold(0.0, f64::max);
        let shown: Vec<(f64, f64)> = lines.into_iter().filter(|line| line.1 > largest / DEPTH).collect();
        let floor = shown.iter().map(|line| line.1).fold(largest, f64::min) / 3.0;
        let intervals = shown.iter().map(|&(x, y)| (x, floor, y)).collect();
        let dot = Dot { shape: Shape::Circle, colour: line_pattern(0).colour, full: true, radius: 0.9 };
        let layers = vec![
            Layer::Uprights { at: self.eigenfrequencies_hz.clone() },
            Layer::Whiskers { intervals, colour: line_pattern(0).colour },
            Layer::Dots { points: shown, dot },
        ];
        let pattern = Pattern { colour: PALE_INK, dashes: Some((1.5, 1.5)) };
        let mut legend = vec![Entry { sample: Sample::Dot(dot), name: "harmonic".to_owned() }];
        if !self.eigenfrequencies_hz.is_empty() {
            legend.push(Entry { sample: Sample::Pattern(pattern), name: "eigenfrequency".to_owned() });
        }
        let y = Measure::logarithmic("Amplitude of acceleration (m/s²)");
        let y = if floor > 0.0 { y.between((floor, 3.0 * largest)) } else { y };
        let panels = vec![Panel { quantity: "harmonic", y, layers, heading: String::new() }];
        let x = Measure::frequency("Frequency", style).between((0.0, 1.2 * highest));
        self.chart(("spectrum of the acceleration", style.frequency_unit), x, panels, vec![legend], None)
            .draw(style)
    }

    /// Amplitude of a harmonic, by Goertzel's sum written out; the phase is reduced first, so that it stays
    /// exact.
    fn amplitude(&self, values: &[f64], k: usize) -> f64 {
        let n = values.len();
        let angle = |j: usize| TAU * ((j * k) % n) as f64 / n as f64;
        let term = |(value, angle): (f64, f64)| (value * angle.cos(), value * angle.sin());
        let sampled = values.iter().enumerate().map(|(j, value)| (*value, angle(j)));
        let per_sample = n as f64 * self.frequency_hz / self.periods();
        let struck = self.impulses.iter().map(|impulse| {
            let share = impulse.cycles / self.periods();
            (per_sample * impulse.velocity_jump(), TAU * (share * k as f64).fract())
        });
        let terms = sampled.chain(struck).map(term);
        let (re, im) = terms.fold((0.0, 0.0), |(re, im), (c, s)| (re + c, im + s));
        2.0 / n as f64 * re.hypot(im)
    }

    fn periods(&self) -> f64 {
        f64::from(self.period_multiple.max(1))
    }

    /// Values over the time, closed at the end of the period.
    fn over_time(&self, value: impl Fn(&OrbitSample) -> f64) -> Vec<(f64, f64)> {
        self.closed(&self.samples.iter().map(value).collect::<Vec<f64>>())
    }

    fn closed(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let step = self.periods() / values.len().max(1) as f64;
        let closed = values.iter().chain(values.first()).enumerate();
        closed.map(|(k, value)| (k as f64 * step, *value)).collect()
    }

    fn chart(
        &self,
        (what, unit): (&str, FrequencyUnit),
        x: Measure,
        panels: Vec<Panel>,
        legend: Vec<Vec<Entry>>,
        aspect: Option<f64>,
    ) -> Chart {
        let (frequency, multiple) = (unit.words(self.frequency_hz), self.period_multiple);
        let mut description =
            format!("{what}, at {frequency}, period {multiple}, {} samples", self.samples.len());
        if !self.impulses.is_empty() {
            description.push_str(&format!("; {}", self.impulses_in_words()));
        }
        Chart { title: self.title.clone(), x, panels, legend, description, aspect }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_of_a_sum_of_cosines_are_its_amplitudes() {
        let value = |j: i32| {
            let t = TAU * f64::from(j) / 64.0;
            3.0 * (2.0 * t + 0.4).cos() + 0.5 * (5.0 * t).sin() + 7.0
        };
        let values: Vec<f64> = (0..64).map(value).collect();
        // Rounding of 64 terms of size 10.
        let orbit = OrbitDiagram::default();
        let is = |k: usize, wanted: f64| {
            assert!((orbit.amplitude(&values, k) - wanted).abs() < 1e-13, "{k}");
        };
        is(1, 0.0);
        is(2, 3.0);
        is(5, 0.5);
    }
    /// Between two walls at constant speed V, thrown back from both: the acceleration is `2 V` times impulses
    /// of alternating sign, whose odd harmonics are `8 V/T` and whose even ones vanish. At 3 Hz, over two
    /// excitation periods.
    #[test]
    fn impulses_have_the_harmonics_of_a_motion_between_two_walls() {
        let impulse = |cycles: f64, speed: f64| OrbitImpulse {
            cycles,
            velocity_m_s: [speed, -speed],
            ..OrbitImpulse::default()
        };
        let orbit = OrbitDiagram {
            frequency_hz: 3.0,
            period_multiple: 2,
            impulses: vec![impulse(0.3, 5.0), impulse(1.3, -5.0)],
            ..OrbitDiagram::default()
        };
        for k in 1..9 {
            let wanted = if k % 2 == 1 { 8.0 * 5.0 * 1.5 } else { 0.0 };
            assert!((orbit.amplitude(&[0.0; 64], k) - wanted).abs() < 1e-12, "{k}");
        }
    }
}
