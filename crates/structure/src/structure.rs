//! A validated linear structure: mass, stiffness and dampers over coordinates, some held, some prescribed.

use faer::Mat;

use crate::{
    StructureError,
    assembly::{Assembly, times},
    modes::Modes,
};

/// Which descriptor a structure came from; lumped ones are not reduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Beam,
    Lumped,
}

/// A name and the transverse displacement it stands for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedCoordinate {
    pub name: String,
    pub coordinate: usize,
}

/// A linear structure with its supports, made by [`crate::Beam::structure`] or [`crate::Lumped::structure`].
///
/// `M y'' + C y' + K y = f` over the free coordinates; held ones are zero, prescribed ones follow the
/// displacement `u_s(t)` of their support.
#[derive(Debug, Clone)]
pub struct Structure {
    pub(crate) kind: Kind,
    pub(crate) assembly: Assembly,
    held: Vec<bool>,
    /// Coordinates that follow each support.
    supports: Vec<Vec<usize>>,
    points: Vec<NamedCoordinate>,
    places: Vec<Place>,
}

/// A place of a structure: all of them in their order are its shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// Distance from the left end [m]; of a lumped structure the number of the mass, from 0.
    pub at: f64,
    /// Its transverse displacement.
    pub coordinate: usize,
}

impl Structure {
    pub(crate) fn new(
        kind: Kind,
        assembly: Assembly,
        held: Vec<bool>,
        points: Vec<NamedCoordinate>,
        places: Vec<Place>,
    ) -> Self {
        Self { kind, assembly, held, supports: Vec::new(), points, places }
    }

    /// Prescribes one support motion `u(t)` of the transverse displacement at each of the named points.
    ///
    /// At a clamped or pinned end the support moves; at any other point the structure is held by what
    /// moves it (rotations stay as they were). At `ground` of a lumped structure the ground moves as a
    /// whole. Springs and dampers of a beam's points stay fixed in space. Replaces an earlier choice;
    /// without a name nothing moves.
    ///
    /// # Errors
    /// A name that no point has.
    pub fn with_support_motion(self, at: &[&str]) -> Result<Self, StructureError> {
        self.with_support_motions(if at.is_empty() { &[] } else { std::slice::from_ref(&at) })
    }

    /// Prescribes several support motions `u_s(t)`, each at the points of a group; see
    /// [`Structure::with_support_motion`].
    ///
    /// # Errors
    /// A name that no point has, or a place that two supports would move.
    pub fn with_support_motions(mut self, groups: &[&[&str]]) -> Result<Self, StructureError> {
        let mut supports: Vec<Vec<usize>> = Vec::with_capacity(groups.len());
        for at in groups {
            let coordinates = self.coordinates("support motion", at)?;
            if let Some(&twice) = coordinates.iter().find(|&&c| supports.iter().any(|s| s.contains(&c))) {
                let names = self.points.iter().filter(|point| point.coordinate == twice);
                return Err(StructureError::MovedTwice { names: names.map(|p| p.name.clone()).collect() });
            }
            supports.push(coordinates);
        }
        self.supports = supports;
        Ok(self)
    }

    /// Names of all points: those of the beam, `left` and `right`; or the masses and `ground`.
    pub fn point_names(&self) -> impl Iterator<Item = &str> {
        self.points.iter().map(|point| point.name.as_str())
    }

    /// Eigenfrequencies [Hz] of the supported structure, support motion held at zero; rigid-body modes are
    /// 0.0.
    ///
    /// # Errors
    /// Nothing is free, or the modes do not converge.
    pub fn eigenfrequencies_hz(&self) -> Result<Vec<f64>, StructureError> {
        Ok(self.supported_modes()?.frequencies_hz())
    }

    /// Displacement [m] of a point under a uniform acceleration (gravity), the support at rest.
    ///
    /// `K y = a M 1`, from all modes of the unreduced structure.
    ///
    /// * `acceleration`: a [m/s^2], along the positive displacement.
    ///
    /// # Errors
    /// An unknown point, or a rigid-body mode that the load drives.
    pub fn static_deflection(&self, point: &str, acceleration: f64) -> Result<f64, StructureError> {
        let coordinate = self.coordinate("static deflection", point)?;
        let free = self.free_coordinates();
        let modes = self.supported_modes()?;
        let weight = self.uniform_load();
        let load: Vec<f64> = free.iter().map(|&index| acceleration * weight[index]).collect();
        let answer = modes.static_answer(&load)?;
        Ok(free.iter().position(|&index| index == coordinate).map_or(0.0, |row| answer[row]))
    }

