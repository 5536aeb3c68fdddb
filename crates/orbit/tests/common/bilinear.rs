//! Bifurcations of bilinear oscillators in closed form.
//!
//! `x'' + c x' + k x = F cos W t`, with the force `(K - k)(x - g)` besides beyond the gap `g`. In `y = x - g`
//! either region is linear, `y'' + c y' + k y = F cos W t - k g`, and the same with `K y`. An orbit with one
//! contact a period enters it at the time `t_1` with the velocity `v`, leaves it `s` later and comes back
//! after the period. In either region the motion is a steady part and a decaying part that `E(t)`, the
//! exponential of the region, carries on. The four unknowns `t_1, v, s, W` obey
//!
//! `y(t_1 + s) = 0`, `y(t_1 + T) = 0`, `y'(t_1 + T) = v`, `det(M - m) = m^2 - m tr M + det M = 0`,
//! `M = E_k(T - s) E_K(s)`,
//!
//! with `m = -1` at a flip and `m = 1` at a fold: the force has no jump, so the fundamental matrix is the
//! product of the exponentials.
//!
//! With the same stop at `-g`, an orbit that is its own mirror image touches both once a period. Half a
//! period after `t_1` it is at `-g` with `-v`: `y(t_1 + T/2) = -2g`, `y'(t_1 + T/2) = -v`, and
//! `M = E_k(T/2 - s) E_K(s)`. A deviation comes back mirrored, as `-M` times itself, so it alternates from
//! one half to the next where M has the multiplier +1: there the motion loses its symmetry.
//!
//! Newton's method with differences solves them.

use std::f64::consts::{PI, TAU};

use super::events::{Subject, oscillator};
use hammerbeam_motion::{
    Law,
    law::{LinearStop, TwoSidedStop},
};
use hammerbeam_orbit::PeriodicSolution;

const DAMPER: f64 = 0.1;
const FORCE: f64 = 1.0;

/// Stiffness k without contact.
pub const SOFT: f64 = 1.0;

/// An oscillator of unit mass.
#[derive(Debug, Clone, Copy)]
pub struct Bilinear {
    /// Stiffness K with contact.
    pub stiff: f64,
    pub gap: f64,
    /// Whether there is the same stop on the other side.
    pub is_symmetric: bool,
}

impl Bilinear {
    pub const fn one_sided(stiff: f64, gap: f64) -> Self {
        Self { stiff, gap, is_symmetric: false }
    }

    pub const fn symmetric(stiff: f64, gap: f64) -> Self {
        Self { stiff, gap, is_symmetric: true }
    }

    pub fn subject(self) -> Subject {
        let law = if self.is_symmetric {
            Law::TwoSided(TwoSidedStop::new(self.stiff - SOFT, self.gap, self.gap).unwrap())
        } else {
            Law::Linear(LinearStop::with_gap(self.stiff - SOFT, self.gap).unwrap())
        };
        oscillator(SOFT, DAMPER, FORCE, law)
    }

    /// Frequency [Hz] at which the orbit with one contact at each stop that is near to this one has a
    /// multiplier, of half the period where the stops are symmetric.
    pub fn frequency_hz(self, multiplier: f64, near: &PeriodicSolution) -> f64 {
        let mut unknowns = self.contact_of(near);
        for _ in 0..20 {
            let value = self.equations(multiplier, unknowns);
            let mut matrix = [[0.0; 5]; 4];
            for j in 0..4 {
                let h = 1e-6;
                let at = |sign: f64| {
                    let mut other = unknowns;
                    other[j] += sign * h;
                    self.equations(multiplier, other)
                };
                let (plus, minus) = (at(1.0), at(-1.0));
                (0..4).for_each(|i| matrix[i][j] = (plus[i] - minus[i]) / (2.0 * h));
            }
            (0..4).for_each(|i| matrix[i][4] = -value[i]);
            let update = eliminate(matrix);
            (0..4).for_each(|i| unknowns[i] += update[i]);
        }
        let left = self.equations(multiplier, unknowns);
        assert!(left.iter().all(|value| value.abs() < 1e-12), "{left:?}");
        unknowns[3] / TAU
    }

