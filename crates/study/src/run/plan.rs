//! Where a run looks for branches.

use crate::file::Study;

/// The searches of a run, in the order in which they are made.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The searches.
    pub targets: Vec<Target>,
    /// Range of the excitation frequency [Hz].
    pub range_hz: [f64; 2],
    /// Largest number of solutions of a walk.
    pub budget: u64,
}

/// A search for a start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Where [Hz].
    pub frequency_hz: f64,
    /// The search is left out if a branch of this multiple already passes this frequency.
    pub only_if_not_covered: bool,
}

/// Frequencies, as parts of the range from its upper end, at which harmonic starts are sought one after the other
/// where no harmonic branch passes yet.
const HARMONIC: [f64; 9] = [0.0, 1.0, 0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875];

/// Number of equal parts of the range in whose middles subharmonic starts are sought.
const SUBHARMONIC_PARTS: u32 = 8;

impl Plan {
    /// The plan of a study: harmonic branches that together span the range, every subharmonic branch that is met.
    #[must_use]
    pub fn of(study: &Study) -> Self {
        let range_hz = study.excitation.frequency_hz;
        let targets =
            study.response.period_multiples.iter().flat_map(|&multiple| targets(multiple, range_hz));
        Self { targets: targets.collect(), range_hz, budget: study.continuation.budget_solutions as u64 }
    }
}

fn targets(period_multiple: u32, [low, high]: [f64; 2]) -> Vec<Target> {
    let at = |part: f64, only_if_not_covered| Target {
        period_multiple,
        frequency_hz: (high + part * (low - high)).clamp(low, high),
        only_if_not_covered,
    };
    if period_multiple == 1 {
        return HARMONIC.iter().map(|&part| at(part, true)).collect();
    }
    let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(SUBHARMONIC_PARTS);
    (0..SUBHARMONIC_PARTS).map(|index| at(middle(index), false)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_harmonic_branch_is_sought_at_the_upper_end_first() {
        let targets = targets(1, [19.0, 110.0]);
        let frequencies: Vec<f64> = targets.iter().map(|target| target.frequency_hz).collect();
        assert_eq!(frequencies[..5], [110.0, 19.0, 64.5, 87.25, 41.75]);
    }

    #[test]
    fn subharmonic_branches_are_sought_over_the_whole_range_within_its_ends() {
        let targets = targets(3, [1.0, 9.0]);
        assert_eq!(targets.len(), 8);
        assert_eq!((targets[0].frequency_hz, targets[7].frequency_hz), (8.5, 1.5));
        assert!(targets.iter().all(|target| !target.only_if_not_covered));
    }
}
