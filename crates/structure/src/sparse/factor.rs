//! The factors of `K - sigma M`, and how many of their pivots are negative.
//!
//! `P (K - sigma M) P^T = L D L^T` without exchanges: stable where the matrix is definite, and where it is
//! not, checked by solving twice (see [`Pencil::factors`]). By Sylvester's law the negative entries of `D`
//! count the eigenvalues of `K phi = lambda M phi` below `sigma`, if `M` is positive semi-definite and `K` is
//! positive definite on what has no mass.

use faer::{
    Conj, Mat, MatMut, Par, Side,
    dyn_stack::{MemBuffer, MemStack},
    linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization},
    prelude::{Reborrow, ReborrowMut},
    sparse::{
        SparseColMatRef, SymbolicSparseColMatRef,
        linalg::cholesky::{
            CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
            factorize_symbolic_cholesky, supernodal::SupernodalLdltRef,
        },
    },
};

use super::{
    SymmetricMatrix,
    memory::{MemoryBudget, MemoryNeed, of_matrices, of_vectors},
    random::Random,
};
use crate::StructureError;

/// Largest correction of a solution, relative to it, of factors that are trusted.
const RELIABLE: f64 = 1e-3;

/// The matrices `K` and `M` on one pattern, with the order of elimination for it.
#[derive(Debug)]
pub(crate) struct Pencil {
    /// `K`.
    pub stiffness: SymmetricMatrix,
    /// `M`.
    pub mass: SymmetricMatrix,
    starts: Vec<u32>,
    rows: Vec<u32>,
    symbolic: SymbolicCholesky<u32>,
    budget: MemoryBudget,
}

/// Factors of `K - sigma M`.
#[derive(Debug)]
pub(crate) struct Factors<'a> {
    pencil: &'a Pencil,
    shift: f64,
    values: Vec<f64>,
}

