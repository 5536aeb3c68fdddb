//! A place of the structure where a force acts that is not linear.

use crate::{
    Law,
    law::{AcrossHole, RoundHole},
};

/// A local element: a law between two points, or between a point and its surroundings.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalElement {
    /// Name for reports.
    pub name: String,
    /// `phi_e`: relative displacement per modal coordinate, and modal load per unit force, length n.
    pub shape: Vec<f64>,
    /// `s_es`: relative displacement per unit displacement of each support: 0 for a stop on a structure that
    /// follows its one support rigidly and carries the stop; those that are left out are 0.
    pub support_ratios: Vec<f64>,
    /// The force law.
    pub law: Law,
}

impl LocalElement {
    /// The two elements of a round hole, from the displacements of a point in two directions across its axis.
    ///
    /// * `directions`: shape and support ratios of each.
    #[must_use]
    pub fn round_hole(name: &str, directions: [(Vec<f64>, Vec<f64>); 2], hole: RoundHole) -> [Self; 2] {
        let [first, second] = directions;
        let element = |name: String, (shape, support_ratios), law| Self { name, shape, support_ratios, law };
        [
            element(name.to_owned(), first, hole.into()),
            element(format!("{name} (across)"), second, AcrossHole.into()),
        ]
    }
}
