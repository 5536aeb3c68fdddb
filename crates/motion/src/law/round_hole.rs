//! A round hole around a point that moves in two directions, without friction.
//! Equations (L13) and (L14) of the book, `docs/reference`.
//!
//! With the displacement `r = (y, z)` across the axis of the hole, its length `rho` and the clearance `c`,
//! the force is that of a one-sided law `f` of the penetration `rho - c`, along the radius:
//!
//! `F = f(rho) n`, `n = r/rho`, `dF = (f' n n^T + (f/rho) (1 - n n^T)) dr`.
//!
//! It is the gradient of a potential, so an elastic hole takes no energy; and it has no moment about the
//! axis. For motions in one direction it is a stop on both sides at the gap c.
//!
//! # The reading
//! The radius has no derivatives at the centre, and its second one grows there without bound. What tells of
//! contact is therefore the *reading*
//!
//! `R = c/2 + (y^2 + z^2)/(2 c)`, `R - c = (rho - c) (rho + c)/(2 c)`,
//!
//! which is c where the radius is c, about the radius near there, and a polynomial of the displacements:
//!
//! `R' = r . r'/c`, `R'' = (r' . r' + r . r'')/c`, `R''' = (3 r' . r'' + r . r''')/c`.
//!
//! With bounds P, V, A and J on `|r|` and its first three derivatives over some time ahead,
//!
//! `|R''| <= (V^2 + P A)/c` and `|R'''| <= (3 V A + P J)/c`
//!
//! there, by the inequality of Cauchy and Schwarz. These are the bounds that the certified search for
//! contacts needs of a relative displacement, so it serves a hole with R in the place of r.
//!
//! # Two elements
//! A hole is two local elements, one after the other: [`RoundHole`] has the law, the contact and the first
//! direction; [`AcrossHole`] the second direction, and nothing else. What is asked of the contact of a hole
//! is asked of the first; its force takes the reading.

use super::{
    Contact, Force, ForceLaw, LawConstant, LawError, force_law::no_constant, one_sided, positive_stiffness,
};

/// A round hole, as the element of its first direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundHole {
    stiffness: f64,
    contact: [Contact; 1],
}

/// The second direction of the round hole that the element before it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AcrossHole;

/// The force of a hole and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HoleForce {
    /// `F` [N].
    pub value: [f64; 2],
    /// `dF_y/dy` and `dF_z/dz` [N/m].
    pub slopes: [f64; 2],
    /// `dF_y/dz = dF_z/dy` [N/m].
    pub cross: f64,
    /// `n`.
    pub normal: [f64; 2],
}

impl RoundHole {
    /// A hole with a linear spring of stiffness `k` [N/m] along the radius: `f = -k (rho - c)`.
    ///
    /// * `clearance`: c [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Clearance`] unless finite and more
    /// than
    /// 0.
    pub fn linear(stiffness: f64, clearance: f64) -> Result<Self, LawError> {
        Self::with_exponent(stiffness, clearance, 1.0)
    }

    /// A hole with a Hertz contact of stiffness `k` [N/m^1.5] along the radius: `f = -k (rho - c)^1.5`.
    ///
    /// # Errors
    /// As [`RoundHole::linear`].
    pub fn hertz(stiffness: f64, clearance: f64) -> Result<Self, LawError> {
        Self::with_exponent(stiffness, clearance, 1.5)
    }

    fn with_exponent(stiffness: f64, clearance: f64, exponent: f64) -> Result<Self, LawError> {
        positive_stiffness(stiffness)?;
        if !(clearance.is_finite() && clearance > 0.0) {
            return Err(LawError::Clearance { found: clearance });
        }
        Ok(Self { stiffness, contact: one_sided(clearance, exponent) })
    }

    /// The clearance c [m].
    #[must_use]
    pub fn clearance(&self) -> f64 {
        self.contact[0].level
    }

    /// The radius at which the reading is R [m].
    #[must_use]
    pub fn radius(&self, reading: f64) -> f64 {
        let clearance = self.clearance();
        (clearance * (2.0 * reading - clearance)).max(0.0).sqrt()
    }

    /// The reading R and its first two derivatives by the time, from those of the displacements.
    pub(crate) fn reading(&self, y: [f64; 3], z: [f64; 3]) -> [f64; 3] {
        let clearance = self.clearance();
        [
            0.5 * clearance + 0.5 * (y[0] * y[0] + z[0] * z[0]) / clearance,
            (y[0] * y[1] + z[0] * z[1]) / clearance,
            (y[1] * y[1] + z[1] * z[1] + y[0] * y[2] + z[0] * z[2]) / clearance,
        ]
    }

    /// The force on a point at that displacement.
    pub(crate) fn force_at(&self, r: [f64; 2]) -> HoleForce {
        self.along_radius(r, |rho| self.radial_force(rho))
    }

    /// The force of a hole that is held closed, continued by its tangent to where the contact has ended.
    pub(crate) fn continued_force_at(&self, r: [f64; 2]) -> HoleForce {
        self.along_radius(r, |rho| {
            let penetration = rho - self.clearance();
            if penetration > 0.0 || self.contact[0].onset_exponent > 1.0 {
                return self.radial_force(rho);
            }
            Force::elastic(-self.stiffness * penetration, -self.stiffness)
        })
    }

    fn radial_force(&self, radius: f64) -> Force {
        let penetration = radius - self.clearance();
        if penetration <= 0.0 {
            return Force::ZERO;
        }
        if self.contact[0].onset_exponent == 1.0 {
            return Force::elastic(-self.stiffness * penetration, -self.stiffness);
        }
        let root = penetration.sqrt();
        Force::elastic(-self.stiffness * penetration * root, -1.5 * self.stiffness * root)
    }

