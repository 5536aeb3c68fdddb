//! What bounds all derivatives of a known function of time at once.

/// Bounds on the derivatives of a function q over a time: `|q'| <= speed` and, for `j >= 2`,
///
/// `|q^(j)| <= rate^(j - 2) (rate speed + acceleration)`,
///
/// up to the derivative [`Majorant::DERIVATIVES`].
///
/// `A cos(w t)` has the speed `A w` and the rate w, without an acceleration of its own; a parabola the
/// largest of its velocity, and its acceleration, with the rate 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Majorant {
    pub speed: f64,
    pub rate: f64,
    pub acceleration: f64,
}

impl Majorant {
    /// Highest derivative that is bounded.
    pub const DERIVATIVES: u32 = 24;
}
