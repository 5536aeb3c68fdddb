//! Beams of several spans, each with its own section and material.

use faer::Mat;

use super::{
    element, mesh,
    point::{BeamPoint, End},
    timoshenko,
};
use crate::{
    Section, Structure, StructureError,
    assembly::Assembly,
    error::{not_negative, positive},
    names::check_names,
    strain::Strains,
    structure::{Kind, NamedCoordinate, Place},
};

/// Shear of a section, for the theory of Timoshenko.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shear {
    /// Shear modulus `G` [Pa].
    pub modulus: f64,
    /// Shear coefficient `kappa` [-]; see [`Section::shear_coefficient`].
    pub coefficient: f64,
}

/// A stretch of a beam with one section and one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamSpan {
    /// Length [m].
    pub length: f64,
    /// Cross-section.
    pub section: Section,
    /// Young's modulus `E` [Pa].
    pub youngs_modulus: f64,
    /// Density `rho` [kg/m^3].
    pub density: f64,
    /// Mass per length that moves with the span and does not stiffen it [kg/m].
    pub added_mass: f64,
    /// Shear; without it the span bends after Euler and Bernoulli, without shear and rotary inertia.
    pub shear: Option<Shear>,
}

/// A beam of several spans, from left to right.
///
/// Displacement and rotation are continuous where two spans meet. A span without shear obeys
/// `E I w'''' + (rho A + m) w_tt = 0`; one with shear the equations of Timoshenko,
///
/// `(rho A + m) w_tt = (kappa G A (w' - psi))'`, `rho I psi_tt = (E I psi')' + kappa G A (w' - psi)`,
///
/// where the rotation at the nodes is that of the section, `psi`.
#[derive(Debug, Clone, PartialEq)]
pub struct SteppedBeam {
    /// Number of elements, shared over the stretches between ends, points and borders of spans as evenly as
    /// possible, with at least one each and up to four on a short one; at most 1000.
    pub elements: usize,
    /// The spans; at least one.
    pub spans: Vec<BeamSpan>,
    /// How the left end is held.
    pub left: End,
    /// How the right end is held.
    pub right: End,
    /// Places with supports, masses, springs and dampers, or where motion and forces are wanted.
    pub points: Vec<BeamPoint>,
}

impl SteppedBeam {
    /// Length of all spans [m].
    #[must_use]
    pub fn length(&self) -> f64 {
        self.spans.iter().map(|span| span.length).sum()
    }

