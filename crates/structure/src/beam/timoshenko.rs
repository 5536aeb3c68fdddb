//! The element of Timoshenko's beam whose statics are exact under loads at the nodes.
//!
//! Coordinates `(w_1, psi_1, w_2, psi_2)` with the rotation `psi` of the section. Displacement and rotation
//! are those of an element without loads between its nodes: a cubic and a parabola, joined by the shear
//! angle `w' - psi`, which is constant. At `s = 12 E I / (kappa G A l^2)` they are functions of `x = z / l`:
//!
//! `(1 + s) w = (1 + s - s x - 3 x^2 + 2 x^3) w_1 + (s x + 3 x^2 - 2 x^3) w_2`
//! `+ l x ((1 + s/2) - (2 + s/2) x + x^2) psi_1 + l x (-s/2 - (1 - s/2) x + x^2) psi_2`,
//!
//! `(1 + s) psi = 6 (x - x^2) (w_2 - w_1)/l + (1 + s - (4 + s) x + 3 x^2) psi_1 + (3 x^2 - (2 - s) x) psi_2`.
//!
//! Without shear, `s = 0`, these are the cubics of Hermite and their slopes. The relative error of an
//! eigenfrequency of wavenumber `k` is about `(k l)^2 k^2 E I/(24 kappa G A)`, and that of the element
//! without shear.
//!
//! # Source
//! Przemieniecki, *Theory of Matrix Structural Analysis* (1968), 5.6; Friedman and Kosmatka, Computers and
//! Structures 47 (1993), 473-481. The mass is integrated by quadrature here.

use faer::Mat;

use super::element;

/// Points in `[0, 1]` and weights of the formula of Gauss with four points, exact to degree 7.
const QUADRATURE: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// The two strains of an element: rows of `G_e` with `K_e = G_e^T G_e`.
///
/// The symmetric form bends without shear, as that of Euler and Bernoulli; the antisymmetric one has the
/// energy `3EI/(2l (1 + s)) (psi_1 + psi_2 - 2 (w_2 - w_1)/l)^2`.
///
/// * `bending_stiffness`: `E I` [N m^2].
/// * `length`: `l` [m].
/// * `shear_number`: `s` [-].
pub(super) fn strains(bending_stiffness: f64, length: f64, shear_number: f64) -> [[f64; 4]; 2] {
    let [symmetric, antisymmetric] = element::bending_strains(bending_stiffness, length);
    let softer = (1.0 + shear_number).sqrt();
    [symmetric, antisymmetric.map(|entry| entry / softer)]
}

/// Consistent mass matrix of an element, with the rotary inertia of its section.
///
/// * `per_length`: mass [kg/m] and rotary inertia `rho I` [kg m].
/// * `length`: `l` [m].
/// * `shear_number`: `s` [-].
pub(super) fn consistent_mass(per_length: (f64, f64), length: f64, shear_number: f64) -> Mat<f64> {
    let mut mass = Mat::zeros(4, 4);
    for (x, weight) in QUADRATURE {
        let (displacement, rotation) = shapes(x, length, shear_number);
        for i in 0..4 {
            for j in 0..4 {
                let moved = per_length.0 * displacement[i] * displacement[j];
                let turned = per_length.1 * rotation[i] * rotation[j];
                mass[(i, j)] += weight * length * (moved + turned);
            }
        }
    }
    mass
}

/// Displacement and rotation at a place `x` in `[0, 1]` per unit of each coordinate.
fn shapes(x: f64, l: f64, s: f64) -> ([f64; 4], [f64; 4]) {
    let displacement = [
        1.0 + s - x * (s + x * (3.0 - 2.0 * x)),
        l * x * (1.0 + s / 2.0 - x * (2.0 + s / 2.0 - x)),
        x * (s + x * (3.0 - 2.0 * x)),
        l * x * (-s / 2.0 - x * (1.0 - s / 2.0 - x)),
    ];
    let slope = 6.0 * x * (1.0 - x) / l;
    let rotation = [-slope, 1.0 + s - x * (4.0 + s - 3.0 * x), slope, x * (3.0 * x - 2.0 + s)];
    (displacement.map(|value| value / (1.0 + s)), rotation.map(|value| value / (1.0 + s)))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn energy(matrix: &Mat<f64>, x: [f64; 4]) -> f64 {
        (0..4).map(|i| (0..4).map(|j| x[i] * matrix[(i, j)] * x[j]).sum::<f64>()).sum()
    }

    #[test]
    fn without_shear_and_rotary_inertia_it_is_the_element_of_euler_and_bernoulli() {
        let (mass, plain) = (consistent_mass((2.0, 0.0), 0.7, 0.0), element::consistent_mass(2.0, 0.7));
        for i in 0..4 {
            for j in 0..4 {
                assert!((mass[(i, j)] - plain[(i, j)]).abs() < 1e-15);
            }
        }
        assert_eq!(strains(3.0, 0.7, 0.0), element::bending_strains(3.0, 0.7));
    }

    /// A rigid translation and a rigid rotation about the first node.
    #[test]
    fn mass_of_a_rigid_motion_does_not_depend_on_shear() {
        let (l, s) = (0.7_f64, 1.3);
        let mass = consistent_mass((2.0, 0.1), l, s);
        assert_relative_eq!(energy(&mass, [1.0, 0.0, 1.0, 0.0]), 2.0 * l, max_relative = 1e-14);
        let turning = 2.0 * l.powi(3) / 3.0 + 0.1 * l;
        assert_relative_eq!(energy(&mass, [0.0, 1.0, l, 1.0]), turning, max_relative = 1e-14);
    }

    /// The shear angle `w' - psi` is the same everywhere, and displacements fit the coordinates.
    #[test]
    fn shear_angle_is_constant() {
        let (l, s, step) = (0.7, 1.3, 1e-6);
        for coordinate in 0..4 {
            let angle = |x: f64| {
                let w = |x: f64| shapes(x, l, s).0[coordinate];
                (w(x + step) - w(x - step)) / (2.0 * step * l) - shapes(x, l, s).1[coordinate]
            };
            assert!((angle(0.2) - angle(0.9)).abs() < 1e-9);
            let unit = |of: usize| if of == coordinate { 1.0 } else { 0.0 };
            for (x, first) in [(0.0, 0), (1.0, 2)] {
                let (w, psi) = shapes(x, l, s);
                assert!((w[coordinate] - unit(first)).abs() < 1e-15);
                assert!((psi[coordinate] - unit(first + 1)).abs() < 1e-15);
            }
        }
    }
}
