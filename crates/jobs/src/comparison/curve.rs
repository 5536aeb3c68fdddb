//! Branches as curves of one quantity, by frequency.

/// A solution of a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Value of the quantity, in SI.
    pub value: f64,
    /// Whether it is stable.
    pub stable: bool,
    /// Row of the branch, from 1 on, end to end as in `branches.csv`.
    pub row: usize,
}

/// A branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchCurve {
    /// Its number.
    pub branch: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Solutions end to end.
    pub points: Vec<CurvePoint>,
}

/// A place where a branch meets a frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Number of the branch.
    pub branch: u32,
    /// Its period multiple.
    pub period_multiple: u32,
    /// Value between the two solutions about the frequency.
    pub value: f64,
    /// Whether the nearer one is stable.
    pub stable: bool,
    /// Row of the nearer one, from 1 on.
    pub row: usize,
}

/// Curves, sorted so that all that meets a frequency is found at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    branches: Vec<BranchCurve>,
    low_hz: f64,
    width_hz: f64,
    /// Segments that reach into each part of the range: index of the branch, index of their first point.
    parts: Vec<Vec<(u32, u32)>>,
}

/// Parts into which the range is cut.
const PARTS: usize = 2000;

impl Curves {
    /// Sorts branches; values that are not positive and finite break a curve.
    #[must_use]
    pub fn new(branches: Vec<BranchCurve>) -> Self {
        let frequencies =
            || branches.iter().flat_map(|branch| &branch.points).map(|point| point.frequency_hz);
        let (low_hz, high_hz) =
            (frequencies().fold(f64::INFINITY, f64::min), frequencies().fold(f64::NEG_INFINITY, f64::max));
        let width_hz = ((high_hz - low_hz) / PARTS as f64).max(f64::MIN_POSITIVE);
        let mut curves = Self { low_hz, width_hz, parts: vec![Vec::new(); PARTS], branches };
        for (index, branch) in curves.branches.iter().enumerate() {
            for (first, pair) in branch.points.windows(2).enumerate() {
                let [a, b] = [pair[0].frequency_hz, pair[1].frequency_hz].map(|f| part(low_hz, width_hz, f));
                for segments in &mut curves.parts[a.min(b)..=a.max(b)] {
                    segments.push((index as u32, first as u32));
                }
            }
        }
        curves
    }

    /// The branches.
    #[must_use]
    pub fn branches(&self) -> &[BranchCurve] {
        &self.branches
    }

    /// Solutions that are no number: gaps in their branches.
    #[must_use]
    pub fn gaps(&self) -> usize {
        self.branches.iter().flat_map(|branch| &branch.points).filter(|point| point.value.is_nan()).count()
    }

    /// All places where a branch of this period (any if none is given) meets a frequency.
    #[must_use]
    pub fn at(&self, frequency_hz: f64, period_multiple: Option<u32>) -> Vec<Hit> {
        let hits = self.segments(frequency_hz, period_multiple).filter_map(|(branch, a, b)| {
            if !positive(a.value) || !positive(b.value) {
                return None;
            }
            let width_hz = b.frequency_hz - a.frequency_hz;
            let share = if width_hz == 0.0 { 0.0 } else { (frequency_hz - a.frequency_hz) / width_hz };
            let nearer = if share < 0.5 { a } else { b };
            Some(Hit {
                branch: branch.branch,
                period_multiple: branch.period_multiple,
                value: a.value + share * (b.value - a.value),
                stable: nearer.stable,
                row: nearer.row,
            })
        });
        hits.collect()
    }

    /// Whether a stable branch of this period meets a frequency with the value 0: a contact force where
    /// nothing touches.
    #[must_use]
    pub fn rests(&self, frequency_hz: f64, period_multiple: Option<u32>) -> bool {
        self.segments(frequency_hz, period_multiple)
            .any(|(_, a, b)| a.stable && b.stable && (a.value == 0.0 || b.value == 0.0))
    }

    /// Where branches of a period meet a frequency: the ends of the segment that crosses it, or the same node
    /// twice where it lies there exactly.
    fn segments(
        &self,
        frequency_hz: f64,
        period_multiple: Option<u32>,
    ) -> impl Iterator<Item = (&BranchCurve, CurvePoint, CurvePoint)> {
        let segments = &self.parts[part(self.low_hz, self.width_hz, frequency_hz)];
        segments.iter().filter_map(move |&(index, first)| {
            let branch = &self.branches[index as usize];
            let wanted = period_multiple.is_none_or(|period| period == branch.period_multiple);
            let ends = meets(&branch.points[first as usize..], frequency_hz).filter(|_| wanted);
            ends.map(|[a, b]| (branch, a, b))
        })
    }

