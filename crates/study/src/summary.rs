//! What a results folder holds, branch by branch, in few numbers.

use std::collections::HashSet;

use hammerbeam_orbit::Stability;

use crate::store::{BranchRecord, JobKind, Row, Store, StoreError, start_of_key};

/// A branch in few numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchSummary {
    /// The branch and how its walks ended.
    pub record: BranchRecord,
    /// Number of solutions.
    pub solutions: u64,
    /// Number of those that are stable.
    pub stable: u64,
    /// Number of those of which that is not known, see [`Stability::Marginal`].
    pub marginal: u64,
    /// Lowest and highest frequency [Hz].
    pub range_hz: [f64; 2],
    /// Number of cyclic folds.
    pub folds: u64,
    /// Number of flips.
    pub flips: u64,
    /// Those at which the study does not ask for the branch of doubled period; 0 as long as the branch is not finished.
    pub flips_not_followed: u64,
    /// Number of Neimark-Sacker points.
    pub neimark_sackers: u64,
    /// Number of branch points.
    pub branch_points: u64,
    /// Number of grazings.
    pub grazings: u64,
    /// Peaks of the maximum displacement along the branch.
    pub peaks: Vec<Peak>,
}

/// A peak of the maximum displacement along a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Where [Hz].
    pub frequency_hz: f64,
    /// Maximum displacement [m].
    pub max_abs_displacement_m: f64,
    /// Whether the solution there is stable.
    pub stability: Stability,
}

/// Rise and fall, relative to the peak, that make it one.
const PROMINENCE: f64 = 0.05;

/// The branches of a results folder in few numbers.
///
/// # Errors
/// The store refuses.
pub fn summarise(store: &Store) -> Result<Vec<BranchSummary>, StoreError> {
    let _snapshot = store.snapshot()?;
    let jobs = store.jobs()?;
    let doublings = jobs.iter().filter(|job| job.kind == JobKind::Doubling);
    let followed: Vec<u32> = doublings.filter_map(|job| job.source).map(start_of_key).collect();
    // What the flips of a branch lead to is known once its job is finished.
    let finished: HashSet<u32> = jobs.iter().filter(|job| job.outcome.is_some()).map(|job| job.id).collect();
    let starts = store.starts()?.into_iter().filter(|start| finished.contains(&start.job));
    let concluded: HashSet<u32> = starts.map(|start| start.key).collect();
    let summarised = store.branches()?.into_iter().map(|branch| {
        let mut summary = summarise_branch(store, branch)?;
        let start = summary.record.start;
        if concluded.contains(&start) {
            let followed = followed.iter().filter(|&&of| of == start).count() as u64;
            summary.flips_not_followed = summary.flips.saturating_sub(followed);
        }
        Ok(summary)
    });
    summarised.collect()
}

fn summarise_branch(store: &Store, record: BranchRecord) -> Result<BranchSummary, StoreError> {
    let mut summary = BranchSummary {
        solutions: 0,
        stable: 0,
        marginal: 0,
        range_hz: [f64::INFINITY, f64::NEG_INFINITY],
        folds: 0,
        flips: 0,
        flips_not_followed: 0,
        neimark_sackers: 0,
        branch_points: 0,
        grazings: 0,
        peaks: Vec::new(),
        record: record.clone(),
    };
    let mut peaks = PeakFinder::default();
    store.each_row::<StoreError>(&record, |row| {
        summary.count(&row);
        peaks.add(&row);
        Ok(())
    })?;
    summary.peaks = peaks.found;
    Ok(summary)
}

impl BranchSummary {
    fn count(&mut self, row: &Row) {
        self.solutions += 1;
        self.stable += u64::from(row.stability == Stability::Stable);
        self.marginal += u64::from(row.stability == Stability::Marginal);
        self.range_hz[0] = self.range_hz[0].min(row.frequency_hz);
        self.range_hz[1] = self.range_hz[1].max(row.frequency_hz);
        self.folds += u64::from(row.events.fold);
        self.flips += u64::from(row.events.flip);
        self.neimark_sackers += u64::from(row.events.neimark_sacker);
        self.branch_points += u64::from(row.events.branch_point);
        self.grazings += u64::from(row.events.grazing);
    }
}

/// Finds peaks that rise above and fall below by [`PROMINENCE`], in one pass.
#[derive(Debug, Default)]
struct PeakFinder {
    found: Vec<Peak>,
    highest: Option<Peak>,
    lowest: Option<f64>,
    rising: bool,
}

impl PeakFinder {
    fn add(&mut self, row: &Row) {
        let value = row.maxima.displacement;
        let lowest = self.lowest.get_or_insert(value);
        *lowest = lowest.min(value);
        let rise = PROMINENCE * value.max(*lowest);
        if !self.rising && value - *lowest > rise {
            self.rising = true;
            self.highest = None;
        }
        if !self.rising {
            return;
        }
        let highest = self.highest.get_or_insert(Peak::of(row));
        if value >= highest.max_abs_displacement_m {
            *highest = Peak::of(row);
        } else if highest.max_abs_displacement_m - value > PROMINENCE * highest.max_abs_displacement_m {
            self.found.push(*highest);
            (self.rising, self.lowest) = (false, Some(value));
        }
    }
}

impl Peak {
    fn of(row: &Row) -> Self {
        Self {
            frequency_hz: row.frequency_hz,
            max_abs_displacement_m: row.maxima.displacement,
            stability: row.stability,
        }
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::{Events, OrbitMaxima};

    use super::*;

    fn row(frequency_hz: f64, displacement: f64) -> Row {
        Row {
            frequency_hz,
            maxima: OrbitMaxima { displacement, ..OrbitMaxima::default() },
            events: Events::default(),
            stability: Stability::Stable,
            leading_multiplier: [0.0, 0.0],
            residual: 0.0,
            error_estimate: 0.0,
        }
    }

    fn peaks(values: &[f64]) -> Vec<f64> {
        let mut finder = PeakFinder::default();
        values.iter().enumerate().for_each(|(index, value)| finder.add(&row(index as f64, *value)));
        finder.found.iter().map(|peak| peak.frequency_hz).collect()
    }

    #[test]
    fn peaks_are_found_and_ripples_are_not() {
        assert_eq!(peaks(&[1.0, 2.0, 3.0, 2.9, 3.1, 2.0, 1.0, 1.5, 1.2]), [4.0, 7.0]);
    }

    #[test]
    fn the_ends_of_a_branch_are_no_peaks() {
        assert_eq!(peaks(&[3.0, 2.0, 1.0]), [0.0; 0]);
        assert_eq!(peaks(&[1.0, 2.0, 3.0]), [0.0; 0]);
    }
}
