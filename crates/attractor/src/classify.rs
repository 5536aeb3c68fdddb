//! What kind of motion an attractor is: periodic, quasi-periodic, chaotic, or doubtful.
//!
//! A motion that repeats (`settle.rs`) is periodic. Of one that does not, two indicators are asked: the
//! largest exponent, and K of the 0-1 test on that entry of the state that moves most. With the largest
//! exponent `L` per period over N periods,
//!
//! - exponent: regular `-2/N <= L <= 10/N`, half width `<= 20/N`, not surely below zero; chaotic
//!   `L - half width > 10/N`; else undecided, or below: still settling
//! - 0-1 test: regular `K < 0.2`; chaotic `K > 0.8`; else undecided
//!
//! and, of a motion that both call regular, its returns over eight times as many periods (`returns.rs`): the
//! distance to the state n periods before, for every n up to the longest period looked for. It stays the same
//! on average where there is no period, and falls where the motion still settles to one. If it falls by a
//! fifth or more from the first quarter of these periods to the last, for any n, or for all n together by
//! about the same factor from each quarter to the next, the motion is still settling. Weak chaos in narrow
//! bands looks regular to both indicators as well: its exponent is below `10/N`, and its bands make lines in
//! its spectrum. So a motion is quasi-periodic only if it returns as on a torus: the closest return, after n
//! periods, is three times as far after `3 n` and is not rounding, and the last states lie between earlier
//! ones. The last states of a motion that creeps past an orbit are at the end of its way.
//!
//! (The tangent vectors of a regular motion without a period grow like N at most, so that `L` is about `ln
//! N/N`, and do not shrink. What they gain on one part of the torus they lose on another, so that the half
//! width is larger than what is left over; where it is not, and `L` is below zero with all of its interval,
//! the motion settles, however slowly.) Where both agree the motion is quasi-periodic or chaotic; where they
//! do not it is doubtful, with the reason. A motion whose largest exponent is below zero is on its way to a
//! periodic one: it is given time once more, and then called doubtful.

use crate::{
    AttractorError, Estimate, Lyapunov, LyapunovSettings, SectionMap,
    returns::{Returns, returns, settles},
    section::WATCHED_PERIODS,
    settle::{Patience, Settled, advance_period, settle},
    zero_one,
};

/// Bounds of K.
const REGULAR_BELOW: f64 = 0.2;
const CHAOTIC_ABOVE: f64 = 0.8;
/// What the exponent per period of a regular motion may be, times the number of periods.
const ZERO: f64 = 10.0;
/// What its half width may be, times the number of periods. A torus that stretches tangent vectors by e on
/// the way shows `1/n` in each of the 20 blocks of `n = N/20` periods, so that `10/N` is usual.
const WIDTH: f64 = 20.0;
/// The same below zero.
const SHRINKING: f64 = 2.0;
/// What both indicators call regular is followed for so many times as long: in the periods of the average a
/// motion that creeps past an orbit shows too little of its way, and a torus too little of itself.
const CONFIRMED: u64 = 7;
/// The high end of its interval below which it is surely negative, times the number of periods: rounding
/// makes 1e-13 of it.
const SURELY: f64 = 0.01;

/// How much is spent on a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// For settling.
    pub patience: Patience,
    /// Periods over which tangent vectors turn into their directions.
    pub aligning: u64,
    /// Periods over which exponents are averaged and the 0-1 test is taken.
    pub averaged: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { patience: Patience::default(), aligning: 50, averaged: 1000 }
    }
}

/// Kind of an attractor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// It repeats after that many periods.
    Periodic {
        /// In excitation periods.
        period: usize,
    },
    /// Regular and without a period.
    QuasiPeriodic,
    /// Neighbouring motions part exponentially.
    Chaotic,
    /// Neither regular nor chaotic for certain.
    Doubtful(MotionDoubt),
}

/// Why a motion is called doubtful.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionDoubt {
    /// One indicator says regular, the other chaotic.
    IndicatorsDisagree,
    /// The largest exponent is neither near zero nor surely above it.
    ExponentUndecided,
    /// K lies between the bounds.
    ZeroOneUndecided,
    /// Both indicators say regular, but the motion does not come back as on a torus.
    NotTurning,
    /// Neighbouring motions come closer, but it has not repeated yet, or only after more periods than were
    /// looked for.
    NotSettled,
}

