//! What can be wrong with a system.

/// Why a model, a load and elements do not make a system.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// A vector over the modes has the wrong length.
    #[error("{what} has {found} entries, the model has {expected} modes")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Length { what: String, found: usize, expected: usize },
    /// Support motion is prescribed, but the model has no moving support.
    #[error("support motion is prescribed, but no support of the structure can move")]
    NoMovingSupport,
    /// A motion, or an element, is of a support that the model does not have.
    #[error("{what} is of support {number}, the model has {count} that move")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NoSuchSupport { what: String, number: usize, count: usize },
    /// A number of the model, the load or an element is infinite or not a number.
    #[error("{what} holds {found}, must be finite")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NotFinite { what: String, found: f64 },
    /// The two directions of a hole are two elements, one after the other.
    #[error("element {name} is one direction of a round hole without the other beside it")]
    #[expect(missing_docs, reason = "the message names its fields")]
    HalfHole { name: String },
    /// Rigid stops, and forces that depend on the velocity, cannot act beside a hole.
    #[error("element {name} is rigid or loses energy, which does not go beside the round hole {hole}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    BesideHole { name: String, hole: String },
    /// A constant load has no amplitude over the frequency.
    #[error("a load of order 0 cannot have an amplitude over the frequency")]
    ConstantOverFrequency,
}