    fn along_radius(&self, r: [f64; 2], radial: impl Fn(f64) -> Force) -> HoleForce {
        let rho = r[0].hypot(r[1]);
        // Where there is no direction there is no force either: the clearance is more than 0.
        let normal = if rho > 0.0 { r.map(|part| part / rho) } else { [1.0, 0.0] };
        let force = radial(rho);
        let turning = if rho > 0.0 { force.value / rho } else { 0.0 };
        let difference = force.slope - turning;
        HoleForce {
            value: normal.map(|part| force.value * part),
            slopes: normal.map(|part| turning + difference * part * part),
            cross: difference * normal[0] * normal[1],
            normal,
        }
    }
}

impl ForceLaw for RoundHole {
    /// The radial force by the reading: `dR/drho = rho/c`.
    fn force(&self, displacement: f64, _: f64) -> Force {
        let radius = self.radius(displacement);
        let force = self.radial_force(radius);
        if force.value == 0.0 {
            return Force::ZERO;
        }
        Force { slope: force.slope * self.clearance() / radius, ..force }
    }

    fn contacts(&self) -> &[Contact] {
        &self.contact
    }

    fn is_odd(&self) -> bool {
        true
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Stiffness).then_some(self.stiffness)
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Gap => Self::with_exponent(self.stiffness, value, self.contact[0].onset_exponent),
            LawConstant::Stiffness => {
                positive_stiffness(value)?;
                Ok(Self { stiffness: value, ..*self })
            }
            other => no_constant("a round hole", other),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.constant(constant)
    }
}

impl ForceLaw for AcrossHole {
    /// The force is that of the element before.
    fn force(&self, _: f64, _: f64) -> Force {
        Force::ZERO
    }

    fn is_odd(&self) -> bool {
        true
    }

    fn constant(&self, _: LawConstant) -> Option<f64> {
        None
    }

    fn with_constant(&self, constant: LawConstant, _: f64) -> Result<Self, LawError> {
        no_constant("the second direction of a round hole", constant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holes() -> [RoundHole; 2] {
        [RoundHole::linear(1.6e5, 1e-3).unwrap(), RoundHole::hertz(4.5e9, 1e-3).unwrap()]
    }

    /// In the direction (3, 4)/5, 0.2 mm beyond the clearance.
    #[test]
    fn force_is_that_of_the_radial_law_along_the_radius() {
        let r = [0.6 * 1.2e-3, 0.8 * 1.2e-3];
        for (hole, expected) in holes().iter().zip([-1.6e5 * 2e-4, -4.5e9 * 2e-4_f64.powf(1.5)]) {
            let force = hole.force_at(r);
            assert!((force.value[0] - 0.6 * expected).abs() < 1e-11 * expected.abs());
            assert!((force.value[1] - 0.8 * expected).abs() < 1e-11 * expected.abs());
            assert_eq!(hole.force_at([0.3e-3, -0.9e-3]).value, [0.0; 2]);
            assert_eq!(hole.force_at([0.0; 2]).value, [0.0; 2]);
        }
    }

    #[test]
    fn derivatives_of_the_force_agree_with_differences() {
        for hole in holes() {
            for r in [[1.1e-3, 0.2e-3], [-0.8e-3, 0.9e-3], [0.0, -1.3e-3]] {
                let step = 1e-9;
                let by = |part: usize| {
                    let moved = |sign: f64| {
                        let mut moved = r;
                        moved[part] += sign * step;
                        hole.force_at(moved).value
                    };
                    let (after, before) = (moved(1.0), moved(-1.0));
                    [0, 1].map(|k: usize| (after[k] - before[k]) / (2.0 * step))
                };
                let (by_y, by_z, found) = (by(0), by(1), hole.force_at(r));
                let scale = found.slopes[0].abs() + found.slopes[1].abs();
                for (slope, difference) in [
                    (found.slopes[0], by_y[0]),
                    (found.slopes[1], by_z[1]),
                    (found.cross, by_y[1]),
                    (found.cross, by_z[0]),
                ] {
                    assert!((slope - difference).abs() < 1e-6 * scale, "{r:?}: {slope}, {difference}");
                }
            }
        }
    }

    /// On the circle `r = 2 c (cos t, sin t)` the reading is `c/2 + 2 c`, at rest; on the line `y = t` it is
    /// `c/2 + t^2/(2 c)`.
    #[test]
    fn reading_is_the_clearance_where_the_radius_is() {
        let hole = holes()[0];
        let c = hole.clearance();
        let (sin, cos) = 0.7_f64.sin_cos();
        let ring = hole.reading(
            [2.0 * c * cos, -2.0 * c * sin, -2.0 * c * cos],
            [2.0 * c * sin, 2.0 * c * cos, -2.0 * c * sin],
        );
        assert!(
            (ring[0] - 2.5 * c).abs() < 1e-18 && ring[1].abs() < 1e-18 && ring[2].abs() < 1e-17,
            "{ring:?}"
        );
        let line = hole.reading([c, 1.0, 0.0], [0.0; 3]);
        assert_eq!(line, [c, 1.0, 1.0 / c]);
        assert!((hole.radius(ring[0]) - 2.0 * c).abs() < 1e-17);
        assert!((hole.radius(c) - c).abs() < 1e-18);
    }

    #[test]
    fn holes_without_clearance_or_stiffness_are_refused() {
        assert_eq!(RoundHole::linear(1e5, 0.0), Err(LawError::Clearance { found: 0.0 }));
        assert!(matches!(RoundHole::hertz(0.0, 1e-3), Err(LawError::Stiffness { .. })));
        assert_eq!(
            holes()[1].with_constant(LawConstant::Gap, -1e-3),
            Err(LawError::Clearance { found: -1e-3 })
        );
    }
}
