//! The shooting equations with two parameters and a phase.
//!
//! `R_k = Z_k(z_k, f, x, p) - z_{k+1}`, where segment k runs from the phase `x + k N/m` to `x + (k + 1) N/m`.
//! By the phase at which it is cut a segment has the derivative `(F(end) - G_k F(start))/f`, with the rate
//! `F` of the state.

use hammerbeam_motion::{
    Parameter, Stretch,
    exact::{ExactIntegrator, MotionError, complete_touches},
};

use super::{closing::Closing, passing::Passing};
use crate::{
    NoEigenvalues,
    by_rows::{dot, left_times, multiply, times},
    known_matrix::{Accuracy, KnownMatrix},
    spectrum::Spectrum,
    state_scale::StateScale,
};

/// Where the equations are evaluated; nodes are scaled, one after the other.
#[derive(Debug, Clone)]
pub(super) struct CurveOrbit {
    pub nodes: Vec<f64>,
    pub frequency_hz: f64,
    pub phase: f64,
    pub value: f64,
}

/// Flow of one segment in scaled states, matrices by rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Segment {
    pub end: Vec<f64>,
    pub matrix: Vec<f64>,
    pub by_frequency: Vec<f64>,
    pub by_parameter: Vec<f64>,
    /// Touches of each contact.
    pub touches: Vec<u32>,
    /// What rounding leaves unknown behind hard contacts [1/s].
    pub rounding: f64,
}

impl Segment {
    fn multiply(&mut self, sign: f64) {
        let all = [&mut self.end, &mut self.matrix, &mut self.by_frequency, &mut self.by_parameter];
        all.into_iter().flatten().for_each(|value| *value *= sign);
    }

    /// This one and then another one.
    fn then(&self, next: &Self) -> Self {
        let sum = |first: &[f64], second: &[f64]| -> Vec<f64> {
            times(&next.matrix, first).iter().zip(second).map(|(a, b)| a + b).collect()
        };
        let mut matrix = vec![0.0; self.matrix.len()];
        multiply(self.end.len(), &next.matrix, &self.matrix, &mut matrix);
        Self {
            end: next.end.clone(),
            matrix,
            by_frequency: sum(&self.by_frequency, &next.by_frequency),
            by_parameter: sum(&self.by_parameter, &next.by_parameter),
            touches: self.touches.iter().zip(&next.touches).map(|(a, b)| a + b).collect(),
            rounding: self.rounding.hypot(next.rounding),
        }
    }
}

/// The shooting equations.
#[derive(Debug)]
pub(super) struct Shooting {
    pub integrator: ExactIntegrator,
    pub parameter: Parameter,
    pub period_multiple: u32,
    /// What of the orbit the segments are.
    pub closing: Closing,
    pub scale: StateScale,
    pub count: usize,
    /// The segments at the last evaluated place.
    pub segments: Vec<Segment>,
    /// `A_k`, the products of the first k matrices, `k = 0..=m`.
    pub products: Vec<Vec<f64>>,
    pub touches: Vec<u32>,
    /// About how far the orbit is from grazing a contact, relative to its size, as far as the differences at
    /// the last evaluated place have seen it: 0 if one broke off at the shortest step, infinite if the
    /// longest served.
    pub grazing_distance: f64,
    /// Where the orbit touches a contact at its ends.
    pub passing: Option<Passing>,
}

impl Shooting {
    /// Entries of a node, 2n.
    pub fn size(&self) -> usize {
        self.scale.values().len()
    }

    /// Monodromy matrix at the last evaluated place, by rows.
    pub fn monodromy(&self) -> &[f64] {
        &self.products[self.count]
    }

    /// Multipliers at the last evaluated place, with this mismatch of the equations.
    pub fn spectrum(&self, residual: f64) -> Result<Spectrum, NoEigenvalues> {
        let rounding = self
            .scale
            .relative_rate(self.segments.iter().map(|segment| segment.rounding).fold(0.0, f64::hypot));
        let accuracy =
            Accuracy { motion_tolerance: self.integrator.settings().tolerance, residual, rounding };
        let segments = self.segments.iter().map(|segment| segment.matrix.as_slice()).collect();
        Spectrum::of(&KnownMatrix::of_orbit(self.size(), segments, &self.products, &accuracy))
    }

    /// How long the segments are in all [cycles].
    pub fn cycles(&self) -> f64 {
        self.closing.share() * f64::from(self.period_multiple)
    }

    pub fn stretch(&self, segment: usize, frequency_hz: f64, phase: f64) -> Stretch {
        let cycle = |k: usize| phase + self.cycles() * k as f64 / self.count as f64;
        Stretch { frequency_hz, start: cycle(segment), end: cycle(segment + 1) }
    }

