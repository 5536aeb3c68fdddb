//! What low-pass filters leave of the maxima along the branches.
//!
//! Each orbit is taken over its period and multiplied, line by line, with the response of the filter
//! (`hammerbeam_signal::filter::periodic_low_pass`): no transient. The unfiltered maxima are those that are
//! stored, exact on the continuous motion. An orbit whose motion cannot be gone over again leaves a gap and
//! is counted; it is an error only if none can.

use hammerbeam_attractor::InOrder;
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::Model;

use super::RigError;
use crate::{
    Observer, PooledOrder, StoredBranches,
    comparison::{
        BranchCurve, CurvePoint, Curves, Filter,
        history::{MotionHistory, Sampled, history, largest_behind, sampled},
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
    /// and behind each filter; no number in a gap.
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

/// Branches behind filters.
#[derive(Debug, Clone, PartialEq)]
pub struct Filtered {
    /// The branches.
    pub branches: Vec<FilteredBranch>,
    /// Solutions that could not be gone over.
    pub gaps: usize,
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
    observer: &mut dyn Observer,
) -> Result<Filtered, RigError> {
    let mut items: Vec<Item> = Vec::new();
    let mut found = Vec::new();
    for (index, branch) in branches.branches().iter().enumerate() {
        for (row, placed) in thinned(branch, spacing_hz) {
            items.push((
                index,
                row + 1,
                placed.row.stability.may_be_stable(),
                branches.solution(branch, placed)?,
            ));
        }
        let record = &branch.record;
        let (branch, period_multiple) = (record.id, record.period_multiple);
        found.push(FilteredBranch { branch, period_multiple, points: Vec::new() });
    }
    let gaps = fill(&mut found, &items, (model, filters, samples), (threads, observer))?;
    Ok(Filtered { branches: found, gaps })
}

/// Puts solutions behind filters and into their branches.
///
/// # Returns
/// How many could not be gone over.
fn fill(
    found: &mut [FilteredBranch],
    items: &[Item],
    (model, filters, samples): (&Model, &[Filter], usize),
    (threads, observer): (usize, &mut dyn Observer),
) -> Result<usize, RigError> {
    let work = |(): &mut (), (_, _, _, orbit): &Item| maxima(model, filters, samples, orbit);
    let tried = PooledOrder::new(threads, observer).in_order(items, &|| (), &work);
    let tried = tried.ok_or(RigError::Interrupted)?;
    let (maxima, gaps) = sampled(tried)?;
    for (item, maxima) in items.iter().zip(maxima) {
        found[item.0].points.push(point(item, maxima.unwrap_or_else(|| Maxima::gap(filters.len()))));
    }
    Ok(gaps)
}

/// Maxima behind each filter.
struct Maxima {
    acceleration: Vec<f64>,
    displacement: Vec<f64>,
}

impl Maxima {
    fn gap(filters: usize) -> Self {
        Self { acceleration: vec![f64::NAN; filters], displacement: vec![f64::NAN; filters] }
    }
}

fn maxima(
    model: &Model,
    filters: &[Filter],
    samples: usize,
    orbit: &PeriodicSolution,
) -> Sampled<Maxima, RigError> {
    let history = match history(model, orbit, samples) {
        Ok(history) => history,
        Err(reason) => return Ok(Err(reason)),
    };
    let behind = |of: fn(&MotionHistory) -> &Vec<f64>| -> Result<Vec<f64>, RigError> {
        let largest = |filter: &Filter| Ok(largest_behind(of(&history), history.duration_s, *filter)?.0);
        filters.iter().map(largest).collect()
    };
    Ok(Ok(Maxima {
        acceleration: behind(|history| &history.acceleration)?,
        displacement: behind(|history| &history.displacement)?,
    }))
}

fn point((_, row, stable, orbit): &Item, behind: Maxima) -> FilteredPoint {
    FilteredPoint {
        row: *row,
        frequency_hz: orbit.frequency_hz,
        stable: *stable,
        acceleration: orbit.maxima.acceleration,
        filtered_acceleration: behind.acceleration,
        displacement: orbit.maxima.displacement,
        filtered_displacement: behind.displacement,
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::OrbitMaxima;

    use super::*;
    use crate::Quiet;
    use hammerbeam_study::StudyFile;

    const BEAM: &str = include_str!("../../../../studies/beam-with-stop.toml");

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
    /// A motion of the paper's beam from rest, and orbits that have no state to begin with.
    #[test]
    fn orbits_that_cannot_be_gone_over_are_gaps_and_none_at_all_is_refused() {
        let file = StudyFile::parse("study.toml", BEAM.to_owned()).unwrap();
        let model = Model::build(&file).unwrap();
        let orbit = |nodes: Vec<Vec<f64>>| PeriodicSolution {
            frequency_hz: 30.0,
            period_multiple: 1,
            phase: 0.0,
            nodes,
            floquet_multipliers: Vec::new(),
            on_circle: Vec::new(),
            residual: 0.0,
            error_estimate: 0.0,
            maxima: OrbitMaxima { acceleration: 2.0, displacement: 1.0, ..OrbitMaxima::default() },
        };
        let filters = [Filter { order: 2, cut_off_hz: 850.0 }];
        let filled = |orbits: Vec<PeriodicSolution>| {
            let mut found = [FilteredBranch { branch: 1, period_multiple: 1, points: Vec::new() }];
            let item = |(row, orbit)| (0, row + 1, true, orbit);
            let items: Vec<Item> = orbits.into_iter().enumerate().map(item).collect();
            let gaps = fill(&mut found, &items, (&model, &filters, 64), (1, &mut Quiet))?;
            let [branch] = found;
            Ok::<_, RigError>((branch, gaps))
        };
        let lost = || orbit(Vec::new());
        let (branch, gaps) = filled(vec![lost(), orbit(vec![vec![0.0; 2 * model.system.dof()]])]).unwrap();
        assert_eq!((gaps, branch.points.len()), (1, 2));
        let maxima: Vec<f64> = branch.points.iter().map(|point| point.filtered_displacement[0]).collect();
        assert!(maxima[0].is_nan() && maxima[1] > 0.0, "{maxima:?}");
        assert_eq!(branch.points[0].displacement, 1.0);
        let curves = acceleration_curves(std::slice::from_ref(&branch), 0);
        assert_eq!((curves.gaps(), FilteredBranch::ratio(&[&branch], 0, true, true).solutions), (1, 1));
        assert_eq!(filled(Vec::new()).unwrap().1, 0);
        let refused = filled(vec![lost(), lost()]).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "none of 2 orbits can be gone over; the first: the orbit has no state at phase 0"
        );
    }
}
