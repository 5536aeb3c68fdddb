//! How well the numbers are known: the differences within the reach, their slopes, and the covariance that
//! follows.

use super::{
    problem::{Place, Problem},
    used::{Used, difference},
};
use crate::comparison::curve;

/// Part of the frequency over which a slope is taken, to each side.
const SECANT: f64 = 0.0025;

/// A point within the reach: its difference and the derivatives of it.
pub(super) struct Row {
    pub difference: f64,
    slopes: [f64; 2],
}

impl Problem<'_> {
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
    // Slopes that are all alike cannot be separated from the factor.
    if determinant <= 1e-12 * a * d {
        return None;
    }
    Some([[d / determinant, -b / determinant], [-c / determinant, a / determinant]])
}

/// Infinite where the points cannot separate the numbers.
pub(super) fn covariance(rows: &[Row], free: [bool; 2]) -> [[f64; 2]; 2] {
    let fitted = free.iter().filter(|free| **free).count();
    let left = rows.len().saturating_sub(fitted).max(1);
    let variance = rows.iter().map(|row| row.difference * row.difference).sum::<f64>() / left as f64;
    inverse(normal(rows, free))
        .map_or([[f64::INFINITY; 2]; 2], |matrix| matrix.map(|row| row.map(|v| v * variance)))
}
