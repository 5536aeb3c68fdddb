//! Linear springs on both sides of a clearance.

use super::{Contact, Force, LawError};

/// A linear spring on either side of a clearance.
///
/// `f = -k (r - g_+)` for `r > g_+`, `f = -k (r + g_-)` for `r < -g_-`, else `f = 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSidedStop {
    stiffness: f64,
    contacts: [Contact; 2],
}

impl TwoSidedStop {
    /// Springs of stiffness `k` [N/m] at the rest distances `gap_above` and `gap_below` [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Gap`] unless both gaps are finite and
    /// not negative.
    pub fn new(stiffness: f64, gap_above: f64, gap_below: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let above = Contact { level: super::valid_gap(gap_above)?, sign: 1.0, onset_exponent: 1.0 };
        let below = Contact { level: -super::valid_gap(gap_below)?, sign: -1.0, onset_exponent: 1.0 };
        Ok(Self { stiffness, contacts: [above, below] })
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    pub(super) fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self { stiffness, ..*self })
    }

    pub(super) fn force(&self, displacement: f64) -> Force {
        for contact in &self.contacts {
            let beyond = displacement - contact.level;
            if contact.sign * beyond > 0.0 {
                return Force::elastic(-self.stiffness * beyond, -self.stiffness);
            }
        }
        Force::ZERO
    }

    pub(super) fn contacts(&self) -> &[Contact] {
        &self.contacts
    }
}
