//! The lowest modes of `K phi = lambda M phi` by block Lanczos on `(K - sigma M)^-1 M`.
//!
//! With a shift `sigma` below all eigenvalues the operator `A = (K - sigma M)^-1 M` is symmetric in the inner
//! product `x^T M y`, its eigenvalues are `theta = 1 / (lambda - sigma)`, largest for the lowest modes, and 0
//! for what has no mass. A basis `V`, `V^T M V = 1`, grows by the blocks `A V_last`, made orthogonal to all
//! of it twice. The eigenpairs of `V^T M A V` are the approximations; the norm of what `A` leaves outside of
//! `V` is their residual. Past a length the basis is replaced by its best approximations, and goes on.
//!
//! `M` is never factored: it may be singular, and then `x^T M x` is a norm only of what has mass. Starting
//! from `A r` keeps the vectors free of massless motion, up to rounding; a last `phi = A phi` takes that away
//! as well.
//!
//! The answers of `A` are off by the rounding of the solutions, relative to the largest `theta`, and so are
//! its eigenpairs: those of small `theta` most. So the modes found, `X`, end with one step of Rayleigh and
//! Ritz in the matrices themselves, `X^T (K - sigma M) X y = (lambda - sigma) X^T M X y`. What `phi^T K phi`
//! says of a mode `phi = X y` is then off by the square of what the modes were off, and by the rounding of
//! `K`. That is why [`RESIDUAL`] need not be near rounding, which solutions of stiff meshes do not reach.
//!
//! How many modes there are up to a cut-off is known before from the pivots of `K - sigma M` there, so the
//! search ends when it has all of them. A block that brings nothing new is replaced by a random one, which
//! finds modes of one frequency that the start did not hold.
//!
//! # Source
//! Grimes, Lewis, Simon, SIAM J. Matrix Anal. Appl. 15 (1994), 228-272, whose partial orthogonalisation is a
//! full one here; restarts as of Wu and Simon, SIAM J. Matrix Anal. Appl. 22 (2000), 602-616.

use faer::{Mat, MatRef, Side};

use super::{
    factor::Factors,
    krylov_size::{BLOCK, longest_basis},
    matrix::SymmetricMatrix,
    random::Random,
};

/// Residual of a mode relative to its `theta`: the error of `lambda` is of the order of its square.
const RESIDUAL: f64 = 1e-8;
/// A vector of which orthogonalisation leaves this part or less is spanned by the others.
const DEPENDENT: f64 = 1e-11;
/// Part of the cut-off that an eigenvalue beside it may be off by.
const BEYOND: f64 = 1e-6;
/// Blocks after which the search gives up, for each block that the modes wanted would fill.
const PATIENCE: usize = 40;

/// Eigenpairs, lowest first.
pub(super) struct LowestModes {
    /// `lambda` [1/s^2].
    pub values: Vec<f64>,
    /// `Phi`, one column a mode, `Phi^T M Phi = 1`.
    pub shapes: Mat<f64>,
}

/// The `count` lowest eigenpairs; `None` if they did not converge.
///
/// * `factors`: of `K - sigma M` with `sigma` below all eigenvalues.
/// * `highest`: what no `lambda` of them exceeds, by the count of pivots. A converged one beyond it says that
///   one below is missing, of a multiplicity that the blocks do not hold; a random block then finds it.
pub(super) fn lowest_modes(
    factors: &Factors<'_>,
    mass: &SymmetricMatrix,
    shift: f64,
    (count, highest): (usize, f64),
) -> Option<LowestModes> {
    if count == 0 {
        return Some(LowestModes { values: Vec::new(), shapes: Mat::zeros(mass.size(), 0) });
    }
    let mut basis = KrylovBasis::new(factors, mass);
    for _ in 0..PATIENCE * (1 + count.div_ceil(BLOCK)) {
        basis.grow();
        let ritz = basis.approximations()?;
        if ritz.converged(count) {
            if 1.0 / ritz.theta[count - 1] + shift <= highest * (1.0 + BEYOND) {
                return basis.modes(&ritz, shift, count);
            }
            basis.add_random_block();
        }
        if basis.length() > longest_basis(count) {
            basis.restart(&ritz, count + 4 * BLOCK);
        }
    }
    None
}

