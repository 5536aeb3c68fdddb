//! How large the basis of a search for modes becomes.

/// Vectors of a block: as many as a body has rigid motions.
pub(super) const BLOCK: usize = 6;

/// Length beyond which the basis of a search for so many modes is restarted.
pub(super) fn longest_basis(count: usize) -> usize {
    8 * count + 50 * BLOCK
}

/// Vectors that such a search holds at once, at most: the basis with the next block and what is made of it,
/// and at its end the modes in three forms with their products.
pub(super) fn most_vectors(count: usize) -> usize {
    longest_basis(count) + 2 * BLOCK + 4 * count
}