impl Class {
    /// Name of the kind: `periodic`, `quasi-periodic`, `chaotic`, `doubtful`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Periodic { .. } => "periodic",
            Self::QuasiPeriodic => "quasi-periodic",
            Self::Chaotic => "chaotic",
            Self::Doubtful(_) => "doubtful",
        }
    }

    /// Period of a periodic motion, in excitation periods.
    #[must_use]
    pub fn period(self) -> Option<usize> {
        match self {
            Self::Periodic { period } => Some(period),
            _ => None,
        }
    }

    /// Why a doubtful motion is called so, in words.
    #[must_use]
    pub fn doubt(self) -> Option<&'static str> {
        match self {
            Self::Doubtful(doubt) => Some(doubt.reason()),
            _ => None,
        }
    }
}

/// `period 3`, or the name.
impl std::fmt::Display for Class {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Periodic { period } => formatter.pad(&format!("period {period}")),
            other => formatter.pad(other.name()),
        }
    }
}

impl MotionDoubt {
    /// Every doubt.
    pub const ALL: [Self; 5] = [
        Self::IndicatorsDisagree,
        Self::ExponentUndecided,
        Self::ZeroOneUndecided,
        Self::NotTurning,
        Self::NotSettled,
    ];

    /// In words.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::IndicatorsDisagree => "the exponent and the 0-1 test disagree",
            Self::ExponentUndecided => "the largest exponent is neither near zero nor surely above it",
            Self::ZeroOneUndecided => "the 0-1 test is undecided",
            Self::NotTurning => {
                "the exponent is near zero and the 0-1 test says regular, \
                but the motion does not come back as on a torus"
            }
            Self::NotSettled => "the motion has not settled, or its period is longer than those looked for",
        }
    }
}

/// A motion and its kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Classified {
    /// What it is.
    pub class: Class,
    /// States at the start of each period: all of a periodic orbit, the averaged ones of another motion.
    pub states: Vec<Vec<f64>>,
    /// Largest exponent over the unit of time, if it was needed.
    pub largest_exponent: Option<Estimate>,
    /// K of the 0-1 test, if it was needed.
    pub zero_one: Option<f64>,
}

/// Lets a motion settle and says what it is.
///
/// * `parts`: sections in a period of the map.
///
/// # Errors
/// [`AttractorError::NeverOpens`], or the motion cannot be computed.
pub fn classify(
    map: &mut impl SectionMap,
    parts: u64,
    state: &[f64],
    effort: &Effort,
) -> Result<Classified, AttractorError> {
    let mut state = match settle(map, parts, state, effort.patience)? {
        Settled::Repeats(states) => return periodic(map, states),
        Settled::Restless(state) => state,
    };
    let mut restless = examine(map, parts, &state, effort)?;
    if restless.class == Class::Doubtful(MotionDoubt::NotSettled) {
        state = restless.states.pop().unwrap_or(state);
        let once_more = Patience { skipped: 0, ..effort.patience };
        match settle(map, parts, &state, once_more)? {
            Settled::Repeats(states) => return periodic(map, states),
            Settled::Restless(state) => restless = examine(map, parts, &state, effort)?,
        }
    }
    Ok(restless)
}

/// A motion that has come back to the last of these states, one for each of its periods.
///
/// # Errors
/// [`AttractorError::NeverOpens`], or the motion cannot be computed.
pub(crate) fn periodic(
    map: &mut impl SectionMap,
    states: Vec<Vec<f64>>,
) -> Result<Classified, AttractorError> {
    let period = states.len();
    map.check_opens(&states[period - 1], period)?;
    Ok(Classified { class: Class::Periodic { period }, states, largest_exponent: None, zero_one: None })
}

/// Asks both indicators of a motion that does not repeat.
///
/// # Errors
/// [`AttractorError::NeverOpens`], or the motion cannot be computed.
pub fn examine(
    map: &mut impl SectionMap,
    parts: u64,
    state: &[f64],
    effort: &Effort,
) -> Result<Classified, AttractorError> {
    map.check_opens(state, WATCHED_PERIODS)?;
    let settings = LyapunovSettings { aligning: effort.aligning * parts, averaged: effort.averaged * parts };
    let mut average = Lyapunov::new(map, 0, state, settings)?;
    let mut states = Vec::new();
    while average.step(map)? {
        let sections = average.progress().0;
        if sections > settings.aligning && sections.is_multiple_of(parts) {
            states.push(average.state().to_vec());
        }
    }
    map.check_opens(average.state(), WATCHED_PERIODS)?;
    let spectrum = average.spectrum().expect("all blocks are whole");
    let largest = spectrum.exponents[0];
    let period = map.duration() * parts as f64;
    let zero_one = zero_one(&liveliest(&states, &map.scales()));
    let mut class = judge(largest, period, states.len(), zero_one);
    if class == Class::QuasiPeriodic {
        for _ in 0..CONFIRMED * effort.averaged {
            let state = advance_period(map, parts, states.last().unwrap_or(&Vec::new()))?;
            states.push(state);
        }
        class = judge_returns(&states, &map.scales(), effort.patience.longest);
        states.drain(..states.len() - effort.averaged as usize);
    }
    Ok(Classified { class, states, largest_exponent: Some(largest), zero_one })
}

