//! The sum of squares, its valleys, and how its minima are refined.

use super::{SecondMinimum, Used, difference, shift};
use crate::comparison::{Curves, Shift, curve};

/// Trials of the shift of frequencies, and steps of the logarithm of the factor.
const FREQUENCY_TRIALS: usize = 660;
const AMPLITUDE_STEP: f64 = 0.02;
/// Trials to each side than which a valley is lower, and distance beyond which refined minima are two, as a factor (an offset counts at 30 Hz).
const BESIDE: usize = 8;
const APART: f64 = 0.005;
/// Chi-squared of one freedom that is exceeded with 5 %.
const CHI_SQUARED: f64 = 3.84;
/// Part of the frequency over which a slope is taken, to each side.
const SECANT: f64 = 0.0025;
const ITERATIONS: usize = 40;
/// Difference of sums of squares that is none.
const SAME: f64 = 1e-12;

/// Shift of the frequency and logarithm of the factor.
pub(super) type Place = [f64; 2];

/// A place and its sum of squares.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub place: Place,
    pub cost: f64,
}

/// A point within the reach: its difference and the derivatives of it.
pub(super) struct Row {
    difference: f64,
    slopes: [f64; 2],
}

pub(super) struct Problem<'a> {
    pub used: &'a [Used],
    pub curves: &'a Curves,
    pub offset: bool,
    pub reach: f64,
    /// Lower and upper end of each number; the same for one that is given.
    pub tried: [[f64; 2]; 2],
}

impl Problem<'_> {
    /// Which numbers are fitted.
    pub fn free(&self) -> [bool; 2] {
        self.tried.map(|[low, high]| low < high)
    }

    /// Which of the fitted ones are at an end.
    pub fn at_end(&self, place: Place) -> [bool; 2] {
        std::array::from_fn(|k| self.free()[k] && self.tried[k].contains(&place[k]))
    }

    fn trial(&self, place: Place) -> Trial {
        Trial { place, cost: self.cost(place) }
    }

    fn shift(&self, at: Place) -> Shift {
        shift(self.offset, at[0], at[1])
    }

    /// `sum min(r^2, R^2)`.
    fn cost(&self, at: Place) -> f64 {
        let (shift, most) = (self.shift(at), self.reach * self.reach);
        let of = |point: &Used| difference(point, self.curves, shift).map_or(most, |r| (r * r).min(most));
        self.used.iter().map(of).sum()
    }

    /// Minima of all valleys of the shift of frequencies: the best of a grid in each, refined.
    pub fn minima(&self) -> Vec<Trial> {
        let [[low, high], [least, most]] = self.tried;
        let steps = ((most - least) / AMPLITUDE_STEP).ceil().max(1.0) as usize;
        let factors = trials(least, most, steps);
        let profile: Vec<Trial> = trials(low, high, FREQUENCY_TRIALS)
            .into_iter()
            .map(|shift| self.best_factor(shift, &factors))
            .collect();
        let lowest = |k: &usize| {
            let near = k.saturating_sub(BESIDE)..(k + BESIDE + 1).min(profile.len());
            profile[near].iter().all(|other| profile[*k].cost <= other.cost)
        };
        (0..profile.len()).filter(lowest).map(|k| self.refine(profile[k].place)).collect()
    }

    /// The lowest of some minima; of equal ones the nearest to no shift and no factor.
    pub fn best(&self, minima: &[Trial]) -> Trial {
        let none = if self.offset { 0.0 } else { 1.0 };
        let far = |trial: &Trial| (trial.place[0] - none).abs() + 1e-3 * trial.place[1].abs();
        let better = |one: &Trial, other: &Trial| {
            one.cost < other.cost - SAME || (one.cost <= other.cost + SAME && far(one) < far(other))
        };
        *minima.iter().fold(&minima[0], |best, one| if better(one, best) { one } else { best })
    }

    /// The best factor at a shift.
    fn best_factor(&self, frequency: f64, factors: &[f64]) -> Trial {
        let most = self.reach * self.reach;
        let values = self.values(frequency);
        let cost = |factor: f64| {
            let of = |(point, values): (&Used, &Vec<f64>)| {
                let square = |value: &f64| (factor + point.logarithm - value).powi(2);
                values.iter().map(square).fold(most, f64::min)
            };
            self.used.iter().zip(&values).map(of).sum::<f64>()
        };
        let mut best = Trial { cost: f64::INFINITY, place: [frequency, factors[0]] };
        for &factor in factors {
            let found = cost(factor);
            let nearer = factor.abs() < best.place[1].abs();
            if found < best.cost - SAME || (found <= best.cost + SAME && nearer) {
                best = Trial { cost: found, place: [frequency, factor] };
            }
        }
        best
    }

    /// The best minimum in another valley, if it is about as good: the data would prefer the best one to it with a probability of less than 95 %, `(n - p)(S' - S)/S < 3.84`
    /// (chi-squared of one freedom), or by less than a tenth of its sum of squares.
    pub fn second(&self, best: Trial, minima: &[Trial]) -> Option<SecondMinimum> {
        let fitted = self.free().into_iter().filter(|free| *free).count();
        let left = self.used.len().saturating_sub(fitted).max(1) as f64;
        let good = best.cost * (1.0 + (CHI_SQUARED / left).max(0.1));
        let distance = APART * if self.offset { 30.0 } else { 1.0 };
        let apart = |other: &&Trial| (other.place[0] - best.place[0]).abs() > distance;
        let found = minima.iter().filter(apart).min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        (best.cost > 0.0 && found.cost <= good).then(|| SecondMinimum {
            frequency: found.place[0],
            amplitude: found.place[1].exp(),
            // Equal ones differ by rounding.
            cost_ratio: (found.cost / best.cost).max(1.0),
            at_end: self.at_end(found.place).contains(&true),
        })
    }

    /// Logarithms of the values of the stable solutions that each point could belong to.
    fn values(&self, frequency: f64) -> Vec<Vec<f64>> {
        let shift = self.shift([frequency, 0.0]).frequency;
        let of = |point: &Used| {
            let hits = self.curves.at(shift.apply(point.frequency_hz), point.period);
            hits.iter().filter(|hit| hit.stable).map(|hit| hit.value.ln()).collect()
        };
        self.used.iter().map(of).collect()
    }

    /// Differences within the reach and their slopes.
    pub fn rows(&self, at: Place) -> Vec<Row> {
        let shift = self.shift(at);
        let row = |point: &Used| {
            let difference = difference(point, self.curves, shift).filter(|r| r.abs() <= self.reach)?;
            Some(Row { difference, slopes: [self.slope(point, at), 1.0] })
        };
        self.used.iter().filter_map(row).collect()
    }

    /// `dr/d(shift)`: minus the slope of the logarithm of the branch, by a secant on the branch that is met.
    fn slope(&self, point: &Used, at: Place) -> f64 {
        let shift = self.shift(at);
        let frequency = shift.frequency.apply(point.frequency_hz);
        let value = shift.amplitude_factor * point.logarithm.exp();
        let Some(here) = self.curves.nearest_stable(frequency, point.period, value) else { return 0.0 };
        let beside = |step: f64| {
            let hits = self.curves.at(frequency + step, point.period).into_iter();
            let same = hits.filter(|hit| hit.branch == here.branch && hit.stable);
            curve::nearest(same, here.value).map_or((0.0, here.value), |hit| (step, hit.value))
        };
        let step = SECANT * frequency;
        let ((left, low), (right, high)) = (beside(-step), beside(step));
        if right <= left {
            return 0.0;
        }
        let by_frequency = (high / low).ln() / (right - left);
        -by_frequency * if self.offset { 1.0 } else { point.frequency_hz }
    }

    /// Gauss-Newton steps within what is tried, halved until the cost falls.
    fn refine(&self, begin: Place) -> Trial {
        let mut at = self.trial(begin);
        for _ in 0..ITERATIONS {
            let Some(step) = self.step(at.place) else { break };
            let place = |share: f64| -> Place {
                std::array::from_fn(|k| {
                    let [low, high] = self.tried[k];
                    (at.place[k] + share * step[k]).clamp(low, high)
                })
            };
            let shorter = (0..12).map(|halvings| self.trial(place(0.5_f64.powi(halvings))));
            let Some(found) = shorter.into_iter().find(|found| found.cost < at.cost) else { break };
            let done = at.cost - found.cost <= 1e-13 * at.cost;
            at = found;
            if done {
                break;
            }
        }
        at
    }

    /// A Gauss-Newton step; a number that is at an end and would leave it is held there, and the other one goes alone.
    fn step(&self, at: Place) -> Option<Place> {
        let rows = self.rows(at);
        let mut free = self.free();
        loop {
            let step = gauss_newton(&rows, free)?;
            let leaves = |k: &usize| {
                let [low, high] = self.tried[*k];
                free[*k] && ((at[*k] <= low && step[*k] < 0.0) || (at[*k] >= high && step[*k] > 0.0))
            };
            let Some(held) = (0..2).find(leaves) else { return Some(step) };
            free[held] = false;
        }
    }
}

