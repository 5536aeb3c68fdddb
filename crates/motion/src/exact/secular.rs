//! A load at (or very near) resonance: the motion it drives from rest.
//!
//! `p' = s + Re(beta e)`, `s' = -k p - c s + Re(phi e)`, `e = exp(i (w t + angle))`, from `p = s = 0`. With
//! `C = Re e`, `S = Im e` and `t C`, `t S` as further states, the motion and its derivative by the frequency
//! solve one constant linear system of eight equations, whose exponential is finite whatever the distance
//! from resonance. The constant load on a free block (gravity on a rigid mode) is the parabola.

use faer::c64;

use super::output::Output;

const SIZE: usize = 8;
type Matrix<const N: usize> = [[f64; N]; N];

/// A resonant load on one block.
#[derive(Debug, Clone)]
pub(crate) struct SecularLoad {
    pub block: usize,
    stiffness: f64,
    damping: f64,
    frequency: f64,
    input: [c64; 2],
    is_change: bool,
    system: Matrix<SIZE>,
}

/// Motion of the block, from rest at the start of the stretch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SecularResponse {
    pub state: [f64; 2],
    pub rate: [f64; 2],
    pub curvature: [f64; 2],
    pub by_frequency: [f64; 2],
}

impl SecularLoad {
    /// * `(k, c)`: the block; `input`: `[beta, phi]`; `input_by_frequency` [1/Hz].
    /// * `(w, rate)`: circular frequency and its derivative by the excitation frequency.
    /// * `angle`: phase of the load at the start of the stretch.
    pub fn new(
        block: usize,
        (stiffness, damping): (f64, f64),
        input: [c64; 2],
        input_by_frequency: [c64; 2],
        (frequency, rate): (f64, f64),
        angle: f64,
    ) -> Self {
        let turned = c64::new(angle.cos(), angle.sin());
        let input = input.map(|value| value * turned);
        let input_by_frequency = input_by_frequency.map(|value| value * turned);
        let mut system = [[0.0; SIZE]; SIZE];
        for offset in [0, 2] {
            system[offset][offset + 1] = 1.0;
            system[offset + 1][offset] = -stiffness;
            system[offset + 1][offset + 1] = -damping;
        }
        for row in 0..2 {
            system[row][4] = input[row].re;
            system[row][5] = -input[row].im;
            system[2 + row][4] = input_by_frequency[row].re;
            system[2 + row][5] = -input_by_frequency[row].im;
            system[2 + row][6] = -rate * input[row].im;
            system[2 + row][7] = -rate * input[row].re;
        }
        system[4][5] = -frequency;
        system[5][4] = frequency;
        system[6][7] = -frequency;
        system[7][6] = frequency;
        system[6][4] = 1.0;
        system[7][5] = 1.0;
        Self { block, stiffness, damping, frequency, input, is_change: false, system }
    }

    /// The change of another block (or of the same) by what this load does, `s' = A s + K x` from rest; of it
    /// only [`SecularLoad::state`] is told.
    ///
    /// * `block`, `(k, c)`: the block that changes; `coupling`: `K`.
    pub fn change(&self, block: usize, (stiffness, damping): (f64, f64), coupling: &[[f64; 2]; 2]) -> Self {
        let mut system = [[0.0; SIZE]; SIZE];
        for (offset, k, c) in [(0, stiffness, damping), (2, self.stiffness, self.damping)] {
            system[offset][offset + 1] = 1.0;
            system[offset + 1][offset] = -k;
            system[offset + 1][offset + 1] = -c;
        }
        for row in 0..2 {
            system[row][2..4].copy_from_slice(&coupling[row]);
            system[2 + row][4..6].copy_from_slice(&self.system[row][4..6]);
        }
        system[4][5] = -self.frequency;
        system[5][4] = self.frequency;
        Self { block, stiffness, damping, system, is_change: true, ..*self }
    }

    /// Whether the load is of order 0.
    pub fn is_constant(&self) -> bool {
        self.frequency == 0.0
    }

    /// Whether it is a constant load on a block without stiffness and damping.
    pub fn is_parabola(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0 && self.frequency == 0.0 && !self.is_change
    }

    /// The motion at `time` after the start.
    pub fn response(&self, time: f64) -> SecularResponse {
        let (state, by_frequency) = self.motion(time);
        let (sin, cos) = (self.frequency * time).sin_cos();
        let rotation = c64::new(cos, sin);
        let load = self.input.map(|value| (value * rotation).re);
        let load_rate = self.input.map(|value| (value * rotation * c64::new(0.0, self.frequency)).re);
        let rate = [state[1] + load[0], -self.stiffness * state[0] - self.damping * state[1] + load[1]];
        let curvature =
            [rate[1] + load_rate[0], -self.stiffness * rate[0] - self.damping * rate[1] + load_rate[1]];
        SecularResponse { state, rate, curvature, by_frequency }
    }

