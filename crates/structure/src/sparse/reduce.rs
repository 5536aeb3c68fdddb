//! From matrices to the modal form.
//!
//! The coordinates are `x = [x_f; u]`, free ones and the displacements of supports that move. The absolute
//! motion is `x_f = sum_s Gamma_s u_s + Phi q` as for beams (see the crate's documentation), with `Gamma_s` a
//! trial shape and the static answer to the forces that it leaves.
//!
//! The basis `T = [Phi_k Psi]` has the kept modes and, for each interface load, what the deleted modes answer
//! to it, made orthonormal in `K`. In it `K` is `diag(w_k^2, 1)` and `M` is `diag(1, H)`, `H = Psi^T M Psi`.
//! Free supports are prescribed again by `c p = u`, as for beams. An interface row without mass may leave a
//! `Psi` without inertia: its eigenvalue of `H` is then raised, which puts a mode far above the cut-off and
//! keeps the static flexibility as it is.

use std::f64::consts::TAU;

use faer::{Mat, MatRef, Side};

use super::{
    Matrices, MatrixReport, SupportRows, SymmetricMatrix,
    assemble::{Assembled, unit},
    craig_bampton::FixedInterface,
    factor::{Factors, Pencil},
    map::CoordinateMap,
    pencil_modes::PencilModes,
    report,
    statics::{Statics, add, dot},
};
use crate::{
    Damping, FlexibilityError, ModeTables, OutlinePoint, PointOutput, Reduced, ReducedModel, Reduction,
    StructureError, SupportInput,
    error::positive,
    modes::Modes,
    tables::{FrequencyError, flexibility, relative_error},
};

/// A residual mode is dropped if this part of it or less is not spanned by those already taken.
const DEPENDENT: f64 = 1e-8;
/// A residual mode whose flexibility is this part or less of what the load meets in all is nothing.
const NOTHING: f64 = 1e-10;
/// A mode that is at rest at a point moves less than this part of its largest displacement there.
const AT_REST: f64 = 1e-6;
/// Frequency of a residual mode without inertia, over the highest frequency that is kept.
const FAR_ABOVE: f64 = 100.0;

/// Weighted coordinates.
type Weights = Vec<(usize, f64)>;

/// A structure whose supports are told apart, with its pencils.
struct Prepared {
    assembled: Assembled,
    /// Over the free coordinates.
    supported: Pencil,
    /// Weights of each point over all coordinates x.
    points: Vec<(String, Weights)>,
}

/// What a reduction leaves.
struct ReducedModes {
    /// `w` [rad/s].
    frequencies: Vec<f64>,
    /// Shapes over all coordinates x, one column a mode.
    shapes: Mat<f64>,
    /// Frequencies of the modes of the basis [Hz].
    kept_hz: Vec<f64>,
}

