//! The flows of the segments at a point: residuals, matrices, touches; and multipliers where the orbit is cut
//! at a touch.

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Stretch, System,
    exact::{MotionError, complete_touches, touches_lacking},
};
use hammerbeam_path::EvaluationError;

use super::ShootingProblem;
use crate::{NoEigenvalues, by_rows::multiply, spectrum::Spectrum};

/// Parts of a segment by which nodes are carried away from a touch, tried one after the other: no two of
/// these cuts are as far apart as instants of a symmetric motion are.
const ELSEWHERE: [f64; 4] = [0.382, 0.618, 0.146, 0.854];

/// Excitation frequency over the lowest eigenfrequency from which on rounding of states would leave less of
/// an orbit than its tolerance asks for.
const FAST: f64 = 1e3;
/// Most that rounding of states makes of a residual, in parts of the largest state.
const ROUNDING: f64 = 1e-12;

impl ShootingProblem {
    /// The flows of all segments from a point.
    pub(super) fn evaluate_flows(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.touches.fill(0);
        self.at_ends.iter_mut().for_each(Vec::clear);
        self.failure = None;
        self.spectrum = None;
        self.rounding = 0.0;
        let frequency = self.frequency(point);
        if frequency.is_nan() || frequency <= 0.0 {
            return Err(EvaluationError::OutsideDomain);
        }
        if let Err(error) = self.move_to(point) {
            self.failure = Some(error);
            return Err(EvaluationError::OutsideDomain);
        }
        // What is evaluated last is often observed next.
        self.integrator.begin_course();
        let mut flights = Vec::new();
        let evaluated =
            (0..self.segments).try_for_each(|segment| self.evaluate_segment((segment, &mut flights), point));
        self.integrator.end_course();
        if let Err(error) = evaluated {
            // What was noted is not the whole motion.
            self.integrator.begin_course();
            self.integrator.end_course();
            self.failure = Some(error);
            return Err(EvaluationError::NotFinite);
        }
        self.is_short_flight = flights.len() == self.segments && self.has_uncoupled_modes();
        for segment in flights {
            self.sharpen_flight(segment, point);
        }
        self.put_touches_right();
        complete_touches(&mut self.touches);
        Ok(())
    }

