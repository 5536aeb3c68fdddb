//! Beams with points: uniform ones, and those of several spans.

mod change;
mod element;
mod mesh;
mod stepped;
mod timoshenko;

pub use change::{BeamChange, Boundary, PointChange};
pub use stepped::{BeamSpan, Shear, SteppedBeam};

use crate::{
    Section, Structure, StructureError,
    error::{finite, not_negative},
};

/// How an end of a beam, or a point on it, is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum End {
    /// No displacement, no rotation.
    Clamped,
    /// No displacement, free to rotate.
    Pinned,
    /// Free to move across, no rotation.
    Sliding,
    /// Not held.
    #[default]
    Free,
}

impl End {
    fn holds_displacement(self) -> bool {
        matches!(self, Self::Clamped | Self::Pinned)
    }

    fn holds_rotation(self) -> bool {
        matches!(self, Self::Clamped | Self::Sliding)
    }
}

/// A named place on a beam, with what is attached there; it becomes a node.
///
/// Springs and dampers go to the ground, which is fixed in space: it does not ride with a moving support.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BeamPoint {
    /// Name, unique; not `left`, `right`, `ground`, `space` or `support`.
    pub name: String,
    /// Distance from the left end [m].
    pub at: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Rotary inertia [kg m^2].
    pub rotary_inertia: f64,
    /// Transverse spring to the ground [N/m].
    pub spring: f64,
    /// Transverse damper to the ground [N s/m].
    pub damper: f64,
    /// Rotational spring to the ground [N m/rad].
    pub rotational_spring: f64,
    /// Rotational damper to the ground [N m s/rad].
    pub rotational_damper: f64,
    /// How the point is held: a support between the ends.
    pub support: End,
}

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

impl BeamPoint {
    fn check(&self, length: f64) -> Result<(), StructureError> {
        let what = |quantity: &str| format!("{quantity} of point \"{}\"", self.name);
        finite(&what("position"), self.at)?;
        not_negative(&what("mass"), self.mass)?;
        not_negative(&what("rotary inertia"), self.rotary_inertia)?;
        not_negative(&what("spring"), self.spring)?;
        not_negative(&what("damper"), self.damper)?;
        not_negative(&what("rotational spring"), self.rotational_spring)?;
        not_negative(&what("rotational damper"), self.rotational_damper)?;
        if (0.0..=length).contains(&self.at) {
            Ok(())
        } else {
            Err(StructureError::PointOffBeam { name: self.name.clone(), at: self.at, length })
        }
    }
}
