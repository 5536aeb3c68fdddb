//! Whether a solution lies on a branch that is already there.

use hammerbeam_orbit::PeriodicSolution;

use crate::store::{BranchRecord, Row, Store, StoreError};

/// Relative difference of maxima up to which two solutions are taken for the same.
///
/// Maxima over a whole orbit do not depend on its phase, so that an orbit of period N, which appears in N shifted
/// forms, is recognised in each of them. Mirror images of a symmetric system are recognised as well.
const SAME: f64 = 1e-2;

/// Number of the branch on which the solution lies, if it lies on one of the same period.
pub(super) fn branch_of(store: &Store, solution: &PeriodicSolution) -> Result<Option<u32>, StoreError> {
    for branch in store.branches()? {
        if branch.period_multiple == solution.period_multiple && lies_on(store, &branch, solution)? {
            return Ok(Some(branch.id));
        }
    }
    Ok(None)
}

fn lies_on(store: &Store, branch: &BranchRecord, solution: &PeriodicSolution) -> Result<bool, StoreError> {
    let mut last: Option<Row> = None;
    let mut found = false;
    store.each_row::<StoreError>(branch, |row| {
        if let Some(last) = last.replace(row) {
            found |= between(&last, &row, solution);
        }
        Ok(())
    })?;
    Ok(found)
}

/// Whether the solution agrees with two neighbours on a branch, interpolated to its frequency.
fn between(first: &Row, second: &Row, solution: &PeriodicSolution) -> bool {
    let (from, to) = (first.frequency_hz, second.frequency_hz);
    let frequency = solution.frequency_hz;
    if (frequency - from) * (frequency - to) > 0.0 {
        return false;
    }
    let part = if to == from { 0.0 } else { (frequency - from) / (to - from) };
    let agrees = |of: fn(&hammerbeam_orbit::OrbitMaxima) -> f64| {
        let there = of(&first.maxima) + part * (of(&second.maxima) - of(&first.maxima));
        (of(&solution.maxima) - there).abs() <= SAME * there.abs()
    };
    agrees(|maxima| maxima.displacement) && agrees(|maxima| maxima.acceleration)
}
