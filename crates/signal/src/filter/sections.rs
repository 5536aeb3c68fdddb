//! Chains of second-order sections.
//!
//! A section `H = (b0 + b1/z + b2/z²) / (1 + a1/z + a2/z²)` is run with two memories,
//! `y = b0 x + s1`, `s1 <- b1 x - a1 y + s2`, `s2 <- b2 x - a2 y` (transposed direct form II). For a constant input `x` its steady state is
//! `y = g x`, `s2 = (b2 - a2 g) x`, `s1 = (b1 - a1 g) x + s2`, with `g = H(1)`.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

/// One section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Numerator, `b0, b1, b2`.
    pub b: [f64; 3],
    /// Denominator without its leading 1: `a1, a2`.
    pub a: [f64; 2],
}

impl Section {
    pub(super) fn response(&self, z: Complex<f64>) -> Complex<f64> {
        let w = z.inv();
        let [b0, b1, b2] = self.b;
        let [a1, a2] = self.a;
        (b0 + w * (b1 + w * b2)) / (1.0 + w * (a1 + w * a2))
    }

    fn steady_gain(&self) -> f64 {
        self.b.iter().sum::<f64>() / (1.0 + self.a.iter().sum::<f64>())
    }
}

/// A chain of sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Sections {
    sections: Vec<Section>,
}

/// Memories of the sections.
pub(super) type Memory = Vec<[f64; 2]>;

impl Sections {
    pub(super) const fn new(sections: Vec<Section>) -> Self {
        Self { sections }
    }

    /// The sections, in the order in which they act.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Gain for a harmonic signal.
    ///
    /// * `frequency_hz`, `sampling_rate_hz`: of signal and series [Hz].
    #[must_use]
    pub fn gain(&self, frequency_hz: f64, sampling_rate_hz: f64) -> f64 {
        let z = Complex::from_polar(1.0, 2.0 * PI * frequency_hz / sampling_rate_hz);
        self.sections.iter().map(|section| section.response(z).norm()).product()
    }

    /// Filters as an instrument does that has stood at the first value for ever.
    #[must_use]
    pub fn causal(&self, series: &[f64]) -> Vec<f64> {
        let mut filtered = series.to_vec();
        self.run(&mut filtered, self.steady(series.first().copied().unwrap_or(0.0)));
        filtered
    }

    /// Filters from rest: the series is taken as zero before its first sample.
    #[must_use]
    pub fn causal_from_rest(&self, series: &[f64]) -> Vec<f64> {
        let mut filtered = series.to_vec();
        self.run(&mut filtered, vec![[0.0; 2]; self.sections.len()]);
        filtered
    }

    /// Memories in the steady state of a constant input.
    pub(super) fn steady(&self, input: f64) -> Memory {
        let mut level = input;
        self.sections
            .iter()
            .map(|section| {
                let gain = section.steady_gain();
                let second = section.b[2] - section.a[1] * gain;
                let first = section.b[1] - section.a[0] * gain + second;
                let memory = [first * level, second * level];
                level *= gain;
                memory
            })
            .collect()
    }

    /// Filters in place.
    pub(super) fn run(&self, series: &mut [f64], mut memory: Memory) {
        // Two sections at a time, so that the second one works while the first one waits for its sums.
        let mut chain = self.sections.iter().zip(&mut memory);
        loop {
            match (chain.next(), chain.next()) {
                (Some(one), Some(other)) => run_two(series, one, other),
                (Some((section, memory)), None) => {
                    series.iter_mut().for_each(|value| *value = step(section, memory, *value));
                    return;
                }
                _ => return,
            }
        }
    }
}

fn run_two(series: &mut [f64], one: (&Section, &mut [f64; 2]), other: (&Section, &mut [f64; 2])) {
    let (first, second) = (*one.0, *other.0);
    let (mut a, mut b) = (*one.1, *other.1);
    for value in series {
        let between = step(&first, &mut a, *value);
        *value = step(&second, &mut b, between);
    }
}

#[inline]
fn step(section: &Section, memory: &mut [f64; 2], input: f64) -> f64 {
    let output = section.b[0] * input + memory[0];
    memory[0] = section.b[1] * input - section.a[0] * output + memory[1];
    memory[1] = section.b[2] * input - section.a[1] * output;
    output
}
