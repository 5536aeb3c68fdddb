//! What the path crate asks of the shooting equations.

use hammerbeam_motion::exact::NearMisses;
use hammerbeam_path::{
    Determinant, EvaluationError, Events, Outside, PathProblem, RootCorner, SingularJacobian, TestValue,
};

use super::ShootingProblem;
use crate::stability;

impl PathProblem for ShootingProblem {
    fn unknowns(&self) -> usize {
        self.residual.len()
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The first node stays, however the orbit is cut.
    fn memory_weights(&self) -> Vec<f64> {
        let weight = self.hertz_per_norm * self.hertz_per_norm;
        std::iter::repeat_n(weight, self.node_size()).chain([1.0]).collect()
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
        let size = self.node_size();
        let width = size + 1;
        self.border.clear();
        self.border.extend_from_slice(row);
        self.condensed.fill(0.0);
        let monodromy = &self.products[self.segments];
        for i in 0..size {
            let target = &mut self.condensed[i * width..(i + 1) * width];
            target[..size].copy_from_slice(&monodromy[i * size..(i + 1) * size]);
            target[i] -= 1.0;
            target[size] = self.parameter_sums[self.segments][i];
        }
        let target = &mut self.condensed[size * width..];
        target[size] = row[self.segments * size];
        for k in 0..self.segments {
            for i in 0..size {
                let border = row[k * size + i];
                let product = &self.products[k][i * size..(i + 1) * size];
                target.iter_mut().zip(product).for_each(|(t, a)| *t += border * a);
                target[size] += border * self.parameter_sums[k][i];
            }
        }
        self.lu.factorise(width, &self.condensed)
    }

    fn solve(&self, right_hand_side: &mut [f64]) {
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

    fn tests(&mut self, values: &mut Vec<TestValue>) {
        self.tests_without(&[], values);
    }

    fn tests_without(&mut self, left_out: &[u32], values: &mut Vec<TestValue>) {
        values.clear();
        if !self.watches_stability {
            return;
        }
        let without = |index: usize| left_out.get(index).copied().unwrap_or(0);
        if let Ok(spectrum) = self.spectrum() {
            values.push(stability::flip_without(spectrum, without(0)));
            values.push(stability::neimark_sacker_without(spectrum, without(1)));
        }
        // Never negative: between two grazings with the same contacts on both sides they come near zero.
        let NearMisses { clearances, squared_touch_speeds, penetrations } = self.integrator.near_misses();
        let near = [clearances, squared_touch_speeds, penetrations].concat();
        values.extend(near.into_iter().map(|value| TestValue::new(value, 0)));
    }

    /// The complex pairs of multipliers that are not on the unit circle, by the one in the upper half-plane.
    fn note(&mut self, numbers: &mut Vec<f64>) {
        numbers.clear();
        if self.watches_stability
            && let Ok(spectrum) = self.spectrum()
        {
            numbers.extend(stability::pairs_off_circle(spectrum).flatten());
        }
    }

    fn hides_zeros(&self, before: &[f64], behind: &[f64]) -> bool {
        stability::pairs_cross_both_ways(before.as_chunks().0, behind.as_chunks().0)
    }

    fn outside(&mut self, events: Events) -> Option<Outside> {
        if !self.watches_stability {
            return None;
        }
        self.spectrum().ok().map(|spectrum| stability::outside(spectrum, events))
    }

    /// Distance from the orbits of shorter period, by the nodes that lie whole excitation periods apart.
    ///
    /// With `z_j` the nodes and s nodes in k excitation periods it is the root mean square of `z_{j+s} -
    /// z_j`, the least one over the proper divisors k of N for which s is a whole number.
    fn distance_to_simpler(&self, point: &[f64]) -> f64 {
        let (periods, m) = (self.period_multiple as usize, self.segments);
        let states = &point[..self.residual.len()];
        let shift = |k: usize| {
            (periods.is_multiple_of(k) && (m * k).is_multiple_of(periods)).then_some(m * k / periods)
        };
        let distance = |nodes: usize| {
            let later = states.iter().cycle().skip(nodes * self.node_size());
            let squares: f64 = states.iter().zip(later).map(|(a, b)| (a - b) * (a - b)).sum();
            self.hertz_per_norm * (squares / m as f64).sqrt()
        };
        (1..periods).filter_map(shift).map(distance).fold(f64::INFINITY, f64::min)
    }

    /// The orbit as it begins some whole excitation periods later, if nodes lie so far apart.
    fn images(&self) -> usize {
        let periods = self.period_multiple as usize;
        if self.segments.is_multiple_of(periods) { periods } else { 1 }
    }

    fn image(&self, k: usize, vector: &[f64]) -> Vec<f64> {
        let (last, shift) = (self.residual.len(), k * self.segments / self.images() * self.node_size());
        let nodes = vector[shift..last].iter().chain(&vector[..shift]);
        nodes.chain(&vector[last..]).copied().collect()
    }

    /// Impacts on rigid stops have a speed that goes like the root of the depth.
    fn has_root_corners(&self) -> bool {
        self.system().has_rigid_stops()
    }

    fn root_corner(
        &mut self,
        point: &[f64],
        reach: f64,
        lies_ahead: &dyn Fn(&[f64]) -> bool,
    ) -> Option<RootCorner> {
        self.grazing_near(point, reach / self.hertz_per_norm, lies_ahead)
    }

    fn signature(&self) -> u64 {
        // FNV-1a over the numbers of touches; without any, elements may be closed or open throughout.
        let still = self.touches.iter().all(|&t| t == 0);
        let closed = if still { self.integrator.closed_throughout() } else { 0 };
        let words = self.touches.iter().map(|&t| u64::from(t)).chain([closed]);
        words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3))
    }
}
