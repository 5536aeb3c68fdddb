//! Sums over the panels of an orbit.

use std::f64::consts::TAU;

use hammerbeam_motion::exact::PANEL_NODES;

use super::{extremum::extrema, numbers::SignalStatistics};

/// `exp(-i 2 pi (j/n) x_k)` at the nodes of a panel, `[j - 1][k]`.
pub(super) struct Kernel(Vec<[[f64; 2]; PANEL_NODES]>);

impl Kernel {
    /// * `cycles`: of the excitation at the nodes; `multiple`: excitation periods of the orbit.
    pub fn new(cycles: &[f64; PANEL_NODES], multiple: u32, count: usize) -> Self {
        let first = cycles.map(|cycles| turned(cycles, multiple, 1));
        let mut orders = Vec::with_capacity(count);
        let mut next = first;
        for _ in 0..count {
            orders.push(next);
            for (value, first) in next.iter_mut().zip(&first) {
                *value =
                    [value[0] * first[0] - value[1] * first[1], value[0] * first[1] + value[1] * first[0]];
            }
        }
        Self(orders)
    }
}

/// `exp(-i 2 pi (j/n) x)`.
fn turned(cycles: f64, multiple: u32, j: u32) -> [f64; 2] {
    let turns = cycles.rem_euclid(f64::from(multiple)) / f64::from(multiple);
    let (sin, cos) = (TAU * (f64::from(j) * turns).fract()).sin_cos();
    [cos, -sin]
}

/// What is summed up of a signal.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    maximum: f64,
    minimum: f64,
    integral: f64,
    square: f64,
    harmonics: Vec<[f64; 2]>,
}

impl Sums {
    /// * `count`: of harmonics.
    pub fn new(count: usize) -> Self {
        Self {
            maximum: f64::NEG_INFINITY,
            minimum: f64::INFINITY,
            integral: 0.0,
            square: 0.0,
            harmonics: vec![[0.0; 2]; count],
        }
    }

    /// Adds a panel with its values at the nodes.
    pub fn add(&mut self, weights: &[f64; PANEL_NODES], values: &[f64; PANEL_NODES], kernel: &Kernel) {
        [self.minimum, self.maximum] = extrema(values, [self.minimum, self.maximum]);
        for (weight, value) in weights.iter().zip(values) {
            self.integral += weight * value;
            self.square += weight * value * value;
        }
        for (sum, order) in self.harmonics.iter_mut().zip(&kernel.0) {
            for ((weight, value), [re, im]) in weights.iter().zip(values).zip(order) {
                sum[0] += weight * value * re;
                sum[1] += weight * value * im;
            }
        }
    }

    /// Adds an impulse at a phase [cycles].
    pub fn add_impulse(&mut self, impulse: f64, cycles: f64, multiple: u32) {
        self.integral += impulse;
        for (sum, j) in self.harmonics.iter_mut().zip(1..) {
            let [re, im] = turned(cycles, multiple, j);
            sum[0] += impulse * re;
            sum[1] += impulse * im;
        }
    }

    /// The numbers of an orbit of this period [s].
    pub fn over(self, period: f64) -> SignalStatistics {
        SignalStatistics {
            maximum: self.maximum,
            minimum: self.minimum,
            mean: self.integral / period,
            root_mean_square: (self.square / period).sqrt(),
            harmonics: self.harmonics.iter().map(|sum| sum.map(|part| 2.0 * part / period)).collect(),
        }
    }
}
