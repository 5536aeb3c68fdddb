//! What becomes of each measured point.

use hammerbeam_signal::{
    MeasuredQuantity,
    points::{MeasuredKind, MeasuredPoint},
};

use super::{Curves, Hit, Shift, curve, fit::period_of};

/// A branch, and the point over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// Where the branch is met.
    pub hit: Hit,
    /// Natural logarithm of the shifted value over that of the branch.
    pub difference: f64,
}

/// The verdict on a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// A stable branch of its period explains it.
    Explained,
    /// The nearest stable branch of its period is too far off.
    TooFar,
    /// A branch of its period meets the frequency, but is unstable there.
    OnlyUnstable {
        /// The nearest frequency at which a stable one of the period exists [Hz].
        nearest_hz: Option<f64>,
    },
    /// No branch of its period meets the frequency.
    NoBranch {
        /// The nearest frequency at which there is one [Hz].
        nearest_hz: Option<f64>,
    },
    /// Stable branches of its period are without contact there, so that their force is 0.
    NoContact {
        /// The nearest frequency at which there is one with contact [Hz].
        nearest_hz: Option<f64>,
    },
    /// It does not repeat, so that no branch is compared.
    Aperiodic,
    /// The measurement does not show what it is.
    Doubtful,
}

impl Verdict {
    /// A word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::TooFar => "too-far",
            Self::OnlyUnstable { .. } => "only-unstable",
            Self::NoBranch { .. } => "no-branch",
            Self::NoContact { .. } => "no-contact",
            Self::Aperiodic => "aperiodic",
            Self::Doubtful => "doubtful",
        }
    }

    /// Whether the point is periodic and no branch explains it.
    #[must_use]
    pub const fn is_unexplained(self) -> bool {
        matches!(
            self,
            Self::TooFar | Self::OnlyUnstable { .. } | Self::NoBranch { .. } | Self::NoContact { .. }
        )
    }

    /// Where no stable branch of the period is there: the nearest frequency that has one [Hz].
    #[must_use]
    pub const fn nearest_hz(self) -> Option<f64> {
        match self {
            Self::OnlyUnstable { nearest_hz }
            | Self::NoBranch { nearest_hz }
            | Self::NoContact { nearest_hz } => nearest_hz,
            _ => None,
        }
    }
}

/// A measured point and what it is held against.
#[derive(Debug, Clone, PartialEq)]
pub struct PointOutcome {
    /// The point.
    pub point: MeasuredPoint,
    /// Its value.
    pub value: f64,
    /// Shifted frequency [Hz],
    pub shifted_hz: f64,
    /// and shifted value.
    pub shifted_value: f64,
    /// The nearest stable branch of its period; of points that do not repeat, and where there is none, the
    /// nearest branch of any kind.
    pub nearest: Option<Match>,
    /// Period multiples of the stable solutions at the shifted frequency, rising, each once.
    pub stable_periods: Vec<u32>,
    /// The verdict.
    pub verdict: Verdict,
}

pub(super) fn judge(
    point: &MeasuredPoint,
    curves: &Curves,
    quantity: MeasuredQuantity,
    shift: Shift,
    reach: f64,
) -> PointOutcome {
    let value = point.maxima.of(quantity).unwrap_or(f64::NAN);
    let (shifted_hz, shifted_value) =
        (shift.frequency.apply(point.frequency_hz), shift.amplitude_factor * value);
    let matched = |hit: Hit| Match { hit, difference: (shifted_value / hit.value).ln() };
    let hits = curves.at(shifted_hz, None);
    let any = || curve::nearest(hits.iter().copied(), shifted_value).map(matched);
    let mut stable_periods: Vec<u32> =
        hits.iter().filter(|hit| hit.stable).map(|hit| hit.period_multiple).collect();
    stable_periods.sort_unstable();
    stable_periods.dedup();
    let outcome = |nearest, verdict| PointOutcome {
        point: point.clone(),
        value,
        shifted_hz,
        shifted_value,
        nearest,
        stable_periods,
        verdict,
    };
    let (nearest, verdict) = match period_of(point.kind) {
        None if point.kind == MeasuredKind::Doubtful => (any(), Verdict::Doubtful),
        None => (any(), Verdict::Aperiodic),
        Some(period) => match curves.nearest_stable(shifted_hz, period, shifted_value).map(matched) {
            Some(found) if found.difference.abs() <= reach => (Some(found), Verdict::Explained),
            Some(found) => (Some(found), Verdict::TooFar),
            None => {
                let nearest_hz = curves.nearest_frequency(shifted_hz, period);
                let wanted = |hit: &Hit| period.is_none_or(|period| period == hit.period_multiple);
                let unstable = hits.iter().copied().filter(wanted);
                if curves.rests(shifted_hz, period) {
                    return outcome(any(), Verdict::NoContact { nearest_hz });
                }
                match curve::nearest(unstable, shifted_value).map(matched) {
                    Some(found) => (Some(found), Verdict::OnlyUnstable { nearest_hz }),
                    None => (any(), Verdict::NoBranch { nearest_hz }),
                }
            }
        },
    };
    outcome(nearest, verdict)
}
