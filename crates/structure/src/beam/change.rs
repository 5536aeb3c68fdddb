//! Derivatives of the eigenfrequencies of a beam by what describes it.
//!
//! For a mass-normalised mode `phi` of the frequency w, and any parameter p,
//!
//! `dw/dp = (phi^T dK/dp phi - w^2 phi^T dM/dp phi)/(2 w)`,
//!
//! since the derivative of the mode itself does not enter. With strains, `phi^T dK phi = 2 (G phi) . (dG
//! phi)` over the elements, and `dk phi_c^2` for a spring at the coordinate c. Nodes move with the ends and
//! points between which they lie, so the number of elements on a stretch does not change, as it may between
//! two beams that are computed one after the other. Multiple eigenfrequencies do not occur in the bending of
//! a beam that hangs together.
//!
//! # Source
//! Fox and Kapoor, AIAA J. 6 (1968), 2426-2429.

use faer::Mat;

use super::{
    Beam,
    element::{bending_strain_rates, bending_strains, consistent_mass, consistent_mass_rate},
};
use crate::{StructureError, modes::Modes};

/// Which coordinates of a structure are free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// Its supports hold, a moving one is at rest.
    Supported,
    /// What is moved is let go.
    Released,
}

/// Derivatives of what describes a beam by some parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BeamChange {
    /// Of the length.
    pub length: f64,
    /// Of the bending stiffness `E I` [N m^2].
    pub bending_stiffness: f64,
    /// Of the mass per length `rho A` [kg/m].
    pub mass_per_length: f64,
    /// Of the points: as many as the beam has, or none if nothing of them changes.
    pub points: Vec<PointChange>,
}

/// Derivatives of what describes a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointChange {
    /// Of its distance from the left end.
    pub at: f64,
    /// Of the mass [kg].
    pub mass: f64,
    /// Of the rotary inertia [kg m^2].
    pub rotary_inertia: f64,
    /// Of the spring [N/m].
    pub spring: f64,
    /// Of the rotational spring [N m/rad].
    pub rotational_spring: f64,
}

impl Beam {
    /// Derivatives of the eigenfrequencies [Hz] by a parameter, in the order of the eigenfrequencies; 0 for
    /// rigid-body modes.
    ///
    /// `None` where the change would tear apart points that share a place, so that the mesh has no
    /// derivative.
    ///
    /// * `moving`: points whose motion is prescribed.
    ///
    /// # Errors
    /// As [`Beam::structure`] and [`crate::Structure::eigenfrequencies_hz`].
    pub fn eigenfrequency_derivatives(
        &self,
        moving: &[&str],
        boundary: Boundary,
        change: &BeamChange,
    ) -> Result<Option<Vec<f64>>, StructureError> {
        let structure = self.structure()?.with_support_motion(moving)?;
        let mesh = self.stepped().mesh()?;
        let Some(moved) = self.node_rates(&mesh.nodes, mesh.positions.len(), change) else { return Ok(None) };
        let coordinates = match boundary {
            Boundary::Supported => structure.free_coordinates(),
            Boundary::Released => structure.released_coordinates(),
        };
        let modes = Modes::over(&structure.assembly, &coordinates)?;
        let mut shape = vec![0.0; 2 * mesh.positions.len()];
        let derivative = |(mode, w): (usize, &f64)| {
            if *w == 0.0 {
                return 0.0;
            }
            for (row, coordinate) in coordinates.iter().enumerate() {
                shape[*coordinate] = modes.shapes[(row, mode)];
            }
            let elements = self.element_forms(&mesh.positions, &moved, change, &shape);
            let points = self.point_forms(&mesh.nodes, change, &shape);
            let (stiffness, mass) = (elements.0 + points.0, elements.1 + points.1);
            (stiffness - w * w * mass) / (2.0 * w) / std::f64::consts::TAU
        };
        Ok(Some(modes.frequencies.iter().enumerate().map(derivative).collect()))
    }

    /// Derivatives of the positions of all nodes.
    ///
    /// * `nodes`: of the points, then of the left and the right end.
    fn node_rates(&self, nodes: &[usize], count: usize, change: &BeamChange) -> Option<Vec<f64>> {
        let points = (0..self.points.len()).map(|k| change.points.get(k).map_or(0.0, |point| point.at));
        let mut corners: Vec<(usize, f64)> =
            nodes.iter().copied().zip(points.chain([0.0, change.length])).collect();
        corners.sort_by_key(|corner| corner.0);
        let torn = |pair: &[(usize, f64)]| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1;
        if corners.windows(2).any(torn) {
            return None;
        }
        let mut rates = vec![0.0; count];
        for pair in corners.windows(2) {
            let ((first, from), (last, to)) = (pair[0], pair[1]);
            for node in first..=last {
                let part = if last > first { (node - first) as f64 / (last - first) as f64 } else { 0.0 };
                rates[node] = from + part * (to - from);
            }
        }
        Some(rates)
    }

    /// `phi^T dK phi` and `phi^T dM phi` of the elements.
    fn element_forms(
        &self,
        positions: &[f64],
        moved: &[f64],
        change: &BeamChange,
        shape: &[f64],
    ) -> (f64, f64) {
        let bending = self.youngs_modulus * self.section.second_moment();
        let per_length = self.density * self.section.area();
        let (mut stiffness, mut mass) = (0.0, 0.0);
        for element in 0..positions.len() - 1 {
            let x = &shape[2 * element..2 * element + 4];
            let length = positions[element + 1] - positions[element];
            let lengthened = moved[element + 1] - moved[element];
            let strains = bending_strains(bending, length);
            let rates = bending_strain_rates(bending, length, (change.bending_stiffness, lengthened));
            let along = |row: &[f64; 4]| -> f64 { row.iter().zip(x).map(|(a, x)| a * x).sum() };
            stiffness += strains.iter().zip(&rates).map(|(g, dg)| 2.0 * along(g) * along(dg)).sum::<f64>();
            if lengthened != 0.0 {
                mass += form(&consistent_mass_rate(per_length, length), x) * lengthened;
            }
            if change.mass_per_length != 0.0 {
                mass += form(&consistent_mass(change.mass_per_length, length), x);
            }
        }
        (stiffness, mass)
    }

    /// The same of what the points carry.
    fn point_forms(&self, nodes: &[usize], change: &BeamChange, shape: &[f64]) -> (f64, f64) {
        let squares = change.points.iter().zip(nodes).map(|(point, &node)| {
            let (w, theta) = (shape[2 * node].powi(2), shape[2 * node + 1].powi(2));
            (
                point.spring * w + point.rotational_spring * theta,
                point.mass * w + point.rotary_inertia * theta,
            )
        });
        squares.fold((0.0, 0.0), |sum, form| (sum.0 + form.0, sum.1 + form.1))
    }
}

/// `x^T A x`.
fn form(matrix: &Mat<f64>, x: &[f64]) -> f64 {
    (0..4).map(|i| (0..4).map(|j| x[i] * matrix[(i, j)] * x[j]).sum::<f64>()).sum()
}
