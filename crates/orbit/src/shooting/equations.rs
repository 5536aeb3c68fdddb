//! What the path crate asks of the shooting equations.

use hammerbeam_motion::exact::NearMisses;
use hammerbeam_path::{Determinant, EvaluationError, Judge, PathProblem, SingularJacobian, TestValue};

use super::ShootingProblem;
use crate::stability;

/// Largest entry of the monodromy matrix up to which the equations are condensed to the first node. Behind it
/// what rounding leaves of corrections and tangents is more than the path allows.
const MOST_CONDENSED: f64 = 1e7;

/// The matrix of the equations and the border; what puts it together returns its width.
impl ShootingProblem {
    /// Condensed to the first node.
    fn put_condensed(&mut self, row: &[f64]) -> usize {
        let size = self.node_size();
        let width = size + 1;
        self.matrix.clear();
        self.matrix.resize(width * width, 0.0);
        let monodromy = &self.products[self.segments];
        for i in 0..size {
            let target = &mut self.matrix[i * width..(i + 1) * width];
            target[..size].copy_from_slice(&monodromy[i * size..(i + 1) * size]);
            target[i] -= 1.0;
            target[size] = self.parameter_sums[self.segments][i];
        }
        let target = &mut self.matrix[size * width..];
        target[size] = row[self.segments * size];
        for k in 0..self.segments {
            for i in 0..size {
                let border = row[k * size + i];
                let product = &self.products[k][i * size..(i + 1) * size];
                target.iter_mut().zip(product).for_each(|(t, a)| *t += border * a);
                target[size] += border * self.parameter_sums[k][i];
            }
        }
        width
    }

    /// All of them: `G_k d_k - d_{k+1} + g_k df`. The condensed ones have the same determinant.
    pub(super) fn put_whole(&mut self, row: &[f64]) -> usize {
        let (size, m) = (self.node_size(), self.segments);
        let width = m * size + 1;
        self.matrix.clear();
        self.matrix.resize(width * width, 0.0);
        for k in 0..m {
            let (here, next) = (k * size, (k + 1) % m * size);
            for i in 0..size {
                let target = &mut self.matrix[(here + i) * width..(here + i + 1) * width];
                let segment = &self.segment_matrices[k][i * size..(i + 1) * size];
                target[here..here + size].copy_from_slice(segment);
                target[next + i] = -1.0;
                target[m * size] = self.by_parameter[k][i];
            }
        }
        self.matrix[m * size * width..].copy_from_slice(row);
        width
    }

    fn solve_condensed(&self, right_hand_side: &mut [f64]) {
        let (size, m) = (self.node_size(), self.segments);
        // `s_k`, for k = 1..=m in place of the right-hand sides.
        for k in 1..m {
            let (before, after) = right_hand_side.split_at_mut(k * size);
            let (carried, target) = (&before[(k - 1) * size..], &mut after[..size]);
            let matrix = &self.segment_matrices[k];
            for (row, value) in matrix.chunks_exact(size).zip(target) {
                *value += row.iter().zip(carried).map(|(g, s)| g * s).sum::<f64>();
            }
        }
        let mut condensed = vec![0.0; size + 1];
        condensed[..size].copy_from_slice(&right_hand_side[(m - 1) * size..m * size]);
        let carried = (size..m * size).map(|i| self.border[i] * right_hand_side[i - size]).sum::<f64>();
        condensed[size] = right_hand_side[m * size] + carried;
        self.lu.solve(&mut condensed);
        let change = condensed[size];
        // `d_k = A_k d_0 + a_k df - s_k`, from the last node back since `s_k` stands where `d_{k-1}` goes.
        for k in (1..m).rev() {
            for i in 0..size {
                let row = &self.products[k][i * size..(i + 1) * size];
                let carried: f64 = row.iter().zip(&condensed).map(|(a, d)| a * d).sum();
                right_hand_side[k * size + i] =
                    carried + self.parameter_sums[k][i] * change - right_hand_side[(k - 1) * size + i];
            }
        }
        right_hand_side[..size].copy_from_slice(&condensed[..size]);
        right_hand_side[m * size] = change;
    }
}

impl PathProblem for ShootingProblem {
    fn unknowns(&self) -> usize {
        self.residual.len()
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.evaluate_flows(point)?;
        if self.jumps_at_cut {
            let spectrum = self.spectrum_cut_elsewhere(point);
            self.evaluate_flows(point)?;
            self.spectrum = Some(spectrum);
        }
        self.accumulate();
        Ok(())
    }

    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn factorise(&mut self, row: &[f64]) -> Result<Determinant, SingularJacobian> {
        self.border.clear();
        self.border.extend_from_slice(row);
        let is_small = |entry: &f64| entry.abs() <= MOST_CONDENSED;
        self.is_condensed = self.segments == 1 || self.monodromy().iter().all(is_small);
        let width = if self.is_condensed { self.put_condensed(row) } else { self.put_whole(row) };
        self.lu.factorise(width, &self.matrix)
    }

    fn solve(&self, right_hand_side: &mut [f64]) {
        if self.is_condensed { self.solve_condensed(right_hand_side) } else { self.lu.solve(right_hand_side) }
    }

    /// Flips, Neimark-Sacker points, and then how near contacts come to a change, as often for each of three
    /// kinds.
    fn tests(&mut self, left_out: &[u32], values: &mut Vec<TestValue>) {
        values.clear();
        if !self.watches_stability() {
            return;
        }
        let without = |index: usize| left_out.get(index).copied().unwrap_or(0);
        if let Ok(spectrum) = self.spectrum() {
            values.push(stability::flip_without(spectrum, without(0)));
            values.push(stability::neimark_sacker_without(spectrum, without(1)));
        }
        // Between two grazings with the same contacts on both sides they come near zero.
        let NearMisses { clearances, squared_touch_speeds, penetrations } = self.integrator.near_misses();
        let near = clearances.into_iter().chain(squared_touch_speeds).chain(penetrations);
        values.extend(near.map(TestValue::near_jump));
    }

    fn judge(&mut self) -> &mut dyn Judge {
        self
    }
}
