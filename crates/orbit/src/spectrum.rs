//! Floquet multipliers, and which of them lie on the unit circle as well as they are known.
//! Equation (P8) of the book, `docs/theory`.
//!
//! The computed monodromy matrix `A` is that of the orbit up to an error `E`, `|E| <= e`. A number z is an
//! eigenvalue of one of the matrices `A + E` if and only if
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
//! # The error of a monodromy matrix
//! `e = (8 t + 4 n eps + r) max_k |A_k| + h`, with the tolerance t of the motion, the rounding `eps` of a
//! number, the mismatch r of the shooting equations, relative to the orbit, and the products `A_k` of the
//! fundamental matrices up to each node, in states measured by their energy. By h the jump of velocities in
//! hard contacts is unknown, by rounding of their penetration; what comes before and behind such a contact is
//! a motion of the size one. Measured on undamped systems, whose multipliers lie on the circle exactly: see
//! the tests of the verification crate. Where uncoupled modes fly through a period that is short beside
//! theirs, t is zero: over it they are damped by less than the tolerance, and their matrices are known to
//! rounding.
//!
//! # Source
//! Trefethen and Embree, *Spectra and Pseudospectra* (2005), chapter 2.

use hammerbeam_path::DenseLu;

use crate::{NoEigenvalues, eigenvalues::eigenvalues};

/// Steps of the tolerance of the motion in the error of a monodromy matrix: those of an orbit, whose errors
/// add.
const STEPS: f64 = 8.0;

/// What is known of the stability of a periodic solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stability {
    /// All multipliers lie inside the unit circle.
    Stable,
    /// None is known to lie outside, but at least one is on the circle as well as it is known: at a
    /// bifurcation, or all along a branch where a mode has no damping.
    Marginal,
    /// At least one lies outside.
    Unstable,
}

impl Stability {
    /// Of multipliers, those on the circle marked.
    pub(crate) fn of(multipliers: &[[f64; 2]], on_circle: &[bool]) -> Self {
        let marks = on_circle.iter().copied().chain(std::iter::repeat(false));
        let outside = multipliers.iter().zip(marks).any(|([re, im], on)| !on && re.hypot(*im) >= 1.0);
        if outside {
            Self::Unstable
        } else if on_circle.contains(&true) {
            Self::Marginal
        } else {
            Self::Stable
        }
    }

    /// Whether no multiplier is known to lie outside: a motion may settle there, or stay beside it.
    #[must_use]
    pub fn may_be_stable(self) -> bool {
        self != Self::Unstable
    }

    /// `true`, `marginal` or `false`, as tables have it in the column `stable`.
    #[must_use]
    pub fn column(self) -> &'static str {
        match self {
            Self::Stable => "true",
            Self::Marginal => "marginal",
            Self::Unstable => "false",
        }
    }

    /// In words.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Marginal => "marginal",
            Self::Unstable => "unstable",
        }
    }
}

/// The multipliers of a monodromy matrix.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Spectrum {
    /// Largest modulus first, the positive imaginary part first in a pair.
    pub multipliers: Vec<[f64; 2]>,
    /// Which of them are on the unit circle as well as they are known.
    pub on_circle: Vec<bool>,
    /// Which of them are at -1 as well as they are known.
    pub at_minus_one: Vec<bool>,
    /// Norm of what is not known of the matrix.
    pub error: f64,
}

impl Spectrum {
    /// Of an orbit, by the products of its fundamental matrices up to each node, from the identity to the
    /// monodromy matrix.
    ///
    /// # Errors
    /// As [`eigenvalues`].
    pub fn of_orbit(size: usize, products: &[Vec<f64>], accuracy: &Accuracy) -> Result<Self, NoEigenvalues> {
        let monodromy = &products[products.len() - 1];
        Self::of(size, monodromy, monodromy_error(size, products, accuracy))
    }

