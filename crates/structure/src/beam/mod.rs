//! Uniform Euler-Bernoulli beams with points.

mod change;
mod element;
mod mesh;

pub use change::{BeamChange, Boundary, PointChange};
use faer::Mat;

use crate::{
    Section, Structure, StructureError,
    error::{finite, not_negative, positive},
    names::check_names,
    strain::Strains,
    structure::{Assembly, Kind, NamedCoordinate, Place},
};

/// How an end of a beam is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// No displacement, no rotation.
    Clamped,
    /// No displacement, free to rotate.
    Pinned,
    /// Free to move across, no rotation.
    Sliding,
    /// Not held.
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
        self.check_numbers()?;
        let mesh = self.mesh()?;
        let mut assembly = self.elements_between(&mesh.positions);
        for (point, &node) in self.points.iter().zip(&mesh.nodes) {
            attach(&mut assembly, point, 2 * node);
        }
        let points = self
            .places()
            .into_iter()
            .zip(&mesh.nodes)
            .map(|((name, _), &node)| NamedCoordinate { name: name.into(), coordinate: 2 * node });
        let places = mesh.positions.iter().enumerate().map(|(node, &at)| Place { at, coordinate: 2 * node });
        let held = self.held(mesh.positions.len());
        Ok(Structure::new(Kind::Beam, assembly, held, points.collect(), places.collect()))
    }

    /// Whether [`Self::structure`] would take the beam; nothing is assembled.
    ///
    /// # Errors
    /// As [`Self::structure`].
    pub fn check(&self) -> Result<(), StructureError> {
        self.check_numbers()?;
        self.mesh().map(drop)
    }

    /// Names and positions of the points, then of the left and the right end.
    fn places(&self) -> Vec<(&str, f64)> {
        let points = self.points.iter().map(|point| (point.name.as_str(), point.at));
        points.chain([("left", 0.0), ("right", self.length)]).collect()
    }

    fn mesh(&self) -> Result<mesh::Mesh, StructureError> {
        mesh::divide(self.length, self.elements, &self.places())
    }

    fn check_numbers(&self) -> Result<(), StructureError> {
        positive("length of the beam", self.length)?;
        positive("Young's modulus", self.youngs_modulus)?;
        positive("density", self.density)?;
        check_names("point", self.points.iter().map(|point| point.name.as_str()))?;
        self.points.iter().try_for_each(|point| point.check(self.length))
    }

    /// Mass and bending strains of all elements; coordinates `(w, theta)` node after node.
    fn elements_between(&self, positions: &[f64]) -> Assembly {
        let size = 2 * positions.len();
        let mut mass = Mat::zeros(size, size);
        let mut stiffness = Strains::default();
        for (element, ends) in positions.windows(2).enumerate() {
            let (first, length) = (2 * element, ends[1] - ends[0]);
            let own = element::consistent_mass(self.density * self.section.area(), length);
            for i in 0..4 {
                for j in 0..4 {
                    mass[(first + i, first + j)] += own[(i, j)];
                }
            }
            for row in element::bending_strains(self.youngs_modulus * self.section.second_moment(), length) {
                stiffness.push((0..4).map(|i| (first + i, row[i])).collect::<Vec<_>>());
            }
        }
        let translation = (0..size).map(|index| if index % 2 == 0 { 1.0 } else { 0.0 }).collect();
        Assembly { mass, stiffness, damping: Strains::default(), translation }
    }

    /// Which coordinates the ends hold.
    fn held(&self, nodes: usize) -> Vec<bool> {
        let mut held = vec![false; 2 * nodes];
        for (end, first) in [(self.left, 0), (self.right, 2 * nodes - 2)] {
            held[first] = end.holds_displacement();
            held[first + 1] = end.holds_rotation();
        }
        held
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

/// Adds what a point carries to the node whose displacement is the coordinate `w`.
fn attach(assembly: &mut Assembly, point: &BeamPoint, w: usize) {
    let theta = w + 1;
    assembly.mass[(w, w)] += point.mass;
    assembly.mass[(theta, theta)] += point.rotary_inertia;
    assembly.stiffness.connect(point.spring, w, None);
    assembly.stiffness.connect(point.rotational_spring, theta, None);
    assembly.damping.connect(point.damper, w, None);
    assembly.damping.connect(point.rotational_damper, theta, None);
}
