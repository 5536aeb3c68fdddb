//! Rigid stop with a coefficient of restitution.
//! Equation (L10) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, LawConstant, LawDescription, LawError, LawIdentity, LawKey, LawPart, LawRest,
    LawSides, LawSymbol, LawWords, NoPreload, Quantity, force_law::no_constant, quantity::Bound,
};

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
        let contact = super::one_sided(level, 1.0);
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
}

impl ForceLaw for RigidStop {
    fn force(&self, _: f64, _: f64) -> Force {
        Force::ZERO
    }

    fn contacts(&self) -> &[Contact] {
        &self.contact
    }

    fn linear_beyond(&self) -> Option<f64> {
        Some(self.contact[0].level.abs())
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Restitution).then_some(self.restitution)
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Gap => Self::with_gap(self.restitution, value),
            LawConstant::Restitution => self.with_restitution(value),
            other => no_constant("a rigid stop", other),
        }
    }
}

/// The coefficient of restitution.
const RESTITUTION: Quantity = Quantity::new("", Bound::Including(0.0), Bound::Including(1.0));

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "rigid",
    identity: LawIdentity::Named("rigid"),
    force: "none: `r` never passes the gap, and an impact with the speed v goes back with `e v`; see below",
    sides: LawSides::One {
        no_preload: Some(NoPreload {
            why: "a rigid stop has no stiffness to press with",
            allowed: "allowed: a gap",
        }),
        build: |values, rest| match rest {
            LawRest::Level(level) => Ok(LawPart::whole(RigidStop::at_level(values.number(0), level)?.into())),
            LawRest::Preload(_) => Err(LawError::NoConstant { law: "a rigid stop", constant: "preload" }),
        },
    },
    keys: &[LawKey::number("restitution", "e", RESTITUTION)
        .named("coefficient of restitution")
        .meaning("coefficient of restitution e of a rigid stop, the ratio of speeds itself")
        .varying(LawConstant::Restitution)],
    alternative: None,
    symbol: LawSymbol::Wall,
    words: LawWords { report: "rigid", caption: "rigid", last_first: false },
};
