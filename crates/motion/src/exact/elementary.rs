//! Sines, cosines and exponentials of several numbers at once, without branches, so that the compiler makes
//! vectors of them ([`vectorised`](super::lanes::vectorised)).
//!
//! **Reduction** (Cody and Waite 1980, chapter 8). With the nearest multiple k of a quarter turn, `x = k pi/2
//! + r + t`, `|r| <= pi/4`. Of `pi/2 = A + B + C` the parts A and B have 33 bits each, so `k A` and `k B` are
//! exact up to `|k| < 2^20`, and so is `x - k A`. What r rounds is kept as the tail t, half a unit of r at
//! most. The same for the exponential with `ln 2 = A + B`, where `|k| < 2^11` and A has 40 bits.
//!
//! **Series.** With `w = 1 - r^2/2`,
//!
//! `sin(r + t) = r + (r^3 S(r^2) + t w)`, `cos(r + t) = w + ((1 - w - r^2/2) + (r^4 C(r^2) - r t))`,
//! `exp(r) = 1 + (r + r^2 E(r))`
//!
//! by Taylor up to `r^17`, `r^16` and `r^13`, `|r| <= ln(2)/2` in the last: what is left is below `8e-20`,
//! `3e-18` and `4e-18`, relative to the function.
//!
//! **Error.** The last sum rounds by half a unit in the last place, and what is added in it is less than a
//! third of the result and rounded a few times: the error is below one unit in the last place. The tests
//! measure it against the standard library, whose own error is as large.
//!
//! Beyond [`TURNING`] and [`DECAY`] the standard functions have to serve.

/// Largest angle in magnitude that the reduction serves [rad].
pub(crate) const TURNING: f64 = 1.6e6;
/// Largest exponent in magnitude that is served.
pub(crate) const DECAY: f64 = 700.0;

/// `1.5 2^52`: a number that is added to it is rounded to an integer, which stands in the lowest bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;
/// `pi/2`: 33 bits, the next 33 bits, the rest.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// `ln 2`: 40 bits, the rest.
const LN_2: [f64; 2] = [0.693_147_180_560_117_7, -1.723_944_452_561_483_5e-13];

/// `1/m!`.
const fn inverse_factorial(m: usize) -> f64 {
    let (mut factorial, mut k) = (1.0, 2);
    while k <= m {
        factorial *= k as f64;
        k += 1;
    }
    1.0 / factorial
}

/// `sign^k/(first + k step)!`, in ascending order.
const fn series<const N: usize>(first: usize, step: usize, sign: f64) -> [f64; N] {
    let (mut terms, mut k, mut factor) = ([0.0; N], 0, 1.0);
    while k < N {
        terms[k] = factor * inverse_factorial(first + k * step);
        factor *= sign;
        k += 1;
    }
    terms
}

/// Negative `S`.
const SINE: [f64; 8] = series(3, 2, -1.0);
/// `C`.
const COSINE: [f64; 7] = series(4, 2, -1.0);
/// `E`.
const EXPONENTIAL: [f64; 12] = series(2, 1, 1.0);

#[inline(always)]
fn horner<const T: usize>(terms: &[f64; T], x: f64) -> f64 {
    let mut sum = terms[T - 1];
    for m in (0..T - 1).rev() {
        sum = terms[m] + x * sum;
    }
    sum
}

/// Cosines and sines of angles up to [`TURNING`].
#[inline(always)]
pub(crate) fn cosines_and_sines<const N: usize>(angles: &[f64; N]) -> [[f64; N]; 2] {
    let (mut cosines, mut sines) = ([0.0; N], [0.0; N]);
    for i in 0..N {
        let rounded = angles[i] * std::f64::consts::FRAC_2_PI + ROUNDING;
        let (k, quadrant) = (rounded - ROUNDING, rounded.to_bits());
        let (coarse, fine) = (angles[i] - k * QUARTER[0], k * QUARTER[1]);
        let first = coarse - fine;
        let left = (coarse - first - fine) - k * QUARTER[2];
        let r = first + left;
        let tail = (first - r) + left;
        let square = r * r;
        let half = 0.5 * square;
        let lead = 1.0 - half;
        let sine = (r - (r * square * horner(&SINE, square) - tail * lead)).to_bits();
        let rest = (1.0 - lead - half) + (square * square * horner(&COSINE, square) - r * tail);
        let cosine = (lead + rest).to_bits();
        // Odd quadrants exchange the two; the second and third turn the sign of the sine, the first and
        // second that of the cosine.
        let exchange = 0_u64.wrapping_sub(quadrant & 1);
        let sign = [quadrant, quadrant.wrapping_add(1)].map(|bits| (bits & 2) << 62);
        sines[i] = f64::from_bits(((cosine & exchange) | (sine & !exchange)) ^ sign[0]);
        cosines[i] = f64::from_bits(((sine & exchange) | (cosine & !exchange)) ^ sign[1]);
    }
    [cosines, sines]
}

