//! What a study says of matrices.

use std::path::PathBuf;

use serde::Serialize;

/// A structure given as matrices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Matrices {
    /// Its components; one without a name where the files stand in `[structure]` itself.
    pub components: Vec<MatrixFiles>,
    /// Where nodes are.
    pub nodes: Option<InputFile>,
    /// Which nodes lines join, for drawing; no part of the identity.
    #[serde(skip)]
    pub lines: Option<Box<InputFile>>,
    /// Factor that brings their places to metres.
    pub length_factor: f64,
    /// Named points.
    pub points: Vec<MatrixPointEntry>,
    /// Supports by name.
    pub supports: Vec<MatrixSupportEntry>,
    /// Rows that are held.
    pub fixed: Vec<RowSetEntry>,
    /// Direction of gravity in space.
    pub acceleration_direction: Option<[f64; 3]>,
    /// Memory for factors [GB]; no part of the identity.
    #[serde(skip)]
    pub memory_gb: f64,
}

/// A file with what it held when the study was read: results belong to that.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputFile {
    /// The file; no part of the identity.
    #[serde(skip)]
    pub path: PathBuf,
    /// Its name as the study has it; no part of the identity.
    #[serde(skip)]
    pub written: String,
    /// Checksum of its bytes and their number.
    pub checksum: String,
}

/// The files of a component.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixFiles {
    /// Name.
    pub name: String,
    /// Format of the matrices; found out if `None`.
    pub format: Option<String>,
    /// Stiffness.
    pub stiffness: MatrixEntry,
    /// Mass.
    pub mass: MatrixEntry,
    /// Damping.
    pub damping: Option<MatrixEntry>,
    /// What rows are.
    pub dofs: Option<InputFile>,
}

/// A matrix of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixEntry {
    /// The file.
    pub file: InputFile,
    /// Name of the matrix in it; found out if `None`.
    pub matrix: Option<String>,
    /// Factor that brings it to SI units.
    pub factor: f64,
}

/// Which way a point looks or a support moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum DirectionEntry {
    /// `x`, `y`, `z`, `rx`, `ry`, `rz` or a number.
    Named(String),
    /// A vector in space.
    Vector([f64; 3]),
}

/// A named point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixPointEntry {
    /// Name.
    pub name: String,
    /// What it is.
    pub place: PointPlaceEntry,
}

/// What a point is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointPlaceEntry {
    /// A node in a direction.
    Node {
        /// Number of the node.
        node: u32,
        /// Direction.
        direction: DirectionEntry,
    },
    /// The row with a name in `dofs.csv`.
    Label(String),
    /// A row, from 1.
    Row {
        /// Number of the component, from 0.
        component: usize,
        /// Row.
        row: u32,
    },
}

/// Rows by nodes or one by one.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
pub struct RowSetEntry {
    /// Nodes, as runs from first to last.
    pub nodes: Vec<[u32; 2]>,
    /// Rows, from 1.
    pub rows: Vec<u32>,
    /// Directions of the nodes; all if empty.
    pub directions: Vec<String>,
}

/// A support.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixSupportEntry {
    /// Name.
    pub name: String,
    /// What it holds; everything that holds the structure if `None`.
    pub rows: Option<RowSetEntry>,
    /// Direction in which it can move.
    pub direction: [f64; 3],
}
