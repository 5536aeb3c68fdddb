//! Whether a motion repeats: it is advanced period by period until it does, or until patience ends.
//!
//! A motion repeats after n periods if its state comes back to within [`REPEATED`] of its size, both in the
//! scales of the map. A motion that creeps towards an orbit of period m, changing sides or turning about it,
//! comes back after a multiple of m first: twice where a multiplier is negative, thrice where a pair turns by
//! a third. Where the state is close after a divisor of n, too, it is given time for as long as it still
//! comes closer.

use std::collections::VecDeque;

use crate::{AttractorError, SectionMap};

/// Distance, relative to the motion, at which it counts as having repeated.
pub(crate) const REPEATED: f64 = 1e-8;
/// Distance after a part of the period below which the motion may be creeping to an orbit of that period.
const CREEPING: f64 = 1e-2;
/// Part of that distance to which it has to fall until the next look for the motion to be creeping still.
const CLOSER: f64 = 0.9999;
/// Periods after which a creeping motion is looked at again.
const LOOK_AGAIN: u64 = 64;

/// How long a motion may take to settle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patience {
    /// Periods that are run first, without looking.
    pub skipped: u64,
    /// Periods after those in which the motion is expected to repeat.
    pub periods: u64,
    /// Longest period looked for.
    pub longest: usize,
}

impl Default for Patience {
    fn default() -> Self {
        Self { skipped: 50, periods: 1000, longest: 32 }
    }
}

/// What has become of a motion.
#[derive(Debug, Clone, PartialEq)]
pub enum Settled {
    /// It repeats: its states at the start of each of its periods, the latest one last.
    Repeats(Vec<Vec<f64>>),
    /// It did not repeat: the state that it has come to.
    Restless(Vec<f64>),
}

impl Settled {
    /// The state that the motion has come to.
    #[must_use]
    pub fn state(&self) -> &[f64] {
        match self {
            Self::Repeats(states) => states.last().map_or(&[], Vec::as_slice),
            Self::Restless(state) => state,
        }
    }
}

/// Distance of two states relative to the size of the first, in the scales of a map.
#[must_use]
pub fn distance(scales: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    for ((a, b), scale) in a.iter().zip(b).zip(scales) {
        off += ((a - b) / scale).powi(2);
        size += (a / scale).powi(2);
    }
    (off / size.max(f64::MIN_POSITIVE)).sqrt()
}

/// Advances over one period of `parts` sections.
///
/// # Errors
/// The motion cannot be computed.
pub fn advance_period(
    map: &mut impl SectionMap,
    parts: u64,
    state: &[f64],
) -> Result<Vec<f64>, AttractorError> {
    let mut state = map.advance(0, state)?;
    for part in 1..parts {
        state = map.advance(part, &state)?;
    }
    Ok(state)
}

/// Advances a motion until it repeats.
///
/// * `parts`: sections in a period of the map.
/// * `arrived`: asked after every period with the states so far, the newest last, at most `patience.longest +
///   1` of them; the motion ends when it says true.
///
/// # Errors
/// The motion cannot be computed.
pub fn settle_unless(
    map: &mut impl SectionMap,
    parts: u64,
    state: &[f64],
    patience: Patience,
    mut arrived: impl FnMut(&VecDeque<Vec<f64>>) -> bool,
) -> Result<Settled, AttractorError> {
    let scales = map.scales();
    let mut states = VecDeque::from([state.to_vec()]);
    let mut creeping: Option<(u64, f64)> = None;
    for period in 0..patience.skipped + patience.periods {
        let next = advance_period(map, parts, &states[states.len() - 1])?;
        states.push_back(next);
        if states.len() > patience.longest + 1 {
            states.pop_front();
        }
        if arrived(&states) {
            break;
        }
        if period < patience.skipped || creeping.is_some_and(|(since, _)| period < since + LOOK_AGAIN) {
            continue;
        }
        let last = states.len() - 1;
        let back = |n: usize| distance(&scales, &states[last], &states[last - n]);
        let Some(n) = (1..=last).find(|&n| back(n) < REPEATED) else { continue };
        let shorter = (1..n).filter(|m| n.is_multiple_of(*m)).map(back).fold(f64::INFINITY, f64::min);
        if shorter < CREEPING && creeping.is_none_or(|(_, before)| shorter < CLOSER * before) {
            creeping = Some((period, shorter));
            continue;
        }
        states.drain(..states.len() - n);
        return Ok(Settled::Repeats(states.into()));
    }
    Ok(Settled::Restless(states.pop_back().unwrap_or_default()))
}

/// Advances a motion until it repeats, or until patience ends.
///
/// * `parts`: sections in a period of the map.
///
/// # Errors
/// The motion cannot be computed.
pub fn settle(
    map: &mut impl SectionMap,
    parts: u64,
    state: &[f64],
    patience: Patience,
) -> Result<Settled, AttractorError> {
    settle_unless(map, parts, state, patience, |_| false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StepMap;

    /// Turning by `turn` of a circle and shrinking in every step, towards the fixed point 0 of a map about
    /// (1, 1).
    fn spiral(turn: f64, shrink: f64) -> impl SectionMap {
        StepMap::new(2, move |z: &[f64]| {
            let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
            let (x, y) = (shrink * (z[0] - 1.0), shrink * (z[1] - 1.0));
            (vec![1.0 + cos * x - sin * y, 1.0 + sin * x + cos * y], faer::Mat::zeros(2, 2))
        })
    }

    #[test]
    fn motion_that_turns_about_an_orbit_has_the_period_of_the_orbit() {
        for turn in [0.5, 1.0 / 3.0, 0.25, 0.2, 0.5 + 1e-7] {
            let settled = settle(&mut spiral(turn, 0.97), 1, &[1.5, 0.7], Patience::default()).unwrap();
            let Settled::Repeats(states) = settled else { panic!("turn {turn}: it settles") };
            assert_eq!(states.len(), 1, "turn {turn}");
        }
    }
}