    /// Steady part `[y, y']` of a region of stiffness `k` at a time.
    fn steady(self, stiffness: f64, omega: f64, time: f64) -> [f64; 2] {
        let (re, im) = (stiffness - omega * omega, DAMPER * omega);
        let size = FORCE / (re * re + im * im);
        let (cosine, sine) = ((omega * time).cos(), (omega * time).sin());
        let rest = -SOFT * self.gap / stiffness;
        [rest + size * (re * cosine + im * sine), size * omega * (im * cosine - re * sine)]
    }

    /// State a time after a state at `start` in a region.
    fn moved(self, stiffness: f64, omega: f64, (start, time): (f64, f64), state: [f64; 2]) -> [f64; 2] {
        let [before, after] = [start, start + time].map(|time| self.steady(stiffness, omega, time));
        let e = exponential(stiffness, time);
        let free = [state[0] - before[0], state[1] - before[1]];
        [0, 1].map(|i| after[i] + e[i][0] * free[0] + e[i][1] * free[1])
    }

    /// The four equations for `[t_1, v, s, W]`.
    fn equations(self, multiplier: f64, [enters, speed, duration, omega]: [f64; 4]) -> [f64; 4] {
        let period = TAU / omega;
        let (until_next, sides) = if self.is_symmetric { (0.5 * period, -1.0) } else { (period, 1.0) };
        let flight = until_next - duration;
        let leaves = self.moved(self.stiff, omega, (enters, duration), [0.0, speed]);
        let back = self.moved(SOFT, omega, (enters + duration, flight), leaves);
        let m = times(exponential(SOFT, flight), exponential(self.stiff, duration));
        let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let characteristic = multiplier * (multiplier - m[0][0] - m[1][1]) + determinant;
        let next = self.gap * (sides - 1.0);
        [leaves[0], back[0] - next, back[1] - sides * speed, characteristic]
    }

    /// The unknowns of an orbit, roughly, by steps of the closed form from its first state, in flight.
    fn contact_of(self, orbit: &PeriodicSolution) -> [f64; 4] {
        let omega = TAU * orbit.frequency_hz;
        let (steps, mut state) = (20_000, [orbit.nodes[0][0] - self.gap, orbit.nodes[0][1]]);
        let (mut enters, mut leaves, mut speed) = (0.0, 0.0, 0.0);
        let h = TAU / omega / f64::from(steps);
        for k in 0..2 * steps {
            let time = f64::from(k) * h;
            let stiffness = if state[0] > 0.0 { self.stiff } else { SOFT };
            let next = if self.is_symmetric && state[0] < -2.0 * self.gap {
                let below = self.moved(self.stiff, omega, (time + PI / omega, h), self.mirrored(state));
                self.mirrored(below)
            } else {
                self.moved(stiffness, omega, (time, h), state)
            };
            if state[0] <= 0.0 && next[0] > 0.0 && enters == 0.0 {
                (enters, speed) = (time, next[1]);
            } else if state[0] > 0.0 && next[0] <= 0.0 && enters != 0.0 && leaves == 0.0 {
                leaves = time;
            }
            state = next;
        }
        [enters, speed, leaves - enters, omega]
    }

    /// The state as it is half a period later on the other side.
    fn mirrored(self, [y, speed]: [f64; 2]) -> [f64; 2] {
        [-y - 2.0 * self.gap, -speed]
    }
}

/// `E(t)` of `y'' + c y' + k y = 0`, underdamped, by rows.
fn exponential(stiffness: f64, time: f64) -> [[f64; 2]; 2] {
    let half = 0.5 * DAMPER;
    let w = (stiffness - half * half).sqrt();
    let (decay, cosine, sine) = ((-half * time).exp(), (w * time).cos(), (w * time).sin() / w);
    [
        [decay * (cosine + half * sine), decay * sine],
        [-decay * stiffness * sine, decay * (cosine - half * sine)],
    ]
}

fn times(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

fn eliminate(mut m: [[f64; 5]; 4]) -> [f64; 4] {
    for k in 0..4 {
        let best = (k..4).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs())).unwrap();
        m.swap(k, best);
        for i in (0..4).filter(|&i| i != k) {
            let (factor, pivot) = (m[i][k] / m[k][k], m[k]);
            (0..5).for_each(|j| m[i][j] -= factor * pivot[j]);
        }
    }
    [0, 1, 2, 3].map(|i| m[i][4] / m[i][i])
}
