//! What the rows of matrices stand for.

use std::fmt;

/// Which way a row moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// Displacement along axis 0, 1 or 2.
    Translation(u8),
    /// Rotation about axis 0, 1 or 2.
    Rotation(u8),
    /// Anything else, by the number that the program gives it.
    Other(i64),
}

impl Direction {
    /// The direction of a number as finite element programs count: 1 to 3 displacements, 4 to 6 rotations.
    #[must_use]
    pub fn numbered(number: i64) -> Self {
        match number {
            1..=3 => Self::Translation((number - 1) as u8),
            4..=6 => Self::Rotation((number - 4) as u8),
            other => Self::Other(other),
        }
    }

    /// `x`, `y`, `z`, `rx`, `ry`, `rz` or a number.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_lowercase();
        let axes = ["x", "y", "z", "rx", "ry", "rz"];
        let number = axes.iter().position(|axis| *axis == name).map(|place| place as i64 + 1);
        number.or_else(|| name.parse().ok()).map(Self::numbered)
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Translation(axis) => formatter.write_str(["x", "y", "z"][usize::from(*axis)]),
            Self::Rotation(axis) => formatter.write_str(["rx", "ry", "rz"][usize::from(*axis)]),
            Self::Other(number) => write!(formatter, "{number}"),
        }
    }
}

/// What kind of coordinate a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RowKind {
    /// The motion of a node.
    Physical,
    /// The amplitude of a mode of a reduced component.
    Modal,
}

/// What a row stands for.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct RowLabel {
    /// Number of the node, or of the scalar point of a mode.
    pub node: i64,
    /// Which way it moves; 0 of a modal row.
    pub direction: Direction,
    /// What kind of coordinate it is.
    pub kind: RowKind,
    /// Name given to it; empty if none.
    pub name: String,
}

impl RowLabel {
    /// A node moving in a direction.
    #[must_use]
    pub fn physical(node: i64, direction: Direction) -> Self {
        Self { node, direction, kind: RowKind::Physical, name: String::new() }
    }

    /// The amplitude of a mode.
    #[must_use]
    pub fn modal(point: i64) -> Self {
        Self { node: point, direction: Direction::Other(0), kind: RowKind::Modal, name: String::new() }
    }
}

impl fmt::Display for RowLabel {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.name.as_str(), self.kind) {
            ("", RowKind::Physical) => write!(formatter, "node {} {}", self.node, self.direction),
            ("", RowKind::Modal) => write!(formatter, "mode {}", self.node),
            (name, _) => formatter.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_names_and_numbers() {
        for number in -1..9 {
            let direction = Direction::numbered(number);
            assert_eq!(Direction::named(&direction.to_string()), Some(direction));
        }
        assert_eq!(Direction::named(" RY "), Some(Direction::Rotation(1)));
        assert_eq!(Direction::named("up"), None);
        assert_eq!(RowLabel::physical(7, Direction::Translation(2)).to_string(), "node 7 z");
    }
}
