//! A branch divided into parts of one stability, without gaps, inside the frequency axis.

/// A solution on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BranchSample {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) look: LineLook,
    /// Stability may change here, so that the look of the point does not determine the lines on both sides.
    pub(crate) bifurcation: bool,
}

/// How a line shows the stability of its solutions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineLook {
    Stable,
    /// A multiplier stays on the unit circle, to its accuracy.
    Marginal,
    Unstable,
}

impl LineLook {
    pub(crate) const ALL: [Self; 3] = [Self::Stable, Self::Marginal, Self::Unstable];

    /// * `stable`: no multiplier is known to lie outside the unit circle.
    pub(crate) fn of(stable: bool, marginal: bool) -> Self {
        match (stable, marginal) {
            (false, _) => Self::Unstable,
            (true, true) => Self::Marginal,
            (true, false) => Self::Stable,
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Marginal => "marginal",
            Self::Unstable => "unstable",
        }
    }
}

/// A part of a branch of one stability: a line, or a dot for a single solution.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BranchStretch {
    pub(crate) look: LineLook,
    pub(crate) vertices: Vec<Vertex>,
}

/// A point of a part, in the units of the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// A turning point, which simplification must keep.
    pub(crate) keep: bool,
}

/// Divides a branch into parts of one stability.
///
/// * `samples`: the solutions in order; one that is not finite is a gap.
/// * `range`: ends of the horizontal axis; lines are cut exactly there.
pub(crate) fn stretches(samples: &[BranchSample], range: (f64, f64)) -> Vec<BranchStretch> {
    samples
        .split(|sample| !(sample.x.is_finite() && sample.y.is_finite()))
        .flat_map(|connected| match connected {
            [] => Vec::new(),
            [lone] => dot(lone, range).into_iter().collect(),
            _ => lines(connected, range),
        })
        .collect()
}

fn dot(lone: &BranchSample, (from, to): (f64, f64)) -> Option<BranchStretch> {
    let vertices = vec![Vertex { x: lone.x, y: lone.y, keep: true }];
    (from..=to).contains(&lone.x).then_some(BranchStretch { look: lone.look, vertices })
}

fn lines(samples: &[BranchSample], range: (f64, f64)) -> Vec<BranchStretch> {
    let mut stretches: Vec<BranchStretch> = Vec::new();
    let passing = passing_marginal(samples);
    for (k, pair) in samples.windows(2).enumerate() {
        let Some((start, end)) = cut(&pair[0], &pair[1], range) else { continue };
        let look = look_between([&pair[0], &pair[1]], [passing[k], passing[k + 1]]);
        match stretches.last_mut() {
            Some(open) if open.look == look && same_place(open.vertices.last(), &start) => {
                open.vertices.push(end);
            }
            _ => stretches.push(BranchStretch { look, vertices: vec![start, end] }),
        }
    }
    stretches
}

fn same_place(last: Option<&Vertex>, start: &Vertex) -> bool {
    last.is_some_and(|last| last.x == start.x && last.y == start.y)
}

/// Which solutions are marginal between neighbours that are not: a multiplier passes the unit circle, and, as
/// at a bifurcation, their look does not determine the lines on both sides.
fn passing_marginal(samples: &[BranchSample]) -> Vec<bool> {
    let is_marginal = |k: usize| samples.get(k).is_some_and(|sample| sample.look == LineLook::Marginal);
    let alone = |k: usize| is_marginal(k) && !is_marginal(k + 1) && (k == 0 || !is_marginal(k - 1));
    (0..samples.len()).map(alone).collect()
}

/// The look of the line between two neighbours: the look of the one at which stability does not change, else
/// the less stable one. Two successive bifurcations may have stable solutions between them.
///
/// * `passing`: whether each is marginal in passing only.
fn look_between([start, end]: [&BranchSample; 2], passing: [bool; 2]) -> LineLook {
    let looks = [start.look, end.look];
    let has = |look: LineLook| looks.contains(&look);
    match (start.bifurcation || passing[0], end.bifurcation || passing[1]) {
        (true, false) => end.look,
        (false, true) => start.look,
        _ if has(LineLook::Unstable) => LineLook::Unstable,
        (false, false) if has(LineLook::Marginal) => LineLook::Marginal,
        _ => LineLook::Stable,
    }
}

/// The part of the line between two solutions inside the axis.
fn cut(start: &BranchSample, end: &BranchSample, (from, to): (f64, f64)) -> Option<(Vertex, Vertex)> {
    let (low, high) = (start.x.min(end.x), start.x.max(end.x));
    let inside = low <= to && high >= from;
    inside.then(|| (cut_end(start, end, (from, to)), cut_end(end, start, (from, to))))
}

