//! A branch that starts at a branch point and comes back to its start passes that point once more, just
//! before it ends. It is one point: tables, summaries and figures have it at the start alone.

use hammerbeam_orbit::{BranchEventKind, EventSet};

use crate::row::Row;

/// How far the located point may be from the start, relative to the frequency. Both are located to some
/// 1e-12; other branch points of one branch are much farther apart.
const SAME_FREQUENCY: f64 = 1e-9;
/// The same relative to the displacement, which changes like the square root beside a branch point.
const SAME_DISPLACEMENT: f64 = 1e-3;

/// The branch point at which a closed branch starts.
#[derive(Debug, Default)]
pub(super) struct ClosedAt {
    is_closed: bool,
    start: Option<Row>,
}

impl ClosedAt {
    /// Of a branch whose rows are read from its first one on.
    ///
    /// * `is_closed`: whether it starts with its first row and ends there.
    pub fn of(is_closed: bool) -> Self {
        Self { is_closed, start: None }
    }

    /// What happens at the next row; the branch point of the start does not happen twice.
    pub fn events(&mut self, row: &Row, is_first: bool) -> EventSet {
        let is_branch_point = self.is_closed && row.events.has(BranchEventKind::BranchPoint);
        if is_branch_point && is_first {
            self.start = Some(*row);
        } else if is_branch_point && self.start.is_some_and(|start| is_same(&start, row)) {
            return row.events.without(BranchEventKind::BranchPoint);
        }
        row.events
    }
}

fn is_same(one: &Row, other: &Row) -> bool {
    let near = |a: f64, b: f64, share: f64| (a - b).abs() <= share * a.abs();
    near(one.parameter, other.parameter, SAME_FREQUENCY)
        && near(one.maxima.displacement, other.maxima.displacement, SAME_DISPLACEMENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch_point(parameter: f64, displacement: f64) -> Row {
        let mut row = Row {
            parameter,
            events: EventSet::default().with(BranchEventKind::BranchPoint),
            ..Row::default()
        };
        row.maxima.displacement = displacement;
        row
    }

    /// Frequencies and displacements of a run of a symmetric oscillator of Duffing.
    #[test]
    fn the_point_at_which_a_closed_branch_starts_happens_once() {
        let rows =
            [(0.137_302_460_674_888, 1.72), (0.169_858_346_613_087, 2.32), (0.137_302_460_673_380, 1.72)];
        let labels = |is_closed| {
            let mut closed = ClosedAt::of(is_closed);
            let rows = rows.iter().enumerate();
            rows.map(|(k, &(at, high))| closed.events(&branch_point(at, high), k == 0).label())
                .collect::<Vec<_>>()
        };
        assert_eq!(labels(true), ["branch-point", "branch-point", ""]);
        assert_eq!(labels(false), ["branch-point"; 3]);
        let mut closed = ClosedAt::of(true);
        let twice = [branch_point(0.137, 1.72), branch_point(0.137, 1.82)];
        assert!(twice.iter().enumerate().all(|(k, row)| closed.events(row, k == 0) == row.events));
    }
}
