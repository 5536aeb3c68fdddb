//! Whether a branch goes to infinity: its amplitude grows while its parameter stands still.
//!
//! Beside an undamped resonance at `λ*` the amplitude is `a = c / |λ - λ*|`: each further doubling takes half
//! the way that is left, so the path is endless and its parameter is not. The walk ends where
//!
//! - the amplitude has grown by [`GROWTH`] while the parameter moved by no more than [`STILL`] of itself
//!   ([`OF_RANGE`] of the range, if that is less), which leaves it nearer to `λ*` than a fifth of that, and
//! - nothing is ahead that could turn it: every element is linear beyond its outermost level, and moves
//!   [`BEYOND`] times as far as that; else
//! - the amplitude has grown by [`FOR_ANY`], since an element that does not take part in the growth is never
//!   reached.
//!
//! At a part of an undamped eigenfrequency nothing resonates, but the mode vibrates freely besides: orbits of
//! every amplitude and phase belong to one frequency, and a walk among them makes no progress. It ends where
//! the last points have the same parameter to rounding, and a mode has such a frequency. A branch with
//! contacts may lead there, too, to free vibrations that just touch: so touches do not count here, since what
//! presses would change the parameter.
//!
//! Where nothing takes energy out of the motion, a branch may climb at a part of the frequency with which the
//! structure vibrates in contact: the slope there goes like a power of the amplitude, and the parameter never
//! stands still. Such a walk goes on until no step is short enough. If the motion at each element then goes
//! [`BEYOND`] times as far as its gap, nothing bounds it either.
//!
//! With a damping ratio `ζ` the amplitude ends at `λ*/(2 ζ)` of that slope, so that ratios below some 1e-8
//! count as none. A fold is no such place: `λ - λ_f` goes with the square of the change of the amplitude
//! there. Amplitudes are sizes of the motion (`size.rs`), looked at where units are.

use hammerbeam_motion::{Law, LocalElement, System};
use hammerbeam_path::Node;

use super::orbit_path::OrbitPath;
use crate::{
    ResonantMode, StopReason,
    free_vibration::{self, is_damped},
};

/// Growth of the amplitude at a parameter that stands still.
const GROWTH: f64 = 8.0;
/// The same where something is ahead that may turn the path.
const FOR_ANY: f64 = 1e12;
/// Change of the parameter, relative to it, up to which it stands still.
const STILL: f64 = 1e-7;
/// The same, relative to the range.
const OF_RANGE: f64 = 1e-4;
/// An element is linear for all that follows where its motion goes so many times beyond its levels.
const BEYOND: f64 = 1e3;
/// Change of the parameter, relative to it, up to which points have the same one.
const SAME: f64 = 1e-13;

/// Where the parameter came to a stand: the least amplitude since, and the parameter there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Growth {
    pub amplitude: f64,
    pub parameter: f64,
}

impl Growth {
    /// Notes an amplitude; by how much it has grown since the parameter stands still.
    fn note(&mut self, amplitude: f64, parameter: f64, still: f64) -> f64 {
        if amplitude <= self.amplitude || (parameter - self.parameter).abs() > still || self.amplitude <= 0.0
        {
            *self = Self { amplitude, parameter };
        }
        amplitude / self.amplitude
    }

    /// Why the walk ends, if its present orbit belongs to a branch that goes to infinity.
    ///
    /// * `size`: of the orbit [kg^1/2 m/s].
    /// * `touches`: of each contact at the row before.
    pub fn end_of(&mut self, path: &mut OrbitPath, size: f64, touches: &[u32]) -> Option<StopReason> {
        let parameter = path.parameter();
        let (low, high) = path.range;
        let of_itself = STILL * path.problem.parameter_size(&path.current().point);
        let still = of_itself.min(OF_RANGE * (high - low));
        let growth = self.note(size, parameter, still);
        let unbounded = growth >= FOR_ANY || (growth >= GROWTH && is_beyond_all_levels(path));
        if unbounded {
            let touches_nothing = touches.iter().all(|&touches| touches == 0);
            let mode = free_mode(path).filter(|_| touches_nothing);
            return Some(end_at_mode(path, parameter, mode));
        }
        let mode = free_mode(path).filter(|_| stands_still(path))?;
        Some(end_at_mode(path, parameter, Some(mode)))
    }
}

