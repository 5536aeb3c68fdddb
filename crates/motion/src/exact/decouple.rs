//! Blocks of a structure whose dampers couple the modes.
//!
//! Modes that no damping entry connects stay as they are. Each connected group of m modes is the first-order
//! system `A` of size 2m; its eigenvalues are taken in pairs (complex conjugates, or neighbouring real ones)
//! with `c = -(l_1 + l_2)` and `k = l_1 l_2`. The null space of `A^2 + c A + k I` is the invariant plane of
//! the pair, well determined even where its eigenvectors merge (critical damping). With any `s` in the plane
//! and `p = (A + c I) s`, `A p = -k s` and `A s = p - c s`: the block of `block.rs`.
//!
//! In a stiff structure the squares in that null space cost the slow pairs their digits; Newton's method on
//! the equations of the plane (`plane.rs`), each row of its own size, brings them back.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, c64};
use hammerbeam_structure::ReducedModel;

use super::{
    block::{Blocks, Transform},
    plane::InvariantPlane,
};

/// Damping entries below this fraction of the diagonal do not couple modes (rounding of a projection).
const COUPLING: f64 = 1e-13;
/// Largest condition number of the block coordinates that keeps ten digits.
const CONDITION: f64 = 1e7;

/// The damping of a group of modes has no block form: more than two eigenvalues merge into one vector.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the damped modes cannot be told apart to ten digits (condition {condition:.1e}, at most \
     {CONDITION:.0e} is allowed): more than two nearly coincide, or a damper is far stronger than what it \
     damps; make it weaker, or join what it connects"
)]
pub struct MergedModes {
    /// Condition number of the eigenvectors.
    pub condition: f64,
}

impl Blocks {
    /// The blocks of a model.
    ///
    /// # Errors
    /// [`MergedModes`] where more than two eigenvalues of the damped structure merge into one vector.
    pub fn new(model: &ReducedModel) -> Result<Self, MergedModes> {
        let n = model.dof();
        let frequencies = model.natural_frequencies.iter().enumerate();
        let mut pairs: Vec<_> = frequencies.map(|(i, w)| (w * w, model.damping[(i, i)])).collect();
        let groups: Vec<Vec<usize>> = groups(model).into_iter().filter(|group| group.len() > 1).collect();
        if groups.is_empty() {
            return Ok(Self::of(pairs, None));
        }
        let mut from_blocks = Mat::<f64>::identity(2 * n, 2 * n);
        for group in &groups {
            decouple(model, group, &mut pairs, &mut from_blocks)?;
        }
        let rates: Vec<f64> = (0..n).map(|mode| rate(model, mode)).collect();
        let (to_blocks, condition) = inverse(&from_blocks, &rates);
        if condition.is_nan() || condition > CONDITION {
            return Err(MergedModes { condition });
        }
        Ok(Self::of(pairs, Some(Transform { from_blocks, to_blocks })))
    }
}

/// Inverse of `S`, and its condition number with displacements scaled to velocities and columns to length
/// one.
fn inverse(from_blocks: &Mat<f64>, rates: &[f64]) -> (Mat<f64>, f64) {
    let size = from_blocks.nrows();
    let row_scale = |i: usize| rates.get(i).copied().unwrap_or(1.0);
    let rows = Mat::from_fn(size, size, |i, j| from_blocks[(i, j)] * row_scale(i));
    let lengths: Vec<f64> = (0..size).map(|j| rows.col(j).norm_l2()).collect();
    let scaled = Mat::from_fn(size, size, |i, j| rows[(i, j)] / lengths[j]);
    let mut inverse = scaled.partial_piv_lu().inverse();
    let condition = (0..size).map(|j| inverse.row(j).norm_l2()).fold(0.0, f64::max);
    let defect = Mat::<f64>::identity(size, size) - &scaled * &inverse;
    inverse = &inverse + &inverse * &defect;
    (Mat::from_fn(size, size, |i, j| inverse[(i, j)] / lengths[i] * row_scale(j)), condition)
}

/// Connected components of the modes under the damping matrix.
fn groups(model: &ReducedModel) -> Vec<Vec<usize>> {
    let n = model.dof();
    let scale = (0..n).map(|i| model.damping[(i, i)].abs()).fold(0.0, f64::max);
    let mut group_of: Vec<usize> = (0..n).collect();
    for i in 0..n {
        for j in 0..i {
            if model.damping[(i, j)].abs() > COUPLING * scale && group_of[i] != group_of[j] {
                let (from, to) = (group_of[i], group_of[j]);
                group_of.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
            }
        }
    }
    (0..n).map(|g| (0..n).filter(|&i| group_of[i] == g).collect()).collect()
}

