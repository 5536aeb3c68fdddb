//! The matrices of all components, joined at the rows that they share.

use std::collections::{BTreeMap, BTreeSet};

use super::{Direction, MatrixComponent, MatrixPart, RowKind, RowLabel, SymmetricMatrix};
use crate::StructureError;

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

/// Rows of all components, those of common nodes and directions once.
pub(super) struct SharedRows {
    /// Of each joined row, where it is known.
    pub labels: Vec<Option<RowLabel>>,
    /// The joined row of each row of each component.
    pub rows: Vec<Vec<usize>>,
}

impl SharedRows {
    /// Finds what components share.
    ///
    /// # Errors
    /// A shared label that stands for two rows of one component: it is not known which one is meant.
    pub fn of(components: &[MatrixComponent]) -> Result<Self, StructureError> {
        let common = common_rows(components);
        for ([component, first], [other, second]) in
            common.values().flat_map(|rows| rows.windows(2)).map(|pair| (pair[0], pair[1]))
        {
            if component == other {
                let MatrixComponent { name, labels, .. } = &components[component];
                let part = MatrixPart::Component(component, name.clone());
                let RowLabel { node, direction, .. } = labels[first];
                let (label, rows) = (format!("node {node} {direction}"), vec![first + 1, second + 1]);
                return Err(StructureError::JoinedTwice { part, label, rows });
            }
        }
        let mut shared = Self { labels: Vec::new(), rows: Vec::new() };
        for (number, component) in components.iter().enumerate() {
            let mut places = Vec::with_capacity(component.stiffness.size());
            for row in 0..component.stiffness.size() {
                let label = component.labels.get(row);
                let first = label.and_then(key).and_then(|key| common.get(&key)).map(|rows| rows[0]);
                let place = match first {
                    Some([other, row]) if other != number => shared.rows[other][row],
                    _ => {
                        shared.labels.push(label.cloned());
                        shared.labels.len() - 1
                    }
                };
                places.push(place);
            }
            shared.rows.push(places);
        }
        Ok(shared)
    }
}

/// Component and row of all rows that stand for a node and direction which several components have.
fn common_rows(components: &[MatrixComponent]) -> BTreeMap<(i64, Direction), Vec<[usize; 2]>> {
    let mut rows: BTreeMap<(i64, Direction), Vec<[usize; 2]>> = BTreeMap::new();
    for (number, component) in components.iter().enumerate().filter(|_| components.len() > 1) {
        for (row, label) in component.labels.iter().enumerate() {
            if let Some(key) = key(label) {
                rows.entry(key).or_default().push([number, row]);
            }
        }
    }
    rows.retain(|_, rows| rows.iter().any(|[component, _]| *component != rows[0][0]));
    rows
}

/// By what rows of components are joined.
fn key(label: &RowLabel) -> Option<(i64, Direction)> {
    (label.kind == RowKind::Physical).then_some((label.node, label.direction))
}