/// Evenly spaced numbers from one end to the other, both included; one where they are the same.
fn trials(low: f64, high: f64, steps: usize) -> Vec<f64> {
    if low == high {
        return vec![low];
    }
    let inner = (1..steps).map(|k| low + (high - low) * k as f64 / steps as f64);
    [low].into_iter().chain(inner).chain([high]).collect()
}

/// `J^T J`, with the identity in the rows that are not free.
fn normal(rows: &[Row], free: [bool; 2]) -> [[f64; 2]; 2] {
    let mut matrix = [[0.0; 2]; 2];
    for j in 0..2 {
        for k in 0..2 {
            matrix[j][k] = if free[j] && free[k] {
                rows.iter().map(|row| row.slopes[j] * row.slopes[k]).sum()
            } else {
                f64::from(u8::from(j == k))
            };
        }
    }
    matrix
}

fn inverse(matrix: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let [[a, b], [c, d]] = matrix;
    let determinant = a * d - b * c;
    // Slopes that are all alike cannot be told from the factor.
    if determinant <= 1e-12 * a * d {
        return None;
    }
    Some([[d / determinant, -b / determinant], [-c / determinant, a / determinant]])
}

fn gauss_newton(rows: &[Row], free: [bool; 2]) -> Option<Place> {
    let inverse = inverse(normal(rows, free))?;
    let gradient: [f64; 2] = std::array::from_fn(|k| {
        if free[k] { rows.iter().map(|row| row.slopes[k] * row.difference).sum() } else { 0.0 }
    });
    Some(std::array::from_fn(|j| -(inverse[j][0] * gradient[0] + inverse[j][1] * gradient[1])))
}

/// Infinite where the points cannot tell the numbers apart.
pub(super) fn covariance(rows: &[Row], free: [bool; 2]) -> [[f64; 2]; 2] {
    let fitted = free.iter().filter(|free| **free).count();
    let left = rows.len().saturating_sub(fitted).max(1);
    let variance = rows.iter().map(|row| row.difference * row.difference).sum::<f64>() / left as f64;
    inverse(normal(rows, free))
        .map_or([[f64::INFINITY; 2]; 2], |matrix| matrix.map(|row| row.map(|v| v * variance)))
}
