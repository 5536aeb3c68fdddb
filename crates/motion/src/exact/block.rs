//! The linear structure as independent second-order blocks, exact in time.
//! Equation (F2) of the book, `docs/theory`.
//!
//! With modal damping each mode is a block of its own. Dampers that couple modes are taken out by the
//! eigenvectors of the coupled first-order system, so that in every case the state `x = S^-1 z` of `z = [q;
//! q']` obeys
//!
//! `p_i' = s_i + beta_i`, `s_i' = -k_i p_i - c_i s_i + phi_i`, `x = [p; s]`,
//!
//! with inputs `[beta; phi] = S^-1 [0; b]` from a modal load `b`. A complex pair `-a +- i w` gives `k = a^2 +
//! w^2`, `c = 2 a`; two real eigenvalues `m_1, m_2` give `k = m_1 m_2`, `c = -(m_1 + m_2)`. So underdamped,
//! critically damped, overdamped and rigid modes are all the same block, and its propagator needs no
//! eigenvalues.

use faer::Mat;

use super::propagator::{Four, Propagator};

/// States at equal steps that follow from one another.
const IN_A_ROW: usize = 64;

/// The change of coordinates `z = S x` and back, where dampers couple the modes.
#[derive(Debug, Clone)]
pub(crate) struct Transform {
    /// `S`, 2n x 2n.
    pub from_blocks: Mat<f64>,
    /// `S^-1`, 2n x 2n.
    pub to_blocks: Mat<f64>,
}

/// The blocks of a structure.
#[derive(Debug, Clone)]
pub(crate) struct Blocks {
    /// `k_i` [1/s^2], length n.
    pub stiffness: Vec<f64>,
    /// `c_i` [1/s], length n. Neither is changed once the blocks are made.
    pub damping: Vec<f64>,
    /// `None` where the modes are the blocks.
    pub transform: Option<Transform>,
    /// All blocks, four by four; the last ones are filled up.
    fours: Vec<Four>,
}

impl Blocks {
    /// From the stiffness and the damping of each.
    pub fn of(pairs: Vec<(f64, f64)>, transform: Option<Transform>) -> Self {
        let (stiffness, damping): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        let firsts = (0..stiffness.len()).step_by(4);
        let fours = firsts.map(|i| Four::new(four(&stiffness[i..]), four(&damping[i..]))).collect();
        Self { stiffness, damping, transform, fours }
    }

    /// Number of blocks n; block states are `[p; s]`, length 2n.
    pub fn count(&self) -> usize {
        self.stiffness.len()
    }

    /// Calls `with` with the propagator of each block over `time`.
    #[inline(always)]
    pub fn for_propagators(&self, time: f64, mut with: impl FnMut(usize, Propagator)) {
        let n = self.count();
        for (place, four) in self.fours.iter().enumerate() {
            let quad = four.propagators(time);
            for (lane, i) in (4 * place..n.min(4 * place + 4)).enumerate() {
                let of_one = || Propagator::new(self.stiffness[i], self.damping[i], time);
                with(i, quad.as_ref().map_or_else(of_one, |quad| quad.propagator(lane)));
            }
        }
    }

    /// Block state after a free motion over `time` from `start`.
    pub fn fly(&self, start: &[f64], time: f64, end: &mut [f64]) {
        let n = self.count();
        self.for_propagators(time, |i, propagator| {
            (end[i], end[n + i]) = propagator.apply(start[i], start[n + i]);
        });
    }

    /// Takes a block state over a free motion of that duration.
    pub fn carry(&self, state: &mut [f64], time: f64) {
        let n = self.count();
        self.for_propagators(time, |i, propagator| {
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        });
    }

    /// Block states of a free motion, which was `start` at the time `since`, at later times.
    ///
    /// Where the times are equally far apart, as those of a picture are, a state follows from the one
    /// before by the propagators of one step, which are made once. Every [`IN_A_ROW`]th comes from the
    /// start, so that rounding does not grow.
    pub fn states_at(&self, (start, since): (&[f64], f64), times: &[f64]) -> Vec<Vec<f64>> {
        let mut states: Vec<Vec<f64>> = Vec::with_capacity(times.len());
        let mut propagators = Vec::new();
        for row in times.chunks(IN_A_ROW) {
            let step = equal_step(row);
            if let Some(step) = step {
                self.propagators(step, &mut propagators);
            }
            for (k, &time) in row.iter().enumerate() {
                let follows = k > 0 && step.is_some();
                let mut state = if follows { states[states.len() - 1].clone() } else { start.to_vec() };
                if follows {
                    self.apply(&propagators, &mut state);
                } else {
                    self.carry(&mut state, (time - since).max(0.0));
                }
                states.push(state);
            }
        }
        states
    }

    /// Takes a block state over the time of these propagators.
    pub fn apply(&self, propagators: &[Propagator], state: &mut [f64]) {
        let n = self.count();
        for (i, propagator) in propagators.iter().enumerate() {
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        }
    }

    /// The propagators over `time`.
    pub fn propagators(&self, time: f64, into: &mut Vec<Propagator>) {
        into.clear();
        self.for_propagators(time, |_, propagator| into.push(propagator));
    }

    /// Block state of a modal state `[q; q']`.
    pub fn of_modal(&self, modal: &[f64], block: &mut [f64]) {
        match &self.transform {
            None => block.copy_from_slice(modal),
            Some(transform) => multiply(&transform.to_blocks, modal, block),
        }
    }

    /// Modal state of a block state.
    pub fn to_modal(&self, block: Vec<f64>) -> Vec<f64> {
        let Some(transform) = &self.transform else { return block };
        let mut modal = vec![0.0; block.len()];
        multiply(&transform.from_blocks, &block, &mut modal);
        modal
    }

