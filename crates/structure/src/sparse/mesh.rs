//! How the nodes of a mesh move with the modes: for drawing it.
//!
//! The displacement of a node is `sum_i phi_i q_i + sum_s s_s u_s` in each direction of space, as that of a
//! point. A direction without a row is held: it stands still, or follows a base that takes along everything
//! that holds the structure.

use std::collections::BTreeMap;

use faer::Mat;

use super::{Direction, Matrices, MatrixPart, RowKind, SupportRows, assemble::unit, prepared::Prepared};
use crate::StructureError;

/// A node of a mesh that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshNode {
    /// Its number.
    pub number: i64,
    /// Where it is [m].
    pub place: [f64; 3],
    /// Displacement along x, y and z in each mode [kg^-1/2], each of length n.
    pub shape: [Vec<f64>; 3],
    /// The same per unit displacement of each support that moves.
    pub support_ratios: [Vec<f64>; 3],
}

/// A mesh that is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshShape {
    /// Its nodes, by rising number.
    pub nodes: Vec<MeshNode>,
    /// Places of two nodes in that list that a line joins.
    pub lines: Vec<[usize; 2]>,
}

impl MeshShape {
    /// The mesh of the lines of a structure, over these modes and motions of supports; `None` without lines.
    ///
    /// # Errors
    /// Nodes of lines whose place is not known.
    pub(super) fn of(
        matrices: &Matrices,
        prepared: &Prepared,
        moving: &[&[&str]],
        (shapes, support_shapes): (&Mat<f64>, &Mat<f64>),
    ) -> Result<Option<Self>, StructureError> {
        if matrices.lines.is_empty() {
            return Ok(None);
        }
        let mut numbers: Vec<i64> = matrices.lines.iter().flatten().copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        let unknown = numbers.iter().filter(|number| !matrices.nodes.contains_key(number));
        let unknown: Vec<String> = unknown.take(8).map(i64::to_string).collect();
        if !unknown.is_empty() {
            return Err(StructureError::NoSuchNodes { part: MatrixPart::Lines, nodes: unknown });
        }
        let rows = rows_of_nodes(prepared);
        let bases = bases(matrices, moving)?;
        let node = |number: &i64| {
            let along = |axis: u8| match rows.get(&(*number, axis)) {
                Some(row) => {
                    let weights = prepared.assembled.map.pulled_back(&[(*row, 1.0)]);
                    (weighted(&weights, shapes), weighted(&weights, support_shapes))
                }
                None => (
                    vec![0.0; shapes.ncols()],
                    bases.iter().map(|base| base.map_or(0.0, |along| along[usize::from(axis)])).collect(),
                ),
            };
            let [x, y, z] = [0, 1, 2].map(along);
            MeshNode {
                number: *number,
                place: matrices.nodes[number],
                shape: [x.0, y.0, z.0],
                support_ratios: [x.1, y.1, z.1],
            }
        };
        let nodes: Vec<MeshNode> = numbers.iter().map(node).collect();
        let place = |number: &i64| numbers.partition_point(|other| other < number);
        let lines = matrices.lines.iter().map(|[from, to]| [place(from), place(to)]).collect();
        Ok(Some(Self { nodes, lines }))
    }
}

/// Direction of each group of supports that takes along everything that holds the structure.
fn bases(matrices: &Matrices, moving: &[&[&str]]) -> Result<Vec<Option<[f64; 3]>>, StructureError> {
    let base = |names: &&[&str]| {
        let mut own = matrices.supports.iter().filter(|support| names.contains(&support.name.as_str()));
        let base = own.find(|support| support.rows == SupportRows::Base);
        base.map(|support| unit(&support.along, "the direction of a support")).transpose()
    };
    moving.iter().map(base).collect()
}

/// The row of each node and axis of space.
fn rows_of_nodes(prepared: &Prepared) -> BTreeMap<(i64, u8), usize> {
    let labels = prepared.assembled.joined.labels.iter().enumerate();
    let row = |(row, label): (usize, &Option<super::RowLabel>)| {
        let label = label.as_ref().filter(|label| label.kind == RowKind::Physical)?;
        match label.direction {
            Direction::Translation(axis) => Some(((label.node, axis), row)),
            _ => None,
        }
    };
    labels.filter_map(row).collect()
}

fn weighted(weights: &[(usize, f64)], columns: &Mat<f64>) -> Vec<f64> {
    columns.col_iter().map(|column| weights.iter().map(|&(row, weight)| weight * column[row]).sum()).collect()
}