/// Why a walk ends where the amplitude may be any: a mode that vibrates freely there, unless it is driven.
pub(super) fn end_at_mode(path: &OrbitPath, place: f64, mode: Option<ResonantMode>) -> StopReason {
    let driving_hz = path.problem.frequency(&path.follower.current().point);
    let is_driven = || free_vibration::resonance(path.problem.system(), driving_hz).is_some();
    match mode {
        Some(mode) if !is_driven() => StopReason::FreeVibration { place, mode },
        mode => StopReason::Unbounded { place, mode },
    }
}

/// Whether the last points all have the same parameter.
fn stands_still(path: &OrbitPath) -> bool {
    let history = &path.follower.state().history;
    let parameter = |point: &[f64]| point.last().copied().unwrap_or(f64::NAN);
    let (present, size) = (path.parameter(), path.problem.parameter_size(&path.current().point));
    let is_same = |node: &Node| (parameter(&node.point) - present).abs() <= SAME * size;
    history.used == history.nodes.len() && history.nodes.iter().all(is_same)
}

/// Whether every element is linear for all that follows.
fn is_beyond_all_levels(path: &mut OrbitPath) -> bool {
    let elements = path.problem.system().elements();
    let level = |element: &LocalElement| Some((element.shape.clone(), element.law.linear_beyond()?));
    let Some(levels) = elements.iter().map(level).collect::<Option<Vec<(Vec<f64>, f64)>>>() else {
        return false;
    };
    goes_beyond(path, &levels).is_some_and(|least| least >= BEYOND)
}

/// How many times as far as its level the motion goes along each shape, the least of them; infinite where
/// none is above zero. `None` if the motion cannot be computed.
fn goes_beyond(path: &mut OrbitPath, levels: &[(Vec<f64>, f64)]) -> Option<f64> {
    path.of_present(|orbit, integrator, _| {
        let mut least = f64::INFINITY;
        // Supports move as before, and do not count beside motion that grows.
        for (shape, level) in levels.iter().filter(|(_, level)| *level > 0.0) {
            least = least.min(orbit.largest_along(integrator, shape)? / level);
        }
        Ok(least)
    })
}

/// Whether the motion goes [`BEYOND`] times as far as the gap of each element.
pub(super) fn is_far_beyond_gaps(path: &mut OrbitPath) -> bool {
    let gap = |element: &LocalElement| Some((element.shape.clone(), element.law.gap()?));
    let gaps: Vec<(Vec<f64>, f64)> = path.problem.system().elements().iter().filter_map(gap).collect();
    goes_beyond(path, &gaps).is_some_and(|least| least.is_finite() && least >= BEYOND)
}

/// Whether nothing takes energy out of any motion.
pub(super) fn has_no_losses(system: &System) -> bool {
    let loses = |law: &Law| {
        let gives_less = law.rigid().is_some_and(|stop| stop.restitution() < 1.0);
        gives_less || law.depends_on_velocity() || law.remembers_impact()
    };
    let is_damped = (0..system.dof()).any(|mode| is_damped(system, mode));
    !is_damped && !system.elements().iter().any(|element| loses(&element.law))
}

/// The undamped mode whose free vibration repeats with the present orbit where no contact is closed.
pub(super) fn free_mode(path: &OrbitPath) -> Option<ResonantMode> {
    let frequency_hz = path.problem.frequency(&path.follower.current().point);
    let base_hz = frequency_hz / f64::from(path.problem.period_multiple());
    free_vibration::resonant_mode(path.problem.system(), base_hz)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Growth at the end of a history of amplitudes and parameters.
    fn growth(history: impl Iterator<Item = (f64, f64)>) -> f64 {
        let mut growth = Growth::default();
        history.map(|(amplitude, parameter)| growth.note(amplitude, parameter, 1e-7)).last().unwrap()
    }

    #[test]
    fn beside_a_pole_the_parameter_stands_still_within_a_fifth_of_its_resolution() {
        let pole = |distance: f64| (1.0 / distance, 1.0 - distance);
        let steps = |last: f64| (0..).map(|k| 0.9f64.powi(k)).take_while(move |d| *d > last);
        assert!(growth(steps(1e-7).map(pole)) < GROWTH);
        assert!(growth(steps(1e-9).map(pole)) > GROWTH);
    }

    #[test]
    fn at_a_fold_and_on_the_way_down_nothing_grows() {
        let fold = (0..1000).map(|k| f64::from(k - 500) * 1e-3).map(|x| (x.exp(), 1.0 - 1e-2 * x * x));
        assert!(growth(fold) < 1.5);
        assert!(growth((0..100).map(|k| (0.5f64.powi(k), 1.0))) == 1.0);
    }
}
