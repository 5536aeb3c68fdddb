//! What low-pass filters leave of the maxima along the branches.
//!
//! Each orbit is taken over its period and multiplied, line by line, with the response of the filter (`hammerbeam_signal::filter::periodic_low_pass`): no transient. The unfiltered
//! maxima are those that are stored, exact on the continuous motion.

use std::sync::atomic::AtomicBool;

use hammerbeam_attractor::in_order;
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_signal::SignalError;

use super::RigError;
use crate::{
    Model, StoredBranches,
    comparison::{
        BranchCurve, CurvePoint, Curves, Filter,
        course::{Course, course, largest_behind},
        thinned,
    },
};

/// A solution behind filters.
#[derive(Debug, Clone, PartialEq)]
pub struct FilteredPoint {
    /// Row of the branch, from 1 on.
    pub row: usize,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Whether it is stable.
    pub stable: bool,
    /// Largest acceleration [m/s²],
    pub acceleration: f64,
    /// and behind each filter.
    pub filtered_acceleration: Vec<f64>,
    /// Largest displacement [m],
    pub displacement: f64,
    /// and behind each filter.
    pub filtered_displacement: Vec<f64>,
}

/// A branch behind filters.
#[derive(Debug, Clone, PartialEq)]
pub struct FilteredBranch {
    /// Its number.
    pub branch: u32,
    /// Its period multiple.
    pub period_multiple: u32,
    /// Solutions, end to end.
    pub points: Vec<FilteredPoint>,
}

/// By what factor a filter lowers maxima.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FilteredRatio {
    /// Number of solutions.
    pub solutions: usize,
    /// The largest ratio of the maximum without the filter to that behind it, and where [Hz].
    pub largest: (f64, f64),
    /// The smallest, and where [Hz].
    pub smallest: (f64, f64),
    /// The median.
    pub median: f64,
}

impl FilteredBranch {
    /// Ratios for a filter, of accelerations or displacements; of stable solutions alone, or of all.
    #[must_use]
    pub fn ratio(
        branches: &[&Self],
        filter: usize,
        of_displacement: bool,
        stable_alone: bool,
    ) -> FilteredRatio {
        let points = branches.iter().flat_map(|branch| &branch.points);
        let mut ratios: Vec<(f64, f64)> = points
            .filter(|point| point.stable || !stable_alone)
            .map(|point| {
                let (before, after) = if of_displacement {
                    (point.displacement, point.filtered_displacement[filter])
                } else {
                    (point.acceleration, point.filtered_acceleration[filter])
                };
                (before / after, point.frequency_hz)
            })
            .filter(|(ratio, _)| ratio.is_finite())
            .collect();
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        match ratios.as_slice() {
            [] => FilteredRatio::default(),
            [smallest, ..] => FilteredRatio {
                solutions: ratios.len(),
                largest: ratios[ratios.len() - 1],
                smallest: *smallest,
                median: median(&ratios),
            },
        }
    }
}

fn median(sorted: &[(f64, f64)]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len().is_multiple_of(2) {
        0.5 * (sorted[middle - 1].0 + sorted[middle].0)
    } else {
        sorted[middle].0
    }
}

/// Curves of the accelerations behind one of the filters.
#[must_use]
pub fn acceleration_curves(branches: &[FilteredBranch], filter: usize) -> Curves {
    let curve = |branch: &FilteredBranch| BranchCurve {
        branch: branch.branch,
        period_multiple: branch.period_multiple,
        points: branch
            .points
            .iter()
            .map(|point| CurvePoint {
                frequency_hz: point.frequency_hz,
                value: point.filtered_acceleration[filter],
                stable: point.stable,
                row: point.row,
            })
            .collect(),
    };
    Curves::new(branches.iter().map(curve).collect())
}

/// A stored solution that is gone over: index of its branch, row, whether it is stable.
type Item = (usize, usize, bool, PeriodicSolution);

/// Puts stored branches behind filters, at solutions that are some distance apart.
///
/// # Errors
/// [`RigError`].
pub fn filtered_branches(
    branches: &StoredBranches,
    model: &Model,
    filters: &[Filter],
    (spacing_hz, samples): (f64, usize),
    threads: usize,
    stop: &AtomicBool,
) -> Result<Vec<FilteredBranch>, RigError> {
    let mut items: Vec<Item> = Vec::new();
    let mut found = Vec::new();
    for (index, branch) in branches.branches().iter().enumerate() {
        for (row, placed) in thinned(branch, spacing_hz) {
            items.push((index, row + 1, placed.row.stable, branches.solution(branch, placed)?));
        }
        let record = &branch.record;
        let (branch, period_multiple) = (record.id, record.period_multiple);
        found.push(FilteredBranch { branch, period_multiple, points: Vec::new() });
    }
    let work = |(): &mut (), item: &Item| point(model, filters, samples, item);
    let points = in_order(&items, threads, stop, || (), work).ok_or(RigError::Interrupted)?;
    for (item, point) in items.iter().zip(points) {
        found[item.0].points.push(point?);
    }
    Ok(found)
}

fn point(
    model: &Model,
    filters: &[Filter],
    samples: usize,
    (_, row, stable, orbit): &Item,
) -> Result<FilteredPoint, RigError> {
    // A motion that cannot be gone over leaves a gap.
    let course = course(model, orbit, samples).ok();
    let behind = |of: fn(&Course) -> &Vec<f64>| -> Result<Vec<f64>, SignalError> {
        let largest = |filter: &Filter| match &course {
            Some(course) => Ok(largest_behind(of(course), course.duration_s, *filter)?.0),
            None => Ok(f64::NAN),
        };
        filters.iter().map(largest).collect()
    };
    Ok(FilteredPoint {
        row: *row,
        frequency_hz: orbit.frequency_hz,
        stable: *stable,
        acceleration: orbit.maxima.acceleration,
        filtered_acceleration: behind(|course| &course.acceleration)?,
        displacement: orbit.maxima.displacement,
        filtered_displacement: behind(|course| &course.displacement)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_told_with_their_places() {
        let point = |frequency_hz: f64, acceleration: f64, stable: bool| FilteredPoint {
            row: 1,
            frequency_hz,
            stable,
            acceleration,
            filtered_acceleration: vec![1.0],
            displacement: 2.0,
            filtered_displacement: vec![1.0],
        };
        let points = vec![
            point(30.0, 4.0, true),
            point(31.0, 2.0, true),
            point(32.0, 9.0, false),
            point(33.0, 3.0, true),
        ];
        let branch = FilteredBranch { branch: 1, period_multiple: 1, points };
        let stable = FilteredBranch::ratio(&[&branch], 0, false, true);
        assert_eq!((stable.solutions, stable.median), (3, 3.0));
        assert_eq!((stable.largest, stable.smallest), ((4.0, 30.0), (2.0, 31.0)));
        let all = FilteredBranch::ratio(&[&branch], 0, false, false);
        assert_eq!((all.largest, all.median), ((9.0, 32.0), 3.5));
        assert_eq!(FilteredBranch::ratio(&[&branch], 0, true, true).median, 2.0);
        assert_eq!(FilteredBranch::ratio(&[], 0, true, true), FilteredRatio::default());
    }
}
