//! Floquet multipliers of a branch: their moduli over the frequency, and in the complex plane with the unit
//! circle.

use std::f64::consts::TAU;

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    stretch::LineLook,
    style::{INK, Pattern, Style, line_pattern, stability_colour},
};

/// Largest number of moduli that are drawn, and the least modulus.
const MOST: usize = 6;
const LEAST: f64 = 1e-4;
/// Largest number of multipliers of a solution in the complex plane.
const MOST_IN_PLANE: usize = 4;
/// Half the width of the frame around the unit circle.
const FRAME: f64 = 1.5;

/// Multipliers along a branch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplierDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Solutions in order along the branch.
    pub solutions: Vec<Multipliers>,
}

/// The multipliers of a solution.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Multipliers {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Whether no multiplier is known to lie outside the unit circle.
    pub stable: bool,
    /// Whether stability is undecided: a multiplier is on the unit circle to its accuracy.
    pub marginal: bool,
    /// Real and imaginary parts, in any order; one that is not finite is left out.
    pub multipliers: Vec<[f64; 2]>,
}

impl Multipliers {
    /// Finite moduli, the largest first.
    fn moduli(&self) -> Vec<f64> {
        let mut moduli: Vec<f64> = self.multipliers.iter().map(|[re, im]| re.hypot(*im)).collect();
        moduli.retain(|modulus| modulus.is_finite());
        moduli.sort_by(|a, b| b.total_cmp(a));
        moduli
    }
}

impl MultiplierDiagram {
    /// Moduli over the frequency, on a logarithmic axis; of many the six largest, from 1e-4 on.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no modulus is finite and large enough.
    pub fn draw_moduli(&self, style: &Style) -> Result<Figure, FigureError> {
        let moduli: Vec<(f64, Vec<f64>)> =
            self.solutions.iter().map(|solution| (solution.frequency_hz, solution.moduli())).collect();
        let drawn = moduli.iter().map(|(_, moduli)| moduli.len()).max().unwrap_or(0).min(MOST);
        let value = |moduli: &Vec<f64>, k: usize| {
            moduli.get(k).copied().filter(|modulus| *modulus >= LEAST).unwrap_or(f64::NAN)
        };
        let line = |k: usize| Layer::Line {
            points: moduli.iter().map(|(frequency_hz, moduli)| (*frequency_hz, value(moduli, k))).collect(),
            pattern: line_pattern(k),
        };
        let mut layers = vec![Layer::Levels { at: vec![1.0] }];
        layers.extend((0..drawn).rev().map(line));
        let name = |k: usize| if k == 0 { "1 (largest)".to_owned() } else { (k + 1).to_string() };
        let entry = |k: usize| LegendEntry { sample: LegendSample::Pattern(line_pattern(k)), name: name(k) };
        let y = Measure::logarithmic("Modulus of multiplier (–)");
        let panels = vec![ChartPanel { quantity: "multiplier", y, layers, heading: String::new() }];
        let description = format!(
            "moduli of Floquet multipliers over the excitation frequency, {} solutions; not finite: {}",
            self.solutions.len(),
            self.not_finite()
        );
        let frequencies = self.solutions.iter().map(|solution| solution.frequency_hz);
        Chart {
            title: self.title.clone(),
            x: Measure::frequency("Excitation frequency", style, frequencies),
            panels,
            legend: vec![(0..drawn).map(entry).collect()],
            description,
            aspect: None,
        }
        .draw(style)
    }

    /// Multipliers in the complex plane about the unit circle; of many the four of largest modulus of each
    /// solution, with the partner of the last.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no multiplier is finite.
    pub fn draw_circle(&self, style: &Style) -> Result<Figure, FigureError> {
        let finite: Vec<(LineLook, (f64, f64))> = self.finite().collect();
        if finite.is_empty() {
            let points = self.solutions.len();
            return Err(FigureError::Empty { quantity: "multiplier", curves: 1, points });
        }
        let is_in = |(re, im): &(f64, f64)| re.abs() <= FRAME && im.abs() <= FRAME;
        let outside = finite.iter().filter(|(_, at)| !is_in(at)).count();
        let circle = (0..=360).map(|k| f64::from(k) / 360.0 * TAU).map(|angle| (angle.cos(), angle.sin()));
        let pattern = Pattern { colour: INK, dashes: None };
        let mut layers = vec![Layer::Levels { at: vec![0.0] }, Layer::Uprights { at: vec![0.0] }];
        let mut legend = Vec::new();
        for line in LineLook::ALL.into_iter().rev() {
            let points: Vec<(f64, f64)> =
                finite.iter().filter(|(of, _)| *of == line).map(|(_, at)| *at).collect();
            let (shape, full, radius) = match line {
                LineLook::Stable => (Shape::Circle, true, 0.6),
                LineLook::Marginal => (Shape::Circle, false, 0.8),
                LineLook::Unstable => (Shape::Square, false, 0.7),
            };
            let dot = Dot { shape, colour: stability_colour(line), full, radius };
            if !points.is_empty() {
                legend.insert(
                    0,
                    LegendEntry {
                        sample: LegendSample::Dot(dot),
                        name: format!("of {} solutions", line.name()),
                    },
                );
            }
            layers.push(Layer::Dots { points, dot });
        }
        layers.push(Layer::Line { points: circle.collect(), pattern });
        let ends = (-FRAME, FRAME);
        let y = Measure::new("Imaginary part (–)").between(ends);
        let heading = if outside == 0 {
            String::new()
        } else {
            format!("{outside} of {} multipliers lie outside the frame", finite.len())
        };
        let panels = vec![ChartPanel { quantity: "multiplier", y, layers, heading: heading.clone() }];
        let missing = self.not_finite();
        let description = format!(
            "Floquet multipliers in the complex plane, {} solutions; {heading}; not finite: {missing}",
            self.solutions.len()
        );
        let x = Measure::new("Real part (–)").between(ends);
        Chart { title: self.title.clone(), x, panels, legend: vec![legend], description, aspect: Some(1.0) }
            .draw(style)
    }

    /// The largest finite multipliers of each solution, with its stability.
    fn finite(&self) -> impl Iterator<Item = (LineLook, (f64, f64))> {
        self.solutions.iter().flat_map(|solution| {
            let mut finite = solution.multipliers.clone();
            finite.retain(|[re, im]| re.is_finite() && im.is_finite());
            finite.sort_by(|a, b| b[0].hypot(b[1]).total_cmp(&a[0].hypot(a[1])));
            // Both or none of a pair, which have one modulus except for rounding.
            let least = finite.get(MOST_IN_PLANE - 1).map_or(0.0, |[re, im]| (1.0 - 1e-9) * re.hypot(*im));
            finite.retain(|[re, im]| re.hypot(*im) >= least);
            let line = LineLook::of(solution.stable, solution.marginal);
            finite.into_iter().map(move |[re, im]| (line, (re, im)))
        })
    }

    fn not_finite(&self) -> usize {
        let all = self.solutions.iter().flat_map(|solution| &solution.multipliers);
        all.filter(|[re, im]| !(re.is_finite() && im.is_finite())).count()
    }
}
