//! One-sided linear spring.

use super::{Contact, Force, LawError};

/// One-sided linear spring.
///
/// `f = -k p` at penetration `p = r - level > 0`, else `f = 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearStop {
    stiffness: f64,
    contact: [Contact; 1],
}

impl LinearStop {
    /// A spring of stiffness `k` [N/m] at rest distance `gap` [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Gap`] unless finite and not negative.
    pub fn with_gap(stiffness: f64, gap: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self {
            stiffness,
            contact: [Contact { level: super::valid_gap(gap)?, sign: 1.0, onset_exponent: 1.0 }],
        })
    }

    /// A spring that presses on the undeformed structure with `preload` [N].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Preload`] unless finite and not negative.
    pub fn with_preload(stiffness: f64, preload: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let level = -super::valid_preload(preload)? / stiffness;
        Ok(Self { stiffness, contact: [Contact { level, sign: 1.0, onset_exponent: 1.0 }] })
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    pub(super) fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self { stiffness, ..*self })
    }

    pub(super) fn force(&self, displacement: f64) -> Force {
        let penetration = displacement - self.contact[0].level;
        if penetration <= 0.0 {
            return Force::ZERO;
        }
        Force { value: -self.stiffness * penetration, slope: -self.stiffness }
    }

    pub(super) fn contacts(&self) -> &[Contact] {
        &self.contact
    }
}