    /// The stable solution of a period whose value is nearest to one, by the ratio.
    #[must_use]
    pub fn nearest_stable(&self, frequency_hz: f64, period: Option<u32>, value: f64) -> Option<Hit> {
        nearest(self.at(frequency_hz, period).into_iter().filter(|hit| hit.stable), value)
    }

    /// The frequency nearest to one at which a stable solution of a period exists, with a value that is
    /// not 0.
    #[must_use]
    pub fn nearest_frequency(&self, frequency_hz: f64, period: Option<u32>) -> Option<f64> {
        let wanted = |branch: &&BranchCurve| period.is_none_or(|period| period == branch.period_multiple);
        let stable = self.branches.iter().filter(wanted).flat_map(|branch| &branch.points);
        let frequencies =
            stable.filter(|point| point.stable && positive(point.value)).map(|point| point.frequency_hz);
        frequencies.min_by(|a, b| (a - frequency_hz).abs().total_cmp(&(b - frequency_hz).abs()))
    }
}

/// How the first segment of a part of a branch meets a frequency. The node between two segments belongs to
/// the second one, so that it is met once; the last node of a branch belongs to the last segment.
fn meets(points: &[CurvePoint], frequency_hz: f64) -> Option<[CurvePoint; 2]> {
    let [a, b] = [points[0], points[1]];
    if a.frequency_hz == frequency_hz {
        return Some([a, a]);
    }
    if b.frequency_hz == frequency_hz {
        return (points.len() == 2).then_some([b, b]);
    }
    ((a.frequency_hz < frequency_hz) != (b.frequency_hz < frequency_hz)).then_some([a, b])
}

/// The hit whose value is nearest to one, by the ratio.
pub(super) fn nearest(hits: impl Iterator<Item = Hit>, value: f64) -> Option<Hit> {
    let off = |hit: &Hit| (hit.value / value).ln().abs();
    hits.min_by(|a, b| off(a).total_cmp(&off(b)))
}

fn positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

fn part(low_hz: f64, width_hz: f64, frequency_hz: f64) -> usize {
    (((frequency_hz - low_hz) / width_hz) as usize).min(PARTS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A branch of these frequencies and values, whose rows are stable.
    fn branch(points: &[(f64, f64)]) -> BranchCurve {
        let point = |(k, &(frequency_hz, value)): (usize, &(f64, f64))| CurvePoint {
            frequency_hz,
            value,
            stable: true,
            row: k + 1,
        };
        BranchCurve { branch: 1, period_multiple: 1, points: points.iter().enumerate().map(point).collect() }
    }

    fn values(curves: &Curves, frequency_hz: f64) -> Vec<f64> {
        curves.at(frequency_hz, None).iter().map(|hit| hit.value).collect()
    }

    /// Up to a fold at 14 Hz and back to one at 3 Hz, so that all nodes are at the ends of the range or
    /// shared.
    #[test]
    fn branch_is_met_at_both_ends_and_each_node_once() {
        for (low, high) in [(3.0, 14.0), (19.0, 110.0), (0.1, 0.7), (20.3, 69.9)] {
            let middle = 0.5 * (low + high);
            let there = [(low, 1.0), (middle, 2.0), (high, 4.0), (middle, 8.0), (low, 16.0), (middle, 32.0)];
            let curves = Curves::new(vec![branch(&there)]);
            assert_eq!(values(&curves, low), [1.0, 16.0]);
            assert_eq!(values(&curves, high), [4.0]);
            assert_eq!(values(&curves, middle), [2.0, 8.0, 32.0]);
            // Beside the nodes each segment is met once.
            assert_eq!(curves.at(0.5 * (low + middle), None).len(), 3);
            assert_eq!(curves.at(0.5 * (middle + high), None).len(), 2);
            assert!(curves.at(low * (1.0 - 1e-15), None).is_empty());
            assert!(curves.at(high * (1.0 + 1e-15), None).is_empty());
        }
    }

    /// Beside a value that is none the node itself is there, and the segment is not.
    #[test]
    fn node_beside_a_gap_is_met() {
        let curves = Curves::new(vec![branch(&[(1.0, 5.0), (2.0, f64::NAN), (3.0, 7.0)])]);
        assert_eq!((values(&curves, 1.0), values(&curves, 3.0)), (vec![5.0], vec![7.0]));
        assert!(values(&curves, 1.5).is_empty() && values(&curves, 2.0).is_empty());
    }

    #[test]
    fn force_at_rest_is_told_at_both_ends() {
        let curves = Curves::new(vec![branch(&[(1.0, 0.0), (2.0, 3.0), (3.0, 0.0)])]);
        assert!([1.0, 1.5, 2.5, 3.0].iter().all(|f| curves.rests(*f, None)));
        assert!(!curves.rests(2.0, None) && values(&curves, 2.0) == [3.0]);
    }
}
