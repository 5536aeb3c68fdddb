//! Digital filters of second-order sections.
//!
//! A section is written in `d = z - 1`, not in `z`:
//!
//! `H = g (c0 d² + c1 d + c2)/(d² + a1 d + a2)`, for poles `z = 1 - p`: `a1 = p + p*`, `a2 = p p*`
//!
//! A filter far below the sampling rate has its poles near `z = 1`. In `z` their distance from one is a
//! difference of coefficients that are nearly 2 and 1, and their rounding is amplified by the square of the
//! sampling rate over the cut-off; in `d` it is a coefficient. The two state variables are
//!
//! `w0 <- w0 + w1`, `w1 <- w1 - (a1 w1 + a2 w0) + x`, `y = g (c0 (x - a1 w1 - a2 w0) + c1 w1 + c2 w0)`
//!
//! and in the steady state of a constant input `w0 = x/a2`, `w1 = 0`. A section of first order is `H = g (c1
//! d + c2)/(d + a2)`, with `w0 <- w0 - a2 w0 + x`.
//!
//! # Source
//! Middleton and Goodwin, IEEE Trans. Autom. Control 31 (1986), 1015-1021, on the operator `d`.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

/// One section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondOrderSection {
    /// Numerator in powers of `z - 1`, the highest first, gain included; the first one is unused in a section
    /// of first order.
    pub numerator: [f64; 3],
    /// Denominator without its leading 1: `a1, a2`; `0, a2` in a section of first order.
    pub denominator: [f64; 2],
    /// Whether it is of first order.
    pub is_first_order: bool,
}

impl SecondOrderSection {
    pub(super) fn response(&self, z: Complex<f64>) -> Complex<f64> {
        let d = z - 1.0;
        let [c0, c1, c2] = self.numerator;
        let [a1, a2] = self.denominator;
        if self.is_first_order {
            (d * c1 + c2) / (d + a2)
        } else {
            (d * (d * c0 + c1) + c2) / (d * (d + a1) + a2)
        }
    }

    fn steady_gain(&self) -> f64 {
        self.numerator[2] / self.denominator[1]
    }

    /// State variables in the steady state of a constant input.
    fn steady(&self, input: f64) -> [f64; 2] {
        [input / self.denominator[1], 0.0]
    }
}

/// A digital filter: second-order sections that act in sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct DigitalFilter {
    sections: Vec<SecondOrderSection>,
}

/// State variables of the sections.
pub(super) type SectionStates = Vec<[f64; 2]>;

impl DigitalFilter {
    pub(super) const fn new(sections: Vec<SecondOrderSection>) -> Self {
        Self { sections }
    }

    /// The sections, in the order in which they act.
    #[must_use]
    pub fn sections(&self) -> &[SecondOrderSection] {
        &self.sections
    }

    /// Gain for a harmonic signal.
    ///
    /// * `frequency_hz`, `sampling_rate_hz`: frequency of the signal and sampling rate of the series [Hz].
    #[must_use]
    pub fn gain(&self, frequency_hz: f64, sampling_rate_hz: f64) -> f64 {
        let z = Complex::from_polar(1.0, 2.0 * PI * frequency_hz / sampling_rate_hz);
        self.sections.iter().map(|section| section.response(z).norm()).product()
    }

    /// Filters from the steady state of the first value, as an instrument does.
    #[must_use]
    pub fn causal(&self, series: &[f64]) -> Vec<f64> {
        let mut filtered = series.to_vec();
        self.run(&mut filtered, self.steady(series.first().copied().unwrap_or(0.0)));
        filtered
    }

    /// Filters from rest: the series is zero before its first sample.
    #[must_use]
    pub fn causal_from_rest(&self, series: &[f64]) -> Vec<f64> {
        let mut filtered = series.to_vec();
        self.run(&mut filtered, vec![[0.0; 2]; self.sections.len()]);
        filtered
    }

    /// State variables in the steady state of a constant input.
    pub(super) fn steady(&self, input: f64) -> SectionStates {
        let mut level = input;
        let one = |section: &SecondOrderSection| {
            let state = section.steady(level);
            level *= section.steady_gain();
            state
        };
        self.sections.iter().map(one).collect()
    }

    /// Filters in place.
    pub(super) fn run(&self, series: &mut [f64], mut states: SectionStates) {
        // Two sections at a time, so that the processor can interleave their operations.
        let mut chain = self.sections.iter().zip(&mut states);
        loop {
            match (chain.next(), chain.next()) {
                (Some(one), Some(other)) => run_two(series, one, other),
                (Some((section, state)), None) => {
                    series.iter_mut().for_each(|value| *value = section.step(state, *value));
                    return;
                }
                _ => return,
            }
        }
    }
}

fn run_two(
    series: &mut [f64],
    one: (&SecondOrderSection, &mut [f64; 2]),
    other: (&SecondOrderSection, &mut [f64; 2]),
) {
    let (first, second) = (*one.0, *other.0);
    let (mut a, mut b) = (*one.1, *other.1);
    for value in series {
        let between = first.step(&mut a, *value);
        *value = second.step(&mut b, between);
    }
}

impl SecondOrderSection {
    #[inline]
    fn step(&self, state: &mut [f64; 2], input: f64) -> f64 {
        let [c0, c1, c2] = self.numerator;
        let [a1, a2] = self.denominator;
        let [w0, w1] = *state;
        if self.is_first_order {
            let change = input - a2 * w0;
            state[0] = w0 + change;
            return c1 * change + c2 * w0;
        }
        let change = input - a1 * w1 - a2 * w0;
        *state = [w0 + w1, w1 + change];
        c0 * change + c1 * w1 + c2 * w0
    }
}
