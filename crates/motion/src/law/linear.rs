//! One-sided linear spring, with or without a damper beside it.

use super::{Contact, Force, LawError, Pressure};

/// One-sided linear spring, with or without a damper beside it.
///
/// `f = -(k p + c p')` at penetration `p = r - level > 0` as long as that pushes, else `f = 0`: the stop does
/// not pull. With a damper the force sets in with a jump, `-c p'`, and ends where `k p + c p' = 0`, before
/// the penetration does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearStop {
    stiffness: f64,
    damping: f64,
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
            damping: 0.0,
            contact: [Contact { level: super::valid_gap(gap)?, sign: 1.0, onset_exponent: 1.0 }],
        })
    }

    /// A spring that presses on the undeformed structure with `preload` [N].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Preload`] unless finite and not
    /// negative.
    pub fn with_preload(stiffness: f64, preload: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let level = -super::valid_preload(preload)? / stiffness;
        Ok(Self { stiffness, damping: 0.0, contact: [Contact { level, sign: 1.0, onset_exponent: 1.0 }] })
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    pub(super) fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self { stiffness, ..*self })
    }

    /// The same stop with a damper `c` [N s/m] beside the spring.
    ///
    /// # Errors
    /// [`LawError::Damping`] unless finite and not negative.
    pub fn with_damping(self, damping: f64) -> Result<Self, LawError> {
        Ok(Self { damping: super::valid_damping(damping)?, ..self })
    }

    pub(super) fn damping(&self) -> f64 {
        self.damping
    }

    /// The part of the spring.
    pub(super) fn elastic_force(&self, displacement: f64) -> f64 {
        -self.stiffness * (displacement - self.contact[0].level)
    }

    pub(super) fn force(&self, displacement: f64, velocity: f64) -> Force {
        if displacement <= self.contact[0].level {
            return Force::ZERO;
        }
        let force = self.pressing_force(displacement, velocity);
        if force.value < 0.0 { force } else { Force::ZERO }
    }

    pub(super) fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        Force {
            value: self.elastic_force(displacement) - self.damping * velocity,
            slope: -self.stiffness,
            damping: -self.damping,
        }
    }

    /// `p + (c/k) p'`.
    pub(super) fn pressure(&self) -> Option<Pressure> {
        let velocity = self.damping / self.stiffness;
        (velocity > 0.0).then_some(Pressure { displacement: 1.0, velocity, offset: 0.0 })
    }

    pub(super) fn contacts(&self) -> &[Contact] {
        &self.contact
    }
}