    pub fn flow(&mut self, segment: usize, place: &CurveOrbit, node: &[f64]) -> Result<Segment, MotionError> {
        let stretch = self.stretch(segment, place.frequency_hz, place.phase);
        let mut parts = self.parts(stretch, place.phase).into_iter();
        let whole = parts.next().unwrap_or((stretch, false));
        let mut flow = self.flow_over(whole, node)?;
        for part in parts {
            flow = flow.then(&self.flow_over(part, &flow.end)?);
        }
        if segment + 1 == self.count {
            flow.multiply(self.closing.sign());
        }
        Ok(flow)
    }

    /// Flow of a scaled node over a part of the orbit.
    pub fn flow_over(
        &mut self,
        (stretch, passes): (Stretch, bool),
        node: &[f64],
    ) -> Result<Segment, MotionError> {
        let scales = self.scale.values().to_vec();
        let size = scales.len();
        let state: Vec<f64> = node.iter().zip(&scales).map(|(x, s)| x * s).collect();
        let integrator = self.integrator_of(passes);
        let flow = integrator.flow(&stretch, &state)?;
        let scaled = |values: &[f64]| values.iter().zip(&scales).map(|(z, s)| z / s).collect::<Vec<f64>>();
        let matrix = (0..size * size).map(|k| (k / size, k % size));
        let mut by_parameter = scaled(&flow.by_parameter);
        // An element that is left out depends on nothing.
        by_parameter.resize(size, 0.0);
        Ok(Segment {
            end: scaled(&flow.state),
            matrix: matrix.map(|(i, j)| flow.by_state[(i, j)] / scales[i] * scales[j]).collect(),
            by_frequency: scaled(&flow.by_frequency),
            by_parameter,
            touches: integrator.touches().to_vec(),
            rounding: integrator.rounding(),
        })
    }

    /// Gives the parameter that is followed another value.
    pub fn set_parameter(&mut self, value: f64) -> Result<(), MotionError> {
        self.integrator.set_parameter(self.parameter, value)?;
        self.passing.as_mut().map_or(Ok(()), |passing| passing.set_parameter(self.parameter, value))
    }

    /// Evaluates all segments at a place.
    pub fn evaluate(&mut self, place: &CurveOrbit) -> Result<(), MotionError> {
        self.set_parameter(place.value)?;
        let size = self.size();
        self.grazing_distance = f64::INFINITY;
        self.touches.fill(0);
        self.segments.clear();
        let mut identity = vec![0.0; size * size];
        (0..size).for_each(|i| identity[i * size + i] = 1.0);
        self.products = vec![identity];
        for k in 0..self.count {
            let segment = self.flow(k, place, &place.nodes[k * size..(k + 1) * size])?;
            let touches = self.touches.iter_mut().zip(&segment.touches);
            touches.for_each(|(sum, touches)| *sum += touches);
            let mut product = vec![0.0; size * size];
            multiply(size, &segment.matrix, &self.products[k], &mut product);
            self.products.push(product);
            self.segments.push(segment);
        }
        complete_touches(&mut self.touches);
        Ok(())
    }

    /// `v_k = A_k v`, the vector carried to the node of each segment.
    pub fn carried(&self, vector: &[f64]) -> Vec<Vec<f64>> {
        self.products[..self.count].iter().map(|product| times(product, vector)).collect()
    }

    /// `w_k^T = w^T G_{m-1} ... G_{k+1}`, the left vector carried back to the end of each segment.
    pub fn carried_back(&self, vector: &[f64]) -> Vec<Vec<f64>> {
        let mut rows = vec![vector.to_vec()];
        for segment in self.segments[1..].iter().rev() {
            rows.push(left_times(&segment.matrix, &rows[rows.len() - 1]));
        }
        rows.reverse();
        rows
    }

    /// Derivative of `w^T A v` by all nodes, the frequency and the parameter, with vectors fixed.
    pub fn gradient(
        &mut self,
        place: &CurveOrbit,
        left: &[f64],
        right: &[f64],
    ) -> Result<Vec<f64>, MotionError> {
        let directions = self.carried(right);
        let lefts = self.carried_back(left);
        let differences = self.differences(place, &directions)?;
        let (mut gradient, mut by) = (Vec::new(), [0.0; 2]);
        for (left, difference) in lefts.iter().zip(&differences) {
            gradient.extend(left_times(&difference.matrix, left));
            by[0] += dot(left, &difference.by_frequency);
            by[1] += dot(left, &difference.by_parameter);
        }
        gradient.extend(by);
        Ok(gradient)
    }

    /// Rate of a scaled state at a phase.
    pub fn rate(&self, place: &CurveOrbit, phase: f64, node: &[f64]) -> Vec<f64> {
        let scales = self.scale.values();
        let state: Vec<f64> = node.iter().zip(scales).map(|(x, s)| x * s).collect();
        let rate = self.integrator.system().rate(place.frequency_hz, phase, &state);
        rate.iter().zip(scales).map(|(r, s)| r / s).collect()
    }
}
