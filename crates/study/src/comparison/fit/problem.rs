//! The sum of squares, and how it is made smaller from a place on.

use super::{Used, difference, shift};
use crate::comparison::{Curves, Shift, curve};

/// Part of the frequency over which a slope is taken, to each side.
const SECANT: f64 = 0.0025;
const ITERATIONS: usize = 40;
/// Most steps to the best factor at a shift.
const FACTOR_STEPS: usize = 20;

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
    pub difference: f64,
    slopes: [f64; 2],
}

pub(super) struct Problem<'a> {
    pub used: &'a [Used],
    pub curves: &'a Curves,
    pub offset: bool,
    pub reach: f64,
    /// What a relative shift of 1 is: 1 for factors, the median frequency of the points for offsets [Hz].
    pub unit: f64,
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

    pub fn trial(&self, place: Place) -> Trial {
        Trial { place, cost: self.cost(place) }
    }

    pub fn shift(&self, at: Place) -> Shift {
        shift(self.offset, at[0], at[1])
    }

    /// `sum min(r^2, R^2)`.
    fn cost(&self, at: Place) -> f64 {
        let (shift, most) = (self.shift(at), self.reach * self.reach);
        let of = |point: &Used| difference(point, self.curves, shift).map_or(most, |r| (r * r).min(most));
        self.used.iter().map(of).sum()
    }

    /// Logarithms of the values of the stable solutions that each point could belong to.
    pub fn values(&self, frequency: f64) -> Vec<Vec<f64>> {
        let shift = self.shift([frequency, 0.0]).frequency;
        let of = |point: &Used| {
            let hits = self.curves.at(shift.apply(point.frequency_hz), point.period);
            hits.iter().filter(|hit| hit.stable).map(|hit| hit.value.ln()).collect()
        };
        self.used.iter().map(of).collect()
    }

    /// The differences nearest to zero, with what [`Problem::values`] gives and a logarithm of the factor.
    pub fn differences<'b>(
        &'b self,
        values: &'b [Vec<f64>],
        factor: f64,
    ) -> impl Iterator<Item = Option<f64>> + 'b {
        self.used.iter().zip(values).map(move |(point, values)| {
            let differences = values.iter().map(|value| factor + point.logarithm - value);
            differences.min_by(|a, b| a.abs().total_cmp(&b.abs()))
        })
    }

    /// `sum min(r^2, R^2)` of such differences.
    pub fn cost_of(&self, values: &[Vec<f64>], factor: f64) -> f64 {
        let most = self.reach * self.reach;
        self.differences(values, factor).map(|r| r.map_or(most, |r| (r * r).min(most))).sum()
    }

    /// The best factor at a shift, from one on: the mean of the differences within the reach is taken off until that is no gain.
    pub fn at_shift(&self, values: &[Vec<f64>], begin: Place) -> Trial {
        let [low, high] = self.tried[1];
        let mut best = Trial { place: begin, cost: self.cost_of(values, begin[1]) };
        for _ in 0..FACTOR_STEPS {
            let within = self.differences(values, best.place[1]).flatten().filter(|r| r.abs() <= self.reach);
            let (sum, count) = within.fold((0.0, 0.0), |(sum, count), r| (sum + r, count + 1.0));
            let factor = (best.place[1] - sum / f64::max(count, 1.0)).clamp(low, high);
            let cost = self.cost_of(values, factor);
            if cost >= best.cost {
                break;
            }
            best = Trial { place: [begin[0], factor], cost };
        }
        best
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
    pub fn refine(&self, begin: Place) -> Trial {
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