    /// `[p, s]` at `time` after the start.
    pub fn state(&self, time: f64) -> [f64; 2] {
        self.motion(time).0
    }

    fn motion(&self, time: f64) -> ([f64; 2], [f64; 2]) {
        if self.is_parabola() { self.parabola(time) } else { self.exponential(time) }
    }

    /// Derivative of the rate by the frequency at `time` after the start.
    pub fn rate_by_frequency(&self, time: f64) -> [f64; 2] {
        let [p, s] = self.response(time).by_frequency;
        let (sin, cos) = (self.frequency * time).sin_cos();
        let load = |row: usize| {
            let input = &self.system[2 + row];
            input[4] * cos + input[5] * sin + time * (input[6] * cos + input[7] * sin)
        };
        [s + load(0), -self.stiffness * p - self.damping * s + load(1)]
    }

    fn parabola(&self, time: f64) -> ([f64; 2], [f64; 2]) {
        let [beta, phi] = [self.system[0][4], self.system[1][4]];
        let [beta_f, phi_f] = [self.system[2][4], self.system[3][4]];
        let half = 0.5 * time * time;
        ([beta * time + phi * half, phi * time], [beta_f * time + phi_f * half, phi_f * time])
    }

    fn exponential(&self, time: f64) -> ([f64; 2], [f64; 2]) {
        let exponential = exponential(&self.system, time);
        let column = |row: usize| exponential[row][4];
        ([column(0), column(1)], [column(2), column(3)])
    }

    /// Bound on the part that `output` reads, until `until`.
    pub fn magnitude(&self, output: &Output, until: f64) -> f64 {
        let n = output.row.len() / 2;
        let [beta, phi] = self.input.map(c64::norm);
        let root = self.stiffness.sqrt();
        let speed = (root * beta + phi) * until;
        let displacement = (beta * until + 0.5 * phi * until * until).min(speed / root);
        output.row[self.block].abs() * displacement + output.row[n + self.block].abs() * speed
    }

    /// Bounds on the second and third derivative of the part that `output` reads, until `until`.
    pub fn bounds(&self, output: &Output, until: f64) -> (f64, f64) {
        let [second, third, _] = self.derivative_bounds(output, until);
        (second, third)
    }

    /// Bound on the fourth derivative of the part that `output` reads, until `until`.
    pub fn fourth_bound(&self, output: &Output, until: f64) -> f64 {
        self.derivative_bounds(output, until)[2]
    }

    /// Bounds on the second to fourth derivative.
    ///
    /// The energy norm grows at most like `g t`, `g = sqrt(k) |beta| + |phi|`, since damping only takes.
    fn derivative_bounds(&self, output: &Output, until: f64) -> [f64; 3] {
        let n = output.row.len() / 2;
        let [beta, phi] = self.input.map(c64::norm);
        let root = self.stiffness.sqrt();
        let norm = (root * beta + phi) * until;
        let (p, s) = (output.row[self.block].abs(), output.row[n + self.block].abs());
        let (c, w, k) = (self.damping, self.frequency, self.stiffness);
        let s_1 = (root + c) * norm + phi;
        let s_2 = k * (norm + beta) + c * s_1 + w * phi;
        let s_3 = k * (s_1 + w * beta) + c * s_2 + w * w * phi;
        let s_4 = k * (s_2 + w * w * beta) + c * s_3 + w * w * w * phi;
        [
            p * (s_1 + w * beta) + s * s_2,
            p * (s_2 + w * w * beta) + s * s_3,
            p * (s_3 + w * w * w * beta) + s * s_4,
        ]
    }
}

fn multiply<const N: usize>(x: &Matrix<N>, y: &Matrix<N>) -> Matrix<N> {
    let mut product = [[0.0; N]; N];
    for i in 0..N {
        for k in 0..N {
            for j in 0..N {
                product[i][j] += x[i][k] * y[k][j];
            }
        }
    }
    product
}

/// `exp(A t)` by Taylor's series of `A t / 2^j` and j squarings.
pub(super) fn exponential<const N: usize>(system: &Matrix<N>, time: f64) -> Matrix<N> {
    let norm =
        system.iter().map(|row| row.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max) * time.abs();
    let squarings = if norm > 0.5 { (norm / 0.5).log2().ceil() as i32 } else { 0 };
    let scaled = system.map(|row| row.map(|value| value * time / 2f64.powi(squarings)));
    let mut sum = [[0.0; N]; N];
    (0..N).for_each(|i| sum[i][i] = 1.0);
    let mut term = sum;
    for m in 1..=18 {
        term = multiply(&term, &scaled).map(|row| row.map(|value| value / f64::from(m)));
        (0..N).for_each(|i| (0..N).for_each(|j| sum[i][j] += term[i][j]));
    }
    for _ in 0..squarings {
        sum = multiply(&sum, &sum);
    }
    sum
}
