//! A structure that is held on rigid stops: the linear structure that is left while contacts stick.
//! Equation (F9) of the book, `docs/theory`.
//!
//! While the elements of a set S are held on their stops, `r_j = phi_j . q + s_j . u = level_j`, with the
//! displacements u of the supports, the structure obeys
//!
//! `q'' + C q' + diag(w^2) q = b(t) - Phi lambda`, `Phi = [phi_j]`, `lambda_j >= 0` the pressing forces.
//!
//! With `D = Phi^T Phi` and an orthonormal basis N of the complement of Phi it is `q = q_S(t) + N y`, `q_S =
//! Phi D^-1 (level - s . u)`, and y moves freely:
//!
//! `y'' + N^T C N y' + N^T diag(w^2) N y = N^T (b - C q_S' - diag(w^2) q_S)`,
//! `lambda = D^-1 (Phi^T (b - C q' - diag(w^2) q) + s . u'')`.
//!
//! Forces of other elements add `Phi_e F_e` to both right sides, `N^T phi_e F_e` and `D^-1 Phi^T phi_e F_e`
//! (`pressing.rs`).
//!
//! So it is a linear structure again, whose blocks may be coupled although those of the free structure were
//! not. N is turned so that `N^T diag(w^2) N` is diagonal (singular vectors of `diag(w) N`, which keep the
//! small eigenfrequencies to their digits), then the damping is decoupled as in `decouple.rs`.
//!
//! **One state for both.** The state keeps its length 2n: besides the n - s blocks of y it has s blocks
//! `(phi_j . q, phi_j . q')` without stiffness or damping, of which all is prescribed: `(level_j - s_j . u,
//! -s_j . u')` is their part of the particular solution, and their homogeneous part is zero. So `x = S^-1 [q;
//! q'] - particular` as everywhere, flight, certified search, force steps, sensitivities, traces and maxima
//! are those of the free structure with these blocks, and the pressing forces are outputs of their own, after
//! all others.

use faer::{Mat, c64};
use hammerbeam_structure::ReducedModel;

use super::{
    MergedModes,
    block::{Blocks, Transform},
    drive::Drive,
    output::Output,
    structure::Structure,
};
use crate::{Stretch, System};

/// A structure held on some of its rigid stops.
#[derive(Debug, Clone)]
pub(super) struct Held {
    /// Held elements, ascending.
    pub elements: Vec<usize>,
    pub structure: Structure,
    /// `Phi D^-1`, n x s.
    lift: Mat<f64>,
    /// `-D^-1 Phi^T phi_e` for every element e: impulses on the held stops per impulse on that element.
    pub reactions: Vec<Vec<f64>>,
}

/// Largest condition number, roughly, of shapes that are held at once.
const INDEPENDENT: f64 = 1e-10;

impl Held {
    /// The structure of `system` with `elements` held; its particular solution is made with each stretch.
    /// `None` if their shapes depend on one another.
    ///
    /// # Errors
    /// [`MergedModes`] where the damping that is left has no block form.
    pub fn new(
        system: &System,
        elements: &[usize],
        outputs: &[(Vec<f64>, Vec<f64>)],
        stretch: &Stretch,
    ) -> Result<Option<Self>, MergedModes> {
        let (n, s) = (system.dof(), elements.len());
        let shape = |j: usize| &system.elements()[elements[j]].shape;
        let Some(directions) = orthonormal(n, (0..s).map(|j| shape(j).clone()).collect()) else {
            return Ok(None);
        };
        // `Phi D^-1` from Phi = Q R: `Q R^-T`.
        let lift = lift_of(&directions, &(0..s).map(|j| shape(j).as_slice()).collect::<Vec<_>>());
        let (moving, frequencies) = moving_modes(system.model(), &directions, s)?;
        let blocks = blocks_of(system, (&moving, &frequencies), &lift, elements)?;
        let mut read: Vec<Output> =
            outputs.iter().map(|(shape, ratios)| Output::new(&blocks, shape, ratios)).collect();
        read.extend((0..s).map(|j| pressing_force(system, &blocks, &lift, j)));
        let inputs: Vec<Vec<f64>> =
            system.elements().iter().map(|e| held_input(&blocks, &e.shape, s)).collect();
        let reaction = |e: &crate::LocalElement| {
            (0..s).map(|j| -(0..n).map(|i| lift[(i, j)] * e.shape[i]).sum::<f64>()).collect()
        };
        let reactions = system.elements().iter().map(reaction).collect();
        let drive = Drive::new(system, &blocks, &[], stretch);
        let structure = Structure::new(blocks, read, inputs, drive);
        Ok(Some(Self { elements: elements.to_vec(), structure, lift, reactions }))
    }

