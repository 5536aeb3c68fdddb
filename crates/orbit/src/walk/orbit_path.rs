//! The path that a walk follows: its equations, the follower on it, and its start.

use hammerbeam_motion::exact::{ExactIntegrator, MotionError};
use hammerbeam_path::{ContinuationPoint, Follower, Settings};

use super::settings::{length_per_norm, path_settings};
use crate::{OrbitError, OrbitSettings, shooting::ShootingProblem, size::Cut, state_scale::StateScale};

/// The start is brought back within so many longest steps of its frequency.
const STEPS_TO_START: f64 = 2.0;

/// A path of orbits, in the unknowns in which it is followed at present.
#[derive(Debug)]
pub(crate) struct OrbitPath {
    pub problem: ShootingProblem,
    pub follower: Follower,
    pub settings: OrbitSettings,
    pub range: (f64, f64),
    /// Accepted points since the journal was taken last.
    pub journal: Vec<ContinuationPoint>,
    /// The start as it was, once the phase at which orbits start has moved.
    pub origin: Option<Origin>,
    /// Lengths are measured in another way since the last row.
    pub measures_anew: bool,
}

/// The start of a walk as it was.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Origin {
    /// Phase of its first node [cycles].
    pub phase: f64,
    /// In the first units.
    pub point: ContinuationPoint,
}

impl OrbitPath {
    /// At the start of a walk.
    pub fn new(
        problem: ShootingProblem,
        follower: Follower,
        (settings, range): (&OrbitSettings, (f64, f64)),
    ) -> Self {
        let journal = vec![follower.current().clone()];
        let (settings, origin, measures_anew) = (*settings, None, false);
        Self { problem, follower, settings, range, journal, origin, measures_anew }
    }

    /// The present point.
    pub fn current(&self) -> &ContinuationPoint {
        self.follower.current()
    }

    /// Frequency, or value of what varies, of the present point.
    pub fn parameter(&self) -> f64 {
        self.follower.current().parameter()
    }

    /// How many hertz of arc length a change of the orbit by its own size counts.
    pub fn length_per_norm(&self) -> f64 {
        length_per_norm(self.range)
    }

    /// Settings with which points between others are solved for.
    pub fn settings_between(&self) -> Settings {
        path_settings(&self.settings, self.problem.system(), self.length_per_norm())
    }

    /// Something about the present orbit in the units of the walk; `None` if its motion cannot be computed.
    pub fn of_present<T>(
        &mut self,
        ask: impl FnOnce(Cut<'_>, &mut ExactIntegrator, &StateScale) -> Result<T, MotionError>,
    ) -> Option<T> {
        let point = &self.follower.current().point;
        self.problem.move_to(point).ok()?;
        let (frequency_hz, nodes) = (self.problem.frequency(point), self.problem.nodes(point));
        let (phase, period_multiple) = (self.problem.phase(), self.problem.period_multiple());
        let scale = self.problem.scale().clone();
        let orbit = Cut { phase, nodes: &nodes, frequency_hz, period_multiple };
        ask(orbit, self.problem.integrator(), &scale).ok()
    }

    /// Why the motion could not be computed at the last evaluation, if so.
    pub fn motion_failure(&self) -> Option<OrbitError> {
        self.problem.failure().map(|failure| OrbitError::Motion(failure.clone()))
    }

    /// Notes the present point in the journal, in the first units.
    pub fn note_in_journal(&mut self) {
        let point = self.follower.state().in_first_units(self.follower.current());
        self.journal.push(point);
    }

    /// Whether the start has been lost to another phase, and the present point is near it.
    pub fn is_near_lost_start(&self) -> bool {
        let near = STEPS_TO_START * self.settings.max_step;
        let lost = self.origin.as_ref().filter(|_| !self.follower.state().has_start());
        lost.is_some_and(|origin| (origin.point.parameter() - self.parameter()).abs() < near)
    }
}
