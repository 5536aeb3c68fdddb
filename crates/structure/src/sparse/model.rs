//! What is said of a structure that is given as matrices.

use std::collections::BTreeMap;

use super::{Direction, RowLabel, SymmetricMatrix};

/// Matrices of a structure, or of a component of one.
#[derive(Debug, Clone)]
pub struct MatrixComponent {
    /// Name for messages; empty if the structure has one component.
    pub name: String,
    /// Stiffness [N/m and so on].
    pub stiffness: SymmetricMatrix,
    /// Mass [kg and so on], positive semi-definite, often singular.
    pub mass: SymmetricMatrix,
    /// Viscous damping [N s/m and so on], acting on the absolute motion.
    pub damping: Option<SymmetricMatrix>,
    /// What each row stands for; empty if nothing is known.
    pub labels: Vec<RowLabel>,
    /// Relative error of the entries of the stiffness: `1.1e-16`, or what a text rounds them to.
    pub precision: f64,
}

/// Along what a node is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Along {
    /// One of its rows.
    Row(Direction),
    /// A direction in space; made of length 1.
    Vector([f64; 3]),
}

/// What is looked at.
#[derive(Debug, Clone, PartialEq)]
pub enum PointPlace {
    /// A row of a component, from 0.
    Row {
        /// Component.
        component: usize,
        /// Row.
        row: usize,
    },
    /// The row with a name.
    Name(String),
    /// A node in a direction.
    Node {
        /// Number of the node.
        node: i64,
        /// Which way.
        along: Along,
    },
}

/// A named point.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixPoint {
    /// Name.
    pub name: String,
    /// What it is.
    pub place: PointPlace,
}

/// Rows by their nodes, or one by one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RowSet {
    /// Rows of the first component, from 0.
    pub rows: Vec<usize>,
    /// Nodes.
    pub nodes: Vec<i64>,
    /// Directions of the nodes that are meant; all if empty.
    pub directions: Vec<Direction>,
}

/// What a support takes along when it moves.
#[derive(Debug, Clone, PartialEq)]
pub enum SupportRows {
    /// These rows move as a rigid body without turning; what they do not follow is held.
    Of(RowSet),
    /// Everything that holds the structure, also what was left out of the matrices: the structure follows as
    /// a rigid body.
    Base,
}

/// A support, at rest unless the excitation moves it.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixSupport {
    /// Name.
    pub name: String,
    /// What it holds and takes along.
    pub rows: SupportRows,
    /// Direction of its motion in space; made of length 1.
    pub along: [f64; 3],
}

/// A structure given as matrices.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// Components, joined where their rows stand for the same node and direction.
    pub components: Vec<MatrixComponent>,
    /// Places of nodes [m], as far as they are known.
    pub nodes: BTreeMap<i64, [f64; 3]>,
    /// Pairs of nodes that lines join, for drawing.
    pub lines: Vec<[i64; 2]>,
    /// Named points.
    pub points: Vec<MatrixPoint>,
    /// Supports.
    pub supports: Vec<MatrixSupport>,
    /// Rows that are held.
    pub fixed: Vec<RowSet>,
    /// Direction of a uniform acceleration, such as gravity.
    pub acceleration: Option<[f64; 3]>,
    /// Memory that matrices, their factors and the search for modes may take [bytes].
    pub memory_limit_bytes: u64,
}

/// What was found on assembling and solving.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MatrixReport {
    /// Rows of all components.
    pub rows: usize,
    /// Rows that components share.
    pub joined: usize,
    /// Rows without any entry, left out.
    pub empty_rows: usize,
    /// Rows of Lagrange multipliers, eliminated with one coordinate each.
    pub lagrange_rows: usize,
    /// Rows held, supports that do not move included.
    pub fixed_rows: usize,
    /// Rows of nodes without a place that do not move when the structure is displaced without turning:
    /// internal freedoms of elements.
    pub internal_rows: usize,
    /// Rows of nodes without a place that move then.
    pub unplaced_rows: usize,
    /// Largest strain energy of a translation of rows along x, y and z over the sum of its parts' magnitudes:
    /// rounding, where nothing holds the matrices. `None` where nothing is known of the rows.
    pub translation_strain: Option<f64>,
    /// Coordinates that are left.
    pub coordinates: usize,
    /// Coordinates without mass of their own.
    pub massless: usize,
    /// Parts that no stiffness joins.
    pub parts: usize,
    /// Rigid-body modes of the supported structure.
    pub rigid_modes: usize,
    /// Largest of their `|K phi| / (|K| |phi|)`, with the largest entries for norms.
    pub rigid_residual: f64,
    /// Mass [kg] that each direction in space moves, where rows are labelled and matrices that nothing holds
    /// let them move without strain.
    pub mass: Option<[f64; 3]>,
    /// Centre of gravity [m], where nodes are known.
    pub centre: Option<[f64; 3]>,
    /// Smallest box [m] that holds all nodes, where they are known.
    pub extent: Option<[f64; 3]>,
}
