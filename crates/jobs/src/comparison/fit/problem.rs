//! The sum of squares, and the factor that makes it smallest at a shift.
//!
//! At a shift each point `i` has the stable values `M_ij` that it could belong to, and with the factor `a`,
//! `x = ln a`, it adds `min_j min((x - c_ij)^2, R^2)`, where `c_ij = ln M_ij - ln A_i` is the factor that
//! would bring it there. Along `x` that is a parabola about each `c_ij`, as far as no other one is nearer and
//! as far as `R`, and the level `R^2` elsewhere. So the sum is a parabola between neighbouring ends of such
//! pieces, and going over these ends in their order, with running sums of the pieces that are open, gives the
//! smallest of all: not a local minimum.

use super::used::Used;
use crate::comparison::{Curves, Shift};

/// Difference of sums of squares that is none.
pub(super) const SAME: f64 = 1e-12;
/// Error that the running sums may have.
const ROUNDING: f64 = 1e-9;

/// Shift of the frequency and logarithm of the factor.
pub(super) type Place = [f64; 2];

/// A place and its sum of squares.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub place: Place,
    pub cost: f64,
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

/// An end of a piece: where, and what begins (1) or ends (-1) there about which centre.
struct End {
    at: f64,
    sign: f64,
    centre: f64,
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

    pub fn shift(&self, at: Place) -> Shift {
        Shift::new(self.offset, at[0], at[1])
    }

    /// The best factor of those that are tried, at a shift.
    pub fn best_at(&self, frequency: f64) -> Trial {
        self.best_between(frequency, self.tried[1])
    }

    /// The best factor between two logarithms, at a shift; of equal ones the nearest to 1.
    pub fn best_between(&self, frequency: f64, [low, high]: [f64; 2]) -> Trial {
        let centres = self.centres(frequency);
        let of = |x: f64| Trial { place: [frequency, x], cost: self.cost(&centres, x) };
        let lowest = self.lowest(&centres, [low, high]);
        let least = lowest.iter().map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min);
        let good = lowest.iter().filter(|(cost, _)| *cost <= least + ROUNDING).map(|(_, x)| of(*x));
        let nearer = |one: &Trial, other: &Trial| one.place[1].abs() < other.place[1].abs();
        good.fold(of(0.0_f64.clamp(low, high)), |best, one| {
            let equal = one.cost <= best.cost + SAME;
            if one.cost < best.cost - SAME || (equal && nearer(&one, &best)) { one } else { best }
        })
    }

    /// For each point the logarithms of the factors that would bring it onto the stable solutions that it
    /// could belong to, in ascending order.
    fn centres(&self, frequency: f64) -> Vec<Vec<f64>> {
        let shift = self.shift([frequency, 0.0]).frequency;
        let of = |point: &Used| {
            let hits = self.curves.at(shift.apply(point.frequency_hz), point.period);
            let stable = hits.iter().filter(|hit| hit.stable);
            let mut centres: Vec<f64> = stable.map(|hit| hit.value.ln() - point.logarithm).collect();
            centres.sort_by(f64::total_cmp);
            centres
        };
        self.used.iter().map(of).collect()
    }

    /// `sum min(r^2, R^2)`.
    fn cost(&self, centres: &[Vec<f64>], x: f64) -> f64 {
        let most = self.reach * self.reach;
        let of = |centres: &Vec<f64>| centres.iter().map(|c| (x - c).powi(2)).fold(most, f64::min);
        centres.iter().map(of).sum()
    }

    /// The smallest sum between each two neighbouring ends of pieces, by running sums, and where it is.
    fn lowest(&self, centres: &[Vec<f64>], [low, high]: [f64; 2]) -> Vec<(f64, f64)> {
        let mut ends: Vec<End> = centres.iter().flat_map(|of_point| self.ends(of_point)).collect();
        ends.sort_by(|a, b| a.at.total_cmp(&b.at));
        let most = self.reach * self.reach;
        // Of the open pieces: how many, the sum of their centres, and of the squares of these.
        let (mut count, mut sum, mut squares) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut lowest = Vec::with_capacity(ends.len() + 1);
        let mut from = f64::NEG_INFINITY;
        for index in 0..=ends.len() {
            let to = ends.get(index).map_or(f64::INFINITY, |end| end.at);
            if from < to && from <= high && to >= low {
                let middle: f64 = if count > 0.0 { sum / count } else { 0.0 };
                let x = middle.clamp(from, to).clamp(low, high);
                let level = (centres.len() as f64 - count) * most;
                lowest.push((count * x * x - 2.0 * x * sum + squares + level, x));
            }
            if let Some(end) = ends.get(index) {
                count += end.sign;
                sum += end.sign * end.centre;
                squares += end.sign * end.centre * end.centre;
                from = end.at;
            }
        }
        lowest
    }

    /// The ends of the pieces of a point.
    fn ends(&self, centres: &[f64]) -> Vec<End> {
        let middle = |k: usize| 0.5 * (centres[k] + centres[k + 1]);
        let piece = |(k, &centre): (usize, &f64)| {
            let low = if k == 0 { f64::NEG_INFINITY } else { middle(k - 1) };
            let high = if k + 1 == centres.len() { f64::INFINITY } else { middle(k) };
            let [low, high] = [low.max(centre - self.reach), high.min(centre + self.reach)];
            [End { at: low, sign: 1.0, centre }, End { at: high, sign: -1.0, centre }]
        };
        centres.iter().enumerate().flat_map(piece).collect()
    }
}
