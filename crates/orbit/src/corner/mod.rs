//! Grazing of a rigid stop as a corner of the path: where it is, and points behind it.
//! Equations (G8) and (G9) of the book, `docs/theory`.
//!
//! An impact of the speed `v` depends on the state like the root of the depth to which the motion would have
//! gone, so near `v = 0` a point that is good to `e` gives its impact to `e/v` only, and Newton's method on
//! states alone loses its way at speeds of some 1e-6. With the orbit cut at its touch, and the phase `x` of
//! that for an unknown, all is smooth:
//!
//! `Z(J z, x) = z`, `r = level`, `r' = v`, with the jump `J` of the impact,
//!
//! has a regular matrix for all speeds down to zero and beyond, since `r'` changes with x by `r''/f`.
//! There J is the identity, and the orbits without the impact follow: `Z(z, x) = z`, `r' = 0`, `level -
//! r = c`. So both sides of the corner are solutions of regular equations for a given v or c
//! (`equations.rs`), and the corner is where both are zero.
//!
//! The motion shows which touch it is: an impact that is slow, or a turn that is near (`touch.rs`).
//!
//! **Several touches at once.** In a symmetric orbit both stops are grazed at once, and orbits with either
//! impact, with both and with none meet in the corner. The path joins each set of impacts with its
//! complement: the orbits with none go on as the orbits with both, which are symmetric, too; and the orbits
//! with the one as their mirror images with the other. So no branch comes to the orbits without impacts
//! twice. An orbit of N periods that touches in one of them only comes to orbits of a shorter period: there
//! its complement is itself, started a period later, and the branch ends.
//!
//! # Source
//! Nordmark, J. Sound Vib. 145 (1991), 279-297: near grazing the impact speed is the smooth coordinate.

mod equations;
mod flow;
mod touch;

use hammerbeam_path::{PathProblem, RootCorner};

use crate::shooting::ShootingProblem;
use equations::{Beside, TouchEquations, Unknowns};
use touch::{Side, Touch};

/// Clearance of the nearest point without the impact, relative to the orbit: what a point is known to does
/// not make an impact of it.
const CLEAR: f64 = 1e-9;
/// The same for the point that gives the direction; the nearer ones where another touch is near.
const CLEAR_FARTHER: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// Speed of the first point with the impact, relative to the orbit: about the least that a point of the path
/// resolves,
const SLOW: f64 = 1e-5;
/// but no more than this part of the next slower touch, down to that.
const PART: f64 = 0.05;
const SLOWEST: f64 = 3e-7;
const SLOWER: [f64; 3] = [1.0, 0.1, 0.03];
/// Distance from the corner at which that point lies if it can, relative to the orbit.
const NEAR: f64 = 1e-5;
/// How many times faster that is where several touches become impacts at once: each multiplies
/// what is between two motions by one over its speed. From 1e8 or so rounding of a state is more than the
/// tolerance after a period.
const AT_ONCE_FASTER: f64 = 30.0;
/// So much farther it may lie to have that speed: distances are measured by the range, and where that is
/// narrow the frequency makes most of them.
const AT_ONCE_FARTHER: f64 = 300.0;
/// Speeds of points with the impact that are tried, in the first one.
const FASTER: [f64; 7] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
/// How much faster the impact is in the point that gives the direction.
const AHEAD: f64 = 1.1;
/// So many touches are tried, those nearest to grazing first.
const MOST_TOUCHES: usize = 2;
/// Speeds that differ by less, relatively, belong to touches that graze at once.
const AT_ONCE: f64 = 1e-3;
/// How many times as far as a point of the path from the corner its touch may be: what is between two impacts
/// is magnified by either.
const MAGNIFIED: f64 = 300.0;
/// Largest distance from the corner to which a touch is known that the motion was looked at for.
const LOOKED: f64 = 1e-5;

/// The grazing of a rigid stop that an orbit is near, and the orbits behind it.
///
/// * `reach`: about how far from the orbit it is at most, relative to the orbit.
/// * `lies_ahead`: whether a point of the path at which one is found is wanted.
pub(crate) fn grazing_near(
    problem: &mut ShootingProblem,
    point: &[f64],
    reach: f64,
    lies_ahead: &dyn Fn(&[f64]) -> bool,
) -> Option<RootCorner> {
    problem.move_to(point).ok()?;
    let touches = touch::near_grazing(problem, point, reach)?;
    let mut search = CornerSearch {
        last: point[point.len() - 1],
        farthest: MAGNIFIED * reach + LOOKED,
        slow: SLOW,
        evaluations: 0,
    };
    let slow: Vec<Touch> = touches.iter().filter(|touch| touch.side == Side::Impact).cloned().collect();
    for (place, first) in touches.iter().enumerate().take(MOST_TOUCHES) {
        let at_once = |other: &&Touch| {
            other.side == first.side && (other.speed - first.speed).abs() <= AT_ONCE * first.speed
        };
        let together: Vec<Touch> = touches.iter().filter(at_once).cloned().collect();
        let others = touches[place + 1..].iter().filter(|other| !at_once(other));
        let next = others.map(|other| other.speed).fold(f64::INFINITY, f64::min);
        search.slow = (PART * next).clamp(SLOWEST, SLOW);
        let alone = std::slice::from_ref(first);
        let tries = if together.len() > 1 { vec![together.as_slice(), alone] } else { vec![alone] };
        for touches in tries {
            if let Some(corner) = search.corner_of(problem, (touches, &slow), lies_ahead) {
                return Some(corner);
            }
        }
    }
    None
}