impl Matrices {
    /// Reduces the structure and brings it to mass-normalised modal coordinates relative to its supports.
    ///
    /// * `moving`: groups of names of supports; those of a group move alike, each in its direction.
    /// * `interface`: names of the points with local elements or forces.
    ///
    /// # Errors
    /// Names, rows or nodes that are not there, matrices that do not fit together, stiffness or mass that is
    /// not positive semi-definite, mechanisms, a cut-off below the first elastic mode, and what takes too
    /// much memory.
    pub fn reduce(
        &self,
        moving: &[&[&str]],
        reduction: &Reduction,
        damping: &Damping,
        interface: &[&str],
    ) -> Result<(Reduced, MatrixReport), StructureError> {
        if let Some(cut_off_hz) = reduction.cut_off_hz() {
            positive("cut-off frequency", cut_off_hz)?;
        }
        let prepared = self.prepared(moving)?;
        let cut_off_hz = reduction.cut_off_hz().unwrap_or(f64::INFINITY);
        let precision = prepared.assembled.joined.precision;
        let (full, factors) = prepared.modes(&prepared.supported, cut_off_hz, precision)?;
        let statics = Statics::new(&prepared.supported, &full, factors);
        let loads = prepared.interface(interface)?;
        let ReducedModes { frequencies, mut shapes, kept_hz } = match reduction {
            Reduction::Truncation { .. } => {
                ensure_elastic(&prepared.supported, &full, cut_off_hz)?;
                let shapes = over_all(&full.shapes, prepared.assembled.map.columns());
                ReducedModes { frequencies: full.frequencies.clone(), shapes, kept_hz: Vec::new() }
            }
            Reduction::FixedInterface { .. } => {
                prepared.fixed_interface(&full, &statics, &loads, (cut_off_hz, self.memory_limit_bytes))?
            }
            Reduction::FreeInterface { .. } | Reduction::None => {
                prepared.free_interface(&full, &statics, &loads, cut_off_hz)?
            }
        };
        prepared.orient(&mut shapes, &loads);
        let support_shapes = self.support_shapes(&prepared, moving, &statics)?;
        let model = self.modal_form(&prepared, frequencies, &shapes, &support_shapes, damping)?;
        let is_fixed = matches!(reduction, Reduction::FixedInterface { .. });
        let tables = ModeTables {
            clamped_hz: full.frequencies.iter().map(|w| w / TAU).collect(),
            free_interface_hz: if is_fixed { Vec::new() } else { kept_hz.clone() },
            fixed_interface_hz: if is_fixed { kept_hz } else { Vec::new() },
            reduced_hz: model.natural_frequencies.iter().map(|w| w / TAU).collect(),
            frequency_errors: frequency_errors(&full, &model, cut_off_hz),
            flexibility_errors: prepared.flexibility_errors(&statics, &model, &loads),
        };
        let outline = model.points.iter().enumerate().map(|(at, point)| OutlinePoint {
            at: at as f64,
            shape: point.shape.clone(),
            support_ratios: point.support_ratios.clone(),
        });
        let outline = outline.collect();
        let mut report = prepared.assembled.report.clone();
        report::complete(&mut report, self, &prepared.assembled, &prepared.supported, &full)?;
        Ok((Reduced { model, tables, outline }, report))
    }

    fn prepared(&self, moving: &[&[&str]]) -> Result<Prepared, StructureError> {
        let assembled = self.assembled(moving)?;
        let free: Vec<usize> = (0..assembled.free).collect();
        let selected = CoordinateMap::selecting(assembled.map.columns(), &free);
        let supported = Pencil::new(
            selected.congruence(&assembled.stiffness),
            selected.congruence(&assembled.mass),
            self.memory_limit_bytes,
        )?;
        let weights = |point: &super::MatrixPoint| {
            let weights = point.weights(&assembled.joined)?;
            Ok((point.name.clone(), assembled.map.pulled_back(&weights)))
        };
        let points: Result<Vec<(String, Weights)>, StructureError> =
            self.points.iter().map(weights).collect();
        Ok(Prepared { points: points?, supported, assembled })
    }

    /// `Gamma_s` over the free coordinates, and 1 at its support: a column each.
    fn support_shapes(
        &self,
        prepared: &Prepared,
        moving: &[&[&str]],
        statics: &Statics<'_>,
    ) -> Result<Mat<f64>, StructureError> {
        let (free, all) = (prepared.assembled.free, prepared.assembled.map.columns());
        let mut shapes = Mat::zeros(all, moving.len());
        for (number, names) in moving.iter().enumerate() {
            let supports = || self.supports.iter().filter(|support| names.contains(&support.name.as_str()));
            let base = supports().find(|support| support.rows == SupportRows::Base);
            let Some(support) = base.or_else(|| supports().next()) else { continue };
            let along = unit(&support.along, &format!("the direction of support \"{}\"", support.name))?;
            let translation = match (&support.rows, prepared.assembled.joined.translation(along)) {
                (SupportRows::Of(_), Err(_)) => vec![0.0; prepared.assembled.map.rows()],
                (_, translation) => translation?,
            };
            let mut shape = prepared.assembled.of_rows(&translation);
            if support.rows != SupportRows::Base {
                let share = 1.0 / moving.len() as f64;
                shape[..free].iter_mut().for_each(|entry| *entry *= share);
                shape[free..].fill(0.0);
                shape[free + number] = 1.0;
                let forces = prepared.assembled.stiffness.times(&shape);
                let relief = statics.elastic(&forces[..free]);
                add(&mut shape[..free], -1.0, &relief);
            } else {
                shape[free..].fill(0.0);
                shape[free + number] = 1.0;
            }
            shapes.col_mut(number).iter_mut().zip(shape).for_each(|(to, from)| *to = from);
        }
        Ok(shapes)
    }