    /// Makes the particular solution of a stretch.
    pub fn begin(&mut self, system: &System, stretch: &Stretch) {
        let level = |&e: &usize| system.elements()[e].law.contacts()[0].level;
        let levels: Vec<f64> = self.elements.iter().map(level).collect();
        self.structure.drive = self.driven(system, stretch, &levels, false);
    }

    /// Derivative of the particular solution by the level of the j-th held stop.
    pub fn by_level(&self, system: &System, stretch: &Stretch, j: usize) -> Drive {
        let levels: Vec<f64> = (0..self.elements.len()).map(|k| if k == j { 1.0 } else { 0.0 }).collect();
        self.driven(system, stretch, &levels, true)
    }

    /// What a force on an element adds to what the j-th held stop presses with at once: `((Phi D^-1)^T
    /// phi_e)_j`.
    pub fn direct(&self, j: usize, element: usize) -> f64 {
        -self.reactions[element][j]
    }

    fn driven(&self, system: &System, stretch: &Stretch, levels: &[f64], levels_alone: bool) -> Drive {
        let Structure { blocks, outputs, .. } = &self.structure;
        let (n, s, model) = (system.dof(), self.elements.len(), system.model());
        let mut drive = Drive::silent(system, stretch);
        let given = system.orders().iter().enumerate().map(|(index, &order)| (Some(index), order));
        let constant = (!system.orders().contains(&0)).then_some((None, 0));
        let zero = c64::new(0.0, 0.0);
        for (index, order) in given.chain(constant) {
            if levels_alone && order > 0 {
                continue;
            }
            let index = index.filter(|_| !levels_alone);
            let m = f64::from(order);
            let rate = c64::new(0.0, m * drive.circular_frequency());
            let circular = drive.circular_frequency();
            let supports = index.map_or_else(Vec::new, |index| system.support_amplitudes(index, circular));
            let prescribed: Vec<(c64, c64)> = (0..s)
                .map(|j| {
                    let level = if order == 0 { levels[j] } else { 0.0 };
                    let carried = carried(&supports, &system.elements()[self.elements[j]].support_ratios);
                    (c64::new(level, 0.0) - carried.0, -carried.1)
                })
                .collect();
            let mut load = index.map_or_else(
                || crate::ModalLoad { amplitude: vec![zero; n], by_frequency: vec![zero; n] },
                |index| system.modal_load(index, circular),
            );
            let forces = self.direct_forces(system, &load, (&supports, m, circular));
            let lifted = |of: fn(&(c64, c64)) -> c64| -> Vec<c64> {
                (0..n).map(|i| (0..s).map(|j| of(&prescribed[j]) * self.lift[(i, j)]).sum()).collect()
            };
            let (shape, by_circular) = (lifted(|value| value.0), lifted(|value| value.1));
            for i in 0..n {
                let damped = |shape: &[c64]| (0..n).map(|k| shape[k] * model.damping[(i, k)]).sum::<c64>();
                let stiffness = model.natural_frequencies[i].powi(2);
                load.amplitude[i] -= shape[i] * stiffness + rate * damped(&shape);
                load.by_frequency[i] -= c64::new(0.0, m) * damped(&shape)
                    + by_circular[i] * stiffness
                    + rate * damped(&by_circular);
            }
            drive.add_held(blocks, outputs, (m, &supports), (&load, &prescribed), &forces);
        }
        drive
    }

