//! The grid of shifts, its valleys, and the minima in them.
//!
//! With the best factor at each shift (`problem.rs`), what is left is a function of the shift alone. It is
//! tried on a grid, and the lowest valleys of that are gone over with finer and finer grids: a valley can lie
//! beside the end of a branch, where the sum jumps since a point more or less meets it, and slopes say
//! nothing of that.
//!
//! **The step** of the grid goes by the branches: over a step the logarithm of a branch changes by no more
//! than a tenth, but for the steepest parts, which make up a twentieth of all its rise and fall (at a fold
//! the slope has no bound). A valley that is narrower than the grid is missed.

use super::problem::{Place, Problem, SAME, Trial};

/// Fewest and most trials of the shift of frequencies, change of the logarithm of a branch over a step, and
/// part of the variation that may be steeper.
const TRIALS: (usize, usize) = (660, 4000);
const CHANGE: f64 = 0.1;
const STEEPER: f64 = 0.05;
/// Valleys that are gone over, the lowest first.
const VALLEYS: usize = 60;
/// Trials to each side of the lowest place so far, how much finer each time, and how often: a third more than
/// the last step to each side, down to 8e-9 of the first one.
const ABOUT: i32 = 4;
const FINER: f64 = 3.0;
const LEVELS: i32 = 17;
/// Trials between two minima, to see what parts them.
const BETWEEN: usize = 40;
/// Chi-squared of one freedom that is exceeded with 5 %.
const CHI_SQUARED: f64 = 3.84;
/// Part of the sum of squares by which another minimum may always be worse.
const WORSE: f64 = 0.1;
/// Square of a difference of a point that is none: 1e-6, what tables of points are written to.
const WRITTEN: f64 = 1e-12;

/// Another minimum of the fit, in another valley of the shift of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondMinimum {
    /// Factor, or offset [Hz].
    pub frequency: f64,
    /// Factor on values.
    pub amplitude: f64,
    /// Sum of squares of the points that the best one goes by, and what this one has more, over the former: 1
    /// at least. Points that fit neither do not count.
    pub cost_ratio: f64,
    /// Points that it goes by.
    pub points: usize,
    /// Whether one of both numbers is at an end of what is tried.
    pub at_end: bool,
}

