//! Whether a formula is odd or even in `(x, v)`, by its form.
//!
//! A formula that is odd by its form is so everywhere, which values at some places could not show. One that
//! is odd and does not show it, as `(x+1)^2-(x-1)^2`, counts as neither: its mirror images are not used.

use std::{num::ParseFloatError, str::FromStr};

use super::arithmetic::{Arithmetic, Function};

/// What becomes of a term where `(x, v)` turns into `(-x, -v)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Symmetry {
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
    symmetry: Symmetry,
    constant: Option<f64>,
}

impl Parity {
    /// That of the variables.
    pub const ODD: Self = Self { symmetry: Symmetry::Odd, constant: None };

    pub fn is_odd(self) -> bool {
        self.symmetry == Symmetry::Odd
    }

    fn joined(self, other: Self, symmetry: Symmetry, value: impl Fn(f64, f64) -> f64) -> Self {
        Self { symmetry, constant: self.constant.zip(other.constant).map(|(a, b)| value(a, b)) }
    }

    fn of_product(self, other: Self) -> Symmetry {
        match (self.symmetry, other.symmetry) {
            (Symmetry::Neither, _) | (_, Symmetry::Neither) => Symmetry::Neither,
            (a, b) if a == b => Symmetry::Even,
            _ => Symmetry::Odd,
        }
    }
}

impl FromStr for Parity {
    type Err = ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self { symmetry: Symmetry::Even, constant: Some(text.parse()?) })
    }
}

impl Arithmetic for Parity {
    fn plus(self, other: Self) -> Self {
        let symmetry = if self.symmetry == other.symmetry { self.symmetry } else { Symmetry::Neither };
        self.joined(other, symmetry, |a, b| a + b)
    }

    fn negative(self) -> Self {
        Self { symmetry: self.symmetry, constant: self.constant.map(|a| -a) }
    }

    fn times(self, other: Self) -> Self {
        self.joined(other, self.of_product(other), |a, b| a * b)
    }

    fn over(self, other: Self) -> Self {
        self.joined(other, self.of_product(other), |a, b| a / b)
    }

    fn to_the(self, exponent: Self) -> Self {
        let whole = exponent.constant.filter(|n| n.fract() == 0.0);
        let symmetry = match (self.symmetry, exponent.symmetry, whole) {
            (Symmetry::Even, Symmetry::Even, _) => Symmetry::Even,
            (Symmetry::Odd, _, Some(n)) if n % 2.0 == 0.0 => Symmetry::Even,
            (Symmetry::Odd, _, Some(_)) => Symmetry::Odd,
            _ => Symmetry::Neither,
        };
        self.joined(exponent, symmetry, f64::powf)
    }

    fn of(self, function: Function) -> Self {
        let symmetry = match (self.symmetry, function) {
            (Symmetry::Even, _) => Symmetry::Even,
            (Symmetry::Odd, Function::Cos | Function::Cosh | Function::Abs) => Symmetry::Even,
            (
                Symmetry::Odd,
                Function::Sin
                | Function::Tan
                | Function::Asin
                | Function::Atan
                | Function::Sinh
                | Function::Tanh,
            ) => Symmetry::Odd,
            _ => Symmetry::Neither,
        };
        // No exponent is looked for among values of functions.
        Self { symmetry, constant: None }
    }
}
