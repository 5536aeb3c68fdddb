//! Orthonormal tangent vectors that are carried along a motion.
//!
//! Over a section with the fundamental matrix `P` the frame `Q` becomes `P Q = Q' R` with an orthonormal `Q'` and an upper triangular `R` of positive
//! diagonal. The diagonal holds the growth of the volumes of order one, two and so on: their logarithms, summed, are what exponents are made of, and
//! the sum over all of them is `ln |det P|` whatever the frame.
//!
//! # Source
//! Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980), 9-20 and 21-30; Eckmann and Ruelle, Rev. Mod. Phys. 57 (1985), 617-656, section V.C. What differs: Householder's
//! reflections instead of Gram-Schmidt, which loses the directions that shrink most.

use faer::Mat;

use crate::{AttractorError, SectionMap};

/// Size of directions that are lost, relative to the largest.
const LOST: f64 = 1e-20;

/// A state with its frame of tangent vectors.
#[derive(Debug, Clone)]
pub struct Tangents {
    state: Vec<f64>,
    section: u64,
    scales: Vec<f64>,
    /// Columns of `Q`, one after another, in scaled coordinates.
    frame: Vec<f64>,
    /// Logarithms of the diagonal of the last `R`.
    growth: Vec<f64>,
}

impl Tangents {
    /// At a state at the start of the section of that number, with the unit vectors as the frame.
    ///
    /// # Errors
    /// [`AttractorError::StateLength`].
    pub fn new(map: &impl SectionMap, section: u64, state: &[f64]) -> Result<Self, AttractorError> {
        let (found, expected) = (state.len(), map.dimension());
        if found != expected {
            return Err(AttractorError::StateLength { found, expected });
        }
        let mut frame = vec![0.0; expected * expected];
        (0..expected).for_each(|i| frame[i * expected + i] = 1.0);
        let scales = map.scales();
        Ok(Self { state: state.to_vec(), section, scales, frame, growth: vec![0.0; expected] })
    }

    /// Goes over the next section.
    ///
    /// # Returns
    /// `ln R_ii`, in descending order of volume: what each direction grew by.
    /// # Errors
    /// The motion cannot be computed, or the directions cannot be told apart any more.
    pub fn step(&mut self, map: &mut impl SectionMap) -> Result<&[f64], AttractorError> {
        let (state, matrix) = map.flow(self.section, &self.state)?;
        self.state = state;
        self.section += 1;
        let n = self.state.len();
        let mut product = self.times_frame(&matrix);
        if map.growth_of_volume() == Some(f64::NEG_INFINITY) {
            self.forget(&mut product);
            return Ok(&self.growth);
        }
        if !triangularise(&mut product, n, &mut self.frame, &mut self.growth) {
            return Err(AttractorError::TangentsLost { section: self.section });
        }
        Ok(&self.growth)
    }

