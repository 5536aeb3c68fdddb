//! The place of a zero between two points of the path, by few probes.
//!
//! A probe costs what a point costs, so places are guessed as well as what is known allows: by the inverse
//! polynomial through up to four values (order of convergence up to 1.93), and where that leaves the bracket
//! or did not help last time, by the Illinois variant of regula falsi, which always converges.
//!
//! # Source
//! Dowell and Jarratt, BIT 11 (1971), 168-174; inverse interpolation: Brent, *Algorithms for Minimization
//! without Derivatives* (1973), chapter 4.

/// Values that the inverse polynomial goes through.
const MOST_KNOWN: usize = 4;
/// Bracket of a zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bracket {
    low: (f64, f64),
    high: (f64, f64),
    side: i32,
    /// Places and values, the newest last.
    known: Vec<(f64, f64)>,
    /// The last probe did not halve the least value.
    disappointed: bool,
}

impl Bracket {
    /// The values at the ends differ in sign.
    pub fn new(low: (f64, f64), high: (f64, f64)) -> Self {
        Self { low, high, side: 0, known: vec![low, high], disappointed: false }
    }

    pub fn width(&self) -> f64 {
        self.high.0 - self.low.0
    }

    /// Secant slope, in magnitude.
    pub fn slope(&self) -> f64 {
        (self.high.1 - self.low.1).abs() / self.width().max(f64::MIN_POSITIVE)
    }

    /// How far the zero can be from a place with this value: by the secant slope, but no further than the
    /// bracket reaches.
    pub fn uncertainty(&self, value: f64) -> f64 {
        (value.abs() / self.slope().max(f64::MIN_POSITIVE)).min(self.width())
    }

    /// Whether no probe had the sign of the start.
    pub fn is_open_at_start(&self) -> bool {
        self.low.0 == 0.0
    }

    /// The place of the newest probe.
    pub fn newest(&self) -> f64 {
        self.known[self.known.len() - 1].0
    }

    /// Place of the end that is not the newest probe.
    pub fn far_end(&self) -> f64 {
        if self.low.0 == self.newest() { self.high.0 } else { self.low.0 }
    }

    pub fn next(&self) -> f64 {
        let inverse = at_zero(&self.known);
        if self.known.len() > 2 && !self.disappointed && self.low.0 < inverse && inverse < self.high.0 {
            return inverse;
        }
        let share = self.low.1 / (self.low.1 - self.high.1);
        self.low.0 + self.width() * share.clamp(1e-3, 0.999)
    }

    pub fn narrow(&mut self, place: f64, value: f64) {
        let least = self.known.iter().map(|(_, value)| value.abs()).fold(f64::INFINITY, f64::min);
        self.disappointed = value.abs() > 0.5 * least;
        if self.known.len() == MOST_KNOWN {
            self.known.remove(0);
        }
        self.known.push((place, value));
        if value * self.high.1 > 0.0 {
            self.high = (place, value);
            if self.side == 1 {
                self.low.1 *= 0.5;
            }
            self.side = 1;
        } else {
            self.low = (place, value);
            if self.side == -1 {
                self.high.1 *= 0.5;
            }
            self.side = -1;
        }
    }
}

/// Place where the polynomial of the place over the value is met at zero.
pub(super) fn at_zero(known: &[(f64, f64)]) -> f64 {
    let weight = |i: usize| -> f64 {
        let others = known.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, (_, value))| -value / (known[i].1 - value)).product()
    };
    known.iter().enumerate().map(|(i, (place, _))| weight(i) * place).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_met_exactly() {
        let cubic = |x: f64| 0.3 - 2.0 * x + 0.7 * x * x - x * x * x;
        let pairs = [1.0, 0.4, -0.6, -1.5].map(|x| (cubic(x), x));
        assert!((at_zero(&pairs) - 0.3).abs() < 1e-14);
    }

    fn probes(function: impl Fn(f64) -> f64, accuracy: f64) -> u32 {
        let mut bracket = Bracket::new((0.0, function(0.0)), (1.0, function(1.0)));
        for probe in 1..=60 {
            let place = bracket.next();
            assert!((0.0..=1.0).contains(&place));
            let value = function(place);
            bracket.narrow(place, value);
            if value.abs() <= accuracy {
                return probe;
            }
        }
        panic!("not found");
    }

    /// Smooth functions take few probes; powers far from linear ones more, and no function all of them.
    #[test]
    fn zeros_take_few_probes() {
        assert_eq!(probes(|x| 0.3 - x, 1e-12), 1);
        assert!(probes(|x| (0.5 - x).sinh(), 1e-12) <= 4);
        assert!(probes(|x| 1.0 - (1.0 + 2.0 * x).ln() * 1.4, 1e-12) <= 5);
        assert!(probes(|x| 0.01 - x * x, 1e-12) <= 10);
        assert!(probes(|x| (0.2 - x).cbrt(), 1e-6) <= 40);
    }

    /// A jump is bracketed as narrowly as is asked for.
    #[test]
    fn a_jump_is_bracketed() {
        let mut bracket = Bracket::new((0.0, 1.0), (1.0, -1.0));
        for _ in 0..40 {
            let place = bracket.next();
            bracket.narrow(place, if place < 0.37 { 1.0 } else { -1.0 });
        }
        assert!(bracket.width() < 1e-9);
    }
}
