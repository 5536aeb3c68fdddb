//! Whether a motion repeats: it is advanced period by period until it does, or until patience ends.
//!
//! A motion repeats after n periods if its state comes back to within [`REPEATED`] of its size, both in the scales of the map. A motion that
//! creeps alternately towards an orbit of period m comes back after 2m first; where the state after m periods is close too, it is given
//! time for as long as it still comes closer.

use std::collections::VecDeque;

use crate::{AttractorError, SectionMap};

/// Distance, relative to the motion, at which it counts as having repeated.
const REPEATED: f64 = 1e-8;
/// Distance after half the period below which the motion may be creeping to half the period.
const CREEPING: f64 = 1e-2;
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
/// * `arrived`: asked after every period with the states so far, the newest last, at most `patience.longest + 1` of them; the motion ends when it says true.
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
        let half = if n.is_multiple_of(2) { back(n / 2) } else { f64::INFINITY };
        if half < CREEPING && creeping.is_none_or(|(_, before)| half < 0.99 * before) {
            creeping = Some((period, half));
            continue;
        }
        states.drain(..states.len() - n);
        return Ok(Settled::Repeats(states.into()));
    }
    Ok(Settled::Restless(states.pop_back().unwrap_or_default()))
}

/// [`settle_unless`], without anything known.
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