impl Pencil {
    /// Finds the order of elimination.
    ///
    /// # Errors
    /// Matrices and factors would take more memory than there may be.
    pub fn new(
        stiffness: SymmetricMatrix,
        mass: SymmetricMatrix,
        budget: MemoryBudget,
    ) -> Result<Self, StructureError> {
        let (starts, rows) = joint_pattern(&stiffness, &mass);
        let size = stiffness.size();
        let pattern = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows);
        let symbolic = factorize_symbolic_cholesky(
            pattern,
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| StructureError::TooManyEntries { size })?;
        let pencil = Self { stiffness, mass, starts, rows, symbolic, budget };
        pencil.ensure_memory(0)?;
        Ok(pencil)
    }

    /// The memory for so many modes.
    pub fn memory(&self, modes: usize) -> MemoryNeed {
        let work = self.symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let of_rows = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => symbolic.row_idx().len(),
            SymbolicCholeskyRaw::Supernodal(symbolic) => symbolic.row_idx().len(),
        };
        MemoryNeed {
            matrices: of_matrices(&self.stiffness, &self.mass, self.rows.len()),
            factors: (8 * self.symbolic.len_val() + 4 * of_rows) as u64,
            held_factors: self.budget.held_factors,
            work: work.unaligned_bytes_required() as u64,
            vectors: if modes == 0 { 0 } else { of_vectors(self.size(), modes) },
        }
    }

    /// What is left for another form of the structure while the factors of this one stay.
    pub fn beside(&self) -> MemoryBudget {
        let MemoryNeed { factors, held_factors, .. } = self.memory(0);
        MemoryBudget { held_factors: factors + held_factors, ..self.budget }
    }

    /// # Errors
    /// So many modes would take more memory than there may be.
    pub fn ensure_memory(&self, modes: usize) -> Result<(), StructureError> {
        let (need, limit_bytes) = (self.memory(modes), self.budget.limit_bytes);
        if need.total() > limit_bytes {
            return Err(StructureError::TooMuchMemory { size: self.size(), need, limit_bytes });
        }
        Ok(())
    }

    /// Number of coordinates.
    pub fn size(&self) -> usize {
        self.stiffness.size()
    }

    /// Entries of `K - sigma M` on the joint pattern.
    fn shifted(&self, shift: f64) -> Vec<f64> {
        let mut values = vec![0.0; self.rows.len()];
        for column in 0..self.size() {
            let range = self.starts[column] as usize..self.starts[column + 1] as usize;
            let (rows, own) = (&self.rows[range.clone()], &mut values[range]);
            for (matrix, factor) in [(&self.stiffness, 1.0), (&self.mass, -shift)] {
                let mut place = 0;
                for (row, value) in matrix.column(column) {
                    while rows[place] as usize != row {
                        place += 1;
                    }
                    own[place] += factor * value;
                }
            }
        }
        values
    }

    /// The factors of `K - sigma M`.
    ///
    /// # Errors
    /// The coordinate of which elimination leaves nothing: the matrix is singular, or the shift is an
    /// eigenvalue.
    pub fn factors(&self, shift: f64) -> Result<Factors<'_>, usize> {
        let shifted = self.shifted(shift);
        let size = self.size();
        let pattern = SymbolicSparseColMatRef::new_checked(size, size, &self.starts, None, &self.rows);
        let mut values = vec![0.0; self.symbolic.len_val()];
        let scratch = self.symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let mut memory = MemBuffer::new(scratch);
        let regularization = LdltRegularization {
            dynamic_regularization_signs: None,
            dynamic_regularization_delta: 0.0,
            dynamic_regularization_epsilon: 0.0,
        };
        let factored = self.symbolic.factorize_numeric_ldlt(
            &mut values,
            SparseColMatRef::new(pattern, &shifted),
            Side::Lower,
            regularization,
            Par::Seq,
            MemStack::new(&mut memory),
            faer::Spec::default(),
        );
        if let Err(LdltError::ZeroPivot { index }) = factored {
            // The simplicial factors count steps from 1.
            let simplicial = matches!(self.symbolic.raw(), SymbolicCholeskyRaw::Simplicial(_));
            return Err(self.coordinate(index - usize::from(simplicial)));
        }
        let factors = Factors { pencil: self, shift, values };
        match factors.is_reliable() {
            true => Ok(factors),
            false => Err(factors.weakest()),
        }
    }

    /// The coordinate that is eliminated at a step.
    fn coordinate(&self, step: usize) -> usize {
        self.symbolic.perm().map_or(step, |perm| perm.arrays().0[step] as usize)
    }
}

