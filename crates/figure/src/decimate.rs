//! Fewer points for the same line.
//!
//! A branch has far more points than paper has dots. A first pass removes points closer to the last kept one
//! than a fraction of the tolerance; then Douglas and Peucker's method is applied. Distances are to the
//! *segment* between two kept points, not to its line, so that a branch that runs back on itself keeps its
//! turning points.
//!
//! # Source
//! Douglas and Peucker, Cartographica 10 (1973), 112-122; the distance to the segment instead of the line is
//! ours.

use crate::svg::PagePoint;

/// Fraction of the tolerance for the first pass.
const MERGING_SHARE: f64 = 0.2;

/// Ascending indices of the points to keep; every omitted point is within `tolerance` of the line through
/// them.
///
/// * `keep`: points that must stay, one entry for each point; the first and the last one always do.
pub(crate) fn decimate(points: &[PagePoint], keep: &[bool], tolerance: f64) -> Vec<usize> {
    let candidates = merge_close(points, keep, MERGING_SHARE * tolerance);
    let mut kept = vec![false; candidates.len()];
    let mut anchor = 0;
    for (i, &candidate) in candidates.iter().enumerate() {
        if i == 0 || i + 1 == candidates.len() || keep[candidate] {
            kept[i] = true;
            thin_between(points, &candidates, anchor, i, (1.0 - MERGING_SHARE) * tolerance, &mut kept);
            anchor = i;
        }
    }
    candidates.into_iter().zip(kept).filter_map(|(candidate, kept)| kept.then_some(candidate)).collect()
}

/// Leaves out points within `tolerance` of the last kept one.
fn merge_close(points: &[PagePoint], keep: &[bool], tolerance: f64) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::new();
    for (i, &point) in points.iter().enumerate() {
        let end = i == 0 || i + 1 == points.len();
        let near = kept.last().is_some_and(|&last| distance(point, points[last]) <= tolerance);
        if end || keep[i] || !near {
            kept.push(i);
        }
    }
    kept
}

/// Douglas and Peucker's method on `candidates[first..=last]`, with an explicit stack.
fn thin_between(
    points: &[PagePoint],
    candidates: &[usize],
    first: usize,
    last: usize,
    tolerance: f64,
    kept: &mut [bool],
) {
    let mut stack = vec![(first, last)];
    while let Some((first, last)) = stack.pop() {
        let (start, end) = (points[candidates[first]], points[candidates[last]]);
        let mut farthest = (first, tolerance);
        for i in first + 1..last {
            let distance = distance_to_segment(points[candidates[i]], start, end);
            if distance > farthest.1 {
                farthest = (i, distance);
            }
        }
        if farthest.0 > first {
            kept[farthest.0] = true;
            stack.extend([(first, farthest.0), (farthest.0, last)]);
        }
    }
}

/// Distance between two places (pt).
pub(crate) fn distance(a: PagePoint, b: PagePoint) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}

/// Distance of `point` to the nearest place of the segment from `start` to `end`.
fn distance_to_segment(point: PagePoint, start: PagePoint, end: PagePoint) -> f64 {
    let (along_x, along_y) = (end.x - start.x, end.y - start.y);
    let length_squared = along_x * along_x + along_y * along_y;
    if length_squared == 0.0 {
        return distance(point, start);
    }
    let share = ((point.x - start.x) * along_x + (point.y - start.y) * along_y) / length_squared;
    let share = share.clamp(0.0, 1.0);
    distance(point, PagePoint { x: start.x + share * along_x, y: start.y + share * along_y })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Greatest distance of the points between two kept ones to the segment between these.
    fn greatest_error(points: &[PagePoint], kept: &[usize]) -> f64 {
        kept.windows(2)
            .flat_map(|pair| {
                let (start, end) = (points[pair[0]], points[pair[1]]);
                points[pair[0]..=pair[1]].iter().map(move |&point| distance_to_segment(point, start, end))
            })
            .fold(0.0, f64::max)
    }

    proptest! {
        /// A random walk runs back on itself far more than a branch.
        #[test]
        fn no_point_is_farther_from_the_line_than_the_tolerance(
            steps in prop::collection::vec((-1.0..1.0, -1.0..1.0, prop::bool::weighted(0.02)), 1..400),
            tolerance in 0.01..3.0,
        ) {
            let mut at = PagePoint { x: 0.0, y: 0.0 };
            let mut after = |step: &(f64, f64, bool)| {
                at = PagePoint { x: at.x + step.0, y: at.y + step.1 };
                at
            };
            let points: Vec<PagePoint> = steps.iter().map(&mut after).collect();
            let keep: Vec<bool> = steps.iter().map(|step| step.2).collect();
            let kept = decimate(&points, &keep, tolerance);
            prop_assert_eq!(kept[0], 0);
            prop_assert_eq!(*kept.last().unwrap(), points.len() - 1);
            prop_assert!(kept.is_sorted_by(|a, b| a < b));
            prop_assert!((0..points.len()).all(|i| !keep[i] || kept.contains(&i)));
            prop_assert!(greatest_error(&points, &kept) <= tolerance * (1.0 + 1e-12));
        }
    }

    #[test]
    fn a_straight_line_keeps_its_ends() {
        let points: Vec<PagePoint> =
            (0..1000).map(|i| PagePoint { x: f64::from(i), y: 2.0 * f64::from(i) }).collect();
        assert_eq!(decimate(&points, &[false; 1000], 0.01), [0, 999]);
    }

    #[test]
    fn a_line_that_runs_back_on_itself_keeps_its_turning_point() {
        let points = [0.0, 5.0, 10.0, 6.0, 3.0].map(|x| PagePoint { x, y: 1.0 });
        assert_eq!(decimate(&points, &[false; 5], 0.01), [0, 2, 4]);
    }
}
