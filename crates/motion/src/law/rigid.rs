//! Rigid stop with a coefficient of restitution.

use super::{Contact, Force, LawError};

/// Rigid stop with a coefficient of restitution.
///
/// `r <= level` always. It has no force law: a touch with the velocity `r' = v > 0` is an impact after
/// Newton, `r' -> -e v` at once, and a contact that is pressed on lasts with whatever force keeps `r =
/// level`. What both do to a structure, and to its sensitivities, stands in [`exact`](crate::exact),
/// `impact.rs` and `held.rs`. So [`Law::force`](crate::Law::force) is zero, and the stop has no stiffness.
///
/// # Source
/// Newton's law of restitution; Shaw and Holmes, J. Sound Vib. 90 (1983), 129-155.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidStop {
    restitution: f64,
    contact: [Contact; 1],
}

impl RigidStop {
    /// A stop of the restitution `e` at rest distance `gap` [m].
    ///
    /// # Errors
    /// [`LawError::RigidRestitution`] unless from 0 to 1, [`LawError::Gap`] unless finite and not negative.
    pub fn with_gap(restitution: f64, gap: f64) -> Result<Self, LawError> {
        Self::at_level(restitution, super::valid_gap(gap)?)
    }

    /// A stop at the relative displacement `level` [m], which may be negative: then it holds the undeformed
    /// structure away from its rest.
    ///
    /// # Errors
    /// [`LawError::RigidRestitution`] unless from 0 to 1, [`LawError::Gap`] unless finite.
    pub fn at_level(restitution: f64, level: f64) -> Result<Self, LawError> {
        if !level.is_finite() {
            return Err(LawError::Gap { found: level });
        }
        let contact = [Contact { level, sign: 1.0, onset_exponent: 1.0 }];
        Self { restitution, contact }.with_restitution(restitution)
    }

    /// The coefficient of restitution e [-].
    #[must_use]
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The relative displacement that is not passed [m].
    #[must_use]
    pub fn level(&self) -> f64 {
        self.contact[0].level
    }

    /// The same stop with another coefficient of restitution.
    ///
    /// # Errors
    /// [`LawError::RigidRestitution`] unless from 0 to 1.
    pub fn with_restitution(self, restitution: f64) -> Result<Self, LawError> {
        if (0.0..=1.0).contains(&restitution) {
            Ok(Self { restitution, ..self })
        } else {
            Err(LawError::RigidRestitution { found: restitution })
        }
    }

    pub(super) fn force() -> Force {
        Force::ZERO
    }

    pub(super) fn contacts(&self) -> &[Contact] {
        &self.contact
    }
}