/// Approximations within a basis: `theta` descending, their vectors in the basis, their residuals.
struct Approximations {
    theta: Vec<f64>,
    vectors: Mat<f64>,
    residuals: Vec<f64>,
}

impl Approximations {
    fn converged(&self, count: usize) -> bool {
        self.theta.len() >= count
            && (0..count)
                .all(|which| self.theta[which] > 0.0 && self.residuals[which] <= RESIDUAL * self.theta[which])
    }
}

/// The basis and what the operator makes of it.
struct KrylovBasis<'a> {
    factors: &'a Factors<'a>,
    mass: &'a SymmetricMatrix,
    /// `V`: columns that the operator was applied to, then the next block.
    vectors: Vec<Vec<f64>>,
    /// Number of columns that the operator was applied to.
    applied: usize,
    /// `V^T M A v` of each column v applied, over all columns there were.
    projected: Vec<Vec<f64>>,
    random: Random,
}

impl<'a> KrylovBasis<'a> {
    fn new(factors: &'a Factors<'a>, mass: &'a SymmetricMatrix) -> Self {
        let mut basis = Self {
            factors,
            mass,
            vectors: Vec::new(),
            applied: 0,
            projected: Vec::new(),
            random: Random::new(1),
        };
        basis.add_random_block();
        basis
    }

    fn length(&self) -> usize {
        self.vectors.len()
    }

    /// `A X`.
    fn operator(&self, columns: MatRef<'_, f64>) -> Mat<f64> {
        let mut answer = self.mass.times_columns(columns);
        self.factors.solve_refined(answer.as_mut());
        answer
    }

    /// Applies the operator to the last block and adds what is new of the answer as the next one.
    fn grow(&mut self) {
        let size = self.mass.size();
        let block = Mat::from_fn(size, self.length() - self.applied, |row, column| {
            self.vectors[self.applied + column][row]
        });
        let answers = self.operator(block.as_ref());
        let before = self.length();
        for column in 0..answers.ncols() {
            let answer: Vec<f64> = answers.col(column).iter().copied().collect();
            let parts = self.add(answer);
            self.projected.push(parts);
        }
        self.applied = before;
        if self.length() == before {
            self.add_random_block();
        }
    }

    /// Adds what of a vector is outside of the basis.
    ///
    /// # Returns
    /// Its parts along the basis, the new vector included.
    fn add(&mut self, mut vector: Vec<f64>) -> Vec<f64> {
        let mut parts = vec![0.0; self.length()];
        let mut whole = 0.0;
        for pass in 0..2 {
            let heavy = self.mass.times(&vector);
            if pass == 0 {
                whole = dot(&vector, &heavy).max(0.0).sqrt();
            }
            for (part, own) in parts.iter_mut().zip(&self.vectors) {
                let along = dot(own, &heavy);
                *part += along;
                subtract(&mut vector, along, own);
            }
        }
        let left = norm(self.mass, &vector);
        if left > DEPENDENT * whole && left > 0.0 {
            vector.iter_mut().for_each(|entry| *entry /= left);
            self.vectors.push(vector);
            parts.push(left);
        }
        parts
    }

    fn add_random_block(&mut self) {
        let wanted = BLOCK.min(self.mass.size());
        let start = Mat::from_fn(self.mass.size(), wanted, |_, _| self.random.next());
        let answers = self.operator(start.as_ref());
        for column in 0..wanted {
            let answer: Vec<f64> = answers.col(column).iter().copied().collect();
            self.add(answer);
        }
    }

    /// `None` if the eigenvalues of the small matrix do not converge.
    fn approximations(&self) -> Option<Approximations> {
        let (size, all) = (self.applied, self.length());
        let part = |row: usize, column: usize| self.projected[column].get(row).copied().unwrap_or(0.0);
        let small = Mat::from_fn(size, size, |i, j| 0.5 * (part(i, j) + part(j, i)));
        let eigen = small.self_adjoint_eigen(Side::Lower).ok()?;
        let vectors = eigen.U().reverse_cols().to_owned();
        let theta = eigen.S().column_vector().iter().rev().copied().collect();
        let outside = Mat::from_fn(all - size, size, |i, j| part(size + i, j));
        let residuals = (&outside * &vectors).col_iter().map(|column| column.norm_l2()).collect();
        Some(Approximations { theta, vectors, residuals })
    }

