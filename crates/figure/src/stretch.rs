//! A branch cut into stretches of one stability, without gaps, inside the frequency axis.

/// A solution as far as a line through it is concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sample {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) stable: bool,
    /// Stability may change here, so that the flag `stable` says nothing about the lines on both sides.
    pub(crate) bifurcation: bool,
}

/// A stretch of a branch: a line, or a dot where a solution stands alone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) stable: bool,
    pub(crate) vertices: Vec<Vertex>,
}

/// A place on a stretch, in the units of the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// A turning point, which no simplification may take away.
    pub(crate) keep: bool,
}

/// Cuts a branch into stretches.
///
/// * `samples`: the solutions in order; one that is not finite is a gap.
/// * `range`: ends of the horizontal axis; lines are cut exactly there.
pub(crate) fn stretches(samples: &[Sample], range: (f64, f64)) -> Vec<Stretch> {
    samples
        .split(|sample| !(sample.x.is_finite() && sample.y.is_finite()))
        .flat_map(|connected| match connected {
            [] => Vec::new(),
            [lone] => dot(lone, range).into_iter().collect(),
            _ => lines(connected, range),
        })
        .collect()
}

fn dot(lone: &Sample, (from, to): (f64, f64)) -> Option<Stretch> {
    let vertices = vec![Vertex { x: lone.x, y: lone.y, keep: true }];
    (from..=to).contains(&lone.x).then_some(Stretch { stable: lone.stable, vertices })
}

fn lines(samples: &[Sample], range: (f64, f64)) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    for pair in samples.windows(2) {
        let Some((start, end)) = cut(&pair[0], &pair[1], range) else { continue };
        let stable = joins_stable(&pair[0], &pair[1]);
        match stretches.last_mut() {
            Some(open) if open.stable == stable && same_place(open.vertices.last(), &start) => {
                open.vertices.push(end);
            }
            _ => stretches.push(Stretch { stable, vertices: vec![start, end] }),
        }
    }
    stretches
}

fn same_place(last: Option<&Vertex>, start: &Vertex) -> bool {
    last.is_some_and(|last| last.x == start.x && last.y == start.y)
}

/// Whether the solutions between two neighbours are stable: as the one that is not a bifurcation says.
fn joins_stable(start: &Sample, end: &Sample) -> bool {
    match (start.bifurcation, end.bifurcation) {
        (true, false) => end.stable,
        (false, true) => start.stable,
        _ => start.stable && end.stable,
    }
}

/// The part of the line between two solutions inside the axis.
fn cut(start: &Sample, end: &Sample, (from, to): (f64, f64)) -> Option<(Vertex, Vertex)> {
    let (low, high) = (start.x.min(end.x), start.x.max(end.x));
    let inside = low <= to && high >= from;
    inside.then(|| (cut_end(start, end, (from, to)), cut_end(end, start, (from, to))))
}

/// `near`, or where the line from it to `far` enters the axis.
fn cut_end(near: &Sample, far: &Sample, (from, to): (f64, f64)) -> Vertex {
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

    fn sample(x: f64, stable: bool) -> Sample {
        Sample { x, y: 10.0 * x, stable, bifurcation: false }
    }

    fn ends(stretches: &[Stretch]) -> Vec<(bool, f64, f64)> {
        stretches.iter().map(|s| (s.stable, s.vertices[0].x, s.vertices.last().unwrap().x)).collect()
    }

    #[test]
    fn stretches_meet_at_the_bifurcation_whatever_its_own_flag_says() {
        for flag in [true, false] {
            let fold = Sample { bifurcation: true, ..sample(2.0, flag) };
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
    fn solutions_that_are_not_finite_are_gaps() {
        let hole = Sample { y: f64::NAN, ..sample(2.0, true) };
        let branch = [sample(0.0, true), sample(1.0, true), hole, sample(3.0, true), hole];
        assert_eq!(ends(&stretches(&branch, EVERYWHERE)), [(true, 0.0, 1.0), (true, 3.0, 3.0)]);
        assert!(stretches(&[hole, hole], EVERYWHERE).is_empty());
    }

    #[test]
    fn a_line_from_far_outside_does_not_round_to_zero() {
        let far = Sample { x: -1e99, y: 9e53, ..sample(0.0, true) };
        let near = Sample { x: 0.0, y: 1e-91, ..sample(0.0, true) };
        assert!(stretches(&[far, near], (-1e39, 1e39))[0].vertices[0].y > 0.0);
    }

    #[test]
    fn lines_end_exactly_at_the_ends_of_the_axis() {
        let branch: Vec<Sample> = [0.0, 4.0, 9.0, 12.0, 8.0].map(|x| sample(x, true)).into();
        let cut = stretches(&branch, (3.0, 10.0));
        assert_eq!(cut.len(), 1, "the line leaves and comes back at the same place here");
        assert_eq!(cut[0].vertices.iter().map(|v| v.x).collect::<Vec<_>>(), [3.0, 4.0, 9.0, 10.0, 8.0]);
        assert!(cut[0].vertices.iter().all(|v| (v.y - 10.0 * v.x).abs() < 1e-12));
    }
}