/// `near`, or where the line from it to `far` enters the axis.
fn cut_end(near: &BranchSample, far: &BranchSample, (from, to): (f64, f64)) -> Vertex {
    if (from..=to).contains(&near.x) {
        return Vertex { x: near.x, y: near.y, keep: near.bifurcation };
    }
    let x = near.x.clamp(from, to);
    let share = (x - near.x) / (far.x - near.x);
    let y = (1.0 - share) * near.y + share * far.y; // between both ends also after rounding
    Vertex { x, y, keep: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVERYWHERE: (f64, f64) = (-1e9, 1e9);

    fn sample(x: f64, stable: bool) -> BranchSample {
        BranchSample { x, y: 10.0 * x, look: LineLook::of(stable, false), bifurcation: false }
    }

    fn marginal(x: f64) -> BranchSample {
        BranchSample { look: LineLook::Marginal, ..sample(x, true) }
    }

    fn ends(stretches: &[BranchStretch]) -> Vec<(bool, f64, f64)> {
        stretches
            .iter()
            .map(|s| (s.look == LineLook::Stable, s.vertices[0].x, s.vertices.last().unwrap().x))
            .collect()
    }

    #[test]
    fn stretches_meet_at_the_bifurcation_whatever_its_own_flag_says() {
        for flag in [true, false] {
            let fold = BranchSample { bifurcation: true, ..sample(2.0, flag) };
            let branch = [sample(0.0, true), sample(1.0, true), fold, sample(1.5, false), sample(1.0, false)];
            assert_eq!(ends(&stretches(&branch, EVERYWHERE)), [(true, 0.0, 2.0), (false, 2.0, 1.0)]);
        }
    }

    #[test]
    fn a_change_without_an_event_is_unstable_between_the_neighbours() {
        let branch = [sample(0.0, true), sample(1.0, true), sample(2.0, false)];
        assert_eq!(ends(&stretches(&branch, EVERYWHERE)), [(true, 0.0, 1.0), (false, 1.0, 2.0)]);
    }

    #[test]
    fn solutions_that_stay_marginal_are_a_stretch_of_their_own() {
        let branch = [sample(0.0, true), marginal(1.0), marginal(2.0), sample(3.0, false), marginal(4.0)];
        let found = stretches(&branch, EVERYWHERE);
        let looks: Vec<_> = found.iter().map(|s| (s.look, s.vertices.last().unwrap().x)).collect();
        assert_eq!(looks, [(LineLook::Marginal, 2.0), (LineLook::Unstable, 4.0)]);
    }

    #[test]
    fn one_that_is_marginal_in_passing_looks_like_its_neighbours() {
        let branch = [sample(0.0, true), marginal(1.0), sample(2.0, true), marginal(3.0), sample(4.0, false)];
        let found = stretches(&branch, EVERYWHERE);
        let looks: Vec<_> = found.iter().map(|s| (s.look, s.vertices.last().unwrap().x)).collect();
        assert_eq!(looks, [(LineLook::Stable, 3.0), (LineLook::Unstable, 4.0)]);
    }

    #[test]
    fn two_bifurcations_side_by_side_may_have_stable_solutions_between_them() {
        let at = |x| BranchSample { bifurcation: true, ..marginal(x) };
        let found = stretches(&[sample(0.0, true), at(1.0), at(2.0), sample(3.0, false)], EVERYWHERE);
        let looks: Vec<_> = found.iter().map(|s| (s.look, s.vertices.last().unwrap().x)).collect();
        assert_eq!(looks, [(LineLook::Stable, 2.0), (LineLook::Unstable, 3.0)]);
    }

    #[test]
    fn solutions_that_are_not_finite_are_gaps() {
        let hole = BranchSample { y: f64::NAN, ..sample(2.0, true) };
        let branch = [sample(0.0, true), sample(1.0, true), hole, sample(3.0, true), hole];
        assert_eq!(ends(&stretches(&branch, EVERYWHERE)), [(true, 0.0, 1.0), (true, 3.0, 3.0)]);
        assert!(stretches(&[hole, hole], EVERYWHERE).is_empty());
    }

    #[test]
    fn a_line_from_far_outside_does_not_round_to_zero() {
        let far = BranchSample { x: -1e99, y: 9e53, ..sample(0.0, true) };
        let near = BranchSample { x: 0.0, y: 1e-91, ..sample(0.0, true) };
        assert!(stretches(&[far, near], (-1e39, 1e39))[0].vertices[0].y > 0.0);
    }

    #[test]
    fn lines_end_exactly_at_the_ends_of_the_axis() {
        let branch: Vec<BranchSample> = [0.0, 4.0, 9.0, 12.0, 8.0].map(|x| sample(x, true)).into();
        let cut = stretches(&branch, (3.0, 10.0));
        assert_eq!(cut.len(), 1, "the line leaves and comes back at the same place here");
        assert_eq!(cut[0].vertices.iter().map(|v| v.x).collect::<Vec<_>>(), [3.0, 4.0, 9.0, 10.0, 8.0]);
        assert!(cut[0].vertices.iter().all(|v| (v.y - 10.0 * v.x).abs() < 1e-12));
    }
}
