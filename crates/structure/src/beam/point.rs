//! Points of a beam: what is attached there and how they are held; ends, which are held alike.

use crate::{
    StructureError,
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
    pub(super) fn holds_displacement(self) -> bool {
        matches!(self, Self::Clamped | Self::Pinned)
    }

    pub(super) fn holds_rotation(self) -> bool {
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

impl BeamPoint {
    pub(super) fn check(&self, length: f64) -> Result<(), StructureError> {
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