    fn modal_form(
        &self,
        prepared: &Prepared,
        frequencies: Vec<f64>,
        shapes: &Mat<f64>,
        support_shapes: &Mat<f64>,
        damping: &Damping,
    ) -> Result<ReducedModel, StructureError> {
        let Prepared { assembled, points, .. } = prepared;
        let damped = assembled.damping.as_ref().map(|matrix| matrix.times_columns(shapes.as_ref()));
        let product = damped
            .as_ref()
            .map_or_else(|| Mat::zeros(shapes.ncols(), shapes.ncols()), |damped| shapes.transpose() * damped);
        let damping = damping.matrix_with(&frequencies, product.as_ref())?;
        let output = |(name, weights): &(String, Weights)| PointOutput {
            name: name.clone(),
            shape: weighted(weights, shapes),
            support_ratios: weighted(weights, support_shapes),
        };
        let input = |number: usize| {
            let shape = support_shapes.col_as_slice(number);
            let moves_rows =
                (0..assembled.free).any(|row| assembled.is_coupled(row, assembled.free + number));
            SupportInput {
                inertia: projected(shapes, &assembled.mass.times(shape)),
                // A structure that follows its base as a whole does not move against its dampers.
                damping: match &assembled.damping {
                    Some(matrix) if moves_rows => projected(shapes, &matrix.times(shape)),
                    _ => vec![0.0; shapes.ncols()],
                },
            }
        };
        let uniform = match self.acceleration {
            Some(along) => {
                let along = unit(&along, "the direction of the acceleration")?;
                let motion = assembled.of_rows(&assembled.joined.translation(along)?);
                projected(shapes, &assembled.mass.times(&motion))
            }
            None => vec![0.0; shapes.ncols()],
        };
        let model = ReducedModel {
            points: points.iter().map(output).collect(),
            supports: (0..support_shapes.ncols()).map(input).collect(),
            natural_frequencies: frequencies,
            damping,
            uniform_acceleration: uniform,
        };
        crate::reduce::check_finite(&model).map(|()| model)
    }
}

impl Assembled {
    /// The coordinates x of a motion of all rows: what each stands for by itself.
    pub(super) fn of_rows(&self, motion: &[f64]) -> Vec<f64> {
        let mut coordinates = vec![0.0; self.map.columns()];
        for (row, value) in motion.iter().enumerate() {
            let mut terms = self.map.row(row);
            if let (Some((column, weight)), None) = (terms.next(), terms.next())
                && weight == 1.0
            {
                coordinates[column] = *value;
            }
        }
        coordinates
    }

    /// Whether stiffness, mass or damping joins two coordinates.
    fn is_coupled(&self, row: usize, column: usize) -> bool {
        let joins = |matrix: &SymmetricMatrix| {
            matrix.column(row.min(column)).any(|(place, _)| place == row.max(column))
        };
        joins(&self.stiffness) || self.damping.as_ref().is_some_and(joins)
    }
}

