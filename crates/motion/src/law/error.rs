//! Why a law cannot be built, and what constants of several laws have to be.

use super::FormulaError;

/// Why a law cannot be built from its parameters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// Stiffnesses are finite and positive (that of a power of the displacement may be negative).
    #[error("stiffness is {found}, must be finite and {allowed}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Stiffness { found: f64, allowed: &'static str },
    /// Gaps are finite and not negative.
    #[error("gap is {found} m, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Gap { found: f64 },
    /// Preloads are finite and not negative.
    #[error("preload is {found} N, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Preload { found: f64 },
    /// Constants of damping are finite and not negative.
    #[error("damping is {found}, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Damping { found: f64 },
    /// Coefficients of restitution are positive and at most one.
    #[error("coefficient of restitution is {found}, must be more than 0 and at most 1")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Restitution { found: f64 },
    /// Coefficients of restitution of a rigid stop are from 0 to 1.
    #[error("coefficient of restitution of a rigid stop is {found}, must be from 0 to 1")]
    #[expect(missing_docs, reason = "the message names its fields")]
    RigidRestitution { found: f64 },
    /// A law is asked for a constant that it does not have.
    #[error("{law} has no {constant}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NoConstant { law: &'static str, constant: &'static str },
    /// Another constant is not what its law allows.
    #[error("{what} is {found}, must be finite and {allowed}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Constant { what: &'static str, found: f64, allowed: &'static str },
    /// A hole has no law but that of a linear spring or of a Hertz contact.
    #[error("a round hole is elastic: a linear stop without a damper, or a Hertz contact")]
    NotForHole,
    /// A hole that fits closely has no gap to touch across.
    #[error("clearance of a round hole is {found} m, must be finite and more than 0")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Clearance { found: f64 },
    /// A text that is no formula of a force.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// A law that remembers how fast its contact began cannot be closed from the outset.
    #[error("the stop presses at rest, but its law needs the speed with which a contact begins")]
    MemoryOfPreload,
}

pub(super) fn positive_stiffness(found: f64) -> Result<(), LawError> {
    if found.is_finite() && found > 0.0 {
        Ok(())
    } else {
        Err(LawError::Stiffness { found, allowed: "positive" })
    }
}

pub(super) fn valid_gap(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Gap { found }) }
}

pub(super) fn valid_damping(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Damping { found }) }
}

pub(super) fn valid_preload(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Preload { found }) }
}