    /// Inputs `[beta; phi]` of a modal load `b`.
    pub fn input(&self, modal_load: &[f64]) -> Vec<f64> {
        let n = self.count();
        let mut modal = vec![0.0; 2 * n];
        modal[n..].copy_from_slice(modal_load);
        let mut block = vec![0.0; 2 * n];
        self.of_modal(&modal, &mut block);
        block
    }

    /// Row that reads `shape . q` from a block state.
    pub fn output(&self, shape: &[f64]) -> Vec<f64> {
        let n = self.count();
        let mut row = vec![0.0; 2 * n];
        match &self.transform {
            None => row[..n].copy_from_slice(shape),
            Some(transform) => {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry = (0..n).map(|i| shape[i] * transform.from_blocks[(i, j)]).sum();
                }
            }
        }
        row
    }

    /// `row A`: reads the derivative of what `row` reads, as far as the free motion goes.
    pub fn row_times_system(&self, row: &[f64]) -> Vec<f64> {
        let n = self.count();
        let mut product = vec![0.0; 2 * n];
        for i in 0..n {
            product[i] = -self.stiffness[i] * row[n + i];
            product[n + i] = row[i] - self.damping[i] * row[n + i];
        }
        product
    }

    /// `A column`.
    pub fn system_times_column(&self, column: &[f64]) -> Vec<f64> {
        let n = self.count();
        let mut product = vec![0.0; 2 * n];
        for i in 0..n {
            product[i] = column[n + i];
            product[n + i] = -self.stiffness[i] * column[i] - self.damping[i] * column[n + i];
        }
        product
    }

    /// Rate of each block, `sqrt(k) + c` [1/s]; it bounds the norm of the block in its energy norm.
    pub fn rates(&self) -> Vec<f64> {
        self.stiffness.iter().zip(&self.damping).map(|(k, c)| k.sqrt() + c.abs()).collect()
    }
}

/// The first four numbers; those that lack are as the first.
#[inline]
fn four(values: &[f64]) -> [f64; 4] {
    values.first_chunk().copied().unwrap_or_else(|| {
        let mut numbers = [values[0]; 4];
        numbers.iter_mut().zip(values).for_each(|(number, value)| *number = *value);
        numbers
    })
}

/// The step between times, where it is the same for all but for their own rounding.
fn equal_step(times: &[f64]) -> Option<f64> {
    let (first, last) = (*times.first()?, *times.last()?);
    let step = (last - first) / (times.len().max(2) - 1) as f64;
    let rounding = 4.0 * f64::EPSILON * first.abs().max(last.abs());
    let is_near = |(k, time): (usize, &f64)| (first + k as f64 * step - time).abs() <= rounding;
    (times.len() > 2 && times.iter().enumerate().all(is_near)).then_some(step)
}

fn multiply(matrix: &Mat<f64>, from: &[f64], to: &mut [f64]) {
    to.fill(0.0);
    for (j, &value) in from.iter().enumerate() {
        for (i, entry) in to.iter_mut().enumerate() {
            *entry += matrix[(i, j)] * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_at_equal_steps_are_those_from_the_start() {
        let blocks = Blocks::of(vec![(1.0, 0.02), (1e6, 30.0), (17.0, 40.0), (0.0, 0.0), (5e3, 0.0)], None);
        let start: Vec<f64> = (0..10).map(|i| f64::from(i + 1).sin()).collect();
        // Phases of a picture at 33.3 Hz, over a flight that begins early and one that begins late.
        let phases = |from: i32, to: i32| (from..to).map(|k| f64::from(k) / 384.0 / 33.3).collect::<Vec<_>>();
        let uneven: Vec<f64> = phases(0, 100).iter().map(|time| time * time).collect();
        assert!(equal_step(&uneven).is_none() && equal_step(&phases(3, 5)).is_none());
        for (times, since) in [(phases(1, 300), 0.0), (phases(301, 384), 0.0235), (uneven, 0.0)] {
            if since > 0.0 {
                assert!(equal_step(&times[..IN_A_ROW]).is_some());
            }
            let states = blocks.states_at((&start, since), &times);
            assert_eq!(states.len(), times.len());
            for (found, time) in states.iter().zip(&times) {
                let mut expected = start.clone();
                blocks.carry(&mut expected, time - since);
                // Velocities are as large as 1e3, and a time is known to 1e-16 of it.
                let error = found.iter().zip(&expected).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
                assert!(error < 3e-11, "{time}: {error}");
            }
        }
        assert!(blocks.states_at((&start, 0.0), &[]).is_empty());
    }

    #[test]
    fn propagators_of_many_blocks_are_those_of_each() {
        // Weakly damped ones; then among them critical, overdamped, undamped and rigid ones.
        let weak = (0..7).map(|i| (f64::from(1 + i * i), 0.3)).collect::<Vec<_>>();
        let mixed = [(1.0, 0.3), (1.0, 2.0), (5.0, 0.1), (10.0, 8.0), (17.0, 0.0), (0.0, 0.0), (0.0, 0.7)];
        for pairs in [weak, mixed.to_vec()] {
            let blocks = Blocks::of(pairs, None);
            // The fastest one turns by as much as is served in 263 040 s.
            for time in [0.0, 1e-6, 0.7, 30.0, 262_900.0, 263_200.0, 1e7] {
                let mut found = Vec::new();
                blocks.propagators(time, &mut found);
                let pairs = blocks.stiffness.iter().zip(&blocks.damping);
                let expected: Vec<_> = pairs.map(|(&k, &c)| Propagator::new(k, c, time)).collect();
                assert_eq!(found, expected, "{time}");
            }
        }
    }
}