impl Prepared {
    /// Modes of a pencil, mechanisms named by their rows.
    fn modes<'a>(
        &self,
        pencil: &'a Pencil,
        cut_off_hz: f64,
        precision: f64,
    ) -> Result<(PencilModes, Factors<'a>), StructureError> {
        pencil.modes_and_factors(cut_off_hz, precision).map_err(|error| self.assembled.named(error))
    }

    /// Names and weights of the interface points.
    fn interface(&self, names: &[&str]) -> Result<Vec<(String, Weights)>, StructureError> {
        let find = |name: &&str| {
            let known = self.points.iter().find(|(known, _)| known == name);
            known.cloned().ok_or_else(|| StructureError::UnknownPoint {
                what: "the interface".into(),
                name: (*name).into(),
                known: self.points.iter().map(|(known, _)| known.clone()).collect(),
            })
        };
        names.iter().map(find).collect()
    }

    /// By free-interface modes and residual flexibility.
    fn free_interface(
        &self,
        full: &PencilModes,
        statics: &Statics<'_>,
        loads: &[(String, Weights)],
        cut_off_hz: f64,
    ) -> Result<ReducedModes, StructureError> {
        let (free, all) = (self.assembled.free, self.assembled.map.columns());
        if free == all || !cut_off_hz.is_finite() {
            ensure_elastic(&self.supported, full, cut_off_hz)?;
            let basis = Basis::new(&self.supported, full, statics, loads, free);
            let (frequencies, shapes) = basis.modes(&[])?;
            let kept_hz = full.frequencies.iter().map(|w| w / TAU).collect();
            return Ok(ReducedModes { frequencies, shapes: over_all(&shapes, all), kept_hz });
        }
        let released = Pencil::new(self.assembled.stiffness.clone(), self.assembled.mass.clone(), u64::MAX)?;
        let (modes, factors) = self.modes(&released, cut_off_hz, self.assembled.joined.precision)?;
        ensure_elastic(&released, &modes, cut_off_hz)?;
        let statics = Statics::new(&released, &modes, factors);
        let supports = (free..all).map(|column| (String::new(), vec![(column, 1.0)]));
        let loads: Vec<(String, Weights)> = supports.chain(loads.iter().cloned()).collect();
        let basis = Basis::new(&released, &modes, &statics, &loads, all);
        let prescribed: Vec<usize> = (free..all).collect();
        let (frequencies, mut shapes) = basis.modes(&prescribed)?;
        for &row in &prescribed {
            shapes.row_mut(row).iter_mut().for_each(|entry| *entry = 0.0);
        }
        let kept_hz = modes.frequencies.iter().map(|w| w / TAU).collect();
        Ok(ReducedModes { frequencies, shapes, kept_hz })
    }

    /// The same by fixed-interface modes and constraint modes; cut-off frequency [Hz] and memory [bytes].
    fn fixed_interface(
        &self,
        full: &PencilModes,
        statics: &Statics<'_>,
        loads: &[(String, Weights)],
        (cut_off_hz, limit_bytes): (f64, u64),
    ) -> Result<ReducedModes, StructureError> {
        if full.rigid() > 0 {
            return Err(StructureError::NotHeld { rigid_modes: full.rigid() });
        }
        let free = self.assembled.free;
        let fixed = FixedInterface {
            pencil: &self.supported,
            statics,
            loads: loads.iter().map(|(_, weights)| dense(weights, free)).collect(),
            cut_off_hz,
            precision: self.assembled.joined.precision,
            limit_bytes,
        };
        let modes = fixed.modes()?;
        let shapes = over_all(&modes.shapes, self.assembled.map.columns());
        Ok(ReducedModes { frequencies: modes.frequencies, shapes, kept_hz: modes.kept_hz })
    }

    /// Turns each mode so that it is positive at the first interface point where it moves, else where it
    /// moves most.
    fn orient(&self, shapes: &mut Mat<f64>, loads: &[(String, Weights)]) {
        for mode in 0..shapes.ncols() {
            let shape = shapes.col_as_slice(mode);
            let largest = shape.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            let at =
                |weights: &Weights| weights.iter().map(|&(row, weight)| weight * shape[row]).sum::<f64>();
            let mut at_points = loads.iter().map(|(_, weights)| at(weights));
            let reference = at_points.find(|value| value.abs() > AT_REST * largest);
            let most = || shape.iter().copied().find(|entry| entry.abs() >= 0.999 * largest);
            if reference.or_else(most).is_some_and(|value| value < 0.0) {
                shapes.col_mut(mode).iter_mut().for_each(|entry| *entry = -*entry);
            }
        }
    }

    fn flexibility_errors(
        &self,
        statics: &Statics<'_>,
        model: &ReducedModel,
        loads: &[(String, Weights)],
    ) -> Vec<FlexibilityError> {
        let error = |(name, weights): &(String, Weights)| {
            let load = dense(weights, self.assembled.free);
            let full = dot(&load, &statics.elastic(&load));
            let reduced = model
                .point(name)
                .map_or(0.0, |point| flexibility(&model.natural_frequencies, point.shape.iter()));
            FlexibilityError { point: name.clone(), full, reduced, relative: relative_error(full, reduced) }
        };
        loads.iter().map(error).collect()
    }
}

