//! Beams and lumped masses as matrices, for other programs and to hold the two ways against one another.

use std::collections::BTreeMap;

use faer::Mat;

use crate::{
    Direction, Entry, RowLabel, Structure, SymmetricMatrix,
    structure::{Kind, NamedCoordinate},
};

/// A structure in matrices, its supports not yet held.
#[derive(Debug, Clone)]
pub struct ExportedMatrices {
    /// `K`, rows of held coordinates included.
    pub stiffness: SymmetricMatrix,
    /// `M`.
    pub mass: SymmetricMatrix,
    /// `C` of the discrete dampers, if there are any.
    pub damping: Option<SymmetricMatrix>,
    /// What the rows are: nodes from 1; of beams displacement `y` and rotation `rz`, of masses `x`.
    pub labels: Vec<RowLabel>,
    /// Where the nodes are [m].
    pub nodes: BTreeMap<i64, [f64; 3]>,
    /// Nodes that are joined by a line.
    pub lines: Vec<[i64; 2]>,
    /// Rows that ends and the ground hold, from 0.
    pub held: Vec<usize>,
    /// Rows of the named points.
    pub points: Vec<(String, usize)>,
}

impl Structure {
    /// The structure in matrices.
    #[must_use]
    pub fn exported(&self) -> ExportedMatrices {
        let size = self.assembly.translation.len();
        let all: Vec<usize> = (0..size).collect();
        let squared = |strains: Mat<f64>| symmetric(&(strains.transpose() * &strains));
        let damping = squared(self.assembly.damping.columns(&all));
        let label = |coordinate: usize| match self.kind {
            Kind::Beam if coordinate.is_multiple_of(2) => (coordinate / 2, Direction::Translation(1)),
            Kind::Beam => (coordinate / 2, Direction::Rotation(2)),
            Kind::Lumped => (coordinate, Direction::Translation(0)),
        };
        let labels = all.iter().map(|&coordinate| {
            let (node, direction) = label(coordinate);
            let name = self.points().iter().find(|point| point.coordinate == coordinate);
            RowLabel {
                name: name.map_or_else(String::new, |point| point.name.clone()),
                ..RowLabel::physical(node as i64 + 1, direction)
            }
        });
        let node = |coordinate: usize| label(coordinate).0 as i64 + 1;
        let nodes: BTreeMap<i64, [f64; 3]> =
            self.places().iter().map(|place| (node(place.coordinate), [place.at, 0.0, 0.0])).collect();
        let joined = if self.kind == Kind::Beam { self.places() } else { &[] };
        let lines = joined.windows(2).map(|pair| [node(pair[0].coordinate), node(pair[1].coordinate)]);
        let point = |point: &NamedCoordinate| (point.name.clone(), point.coordinate);
        ExportedMatrices {
            stiffness: squared(self.assembly.stiffness.columns(&all)),
            mass: symmetric(&self.assembly.mass),
            damping: (damping.stored() > 0).then_some(damping),
            labels: labels.collect(),
            lines: lines.collect(),
            nodes,
            held: self.held_coordinates(),
            points: self.points().iter().map(point).collect(),
        }
    }
}

fn symmetric(matrix: &Mat<f64>) -> SymmetricMatrix {
    let mut entries = Vec::new();
    for column in 0..matrix.ncols() {
        for row in column..matrix.nrows() {
            let value = matrix[(row, column)];
            entries.push(Entry { row: row as u32, column: column as u32, value });
        }
    }
    SymmetricMatrix::from_entries(matrix.nrows(), &entries)
}
