//! A grid of initial states over two coordinates.

use crate::{AttractorError, error::ensure};

/// One of the two coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What one unit of the coordinate adds to the state, length 2n.
    pub direction: Vec<f64>,
    /// Low end.
    pub low: f64,
    /// High end.
    pub high: f64,
    /// Number of cells.
    pub count: usize,
}

impl Axis {
    /// The coordinate in the middle of a cell.
    #[must_use]
    pub fn place(&self, cell: usize) -> f64 {
        self.low + (self.high - self.low) * (cell as f64 + 0.5) / self.count as f64
    }
}

/// The grid of initial states, at phase 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// State to which the coordinates are added, length 2n.
    pub base: Vec<f64>,
    /// The coordinate that runs faster from cell to cell,
    pub x: Axis,
    /// and the other one.
    pub y: Axis,
}

impl Grid {
    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.x.count * self.y.count
    }

    /// Coordinates in the middle of a cell.
    #[must_use]
    pub fn place(&self, cell: usize) -> [f64; 2] {
        [self.x.place(cell % self.x.count), self.y.place(cell / self.x.count)]
    }

    /// Initial state of a cell.
    #[must_use]
    pub fn state(&self, cell: usize) -> Vec<f64> {
        let [x, y] = self.place(cell);
        let directions = self.x.direction.iter().zip(&self.y.direction);
        self.base
            .iter()
            .zip(directions)
            .map(|(base, (along_x, along_y))| base + x * along_x + y * along_y)
            .collect()
    }

    pub(crate) fn check(&self, dimension: usize) -> Result<(), AttractorError> {
        for part in [&self.base, &self.x.direction, &self.y.direction] {
            if part.len() != dimension {
                return Err(AttractorError::StateLength { found: part.len(), expected: dimension });
            }
        }
        for axis in [&self.x, &self.y] {
            let fits = (1..=100_000).contains(&axis.count);
            ensure("the number of cells along a coordinate", axis.count as f64, "1 to 100000", fits)?;
            ensure("the low end of a coordinate", axis.low, "finite", axis.low.is_finite())?;
            let above = axis.high.is_finite() && axis.high > axis.low;
            ensure("the high end of a coordinate", axis.high, "finite and above the low end", above)?;
        }
        Ok(())
    }
}
