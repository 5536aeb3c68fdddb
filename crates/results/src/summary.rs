//! What a results folder holds, branch by branch, in few numbers.

use std::collections::{BTreeMap, HashSet};

use hammerbeam_orbit::{BranchEventKind, EventSet, Stability};

use crate::{
    row::Row,
    store::{BranchRecord, JobKind, PieceRecord, Store, StoreError, start_of_key},
};

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
    /// Lowest and highest value of what varies, in the unit of its name; the frequency [Hz] where it is that.
    pub range: [f64; 2],
    /// What happens on it, and how often.
    pub events: EventCounts,
    /// Flips at which the study does not ask for the branch of doubled period; 0 as long as the branch is not
    /// finished.
    pub flips_not_followed: u64,
    /// Peaks of the maximum displacement along the branch.
    pub peaks: Vec<Peak>,
}

/// How often each kind of event happens.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EventCounts(BTreeMap<BranchEventKind, u64>);

impl EventCounts {
    /// How often this happens.
    #[must_use]
    pub fn of(&self, kind: BranchEventKind) -> u64 {
        self.0.get(&kind).copied().unwrap_or(0)
    }

    /// What happens, by its name in tables, in the order of the names.
    #[must_use]
    pub fn by_name(&self) -> BTreeMap<&'static str, u64> {
        let mut names = BTreeMap::new();
        self.0.iter().for_each(|(kind, count)| *names.entry(kind.name()).or_default() += count);
        names
    }

    fn add(&mut self, events: EventSet) {
        events.kinds().for_each(|kind| *self.0.entry(kind).or_default() += 1);
    }
}

/// A piece of the study with its branches in few numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceSummary {
    /// The piece.
    pub record: PieceRecord,
    /// Its branches.
    pub branches: Vec<BranchSummary>,
}

/// A peak of the maximum displacement along a branch: the highest solution between a rise and a fall, or all
/// those that are as high as far as displacements are known, as where a motion reaches a rigid stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Where the first of the highest solutions is, in the order of the branch [Hz].
    pub frequency_hz: f64,
    /// Lowest and highest frequency of the highest solutions, which are equal; the same twice where there is
    /// but one [Hz].
    pub equal_hz: [f64; 2],
    /// Number of the highest solutions.
    pub equal: u64,
    /// Maximum displacement [m].
    pub max_abs_displacement_m: f64,
    /// How much higher the branch may be between this solution and those beside it [m].
    pub higher_between_m: f64,
    /// Whether the solutions there are stable; `None` where some are and others are not.
    pub stability: Option<Stability>,
}

/// Rise and fall, relative to the peak, that make it one.
const PROMINENCE: f64 = 0.05;

/// How much higher a branch may be beside its highest solution, in parts of the larger fall to its
/// neighbours: 1/8 on a parabola with equal steps, 1/3 where one step is twice the other.
const BETWEEN: f64 = 0.5;

/// Displacements are equal up to this part of them: orbits are computed to 1e-10 of their size.
const EQUAL: f64 = 1e-10;

/// Displacements below this part of the largest one of the branch are zero but for rounding: a hundred times
/// [`EQUAL`], since elsewhere the structure may move so much farther than at the point.
const ZERO: f64 = 1e-8;

/// Branches over other parameters, and curves, in few numbers.
///
/// # Errors
/// The store refuses.
pub fn summarise_pieces(store: &Store) -> Result<Vec<PieceSummary>, StoreError> {
    let _snapshot = store.snapshot()?;
    let summarised = store.pieces()?.into_iter().map(|record| {
        let branches = record.branches.iter().map(|branch| summarise_branch(store, branch.clone()));
        Ok(PieceSummary { branches: branches.collect::<Result<_, StoreError>>()?, record })
    });
    summarised.collect()
}

