//! How the rows move when the structure is displaced without turning: for its mass, gravity, and a base that
//! takes everything along.
//!
//! A row with the label of a node and an axis moves along this axis. Programs also label rows that are no
//! displacements of nodes, such as the amplitudes of incompatible modes within an element; the nodes of these
//! stand on no list of nodes. Neither do nodes that a program makes itself, as at the faces of an expanded
//! shell, and these do move. So, where some labelled nodes have a place and others have none, both
//! translations `t` are tried, those without a place at rest or along: a translation does not strain the
//! structure but where the ground holds it, so that the one with less strain energy `t^T K t` is meant.
//!
//! Where nothing holds the matrices it has none at all: then the rounding of the entries bounds
//! `t^T K t / sum_ij |K_ij t_i t_j|`.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    Direction, Matrices, RowKind, RowLabel,
    joined::{Joined, Unplaced},
    vectors::dot,
};
use crate::StructureError;

/// Rigid motions of a body in space.
pub(super) const RIGID_MOTIONS: usize = 6;
/// A translation strains what nothing holds if its strain energy is larger than this part of the sum of its
/// magnitudes, and than so many times the precision of the entries.
const STRAINED: (f64, f64) = (1e-9, 10.0);

impl Joined {
    /// The displacements of all rows in a translation along a direction.
    ///
    /// # Errors
    /// Nothing is known of the rows.
    pub fn translation(&self, along: [f64; 3]) -> Result<Vec<f64>, StructureError> {
        if self.labels.iter().all(Option::is_none) {
            return Err(StructureError::NoLabels { part: None });
        }
        Ok(self.displaced(along, &self.unplaced.internal))
    }

    /// What rows of nodes without a place do in a translation.
    pub fn unplaced(&self, nodes: &BTreeMap<i64, [f64; 3]>) -> Unplaced {
        let of_node = |row: &usize| axis(&self.labels[*row]).map(|(node, _)| nodes.contains_key(&node));
        let rows = || 0..self.labels.len();
        let unplaced: BTreeSet<usize> = rows().filter(|row| of_node(row) == Some(false)).collect();
        if nodes.is_empty() || !rows().any(|row| of_node(&row) == Some(true)) {
            return Unplaced::default();
        }
        let none = BTreeSet::new();
        let energy = |at_rest: &BTreeSet<usize>| {
            AXES.iter().map(|along| self.strain(&self.displaced(*along, at_rest)).0).sum::<f64>()
        };
        let moves = unplaced.is_empty()
            || energy(&none) <= energy(&unplaced)
            || AXES.iter().all(|along| !self.is_strain(self.strain(&self.displaced(*along, &none))));
        match moves {
            true => Unplaced { moving: unplaced.len(), internal: none },
            false => Unplaced { moving: 0, internal: unplaced },
        }
    }

    /// Largest strain energy of the translations along the axes over the sum of its magnitudes.
    pub fn translation_strain(&self) -> f64 {
        let strain = |along: &[f64; 3]| {
            let (energy, magnitude) = self.strain(&self.displaced(*along, &self.unplaced.internal));
            if magnitude > 0.0 { energy.abs() / magnitude } else { 0.0 }
        };
        AXES.iter().map(strain).fold(0.0, f64::max)
    }

    /// Whether a translation strains the matrices, be it against what holds them.
    pub fn is_strained(&self) -> bool {
        self.is_strain((self.translation_strain(), 1.0))
    }

    fn is_strain(&self, (energy, magnitude): (f64, f64)) -> bool {
        energy.abs() > STRAINED.0.max(STRAINED.1 * self.precision) * magnitude
    }

    /// `t^T K t` and `sum_ij |K_ij t_i t_j|`.
    fn strain(&self, motion: &[f64]) -> (f64, f64) {
        (dot(motion, &self.stiffness.times(motion)), self.stiffness.absolute_form(motion))
    }

    fn displaced(&self, along: [f64; 3], at_rest: &BTreeSet<usize>) -> Vec<f64> {
        let displacement = |(row, label): (usize, &Option<RowLabel>)| match axis(label) {
            Some((_, axis)) if !at_rest.contains(&row) => along[axis],
            _ => 0.0,
        };
        self.labels.iter().enumerate().map(displacement).collect()
    }
}

/// Refuses a translation of rows that strains matrices that nothing holds.
///
/// # Errors
/// [`StructureError::TranslationStrains`], and as [`Matrices::survey`].
pub(super) fn ensure_translation(matrices: &Matrices, joined: &Joined) -> Result<(), StructureError> {
    if !joined.is_strained() {
        return Ok(());
    }
    // What the study holds may be all that does.
    let free = Matrices {
        fixed: Vec::new(),
        supports: Vec::new(),
        points: Vec::new(),
        acceleration: None,
        ..matrices.clone()
    };
    // Freed, they may be no structure at all, as with a mechanism that the study holds: then the ground is
    // not shown to be all that strains.
    match free.survey(RIGID_MOTIONS + 1) {
        Ok(survey) if survey.report.is_free() => {
            Err(StructureError::TranslationStrains { strain: joined.translation_strain() })
        }
        _ => Ok(()),
    }
}

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The node and axis of a row that is a displacement.
fn axis(label: &Option<RowLabel>) -> Option<(i64, usize)> {
    match label {
        Some(RowLabel { node, direction: Direction::Translation(axis), kind: RowKind::Physical, .. }) => {
            Some((*node, usize::from(*axis)))
        }
        _ => None,
    }
}