    /// The first approximations as vectors.
    fn combined(&self, vectors: &Mat<f64>, count: usize) -> Mat<f64> {
        let mut combined = Mat::zeros(self.mass.size(), count);
        for which in 0..count {
            let mut sum = vec![0.0; self.mass.size()];
            for (column, own) in self.vectors.iter().take(vectors.nrows()).enumerate() {
                subtract(&mut sum, -vectors[(column, which)], own);
            }
            combined.col_mut(which).iter_mut().zip(sum).for_each(|(to, from)| *to = from);
        }
        combined
    }

    /// Replaces the basis by its best approximations and the last block.
    fn restart(&mut self, ritz: &Approximations, keep: usize) {
        let keep = keep.min(ritz.theta.len());
        let best = self.combined(&ritz.vectors, keep);
        let last = self.vectors.split_off(self.applied);
        let outside = |row: usize, which: usize| -> f64 {
            let part = |column: usize| self.projected[column].get(self.applied + row).copied().unwrap_or(0.0);
            (0..self.applied).map(|column| part(column) * ritz.vectors[(column, which)]).sum()
        };
        let projected = (0..keep).map(|which| {
            let mut parts = vec![0.0; keep + last.len()];
            parts[which] = ritz.theta[which];
            (0..last.len()).for_each(|row| parts[keep + row] = outside(row, which));
            parts
        });
        self.projected = projected.collect();
        self.vectors = best.col_iter().map(|column| column.iter().copied().collect()).collect();
        self.vectors.extend(last);
        self.applied = keep;
    }

    /// The first `count` approximations as modes, freed of massless motion, by the step of Rayleigh and Ritz;
    /// `None` if the vectors depend on one another.
    fn modes(&self, ritz: &Approximations, shift: f64, count: usize) -> Option<LowestModes> {
        let rough = self.combined(&ritz.vectors, count);
        let mut shapes = self.operator(rough.as_ref());
        for which in 0..count {
            let size = norm(self.mass, shapes.col_as_slice(which));
            shapes.col_as_slice_mut(which).iter_mut().for_each(|entry| *entry /= size);
        }
        let mut stiff = Mat::zeros(self.mass.size(), count);
        for which in 0..count {
            stiff.col_as_slice_mut(which).copy_from_slice(&self.factors.times(shapes.col_as_slice(which)));
        }
        let heavy = self.mass.times_columns(shapes.as_ref());
        let (stiff, heavy) = (shapes.transpose() * stiff, shapes.transpose() * heavy);
        let lower = heavy.llt(Side::Lower).ok()?.L().to_owned();
        // `L^-1 S L^-T`, whose eigenvectors u give `y = L^-T u`.
        let half = solved_lower(&lower, &stiff);
        let standard = solved_lower(&lower, &half.transpose().to_owned());
        let standard = Mat::from_fn(count, count, |i, j| 0.5 * (standard[(i, j)] + standard[(j, i)]));
        let eigen = standard.self_adjoint_eigen(Side::Lower).ok()?;
        let mut turned = eigen.U().to_owned();
        lower.transpose().solve_upper_triangular_in_place(turned.as_mut());
        let values = ritz.theta[..count].iter().map(|theta| 1.0 / theta + shift).collect();
        Some(LowestModes { values, shapes: shapes * turned })
    }
}

/// `L^-1 B`.
fn solved_lower(lower: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    let mut answer = right.clone();
    lower.solve_lower_triangular_in_place(answer.as_mut());
    answer
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(mass: &SymmetricMatrix, vector: &[f64]) -> f64 {
    dot(vector, &mass.times(vector)).max(0.0).sqrt()
}

fn subtract(from: &mut [f64], factor: f64, vector: &[f64]) {
    from.iter_mut().zip(vector).for_each(|(entry, own)| *entry -= factor * own);
}
