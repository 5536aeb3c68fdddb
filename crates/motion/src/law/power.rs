//! Springs whose force is a power of the displacement, always active.
//! Equation (L12) of the book, `docs/reference`.

use super::{
    Force, ForceLaw, LawConstant, LawDescription, LawError, LawIdentity, LawKey, LawKeyKind, LawPart,
    LawSides, LawSymbol, LawValues, LawWords, Quantity, VariesAs, force_law::no_constant, quantity::Bound,
};

/// Degree of a [`PowerSpring`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degree {
    /// `f = -k r`.
    Linear,
    /// `f = -k r^2`: pushes to one side.
    Quadratic,
    /// `f = -k r^3`.
    Cubic,
}

/// A spring `f = -k r^n`, always active. With `k < 0` a linear one pushes away from the middle, a cubic one
/// softens.
///
/// A spring of several terms is several elements at one place: the force of each is proportional to its
/// constant, which is all that derivatives by that constant need to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerSpring {
    stiffness: f64,
    degree: Degree,
}

impl PowerSpring {
    /// A spring of the constant `k` [N/m, N/m^2, N/m^3].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and not zero.
    pub fn new(stiffness: f64, degree: Degree) -> Result<Self, LawError> {
        if !stiffness.is_finite() || stiffness == 0.0 {
            return Err(LawError::Stiffness { found: stiffness, allowed: "not zero" });
        }
        Ok(Self { stiffness, degree })
    }

    /// A cubic spring of the constant `k` [N/m^3].
    ///
    /// # Errors
    /// As [`PowerSpring::new`].
    pub fn cubic(stiffness: f64) -> Result<Self, LawError> {
        Self::new(stiffness, Degree::Cubic)
    }
}

impl ForceLaw for PowerSpring {
    fn force(&self, displacement: f64, _: f64) -> Force {
        let (k, square) = (self.stiffness, displacement * displacement);
        match self.degree {
            Degree::Linear => Force::elastic(-k * displacement, -k),
            Degree::Quadratic => Force::elastic(-k * square, -2.0 * k * displacement),
            Degree::Cubic => Force::elastic(-k * square * displacement, -3.0 * k * square),
        }
    }

    fn is_odd(&self) -> bool {
        self.degree != Degree::Quadratic
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Stiffness).then_some(self.stiffness)
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Stiffness => Self::new(value, self.degree),
            other => no_constant("a spring", other),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.constant(constant)
    }
}

/// A term of the spring.
const fn term(name: &'static str, symbol: &'static str, unit: &'static str, most: f64) -> LawKey {
    let quantity = Quantity::new(unit, Bound::Including(-most), Bound::Including(most));
    LawKey { kind: LawKeyKind::Term { quantity }, ..LawKey::number(name, symbol, quantity) }
}

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "cubic",
    identity: LawIdentity::Named("cubic"),
    force: "k1 r + k2 r^2 + k3 r^3",
    sides: LawSides::Always { build: of_terms },
    keys: &[
        term("stiffness_n_m", "k1", "N/m", 1e18).meaning(
            "linear term of a cubic spring; negative pushes away from the middle, see [two \
             wells](#two-wells)",
        ),
        term("stiffness_n_m2", "k2", "N/m^2", 1e24).meaning("quadratic term of a cubic spring"),
        LawKey {
            varies: Some(VariesAs::UnlessZero(LawConstant::Stiffness)),
            ..term("stiffness_n_m3", "k3", "N/m^3", 1e30)
                .meaning("cubic term of a cubic spring; negative softens")
        },
    ],
    alternative: None,
    symbol: LawSymbol::ActiveSpring,
    words: LawWords { report: "cubic spring", caption: "cubic spring", last_first: true },
};

/// An element for each term that there is, the cubic one with the name of the stop.
fn of_terms(values: LawValues<'_>) -> Result<Vec<LawPart>, LawError> {
    let terms =
        [(2, Degree::Cubic, ""), (1, Degree::Quadratic, " (quadratic)"), (0, Degree::Linear, " (linear)")];
    let there = terms.into_iter().filter(|(key, ..)| values.number(*key) != 0.0);
    let part = |(key, degree, suffix)| {
        let law = PowerSpring::new(values.number(key), degree)?.into();
        Ok(LawPart { suffix, law, is_turned: false })
    };
    there.map(part).collect()
}