    /// All modes of the supported structure, rows over [`Structure::free_coordinates`].
    pub(crate) fn supported_modes(&self) -> Result<Modes, StructureError> {
        match self.free_coordinates() {
            free if free.is_empty() => Err(StructureError::NothingFree),
            free => Modes::over(&self.assembly, &free),
        }
    }

    /// Coordinates that are neither held nor prescribed, ascending.
    pub(crate) fn free_coordinates(&self) -> Vec<usize> {
        (0..self.held.len()).filter(|index| !self.held[*index] && !self.is_prescribed(*index)).collect()
    }

    /// Coordinates that ends or the ground hold, ascending.
    pub(crate) fn held_coordinates(&self) -> Vec<usize> {
        (0..self.held.len()).filter(|index| self.held[*index]).collect()
    }

    /// Free and prescribed coordinates, ascending: the component whose support is let go.
    pub(crate) fn released_coordinates(&self) -> Vec<usize> {
        (0..self.held.len()).filter(|index| !self.held[*index] || self.is_prescribed(*index)).collect()
    }

    /// Coordinates that follow a support.
    pub(crate) fn prescribed(&self) -> Vec<usize> {
        self.supports.concat()
    }

    fn is_prescribed(&self, coordinate: usize) -> bool {
        self.supports.iter().any(|support| support.contains(&coordinate))
    }

    /// All places, from left to right.
    pub(crate) fn places(&self) -> &[Place] {
        &self.places
    }

    /// The named points.
    pub(crate) fn points(&self) -> &[NamedCoordinate] {
        &self.points
    }

    /// Distinct coordinates of the named points, in the order given.
    pub(crate) fn coordinates(&self, what: &str, names: &[&str]) -> Result<Vec<usize>, StructureError> {
        let mut coordinates = Vec::with_capacity(names.len());
        for name in names {
            let coordinate = self.coordinate(what, name)?;
            if !coordinates.contains(&coordinate) {
                coordinates.push(coordinate);
            }
        }
        Ok(coordinates)
    }

    fn coordinate(&self, what: &str, name: &str) -> Result<usize, StructureError> {
        let known = self.points.iter().find(|point| point.name == name);
        known.map(|point| point.coordinate).ok_or_else(|| StructureError::UnknownPoint {
            what: what.into(),
            name: name.into(),
            known: self.point_names().map(String::from).collect(),
        })
    }

    /// `M 1`: force on every coordinate per unit uniform acceleration [kg], held neighbours included.
    pub(crate) fn uniform_load(&self) -> Vec<f64> {
        times(&self.assembly.mass, &self.assembly.translation)
    }

    /// Static answer of all coordinates to a unit motion of each support, a column each: `[Gamma_s; 1]`, and
    /// 0 where held or where another support moves.
    ///
    /// `Gamma_s = -K_ff^-1 K_fs`. It is found as a trial shape, plus the static answer to the strains that
    /// this leaves. Trial shapes are the support's own displacement and an equal share of the uniform
    /// translation of everything free. Of a single support that is the translation itself, so that a
    /// structure without other supports has `Gamma` exactly 1. All of them sum to the translation, also where
    /// `K_ff` is singular: the rigid-body part, which statics leaves open there, is that of the supports'
    /// mean.
    pub(crate) fn support_shapes(&self, modes: &Modes) -> Mat<f64> {
        let (count, free) = (self.supports.len(), self.free_coordinates());
        let mut shapes = Mat::zeros(self.held.len(), count);
        for (support, own) in self.supports.iter().enumerate() {
            for &index in own {
                shapes[(index, support)] = self.assembly.translation[index];
            }
            for &index in &free {
                shapes[(index, support)] = self.assembly.translation[index] / count as f64;
            }
        }
        if count > 0 {
            let correction = modes.relief_of_strains(self.assembly.stiffness.of(shapes.as_ref()).as_ref());
            for (row, &index) in free.iter().enumerate() {
                for support in 0..count {
                    shapes[(index, support)] += correction[(row, support)];
                }
            }
        }
        shapes
    }
}
