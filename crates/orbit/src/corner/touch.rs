//! Touches of rigid stops that are near grazing: slow impacts, and turns just before a stop.

use hammerbeam_motion::{Stretch, exact::Trace};

use crate::shooting::ShootingProblem;

/// Looks for turns per excitation period.
const LOOKS: usize = 2000;
/// Largest speed of an impact that is gone within a reach, over the reach, both relative to the orbit; and
/// the square of the same ratio of a turn, which has the speed that its clearance for a depth would give it.
const FASTEST: f64 = 3.0;
const FASTEST_SQUARED: f64 = 5.0;

/// Share of the speed behind an impact without which it sticks.
const REBOUNDS: f64 = 0.5;

/// What a touch near grazing is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// An impact.
    Impact,
    /// A turn before the stop.
    Turn,
}

/// A touch near grazing.
#[derive(Debug, Clone)]
pub(super) struct Touch {
    pub element: usize,
    pub side: Side,
    /// From the phase at which the orbit begins, or within N cycles of it [cycles].
    pub phase: f64,
    /// Right before it, scaled.
    pub state: Vec<f64>,
    /// Relative to the orbit.
    pub speed: f64,
}

/// Touches that graze in one corner do so because they are alike: another stop in a symmetric orbit, or the
/// same one a period later. Beside it their speeds are equal, but for this factor.
const ALIKE: f64 = 1.5;
/// Speeds of turns below this are rounding, relative to the orbit: the root of the rounding of a
/// displacement.
const ROUNDED: f64 = 1e-7;
/// Phases that differ by less are the same [cycles].
const SAME_PHASE: f64 = 1e-3;

impl Touch {
    /// Whether both are the same touch of orbits of so many cycles.
    pub fn is_same(&self, other: &Self, cycles: f64) -> bool {
        let apart = (self.phase - other.phase) / cycles;
        self.element == other.element && cycles * (apart - apart.round()).abs() < SAME_PHASE
    }

    /// Whether the touches are whole excitation periods apart.
    pub fn repeats(&self, other: &Self) -> bool {
        let apart = self.phase - other.phase;
        self.element == other.element && (apart - apart.round()).abs() < SAME_PHASE
    }
}

/// What an element moves like in an orbit of the size of the scale: its largest speed.
pub(super) fn largest_speed(problem: &ShootingProblem, element: usize) -> f64 {
    let shape = &problem.system().elements()[element].shape;
    let velocities = &problem.scale().values()[shape.len()..];
    shape.iter().zip(velocities).map(|(shape, scale)| (shape * scale).abs()).sum()
}

/// Touches of the orbit of a point that may graze within a reach, the nearest to grazing first; `None` if its
/// motion cannot be computed.
pub(super) fn near_grazing(problem: &mut ShootingProblem, point: &[f64], reach: f64) -> Option<Vec<Touch>> {
    let frequency_hz = problem.frequency(point);
    let scales = problem.scale().values().to_vec();
    let mut touches = Vec::new();
    for (segment, node) in problem.nodes(point).into_iter().enumerate() {
        let stretch = problem.stretch(segment, frequency_hz);
        let looks = ((stretch.end - stretch.start) * LOOKS as f64).ceil() as usize;
        let phase = |k: usize| stretch.start + (stretch.end - stretch.start) * k as f64 / looks as f64;
        let phases: Vec<f64> = (0..=looks).map(phase).collect();
        let trace = problem.integrator().trace(&stretch, &node, &phases).ok()?;
        for contact in &trace.contacts {
            let (Some(touchdown), Some(jump)) = (&contact.begin, &contact.jump) else { continue };
            let phase = stretch.start + touchdown.time * frequency_hz;
            let [_, behind, acceleration] =
                problem.system().relative_motion(contact.element, frequency_hz, phase, &jump.state);
            let law = &problem.system().elements()[contact.element].law;
            let restitution = law.rigid().map_or(0.0, |stop| stop.restitution());
            // An impact without restitution leaves no speed; what is pressed on sticks.
            let leaves = if restitution > 0.0 {
                -behind > REBOUNDS * restitution * touchdown.velocity
            } else {
                acceleration < 0.0
            };
            if leaves {
                touches.push(Touch {
                    element: contact.element,
                    side: Side::Impact,
                    phase,
                    state: scaled(&touchdown.state, &scales),
                    speed: touchdown.velocity.abs() / largest_speed(problem, contact.element),
                });
            }
        }
        turns(problem, (&stretch, &phases), &trace, &mut touches);
    }
    touches.retain(|touch| match touch.side {
        Side::Impact => touch.speed <= FASTEST * reach,
        Side::Turn => touch.speed * touch.speed <= FASTEST_SQUARED * reach,
    });
    touches.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    Some(touches)
}

