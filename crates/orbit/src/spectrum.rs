//! Floquet multipliers, and which of them lie on the unit circle as well as they are known: see
//! `known_matrix.rs`.

use crate::{NoEigenvalues, by_rows::norm, eigenvalues::eigenvalues, known_matrix::KnownMatrix};

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
}

impl Spectrum {
    /// Of an orbit.
    ///
    /// # Errors
    /// As [`eigenvalues`].
    pub fn of(known: &KnownMatrix<'_>) -> Result<Self, NoEigenvalues> {
        let multipliers = eigenvalues(known.size, known.by_rows)?;
        // Two multipliers that meet part by the root of the error times the norm at most.
        let reach = known.error.max(2.0 * (known.error * norm(known.by_rows)).sqrt());
        let minus_one = [-1.0, 0.0];
        let off_minus_one = |[re, im]: &[f64; 2]| (1.0 + re).hypot(*im);
        let near_minus_one = |mu: &[f64; 2]| off_minus_one(mu) <= reach;
        let is_at_minus_one = multipliers.iter().any(near_minus_one) && known.belongs(minus_one);
        let at_minus_one =
            |mu: &[f64; 2]| is_at_minus_one && near_minus_one(mu) && known.reaches(*mu, off_minus_one(mu));
        let at_minus_one = multipliers.iter().map(at_minus_one).collect();
        let mut on_circle = Vec::with_capacity(multipliers.len());
        for mu in &multipliers {
            let off = (mu[0].hypot(mu[1]) - 1.0).abs();
            // The other one of a pair was just looked at.
            let on = match on_circle.last() {
                Some(&before) if mu[1] < 0.0 => before,
                _ => {
                    off <= reach
                        && known.reaches(*mu, off)
                        && (off <= known.error || known.reaches_circle(*mu))
                }
            };
            on_circle.push(on);
        }
        Ok(Self { multipliers, on_circle, at_minus_one })
    }
}

/// The largest modulus of multipliers, which come first; 0 of none.
pub(crate) fn largest_modulus(multipliers: &[[f64; 2]]) -> f64 {
    multipliers.first().map_or(0.0, |[re, im]| re.hypot(*im))
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
        let spectrum = Spectrum::of(&KnownMatrix::to_error(matrix, error)).unwrap();
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
        let spectrum = Spectrum::of(&KnownMatrix::to_error(&jordan(-0.5 * ERROR), ERROR)).unwrap();
        assert_eq!(spectrum.at_minus_one, [true, true], "a complex pair that an error makes real");
        let spectrum = Spectrum::of(&KnownMatrix::to_error(&jordan(-3.0 * ERROR), ERROR)).unwrap();
        assert_eq!(spectrum.at_minus_one, [false, false]);
    }

    /// `[a, c; 0, b]` has the condition `|c| / |a - b|`.
    #[test]
    fn an_eigenvalue_of_large_condition_is_known_less_well() {
        let matrix = |off: f64| [1.0 + off, 1e4, 0.0, 0.5];
        assert_eq!(stability(&matrix(1e4 * ERROR), ERROR), Stability::Marginal);
        assert_eq!(stability(&matrix(5e4 * ERROR), ERROR), Stability::Unstable);
        assert_eq!(stability(&[1.0 + 1e4 * ERROR, 0.0, 0.0, 0.5], ERROR), Stability::Unstable);
    }

    /// At a fold +1 is a multiplier, so that it belongs to the pseudospectrum. The root of the error times
    /// the norm is 0.06 here, and 1.04 is known to lie outside nevertheless.
    #[test]
    fn another_multiplier_at_its_place_on_the_circle_does_not_put_one_there() {
        let spectrum =
            Spectrum::of(&KnownMatrix::to_error(&[1.0, 0.0, 0.0, 0.0, 1.04, 0.0, 1e8, 0.0, 0.5], ERROR))
                .unwrap();
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
        let spectrum = Spectrum::of(&KnownMatrix::to_error(&matrix, ERROR)).unwrap();
        assert_eq!(spectrum.on_circle, [false, true, true]);
    }
}
