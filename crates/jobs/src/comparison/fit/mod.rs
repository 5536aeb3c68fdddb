//! The shift of frequencies and the factor on values that bring points onto branches.

mod errors;
mod problem;
mod search;
mod used;

use hammerbeam_signal::{MeasuredQuantity, points::MeasuredPoint};

use super::{Curves, error::ComparisonError, shift::Shift};
use errors::covariance;
use problem::Problem;

pub use search::SecondMinimum;
pub use used::Residual;
pub(super) use used::{Used, period_of, residual};

/// What is given and need not be fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fixed {
    /// Given.
    Given(f64),
    /// To be fitted, between these ends; the lower one is below the upper one.
    Fitted {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
}

/// How a comparison is done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitSettings {
    /// Whether frequencies are shifted by an offset [Hz] instead of a factor.
    pub offset: bool,
    /// The factor or offset.
    pub frequency: Fixed,
    /// The factor on values.
    pub amplitude: Fixed,
    /// Ratio of values beyond which a branch does not explain a point.
    pub reach: f64,
}

/// Factors on frequencies that are tried usually.
const FACTORS: (f64, f64) = (0.85, 1.18);

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            offset: false,
            frequency: Fixed::Fitted { low: FACTORS.0, high: FACTORS.1 },
            amplitude: Fixed::Fitted { low: 0.05, high: 20.0 },
            reach: 1.5,
        }
    }
}

/// A fitted or given number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitEstimate {
    /// Its value.
    pub value: f64,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a number comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Origin {
    /// It was given.
    Given,
    /// It is where the sum of squares is smallest.
    Minimum {
        /// Its standard error; that of one number beside another that is at an end holds for that end.
        standard_error: f64,
    },
    /// It is at an end of what is tried, beyond which the sum of squares may fall: no minimum, so that there
    /// is no standard error.
    AtEnd {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
}

impl FitEstimate {
    /// Its standard error, if it has one.
    #[must_use]
    pub const fn standard_error(&self) -> Option<f64> {
        match self.origin {
            Origin::Minimum { standard_error } => Some(standard_error),
            Origin::Given | Origin::AtEnd { .. } => None,
        }
    }

    /// The ends of what is tried, if it is at one.
    #[must_use]
    pub const fn ends(&self) -> Option<(f64, f64)> {
        match self.origin {
            Origin::AtEnd { low, high } => Some((low, high)),
            Origin::Given | Origin::Minimum { .. } => None,
        }
    }
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Whether the shift of frequencies is an offset.
    pub offset: bool,
    /// Factor, or offset [Hz].
    pub frequency: FitEstimate,
    /// Factor on values.
    pub amplitude: FitEstimate,
    /// Points that the fit goes by.
    pub points: usize,
    /// Correlation of the errors of both numbers, where both are at their minimum.
    pub correlation: Option<f64>,
    /// Another shift that fits about as well, the best of those there are.
    pub second: Option<SecondMinimum>,
}

impl Fit {
    /// As a shift.
    #[must_use]
    pub fn shift(&self) -> Shift {
        Shift::new(self.offset, self.frequency.value, self.amplitude.value.ln())
    }
}

impl FitSettings {
    pub(super) fn check(&self) -> Result<(), ComparisonError> {
        let ensure = |what, found: f64, allowed, holds: bool| {
            if holds { Ok(()) } else { Err(ComparisonError::Input { what, found, allowed }) }
        };
        let more = self.reach > 1.0 && self.reach.is_finite();
        ensure("the reach", self.reach, "a factor of more than 1", more)?;
        for fixed in [self.frequency, self.amplitude] {
            if let Fixed::Fitted { low, high } = fixed {
                ensure("the upper end of what is tried", high, "above the lower one", low < high)?;
            }
        }
        for found in ends(self.amplitude) {
            ensure(
                "the amplitude factor",
                found,
                "finite and more than 0",
                found > 0.0 && found.is_finite(),
            )?;
        }
        for found in ends(self.frequency) {
            let holds = found.is_finite() && (self.offset || found > 0.0);
            ensure("the shift of the frequency", found, "finite, and more than 0 as a factor", holds)?;
        }
        Ok(())
    }
}

impl Fixed {
    /// Offsets that are tried usually: what the usual factors are at the median frequency of the points, -15
    /// to 18 % of it [Hz].
    #[must_use]
    pub fn offsets(points: &[MeasuredPoint]) -> Self {
        let middle = median(points.iter().map(|point| point.frequency_hz));
        Self::Fitted { low: (FACTORS.0 - 1.0) * middle, high: (FACTORS.1 - 1.0) * middle }
    }

    fn logarithm(self) -> Self {
        match self {
            Self::Given(value) => Self::Given(value.ln()),
            Self::Fitted { low, high } => Self::Fitted { low: low.ln(), high: high.ln() },
        }
    }
}

fn ends(fixed: Fixed) -> [f64; 2] {
    match fixed {
        Fixed::Given(value) => [value; 2],
        Fixed::Fitted { low, high } => [low, high],
    }
}

/// The middle of some numbers, 1 if there is none.
fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(1.0)
}

/// Logarithm of the ratio up to which a point pulls, over that up to which it is explained.
const PULL: f64 = 2.0;

pub(super) fn fit(
    used: &[Used],
    curves: &Curves,
    quantity: MeasuredQuantity,
    settings: &FitSettings,
) -> Result<Fit, ComparisonError> {
    let tried = [settings.frequency, settings.amplitude.logarithm()].map(ends);
    let unit = if settings.offset { median(used.iter().map(|point| point.frequency_hz)) } else { 1.0 };
    let problem =
        Problem { used, curves, offset: settings.offset, reach: PULL * settings.reach.ln(), unit, tried };
    let minima = problem.minima();
    let best = problem.best(&minima);
    let rows = problem.rows(best.place);
    let asked = problem.free().into_iter().filter(|free| *free).count();
    if asked > 0 && rows.len() <= asked {
        return Err(ComparisonError::TooFewPoints {
            quantity: quantity.word(),
            fitted: asked,
            measured: used.len(),
            met: residual(used, curves, problem.shift(best.place), problem.reach).met,
            near: rows.len(),
            ratio: settings.reach.powf(PULL),
        });
    }
    let at_end = problem.at_end(best.place);
    let free: [bool; 2] = std::array::from_fn(|k| problem.free()[k] && !at_end[k]);
    let covariance = covariance(&rows, free);
    let origin = |k: usize, fixed: Fixed, scale: f64| match fixed {
        Fixed::Given(_) => Origin::Given,
        Fixed::Fitted { low, high } if at_end[k] => Origin::AtEnd { low, high },
        Fixed::Fitted { .. } => Origin::Minimum { standard_error: scale * covariance[k][k].max(0.0).sqrt() },
    };
    let [frequency, logarithm] = best.place;
    let amplitude = logarithm.exp();
    Ok(Fit {
        offset: settings.offset,
        frequency: FitEstimate { value: frequency, origin: origin(0, settings.frequency, 1.0) },
        // The error of a logarithm is a relative one.
        amplitude: FitEstimate { value: amplitude, origin: origin(1, settings.amplitude, amplitude) },
        points: rows.len(),
        correlation: (free == [true; 2])
            .then(|| covariance[0][1] / (covariance[0][0] * covariance[1][1]).sqrt().max(f64::MIN_POSITIVE)),
        second: problem.second(best, &minima),
    })
}
