//! Where a branch sets out from its start.

/// Where a branch sets out from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StartDirection<'a> {
    /// The parameter increases at first. The start is corrected at fixed parameter.
    Increasing,
    /// The parameter decreases at first. The start is corrected at fixed parameter.
    Decreasing,
    /// Along this vector `v`, length `n + 1`: the start is corrected in the plane `⟨v, z − z_start⟩ = 0`, and
    /// the tangent has `⟨v, t⟩ > 0`. For starts at folds and beside branch points.
    Along(&'a [f64]),
}

impl StartDirection<'_> {
    pub(super) fn sign(self) -> f64 {
        if self == StartDirection::Decreasing { -1.0 } else { 1.0 }
    }
}
