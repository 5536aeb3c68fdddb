//! Hertz contact that loses energy in proportion to its force.

use super::{Contact, Force, HertzStop, LawError, Pressure};

/// One-sided stop after Hunt and Crossley.
///
/// `f = -k p^1.5 (1 + 3/2 a p')` at penetration `p = r - level > 0` as long as that pushes, else `f = 0`. The
/// force sets in and ends like that of Hertz. With nothing but the contact acting it never ends before the
/// penetration does, since `p' = -2/(3 a)` is not passed.
///
/// The coefficient of restitution of an impact with the speed v goes to `1 - a v` for small `a v`, whatever
/// the masses; over the whole range e solves `(1 + e) y = ln((1 + y)/(1 - e y))`, `y = 3/2 a v`.
///
/// # Source
/// Hunt and Crossley, J. Appl. Mech. 42 (1975), 440-445.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossleyStop {
    elastic: HertzStop,
    loss: f64,
}

impl HuntCrossleyStop {
    /// The stop `elastic` with the loss `a` [s/m].
    ///
    /// # Errors
    /// [`LawError::Damping`] unless finite and not negative.
    pub fn new(elastic: HertzStop, loss: f64) -> Result<Self, LawError> {
        Ok(Self { elastic, loss: super::valid_damping(loss)? })
    }

    pub(super) fn loss(&self) -> f64 {
        self.loss
    }

    pub(super) fn with_loss(&self, loss: f64) -> Result<Self, LawError> {
        Self::new(self.elastic, loss)
    }

    /// `df/da = -3/2 k p^1.5 p'`.
    pub(super) fn by_loss(&self, displacement: f64, velocity: f64) -> f64 {
        1.5 * self.elastic.force(displacement).value * velocity
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.elastic.stiffness()
    }

    pub(super) fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        Ok(Self { elastic: self.elastic.with_stiffness(stiffness)?, ..*self })
    }

    pub(super) fn force(&self, displacement: f64, velocity: f64) -> Force {
        let force = self.pressing_force(displacement, velocity);
        if force.value < 0.0 { force } else { Force::ZERO }
    }

    pub(super) fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        damped_hertz(&self.elastic, 1.5 * self.loss, displacement, velocity)
    }

    /// `1 + 3/2 a p'`.
    pub(super) fn pressure(&self) -> Option<Pressure> {
        let velocity = 1.5 * self.loss;
        (velocity > 0.0).then_some(Pressure { displacement: 0.0, velocity, offset: 1.0 })
    }

    pub(super) fn contacts(&self) -> &[Contact] {
        self.elastic.contacts()
    }
}

/// `-k p^1.5 (1 + factor p')` and its derivatives.
pub(super) fn damped_hertz(elastic: &HertzStop, factor: f64, displacement: f64, velocity: f64) -> Force {
    let force = elastic.force(displacement);
    let share = 1.0 + factor * velocity;
    Force { value: force.value * share, slope: force.slope * share, damping: force.value * factor }
}
