//! Cubic spring, always active.

use super::{Force, LawError};

/// Cubic spring: `f = -k r^3`, always active; `k < 0` softens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubicSpring {
    stiffness: f64,
}

impl CubicSpring {
    /// A spring of cubic stiffness `k` [N/m^3].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and not zero.
    pub fn new(stiffness: f64) -> Result<Self, LawError> {
        if !stiffness.is_finite() || stiffness == 0.0 {
            return Err(LawError::Stiffness { found: stiffness, allowed: "not zero" });
        }
        Ok(Self { stiffness })
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    pub(super) fn force(&self, displacement: f64) -> Force {
        let square = displacement * displacement;
        Force::elastic(-self.stiffness * square * displacement, -3.0 * self.stiffness * square)
    }
}