impl Factors<'_> {
    /// Number of eigenvalues below the shift: that of negative pivots.
    pub fn negative(&self) -> usize {
        let mut count = 0;
        self.each_pivot(|_, pivot| count += usize::from(pivot < 0.0));
        count
    }

    /// Solves `(K - sigma M) X = R`, `R` replaced by `X`.
    pub fn solve(&self, mut right: MatMut<'_, f64>) {
        let symbolic = &self.pencil.symbolic;
        let mut memory = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(right.ncols(), Par::Seq));
        LdltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            right.rb_mut(),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }

    /// The same with one step of refinement: low modes of fine meshes need it.
    pub fn solve_refined(&self, mut right: MatMut<'_, f64>) {
        let given = right.rb().to_owned();
        self.solve(right.rb_mut());
        let mut correction = given;
        for column in 0..right.ncols() {
            let solution: Vec<f64> = right.rb().col(column).iter().copied().collect();
            let product = self.times(&solution);
            correction.col_as_slice_mut(column).iter_mut().zip(product).for_each(|(to, from)| *to -= from);
        }
        self.solve(correction.as_mut());
        for column in 0..right.ncols() {
            let addition = correction.col_as_slice(column);
            right.rb_mut().col_mut(column).iter_mut().zip(addition).for_each(|(to, from)| *to += from);
        }
    }

    /// `K - sigma M` times a vector.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let (stiff, heavy) = (self.pencil.stiffness.times(vector), self.pencil.mass.times(vector));
        stiff.iter().zip(&heavy).map(|(stiff, heavy)| stiff - self.shift * heavy).collect()
    }

    /// Whether the factors are those of this matrix: a solution must be hardly changed by correcting it.
    ///
    /// With `L D L^T = A + E` the correction is `A^-1 E x`, and while `|A^-1 E| < 1` the pivots of `A + E`
    /// have the signs of those of `A`.
    fn is_reliable(&self) -> bool {
        let mut random = Random::new(1);
        let mut solution = Mat::from_fn(self.pencil.size(), 1, |_, _| random.next());
        let right: Vec<f64> = solution.col(0).iter().copied().collect();
        self.solve(solution.as_mut());
        let product = self.times(solution.col_as_slice(0));
        let mut correction = Mat::from_fn(right.len(), 1, |row, _| right[row] - product[row]);
        self.solve(correction.as_mut());
        correction.norm_l2() <= RELIABLE * solution.norm_l2()
    }

    /// The coordinate of which elimination leaves the least.
    fn weakest(&self) -> usize {
        let diagonal = self.pencil.stiffness.diagonal();
        let mass = self.pencil.mass.diagonal();
        let (mut least, mut weakest) = (f64::INFINITY, 0);
        self.each_pivot(|step, pivot| {
            let coordinate = self.pencil.coordinate(step);
            let size = (diagonal[coordinate] - self.shift * mass[coordinate]).abs();
            let part = if size > 0.0 { pivot.abs() / size } else { 0.0 };
            if part < least {
                (least, weakest) = (part, coordinate);
            }
        });
        weakest
    }

    /// All pivots in the order of elimination.
    fn each_pivot(&self, mut visit: impl FnMut(usize, f64)) {
        match self.pencil.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                for step in 0..symbolic.ncols() {
                    visit(step, self.values[symbolic.col_ptr()[step] as usize]);
                }
            }
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                let factors = SupernodalLdltRef::new(symbolic, &self.values);
                for node in 0..symbolic.n_supernodes() {
                    let node = factors.supernode(node);
                    let block = node.val();
                    for pivot in 0..block.ncols() {
                        visit(node.start() + pivot, block[(pivot, pivot)]);
                    }
                }
            }
        }
    }
}

