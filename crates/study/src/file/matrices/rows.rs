//! Rows of the page of keys for a structure of matrices.

use hammerbeam_matrices::MatrixFormat;

use crate::document::{Key, KeyRow, Quantity, key::words, quantity};

use super::files::factor;

pub(super) const MEMORY: Key<Quantity> = Key::new(
    "memory_gb",
    quantity::MEMORY_GB,
    "memory that matrices, factors and the search for modes may take",
)
.or(4.0);

fn row(name: &str, allowed: &str, default: &str, meaning: &str) -> KeyRow {
    KeyRow::read_apart(name, allowed, default, meaning)
}

fn matrix_rows() -> Vec<KeyRow> {
    let file = "file, relative to the folder of the study file";
    let found = "none: found out";
    let name = "name of the matrix in a file that holds several";
    let rows = "what rows are: `dofs.csv`, the `.dof` of CalculiX, `.pch` or `.asm` of Nastran with `EXTRN`, \
                the `.inp` of Abaqus";
    vec![
        row("stiffness", file, "required, or `component`", "stiffness matrix"),
        row("mass", file, "required, or `component`", "mass matrix; the same file if it holds both"),
        row("damping", file, "none", "viscous damping, acting on the absolute motion"),
        row("format", &words(MatrixFormat::names().into_iter()), found, "format of the files"),
        row("stiffness_matrix", "text", found, name),
        row("mass_matrix", "text", found, "the same"),
        row("damping_matrix", "text", found, "the same"),
        factor("stiffness_factor", "what brings the numbers to N/m").row(),
        factor("mass_factor", "what brings them to kg").row(),
        factor("damping_factor", "what brings them to N s/m").row(),
        row("dofs", "file", "none", rows),
    ]
}

/// Those of `[structure]`.
pub(in super::super) fn rows() -> Vec<KeyRow> {
    let list = |name, meaning| row(name, "list of tables, below", "none", meaning);
    let lines = "pairs of nodes that lines join, `lines.csv`, for [pictures of the \
                 mesh](../how-to/structures.md#the-mesh-in-pictures); needs `nodes`";
    let mut rows = vec![row("kind", "`\"matrices\"`", "required", "what the structure is")];
    rows.extend(matrix_rows());
    rows.extend([
        row("nodes", "file", "none", "where nodes are: `nodes.csv`, `.inp`, or bulk data"),
        row("lines", "file", "none", lines),
        factor("length_factor", "what brings places of nodes to m").row(),
        row(
            "acceleration_direction",
            "`\"x\"`, `\"-z\"`, ..., or a vector",
            "none",
            "direction of gravity; needed by a load of kind `\"gravity\"`",
        ),
        MEMORY.row(),
        list("component", "several components, instead of the files above"),
        list("point", "named points"),
        list("support", "supports that the excitation may move"),
        list("fixed", "rows that are held"),
    ]);
    rows
}

/// Those of `[[structure.component]]`.
pub(in super::super) fn rows_of_component() -> Vec<KeyRow> {
    let required = |row: KeyRow| match row.name.as_str() {
        "stiffness" | "mass" => KeyRow { default: "required".to_owned(), ..row },
        _ => row,
    };
    let name = row("name", "text", "required", "name, each once");
    [name].into_iter().chain(matrix_rows().into_iter().map(required)).collect()
}

/// Those of `[[structure.point]]`.
pub(in super::super) fn rows_of_point() -> Vec<KeyRow> {
    let directions =
        "`\"x\"`, `\"y\"`, `\"z\"`, `\"rx\"`, `\"ry\"`, `\"rz\"`, a number, or a vector in space";
    vec![
        row("name", "text", "required", "name, each once"),
        row("node", "whole number", "required, or `label`, or `row`", "node, with a `direction`"),
        row("direction", directions, "required with `node`", "direction there"),
        row("label", "text", "none", "the row with that name in `dofs.csv`"),
        row("row", "whole number from 1", "none", "a row of the first component, or of `component`"),
        row("component", "name of a component", "the first", "whose row it is"),
    ]
}

/// Those of `[[structure.support]]`.
pub(in super::super) fn rows_of_support() -> Vec<KeyRow> {
    let everything = "all that holds the structure and is not in the matrices, as a program leaves out the \
                      rows that it holds";
    let moves = "direction in which it moves when the excitation names it";
    let mut rows = vec![
        row("name", "text", "required", "name, each once"),
        row("everything", "`true`, `false`", "`false`", everything),
        row("direction", "`\"x\"`, `\"-z\"`, ..., or a vector", "required", moves),
    ];
    rows.extend(rows_of_fixed());
    rows
}

/// Those of `[[structure.fixed]]`, and what a support holds.
pub(in super::super) fn rows_of_fixed() -> Vec<KeyRow> {
    vec![
        row("nodes", "list of numbers and of runs such as `\"10-20\"`", "none", "nodes that are held"),
        row("directions", "list of directions", "all", "directions in which these nodes are held"),
        row("rows", "list of numbers from 1", "none", "rows that are held"),
    ]
}
