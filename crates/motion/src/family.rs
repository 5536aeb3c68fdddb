//! Systems over a number that the structure itself depends on, as a stiffness or a length: each value has
//! modes of its own.

use crate::System;

/// Systems over a number. Their modal coordinates depend on it smoothly: modes keep their order and their
/// signs, and elements and loads theirs.
pub trait Family: std::fmt::Debug + Send + Sync {
    /// The system with a value of the number.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn member(&self, value: f64) -> Result<Member, String>;
}

/// A system of a family.
#[derive(Debug, Clone)]
pub struct Member {
    /// The system.
    pub system: System,
    /// The response point in its coordinates: shape, length n, and support ratios.
    pub response: (Vec<f64>, Vec<f64>),
}
