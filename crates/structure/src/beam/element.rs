//! The Euler-Bernoulli element with cubic (Hermite) displacement.
//!
//! Coordinates `x = (w_1, theta_1, w_2, theta_2)` of an element of length `l`; no shear, no rotary
//! inertia of the section. Cubic displacements are exact in statics under loads at the nodes; the
//! relative error of an eigenfrequency of wavenumber `k` is about `(k l)^4 / 1440`.

use faer::Mat;

/// The two bending strains of an element: rows of `G_e` with `K_e = G_e^T G_e`.
///
/// Bending is the sum of a symmetric form of energy `EI/(2l) (theta_2 - theta_1)^2` and an antisymmetric
/// one of `3EI/(2l) (theta_1 + theta_2 - 2 (w_2 - w_1)/l)^2`.
///
/// * `bending_stiffness`: `EI` [N m^2].
/// * `length`: `l` [m].
pub(crate) fn bending_strains(bending_stiffness: f64, length: f64) -> [[f64; 4]; 2] {
    let symmetric = (bending_stiffness / length).sqrt();
    let antisymmetric = (3.0 * bending_stiffness / length).sqrt();
    let slope = 2.0 / length * antisymmetric;
    [[0.0, -symmetric, 0.0, symmetric], [slope, antisymmetric, -slope, antisymmetric]]
}

/// Derivative of the bending strains.
///
/// * `rates`: derivatives of the bending stiffness and of the length.
pub(crate) fn bending_strain_rates(bending_stiffness: f64, length: f64, rates: (f64, f64)) -> [[f64; 4]; 2] {
    let longer = rates.1 / length;
    let rate = 0.5 * (rates.0 / bending_stiffness - longer);
    let [symmetric, antisymmetric] = bending_strains(bending_stiffness, length);
    let [w_1, theta_1, w_2, theta_2] = antisymmetric;
    // The slope (w_2 - w_1)/l has the length once more.
    let slope = rate - longer;
    [symmetric.map(|entry| rate * entry), [slope * w_1, rate * theta_1, slope * w_2, rate * theta_2]]
}

/// Consistent mass matrix of an element.
///
/// * `mass_per_length`: `rho A` [kg/m].
/// * `length`: `l` [m].
pub(crate) fn consistent_mass(mass_per_length: f64, length: f64) -> Mat<f64> {
    let l = length;
    let shape = [
        [156.0, 22.0 * l, 54.0, -13.0 * l],
        [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
        [54.0, 13.0 * l, 156.0, -22.0 * l],
        [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
    ];
    Mat::from_fn(4, 4, |row, column| mass_per_length * l / 420.0 * shape[row][column])
}

/// Derivative of the consistent mass matrix by the length of the element.
pub(crate) fn consistent_mass_rate(mass_per_length: f64, length: f64) -> Mat<f64> {
    let l = length;
    let shape = [
        [156.0, 44.0 * l, 54.0, -26.0 * l],
        [44.0 * l, 12.0 * l * l, 26.0 * l, -9.0 * l * l],
        [54.0, 26.0 * l, 156.0, -44.0 * l],
        [-26.0 * l, -9.0 * l * l, -44.0 * l, 12.0 * l * l],
    ];
    Mat::from_fn(4, 4, |row, column| mass_per_length / 420.0 * shape[row][column])
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn strains_give_the_textbook_stiffness() {
        let (ei, l) = (3.0, 0.5);
        let strains = bending_strains(ei, l);
        let stiffness = |i: usize, j: usize| strains.iter().map(|row| row[i] * row[j]).sum::<f64>();
        let textbook = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ];
        for i in 0..4 {
            for j in 0..4 {
                assert_relative_eq!(stiffness(i, j), ei / l.powi(3) * textbook[i][j], max_relative = 1e-14);
            }
        }
    }

    #[test]
    fn mass_of_a_rigid_translation_and_rotation_is_that_of_a_rod() {
        let (per_length, l) = (2.0, 0.7);
        let mass = consistent_mass(per_length, l);
        let energy = |x: [f64; 4]| {
            (0..4).map(|i| (0..4).map(|j| x[i] * mass[(i, j)] * x[j]).sum::<f64>()).sum::<f64>()
        };
        assert_relative_eq!(energy([1.0, 0.0, 1.0, 0.0]), per_length * l, max_relative = 1e-14);
        assert_relative_eq!(energy([0.0, 1.0, l, 1.0]), per_length * l.powi(3) / 3.0, max_relative = 1e-14);
    }
}