    /// Whether the excitation is so fast that a period leaves the slowest mode nearly as it was.
    fn is_fast(&self, frequency_hz: f64) -> bool {
        let frequencies = &self.integrator.system().model().natural_frequencies;
        // Rigid modes stand still in no steady motion.
        let slowest = frequencies.iter().copied().filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min);
        TAU * frequency_hz > FAST * slowest
    }

    /// Whether no damper couples modes, and no stop holds the structure.
    fn has_uncoupled_modes(&self) -> bool {
        let damping = &self.integrator.system().model().damping;
        let n = damping.nrows();
        self.integrator.closed_throughout() == 0
            && (0..n).all(|i| (0..n).all(|j| i == j || damping[(i, j)] == 0.0))
    }

    /// The residual of a segment without forces, by the deviation `d` from the steady motion: `G d_k -
    /// d_{k+1}`.
    ///
    /// It equals the difference of the states but for rounding of these, which the inverse of `G - 1` makes
    /// larger by the excitation frequency over the eigenfrequency. The deviation vanishes at the solution,
    /// and rounding of it with it.
    fn sharpen_flight(&mut self, segment: usize, point: &[f64]) {
        let size = self.node_size();
        let next = (segment + 1) % self.segments;
        let frequency_hz = self.frequency(point);
        let [here, there] = [segment, next].map(|node| {
            let steady = self.integrator.steady_state(&self.stretch(node, frequency_hz));
            let node = &point[node * size..(node + 1) * size];
            let scaled = steady.iter().zip(self.scale.values()).map(|(z, s)| z / s);
            node.iter().zip(scaled).map(|(x, z)| x - z).collect::<Vec<f64>>()
        });
        let matrix = &self.segment_matrices[segment];
        let sharper: Vec<f64> = (0..size)
            .map(|i| {
                let row = &matrix[i * size..(i + 1) * size];
                row.iter().zip(&here).map(|(g, d)| g * d).sum::<f64>() - there[i]
            })
            .collect();
        let residual = &mut self.residual[segment * size..(segment + 1) * size];
        let largest = point[..size * self.segments].iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
        // At a resonance without damping, or while a stop holds the structure, the motion is another one.
        let agrees = |(a, b): (&f64, &f64)| (a - b).abs() <= ROUNDING * largest;
        if residual.iter().zip(&sharper).all(agrees) {
            residual.copy_from_slice(&sharper);
        }
    }

    /// * `flights`: takes the segment if no force acts in it, and its residual is to be put right.
    fn evaluate_segment(
        &mut self,
        (segment, flights): (usize, &mut Vec<usize>),
        point: &[f64],
    ) -> Result<(), MotionError> {
        let size = self.node_size();
        let stretch = self.stretch(segment, self.frequency(point));
        let scales = self.scale.values();
        let node: Vec<f64> =
            point[segment * size..(segment + 1) * size].iter().zip(scales).map(|(x, s)| x * s).collect();
        let steps = self.integrator.counts().steps;
        let flow = self.integrator.flow(&stretch, &node)?;
        let in_flight = self.integrator.counts().steps == steps
            && self.integrator.touches().iter().all(|touches| *touches == 0);
        let by_last = self.varied.column_of(&flow);
        let next = (segment + 1) % self.segments;
        for i in 0..size {
            self.residual[segment * size + i] = flow.state[i] / scales[i] - point[next * size + i];
            self.by_parameter[segment][i] = by_last[i] / scales[i];
        }
        let matrix = &mut self.segment_matrices[segment];
        for j in 0..size {
            for i in 0..size {
                matrix[i * size + j] = flow.by_state[(i, j)] / scales[i] * scales[j];
            }
        }
        self.touches.iter_mut().zip(self.integrator.touches()).for_each(|(sum, touches)| *sum += touches);
        self.rounding = self.rounding.hypot(self.integrator.rounding());
        if in_flight && self.is_fast(stretch.frequency_hz) {
            flights.push(segment);
        }
        for (all, of_segment) in self.at_ends.iter_mut().zip(self.integrator.at_ends()) {
            all.extend_from_slice(of_segment);
        }
        Ok(())
    }

    /// `A_k` and `a_k`.
    pub(super) fn accumulate(&mut self) {
        let size = self.node_size();
        for k in 0..self.segments {
            let (before, after) = self.products.split_at_mut(k + 1);
            let (factor, source, target) = (&self.segment_matrices[k], &before[k], &mut after[0]);
            if k == 0 {
                target.copy_from_slice(factor);
            } else {
                multiply(size, factor, source, target);
            }
            let (before, after) = self.parameter_sums.split_at_mut(k + 1);
            for i in 0..size {
                let row = &factor[i * size..(i + 1) * size];
                let carried: f64 = row.iter().zip(&before[k]).map(|(g, a)| g * a).sum();
                after[0][i] = carried + self.by_parameter[k][i];
            }
        }
    }

    /// Multipliers of the orbit of a point with all its nodes carried on to where it is not cut at a touch at
    /// which a force sets in with a jump. The problem is then evaluated elsewhere, or not at all.
    pub(super) fn spectrum_cut_elsewhere(&mut self, point: &[f64]) -> Result<Spectrum, NoEigenvalues> {
        let phase = self.phase;
        for part in ELSEWHERE {
            let offset = part * f64::from(self.period_multiple) / self.segments as f64;
            let evaluated = self.carried_nodes(point, offset).and_then(|carried| {
                self.phase = phase + offset;
                let evaluated = self.evaluate_flows(&carried);
                self.phase = phase;
                evaluated
            });
            if evaluated.is_ok() && !self.jumps_at_cut {
                self.accumulate();
                return self.spectrum_of_products();
            }
        }
        Err(NoEigenvalues)
    }

    /// The point whose nodes lie this much later on the motion from the nodes of another one [cycles].
    fn carried_nodes(&mut self, point: &[f64], offset: f64) -> Result<Vec<f64>, EvaluationError> {
        let frequency_hz = self.frequency(point);
        let mut nodes = self.nodes(point);
        for (segment, node) in nodes.iter_mut().enumerate() {
            let start = self.stretch(segment, frequency_hz).start;
            let stretch = Stretch { frequency_hz, start, end: start + offset };
            *node = self.integrator.advance(&stretch, node).map_err(|error| {
                self.failure = Some(error);
                EvaluationError::NotFinite
            })?;
        }
        Ok(self.point(&nodes, point[point.len() - 1]))
    }

    /// Counts a touch at which the orbit is cut once, whichever side of it the states on both sides are by
    /// rounding.
    fn put_touches_right(&mut self) {
        self.touches_lacking.fill(0);
        self.jumps_at_cut = false;
        let contacts = self.touches.len();
        let [starts, ends] = &self.at_ends;
        for (place, end) in ends.iter().enumerate() {
            let start = starts[(place + contacts) % starts.len()];
            let lacking = touches_lacking(*end, start);
            if lacking != 0 {
                self.touches_lacking[place % contacts] += lacking;
                self.jumps_at_cut |= jumps(self.integrator.system(), place % contacts);
            }
        }
        let pairs = self.touches.iter_mut().zip(&self.touches_lacking);
        pairs.for_each(|(touches, lacking)| *touches = touches.saturating_add_signed(*lacking));
    }
}

/// Whether the force of a contact, in the order of elements and their contacts, sets in with a jump.
fn jumps(system: &System, contact: usize) -> bool {
    let laws = system.elements().iter().map(|element| &element.law);
    let mut of_contacts = laws.flat_map(|law| std::iter::repeat_n(law, law.contacts().len()));
    of_contacts.nth(contact).is_some_and(|law| law.onset_damping() > 0.0)
}
