//! Where an event was found, and what is known of the way there.

use hammerbeam_path::{ContinuationPoint, Follower, PathProblem, TestValue, distance};

use crate::shooting::ShootingProblem;

/// A contact that appears or vanishes at grazing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContactChange {
    /// Which one, in the order of the elements and their contacts.
    pub contact: usize,
    /// Whether the orbit has it behind the event, in the direction of the walk.
    pub appears: bool,
}

/// What the walk knows of the points at and before the event.
pub(crate) struct EventLocation<'a> {
    pub point: &'a ContinuationPoint,
    /// To this length along the path the place of a corner is known.
    pub at_corners: f64,
    /// The contacts that change there.
    pub contacts: Vec<ContactChange>,
    /// Within which the parameter of a grazing is known that was computed as a corner; `None` where that was
    /// not.
    pub computed: Option<f64>,
    /// What is known of the way there; `None` where nothing is.
    pub approach: Option<Approach>,
}

impl<'a> EventLocation<'a> {
    /// A place of which no more is known than itself, and within which the parameter is known, if that was
    /// computed.
    pub fn alone(point: &'a ContinuationPoint, computed: Option<f64>) -> Self {
        Self { point, at_corners: 0.0, contacts: Vec::new(), computed, approach: None }
    }

    /// A place to which a path has come this way.
    pub fn reached(point: &'a ContinuationPoint, approach: Approach) -> Self {
        Self { approach: Some(approach), ..Self::alone(point, None) }
    }
}

/// What is known of the way from the point before to an event.
#[derive(Debug, Clone)]
pub(crate) struct Approach {
    /// Length of the path from the point before.
    pub chord: f64,
    /// Change of the tangent's frequency component per length.
    pub bend: f64,
    /// The point before, on the way to a fold or branch point; `None` on the way to what needs none.
    pub before: Option<Vec<f64>>,
    /// How near contacts came to a change there: least clearance or penetration of a turn [m], and least
    /// squared speed of a touch [m^2/s^2]; `None` where that is not known.
    pub near: Option<[f64; 2]>,
    /// The test function there whose zero was located.
    pub test: Option<TestValue>,
    /// Tolerance of the motion, and the correction that is still due at the event, relative to the orbit.
    pub errors: [f64; 2],
    /// Length along the path that a change of the orbit by its own size counts.
    pub unit: f64,
}

impl Approach {
    /// Over a length along the path, at the start of which the test function was this.
    ///
    /// * `problem`, `due`: at the event, and the norm of the correction that is still due there.
    pub fn over(chord: f64, test: Option<TestValue>, (problem, due): (&ShootingProblem, f64)) -> Self {
        let unit = problem.length_per_norm();
        let errors = [problem.motion_tolerance(), due / unit];
        Self { chord, bend: 0.0, before: None, near: None, test, errors, unit }
    }

    /// Of the last step of a path.
    ///
    /// * `current`: the present point, with what happens there.
    pub fn of(follower: &Follower, problem: &ShootingProblem, current: &ContinuationPoint) -> Self {
        let tests = &follower.tests().before;
        // Two of the multipliers, then as many of each kind of near miss.
        let near = tests.get(2..).filter(|near| !near.is_empty() && near.len().is_multiple_of(3));
        let near = near.map(|near| {
            let least = |kind: usize| near[kind * near.len() / 3].value;
            [least(0).min(least(2)), least(1)]
        });
        let zeros = current.events.zeros;
        let test = (zeros != 0).then(|| tests.get(zeros.trailing_zeros() as usize).copied()).flatten();
        let mut approach = Self { near, ..Self::over(0.0, test, (problem, current.correction_norm)) };
        // The point before stays in the history, where only the present one counts behind an event, too.
        if let [base, before, ..] = follower.state().history.nodes.as_slice() {
            let last = base.point.len() - 1;
            approach.chord = distance(problem.weights(), &base.point, &before.point);
            approach.bend =
                (base.tangent[last] - before.tangent[last]).abs() / approach.chord.max(f64::MIN_POSITIVE);
            let at_unity = current.events.branch_point || current.events.fold;
            approach.before = at_unity.then(|| before.point.clone());
        }
        approach
    }
}