    /// Of a matrix by rows that is known to this error.
    ///
    /// # Errors
    /// As [`eigenvalues`].
    pub fn of(size: usize, by_rows: &[f64], error: f64) -> Result<Self, NoEigenvalues> {
        let multipliers = eigenvalues(size, by_rows)?;
        // Two multipliers that meet part by the root of the error times the norm at most.
        let reach = error.max(2.0 * (error * norm(by_rows)).sqrt());
        let belongs = |z| least_singular_value(size, by_rows, z) <= error;
        // Whether a multiplier may be on the circle at its side, in its own part of the pseudospectrum.
        let reaches_circle = |[re, im]: [f64; 2]| {
            let modulus = re.hypot(im);
            let at = |share: f64| [re, im].map(|part| part * (1.0 - share + share / modulus));
            belongs(at(1.0)) && belongs(at(0.5))
        };
        let minus_one = [-1.0, 0.0];
        let near_minus_one = |[re, im]: &[f64; 2]| (1.0 + re).hypot(*im) <= reach;
        let is_at_minus_one = multipliers.iter().any(near_minus_one) && belongs(minus_one);
        let mut on_circle = Vec::with_capacity(multipliers.len());
        for [re, im] in &multipliers {
            let modulus = re.hypot(*im);
            let off = (modulus - 1.0).abs();
            // The other one of a pair was just looked at.
            let on = match on_circle.last() {
                Some(&before) if *im < 0.0 => before,
                _ => off <= error || off <= reach && reaches_circle([*re, *im]),
            };
            on_circle.push(on);
        }
        let at_minus_one = multipliers.iter().map(|mu| is_at_minus_one && near_minus_one(mu)).collect();
        Ok(Self { multipliers, on_circle, at_minus_one, error })
    }
}

/// How far from a place on the unit circle a multiplier of a matrix by rows can be that is there but for this
/// error: outwards or inwards, to a factor of two, and no less than the error.
///
/// The pseudospectrum ends where `s(z) > e`.
pub(crate) fn reach_from(size: usize, by_rows: &[f64], error: f64, place: [f64; 2]) -> f64 {
    let beyond = |distance: f64| {
        [1.0 + distance, 1.0 - distance]
            .iter()
            .all(|radius| least_singular_value(size, by_rows, place.map(|part| radius * part)) > error)
    };
    let distances = std::iter::successors(Some(error.max(f64::EPSILON)), |distance| Some(2.0 * distance));
    distances.take_while(|distance| *distance < 1.0).find(|distance| beyond(*distance)).unwrap_or(1.0)
}

/// The largest modulus of multipliers, which come first; 0 of none.
pub(crate) fn largest_modulus(multipliers: &[[f64; 2]]) -> f64 {
    multipliers.first().map_or(0.0, |[re, im]| re.hypot(*im))
}

