//! Numbers with their derivatives by displacement and velocity.
//!
//! A jet is `(a, a_x, a_v)`; `h(a)` has the derivatives `h'(a) a_x` and `h'(a) a_v`, and so on by the rules
//! of sums, products, quotients and powers. They are exact up to rounding.

use std::{num::ParseFloatError, str::FromStr};

use super::arithmetic::{Arithmetic, Function};

/// A number with its derivatives.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Jet {
    pub value: f64,
    /// By the displacement.
    pub slope: f64,
    /// By the velocity.
    pub damping: f64,
}

/// Whole exponents up to this are powers by multiplication.
const MULTIPLIED: f64 = 64.0;

impl Jet {
    /// The displacement itself.
    pub fn displacement(value: f64) -> Self {
        Self { value, slope: 1.0, damping: 0.0 }
    }

    /// The velocity itself.
    pub fn velocity(value: f64) -> Self {
        Self { value, slope: 0.0, damping: 1.0 }
    }

    fn is_constant(self) -> bool {
        self.slope == 0.0 && self.damping == 0.0
    }

    /// `value`, whose derivative by this number is `factor`. Where that is infinite and the number stands
    /// still, as in `sqrt(x^2)` at 0, there is no derivative, and what comes out is not a number.
    fn chained(self, value: f64, factor: f64) -> Self {
        Self { value, slope: factor * self.slope, damping: factor * self.damping }
    }
}

impl FromStr for Jet {
    type Err = ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self { value: text.parse()?, ..Self::default() })
    }
}

impl Arithmetic for Jet {
    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
            damping: self.damping + other.damping,
        }
    }

    fn negative(self) -> Self {
        Self { value: -self.value, slope: -self.slope, damping: -self.damping }
    }

    fn times(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        Self {
            value: a * b,
            slope: self.slope * b + a * other.slope,
            damping: self.damping * b + a * other.damping,
        }
    }

    fn over(self, other: Self) -> Self {
        let (value, divisor) = (self.value / other.value, other.value);
        Self {
            value,
            slope: (self.slope - value * other.slope) / divisor,
            damping: (self.damping - value * other.damping) / divisor,
        }
    }

    /// `a^b`, whose logarithmic derivative is `b a'/a + b' ln a`.
    fn to_the(self, exponent: Self) -> Self {
        let (a, b) = (self.value, exponent.value);
        let by_base = self.chained(power(a, b), if b == 0.0 { 0.0 } else { b * power(a, b - 1.0) });
        if exponent.is_constant() {
            return by_base;
        }
        // `a^b ln a` goes to 0 with a.
        let by_exponent = if by_base.value == 0.0 { 0.0 } else { by_base.value * a.ln() };
        let by_exponent = exponent.chained(by_base.value, by_exponent);
        Self {
            value: by_base.value,
            slope: by_base.slope + by_exponent.slope,
            damping: by_base.damping + by_exponent.damping,
        }
    }

    fn of(self, function: Function) -> Self {
        let a = self.value;
        let (value, factor) = match function {
            Function::Sin => (a.sin(), a.cos()),
            Function::Cos => (a.cos(), -a.sin()),
            Function::Tan => (a.tan(), 1.0 + a.tan().powi(2)),
            Function::Asin => (a.asin(), ((1.0 - a) * (1.0 + a)).sqrt().recip()),
            Function::Acos => (a.acos(), -((1.0 - a) * (1.0 + a)).sqrt().recip()),
            Function::Atan => (a.atan(), (1.0 + a * a).recip()),
            Function::Sinh => (a.sinh(), a.cosh()),
            Function::Cosh => (a.cosh(), a.sinh()),
            Function::Tanh => (a.tanh(), a.cosh().powi(2).recip()),
            Function::Exp => (a.exp(), a.exp()),
            Function::Ln => (a.ln(), a.recip()),
            Function::Sqrt => (a.sqrt(), 0.5 / a.sqrt()),
            Function::Abs => (a.abs(), if a == 0.0 { 0.0 } else { a.signum() }),
        };
        self.chained(value, factor)
    }
}

fn power(base: f64, exponent: f64) -> f64 {
    if exponent.fract() == 0.0 && exponent.abs() <= MULTIPLIED {
        base.powi(exponent as i32)
    } else {
        base.powf(exponent)
    }
}