    /// Checks and assembles the beam.
    ///
    /// # Errors
    /// Numbers out of their range, points off the beam, names used twice or reserved, too few elements.
    pub fn structure(&self) -> Result<Structure, StructureError> {
        self.check_numbers()?;
        let mesh = self.mesh()?;
        let mut assembly = self.assembled(&mesh);
        for (point, &node) in self.points.iter().zip(&mesh.nodes) {
            attach(&mut assembly, point, 2 * node);
        }
        let names = self.points.iter().map(|point| point.name.as_str()).chain(["left", "right"]);
        let points = names
            .zip(&mesh.nodes)
            .map(|(name, &node)| NamedCoordinate { name: name.into(), coordinate: 2 * node });
        let places = mesh.positions.iter().enumerate().map(|(node, &at)| Place { at, coordinate: 2 * node });
        let held = self.held(&mesh);
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

    /// Nodes of the points, of the left and the right end, and of the borders between spans.
    pub(super) fn mesh(&self) -> Result<mesh::Mesh, StructureError> {
        let borders = self.borders();
        let length = self.length();
        let points = self.points.iter().map(|point| (point.name.as_str(), point.at));
        let ends = [("left", 0.0), ("right", length)];
        let borders = borders.iter().map(|(name, at)| (name.as_str(), *at));
        let places: Vec<(&str, f64)> = points.chain(ends).chain(borders).collect();
        mesh::divide(length, self.elements, &places)
    }

    /// Where spans meet, with names for messages.
    fn borders(&self) -> Vec<(String, f64)> {
        let mut at = 0.0;
        let end = |(index, span): (usize, &BeamSpan)| {
            at += span.length;
            (format!("end of span {}", index + 1), at)
        };
        self.spans.iter().take(self.spans.len().saturating_sub(1)).enumerate().map(end).collect()
    }

    fn check_numbers(&self) -> Result<(), StructureError> {
        for (index, span) in self.spans.iter().enumerate() {
            let of = if self.spans.len() > 1 { format!("span {}", index + 1) } else { "the beam".to_owned() };
            span.check(&of)?;
        }
        positive("length of the beam", self.length())?;
        check_names("point", self.points.iter().map(|point| point.name.as_str()))?;
        self.points.iter().try_for_each(|point| point.check(self.length()))
    }

    /// Mass and strains of all elements; coordinates `(w, theta)` node after node.
    fn assembled(&self, mesh: &mesh::Mesh) -> Assembly {
        let size = 2 * mesh.positions.len();
        let mut mass = Mat::zeros(size, size);
        let mut stiffness = Strains::default();
        // Nodes at which spans end, but for the last one.
        let ends = &mesh.nodes[self.points.len() + 2..];
        for (element, nodes) in mesh.positions.windows(2).enumerate() {
            let (first, length) = (2 * element, nodes[1] - nodes[0]);
            let span = &self.spans[ends.iter().filter(|end| **end <= element).count()];
            let own = span.mass(length);
            for i in 0..4 {
                for j in 0..4 {
                    mass[(first + i, first + j)] += own[(i, j)];
                }
            }
            for row in span.strains(length) {
                stiffness.push((0..4).map(|i| (first + i, row[i])).collect::<Vec<_>>());
            }
        }
        let translation = (0..size).map(|index| if index % 2 == 0 { 1.0 } else { 0.0 }).collect();
        Assembly { mass, stiffness, damping: Strains::default(), translation }
    }

    /// Which coordinates ends and supports hold.
    fn held(&self, mesh: &mesh::Mesh) -> Vec<bool> {
        let mut held = vec![false; 2 * mesh.positions.len()];
        let supports = self.points.iter().map(|point| point.support).chain([self.left, self.right]);
        for (end, node) in supports.zip(&mesh.nodes) {
            held[2 * node] |= end.holds_displacement();
            held[2 * node + 1] |= end.holds_rotation();
        }
        held
    }
}

impl BeamSpan {
    fn check(&self, of: &str) -> Result<(), StructureError> {
        let what = |quantity: &str| match of {
            "the beam" => quantity.to_owned(),
            of => format!("{quantity} of {of}"),
        };
        positive(&format!("length of {of}"), self.length)?;
        positive(&what("Young's modulus"), self.youngs_modulus)?;
        positive(&what("density"), self.density)?;
        not_negative(&what("added mass"), self.added_mass)?;
        if let Some(shear) = &self.shear {
            positive(&what("shear modulus"), shear.modulus)?;
            positive(&what("shear coefficient"), shear.coefficient)?;
        }
        Ok(())
    }

    /// `rho A + m` [kg/m].
    fn mass_per_length(&self) -> f64 {
        self.density * self.section.area() + self.added_mass
    }

    fn bending_stiffness(&self) -> f64 {
        self.youngs_modulus * self.section.second_moment()
    }

    /// `12 E I / (kappa G A l^2)`: compliance in shear over that in bending.
    fn shear_number(&self, shear: &Shear, length: f64) -> f64 {
        let stiffness = shear.coefficient * shear.modulus * self.section.area();
        12.0 * self.bending_stiffness() / (stiffness * length * length)
    }

    fn mass(&self, length: f64) -> Mat<f64> {
        match &self.shear {
            None => element::consistent_mass(self.mass_per_length(), length),
            Some(shear) => {
                let rotary = self.density * self.section.second_moment();
                let number = self.shear_number(shear, length);
                timoshenko::consistent_mass((self.mass_per_length(), rotary), length, number)
            }
        }
    }

    fn strains(&self, length: f64) -> [[f64; 4]; 2] {
        match &self.shear {
            None => element::bending_strains(self.bending_stiffness(), length),
            Some(shear) => {
                timoshenko::strains(self.bending_stiffness(), length, self.shear_number(shear, length))
            }
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
