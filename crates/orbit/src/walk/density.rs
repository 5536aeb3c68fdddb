//! Rows dense enough to be joined by straight lines.
//!
//! A reader of a branch interpolates the maximum displacement `y` linearly over the frequency `f`. Both are
//! functions of the arc length `s`, smooth ones at a fold as well, where `y(f)` is like a square root. Over
//! the interval from row `a` to row `b`, `u` the share of its length h,
//!
//! `e(u) = y(u) - y_a - (y_b - y_a) (f(u) - f_a)/(f_b - f_a)`
//!
//! is the error. For `f(u)` the cubic Hermite polynomial is taken, whose slopes are the frequency components
//! of the tangents, and `y(u) = y_a + (y_b - y_a) u - D h^2 u (1 - u)` with the second divided differences
//! `D` of `y` here and one row earlier. The maximum over an orbit has kinks where another place of the orbit
//! takes over: a kink at the share `u` shows as a change `c` of the chord's slope that was not to be
//! expected, and makes an error of `u h c` at most.
//!
//! Where the sum may exceed [`ESTIMATED`], the orbit at the middle is solved and becomes a row. It gives the
//! true error there, which for one kink is at least half the largest one; above [`MEASURED`] both halves are
//! cut again.
//!
//! Errors are relative to `y`, or to a millionth of what it is at the size of the motion, if that is more:
//! the response may rest on a stop up to a place from which `y` grows like a power of the distance.
//!
//! The estimate rests on rows of the past alone, so rows come in order and a walk that is taken up again
//! inserts the same ones.

use hammerbeam_path::{ContinuationPoint, solve_between};

use super::{
    between::{Between, outside, show_hidden_events, spectrum_of},
    last_rows::RowPlace,
    orbit_path::OrbitPath,
    row::{RowRecord, row_at},
};
use crate::{BranchRow, OrbitError};

/// Estimated error, relative to `y`, from which on an interval is looked at.
const ESTIMATED: f64 = 5e-4;
/// Error in the middle, relative to `y`, from which on both halves are looked at.
const MEASURED: f64 = 4e-4;
/// Displacement to which errors are relative at least, over the displacement of the motion.
const LEAST: f64 = 1e-6;
/// An interval is halved so often at most.
const MOST_HALVINGS: u32 = 10;

impl RowRecord {
    /// Appends the rows that belong between the row before, at `from`, and `row`, at `to`, and then `row`
    /// itself.
    pub fn append_densely(
        &mut self,
        path: &mut OrbitPath,
        [from, to]: [&ContinuationPoint; 2],
        row: BranchRow,
        rows: &mut Vec<BranchRow>,
    ) -> Result<(), OrbitError> {
        let end = RowPlace::new(to, row.solution.maxima.displacement);
        let slopes = [from.tangent_parameter(), to.tangent_parameter()];
        let mut between = Vec::new();
        if self.last_rows.estimate(end, slopes, self.least_displacement(path)) > ESTIMATED {
            self.halve(path, [from, to], (end, MOST_HALVINGS), &mut between)?;
        }
        if path.settings.locates_stability_changes {
            between = show_hidden_events(self, path, from, (to, &row), between)?;
        }
        rows.extend(between.into_iter().map(|between| between.row));
        self.last_rows.push(end);
        rows.push(row);
        Ok(())
    }

    /// Appends the row of a corner and `row`, the present one, close behind it.
    pub fn append_behind_corner(
        &mut self,
        path: &OrbitPath,
        at_corner: BranchRow,
        row: BranchRow,
        rows: &mut Vec<BranchRow>,
    ) {
        let to = path.current();
        self.outside = Some(outside(&spectrum_of(&row.solution), to.events));
        self.last_rows.push(RowPlace::new(to, row.solution.maxima.displacement));
        rows.extend([at_corner, row]);
    }

    /// Displacement of the response to which errors are relative at least.
    fn least_displacement(&self, path: &OrbitPath) -> f64 {
        let displacements = self.shape.iter().zip(path.problem.scale().values());
        LEAST * displacements.map(|(shape, scale)| shape.abs() * scale).sum::<f64>()
    }

    /// Appends the middle of the interval, and what belongs into its halves; nothing if there is no orbit of
    /// the same arc.
    fn halve(
        &mut self,
        path: &mut OrbitPath,
        [from, to]: [&ContinuationPoint; 2],
        (end, halvings): (RowPlace, u32),
        rows: &mut Vec<Between>,
    ) -> Result<(), OrbitError> {
        let settings = path.settings_between();
        let Ok(point) = solve_between(&mut path.problem, [from, to], 0.5, &settings) else { return Ok(()) };
        self.evaluations_between += point.evaluations;
        let row = match row_at(path, &point) {
            Ok(row) => row,
            // Without its maxima or multipliers an orbit is no row; the walk itself goes on.
            Err(OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => return Ok(()),
            Err(error) => return Err(error),
        };
        let middle = RowPlace::new(&point, row.solution.maxima.displacement);
        let least = self.least_displacement(path);
        let is_missed = |&start: &RowPlace| missed(start, middle, end, least);
        let again = halvings > 0 && self.last_rows.0.last().is_some_and(is_missed);
        if again {
            self.halve(path, [from, &point], (middle, halvings - 1), rows)?;
        }
        self.last_rows.push(middle);
        rows.push(Between { point: point.clone(), row });
        if again {
            self.halve(path, [&point, to], (end, halvings - 1), rows)?;
        }
        Ok(())
    }
}

/// Whether the straight line from start to end misses the row between by too much; `least` is the
/// displacement to which that is relative at least.
fn missed(start: RowPlace, middle: RowPlace, end: RowPlace, least: f64) -> bool {
    let share = (middle.frequency_hz - start.frequency_hz) / (end.frequency_hz - start.frequency_hz);
    let line = start.displacement + share * (end.displacement - start.displacement);
    let error = (middle.displacement - line).abs();
    error.is_nan() || error > MEASURED * middle.displacement.max(least)
}