/// The touches that graze in a corner together with one, and that, by the point beside it without impacts:
/// they are turns there.
///
/// * `(element, phase)`: of the one that was solved for.
pub(super) fn at_grazing(
    problem: &mut ShootingProblem,
    beside: &[f64],
    (element, phase): (usize, f64),
) -> Option<Vec<Touch>> {
    problem.move_to(beside).ok()?;
    let cycles = f64::from(problem.period_multiple());
    let mut turns = near_grazing(problem, beside, f64::INFINITY)?;
    turns.retain(|touch| touch.side == Side::Turn);
    let solved = Touch { element, side: Side::Turn, phase, state: Vec::new(), speed: 0.0 };
    let same = turns.iter().filter(|touch| solved.is_same(touch, cycles)).map(|touch| touch.speed);
    let slowest = same.reduce(f64::min)?.max(ROUNDED);
    turns.retain(|touch| touch.speed <= ALIKE * slowest);
    Some(turns)
}

/// Turns towards rigid stops between samples of a motion.
fn turns(
    problem: &mut ShootingProblem,
    (stretch, phases): (&Stretch, &[f64]),
    trace: &Trace,
    touches: &mut Vec<Touch>,
) {
    let (system, scales) = (problem.system(), problem.scale().values().to_vec());
    let (frequency_hz, samples) = (stretch.frequency_hz, &trace.samples);
    let mut turns = Vec::new();
    // Across an impact the speed jumps from towards the stop to away from it, too, and what a stop held
    // leaves it with a speed that was zero.
    let is_touched = |element: usize, from: f64, to: f64| {
        let cycles = |seconds: f64| stretch.start + seconds * frequency_hz;
        trace.contacts.iter().any(|contact| {
            let ends = contact.end.map_or(stretch.end, cycles);
            contact.element == element && cycles(contact.since()) <= to && ends >= from
        })
    };
    for (element, of) in system.elements().iter().enumerate() {
        let Some(level) = of.law.rigid().map(|stop| stop.level()) else { continue };
        let speeds: Vec<f64> = (0..samples.len())
            .map(|k| {
                let velocities = &samples[k][of.shape.len()..];
                let own: f64 = of.shape.iter().zip(velocities).map(|(phi, v)| phi * v).sum();
                own + system.carried(&of.support_ratios, frequency_hz, phases[k])[1]
            })
            .collect();
        for k in (1..samples.len()).filter(|&k| speeds[k - 1] >= 0.0 && speeds[k] < 0.0) {
            let [_, after, acceleration] =
                system.relative_motion(element, frequency_hz, phases[k], &samples[k]);
            if acceleration >= 0.0 || is_touched(element, phases[k - 1], phases[k]) {
                continue;
            }
            let at = (phases[k] - after / acceleration * frequency_hz).max(phases[k - 1]);
            turns.push((k - 1, element, level, at));
        }
    }
    for (sample, element, level, at) in turns {
        let way = Stretch { frequency_hz, start: phases[sample], end: at };
        let Ok(state) = problem.integrator().advance(&way, &samples[sample]) else { continue };
        // A sample near the turn gives its clearance to the cube of the time in between: the turn itself is
        // asked.
        let [r, after, acceleration] = problem.system().relative_motion(element, frequency_hz, at, &state);
        let depth = after * after / (-2.0 * acceleration);
        let speed = (-2.0 * acceleration * (level - r - depth).max(0.0)).sqrt();
        touches.push(Touch {
            element,
            side: Side::Turn,
            phase: at,
            state: scaled(&state, &scales),
            speed: speed / largest_speed(problem, element),
        });
    }
}

fn scaled(state: &[f64], scales: &[f64]) -> Vec<f64> {
    state.iter().zip(scales).map(|(z, s)| z / s).collect()
}
