//! The matrices of all components, joined at the rows that they share.

use std::collections::BTreeSet;

use super::{Direction, RowKind, RowLabel, SymmetricMatrix};

/// Matrices over all rows of all components, joined.
#[derive(Debug)]
pub(super) struct Joined {
    pub stiffness: SymmetricMatrix,
    pub mass: SymmetricMatrix,
    pub damping: Option<SymmetricMatrix>,
    /// Of each joined row, where it is known.
    pub labels: Vec<Option<RowLabel>>,
    /// The joined row of each row of each component.
    pub rows: Vec<Vec<usize>>,
    pub precision: f64,
    /// What the rows of nodes without a place do when the structure is displaced.
    pub unplaced: Unplaced,
}

/// Rows that are displacements of nodes without a place.
#[derive(Debug, Default)]
pub(super) struct Unplaced {
    /// Those that stay at rest in a translation.
    pub internal: BTreeSet<usize>,
    /// Number of those that move.
    pub moving: usize,
}

impl Joined {
    /// What a joined row is called in messages.
    pub fn label(&self, row: usize) -> String {
        match &self.labels[row] {
            Some(label) => format!("row {} ({label})", row + 1),
            None => format!("row {}", row + 1),
        }
    }

    /// The rows of a node, with their directions.
    pub fn rows_of_node(&self, node: i64) -> Vec<(usize, Direction)> {
        let of = |(row, label): (usize, &Option<RowLabel>)| {
            let label =
                label.as_ref().filter(|label| label.node == node && label.kind == RowKind::Physical)?;
            Some((row, label.direction))
        };
        self.labels.iter().enumerate().filter_map(of).collect()
    }
}