/// The branches over the frequency of a results folder in few numbers.
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
    let starts = store.starts()?.into_iter().filter(|start| finished.contains(&start.job()));
    let concluded: HashSet<u32> = starts.map(|start| start.key).collect();
    let summarised = store.branches()?.into_iter().map(|branch| {
        let mut summary = summarise_branch(store, branch)?;
        let start = summary.record.start;
        if concluded.contains(&start) {
            let followed = followed.iter().filter(|&&of| of == start).count() as u64;
            let flips = summary.events.of(BranchEventKind::Flip);
            summary.flips_not_followed = flips.saturating_sub(followed);
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
        range: [f64::INFINITY, f64::NEG_INFINITY],
        events: EventCounts::default(),
        flips_not_followed: 0,
        peaks: Vec::new(),
        record: record.clone(),
    };
    let mut peaks = PeakFinder::default();
    store.each_row::<StoreError>(&record, |row| {
        summary.count(&row);
        peaks.add(&row);
        Ok(())
    })?;
    summary.peaks = peaks.finish();
    Ok(summary)
}

impl BranchSummary {
    fn count(&mut self, row: &Row) {
        self.solutions += 1;
        self.stable += u64::from(row.stability == Stability::Stable);
        self.marginal += u64::from(row.stability == Stability::Marginal);
        let [low, high] = self.range;
        self.range = [low.min(row.parameter), high.max(row.parameter)];
        self.events.add(row.events);
    }
}

/// Finds peaks that rise above and fall below by [`PROMINENCE`], in one pass.
#[derive(Debug, Default)]
struct PeakFinder {
    found: Vec<Peak>,
    highest: Option<Peak>,
    lowest: Option<f64>,
    /// Height of the last solution that is no event, since these may lie close to others.
    before: Option<f64>,
    /// Whether such a solution came after the highest one.
    followed: bool,
    rising: bool,
    largest: f64,
}

impl PeakFinder {
    /// The peaks, without those of rounding: where the point rests on a rigid stop, its displacement is zero
    /// but for that.
    fn finish(mut self) -> Vec<Peak> {
        self.found.retain(|peak| peak.max_abs_displacement_m > ZERO * self.largest);
        self.found
    }

    fn add(&mut self, row: &Row) {
        self.add_height(row);
        if row.events == EventSet::default() {
            self.before = Some(row.maxima.displacement);
        }
    }

    fn add_height(&mut self, row: &Row) {
        let value = row.maxima.displacement;
        self.largest = self.largest.max(value);
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
        let height = self.highest.map_or(f64::NEG_INFINITY, |peak| peak.max_abs_displacement_m);
        let Some(highest) = self.highest.as_mut().filter(|_| value <= height * (1.0 + EQUAL)) else {
            self.highest = Some(Peak::of(row, self.before));
            self.followed = false;
            return;
        };
        if value >= height * (1.0 - EQUAL) {
            highest.join(row);
            return;
        }
        if highest.equal <= 2 && !self.followed && row.events == EventSet::default() {
            highest.higher_between_m = highest.higher_between_m.max(BETWEEN * (height - value));
            self.followed = true;
        }
        if height - value > PROMINENCE * height {
            self.found.push(*highest);
            (self.rising, self.lowest) = (false, Some(value));
        }
    }
}

impl Peak {
    /// The peak of one solution, behind another of the height `before` [m] if there is one.
    fn of(row: &Row, before: Option<f64>) -> Self {
        let height = row.maxima.displacement;
        let rise = height - before.unwrap_or(height);
        Self {
            frequency_hz: row.frequency_hz,
            equal_hz: [row.frequency_hz; 2],
            equal: 1,
            max_abs_displacement_m: height,
            higher_between_m: BETWEEN * rise.max(0.0),
            stability: Some(row.stability),
        }
    }

    /// Takes in a solution that is as high. Two may stand on either side of the top; of three, the branch is
    /// level there.
    fn join(&mut self, row: &Row) {
        if self.equal > 1 {
            self.higher_between_m = 0.0;
        }
        let [low, high] = self.equal_hz;
        self.equal_hz = [low.min(row.frequency_hz), high.max(row.frequency_hz)];
        self.equal += 1;
        self.stability = self.stability.filter(|stability| *stability == row.stability);
    }

    /// Whether two peaks are as high as one another, as far as their solutions tell: those of a motion and of
    /// its mirror image are stored at different places.
    #[must_use]
    pub fn equals(&self, other: &Self) -> bool {
        let [one, two] = [self, other].map(|peak| peak.max_abs_displacement_m);
        (one - two).abs() <= EQUAL * one.max(two) + self.higher_between_m + other.higher_between_m
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::OrbitMaxima;

    use super::*;

    fn row(frequency_hz: f64, displacement: f64) -> Row {
        Row {
            parameter: frequency_hz,
            frequency_hz,
            maxima: OrbitMaxima { displacement, ..OrbitMaxima::default() },
            stability: Stability::Stable,
            ..Row::default()
        }
    }

    fn peaks(values: &[f64]) -> Vec<f64> {
        let mut finder = PeakFinder::default();
        values.iter().enumerate().for_each(|(index, value)| finder.add(&row(index as f64, *value)));
        finder.finish().iter().map(|peak| peak.frequency_hz).collect()
    }

    #[test]
    fn what_rounding_makes_of_a_point_at_rest_is_no_peak() {
        assert_eq!(peaks(&[0.0, 8e-15, 0.0, 4e-15, 2e-15, 3e-3, 1e-3]), [5.0]);
        assert_eq!(peaks(&[0.0, 3e-12, 0.0, 3e-10, 0.0, 3e-3, 1e-3]), [3.0, 5.0]);
    }

    #[test]
    fn peaks_are_found_and_ripples_are_not() {
        assert_eq!(peaks(&[1.0, 2.0, 3.0, 2.9, 3.1, 2.0, 1.0, 1.5, 1.2]), [4.0, 7.0]);
    }

    /// What a rigid stop makes of a resonance: its gap, but for rounding.
    #[test]
    fn solutions_that_are_equally_high_are_one_peak_that_names_them_all() {
        let mut finder = PeakFinder::default();
        let heights = [1.0, 6.0, 6.0 + 1e-15, 5.9, 6.0 - 1e-15, 6.0 + 5e-15, 3.0];
        heights.iter().enumerate().for_each(|(index, value)| finder.add(&row(index as f64, *value)));
        let [peak] = finder.found[..] else { panic!("{:?}", finder.found) };
        assert_eq!((peak.frequency_hz, peak.equal_hz, peak.equal), (1.0, [1.0, 5.0], 4));
        assert_eq!(peak.stability, Some(Stability::Stable));
    }

    #[test]
    fn a_plateau_of_stable_and_unstable_solutions_is_called_neither() {
        let mut finder = PeakFinder::default();
        for (index, value) in [1.0, 2.0, 2.0, 1.0].into_iter().enumerate() {
            let stability = if index == 1 { Stability::Unstable } else { Stability::Stable };
            finder.add(&Row { stability, ..row(index as f64, value) });
        }
        assert_eq!(finder.found[0].stability, None);
    }

    #[test]
    fn what_is_higher_by_more_than_rounding_is_the_peak_alone() {
        let mut finder = PeakFinder::default();
        let heights = [1.0, 2.0, 2.0 + 1e-9, 1.0];
        heights.iter().enumerate().for_each(|(index, value)| finder.add(&row(index as f64, *value)));
        assert_eq!((finder.found[0].equal_hz, finder.found[0].equal), ([2.0; 2], 1));
    }

    /// One and the same parabola, stored at steps that lie differently, with an event beside a solution.
    #[test]
    fn peaks_of_equal_height_at_different_places_are_equal_and_others_are_not() {
        let peak = |height: f64, first: f64, ratio: f64| {
            let mut finder = PeakFinder::default();
            let mut place = first;
            for number in 0..60 {
                finder.add(&row(place, height - 0.1 * (place - 4.0).powi(2)));
                let beside =
                    Row { events: EventSet::default().with(BranchEventKind::Grazing), ..row(place, 0.0) };
                let displacement = height - 0.1 * (place + 1e-6 - 4.0).powi(2);
                finder.add(&Row { maxima: OrbitMaxima { displacement, ..beside.maxima }, ..beside });
                place += if number % 2 == 0 { 0.1 } else { 0.1 * ratio };
            }
            let [peak] = finder.finish()[..] else { panic!("not one peak") };
            peak
        };
        for ratio in [1.0, 1.5, 2.0] {
            for offset in 0..20 {
                let other = peak(2.0, 0.01 * f64::from(offset), ratio);
                assert!(peak(2.0, 0.0, 1.0).equals(&other), "{ratio}, {offset}");
                assert!(!peak(2.01, 0.0, 1.0).equals(&other), "{ratio}, {offset}");
            }
        }
    }

    #[test]
    fn the_ends_of_a_branch_are_no_peaks() {
        assert_eq!(peaks(&[3.0, 2.0, 1.0]), [0.0; 0]);
        assert_eq!(peaks(&[1.0, 2.0, 3.0]), [0.0; 0]);
    }
}
