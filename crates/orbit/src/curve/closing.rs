//! What of an orbit the segments of shooting are.

/// What of the orbit the segments of shooting are, and how the state comes back at their end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Closing {
    /// The whole orbit, to the state as it was.
    Periodic,
    /// Half of it, to the state with its sign changed.
    Mirrored,
}

impl Closing {
    /// Which share of the orbit the segments are.
    pub fn share(self) -> f64 {
        match self {
            Self::Periodic => 1.0,
            Self::Mirrored => 0.5,
        }
    }

    /// By what the state is multiplied at the end.
    pub fn sign(self) -> f64 {
        match self {
            Self::Periodic => 1.0,
            Self::Mirrored => -1.0,
        }
    }
}

/// The period multiple and the closing of the map over half an orbit of N periods.
pub(super) fn half_of(period_multiple: u32) -> (u32, Closing) {
    if period_multiple.is_multiple_of(2) {
        (period_multiple / 2, Closing::Periodic)
    } else {
        (period_multiple, Closing::Mirrored)
    }
}
