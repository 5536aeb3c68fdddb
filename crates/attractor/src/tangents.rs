//! Orthonormal tangent vectors that are carried along a motion. Equation (E2) of the book, `docs/theory`.
//!
//! Over a section with the fundamental matrix `P` the frame `Q` becomes `P Q = Q' R` with an orthonormal `Q'`
//! and an upper triangular `R` of positive diagonal. The diagonal holds the growth of the volumes of order
//! one, two and so on: their logarithms, summed, are what exponents are made of, and the sum over all of them
//! is `ln |det P|` whatever the frame.
//!
//! **Parts.** Of a direction that shrinks by more than 1e16 against another over a section only rounding is
//! left. So a section is cut into halves, and those again, until none has more than [`SPREAD`] between what
//! its directions grow by: an impact on a rigid stop with the speed `v` stretches one direction by `1/v` and
//! another by `v`, and in chaos that may be any speed. The effect of a single impact cannot be cut into
//! parts. So parts are not cut more often than the map allows ([`SectionMap::most_halvings`]), and are then
//! taken as they are; an impact 1e-4 times as fast as the motion leaves eight digits. The next section starts
//! with parts of the size with which this one has ended.
//!
//! # Source
//! Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980), 9-20 and 21-30; Eckmann and Ruelle, Rev.
//! Mod. Phys. 57 (1985), 617-656, section V.C. What differs: Householder's reflections instead of
//! Gram-Schmidt, which loses the directions that shrink most.

use faer::Mat;

use crate::{AttractorError, Part, SectionMap};

/// Largest difference of the logarithms of growth in one part at which all directions are distinguished to
/// six digits and more.
const SPREAD: f64 = 13.8;
/// Parts are joined where it is less than this share of that.
const CALM: f64 = 0.25;
/// What stands for directions that are lost, relative to the largest entry.
const NOTHING: f64 = 1e-20;

/// A state with its frame of tangent vectors.
#[derive(Debug, Clone)]
pub struct Tangents {
    state: Vec<f64>,
    section: u64,
    scales: Vec<f64>,
    /// Columns of `Q`, one after another, in scaled coordinates.
    frame: Vec<f64>,
    /// Logarithms of growth over the last section.
    growth: Vec<f64>,
    /// What their sum has to be.
    growth_of_volume: Option<f64>,
    /// Initial halvings of the next section.
    halvings: u32,
}

/// A frame after a part of a section, with the logarithms of the diagonal of `R`.
struct Carried {
    frame: Vec<f64>,
    growth: Vec<f64>,
    /// Difference between the largest and the smallest of those that are not lost.
    spread: f64,
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
        let (state, scales, growth) = (state.to_vec(), map.scales(), vec![0.0; expected]);
        Ok(Self { state, section, scales, frame, growth, growth_of_volume: None, halvings: 0 })
    }

    /// Goes over the next section. After an error it cannot go on.
    ///
    /// # Errors
    /// The motion cannot be computed, or the directions can no longer be distinguished.
    pub fn step(&mut self, map: &mut impl SectionMap) -> Result<(), AttractorError> {
        self.growth.fill(0.0);
        self.growth_of_volume = Some(0.0);
        let mut part = Part { section: self.section, number: 0, halvings: self.halvings };
        while part.number >> part.halvings == 0 {
            let (state, matrix) = map.flow(part, &self.state)?;
            let product = self.times_frame(&matrix);
            let volume = map.growth_of_volume();
            let can_halve = part.halvings < map.most_halvings();
            let carried = match carry(product, self.state.len(), map.directions_lost()) {
                Some(carried) if carried.spread <= SPREAD || !can_halve => carried,
                None if !can_halve => return Err(AttractorError::TangentsLost { section: self.section }),
                _ => {
                    map.take_back();
                    part = Part { number: 2 * part.number, halvings: part.halvings + 1, ..part };
                    continue;
                }
            };
            self.state = state;
            self.frame = carried.frame;
            self.growth.iter_mut().zip(carried.growth).for_each(|(sum, growth)| *sum += growth);
            self.growth_of_volume = self.growth_of_volume.zip(volume).map(|(sum, volume)| sum + volume);
            part.number += 1;
            if carried.spread < CALM * SPREAD && part.halvings > 0 && part.number.is_multiple_of(2) {
                part = Part { number: part.number / 2, halvings: part.halvings - 1, ..part };
            }
        }
        self.section += 1;
        self.halvings = part.halvings;
        Ok(())
    }

    /// `ln R_ii` of the last section, in descending order of volume: what each direction grew by; minus
    /// infinity where it is lost for good.
    #[must_use]
    pub fn growth(&self) -> &[f64] {
        &self.growth
    }

    /// What the sum over the growth of the last section has to be, where [`SectionMap::growth_of_volume`]
    /// gives it.
    #[must_use]
    pub fn growth_of_volume(&self) -> Option<f64> {
        self.growth_of_volume
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

/// The frame and its growth from the product of a fundamental matrix and a frame; `None` if the product is
/// singular or not finite.
///
/// * `lost`: so many directions are lost for good; their growth is minus infinity, and the frame keeps its
///   size by directions that nothing says anything of.
fn carry(mut product: Vec<f64>, n: usize, lost: usize) -> Option<Carried> {
    if lost > 0 {
        let largest = product.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let nothing = if largest > 0.0 { NOTHING * largest } else { 1.0 };
        (0..n).for_each(|i| product[i * (n + 1)] += nothing);
    }
    let (mut frame, mut growth) = (vec![0.0; n * n], vec![0.0; n]);
    if !triangularise(&mut product, n, &mut frame, &mut growth) {
        return None;
    }
    let mut ascending: Vec<usize> = (0..n).collect();
    ascending.sort_by(|&i, &j| growth[i].total_cmp(&growth[j]));
    let spread = match ascending.get(lost) {
        Some(&smallest) => growth[ascending[n - 1]] - growth[smallest],
        None => 0.0,
    };
    // What is left of lost directions is rounding: they are those that grow least, once no other one shrinks
    // nearly as much.
    ascending.iter().take(lost).for_each(|&i| growth[i] = f64::NEG_INFINITY);
    Some(Carried { frame, growth, spread })
}

/// `A = Q R` by reflections: writes Q by columns and the logarithms of the diagonal of R, made positive.
/// False if R is singular or not finite.
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

    /// A matrix of seven orders of magnitude: `Q` is orthonormal, and `Q^T A` is upper triangular with the
    /// positive diagonal that is reported.
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
    fn a_singular_matrix_is_reported() {
        let (mut a, mut q, mut growth) = (vec![0.0; 4], vec![0.0; 4], vec![0.0; 2]);
        assert!(!triangularise(&mut a, 2, &mut q, &mut growth));
    }
}
