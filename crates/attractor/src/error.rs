//! Why a motion or what is made of it cannot be given.

use hammerbeam_motion::{exact::MotionError, general::GeneralError};

/// Why there is nothing to give.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum AttractorError {
    /// The exact integrator cannot go on.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The general integrator cannot go on.
    #[error(transparent)]
    General(#[from] GeneralError),
    /// A number that was asked for makes no sense.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: &'static str },
    /// A state has the wrong length.
    #[error("the state has {found} entries, the motion has {expected}")]
    StateLength { found: usize, expected: usize },
    /// A motion is to start behind a rigid stop, where no motion comes.
    #[error("the state lies {depth:.3e} m behind the rigid stop {stop:?}, where no motion comes")]
    BehindRigidStop { stop: String, depth: f64 },
    /// A motion is to start within a contact of an impact-speed-dependent law: the state does not say how
    /// fast that contact closed.
    #[error(
        "the state lies {depth:.3e} m within the contact of {stop:?}, \
        and its law needs to know how fast it closed"
    )]
    WithinContact { stop: String, depth: f64 },
    /// A contact of an impact-speed-dependent law stays closed in the settled motion: its force there depends
    /// on the speed of the first touch, and so on where the motion was started.
    #[error(
        "{element} is closed over the whole settled motion: its law needs to know how fast a contact began, \
        and that speed depends on where the motion was started"
    )]
    NeverOpens { element: String },
    /// Tangent vectors have become linearly dependent or infinite: the sections are too long for the growth
    /// in them.
    #[error("tangent vectors are no longer distinct after section {section}: a shorter section is needed")]
    TangentsLost { section: u64 },
}

/// Refuses a number.
pub(crate) fn ensure(
    what: &'static str,
    found: f64,
    allowed: &'static str,
    holds: bool,
) -> Result<(), AttractorError> {
    if holds { Ok(()) } else { Err(AttractorError::Input { what, found, allowed }) }
}
