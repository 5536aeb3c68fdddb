//! The orbits that are tried.

use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::{StoreError, store::BranchRecord};
use hammerbeam_study::Model;

use super::settings::{OverlaySettings, Sought};
use crate::{StoredBranches, comparison::thinned};

/// Distance of orbits that are tried, as a part of the frequency.
pub(super) const SPACING: f64 = 1e-3;

/// Branch, row and orbit.
pub(super) type Candidate = (u32, Option<usize>, PeriodicSolution);

/// The stable orbits of a period that are sought.
pub(super) fn sought(
    model: &Model,
    branches: &StoredBranches,
    period_multiple: u32,
    settings: &OverlaySettings,
) -> Result<Vec<Candidate>, StoreError> {
    let wanted = |record: &BranchRecord| {
        record.period_multiple == period_multiple && settings.branch.is_none_or(|branch| branch == record.id)
    };
    match settings.sought {
        Sought::Near { frequency_hz, part } => stored(branches, wanted, frequency_hz, part),
        Sought::At(frequency_hz) => at(model, branches, wanted, frequency_hz),
    }
}

fn stored(
    branches: &StoredBranches,
    wanted: impl Fn(&BranchRecord) -> bool,
    frequency_hz: f64,
    part: f64,
) -> Result<Vec<Candidate>, StoreError> {
    let mut orbits = Vec::new();
    for branch in branches.branches().iter().filter(|branch| wanted(&branch.record)) {
        for (index, placed) in thinned(branch, SPACING * frequency_hz) {
            let near = (placed.row.frequency_hz - frequency_hz).abs() <= part * frequency_hz;
            if near && placed.row.stability.may_be_stable() {
                orbits.push((branch.record.id, Some(index + 1), branches.solution(branch, placed)?));
            }
        }
    }
    Ok(orbits)
}

fn at(
    model: &Model,
    branches: &StoredBranches,
    wanted: impl Fn(&BranchRecord) -> bool,
    frequency_hz: f64,
) -> Result<Vec<Candidate>, StoreError> {
    let found = branches.crossings(model, frequency_hz, wanted)?.into_iter();
    let stable = found.filter(|(_, orbit)| orbit.may_be_stable());
    Ok(stable.map(|(branch, orbit)| (branch, None, orbit)).collect())
}
