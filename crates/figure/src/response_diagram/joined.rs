//! Coinciding events of a panel have one mark.
//!
//! At each flip a branch of twice the period bifurcates, whose first row is a branch point at the same place:
//! the mark of the flip represents both. A fold that is the corner of a branch at a grazing has a mark of its
//! own instead of two overlapping marks. Events of other kinds keep their marks, since their coincidence is a
//! result.

use crate::marks::Mark;

/// Where an event is, by frequency and value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EventPlace {
    pub(super) x: f64,
    pub(super) y: f64,
    /// Whether a solution beside it is stable.
    pub(super) of_stable: bool,
}

/// Places count as one if they are no further apart than this, in lengths of the axes: the same event is
/// located on both branches to far less, and others are that near by chance only.
const ONE_PLACE: f64 = 1e-5;

/// Events of a panel by their marks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JoinedEvents {
    /// Places of each mark that has some, in the order of [`Mark::ALL`], and how many events of that kind
    /// there are, those with another mark included.
    pub(super) events: Vec<(Mark, Vec<EventPlace>, usize)>,
    /// Branch points that have the mark of a flip.
    pub(super) branches_at_flips: usize,
}

/// Joins coinciding events.
///
/// * `events`: of each kind, along the branches.
/// * `shares`: position of an event, in lengths of the axes.
pub(super) fn join(
    events: &[(Mark, Vec<EventPlace>)],
    shares: impl Fn(EventPlace) -> (f64, f64),
) -> JoinedEvents {
    let of = |mark: Mark| {
        events.iter().filter(move |(kind, _)| *kind == mark).flat_map(|(_, places)| places.iter().copied())
    };
    let near = |marks: &[Mark]| {
        let mut places: Vec<(f64, f64)> = marks.iter().flat_map(|&mark| of(mark)).map(&shares).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        places
    };
    let flips = near(&[Mark::Flip]);
    let (folds, grazings) = (near(&[Mark::Fold]), near(&[Mark::Grazing]));
    let places = |mark: Mark| -> Vec<EventPlace> {
        match mark {
            Mark::BranchPoint => of(mark).filter(|&place| !is_near(&flips, shares(place))).collect(),
            Mark::Fold => of(mark).filter(|&place| !is_near(&grazings, shares(place))).collect(),
            Mark::Grazing => of(mark).filter(|&place| !is_near(&folds, shares(place))).collect(),
            Mark::FoldAtGrazing => {
                of(Mark::Fold).filter(|&place| is_near(&grazings, shares(place))).collect()
            }
            Mark::Flip | Mark::NeimarkSacker | Mark::OfUnstable => of(mark).collect(),
        }
    };
    let joined = Mark::ALL.map(|mark| {
        let places = places(mark);
        let count = of(mark).count().max(places.len());
        (mark, places, count)
    });
    let hidden = |(mark, places, count): &(Mark, Vec<EventPlace>, usize)| match mark {
        Mark::BranchPoint => count - places.len(),
        _ => 0,
    };
    let branches_at_flips = joined.iter().map(hidden).sum();
    let events = joined.into_iter().filter(|(_, places, _)| !places.is_empty()).collect();
    JoinedEvents { events, branches_at_flips }
}

/// Whether one of the places, in increasing order along the first axis, coincides with a place.
fn is_near(places: &[(f64, f64)], (x, y): (f64, f64)) -> bool {
    let first = places.partition_point(|place| place.0 < x - ONE_PLACE);
    let mut beside = places[first..].iter().take_while(|place| place.0 <= x + ONE_PLACE);
    beside.any(|place| (place.1 - y).abs() <= ONE_PLACE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flip_stands_for_the_branch_point_on_it_and_a_corner_has_one_mark() {
        let at = |(x, y): (f64, f64)| EventPlace { x, y, of_stable: true };
        let places = |places: &[(f64, f64)]| places.iter().copied().map(at).collect::<Vec<_>>();
        let events = [
            (Mark::Flip, places(&[(0.2, 0.5), (0.9, 0.1)])),
            (Mark::BranchPoint, places(&[(0.6, 0.6), (0.2 + 1e-9, 0.5)])),
            (Mark::Fold, places(&[(0.4, 0.4), (0.2, 0.5)])),
            (Mark::Grazing, places(&[(0.4, 0.4), (0.4, 0.7)])),
        ];
        let joined = join(&events, |place| (place.x, place.y));
        assert_eq!(joined.branches_at_flips, 1);
        let found = |mark: Mark| joined.events.iter().find(|(kind, ..)| *kind == mark).unwrap();
        let of = |mark: Mark| found(mark).1.iter().map(|place| (place.x, place.y)).collect::<Vec<_>>();
        assert_eq!(of(Mark::Flip), [(0.2, 0.5), (0.9, 0.1)]);
        assert_eq!(of(Mark::BranchPoint), [(0.6, 0.6)]);
        // A fold on a flip is a finding of its own.
        assert_eq!(of(Mark::Fold), [(0.2, 0.5)]);
        assert_eq!(of(Mark::FoldAtGrazing), [(0.4, 0.4)]);
        assert_eq!(of(Mark::Grazing), [(0.4, 0.7)]);
        assert_eq!((found(Mark::Grazing).2, found(Mark::Fold).2, found(Mark::FoldAtGrazing).2), (2, 2, 1));
    }
}
