//! A force law given as a formula of the displacement and the velocity.
//!
//! `f = -g(r, r')`, always active, where the formula g is the force with which the element resists: `k*x` is
//! a spring and `c*v` a damper, with x for r [m] and v for r' [m/s].
//!
//! **Derivatives** are exact: the formula is evaluated in numbers that carry them ([`jet`]). The library that
//! reads the formula could differentiate it as a text, too; but of `x^(3-1)` that leaves `ln(x) (0 - 0)`,
//! which is not a number at `x = 0`, and each nested quotient makes the text longer.
//!
//! **What is not finite** (a logarithm of a negative number, an overflow) is not a number in the equations of
//! a step, which then has no solution: a motion that comes there ends, and says where. At rest, `r = r' = 0`,
//! where every search begins, the force and its derivatives must be finite.

mod arithmetic;
mod corners;
mod error;
mod jet;
mod notation;
mod parity;

use std::sync::Arc;

use exmex::{Express, FlatEx};

use self::{
    arithmetic::{Literals, Operators},
    corners::Corners,
    jet::Jet,
    parity::Parity,
};
use super::{
    Force, ForceLaw, LawConstant, LawDescription, LawError, LawIdentity, LawKey, LawKeyKind, LawPart,
    LawPhrase, LawSides, LawSymbol, LawValue, LawWords, force_law::no_constant,
};

pub use arithmetic::Function;
pub use error::{DEEPEST, FormulaError, LONGEST};
pub use notation::{CONSTANTS, VARIABLES};

/// Roundings of a force that its formula may make.
const ROUNDINGS: f64 = 64.0;

/// A force law given as a formula, always active.
///
/// `f = -g(r, r')` with the formula g. See [`Formula::new`] for what a formula is.
#[derive(Clone)]
pub struct Formula(Arc<Expression>);

struct Expression {
    /// As it was read, with its constants in their places.
    text: String,
    program: FlatEx<Jet, Operators, Literals>,
    has_displacement: bool,
    has_velocity: bool,
    is_odd: bool,
    has_corners: bool,
}

impl Formula {
    /// The law `f = -g` of the formula g.
    ///
    /// A formula has numbers, the variables `x` (the relative displacement [m]) and `v` (its rate [m/s]),
    /// `pi`, the given constants, `+ - * / ^`, parentheses, and the functions of [`Function::ALL`] of one
    /// argument in parentheses. `-x^2` is `-(x^2)`, and `a^b^c` needs parentheses.
    ///
    /// * `constants`: names and values.
    ///
    /// # Errors
    /// [`FormulaError`]: it is no formula, has neither variable, does not use a constant, or it or one of its
    /// derivatives is not finite at rest.
    pub fn new(text: &str, constants: &[(String, f64)]) -> Result<Self, FormulaError> {
        let text = notation::read(text, constants)?;
        let program = FlatEx::<Jet, Operators, Literals>::parse(&text).map_err(|_| FormulaError::Unread)?;
        let parity = FlatEx::<Parity, Operators, Literals>::parse(&text).map_err(|_| FormulaError::Unread)?;
        let has = |variable: &str| program.var_names().iter().any(|name| name == variable);
        let [has_displacement, has_velocity] = VARIABLES.map(has);
        if !has_displacement && !has_velocity {
            return Err(FormulaError::NoVariable);
        }
        let odd = vec![Parity::ODD; parity.var_names().len()];
        let is_odd = parity.eval(&odd).is_ok_and(Parity::is_odd);
        let corners =
            FlatEx::<Corners, Operators, Literals>::parse(&text).map_err(|_| FormulaError::Unread)?;
        let smooth = vec![Corners::NONE; corners.var_names().len()];
        let has_corners = corners.eval(&smooth).map_err(|_| FormulaError::Unread)?.can_have;
        let found = Expression { text, program, has_displacement, has_velocity, is_odd, has_corners };
        let law = Self(Arc::new(found));
        let Force { value, slope, damping } = law.force(0.0, 0.0);
        for (what, found) in [("force", value), ("slope by `x`", slope), ("slope by `v`", damping)] {
            if !found.is_finite() {
                return Err(FormulaError::NotFiniteAtRest { what, found });
            }
        }
        Ok(law)
    }
}

impl ForceLaw for Formula {
    fn force(&self, displacement: f64, velocity: f64) -> Force {
        let Expression { program, has_displacement, has_velocity, .. } = &*self.0;
        let (x, v) = (Jet::displacement(displacement), Jet::velocity(velocity));
        // In the order of their names.
        let resists = match (has_displacement, has_velocity) {
            (true, true) => program.eval(&[v, x]),
            (true, false) => program.eval(&[x]),
            _ => program.eval(&[v]),
        };
        let Jet { value, slope, damping } = resists.expect("a formula has a value for each of its variables");
        // Not the negative, which of nothing is -0.
        Force { value: 0.0 - value, slope: 0.0 - slope, damping: 0.0 - damping }
    }

    /// Mean of `df/dr'` between two velocities.
    ///
    /// That is the difference of the forces over that of the velocities. Where rounding hides that
    /// difference, as between velocities that are nearly the same, Simpson's rule has more digits.
    fn mean_damping(&self, displacement: f64, [first, last]: [f64; 2]) -> f64 {
        let middle = self.force(displacement, 0.5 * (first + last)).damping;
        let apart = last - first;
        let [first, last] = [first, last].map(|velocity| self.force(displacement, velocity));
        let by_simpson = (first.damping + 4.0 * middle + last.damping) / 6.0;
        let difference = last.value - first.value;
        let rounding = ROUNDINGS * f64::EPSILON * (first.value.abs() + last.value.abs());
        if (by_simpson * apart - difference).abs() <= rounding { by_simpson } else { difference / apart }
    }

    fn depends_on_velocity(&self) -> bool {
        self.0.has_velocity
    }

    fn depends_on_displacement(&self) -> bool {
        self.0.has_displacement
    }

    /// Whether the force of the opposite motion is the opposite one, as the formula shows by its form.
    fn is_odd(&self) -> bool {
        self.0.is_odd
    }

    fn has_corners(&self) -> bool {
        self.0.has_corners
    }

    /// Its constants are numbers of the study as any other.
    fn constant(&self, _: LawConstant) -> Option<f64> {
        None
    }

    fn with_constant(&self, constant: LawConstant, _: f64) -> Result<Self, LawError> {
        no_constant("a formula", constant)
    }
}

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "formula",
    identity: LawIdentity::Named("formula"),
    force: "any [formula](#formulas) of r and r'",
    sides: LawSides::Always {
        build: |values| match values.0 {
            [LawValue::Formula(text, constants)] => Ok(LawPart::whole(Formula::new(text, constants)?.into())),
            _ => Err(LawError::NoConstant { law: "a law without a formula", constant: "text" }),
        },
    },
    keys: &[LawKey {
        name: "formula",
        field: "formula",
        symbol: "",
        kind: LawKeyKind::Formula,
        phrase: LawPhrase::Value,
        meaning: "the force of a law `\"formula\"` [N], by `x` = r [m] and `v` = r' [m/s]",
        varies: None,
    }],
    alternative: None,
    symbol: LawSymbol::ActiveSpring,
    words: LawWords { report: "force", caption: "force", last_first: false },
};

impl PartialEq for Formula {
    fn eq(&self, other: &Self) -> bool {
        self.0.text == other.0.text
    }
}

impl std::fmt::Debug for Formula {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Formula").field(&self.0.text).finish()
    }
}

#[cfg(test)]
mod tests;