/// A search for a corner.
struct CornerSearch {
    /// The last unknown of the orbit that it starts at.
    last: f64,
    /// How far from that the touches are moved at most.
    farthest: f64,
    /// Speed of the first point with the impact.
    slow: f64,
    /// Work so far.
    evaluations: u64,
}

impl CornerSearch {
    /// The corner where some touches graze.
    ///
    /// * `slow`: all slow impacts of the orbit that the search starts at.
    fn corner_of(
        &mut self,
        problem: &mut ShootingProblem,
        (touches, slow): (&[Touch], &[Touch]),
        lies_ahead: &dyn Fn(&[f64]) -> bool,
    ) -> Option<RootCorner> {
        let mut equations = TouchEquations::new(problem, touches, self.last).ok()?;
        let grazing = Beside::WithoutImpact { clearance: 0.0 };
        let guess = Unknowns::of_touches(touches, self.last);
        let solved = equations.solve(&guess, grazing, self.farthest);
        let solved = solved.and_then(|unknowns| Some((equations.point(&unknowns, grazing)?, unknowns)));
        let uncertainty = solved.as_ref().map(|(_, unknowns)| equations.uncertainty(unknowns, grazing));
        let clear = solved.as_ref().map(|(_, unknowns)| without_impact(&mut equations, unknowns));
        self.evaluations += equations.evaluations();
        let (corner, unknowns) = solved.filter(|(corner, _)| lies_ahead(corner))?;
        let one = (equations.elements[0], unknowns.phase(0, equations.problem.node_size()));
        let [beside, farther] = clear?;
        let beside = beside?;
        let uncertainty = uncertainty?? + (beside[beside.len() - 1] - corner[corner.len() - 1]).abs();
        let all = touch::at_grazing(problem, &beside, one)?;
        problem.evaluate(&beside).ok()?;
        let without = problem.touches().to_vec();
        let cycles = f64::from(problem.period_multiple());
        let behind = match impacts_behind(slow, &all, cycles) {
            impacts if impacts.is_empty() => vec![[beside.clone(), farther?]],
            // The same touches: they are solved for.
            impacts if touches[0].side == Side::Turn && impacts.len() == touches.len() => {
                let mut equations = TouchEquations::new(problem, touches, self.last).ok()?;
                self.with_impacts(&mut equations, &unknowns, (&corner, &without))?
            }
            impacts => {
                let last = corner[corner.len() - 1];
                let mut equations = TouchEquations::new(problem, &impacts, last).ok()?;
                let guess = Unknowns::of_touches(&impacts, last);
                // Newton's method may fail, since other stops graze at once. Then the touches are known well
                // enough as they are beside the corner.
                let unknowns = equations.solve(&guess, grazing, self.farthest).unwrap_or(guess);
                self.with_impacts(&mut equations, &unknowns, (&corner, &without))?
            }
        };
        if behind.is_empty() {
            return None;
        }
        let is_multiple = all.len() > 1;
        let evaluations = self.evaluations;
        Some(RootCorner { corner, beside, uncertainty, behind, is_multiple, evaluations })
    }

    /// Orbits beside a corner of which the touches are impacts, the nearest first.
    ///
    /// * `without`: numbers of touches of the orbits without these impacts.
    fn with_impacts(
        &mut self,
        equations: &mut TouchEquations<'_>,
        unknowns: &Unknowns,
        (corner, without): (&[f64], &[u32]),
    ) -> Option<Vec<[Vec<f64>; 2]>> {
        let (faster, farther) =
            if equations.elements.len() > 1 { (AT_ONCE_FASTER, AT_ONCE_FARTHER) } else { (1.0, 1.0) };
        let (slow, near) = (faster * self.slow, farther * NEAR);
        let length_per_norm = equations.length_per_norm();
        let mut point = |speed: f64| {
            let beside = Beside::WithImpact { speed };
            let solution = equations.solve(unknowns, beside, f64::INFINITY)?;
            equations.point(&solution, beside)
        };
        // A touch near by may not leave room for the first.
        let slower = |share: f64| (share * slow).max(SLOWEST);
        let (speed, first) = SLOWER.into_iter().map(slower).find_map(|speed| Some((speed, point(speed)?)))?;
        let far = relative_distance(&first, corner, length_per_norm);
        let slow = (speed * (near / far).min(1.0)).max(SLOWEST);
        let mut with_farther = |speed: f64| {
            let nearer = point(speed)?;
            // Where there is no faster one the direction is that from the corner.
            let on = || nearer.iter().zip(corner).map(|(z, c)| z + (AHEAD - 1.0) * (z - c)).collect();
            let farther = point(AHEAD * speed).unwrap_or_else(on);
            Some([nearer, farther])
        };
        let mut points: Vec<[Vec<f64>; 2]> =
            FASTER.into_iter().filter_map(|factor| with_farther(factor * slow)).collect();
        self.evaluations += equations.evaluations();
        let mut expected = without.to_vec();
        equations.elements.iter().for_each(|&element| expected[element] += 1);
        // Over a period rounding may be more than the impacts that follow.
        points.retain(|[point, _]| {
            equations.problem.evaluate(point).is_ok() && equations.problem.touches() == expected
        });
        Some(points)
    }
}

