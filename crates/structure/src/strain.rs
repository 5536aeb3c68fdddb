//! Stiffness and damping as sums of squares.
//!
//! Every spring and every bending form of an element stores `1/2 s^2` in one scaled strain
//! `s = sum_i a_i x_i` [J^1/2], so `K = G^T G` with the strains as the rows of `G`. Keeping `G` instead
//! of `K` halves the digits lost to the spread of the eigenvalues: eigenfrequencies are singular
//! values of `G`, and a rigid-body motion is one without strain. Dampers are treated alike (`C = D^T D`).

use faer::{Mat, MatRef};

/// Strains over the coordinates of a structure: the rows of `G` or `D`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Strains {
    rows: Vec<Vec<(usize, f64)>>,
}

impl Strains {
    /// Adds the strain `sum_i a_i x_i`, given as pairs of coordinate and coefficient.
    pub fn push(&mut self, row: impl Into<Vec<(usize, f64)>>) {
        self.rows.push(row.into());
    }

    /// Adds a spring (or damper) of constant `constant >= 0` between two coordinates, or to the ground.
    pub fn connect(&mut self, constant: f64, from: usize, to: Option<usize>) {
        let root = constant.sqrt();
        if root > 0.0 {
            let row = [Some((from, root)), to.map(|index| (index, -root))];
            self.push(row.into_iter().flatten().collect::<Vec<_>>());
        }
    }

    /// Columns of `G` that belong to the given coordinates.
    pub fn columns(&self, coordinates: &[usize]) -> Mat<f64> {
        let last =
            self.rows.iter().flatten().map(|&(index, _)| index).chain(coordinates.iter().copied()).max();
        let mut place = vec![None; last.map_or(0, |last| last + 1)];
        for (column, &index) in coordinates.iter().enumerate() {
            place[index] = Some(column);
        }
        let mut matrix = Mat::zeros(self.rows.len(), coordinates.len());
        for (row, terms) in self.rows.iter().enumerate() {
            for &(index, coefficient) in terms {
                if let Some(column) = place[index] {
                    matrix[(row, column)] += coefficient;
                }
            }
        }
        matrix
    }

    /// Strains `G X` of the motions in the columns of `X`, over all coordinates.
    pub fn of(&self, motions: MatRef<'_, f64>) -> Mat<f64> {
        Mat::from_fn(self.rows.len(), motions.ncols(), |row, column| {
            self.rows[row].iter().map(|&(index, coefficient)| coefficient * motions[(index, column)]).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spring_between_two_coordinates_has_no_strain_when_both_move_alike() {
        let mut strains = Strains::default();
        strains.connect(9.0, 0, Some(2));
        let together = Mat::from_fn(3, 1, |_, _| 0.7);
        assert_eq!(strains.of(together.as_ref())[(0, 0)], 0.0);
        assert_eq!(strains.columns(&[2, 1])[(0, 0)], -3.0);
    }

    #[test]
    fn spring_of_no_stiffness_adds_no_strain() {
        let mut strains = Strains::default();
        strains.connect(0.0, 0, None);
        assert_eq!(strains.columns(&[0]).nrows(), 0);
    }
}