/// Exponentials of numbers up to [`DECAY`] in magnitude.
#[inline(always)]
pub(crate) fn exponentials<const N: usize>(exponents: &[f64; N]) -> [f64; N] {
    let mut values = [0.0; N];
    for i in 0..N {
        let rounded = exponents[i] * std::f64::consts::LOG2_E + ROUNDING;
        let k = rounded - ROUNDING;
        let r = (exponents[i] - k * LN_2[0]) - k * LN_2[1];
        let value = 1.0 + (r + r * r * horner(&EXPONENTIAL, r));
        // `2^k`: the integer stands in the lowest bits, whatever its sign.
        values[i] = value * f64::from_bits(rounded.to_bits().wrapping_add(1023) << 52);
    }
    values
}

/// Sine and cosine of any angle.
#[inline]
pub(crate) fn sine_and_cosine(angle: f64) -> (f64, f64) {
    if angle.abs() <= TURNING {
        let [[cosine], [sine]] = cosines_and_sines(&[angle]);
        (sine, cosine)
    } else {
        angle.sin_cos()
    }
}

/// Exponential of any number.
#[inline]
pub(crate) fn exponential(exponent: f64) -> f64 {
    if exponent.abs() <= DECAY { exponentials(&[exponent])[0] } else { exponent.exp() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units in the last place of the expected value.
    fn units(found: f64, expected: f64) -> f64 {
        let next = f64::from_bits(expected.abs().to_bits() + 1);
        (found - expected).abs() / (next - expected.abs())
    }

    /// Numbers in [0, 1), by the congruences of Lehmer modulo `2^64`.
    fn random() -> impl Iterator<Item = f64> {
        let next = |seed: &u64| Some(seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
        std::iter::successors(Some(1), next).skip(1).map(|seed| (seed >> 11) as f64 * 2.0_f64.powi(-53))
    }

    /// Both errors are below one unit; functions that round to different sides are one unit apart.
    const APART: f64 = 1.0;

    #[test]
    fn sines_and_cosines_are_those_of_the_standard_library_to_a_unit() {
        let mut random = random();
        for magnitude in [1e-9, 1e-3, 0.7, 3.0, 50.0, 1e4, TURNING] {
            for _ in 0..200_000 {
                let angles = [(); 4].map(|()| magnitude * (2.0 * random.next().unwrap() - 1.0));
                let [cosines, sines] = cosines_and_sines(&angles);
                for (k, angle) in angles.into_iter().enumerate() {
                    let (sine, cosine) = angle.sin_cos();
                    assert!(units(sines[k], sine) <= APART, "sin {angle:e}: {:e} {sine:e}", sines[k]);
                    assert!(units(cosines[k], cosine) <= APART, "cos {angle:e}: {:e} {cosine:e}", cosines[k]);
                    assert_eq!(sine_and_cosine(angle), (sines[k], cosines[k]));
                }
            }
        }
    }

    /// Next to multiples of a quarter turn nearly all digits of the remainder cancel.
    #[test]
    fn next_to_zeros_sines_and_cosines_keep_all_their_digits() {
        for k in 1..1_000_000 {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_2;
            let ((sine, cosine), expected) = (sine_and_cosine(angle), angle.sin_cos());
            assert!(units(sine, expected.0) <= APART && units(cosine, expected.1) <= APART, "{k}");
        }
    }

    #[test]
    fn exponentials_are_those_of_the_standard_library_to_a_unit() {
        let mut random = random();
        for magnitude in [1e-9, 1e-3, 0.5, 10.0, DECAY] {
            for _ in 0..200_000 {
                let exponents = [(); 4].map(|()| magnitude * (2.0 * random.next().unwrap() - 1.0));
                let values = exponentials(&exponents);
                for (k, exponent) in exponents.into_iter().enumerate() {
                    let expected = exponent.exp();
                    assert!(
                        units(values[k], expected) <= APART,
                        "{exponent:e}: {:e} {expected:e}",
                        values[k]
                    );
                    assert_eq!(exponential(exponent), values[k]);
                }
            }
        }
    }

    #[test]
    fn beyond_their_reach_the_standard_functions_serve() {
        assert_eq!(sine_and_cosine(1e22), 1e22_f64.sin_cos());
        assert_eq!((exponential(-1e4), exponential(800.0)), (0.0, f64::INFINITY));
        assert!(sine_and_cosine(f64::NAN).0.is_nan() && exponential(f64::NAN).is_nan());
        assert_eq!((sine_and_cosine(0.0), exponential(0.0)), ((0.0, 1.0), 1.0));
    }
}