/// What a motion is that both indicators call regular.
fn judge_returns(states: &[Vec<f64>], scales: &[f64], longest: usize) -> Class {
    if settles(states, scales, longest) {
        return Class::Doubtful(MotionDoubt::NotSettled);
    }
    match returns(states, scales) {
        Returns::Turning => Class::QuasiPeriodic,
        Returns::Creeping => Class::Doubtful(MotionDoubt::NotSettled),
        Returns::Elsewhere => Class::Doubtful(MotionDoubt::NotTurning),
    }
}

/// The entry of the states that moves most, in the scales.
fn liveliest(states: &[Vec<f64>], scales: &[f64]) -> Vec<f64> {
    let series = |i: usize| states.iter().map(move |state| state[i]);
    let range = |i: usize| {
        let (low, high) =
            series(i).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (high - low) / scales[i]
    };
    let best = (0..scales.len()).fold(0, |best, i| if range(i) > range(best) { i } else { best });
    series(best).collect()
}

fn judge(largest: Estimate, period: f64, periods: usize, zero_one: Option<f64>) -> Class {
    let zero = ZERO / periods as f64;
    let (value, low) = (largest.value * period, largest.low() * period);
    let surely_shrinks = largest.high() * period * (periods as f64) < -SURELY;
    if value < -SHRINKING / periods as f64 || surely_shrinks {
        return Class::Doubtful(MotionDoubt::NotSettled);
    }
    let known = largest.half_width * period <= WIDTH / periods as f64;
    let exponent =
        if value <= zero { Some(false).filter(|_| known) } else { Some(true).filter(|_| low > zero) };
    let test = match zero_one {
        Some(k) if k < REGULAR_BELOW => Some(false),
        Some(k) if k > CHAOTIC_ABOVE => Some(true),
        _ => None,
    };
    match (exponent, test) {
        (Some(false), Some(false)) => Class::QuasiPeriodic,
        (Some(true), Some(true)) => Class::Chaotic,
        (Some(_), Some(_)) => Class::Doubtful(MotionDoubt::IndicatorsDisagree),
        (None, _) => Class::Doubtful(MotionDoubt::ExponentUndecided),
        (_, None) => Class::Doubtful(MotionDoubt::ZeroOneUndecided),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indicators_that_disagree_make_a_motion_doubtful() {
        let largest = |value, half_width| Estimate { value, half_width };
        let judge = |value, half_width, k| judge(largest(value, half_width), 1.0, 1000, Some(k));
        assert_eq!(judge(0.3, 0.02, 0.99), Class::Chaotic);
        assert_eq!(judge(0.002, 0.001, 0.03), Class::QuasiPeriodic);
        assert_eq!(judge(0.3, 0.02, 0.05), Class::Doubtful(MotionDoubt::IndicatorsDisagree));
        assert_eq!(judge(0.002, 0.001, 0.95), Class::Doubtful(MotionDoubt::IndicatorsDisagree));
        assert_eq!(judge(0.03, 0.025, 0.95), Class::Doubtful(MotionDoubt::ExponentUndecided));
        assert_eq!(judge(0.003, 0.021, 0.03), Class::Doubtful(MotionDoubt::ExponentUndecided));
        assert_eq!(judge(0.3, 0.02, 0.5), Class::Doubtful(MotionDoubt::ZeroOneUndecided));
        assert_eq!(judge(-0.3, 0.02, 0.5), Class::Doubtful(MotionDoubt::NotSettled));
        assert_eq!(judge(-1e-4, 1e-3, 0.03), Class::QuasiPeriodic);
        assert_eq!(judge(-1e-4, 1e-5, 0.03), Class::Doubtful(MotionDoubt::NotSettled));
    }
}
