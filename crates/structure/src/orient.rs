//! Signs of mode shapes.

use faer::Mat;

/// A mode that moves less than this part of its largest displacement at a point is at rest there.
const AT_REST: f64 = 1e-6;

/// Turns each mode so that it is positive at the first of `preferred` where it moves, else where it moves
/// most.
///
/// * `shapes`: one column a mode, rows over all coordinates.
/// * `translation`: 1 for transverse displacements, 0 for rotations.
pub(crate) fn orient(mut shapes: Mat<f64>, preferred: &[usize], translation: &[f64]) -> Mat<f64> {
    for shape in shapes.col_iter_mut() {
        let across = |row: usize| (shape[row] * translation[row]).abs();
        let largest = (0..shape.nrows()).map(across).fold(0.0, f64::max);
        let moves = |row: &usize| across(*row) > AT_REST * largest;
        // Entries that are equal but for rounding must not decide by it, so the first large one counts.
        let most = (0..shape.nrows()).find(|row| across(*row) >= 0.999 * largest && largest > 0.0);
        let turning = (0..shape.nrows()).find(|row| shape[*row] != 0.0);
        let reference = preferred.iter().copied().find(moves).or(most).or(turning);
        if reference.is_some_and(|row| shape[row] < 0.0) {
            shape.iter_mut().for_each(|entry| *entry = -*entry);
        }
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_positive_at_the_first_preferred_coordinate_that_moves() {
        let shapes = Mat::from_fn(3, 2, |i, j| [[1.0, 0.0], [-2.0, -1.0], [-3.0, 2.0]][i][j]);
        let turned = orient(shapes, &[0, 1], &[1.0; 3]);
        assert_eq!((turned[(0, 0)], turned[(1, 0)]), (1.0, -2.0));
        assert_eq!((turned[(0, 1)], turned[(1, 1)], turned[(2, 1)]), (0.0, 1.0, -2.0));
    }

    #[test]
    fn without_preference_the_largest_displacement_is_positive() {
        let shapes = Mat::from_fn(3, 1, |i, _| [9.0, -2.0, 1.0][i]);
        assert_eq!(orient(shapes, &[], &[0.0, 1.0, 1.0])[(1, 0)], 2.0);
    }
}