/// Root of the sum of the squared entries.
pub(crate) fn norm(matrix: &[f64]) -> f64 {
    matrix.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
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

/// The error of a monodromy matrix: see the module.
fn monodromy_error(size: usize, products: &[Vec<f64>], accuracy: &Accuracy) -> f64 {
    let largest = products.iter().map(|product| norm(product)).fold(0.0, f64::max);
    let &Accuracy { motion_tolerance, residual, rounding } = accuracy;
    (STEPS * motion_tolerance + 2.0 * size as f64 * f64::EPSILON + residual) * largest + rounding
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

/// `A - z I` of a matrix by rows; for a complex number `[A - a I, b I; -b I, A - a I]`, which acts on real
/// and imaginary parts.
pub(crate) fn shifted(size: usize, by_rows: &[f64], [re, im]: [f64; 2]) -> Vec<f64> {
    let blocks = if im == 0.0 { 1 } else { 2 };
    let width = blocks * size;
    let mut matrix = vec![0.0; width * width];
    for (i, row) in matrix.chunks_exact_mut(width).enumerate() {
        let (block, of_block) = (i / size, i % size);
        row[block * size..(block + 1) * size]
            .copy_from_slice(&by_rows[of_block * size..(of_block + 1) * size]);
        row[i] -= re;
        if blocks == 2 {
            row[(1 - block) * size + of_block] = if block == 0 { im } else { -im };
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its matrix is wrong")]

    use super::*;

    const ERROR: f64 = 1e-11;

    /// Rotation by an angle, its pair of modulus r.
    fn rotation(r: f64, angle: f64) -> [f64; 4] {
        [r * angle.cos(), -r * angle.sin(), r * angle.sin(), r * angle.cos()]
    }

    fn stability(matrix: &[f64], error: f64) -> Stability {
        let size = matrix.len().isqrt();
        let spectrum = Spectrum::of(size, matrix, error).unwrap();
        Stability::of(&spectrum.multipliers, &spectrum.on_circle)
    }

    #[test]
    fn a_pair_is_marginal_within_the_error_of_the_matrix_and_no_further() {
        for angle in [0.1, 1.0, 3.0] {
            assert_eq!(stability(&rotation(1.0 + 0.5 * ERROR, angle), ERROR), Stability::Marginal);
            assert_eq!(stability(&rotation(1.0 - 0.5 * ERROR, angle), ERROR), Stability::Marginal);
            assert_eq!(stability(&rotation(1.0 + 3.0 * ERROR, angle), ERROR), Stability::Unstable);
            assert_eq!(stability(&rotation(1.0 - 3.0 * ERROR, angle), ERROR), Stability::Stable);
        }
    }

    /// `[-1, 1; d, -1]` has the multipliers `-1 +- sqrt(d)`: an error d moves them by its root.
    #[test]
    fn a_defective_pair_is_known_to_the_root_of_the_error() {
        let jordan = |d: f64| [-1.0, 1.0, d, -1.0];
        assert_eq!(stability(&jordan(0.5 * ERROR), ERROR), Stability::Marginal);
        assert_eq!(stability(&jordan(3.0 * ERROR), ERROR), Stability::Unstable);
        let spectrum = Spectrum::of(2, &jordan(-0.5 * ERROR), ERROR).unwrap();
        assert_eq!(spectrum.at_minus_one, [true, true], "a complex pair that an error makes real");
        let spectrum = Spectrum::of(2, &jordan(-3.0 * ERROR), ERROR).unwrap();
        assert_eq!(spectrum.at_minus_one, [false, false]);
    }

    /// At -1: a multiplier that is alone is off by the error, one of a defective pair by its root.
    #[test]
    fn a_multiplier_reaches_as_far_as_an_error_moves_it() {
        let reach = |matrix: &[f64]| reach_from(2, matrix, ERROR, [-1.0, 0.0]);
        let alone = reach(&[-1.0, 0.0, 0.0, 0.3]);
        assert!((ERROR..4.0 * ERROR).contains(&alone), "{alone}");
        let defective = reach(&[-1.0, 1.0, 0.0, -1.0]);
        assert!((ERROR.sqrt()..4.0 * ERROR.sqrt()).contains(&defective), "{defective}");
    }

    /// `[a, c; 0, b]` has the condition `|c| / |a - b|`.
    #[test]
    fn an_eigenvalue_of_large_condition_is_known_less_well() {
        let matrix = |off: f64| [1.0 + off, 1e4, 0.0, 0.5];
        assert_eq!(stability(&matrix(1e4 * ERROR), ERROR), Stability::Marginal);
        assert_eq!(stability(&matrix(5e4 * ERROR), ERROR), Stability::Unstable);
        assert_eq!(stability(&[1.0 + 1e4 * ERROR, 0.0, 0.0, 0.5], ERROR), Stability::Unstable);
    }

    /// At a fold +1 is a multiplier, so that it belongs to the pseudospectrum; the root of the error times the
    /// norm is 0.06 here, and 1.04 is known to lie outside nevertheless.
    #[test]
    fn another_multiplier_at_its_place_on_the_circle_does_not_put_one_there() {
        let spectrum = Spectrum::of(3, &[1.0, 0.0, 0.0, 0.0, 1.04, 0.0, 1e8, 0.0, 0.5], ERROR).unwrap();
        assert_eq!(spectrum.on_circle, [false, true, false]);
        assert_eq!([0, 1, 2].map(|k| spectrum.multipliers[k][0]), [1.04, 1.0, 0.5]);
    }

    #[test]
    fn one_outside_makes_unstable_whatever_is_on_the_circle() {
        let mut matrix = vec![0.0; 9];
        matrix[0] = 1.5;
        for (k, entry) in rotation(1.0, 0.7).into_iter().enumerate() {
            matrix[(1 + k / 2) * 3 + 1 + k % 2] = entry;
        }
        assert_eq!(stability(&matrix, ERROR), Stability::Unstable);
        let spectrum = Spectrum::of(3, &matrix, ERROR).unwrap();
        assert_eq!(spectrum.on_circle, [false, true, true]);
    }
}
