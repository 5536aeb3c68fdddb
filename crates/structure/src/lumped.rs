//! Lumped structures: masses with springs and dampers between them and to the ground.

use faer::Mat;

use crate::{
    Structure, StructureError,
    assembly::Assembly,
    error::{not_negative, positive},
    names::check_names,
    strain::Strains,
    structure::{Kind, NamedCoordinate, Place},
};

/// Name of the surroundings in which springs and dampers may end.
pub const GROUND: &str = "ground";

/// A mass with one displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedMass {
    /// Name, unique; not `left`, `right`, `ground`, `space` or `support`.
    pub name: String,
    /// Mass [kg], greater than 0.
    pub mass: f64,
}

/// A spring or damper between two masses, or a mass and the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Connection {
    /// Names of the two masses; either may be `ground`.
    pub between: [String; 2],
    /// Stiffness [N/m] or damping constant [N s/m], 0 or greater.
    pub constant: f64,
}

/// Masses that move along one line, with springs and dampers between them; never reduced.
///
/// `M = diag(m)`, and each spring `k` between `a` and `b` stores `k/2 (y_a - y_b)^2`; several between
/// the same two add up. If support motion is prescribed at `ground`, the ground moves as a whole.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lumped {
    /// The masses, at least one.
    pub masses: Vec<LumpedMass>,
    /// Springs, constants in N/m.
    pub springs: Vec<Connection>,
    /// Dampers, constants in N s/m.
    pub dampers: Vec<Connection>,
}

impl Lumped {
    /// Checks and assembles the system.
    ///
    /// # Errors
    /// No mass, a mass that is not positive, a negative constant, names used twice or reserved or unknown.
    pub fn structure(&self) -> Result<Structure, StructureError> {
        self.check()?;
        let count = self.masses.len();
        let mass = |i: usize, j: usize| if i == j && i < count { self.masses[i].mass } else { 0.0 };
        let assembly = Assembly {
            mass: Mat::from_fn(count + 1, count + 1, mass),
            stiffness: self.strains("spring", &self.springs)?,
            damping: self.strains("damper", &self.dampers)?,
            translation: vec![1.0; count + 1],
        };
        let held = (0..=count).map(|index| index == count).collect();
        let points = self.names().enumerate().map(|(coordinate, name)| NamedCoordinate { name, coordinate });
        let places = (0..count).map(|mass| Place { at: mass as f64, coordinate: mass });
        Ok(Structure::new(Kind::Lumped, assembly, held, points.collect(), places.collect()))
    }

    fn check(&self) -> Result<(), StructureError> {
        if self.masses.is_empty() {
            return Err(StructureError::NoMass);
        }
        check_names("mass", self.masses.iter().map(|mass| mass.name.as_str()))?;
        for mass in &self.masses {
            positive(&format!("mass \"{}\"", mass.name), mass.mass)?;
        }
        Ok(())
    }

    /// Names of the coordinates: the masses, then the ground.
    fn names(&self) -> impl Iterator<Item = String> {
        self.masses.iter().map(|mass| mass.name.clone()).chain([GROUND.to_string()])
    }

    fn strains(&self, what: &str, connections: &[Connection]) -> Result<Strains, StructureError> {
        let mut strains = Strains::default();
        for connection in connections {
            let [from, to] = &connection.between;
            let what = format!("{what} between \"{from}\" and \"{to}\"");
            let constant = not_negative(&what, connection.constant)?;
            if from == to {
                return Err(StructureError::ConnectedToItself { what, name: from.clone() });
            }
            strains.connect(constant, self.coordinate(&what, from)?, Some(self.coordinate(&what, to)?));
        }
        Ok(strains)
    }

    fn coordinate(&self, what: &str, name: &str) -> Result<usize, StructureError> {
        self.names().position(|known| known == name).ok_or_else(|| StructureError::UnknownPoint {
            what: what.into(),
            name: name.into(),
            known: self.names().collect(),
        })
    }
}