    /// `D^-1 (Phi^T b + s . u'')` of one order and its derivative by the circular frequency; what else the
    /// stops press with is read from the state.
    fn direct_forces(
        &self,
        system: &System,
        load: &crate::ModalLoad,
        (supports, m, frequency): (&[(c64, c64)], f64, f64),
    ) -> Vec<(c64, c64)> {
        let (n, s) = (self.lift.nrows(), self.elements.len());
        let gram = self.inverse_gram();
        let of = |j: usize, values: &[c64]| (0..n).map(|i| values[i] * self.lift[(i, j)]).sum::<c64>();
        let force = |j: usize| {
            let ratio = |k: usize, u: usize| system.elements()[self.elements[k]].support_ratios[u];
            let share = |u: usize| (0..s).map(|k| gram[j][k] * ratio(k, u)).sum::<f64>();
            let shares: Vec<f64> = (0..supports.len()).map(share).collect();
            let (carried, by_circular) = carried(supports, &shares);
            let square = (m * frequency).powi(2);
            (
                of(j, &load.amplitude) - carried * square,
                of(j, &load.by_frequency) - carried * (2.0 * m * m * frequency) - by_circular * square,
            )
        };
        (0..s).map(force).collect()
    }

    /// `D^-1`, which is `(Phi D^-1)^T (Phi D^-1)`.
    fn inverse_gram(&self) -> Vec<Vec<f64>> {
        let (n, s) = (self.lift.nrows(), self.lift.ncols());
        let entry = |j: usize, k: usize| (0..n).map(|i| self.lift[(i, j)] * self.lift[(i, k)]).sum();
        (0..s).map(|j| (0..s).map(|k| entry(j, k)).collect()).collect()
    }
}

/// What supports that move with these amplitudes add to a displacement, with the derivative.
fn carried(supports: &[(c64, c64)], ratios: &[f64]) -> (c64, c64) {
    let moved = || supports.iter().zip(ratios);
    (moved().map(|(u, ratio)| u.0 * ratio).sum(), moved().map(|(u, ratio)| u.1 * ratio).sum())
}

/// An orthonormal basis of all of space whose first vectors span the given ones; `None` if these depend on
/// one another.
fn orthonormal(n: usize, given: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let s = given.len();
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let orthogonalise = |vector: &mut [f64], basis: &[Vec<f64>]| {
        // Twice is enough.
        for _ in 0..2 {
            for other in basis {
                let part: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
                vector.iter_mut().zip(other).for_each(|(v, o)| *v -= part * o);
            }
        }
    };
    for mut vector in given {
        let before = length(&vector);
        orthogonalise(&mut vector, &basis);
        let left = length(&vector);
        if left.is_nan() || left <= INDEPENDENT * before {
            return None;
        }
        vector.iter_mut().for_each(|v| *v /= left);
        basis.push(vector);
    }
    let mut units: Vec<usize> = (0..n).collect();
    for _ in s..n {
        // The unit vector that is farthest from what is spanned.
        let left = |i: &usize| 1.0 - basis.iter().map(|b| b[*i] * b[*i]).sum::<f64>();
        let (place, _) = units.iter().enumerate().max_by(|a, b| left(a.1).total_cmp(&left(b.1)))?;
        let mut vector = vec![0.0; n];
        vector[units.remove(place)] = 1.0;
        orthogonalise(&mut vector, &basis);
        let left = length(&vector);
        vector.iter_mut().for_each(|v| *v /= left);
        basis.push(vector);
    }
    Some(basis)
}

/// `Phi D^-1`, n x s: the vectors in the span of Phi with `Phi^T L = 1`.
fn lift_of(directions: &[Vec<f64>], shapes: &[&[f64]]) -> Mat<f64> {
    use faer::linalg::solvers::DenseSolveCore;
    let (n, s) = (directions.len(), shapes.len());
    // `Phi^T Q` is square: its inverse gives `L = Q (Phi^T Q)^-1`.
    let along =
        Mat::from_fn(s, s, |j, k| shapes[j].iter().zip(&directions[k]).map(|(a, b)| a * b).sum::<f64>());
    let inverse = along.partial_piv_lu().inverse();
    Mat::from_fn(n, s, |i, j| (0..s).map(|k| directions[k][i] * inverse[(k, j)]).sum())
}

