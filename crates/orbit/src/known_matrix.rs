//! A monodromy matrix, and how well its eigenvalues are known.
//! Equations (P8) and (P10) of the book, `docs/theory`.
//!
//! The computed matrix `A` is the monodromy matrix of the orbit up to an error `E`, `|E| <= e`. A number z is
//! an eigenvalue of one of the matrices `A + E` if and only if
//!
//! `s(z) = min |(A - z I) v| / |v| <= e`,
//!
//! the smallest singular value of `A - z I`: these z are the *pseudospectrum* of A. So a multiplier `mu` is
//! known to lie inside or outside the circle only if the point of the circle beside it, `z = mu/|mu|`, does
//! not belong to it. That is exact for multipliers of any condition, and for pairs that meet at +1 or -1,
//! where the matrix is defective and an error of e moves them by the root of e. The point may belong to it
//! for the sake of another multiplier, as +1 does at a fold: an error that grows moves `mu` within its own
//! part of the pseudospectrum only, so the place half-way between `mu` and z has to belong to it, too.
//! `1/s` is the norm of the inverse of `A - z I`, for which the root of the sum of its squared entries is
//! taken, at most `sqrt(2n)` times as large.
//!
//! # Errors
//! The matrix of a segment of the orbit is known to `e_s = 8 t + r` of its norm, with the tolerance t of the
//! motion and the mismatch r of the shooting equations, relative to the orbit. Their product is known besides
//! to `4 n eps max_k |A_k| + h`, with the rounding `eps` of a number and the products `A_k` up to each node,
//! in states measured by their energy. By h the jump of velocities in hard contacts is unknown, by rounding
//! of their penetration; what comes before and behind such a contact is a motion of the size one. In all the
//! monodromy matrix is known to `e = (e_s + 4 n eps) max_k |A_k| + h`. Where uncoupled modes fly through a
//! period that is short beside theirs, t is zero: over it they are damped by less than the tolerance, and
//! their matrices are known to rounding.
//!
//! Yet the errors of the segments are no errors in any direction: each of them is carried on by the motion.
//! On an orbit that is stretched by 300 in each of two segments and comes back in the third, the
//! pseudospectrum is 150 times too wide. So a multiplier is on the circle only if it is no farther off than
//! twice what these errors move it by to first order, too ([`Condition`]). Of a pair that meets, where first
//! order fails, that is as far as it parts; where three or more meet, it is less.
//!
//! Measured on undamped systems, whose multipliers lie on the circle exactly: see the tests of the
//! verification crate.
//!
//! # Source
//! Trefethen and Embree, *Spectra and Pseudospectra* (2005), chapter 2.

use hammerbeam_path::DenseLu;

use crate::{
    by_rows::{norm, shifted},
    floquet_vectors::Condition,
};

/// Steps of the tolerance of the motion in the error of a matrix, whose errors add; steps of an orbit, and
/// allowed for each of its segments.
const STEPS: f64 = 8.0;
/// How far a multiplier may be moved by errors, in what they do to first order.
const MOVED: f64 = 2.0;

/// The monodromy matrix of an orbit by rows, and what is known of it.
pub(crate) struct KnownMatrix<'a> {
    pub size: usize,
    pub by_rows: &'a [f64],
    /// Of the segments, of which it is the product.
    segments: Vec<&'a [f64]>,
    /// To this part of their norms the matrices of the segments are known.
    of_segments: f64,
    /// Error of their product.
    of_product: f64,
    /// Norm of what is not known of it in all.
    pub error: f64,
}

impl<'a> KnownMatrix<'a> {
    /// Of the matrices of segments and their products up to each node, from the identity to the monodromy
    /// matrix.
    pub fn of_orbit(
        size: usize,
        segments: Vec<&'a [f64]>,
        products: &'a [Vec<f64>],
        accuracy: &Accuracy,
    ) -> Self {
        let largest = products.iter().map(|product| norm(product)).fold(0.0, f64::max);
        let of_segments = STEPS * accuracy.motion_tolerance + accuracy.residual;
        let of_product = 2.0 * size as f64 * f64::EPSILON * largest + accuracy.rounding;
        let error = of_segments * largest + of_product;
        Self { size, by_rows: &products[products.len() - 1], segments, of_segments, of_product, error }
    }

    /// A matrix that is known to an error in any direction, for tests.
    #[cfg(test)]
    pub fn to_error(by_rows: &'a [f64], error: f64) -> Self {
        let (size, segments) = (by_rows.len().isqrt(), vec![by_rows]);
        Self { size, by_rows, segments, of_segments: 0.0, of_product: error, error }
    }

    /// How far a multiplier is moved by the errors, to first order.
    fn moved(&self, multiplier: [f64; 2]) -> f64 {
        let condition = Condition::of(self.size, &self.segments, self.by_rows, multiplier);
        let by = |condition: Condition| {
            condition.of_segments * self.of_segments + condition.of_product * self.of_product
        };
        condition.map(by).filter(|moved| !moved.is_nan()).unwrap_or(f64::INFINITY)
    }