/// Replaces the modes of a group by blocks, each a stiffness and a damping, and fills their columns of `S`.
fn decouple(
    model: &ReducedModel,
    group: &[usize],
    blocks: &mut [(f64, f64)],
    from_blocks: &mut Mat<f64>,
) -> Result<(), MergedModes> {
    let (n, m) = (model.dof(), group.len());
    let rate: Vec<f64> = group.iter().map(|&i| rate(model, i)).collect();
    let system = first_order(model, group, &rate);
    let pairs = eigenvalue_pairs(&system)?;
    let mut taken: Vec<(f64, f64)> = Vec::new();
    for (slot, &(stiffness, damping)) in pairs.iter().enumerate() {
        let same = |other: &&(f64, f64)| {
            (other.0 - stiffness).abs() <= 1e-7 * stiffness.abs()
                && (other.1 - damping).abs() <= 1e-7 * damping.abs()
        };
        let copy = taken.iter().filter(same).count();
        let copies = pairs.iter().filter(same).count();
        taken.push((stiffness, damping));
        let (p, s) = plane(&system, stiffness, damping, copy, copies)?;
        let displacements = |values: &[f64]| (0..m).map(|k| values[k] / rate[k]).collect::<Vec<f64>>();
        let mut plane = InvariantPlane { stiffness, damping, p: displacements(&p), s: displacements(&s) };
        if copies == 1 {
            plane.refine(model, group);
            plane.stiffness = plane.stiffness.max(0.0);
        }
        let block = group[slot];
        blocks[block] = (plane.stiffness, plane.damping);
        for (column, values) in [(block, plane.column_p()), (n + block, plane.column_s())] {
            for i in 0..2 * n {
                from_blocks[(i, column)] = 0.0;
            }
            for k in 0..m {
                from_blocks[(group[k], column)] = values[k];
                from_blocks[(n + group[k], column)] = values[m + k];
            }
        }
    }
    Ok(())
}

/// A rate by which displacements of a mode are scaled to velocities.
fn rate(model: &ReducedModel, mode: usize) -> f64 {
    let rate = model.natural_frequencies[mode].max(model.damping[(mode, mode)].abs());
    if rate > 0.0 { rate } else { 1.0 }
}

/// First-order matrix of a group in the scaled state `[r q; q']`.
fn first_order(model: &ReducedModel, group: &[usize], rate: &[f64]) -> Mat<f64> {
    let m = group.len();
    Mat::from_fn(2 * m, 2 * m, |i, j| match (i < m, j < m) {
        (true, true) => 0.0,
        (true, false) => {
            if i == j - m {
                rate[i]
            } else {
                0.0
            }
        }
        (false, true) => {
            if i - m == j {
                -model.natural_frequencies[group[j]].powi(2) / rate[j]
            } else {
                0.0
            }
        }
        (false, false) => -model.damping[(group[i - m], group[j - m])],
    })
}

/// Stiffness and damping `(k, c)` of the eigenvalue pairs, ascending.
fn eigenvalue_pairs(system: &Mat<f64>) -> Result<Vec<(f64, f64)>, MergedModes> {
    let eigenvalues: Vec<c64> = system.eigenvalues().map_err(|_| MergedModes { condition: f64::INFINITY })?;
    let scale = eigenvalues.iter().map(|l| l.norm()).fold(0.0, f64::max);
    let mut pairs: Vec<(f64, f64)> =
        eigenvalues.iter().filter(|l| l.im > 0.0).map(|l| (l.norm_sqr(), -2.0 * l.re)).collect();
    let mut real: Vec<f64> = eigenvalues.iter().filter(|l| l.im == 0.0).map(|l| l.re).collect();
    real.iter_mut().filter(|l| l.abs() < 1e-15 * scale).for_each(|l| *l = 0.0);
    real.sort_by(f64::total_cmp);
    // Dampers and springs of a structure do not drive it: a stiffness below zero is the rounding of a rigid
    // one.
    pairs.extend(real.chunks_exact(2).map(|pair| ((pair[0] * pair[1]).max(0.0), -(pair[0] + pair[1]))));
    pairs.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
    Ok(pairs)
}

/// Columns `p` and `s` of a block; `copy` of `copies` equal pairs.
fn plane(
    system: &Mat<f64>,
    stiffness: f64,
    damping: f64,
    copy: usize,
    copies: usize,
) -> Result<(Vec<f64>, Vec<f64>), MergedModes> {
    let size = system.nrows();
    let identity = Mat::<f64>::identity(size, size);
    let shifted = system + &identity * faer::Scale(damping);
    let quadratic = system * &shifted + &identity * faer::Scale(stiffness);
    let svd = quadratic.svd().map_err(|_| MergedModes { condition: f64::INFINITY })?;
    // Equal pairs share a null space of 2 x copies vectors; each takes one vector of it and its image.
    let candidates: Vec<usize> = (size - 2 * copies..size).collect();
    let images = candidates.iter().map(|&j| {
        let s = svd.V().col(j).to_owned();
        let p = &shifted * &s;
        (p.iter().copied().collect::<Vec<f64>>(), s.iter().copied().collect::<Vec<f64>>())
    });
    let mut ranked: Vec<_> = images.map(|pair| (independence(&pair), pair)).collect();
    if copies == 1 {
        ranked.sort_by(|x, y| y.0.total_cmp(&x.0));
    }
    Ok(ranked.swap_remove(copy).1)
}

/// Sine of the angle between the two columns of a block.
fn independence((p, s): &(Vec<f64>, Vec<f64>)) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
    let cosine = dot(p, s) / (dot(p, p) * dot(s, s)).sqrt();
    (1.0 - cosine * cosine).max(0.0).sqrt()
}
