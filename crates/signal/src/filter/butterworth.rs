//! Design of Butterworth filters.
//!
//! Poles of the analogue low-pass filter with cut-off 1: `p_k = exp(i pi (2k + n + 1) / (2n))`, `k = 0 ..
//! n-1`. With `c = tan(pi f_c / f_s)`:
//!
//! | band | poles in s | zeros in z |
//! |---|---|---|
//! | low-pass | `c p` | `n` at -1 |
//! | high-pass | `c / p` | `n` at 1 |
//! | band-pass | both roots of `s² - (c₂ - c₁) p s + c₁ c₂ = 0` | `n` at -1, `n` at 1 |
//!
//! then `z = (1 + s)/(1 - s)`, of which only `1 - z = -2 s/(1 - s)` is computed, since poles may lie close to
//! one. The gain is one at zero, at half the sampling rate, or in the middle of the band, `s = i sqrt(c₁
//! c₂)`.

use std::{cmp::Ordering, f64::consts::PI};

use realfft::num_complex::Complex;

use super::sections::{DigitalFilter, SecondOrderSection};
use crate::error::{SignalError, ensure};

/// Highest order; higher ones have no practical use.
const HIGHEST_ORDER: usize = 32;

/// Frequencies that pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Band {
    /// Below a frequency.
    LowPass {
        /// Cut-off, at half the power [Hz].
        cut_off_hz: f64,
    },
    /// Above a frequency.
    HighPass {
        /// Cut-off, at half the power [Hz].
        cut_off_hz: f64,
    },
    /// Between two frequencies.
    BandPass {
        /// Lower cut-off [Hz].
        low_hz: f64,
        /// Upper cut-off [Hz].
        high_hz: f64,
    },
}

/// Designs a filter.
///
/// * `order`: order of the low-pass prototype, 1 to 32; a band-pass filter has twice as many poles.
/// * `sampling_rate_hz`: sampling rate of the series to be filtered [Hz].
///
/// # Errors
/// [`SignalError::Input`]: the order, or a cut-off that is not between 0 and half the sampling rate.
pub fn butterworth(order: usize, band: Band, sampling_rate_hz: f64) -> Result<DigitalFilter, SignalError> {
    let orders = format!("a whole number from 1 to {HIGHEST_ORDER}");
    ensure("the order of the filter", order as f64, orders, (1..=HIGHEST_ORDER).contains(&order))?;
    let half = sampling_rate_hz / 2.0;
    let warped = |what: &'static str, frequency: f64| {
        let allowed = format!("more than 0 and less than half the sampling rate, {half} Hz");
        ensure(what, frequency, allowed, frequency > 0.0 && frequency < half)?;
        Ok::<f64, SignalError>((PI * frequency / sampling_rate_hz).tan())
    };
    let prototype =
        (0..order).map(|k| Complex::from_polar(1.0, PI * (2 * k + order + 1) as f64 / (2 * order) as f64));
    let one = Complex::new(1.0, 0.0);
    let (poles, zeros, reference) = match band {
        Band::LowPass { cut_off_hz } => {
            let c = warped("the cut-off of the low-pass filter", cut_off_hz)?;
            (prototype.map(|p| p * c).collect::<Vec<_>>(), Zeros::Low, one)
        }
        Band::HighPass { cut_off_hz } => {
            let c = warped("the cut-off of the high-pass filter", cut_off_hz)?;
            (prototype.map(|p| c / p).collect(), Zeros::High, -one)
        }
        Band::BandPass { low_hz, high_hz } => {
            let low = warped("the lower cut-off of the band-pass filter", low_hz)?;
            let high = warped("the upper cut-off of the band-pass filter", high_hz)?;
            ensure(
                "the upper cut-off",
                high_hz,
                format!("more than the lower one, {low_hz} Hz"),
                high > low,
            )?;
            let roots = prototype.flat_map(|p| {
                let half = p * (high - low) / 2.0;
                let root = (half * half - low * high).sqrt();
                // The larger root without cancellation; the product of both is known.
                let larger = if (half.conj() * root).re >= 0.0 { half + root } else { half - root };
                [larger, low * high / larger]
            });
            let centre = Complex::new(0.0, (low * high).sqrt());
            (roots.collect(), Zeros::Both, (one + centre) / (one - centre))
        }
    };
    // Distances of the poles from one, 1 - z.
    let poles: Vec<Complex<f64>> = poles.into_iter().map(|s| -2.0 * s / (one - s)).collect();
    Ok(with_unit_gain(&poles, zeros, reference))
}

/// Location of the zeros of a filter: -1, 1, or half of them at each.
#[derive(Clone, Copy)]
enum Zeros {
    Low,
    High,
    Both,
}

/// One or two poles of a section, `d² + a1 d + a2` in `d = z - 1`; a single pole is `d + a2`.
struct SectionPoles {
    a: [f64; 2],
    /// Angle of the pole with positive imaginary part; `None` for real poles.
    angle: Option<f64>,
    /// Modulus of a single pole, or the root of the product of two moduli.
    modulus: f64,
    is_single: bool,
}

