//! The normal, Student's and the chi-squared distribution.
//!
//! All come from two functions: the regularised incomplete gamma function `P(a, x)` (series below `a + 1`,
//! continued fraction above) and the regularised incomplete beta function `I_x(a, b)` (continued fraction).
//! Quantiles are bisected. Relative errors are below 1e-10.
//!
//! # Source
//! Abramowitz and Stegun, *Handbook of Mathematical Functions* (1964), 6.1.41, 6.5.29, 6.5.31, 26.5.8,
//! 26.7.1; continued fractions by the method of Lentz, Appl. Opt. 15 (1976), 668-671.

use std::f64::consts::TAU;

const EPSILON: f64 = 1e-16;
const MAX_TERMS: usize = 10_000;
/// Replaces zero in a continued fraction.
const TINY: f64 = 1e-300;

/// Probability that a variable of the chi-squared distribution exceeds `value`.
#[must_use]
pub fn chi_squared_tail(value: f64, degrees_of_freedom: f64) -> f64 {
    gamma_upper(0.5 * degrees_of_freedom, 0.5 * value.max(0.0))
}

/// `t` with the probability `confidence` between -t and t, of Student's distribution.
#[must_use]
pub fn student_quantile(confidence: f64, degrees_of_freedom: f64) -> f64 {
    quantile(confidence, |t| {
        1.0 - beta(degrees_of_freedom / (degrees_of_freedom + t * t), 0.5 * degrees_of_freedom, 0.5)
    })
}

/// `z` with the probability `confidence` between -z and z, of the normal distribution.
#[must_use]
pub fn normal_quantile(confidence: f64) -> f64 {
    quantile(confidence, |z| 1.0 - gamma_upper(0.5, 0.5 * z * z))
}

/// Argument at which an increasing function reaches `level`.
fn quantile(level: f64, inside: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while inside(high) < level && high < 1e12 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if inside(middle) < level {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// `ln Gamma(x)`, x > 0: Stirling's series after shifting x upwards.
fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut product) = (x, 1.0);
    while x < 15.0 {
        product *= x;
        x += 1.0;
    }
    let square = x * x;
    let series =
        (1.0 / 12.0 - (1.0 / 360.0 - (1.0 / 1260.0 - 1.0 / (1680.0 * square)) / square) / square) / x;
    (x - 0.5) * x.ln() - x + 0.5 * TAU.ln() + series - f64::ln(product)
}

/// `1 - P(a, x)`.
fn gamma_upper(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let factor = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for k in 1..MAX_TERMS {
            term *= x / (a + k as f64);
            sum += term;
            if term < EPSILON * sum {
                break;
            }
        }
        return (1.0 - factor * sum).max(0.0);
    }
    let terms = |k: usize| {
        let k = k as f64;
        if k == 0.0 { (1.0, x + 1.0 - a) } else { (-k * (k - a), x + 2.0 * k + 1.0 - a) }
    };
    factor * fraction(terms)
}

/// `I_x(a, b)`.
fn beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    // The fraction converges fast below the mean.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta(1.0 - x, b, a);
    }
    let factor = (a * x.ln() + b * (-x).ln_1p() + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b)).exp() / a;
    let terms = |k: usize| {
        if k == 0 {
            return (1.0, 1.0);
        }
        let m = (k / 2) as f64;
        let two = 2.0 * m;
        let d = if k.is_multiple_of(2) {
            m * (b - m) * x / ((a + two - 1.0) * (a + two))
        } else {
            -(a + m) * (a + b + m) * x / ((a + two) * (a + two + 1.0))
        };
        (d, 1.0)
    };
    factor * fraction(terms)
}

/// `a_0/(b_0 + a_1/(b_1 + ...))`, with `(a_k, b_k)` from `terms`.
fn fraction(terms: impl Fn(usize) -> (f64, f64)) -> f64 {
    let away = |value: f64| if value.abs() < TINY { TINY } else { value };
    let (mut value, mut c, mut d) = (TINY, TINY, 0.0);
    for k in 0..MAX_TERMS {
        let (a, b) = terms(k);
        d = 1.0 / away(b + a * d);
        c = away(b + a / c);
        value *= c * d;
        if (c * d - 1.0).abs() < 4.0 * f64::EPSILON {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Tables 26.8 and 26.10 of Abramowitz and Stegun, as printed.
    #[test]
    fn quantiles_match_the_tables() {
        for (degrees_of_freedom, t) in
            [(1.0, 12.706), (2.0, 4.303), (5.0, 2.571), (13.0, 2.160), (30.0, 2.042), (120.0, 1.980)]
        {
            assert!((student_quantile(0.95, degrees_of_freedom) - t).abs() < 6e-4, "{degrees_of_freedom}");
        }
        assert!((normal_quantile(0.95) - 1.959_964).abs() < 1e-6);
        for (degrees_of_freedom, value) in [(1.0, 3.84146), (2.0, 5.99147), (10.0, 18.3070), (30.0, 43.7729)]
        {
            assert!(
                (chi_squared_tail(value, degrees_of_freedom) - 0.05).abs() < 1e-6,
                "{degrees_of_freedom}"
            );
        }
    }

    /// With two degrees of freedom the tail is `exp(-x/2)`; Student's distribution with one is an arctangent.
    #[test]
    fn closed_forms_are_reproduced() {
        for x in [1e-3, 0.5, 1.9, 2.1, 7.0, 60.0] {
            let tail = chi_squared_tail(x, 2.0);
            assert!((tail / (-0.5 * x).exp() - 1.0).abs() < 1e-12, "{x}");
        }
        for t in [0.1, 1.0, 12.0] {
            let inside = 2.0 / PI * f64::atan(t);
            assert!((student_quantile(inside, 1.0) / t - 1.0).abs() < 1e-10, "{t}");
        }
    }

    #[test]
    fn gamma_function_of_one_half_and_of_whole_numbers() {
        assert!((ln_gamma(0.5) - 0.5 * PI.ln()).abs() < 1e-13);
        assert!((ln_gamma(6.0) - 120.0_f64.ln()).abs() < 1e-13);
    }

    #[test]
    fn student_becomes_normal_with_many_degrees_of_freedom() {
        assert!((student_quantile(0.95, 1e7) - normal_quantile(0.95)).abs() < 1e-6);
    }
}
