//! Springs whose force is a power of the displacement, always active.

use super::{Force, LawError};

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

    /// Whether the force of the opposite displacement is the opposite one.
    pub(crate) fn is_odd(&self) -> bool {
        self.degree != Degree::Quadratic
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    pub(super) fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        Self::new(stiffness, self.degree)
    }

    pub(super) fn force(&self, displacement: f64) -> Force {
        let (k, square) = (self.stiffness, displacement * displacement);
        match self.degree {
            Degree::Linear => Force::elastic(-k * displacement, -k),
            Degree::Quadratic => Force::elastic(-k * square, -2.0 * k * displacement),
            Degree::Cubic => Force::elastic(-k * square * displacement, -3.0 * k * square),
        }
    }
}