/// The orbits without an impact beside a corner, at it and a little farther.
fn without_impact(equations: &mut TouchEquations<'_>, corner: &Unknowns) -> [Option<Vec<f64>>; 2] {
    let mut point = |clearance: f64| {
        let beside = Beside::WithoutImpact { clearance };
        let solution = equations.solve(corner, beside, f64::INFINITY)?;
        equations.point(&solution, beside)
    };
    let beside = point(CLEAR);
    [beside, CLEAR_FARTHER.into_iter().find_map(point)]
}

/// Which of all touches that graze in a corner are impacts behind it, see the head of the file.
///
/// * `slow`: the slow impacts of the orbit that was followed to it, of so many cycles. Those that do not
///   graze there stay what they are.
fn impacts_behind(slow: &[Touch], all: &[Touch], cycles: f64) -> Vec<Touch> {
    let was_impact = |touch: &&Touch| slow.iter().any(|impact| impact.is_same(touch, cycles));
    let (before, behind): (Vec<&Touch>, Vec<&Touch>) = all.iter().partition(was_impact);
    let repeats = behind.iter().any(|other| before.iter().any(|touch| touch.repeats(other)));
    if repeats { Vec::new() } else { behind.into_iter().cloned().collect() }
}

/// How far two points of the path with one node are apart, relative to the orbit.
fn relative_distance(a: &[f64], b: &[f64], length_per_norm: f64) -> f64 {
    let last = a.len() - 1;
    let squares: f64 = a[..last].iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    squares.sqrt().hypot((a[last] - b[last]) / length_per_norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(element: usize, side: Side, phase: f64) -> Touch {
        Touch { element, side, phase, state: Vec::new(), speed: 0.0 }
    }

    fn phases(touches: &[Touch]) -> Vec<f64> {
        touches.iter().map(|touch| touch.phase).collect()
    }

    /// Four kinds of orbits meet where a symmetric one grazes two stops: they are joined in pairs, each with
    /// one way on.
    #[test]
    fn each_set_of_impacts_goes_on_as_its_complement() {
        let all = [touch(0, Side::Turn, 0.25), touch(1, Side::Turn, 0.75)];
        let above = [touch(0, Side::Impact, 0.25)];
        let below = [touch(1, Side::Impact, 0.75)];
        let both = [above[0].clone(), below[0].clone()];
        assert_eq!(phases(&impacts_behind(&[], &all, 1.0)), [0.25, 0.75]);
        assert_eq!(phases(&impacts_behind(&both, &all, 1.0)), []);
        assert_eq!(phases(&impacts_behind(&above, &all, 1.0)), [0.75]);
        assert_eq!(phases(&impacts_behind(&below, &all, 1.0)), [0.25]);
    }

    /// An impact as slow as one that grazes, a period before or after it or at another time, counts for
    /// nothing.
    #[test]
    fn a_slow_impact_that_does_not_graze_stays() {
        let all = [touch(0, Side::Turn, 1.25)];
        let slow = [touch(0, Side::Impact, 0.25), touch(0, Side::Impact, 0.6)];
        assert_eq!(phases(&impacts_behind(&slow, &all, 2.0)), [1.25]);
    }

    /// With one touch in two periods the complement is the same orbit a period later: the way on is that
    /// without impacts, whose period is half.
    #[test]
    fn an_impact_in_every_second_period_is_lost() {
        let all = [touch(0, Side::Turn, 0.25), touch(0, Side::Turn, 1.25)];
        assert!(impacts_behind(&[touch(0, Side::Impact, 1.25)], &all, 2.0).is_empty());
    }

    /// A touch at the cut of the orbit may be seen at its end or at its start.
    #[test]
    fn a_touch_at_the_end_of_the_period_equals_the_one_at_its_start() {
        let all = [touch(0, Side::Turn, 1e-5)];
        assert!(impacts_behind(&[touch(0, Side::Impact, 1.0 - 1e-5)], &all, 1.0).is_empty());
    }
}
