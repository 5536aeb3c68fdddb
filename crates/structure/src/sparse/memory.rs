//! What memory the modes of sparse matrices take, known before most of it is taken.
//!
//! `K - sigma M` is factored to count the modes below the cut-off, and again to find them. One of these sets
//! of factors is there at a time; beside it that of another pencil, where its static answers are still
//! needed. The vectors of the search come when the work space of the factors is gone.

use std::fmt;

use super::{krylov_size::most_vectors, matrix::SymmetricMatrix};

/// Copies of stiffness and mass: as given, joined, assembled, over the free coordinates.
const COPIES: u64 = 4;

/// Memory that modes take [bytes].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryNeed {
    /// Stiffness and mass in all their copies, and their common pattern.
    pub matrices: u64,
    /// Factors, with the rows of their entries.
    pub factors: u64,
    /// Factors of another form of the structure that are still needed.
    pub held_factors: u64,
    /// Work space while factors are found.
    pub work: u64,
    /// Vectors of the search for modes, at most.
    pub vectors: u64,
}

impl MemoryNeed {
    /// All that is needed at one time [bytes].
    #[must_use]
    pub fn total(&self) -> u64 {
        self.matrices + self.factors + self.held_factors + self.work.max(self.vectors)
    }
}

impl fmt::Display for MemoryNeed {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [total, matrices, factors, work] =
            [self.total(), self.matrices, self.factors + self.held_factors, self.work.max(self.vectors)]
                .map(in_gigabytes);
        write!(formatter, "{total} GB (matrices {matrices}, factors {factors}, vectors {work})")
    }
}

/// With two digits at least.
pub(crate) fn in_gigabytes(bytes: u64) -> String {
    let gigabytes = bytes as f64 / 1e9;
    let decimals = if gigabytes >= 1.0 {
        1
    } else if gigabytes >= 0.1 {
        2
    } else {
        4
    };
    format!("{gigabytes:.decimals$}")
}

/// What may be taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MemoryBudget {
    /// In all [bytes].
    pub limit_bytes: u64,
    /// Taken by factors that stay [bytes].
    pub held_factors: u64,
}

impl MemoryBudget {
    /// All of it is free.
    pub fn of(limit_bytes: u64) -> Self {
        Self { limit_bytes, held_factors: 0 }
    }
}

/// Bytes of stiffness, mass and the common pattern of so many entries, whose `K - sigma M` is a copy more.
pub(super) fn of_matrices(stiffness: &SymmetricMatrix, mass: &SymmetricMatrix, pattern: usize) -> u64 {
    let of_pattern = 4 * (pattern + stiffness.size() + 1) + 8 * pattern;
    COPIES * (stiffness.bytes() + mass.bytes()) + of_pattern as u64
}

/// Bytes of the vectors of a search for so many modes of so many coordinates.
pub(super) fn of_vectors(size: usize, modes: usize) -> u64 {
    8 * size as u64 * most_vectors(modes) as u64
}