/// The modes of the held structure: N, n x (n - s), and its eigenfrequencies; the first s `directions` are
/// held.
fn moving_modes(
    model: &ReducedModel,
    directions: &[Vec<f64>],
    s: usize,
) -> Result<(Mat<f64>, Vec<f64>), MergedModes> {
    let (n, free) = (model.dof(), &directions[s..]);
    let complement = Mat::from_fn(n, free.len(), |i, k| free[k][i]);
    if free.is_empty() {
        return Ok((complement, Vec::new()));
    }
    let stretched = Mat::from_fn(n, free.len(), |i, k| model.natural_frequencies[i] * free[k][i]);
    let svd = stretched.thin_svd().map_err(|_| MergedModes { condition: f64::INFINITY })?;
    let frequencies = (0..free.len()).map(|k| svd.S().column_vector()[k]).collect();
    Ok((&complement * svd.V(), frequencies))
}

/// The blocks of y, then those of the held displacements.
fn blocks_of(
    system: &System,
    (moving, frequencies): (&Mat<f64>, &[f64]),
    lift: &Mat<f64>,
    held: &[usize],
) -> Result<Blocks, MergedModes> {
    let (n, m, s) = (system.dof(), frequencies.len(), held.len());
    let model = ReducedModel {
        natural_frequencies: frequencies.to_vec(),
        damping: moving.transpose() * &system.model().damping * moving,
        points: Vec::new(),
        supports: Vec::new(),
        uniform_acceleration: vec![0.0; m],
    };
    let inner = if m > 0 { Blocks::new(&model)? } else { Blocks::of(Vec::new(), None) };
    let identity = |size: usize| Mat::<f64>::identity(size, size);
    let Transform { from_blocks: from, to_blocks: to } = inner
        .transform
        .clone()
        .unwrap_or_else(|| Transform { from_blocks: identity(2 * m), to_blocks: identity(2 * m) });
    // Place of an entry of [p; s] among the 2 m of y: None where it is held.
    let place = |k: usize| {
        let (half, i) = (k / n, k % n);
        if i < m { Ok(half * m + i) } else { Err((half, i - m)) }
    };
    let from_blocks = Mat::from_fn(2 * n, 2 * n, |row, column| {
        let (half, i) = (row / n, row % n);
        match place(column) {
            Ok(column) => (0..m).map(|k| moving[(i, k)] * from[(half * m + k, column)]).sum(),
            Err((other, j)) if other == half => lift[(i, j)],
            Err(_) => 0.0,
        }
    });
    let to_blocks = Mat::from_fn(2 * n, 2 * n, |row, column| {
        let (half, i) = (column / n, column % n);
        match place(row) {
            Ok(row) => (0..m).map(|k| to[(row, half * m + k)] * moving[(i, k)]).sum(),
            Err((other, j)) if other == half => system.elements()[held[j]].shape[i],
            Err(_) => 0.0,
        }
    });
    let pairs = inner.stiffness.iter().copied().zip(inner.damping.iter().copied());
    let padded = pairs.chain(vec![(0.0, 0.0); s]).collect();
    Ok(Blocks::of(padded, Some(Transform { from_blocks, to_blocks })))
}

/// The output `-(Phi D^-1)^T_j (diag(w^2) q + C q')`.
fn pressing_force(system: &System, blocks: &Blocks, lift: &Mat<f64>, j: usize) -> Output {
    let (n, model) = (system.dof(), system.model());
    let mut modal = vec![0.0; 2 * n];
    for i in 0..n {
        modal[i] = -lift[(i, j)] * model.natural_frequencies[i].powi(2);
        modal[n + i] = -(0..n).map(|k| lift[(k, j)] * model.damping[(k, i)]).sum::<f64>();
    }
    let from = &blocks.transform.as_ref().expect("a held structure has coordinates of its own").from_blocks;
    let row = (0..2 * n).map(|column| (0..2 * n).map(|k| modal[k] * from[(k, column)]).sum()).collect();
    Output::of_row(blocks, row, &[])
}

/// Inputs of a force on an element: the stops take what would move the s held displacements.
fn held_input(blocks: &Blocks, shape: &[f64], s: usize) -> Vec<f64> {
    let n = blocks.count();
    let mut input = blocks.input(shape);
    for half in [n, 2 * n] {
        input[half - s..half].fill(0.0);
    }
    input
}
