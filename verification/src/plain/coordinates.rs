//! What the numbers of a state are.

use hammerbeam_study::Model;

/// Coordinates of the equations of motion.
#[derive(Debug, Clone, PartialEq)]
pub enum Coordinates {
    /// Displacements of the masses of these names.
    Masses(Vec<String>),
    /// Amplitudes of the modes of a beam, and the displacement of each named point in them. Eigenfrequencies
    /// and shapes are the library's: what an assembly is worth is tested by closed forms.
    Modes(Vec<(String, Vec<f64>)>),
}

impl Coordinates {
    /// Those of a beam.
    pub(super) fn of_modes(model: &Model) -> Self {
        let points = &model.system.model().points;
        Self::Modes(points.iter().map(|point| (point.name.clone(), point.shape.clone())).collect())
    }

    /// The displacement of a point, as factors of the coordinates.
    pub(super) fn row(&self, name: &str) -> Option<Vec<f64>> {
        match self {
            Self::Masses(names) => {
                let place = place(names, name)?;
                Some((0..names.len()).map(|i| f64::from(u8::from(i == place))).collect())
            }
            Self::Modes(points) => {
                points.iter().find(|(known, _)| known == name).map(|(_, shape)| shape.clone())
            }
        }
    }
}

/// The place of a name among others.
pub(super) fn place(names: &[String], name: &str) -> Option<usize> {
    names.iter().position(|known| known == name)
}
