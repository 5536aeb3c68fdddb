//! The force of a law at a point, where it begins, and when it presses.
//! Equation (L1) of the book, `docs/reference`.

/// Force of a law and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    /// Force on the structure along `r` [N].
    pub value: f64,
    /// `df/dr` [N/m].
    pub slope: f64,
    /// `df/dr'` [N s/m].
    pub damping: f64,
}

impl Force {
    /// No force.
    pub const ZERO: Self = Self { value: 0.0, slope: 0.0, damping: 0.0 };

    /// A force that does not depend on the velocity.
    pub(super) const fn elastic(value: f64, slope: f64) -> Self {
        Self { value, slope, damping: 0.0 }
    }
}

/// One of the ways in which an element can be loaded: contact is where `sign * (r - level) > 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Relative displacement at which the force begins [m].
    pub level: f64,
    /// +1.0 if contact lies above the level, -1.0 if below.
    pub sign: f64,
    /// Exponent with which the force sets in: 1.5 for Hertz, 1.0 for a linear spring.
    pub onset_exponent: f64,
}

/// What has to be positive besides the penetration p for a contact that loses energy to press: `displacement
/// p + velocity p' + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// Factor of the penetration.
    pub displacement: f64,
    /// Factor of its rate.
    pub velocity: f64,
    /// Constant part.
    pub offset: f64,
}

impl Pressure {
    /// Its value at a penetration and its rate.
    #[must_use]
    pub fn at(&self, penetration: f64, rate: f64) -> f64 {
        self.displacement * penetration + self.velocity * rate + self.offset
    }
}

/// A one-sided contact whose force begins at a level.
pub(super) const fn one_sided(level: f64, onset_exponent: f64) -> [Contact; 1] {
    [Contact { level, sign: 1.0, onset_exponent }]
}
