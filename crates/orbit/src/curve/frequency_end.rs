//! The end of the frequency range, which a curve over another parameter reaches between two of its points.
//!
//! The frequency `f` is one of the unknowns `[nodes; f; p]`. From the point of the chord at which it has
//! the value `F` of the end, Newton's method solves `R = 0` together with `f = F`: the border of the
//! matrix is the unit row of `f`.

use hammerbeam_path::{PathEvents, PathProblem};

use super::{
    row::{CurveEnd, CurveRow},
    walk::CurveWalk,
};

/// Most corrections.
const MOST: usize = 12;
/// A correction of this part of the way between the two points is none.
const DONE: f64 = 1e-9;
/// Largest residual of the last row.
const SOLVES: f64 = 1e-8;

impl CurveWalk {
    /// Whether the point that was just accepted lies outside the frequency range.
    pub(super) fn has_left_frequencies(&self) -> bool {
        let (low, high) = self.settings.range_hz;
        let place = self.problem.place(&self.follower.current().point);
        !(low..=high).contains(&place.frequency_hz)
    }

    /// The row at the end of the frequency range between `from` and the present point, which lies beyond
    /// it: the last of the curve. Where there is none, the curve has ended with the row before.
    pub(super) fn end_at_frequency(&mut self, from: &[f64]) -> Result<CurveRow, CurveEnd> {
        self.end = Some(CurveEnd::FrequencyRangeEnd);
        let beyond = self.follower.current().point.clone();
        self.point_at_frequency_end(from, &beyond)
            .and_then(|(point, error)| self.row_at(&point, PathEvents::default(), error).ok())
            .filter(|row| row.solution.residual <= SOLVES)
            .ok_or(CurveEnd::FrequencyRangeEnd)
    }

    /// The point between two others at the frequency of the range's end, with its last correction.
    fn point_at_frequency_end(&mut self, from: &[f64], beyond: &[f64]) -> Option<(Vec<f64>, f64)> {
        let index = self.problem.frequency_index();
        let (low, high) = self.settings.range_hz;
        let end = beyond[index].clamp(low, high);
        let share = (end - from[index]) / (beyond[index] - from[index]);
        let mut point: Vec<f64> = from.iter().zip(beyond).map(|(a, b)| a + share * (b - a)).collect();
        point[index] = end;
        let weights = self.problem.weights().to_vec();
        let length = |a: &mut dyn Iterator<Item = f64>| -> f64 {
            a.zip(&weights).map(|(d, w)| w * d * d).sum::<f64>().sqrt()
        };
        let way = length(&mut from.iter().zip(beyond).map(|(a, b)| b - a));
        let mut border = vec![0.0; point.len()];
        border[index] = 1.0;
        for _ in 0..MOST {
            self.problem.evaluate(&point).ok()?;
            self.problem.factorise(&border).ok()?;
            let mut correction: Vec<f64> = self.problem.residual().iter().map(|r| -r).collect();
            correction.push(0.0);
            self.problem.solve(&mut correction);
            let size = length(&mut correction.iter().copied());
            if size.is_nan() || size > way {
                return None;
            }
            point.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
            point[index] = end;
            if size <= DONE * way {
                return Some((point, size));
            }
        }
        None
    }
}
