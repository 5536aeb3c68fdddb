//! Whether a formula can have corners: places at which it has no power series, by its form.
//!
//! A step of the integrator judges its error by how fast the coefficients of the force fall, which says more
//! of a force with a power series everywhere than of one without (`exact/step_error.rs`).

use std::{num::ParseFloatError, str::FromStr};

use super::arithmetic::{Arithmetic, Function};

/// Whether a term can have corners, and its value if it is a number.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Corners {
    pub can_have: bool,
    number: Option<f64>,
}

impl Corners {
    /// Those of the variables.
    pub const NONE: Self = Self { can_have: false, number: None };

    fn joined(self, other: Self) -> Self {
        Self { can_have: self.can_have || other.can_have, number: None }
    }
}

impl FromStr for Corners {
    type Err = ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self { can_have: false, number: Some(text.parse()?) })
    }
}

impl Arithmetic for Corners {
    fn plus(self, other: Self) -> Self {
        self.joined(other)
    }

    fn negative(self) -> Self {
        Self { number: self.number.map(|number| -number), ..self }
    }

    fn times(self, other: Self) -> Self {
        self.joined(other)
    }

    fn over(self, other: Self) -> Self {
        self.joined(other)
    }

    /// Powers have none with a whole number for exponent.
    fn to_the(self, exponent: Self) -> Self {
        let is_whole = exponent.number.is_some_and(|number| number.fract() == 0.0);
        Self { can_have: self.can_have || exponent.can_have || !is_whole, number: None }
    }

    fn of(self, function: Function) -> Self {
        let has_corner = matches!(function, Function::Abs | Function::Sqrt | Function::Asin | Function::Acos);
        Self { can_have: self.can_have || has_corner, number: None }
    }
}
