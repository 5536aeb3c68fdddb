//! Which part of a structure of matrices asks for rows, nodes or labels.

use std::fmt;

/// What asks for rows, nodes or labels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MatrixPart {
    /// A named point.
    Point(String),
    /// A support.
    Support(String),
    /// A set of fixed rows, from 0.
    Fixed(usize),
    /// A component, from 0, with its name.
    Component(usize, String),
    /// The lines of the mesh.
    Lines,
}

impl fmt::Display for MatrixPart {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(name) => write!(formatter, "point \"{name}\""),
            Self::Support(name) => write!(formatter, "support \"{name}\""),
            Self::Fixed(number) => write!(formatter, "entry {} of the fixed rows", number + 1),
            Self::Component(_, name) => write!(formatter, "component \"{name}\""),
            Self::Lines => formatter.write_str("a line of the mesh"),
        }
    }
}
