//! A special point of stored branches, where branches of another study can begin: the same structure with
//! changed parameters, say.
//!
//! Special points are numbered from 1 along the branches over the frequency, in their order: every solution
//! with a fold, a flip, a Neimark-Sacker point, a branch point or a grazing. The page shows these numbers.
//!
//! At the point itself Newton's method finds little: a multiplier is on the unit circle there. With changed
//! parameters the point has moved, and what was on one side of it may be on the other. So orbits near by on
//! its branch are tried as well, on both sides, farther and farther away.

use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{BranchEventKind, states_at_phase};
use hammerbeam_results::{Store, StoreError, row::Row, store::BranchRecord};

use crate::settled::SettledState;

/// Distances from the point along its branch at which orbits are tried [solutions].
const DISTANCES: [isize; 9] = [0, 1, -1, 4, -4, 16, -16, 64, -64];

/// What is near a special point.
#[derive(Debug, Clone, PartialEq)]
pub enum NearPoint {
    /// States of orbits at phase 0, those nearest to the point first.
    States(Vec<SettledState>),
    /// There is no point of that number.
    Missing {
        /// How many there are.
        count: u32,
    },
}

/// Orbits at and near a special point.
///
/// * `system`: that of the stored results.
/// * `number`: of the point, from 1.
///
/// # Errors
/// The store refuses, or a solution is damaged.
pub fn near_point(store: &Store, system: &System, number: u32) -> Result<NearPoint, StoreError> {
    let (branch, place) = match find(store, number)? {
        Ok(found) => found,
        Err(count) => return Ok(NearPoint::Missing { count }),
    };
    let places: Vec<_> = branch.places().collect();
    let mut states = Vec::new();
    for distance in DISTANCES {
        let near = place.checked_add_signed(distance).and_then(|place| places.get(place));
        let Some((side, of_side)) = near.copied() else { continue };
        let orbit = store.solution(branch.start, side, of_side)?;
        // One that cannot be computed again is no place to begin at.
        let Ok(mut integrator) = ExactIntegrator::new(system.clone(), ExactSettings::default()) else {
            continue;
        };
        let Ok(found) = states_at_phase(&mut integrator, &orbit, 0.0) else { continue };
        let (frequency_hz, period_multiple) = (orbit.frequency_hz, orbit.period_multiple);
        let first = found.into_iter().next();
        states.extend(first.map(|state| SettledState { frequency_hz, period_multiple, state }));
    }
    Ok(NearPoint::States(states))
}

/// The branch of a special point and the number of its solution, from the lower end on; without such a point
/// how many there are.
fn find(store: &Store, number: u32) -> Result<Result<(BranchRecord, usize), u32>, StoreError> {
    let mut count = 0;
    for branch in store.branches()? {
        let (mut place, mut found) = (0, None);
        store.each_row::<StoreError>(&branch, |row| {
            if is_special(&row) {
                count += 1;
                if count == number {
                    found = Some(place);
                }
            }
            place += 1;
            Ok(())
        })?;
        if let Some(place) = found {
            return Ok(Ok((branch, place)));
        }
    }
    Ok(Err(count))
}

fn is_special(row: &Row) -> bool {
    row.events.is_bifurcation() || row.events.has(BranchEventKind::Grazing)
}
