//! The alignment of one waveform with another.

use std::f64::consts::TAU;

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
};

/// Allowed shifts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shifts {
    /// All shifts.
    Any,
    /// Shifts near whole multiples of a period.
    NearWhole {
        /// Samples of a period.
        period: usize,
        /// Largest distance from a multiple [samples].
        most: f64,
    },
}

impl Shifts {
    /// Signed distance from the nearest multiple of a period.
    fn distance_from_whole(period: usize, shift: f64) -> f64 {
        let period = period as f64;
        shift - (shift / period).round() * period
    }

    fn allows(self, shift: f64) -> bool {
        match self {
            Self::Any => true,
            Self::NearWhole { period, most } => Self::distance_from_whole(period, shift).abs() <= most + 1e-9,
        }
    }

    /// The interval of allowed shifts within one sample of an allowed one.
    fn around(self, best: f64) -> (f64, f64) {
        match self {
            Self::Any => (best - 1.0, best + 1.0),
            Self::NearWhole { period, most } => {
                let whole = best - Self::distance_from_whole(period, best);
                ((best - 1.0).max(whole - most), (best + 1.0).min(whole + most))
            }
        }
    }

    fn check(self) -> Result<(), SignalError> {
        let Self::NearWhole { period, most } = self else { return Ok(()) };
        ensure("the samples of a period", period as f64, "at least 1", period > 0)?;
        ensure("the largest distance of a shift from whole periods", most, "at least 0", most >= 0.0)
    }
}

/// The alignment of two waveforms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// Delay of the second one in samples, from 0 to less than its length.
    pub shift: f64,
    /// Correlation of both about their means with this delay.
    pub correlation: f64,
    /// Least-squares factor on the first one to match the second; negative for a mirror image.
    pub factor: f64,
    /// Root mean squares of both about their means.
    pub sizes: (f64, f64),
}

impl Alignment {
    /// Root mean square of the difference, with a factor on the first one, over the root mean square of the
    /// second.
    #[must_use]
    pub fn residual(&self, factor: f64) -> f64 {
        let (a, b) = self.sizes;
        let ratio = factor * a / b;
        (ratio * ratio - 2.0 * ratio * self.correlation + 1.0).max(0.0).sqrt()
    }
}

/// Aligns the second waveform with the first.
///
/// # Errors
/// [`SignalError::Input`] if the lengths differ, [`SignalError::TooShort`], [`SignalError::NotFinite`],
/// [`SignalError::Constant`] if one of them is constant.
pub fn align(first: &[f64], second: &[f64], shifts: Shifts) -> Result<Alignment, SignalError> {
    for series in [first, second] {
        ensure_series("laying one waveform over another", series, 4)?;
    }
    shifts.check()?;
    let length = first.len();
    let allowed = format!("the {length} of the other one");
    ensure("the number of samples of a waveform", second.len() as f64, allowed, second.len() == length)?;
    let (a, b) = (forward(first.to_vec()), forward(second.to_vec()));
    let lines = || 1..length.div_ceil(2);
    let square = |of: &[Complex<f64>]| lines().map(|k| 2.0 * of[k].norm_sqr()).sum::<f64>() / length as f64;
    let (aa, bb) = (square(&a), square(&b));
    // The rounding of a constant is not a motion.
    let moves = |square: f64, of: &[Complex<f64>]| square > 1e-28 * of[0].norm_sqr() / length as f64;
    if aa <= 0.0 || bb <= 0.0 || !moves(aa, &a) || !moves(bb, &b) {
        return Err(SignalError::Constant);
    }
    let mut cross = vec![Complex::new(0.0, 0.0); a.len()];
    lines().for_each(|k| cross[k] = a[k] * b[k].conj());
    let products = backward(cross.clone(), length);
    let allowed = (0..length).filter(|shift| shifts.allows(*shift as f64));
    let best =
        allowed.max_by(|&i, &j| products[i].total_cmp(&products[j])).expect("a shift of 0 is allowed always");
    let (shift, product) = refined(&cross, length, best as f64, shifts.around(best as f64));
    Ok(Alignment {
        // A shift that rounding makes negative would become a whole length.
        shift: shift.rem_euclid(length as f64) % length as f64,
        correlation: product / (aa * bb).sqrt(),
        factor: product / aa,
        sizes: ((aa / length as f64).sqrt(), (bb / length as f64).sqrt()),
    })
}

/// A waveform delayed by a number of samples, which need not be whole.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn delayed(series: &[f64], shift: f64) -> Result<Vec<f64>, SignalError> {
    ensure_series("delaying a waveform", series, 2)?;
    let length = series.len();
    let mut spectrum = forward(series.to_vec());
    for (k, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex::from_polar(1.0, -TAU * k as f64 * shift / length as f64);
    }
    Ok(backward(spectrum, length))
}

/// Largest number of Newton steps, and of halvings of a step.
const MAX_STEPS: usize = 20;
const MAX_HALVINGS: i32 = 20;
/// Step below which Newton's method ends [samples]: the remaining error is about 1e-12.
const LAST_STEP: f64 = 1e-6;

/// The product and its first and second derivative at a shift.
fn product(cross: &[Complex<f64>], length: usize, shift: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (k, line) in cross.iter().enumerate() {
        let w = TAU * k as f64 / length as f64;
        let turned = line * Complex::from_polar(2.0 / length as f64, w * shift);
        sums[0] += turned.re;
        sums[1] -= w * turned.im;
        sums[2] -= w * w * turned.re;
    }
    sums
}

/// Newton's method from the best sample, within an interval; steps are halved until the product grows.
///
/// # Returns
/// The shift and the product there.
fn refined(cross: &[Complex<f64>], length: usize, best: f64, (low, high): (f64, f64)) -> (f64, f64) {
    let at = |shift: f64| product(cross, length, shift);
    let (mut shift, mut here) = (best, at(best));
    for _ in 0..MAX_STEPS {
        let [value, slope, curvature] = here;
        // With a positive second derivative Newton's method has no maximum: go uphill by half a sample.
        let target = if curvature < 0.0 { shift - slope / curvature } else { shift + 0.5 * slope.signum() };
        let step = target.clamp(low, high) - shift;
        if step.abs() <= LAST_STEP {
            shift += step;
            return (shift, at(shift)[0]);
        }
        let shorter = (0..MAX_HALVINGS).map(|halvings| shift + step * 0.5_f64.powi(halvings));
        let Some(next) = shorter.map(|next| (next, at(next))).find(|(_, there)| there[0] > value) else {
            break;
        };
        (shift, here) = next;
    }
    (shift, here[0])
}
