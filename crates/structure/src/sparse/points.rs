//! Points of a structure given as matrices: weighted sums of its rows.

use super::{Along, Direction, MatrixPart, MatrixPoint, PointPlace, assemble::unit, joined::Joined};
use crate::StructureError;

/// Rows that a message counts up.
const NAMED: usize = 8;

impl MatrixPoint {
    /// The joined rows and their weights.
    ///
    /// # Errors
    /// A row, name, node or direction that is not there, or that several rows have.
    pub(super) fn weights(&self, joined: &Joined) -> Result<Vec<(usize, f64)>, StructureError> {
        let part = MatrixPart::Point(self.name.clone());
        match &self.place {
            PointPlace::Row { component, row } => {
                let rows = joined.rows.get(*component).map_or(&[][..], Vec::as_slice);
                let found = rows.get(*row).copied();
                let found =
                    found.ok_or(StructureError::NoSuchRow { part, row: row + 1, rows: rows.len() })?;
                Ok(vec![(found, 1.0)])
            }
            PointPlace::Name(name) => {
                let is_it =
                    |label: &&Option<super::RowLabel>| label.as_ref().is_some_and(|l| l.name == *name);
                let rows: Vec<usize> =
                    (0..joined.labels.len()).filter(|&row| is_it(&&joined.labels[row])).collect();
                Ok(vec![(the_only(&part, &format!("the name \"{name}\""), &rows)?, 1.0)])
            }
            PointPlace::Node { node, along } => node_weights(&part, joined, *node, *along),
        }
    }
}

fn node_weights(
    part: &MatrixPart,
    joined: &Joined,
    node: i64,
    along: Along,
) -> Result<Vec<(usize, f64)>, StructureError> {
    let rows = joined.rows_of_node(node);
    if rows.is_empty() {
        if joined.labels.iter().all(Option::is_none) {
            return Err(StructureError::NoLabels { part: Some(part.clone()) });
        }
        return Err(StructureError::NoSuchNodes { part: part.clone(), nodes: vec![node.to_string()] });
    }
    let row_of = |direction: Direction| {
        let rows: Vec<usize> =
            rows.iter().filter(|(_, own)| *own == direction).map(|(row, _)| *row).collect();
        the_only(part, &format!("node {node} {direction}"), &rows)
    };
    match along {
        Along::Row(direction) => Ok(vec![(row_of(direction)?, 1.0)]),
        Along::Vector(vector) => {
            let vector = unit(&vector, &format!("the direction of {part}"))?;
            let parts = (0..3_u8).filter(|axis| vector[usize::from(*axis)] != 0.0);
            parts.map(|axis| Ok((row_of(Direction::Translation(axis))?, vector[usize::from(axis)]))).collect()
        }
    }
}

/// The one row of a label.
fn the_only(part: &MatrixPart, label: &str, rows: &[usize]) -> Result<usize, StructureError> {
    match rows {
        [row] => Ok(*row),
        [] => Err(StructureError::NoSuchLabel { part: part.clone(), label: label.into() }),
        several => Err(StructureError::LabelTwice {
            part: part.clone(),
            label: label.into(),
            rows: several.iter().take(NAMED).map(|row| row + 1).collect(),
        }),
    }
}