/// Kept modes and residual modes, orthonormal in `K`.
struct Basis<'a> {
    frequencies: &'a [f64],
    shapes: &'a Mat<f64>,
    residual: Vec<Vec<f64>>,
    /// `H`.
    inertia: Mat<f64>,
}

impl<'a> Basis<'a> {
    fn new(
        pencil: &'a Pencil,
        modes: &'a PencilModes,
        statics: &Statics<'_>,
        loads: &[(String, Weights)],
        size: usize,
    ) -> Self {
        let mut residual: Vec<Vec<f64>> = Vec::new();
        let mut bent: Vec<Vec<f64>> = Vec::new();
        // Where all modes are kept and all coordinates have mass, nothing is left to answer.
        let is_whole = modes.frequencies.len() == pencil.size();
        for (_, weights) in loads.iter().filter(|_| !is_whole) {
            let load = dense(weights, size);
            let mut answer = statics.deleted(&load);
            let own = dot(&load, &answer);
            if own <= NOTHING * dot(&load, &statics.elastic(&load)).abs() {
                continue;
            }
            for _ in 0..2 {
                for (other, bent) in residual.iter().zip(&bent) {
                    let along = dot(bent, &answer);
                    add(&mut answer, -along, other);
                }
            }
            let forces = pencil.stiffness.times(&answer);
            let left = dot(&answer, &forces);
            if left > DEPENDENT * DEPENDENT * own {
                let length = left.sqrt();
                residual.push(answer.iter().map(|entry| entry / length).collect());
                bent.push(forces.iter().map(|entry| entry / length).collect());
            }
        }
        let heavy: Vec<Vec<f64>> = residual.iter().map(|shape| pencil.mass.times(shape)).collect();
        let inertia = Mat::from_fn(residual.len(), residual.len(), |i, j| {
            0.5 * (dot(&residual[i], &heavy[j]) + dot(&residual[j], &heavy[i]))
        });
        let highest = modes.frequencies.last().copied().unwrap_or(0.0);
        let inertia = raised(inertia, (FAR_ABOVE * highest).powi(-2));
        Self { frequencies: &modes.frequencies, shapes: &modes.shapes, residual, inertia }
    }

