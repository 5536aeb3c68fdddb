//! The spectrum of the acceleration of an orbit.

use std::f64::consts::TAU;

use super::data::OrbitDiagram;
use crate::{
    chart::{ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    style::{PALE_INK, Pattern, Style, line_pattern},
};

/// Ratio of the largest amplitude of a spectrum to the least that is drawn.
const DEPTH: f64 = 1e5;

impl OrbitDiagram {
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
        let mut legend = vec![LegendEntry { sample: LegendSample::Dot(dot), name: "harmonic".to_owned() }];
        if !self.eigenfrequencies_hz.is_empty() {
            legend.push(LegendEntry {
                sample: LegendSample::Pattern(pattern),
                name: "eigenfrequency".to_owned(),
            });
        }
        let y = Measure::logarithmic("Amplitude of acceleration (m/s²)");
        let y = if floor > 0.0 { y.between((floor, 3.0 * largest)) } else { y };
        let panels = vec![ChartPanel { quantity: "harmonic", y, layers, heading: String::new() }];
        let x =
            Measure::frequency("Frequency", style, [1.2 * highest].into_iter()).between((0.0, 1.2 * highest));
        self.chart(("spectrum of the acceleration", style.frequency_unit), x, panels, vec![legend], None)
            .draw(style)
    }

    /// Amplitude of a harmonic by direct summation; the phase is reduced first, so that it stays exact.
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit_diagram::data::OrbitImpulse;

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