impl Problem<'_> {
    /// The lowest places of all valleys of the shift of frequencies.
    pub fn minima(&self) -> Vec<Trial> {
        let [low, high] = self.tried[0];
        let shifts = trials(low, high, self.steps());
        let profile: Vec<Trial> = shifts.iter().map(|shift| self.best_at(*shift)).collect();
        let cost = |k: usize| profile.get(k).map_or(f64::INFINITY, |trial| trial.cost);
        // Of a level stretch the first one.
        let lowest = |k: &usize| (*k == 0 || cost(*k) < cost(k - 1)) && cost(*k) <= cost(k + 1);
        let mut valleys: Vec<usize> = (0..profile.len()).filter(lowest).collect();
        valleys.sort_by(|a, b| cost(*a).total_cmp(&cost(*b)));
        valleys.truncate(VALLEYS);
        let step = (high - low) / (shifts.len().max(2) - 1) as f64;
        valleys.into_iter().map(|k| self.about(profile[k], step)).collect()
    }

    /// Steps of the grid of shifts.
    fn steps(&self) -> usize {
        let [low, high] = self.tried[0];
        if low == high {
            return 1;
        }
        let wanted = (high - low) / self.unit * self.steepness() / CHANGE;
        (wanted.ceil() as usize).clamp(TRIALS.0, TRIALS.1)
    }

    /// `|d ln M / d ln f|` of stable branches where points may come to lie; steeper parts make up a small
    /// part of the variation.
    fn steepness(&self) -> f64 {
        let places = self.used.iter().flat_map(|point| {
            self.tried[0].map(|end| self.shift([end, 0.0]).frequency.apply(point.frequency_hz))
        });
        let (from, to) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), f| (a.min(f), b.max(f)));
        let pairs = self.curves.branches().iter().flat_map(|branch| branch.points.windows(2));
        let mut parts: Vec<(f64, f64)> = pairs
            .filter(|pair| pair.iter().all(|point| point.stable && (from..=to).contains(&point.frequency_hz)))
            .map(|pair| {
                let rise = (pair[1].value / pair[0].value).ln().abs();
                (rise / (pair[1].frequency_hz / pair[0].frequency_hz).ln().abs(), rise)
            })
            .filter(|(slope, rise)| slope.is_finite() && rise.is_finite())
            .collect();
        parts.sort_by(|a, b| b.0.total_cmp(&a.0));
        let most = STEEPER * parts.iter().map(|(_, rise)| rise).sum::<f64>();
        let mut steeper = 0.0;
        let bounded = parts.iter().find(|(_, rise)| {
            steeper += rise;
            steeper > most
        });
        bounded.map_or(0.0, |(slope, _)| *slope)
    }

    /// The lowest place about one, by finer and finer grids.
    fn about(&self, begin: Trial, step: f64) -> Trial {
        let [low, high] = self.tried[0];
        if low == high {
            return begin;
        }
        (1..=LEVELS).fold(begin, |at, level| {
            let finer = step / FINER.powi(level);
            (-ABOUT..=ABOUT).filter(|k| *k != 0).fold(at, |best, k| {
                let found = self.best_at((at.place[0] + f64::from(k) * finer).clamp(low, high));
                if found.cost < best.cost { found } else { best }
            })
        })
    }

    /// The lowest of some minima; of equal ones the nearest to no shift and no factor.
    pub fn best(&self, minima: &[Trial]) -> Trial {
        let none = if self.offset { 0.0 } else { 1.0 };
        let far = |trial: &Trial| (trial.place[0] - none).abs() / self.unit + 1e-3 * trial.place[1].abs();
        let better = |one: &Trial, other: &Trial| {
            one.cost < other.cost - SAME || (one.cost <= other.cost + SAME && far(one) < far(other))
        };
        *minima.iter().fold(&minima[0], |best, one| if better(one, best) { one } else { best })
    }

    /// The best minimum beyond shifts that fit worse, if it is about as good: with the `n` points within the
    /// reach of the best one, their sum of squares `S`, and sums of all points `F` and `F'`, the data would
    /// prefer the best one to it with a probability of less than 95 %, `(n - p)(F' - F)/S < 3.84`
    /// (chi-squared of one freedom), or by less than a tenth of `S`. Points that fit neither are in both `F`
    /// and `F'`, and drop out.
    pub fn second(&self, best: Trial, minima: &[Trial]) -> Option<SecondMinimum> {
        let rows = self.rows(best.place);
        let fitted = self.free().into_iter().filter(|free| *free).count();
        let left = rows.len().saturating_sub(fitted).max(1) as f64;
        let squares = rows.iter().map(|row| row.difference.powi(2)).sum::<f64>();
        let squares = squares.max(WRITTEN * rows.len().max(1) as f64);
        let limit = best.cost + squares * (CHI_SQUARED / left).max(WORSE);
        let good = |other: &&Trial| other.cost <= limit && self.parted(best.place, other.place, limit);
        let found = minima.iter().filter(good).min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        Some(SecondMinimum {
            frequency: found.place[0],
            amplitude: found.place[1].exp(),
            // Equal ones differ by rounding.
            cost_ratio: 1.0 + (found.cost - best.cost).max(0.0) / squares,
            points: self.rows(found.place).len(),
            at_end: self.at_end(found.place).contains(&true),
        })
    }

    /// Whether somewhere between the shifts of two places no factor near theirs or between them keeps the sum
    /// of squares below a limit.
    fn parted(&self, one: Place, other: Place, limit: f64) -> bool {
        let [low, high] = self.tried[1];
        let near = [one[1].min(other[1]) - self.reach, one[1].max(other[1]) + self.reach];
        (1..BETWEEN).any(|k| {
            let shift = one[0] + k as f64 / BETWEEN as f64 * (other[0] - one[0]);
            self.best_between(shift, near.map(|x| x.clamp(low, high))).cost > limit
        })
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