    /// The same over a section in which directions are lost for good: what is left of them is rounding, so their growth is minus infinity. The frame keeps its size.
    fn forget(&mut self, product: &mut [f64]) {
        let n = self.state.len();
        let largest = product.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if largest == 0.0 {
            self.growth.fill(f64::NEG_INFINITY);
            return;
        }
        // What is lost is made up for by directions far below all others, so that the frame stays one of unit vectors.
        for (k, entry) in product.iter_mut().enumerate() {
            if k / n == k % n {
                *entry += LOST * largest;
            }
        }
        triangularise(product, n, &mut self.frame, &mut self.growth);
        let most = self.growth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lost = self.growth.iter_mut().filter(|growth| **growth < most + LOST.ln() + 9.0);
        lost.for_each(|growth| *growth = f64::NEG_INFINITY);
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Number of the next section.
    #[must_use]
    pub fn section(&self) -> u64 {
        self.section
    }

    /// `S^-1 P S Q` by columns.
    fn times_frame(&self, matrix: &Mat<f64>) -> Vec<f64> {
        let n = self.state.len();
        let mut product = vec![0.0; n * n];
        for (column, target) in self.frame.chunks_exact(n).zip(product.chunks_exact_mut(n)) {
            for k in 0..n {
                let factor = column[k] * self.scales[k];
                for i in 0..n {
                    target[i] += matrix[(i, k)] * factor;
                }
            }
            target.iter_mut().zip(&self.scales).for_each(|(entry, scale)| *entry /= scale);
        }
        product
    }
}

/// `A = Q R` by reflections: writes Q by columns and the logarithms of the diagonal of R, made positive. False if R is singular or not finite.
fn triangularise(a: &mut [f64], n: usize, q: &mut [f64], growth: &mut [f64]) -> bool {
    let mut signs = vec![1.0; n];
    for k in 0..n {
        let norm = a[k * n + k..(k + 1) * n].iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(norm.is_finite() && norm > 0.0) {
            return false;
        }
        growth[k] = norm.ln();
        // R_kk becomes -sign(a_kk) norm.
        let head = a[k * n + k];
        signs[k] = if head > 0.0 { -1.0 } else { 1.0 };
        // The reflection's vector takes the place of the column, scaled to length one.
        a[k * n + k] = head - signs[k] * norm;
        let length = a[k * n + k..(k + 1) * n].iter().map(|x| x * x).sum::<f64>().sqrt();
        a[k * n + k..(k + 1) * n].iter_mut().for_each(|x| *x /= length);
        let (done, rest) = a.split_at_mut((k + 1) * n);
        let vector = &done[k * n + k..];
        rest.chunks_exact_mut(n).for_each(|column| reflect(vector, &mut column[k..]));
    }
    q.fill(0.0);
    for (j, column) in q.chunks_exact_mut(n).enumerate() {
        column[j] = signs[j];
        for k in (0..=j).rev() {
            reflect(&a[k * n + k..(k + 1) * n], &mut column[k..]);
        }
    }
    true
}

fn reflect(vector: &[f64], column: &mut [f64]) {
    let twice = 2.0 * vector.iter().zip(column.iter()).map(|(v, x)| v * x).sum::<f64>();
    column.iter_mut().zip(vector).for_each(|(x, v)| *x -= twice * v);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix of seven orders of magnitude: `Q` is orthonormal, and `Q^T A` is upper triangular with the positive diagonal that is told.
    #[test]
    fn reflections_give_an_orthonormal_frame_and_the_growth_of_volumes() {
        let n = 5;
        let entry = |i: usize, j: usize| ((3 * i + 7 * j) as f64).sin() * 10f64.powi(-(i as i32) - j as i32);
        let original: Vec<f64> =
            (0..n * n).map(|k| entry(k % n, k / n) + if k % (n + 1) == 0 { 1e-3 } else { 0.0 }).collect();
        let (mut a, mut q, mut growth) = (original.clone(), vec![0.0; n * n], vec![0.0; n]);
        assert!(triangularise(&mut a, n, &mut q, &mut growth));
        let product = |x: &[f64], i: usize, y: &[f64], j: usize| -> f64 {
            (0..n).map(|k| x[i * n + k] * y[j * n + k]).sum()
        };
        for i in 0..n {
            for j in 0..n {
                let unit = if i == j { 1.0 } else { 0.0 };
                assert!((product(&q, i, &q, j) - unit).abs() < 1e-14);
                let r = product(&q, i, &original, j);
                match i.cmp(&j) {
                    std::cmp::Ordering::Equal => assert!((r.ln() - growth[i]).abs() < 1e-9 * r.ln().abs()),
                    std::cmp::Ordering::Greater => assert!(r.abs() < 1e-15),
                    std::cmp::Ordering::Less => {}
                }
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_told() {
        let (mut a, mut q, mut growth) = (vec![0.0; 4], vec![0.0; 4], vec![0.0; 2]);
        assert!(!triangularise(&mut a, 2, &mut q, &mut growth));
    }
}
