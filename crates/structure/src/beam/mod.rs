//! Beams with points: uniform ones, and those of several spans.

mod change;
mod element;
mod mesh;
mod point;
mod stepped;
mod timoshenko;

pub use change::{BeamChange, Boundary, PointChange};
pub use point::{BeamPoint, End};
pub use stepped::{BeamSpan, Shear, SteppedBeam};

use crate::{Section, Structure, StructureError};

/// A uniform Euler-Bernoulli beam.
///
/// `EI w'''' + rho A w_tt = 0` between the points; cubic elements with consistent mass, displacement
/// and rotation at every node. The points `left` and `right` always exist.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Length [m].
    pub length: f64,
    /// Number of elements, shared over the stretches between ends and points as evenly as possible, with at
    /// least one each and up to four on a short one; at most 1000. The dense eigenproblem costs the cube:
    /// see [`Structure::reduce`].
    pub elements: usize,
    /// Cross-section.
    pub section: Section,
    /// Young's modulus `E` [Pa]; see [`crate::PLAUSIBLE_YOUNGS_MODULUS`].
    pub youngs_modulus: f64,
    /// Density `rho` [kg/m^3]; see [`crate::PLAUSIBLE_DENSITY`].
    pub density: f64,
    /// How the left end is held.
    pub left: End,
    /// How the right end is held.
    pub right: End,
    /// Places with masses, springs and dampers, or where motion and forces are wanted.
    pub points: Vec<BeamPoint>,
}

impl Beam {
    /// Checks and assembles the beam.
    ///
    /// # Errors
    /// Numbers out of their range, points off the beam, names used twice or reserved, too few elements.
    pub fn structure(&self) -> Result<Structure, StructureError> {
        self.stepped().structure()
    }

    /// Whether [`Self::structure`] would take the beam; nothing is assembled.
    ///
    /// # Errors
    /// As [`Self::structure`].
    pub fn check(&self) -> Result<(), StructureError> {
        self.stepped().check()
    }

    /// The beam as one of a single span.
    #[must_use]
    pub fn stepped(&self) -> SteppedBeam {
        let span = BeamSpan {
            length: self.length,
            section: self.section,
            youngs_modulus: self.youngs_modulus,
            density: self.density,
            added_mass: 0.0,
            shear: None,
        };
        SteppedBeam {
            elements: self.elements,
            spans: vec![span],
            left: self.left,
            right: self.right,
            points: self.points.clone(),
        }
    }
}
