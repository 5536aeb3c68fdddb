//! Zeros and lowest values of a function of one variable.

/// Zero of a function that is not negative at `low` and negative at `high`, by the Illinois method.
pub(super) fn zero(function: &mut impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    let mut kept = 0;
    for _ in 0..60 {
        let x = (low * at_high - high * at_low) / (at_high - at_low);
        if !(x > low && x < high) || high - low < 1e-15 {
            break;
        }
        let at_x = function(x);
        if at_x >= 0.0 {
            (low, at_low) = (x, at_x);
            if kept == 1 {
                at_high *= 0.5;
            }
            kept = 1;
        } else {
            (high, at_high) = (x, at_x);
            if kept == -1 {
                at_low *= 0.5;
            }
            kept = -1;
        }
    }
    if at_low.abs() <= at_high.abs() { low } else { high }
}

/// Place of the lowest value between two places, by golden section.
pub(super) fn minimum(function: &mut impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (function(a), function(b));
    while high - low > 1e-8 {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = function(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = function(b);
        }
    }
    if at_a < at_b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_bracketed_to_rounding() {
        let x = zero(&mut |x| 0.25 - x * x * x, 0.0, 1.0);
        assert!((x - 0.25_f64.cbrt()).abs() < 1e-14);
    }

    #[test]
    fn minima_are_found_to_half_the_digits() {
        let x = minimum(&mut |x| (x - 0.3_f64).powi(2) - 1e-9, 0.0, 1.0);
        assert!((x - 0.3).abs() < 1e-7);
    }
}