/// Columns and rows of the entries that either matrix has, the diagonal included.
fn joint_pattern(stiffness: &SymmetricMatrix, mass: &SymmetricMatrix) -> (Vec<u32>, Vec<u32>) {
    let size = stiffness.size();
    let (mut starts, mut rows) = (vec![0_u32], Vec::with_capacity(stiffness.stored() + size));
    let mut column_rows: Vec<u32> = Vec::new();
    for column in 0..size {
        column_rows.clear();
        column_rows.push(column as u32);
        column_rows.extend(stiffness.column(column).map(|(row, _)| row as u32));
        column_rows.extend(mass.column(column).map(|(row, _)| row as u32));
        column_rows.sort_unstable();
        column_rows.dedup();
        rows.extend_from_slice(&column_rows);
        starts.push(rows.len() as u32);
    }
    (starts, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::Entry;

    /// A chain of masses on springs: eigenvalues `2 - 2 cos(k pi / (n + 1))`.
    fn chain(size: usize, wide: usize) -> Pencil {
        let mut entries = Vec::new();
        for row in 0..size {
            entries.push(Entry { row: row as u32, column: row as u32, value: 2.0 });
            if row > 0 {
                entries.push(Entry { row: row as u32, column: row as u32 - 1, value: -1.0 });
            }
            // Zeros would be left out; a tiny coupling fills the factors.
            for column in row.saturating_sub(wide)..row.saturating_sub(1) {
                entries.push(Entry { row: row as u32, column: column as u32, value: 1e-14 });
            }
        }
        let unit = (0..size as u32).map(|row| Entry { row, column: row, value: 1.0 });
        let stiffness = SymmetricMatrix::from_entries(size, &entries);
        let mass = SymmetricMatrix::from_entries(size, &unit.collect::<Vec<_>>());
        Pencil::new(stiffness, mass, MemoryBudget::of(1 << 30)).unwrap()
    }

    #[test]
    fn negative_pivots_count_the_eigenvalues_below_the_shift() {
        for (size, wide) in [(50, 1), (300, 120)] {
            let pencil = chain(size, wide);
            let eigenvalue =
                |k: usize| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (size as f64 + 1.0)).cos();
            for below in [0, 1, 7, size / 2, size] {
                // Not halfway, where by symmetry a pivot vanishes.
                let shift = 0.6 * eigenvalue(below) + 0.4 * eigenvalue(below + 1);
                assert_eq!(pencil.factors(shift).unwrap().negative(), below, "{size} {below}");
            }
            let simplicial = matches!(pencil.symbolic.raw(), SymbolicCholeskyRaw::Simplicial(_));
            assert_eq!(simplicial, wide == 1);
        }
    }

    #[test]
    fn a_solution_solves_and_a_singular_matrix_is_refused_where_it_is() {
        let pencil = chain(40, 1);
        let factors = pencil.factors(-0.1).unwrap();
        let mut solution = Mat::from_fn(40, 2, |i, j| (i + j) as f64);
        factors.solve(solution.as_mut());
        let back = factors.times(solution.col_as_slice(1));
        assert!(back.iter().enumerate().all(|(i, value)| (value - (i + 1) as f64).abs() < 1e-10));
        let spring = [(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0), (2, 2, 5.0)];
        let spring: Vec<Entry> =
            spring.iter().map(|&(row, column, value)| Entry { row, column, value }).collect();
        let heavy = [Entry { row: 2, column: 2, value: 1.0 }];
        let pencil = Pencil::new(
            SymmetricMatrix::from_entries(3, &spring),
            SymmetricMatrix::from_entries(3, &heavy),
            MemoryBudget::of(1 << 30),
        )
        .unwrap();
        assert!(pencil.factors(-1.0).unwrap_err() < 2);
    }

    #[test]
    fn factors_that_do_not_fit_are_refused_with_what_they_need() {
        let stiffness = chain(300, 120).stiffness;
        let budget = MemoryBudget::of(1000);
        let error = Pencil::new(stiffness.clone(), stiffness, budget).unwrap_err();
        assert!(error.to_string().contains("of 300 coordinates take"), "{error}");
        assert!(error.to_string().ends_with("allowed are 0.0000 GB"), "{error}");
    }

    /// A chain is eliminated without filling in: two entries a column. Of its modes the vectors are most.
    #[test]
    fn parts_of_the_memory_are_counted() {
        let size = 1000;
        let pencil = chain(size, 1);
        let (below, diagonal, starts) = (size - 1, size, size + 1);
        let need = pencil.memory(0);
        let stiffness = 12 * (below + diagonal) + 8 * starts;
        let mass = 12 * diagonal + 8 * starts;
        let pattern = (4 + 8) * (below + diagonal) + 4 * starts;
        assert_eq!(need.matrices, (4 * (stiffness + mass) + pattern) as u64);
        assert_eq!(need.factors, ((8 + 4) * (below + diagonal)) as u64);
        assert_eq!((need.held_factors, need.vectors), (0, 0));
        assert_eq!(need.total(), need.matrices + need.factors + need.work);
        let of_modes = pencil.memory(10);
        // 10 modes: 8 * 10 + 50 * 6 in the basis, two blocks more, and 4 * 10.
        assert_eq!(of_modes.vectors, 8 * 1000 * (380 + 12 + 40));
        assert_eq!(of_modes.total(), need.matrices + need.factors + of_modes.vectors);
        // Another pencil finds the factors of this one there.
        let unit = (0..3).map(|row| Entry { row, column: row, value: 1.0 }).collect::<Vec<_>>();
        let unit = SymmetricMatrix::from_entries(3, &unit);
        let beside = Pencil::new(unit.clone(), unit, pencil.beside()).unwrap();
        assert_eq!(beside.memory(0).held_factors, need.factors);
    }

    #[test]
    fn vectors_that_do_not_fit_are_refused_once_the_number_of_modes_is_known() {
        let Pencil { stiffness, mass, .. } = chain(1000, 1);
        let pencil = Pencil::new(stiffness, mass, MemoryBudget::of(3_000_000)).unwrap();
        let error = pencil.modes(0.3 / std::f64::consts::TAU, 1e-16).unwrap_err();
        assert!(matches!(error, StructureError::TooMuchMemory { .. }), "{error}");
    }
}