/// Poles grouped into sections, given by their distances from one. A tiny imaginary part is rounding of a
/// real pole.
fn grouped(poles: &[Complex<f64>]) -> Vec<SectionPoles> {
    let is_real = |p: &Complex<f64>| p.im.abs() < 1e-12 * p.norm().max(1e-300);
    let pair = |p: &Complex<f64>| {
        let z = Complex::new(1.0, 0.0) - p;
        SectionPoles {
            a: [2.0 * p.re, p.norm_sqr()],
            angle: Some(z.arg()),
            modulus: z.norm(),
            is_single: false,
        }
    };
    let mut real: Vec<f64> = poles.iter().filter(|p| is_real(p)).map(|p| p.re).collect();
    real.sort_by(|one, other| other.total_cmp(one));
    let of_real = |pair: &[f64]| {
        let is_single = pair.len() == 1;
        let a = if is_single { [0.0, pair[0]] } else { [pair.iter().sum(), pair.iter().product()] };
        let product: f64 = pair.iter().map(|p| (1.0 - p).abs()).product();
        SectionPoles { a, angle: None, modulus: if is_single { product } else { product.sqrt() }, is_single }
    };
    let complex = poles.iter().filter(|p| !is_real(p) && p.im < 0.0);
    complex.map(pair).chain(real.chunks(2).map(of_real)).collect()
}

/// Numerators in powers of `z - 1`: both zeros at -1, both at 1, one at each.
const BOTH_LOW: [f64; 3] = [1.0, 4.0, 4.0];
const BOTH_HIGH: [f64; 3] = [1.0, 0.0, 0.0];
const ONE_EACH: [f64; 3] = [1.0, 2.0, 0.0];

/// A filter with unit gain at a reference: sections ordered by their poles, those closest to the unit circle
/// last, so that the sharpest resonance acts on an already filtered signal.
///
/// The zeros of a band-pass filter are paired with the nearest poles: two zeros at 1 with poles of the lower
/// edge, two at -1 with poles of the upper edge, one of each with a pole left in the middle. Otherwise, if
/// the upper edge is far higher, signals reach sharp poles at the lower edge almost unattenuated, and
/// rounding is a thousand times larger.
fn with_unit_gain(poles: &[Complex<f64>], zeros: Zeros, reference: Complex<f64>) -> DigitalFilter {
    let mut groups = grouped(poles);
    groups.sort_by(|one, other| one.angle.unwrap_or(0.0).total_cmp(&other.angle.unwrap_or(0.0)));
    let complex = groups.iter().filter(|group| group.angle.is_some()).count();
    let mut number = 0;
    let mut numerator = |group: &SectionPoles| match (zeros, group.is_single) {
        (Zeros::Low, false) => BOTH_LOW,
        (Zeros::Low, true) => [0.0, 1.0, 2.0],
        (Zeros::High, false) => BOTH_HIGH,
        (Zeros::High, true) => [0.0, 1.0, 0.0],
        (Zeros::Both, _) if group.angle.is_none() => ONE_EACH,
        (Zeros::Both, _) => {
            number += 1;
            match (2 * number).cmp(&(complex + 1)) {
                Ordering::Less => BOTH_HIGH,
                Ordering::Equal => ONE_EACH,
                Ordering::Greater => BOTH_LOW,
            }
        }
    };
    let mut sections: Vec<(f64, SecondOrderSection)> = groups
        .iter()
        .map(|group| {
            let (numerator, denominator) = (numerator(group), group.a);
            (group.modulus, SecondOrderSection { numerator, denominator, is_first_order: group.is_single })
        })
        .collect();
    sections.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut sections: Vec<SecondOrderSection> = sections.into_iter().map(|(_, section)| section).collect();
    let gain: f64 = sections.iter().map(|section| section.response(reference).norm()).product();
    sections[0].numerator.iter_mut().for_each(|value| *value /= gain);
    DigitalFilter::new(sections)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_power_remains_at_the_cut_off_and_the_slope_follows_the_order() {
        for order in [1, 2, 3, 4, 7, 10] {
            let filter = butterworth(order, Band::LowPass { cut_off_hz: 850.0 }, 1e5).unwrap();
            assert!((filter.gain(850.0, 1e5) - 0.5_f64.sqrt()).abs() < 1e-9, "order {order}");
            // The bilinear formula, |H|² = 1 / (1 + (tan/tan_c)^2n), is exact.
            let ratio = (PI * 0.02).tan() / (PI * 0.0085).tan();
            let expected = (1.0 + ratio.powi(2 * order as i32)).sqrt().recip();
            assert!((filter.gain(2000.0, 1e5) / expected - 1.0).abs() < 1e-7, "order {order}");
        }
    }

    #[test]
    fn high_pass_and_band_pass_have_their_cut_offs() {
        let filter = butterworth(3, Band::HighPass { cut_off_hz: 40.0 }, 1000.0).unwrap();
        assert!((filter.gain(40.0, 1000.0) - 0.5_f64.sqrt()).abs() < 1e-12);
        assert!((filter.gain(500.0, 1000.0) - 1.0).abs() < 1e-12 && filter.gain(0.0, 1000.0) < 1e-12);
        for (low_hz, high_hz) in [(40.0, 60.0), (5.0, 400.0)] {
            let filter = butterworth(3, Band::BandPass { low_hz, high_hz }, 1000.0).unwrap();
            for frequency in [low_hz, high_hz] {
                assert!((filter.gain(frequency, 1000.0) - 0.5_f64.sqrt()).abs() < 1e-12, "{frequency} Hz");
            }
        }
    }

    #[test]
    fn cut_off_beyond_half_the_sampling_rate_is_refused() {
        let refused = butterworth(4, Band::LowPass { cut_off_hz: 850.0 }, 1600.0).unwrap_err().to_string();
        assert!(
            refused.contains("850") && refused.contains("less than half the sampling rate, 800 Hz"),
            "{refused}"
        );
        assert!(butterworth(0, Band::LowPass { cut_off_hz: 1.0 }, 10.0).is_err());
        assert!(butterworth(2, Band::BandPass { low_hz: 3.0, high_hz: 2.0 }, 10.0).is_err());
    }
}
