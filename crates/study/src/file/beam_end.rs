//! How an end of a beam, or a point on it, is held.

use hammerbeam_structure as linear;
use serde::Serialize;

/// Support of an end of a beam, or of a point on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EndSupport {
    /// Neither displacement nor rotation.
    Clamped,
    /// No displacement.
    Pinned,
    /// No rotation.
    Sliding,
    /// No support.
    Free,
}

impl EndSupport {
    /// Whether the support holds the displacement, so that its motion can be prescribed.
    #[must_use]
    pub fn holds_displacement(self) -> bool {
        matches!(self, Self::Clamped | Self::Pinned)
    }

    pub(super) fn descriptor(self) -> linear::End {
        match self {
            Self::Clamped => linear::End::Clamped,
            Self::Pinned => linear::End::Pinned,
            Self::Sliding => linear::End::Sliding,
            Self::Free => linear::End::Free,
        }
    }
}

/// The words for them.
pub(super) const END_KINDS: &[(&str, EndSupport)] = &[
    ("clamped", EndSupport::Clamped),
    ("pinned", EndSupport::Pinned),
    ("sliding", EndSupport::Sliding),
    ("free", EndSupport::Free),
];