    /// Frequencies and shapes of the reduced structure, some rows prescribed to be zero.
    fn modes(&self, prescribed: &[usize]) -> Result<(Vec<f64>, Mat<f64>), StructureError> {
        let (kept, rows) = (self.frequencies.len(), self.shapes.nrows());
        let size = kept + self.residual.len();
        let basis = Mat::from_fn(rows, size, |row, column| match column.checked_sub(kept) {
            None => self.shapes[(row, column)],
            Some(which) => self.residual[which][row],
        });
        if prescribed.is_empty() && self.residual.is_empty() {
            return Ok((self.frequencies.to_vec(), basis));
        }
        let allowed = null_space(basis.as_ref(), prescribed);
        let strains = Mat::from_fn(size, allowed.ncols(), |row, column| {
            allowed[(row, column)] * self.frequencies.get(row).copied().unwrap_or(1.0)
        });
        let mut mass = Mat::<f64>::identity(size, size);
        mass.as_mut().submatrix_mut(kept, kept, size - kept, size - kept).copy_from(&self.inertia);
        let mass = allowed.transpose() * mass * &allowed;
        let modes = Modes::of(strains.as_ref(), mass.as_ref())?;
        Ok((modes.frequencies, basis * (allowed * modes.shapes)))
    }
}

/// Eigenvalues below `least` raised to it.
fn raised(matrix: Mat<f64>, least: f64) -> Mat<f64> {
    if matrix.nrows() == 0 || !least.is_finite() {
        return matrix;
    }
    let Ok(eigen) = matrix.self_adjoint_eigen(Side::Lower) else { return matrix };
    let values = eigen.S().column_vector();
    if values.iter().all(|value| *value >= least) {
        return matrix;
    }
    let scaled =
        Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| eigen.U()[(i, j)] * values[j].max(least));
    scaled * eigen.U().transpose()
}

/// Orthonormal columns `N` with `c N = 0`, `c` the prescribed rows of a basis.
fn null_space(basis: MatRef<'_, f64>, prescribed: &[usize]) -> Mat<f64> {
    let size = basis.ncols();
    let held = prescribed.len().min(size);
    if held == 0 {
        return Mat::identity(size, size);
    }
    let length = |row: usize| basis.row(row).norm_l2().max(f64::MIN_POSITIVE);
    let rows = Mat::from_fn(size, held, |i, j| basis[(prescribed[j], i)] / length(prescribed[j]));
    rows.qr().compute_Q().subcols(held, size - held).to_owned()
}

/// Refuses a cut-off that keeps rigid-body modes alone where there are others.
fn ensure_elastic(pencil: &Pencil, modes: &PencilModes, cut_off_hz: f64) -> Result<(), StructureError> {
    if modes.rigid() < modes.frequencies.len() || !cut_off_hz.is_finite() {
        return Ok(());
    }
    match pencil.first_beyond(modes)? {
        Some(first_hz) => Err(StructureError::CutOffBelowFirstMode { cut_off_hz, first_hz }),
        None => Ok(()),
    }
}

fn frequency_errors(full: &PencilModes, model: &ReducedModel, cut_off_hz: f64) -> Vec<FrequencyError> {
    let compare = |(&full, &reduced): (&f64, &f64)| FrequencyError {
        full_hz: full / TAU,
        reduced_hz: reduced / TAU,
        relative: relative_error(full, reduced),
        below_cut_off: full / TAU <= cut_off_hz,
    };
    full.frequencies.iter().zip(&model.natural_frequencies).map(compare).collect()
}

/// Rows of zeros below, up to `rows` in all.
fn over_all(shapes: &Mat<f64>, rows: usize) -> Mat<f64> {
    Mat::from_fn(rows, shapes.ncols(), |i, j| if i < shapes.nrows() { shapes[(i, j)] } else { 0.0 })
}

fn dense(weights: &Weights, size: usize) -> Vec<f64> {
    let mut vector = vec![0.0; size];
    weights.iter().filter(|(row, _)| *row < size).for_each(|&(row, weight)| vector[row] += weight);
    vector
}

fn weighted(weights: &Weights, columns: &Mat<f64>) -> Vec<f64> {
    columns.col_iter().map(|column| weights.iter().map(|&(row, weight)| weight * column[row]).sum()).collect()
}

/// `Phi^T v`.
fn projected(shapes: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    (0..shapes.ncols()).map(|column| dot(shapes.col_as_slice(column), vector)).collect()
}