    /// Whether the errors can move a multiplier so far, to first order.
    pub fn reaches(&self, multiplier: [f64; 2], off: f64) -> bool {
        // The least that they do.
        let least = self.segments.len() as f64 * self.of_segments + self.of_product;
        off <= MOVED * least || off <= MOVED * self.moved(multiplier)
    }

    /// Whether a number is a multiplier for some error.
    pub fn belongs(&self, z: [f64; 2]) -> bool {
        least_singular_value(self.size, self.by_rows, z) <= self.error
    }

    /// Whether a multiplier may be on the circle at its side, in its own part of the pseudospectrum.
    pub fn reaches_circle(&self, [re, im]: [f64; 2]) -> bool {
        let modulus = re.hypot(im);
        let at = |share: f64| [re, im].map(|part| part * (1.0 - share + share / modulus));
        self.belongs(at(1.0)) && self.belongs(at(0.5))
    }

    /// How far from its place on the unit circle a multiplier there can be: outwards or inwards, as far as
    /// errors move it, or as the pseudospectrum reaches, to a factor of two; the less of both.
    ///
    /// The pseudospectrum ends where `s(z) > e`.
    pub fn reach_from(&self, multiplier: [f64; 2]) -> f64 {
        let [re, im] = multiplier;
        let place = [re, im].map(|part| part / re.hypot(im));
        let beyond = |distance: f64| {
            [1.0 + distance, 1.0 - distance]
                .iter()
                .all(|radius| !self.belongs(place.map(|part| radius * part)))
        };
        let moved = MOVED * self.moved(multiplier);
        let first = self.error.min(moved).max(f64::EPSILON);
        let distances = std::iter::successors(Some(first), |distance| Some(2.0 * distance));
        let within = distances.take_while(|distance| *distance < moved.min(1.0));
        within.into_iter().find(|distance| beyond(*distance)).unwrap_or(moved.min(1.0))
    }
}

/// What the matrices of an orbit are known to, relative to them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Accuracy {
    /// Of a step of the motion; zero for a short flight, which is known to rounding.
    pub motion_tolerance: f64,
    /// Mismatch of the shooting equations.
    pub residual: f64,
    /// Of the jump of velocities in hard contacts.
    pub rounding: f64,
}

/// Estimate of the least singular value of `A - z I`, from below, within `sqrt(2n)` of it: `1 / |(A - z
/// I)^-1|`.
fn least_singular_value(size: usize, by_rows: &[f64], z: [f64; 2]) -> f64 {
    let matrix = shifted(size, by_rows, z);
    let width = matrix.len().isqrt();
    let mut lu = DenseLu::new();
    if lu.factorise(width, &matrix).is_err() {
        return 0.0;
    }
    // The other half of the inverse has the same entries.
    let mut inverse = vec![0.0; width * size];
    (0..size).for_each(|k| inverse[k * size + k] = 1.0);
    lu.solve_rows(&mut inverse, size);
    1.0 / norm(&inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ERROR: f64 = 1e-11;

    /// A pair that turns by an angle and grows by a factor, beside what is stretched.
    fn turned(stretch: f64, growth: f64, angle: f64) -> Vec<f64> {
        let (c, s) = (growth * angle.cos(), growth * angle.sin());
        vec![stretch, 0.0, 0.0, 0.0, c, -s, 0.0, s, c]
    }

    /// The product is known to 9e4 times the tolerance, the pair beside it to 600 times.
    #[test]
    fn what_is_stretched_between_the_nodes_leaves_a_pair_beside_it_known() {
        let accuracy = Accuracy { motion_tolerance: 5e-12, residual: 0.0, rounding: 0.0 };
        let reaches = |off: f64| {
            let segments = [turned(300.0, 1.0, 0.4), turned(300.0, 1.0, 0.4), turned(1e-5, 1.0 + off, 0.4)];
            let products = vec![
                turned(1.0, 1.0, 0.0),
                turned(300.0, 1.0, 0.4),
                turned(9e4, 1.0, 0.8),
                turned(0.9, 1.0 + off, 1.2),
            ];
            let borrowed = segments.iter().map(Vec::as_slice).collect();
            let known = KnownMatrix::of_orbit(3, borrowed, &products, &accuracy);
            let pair = [(1.0 + off) * 1.2_f64.cos(), (1.0 + off) * 1.2_f64.sin()];
            assert!(off < known.error, "the product alone does not decide");
            known.reaches(pair, off)
        };
        assert!(reaches(1e-9));
        assert!(!reaches(1e-6));
    }

    /// At -1: a multiplier that is alone is off by the error, one of a defective pair by its root.
    #[test]
    fn a_multiplier_reaches_as_far_as_an_error_moves_it() {
        let reach = |matrix: &[f64]| KnownMatrix::to_error(matrix, ERROR).reach_from([-1.0, 0.0]);
        let alone = reach(&[-1.0, 0.0, 0.0, 0.3]);
        assert!((ERROR..4.0 * ERROR).contains(&alone), "{alone}");
        let defective = reach(&[-1.0, 1.0, 0.0, -1.0]);
        assert!((ERROR.sqrt()..4.0 * ERROR.sqrt()).contains(&defective), "{defective}");
    }
}
