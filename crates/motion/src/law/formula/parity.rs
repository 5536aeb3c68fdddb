//! Whether a formula is odd or even in `(x, v)`, by its form.
//!
//! A formula that is odd by its form is so everywhere, which values at some places could not show. One that
//! is odd and does not show it, as `(x+1)^2-(x-1)^2`, counts as neither: its mirror images are not used.

use std::{num::ParseFloatError, str::FromStr};

use super::arithmetic::{Arithmetic, Function};

/// What becomes of a term where `(x, v)` turns into `(-x, -v)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Kind {
    /// It stays.
    #[default]
    Even,
    /// It changes its sign.
    Odd,
    Neither,
}

/// The parity of a term, and its value if that is constant.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parity {
    kind: Kind,
    constant: Option<f64>,
}

impl Parity {
    /// That of the variables.
    pub const ODD: Self = Self { kind: Kind::Odd, constant: None };

    pub fn is_odd(self) -> bool {
        self.kind == Kind::Odd
    }

    fn joined(self, other: Self, kind: Kind, value: impl Fn(f64, f64) -> f64) -> Self {
        Self { kind, constant: self.constant.zip(other.constant).map(|(a, b)| value(a, b)) }
    }

    fn of_product(self, other: Self) -> Kind {
        match (self.kind, other.kind) {
            (Kind::Neither, _) | (_, Kind::Neither) => Kind::Neither,
            (a, b) if a == b => Kind::Even,
            _ => Kind::Odd,
        }
    }
}

impl FromStr for Parity {
    type Err = ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self { kind: Kind::Even, constant: Some(text.parse()?) })
    }
}

impl Arithmetic for Parity {
    fn plus(self, other: Self) -> Self {
        let kind = if self.kind == other.kind { self.kind } else { Kind::Neither };
        self.joined(other, kind, |a, b| a + b)
    }

    fn negative(self) -> Self {
        Self { kind: self.kind, constant: self.constant.map(|a| -a) }
    }

    fn times(self, other: Self) -> Self {
        self.joined(other, self.of_product(other), |a, b| a * b)
    }

    fn over(self, other: Self) -> Self {
        self.joined(other, self.of_product(other), |a, b| a / b)
    }

    fn to_the(self, exponent: Self) -> Self {
        let whole = exponent.constant.filter(|n| n.fract() == 0.0);
        let kind = match (self.kind, exponent.kind, whole) {
            (Kind::Even, Kind::Even, _) => Kind::Even,
            (Kind::Odd, _, Some(n)) if n % 2.0 == 0.0 => Kind::Even,
            (Kind::Odd, _, Some(_)) => Kind::Odd,
            _ => Kind::Neither,
        };
        self.joined(exponent, kind, f64::powf)
    }

    fn of(self, function: Function) -> Self {
        let kind = match (self.kind, function) {
            (Kind::Even, _) => Kind::Even,
            (Kind::Odd, Function::Cos | Function::Cosh | Function::Abs) => Kind::Even,
            (
                Kind::Odd,
                Function::Sin
                | Function::Tan
                | Function::Asin
                | Function::Atan
                | Function::Sinh
                | Function::Tanh,
            ) => Kind::Odd,
            _ => Kind::Neither,
        };
        // No exponent is looked for among values of functions.
        Self { kind, constant: None }
    }
}
