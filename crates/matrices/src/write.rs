//! The files of the bundle.

use std::io::{self, Write};

use hammerbeam_structure::{RowKind, RowLabel, SymmetricMatrix};

use crate::read::Nodes;

/// Writes the lower triangle in Matrix Market format, each value with the digits that give it back.
///
/// # Errors
/// What the machine says.
pub fn write_matrix_market(matrix: &SymmetricMatrix, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "%%MatrixMarket matrix coordinate real symmetric")?;
    writeln!(out, "{} {} {}", matrix.size(), matrix.size(), matrix.stored())?;
    for (row, column, value) in matrix.entries() {
        writeln!(out, "{} {} {value:e}", row + 1, column + 1)?;
    }
    Ok(())
}

/// Writes `dofs.csv`.
///
/// # Errors
/// What the machine says.
pub fn write_dofs(labels: &[RowLabel], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "row,node,direction,kind,name")?;
    for (row, label) in labels.iter().enumerate() {
        let kind = match label.kind {
            RowKind::Physical => "physical",
            RowKind::Modal => "modal",
        };
        writeln!(out, "{},{},{},{kind},{}", row + 1, label.node, label.direction, label.name)?;
    }
    Ok(())
}

/// Writes `nodes.csv`.
///
/// # Errors
/// What the machine says.
pub fn write_nodes(nodes: &Nodes, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "node,x,y,z")?;
    for (node, [x, y, z]) in nodes {
        writeln!(out, "{node},{x},{y},{z}")?;
    }
    Ok(())
}

/// Writes `lines.csv`.
///
/// # Errors
/// What the machine says.
pub fn write_lines(lines: &[[i64; 2]], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "node,node")?;
    lines.iter().try_for_each(|[from, to]| writeln!(out, "{from},{to}"))
}
