//! Multiple shooting: the periodic orbit as a problem for the path crate.
//! Equations (P1) to (P6) of the book, `docs/theory`.
//!
//! An orbit of N excitation periods is cut at m equal phases, the first of them the phase at which it begins
//! (0 unless a law needs another one). The unknowns are the states `z_k` there, scaled: displacements with
//! `V/max(w_i, 2 pi f)`, velocities with `V`, which fit the orbit to a factor of four (`state_scale.rs`).
//! With the flow `Z_k` of segment k the equations are
//!
//! `R_k = Z_k(z_k, f) - z_{k+1} = 0`, `k = 0..m`, `z_m = z_0`.
//!
//! The last unknown `f` is the excitation frequency, or another [`ContinuationParameter`] while the frequency
//! is fixed. With `G_k = dZ_k/dz_k`, `g_k = dZ_k/df` a bordered system with right-hand sides `b_k`, and `b`
//! for the border row, is condensed to the first node: `d_{k+1} = A_{k+1} d_0 + a_{k+1} df - s_{k+1}`, where
//! `A_{k+1} = G_k A_k`, `a_{k+1} = G_k a_k + g_k`, `s_{k+1} = G_k s_k + b_k`. Then `(A_m - I) d_0 + a_m df =
//! s_m` and the border row, summed over the nodes. `A_m` is the monodromy matrix. Eliminating the other nodes
//! divides by determinants of `-I` only, so the determinant of the condensed matrix orients the path, and the
//! orientation does not depend on m.
//!
//! # Whole equations
//! The products grow like the multipliers, so condensing leaves a relative error of about `1e-16 |mu_1|` in
//! corrections and tangents, however many the segments. Up to 1e7 that is below the tolerances of the path.
//! Where an entry of `A_m` is larger, all equations and the border row are factorised as they stand, with
//! partial pivoting: then only one segment makes the error. So orbits beside several slow impacts can be
//! followed, on which a disturbance becomes 1e30 times as large in a period. That is some 3 m times the work
//! of condensing. The determinant is the same.
//!
//! # Limits
//! Multipliers are eigenvalues of a product: small ones are known to `1e-16 |mu_1|`, the largest one to 1e-8
//! at 1e12. With one segment the guess parts from the orbit by `|mu_1|` within a period: about 1e5 is the end
//! there.
//!
//! # Fast excitation
//! Where the period is short beside the periods of the modes, `A_m - I` is small and rounding of `Z_k -
//! z_{k+1}` is what limits an orbit. In flight `Z_k - z_{k+1} = G_k d_k - d_{k+1}` with the deviations d from
//! the steady motion, which vanish at the solution, and rounding of them with it: above a thousand times the
//! lowest eigenfrequency residuals are taken like that.
//!
//! # Orbits that are cut at a touch
//! Of states that agree to the tolerance one may lie before the touch and the other behind it: then the flows
//! on both sides have the touch at both of their ends or at neither. Their touches are counted once. Where
//! the force sets in with a jump, the product of their matrices has its factor (the saltation matrix) twice
//! or not at all, and its eigenvalues are not the multipliers: those are taken from the same orbit cut
//! elsewhere. For corrections and tangents the matrices stay as they are, derivatives of the equations on the
//! side on which the nodes lie.
//!
//! What the equations are made of at a point is in `shooting/flows.rs`, what the path crate asks of them in
//! `shooting/equations.rs`, and of what only orbits know in `shooting/judge.rs`; motions beside the one that
//! was evaluated are in `shooting/beside.rs`, nodes carried along the motion in `shooting/carried.rs`.
//!
//! # Source
//! Ascher, Mattheij and Russell, *Numerical Solution of Boundary Value Problems* (1988), chapter 4.

mod beside;
mod carried;
mod equations;
mod flows;
mod judge;

use hammerbeam_motion::{
    Stretch, System,
    exact::{AtEnd, ExactCounts, ExactIntegrator, MotionError},
};
use hammerbeam_path::{DenseLu, PathError};

use beside::{Beside, KnownImages};
use carried::{Along, NodeSlope};

use crate::{
    ContinuationParameter, NoEigenvalues, OrbitError,
    known_matrix::{Accuracy, KnownMatrix},
    spectrum::Spectrum,
    state_scale::StateScale,
};

/// The shooting equations of one system.
#[derive(Debug)]
pub(crate) struct ShootingProblem {
    integrator: ExactIntegrator,
    period_multiple: u32,
    segments: usize,
    /// Phase of the first node [cycles], from 0 to N.
    phase: f64,
    scale: StateScale,
    length_per_norm: f64,
    weights: Vec<f64>,
    residual: Vec<f64>,
    /// `G_k` by rows, scaled.
    segment_matrices: Vec<Vec<f64>>,
    /// `A_k` by rows, `k = 0..=m`; the first is the identity.
    products: Vec<Vec<f64>>,
    /// `g_k` and `a_k`.
    by_parameter: Vec<Vec<f64>>,
    parameter_sums: Vec<Vec<f64>>,
    /// What is factorised: the equations with the border, condensed to the first node or whole.
    matrix: Vec<f64>,
    is_condensed: bool,
    border: Vec<f64>,
    lu: DenseLu,
    touches: Vec<u32>,
    /// [`ExactIntegrator::at_ends`] of all segments, those at their starts and those at their ends.
    at_ends: [Vec<AtEnd>; 2],
    /// See [`ShootingProblem::touches_lacking`].
    touches_lacking: Vec<i32>,
    /// Whether a segment ends at a touch at which a force sets in with a jump, and the flows have it at both
    /// of their ends or at neither.
    jumps_at_cut: bool,
    /// Whether the orbit at the last evaluated point is a flight that is known to rounding.
    is_short_flight: bool,
    /// What rounding leaves unknown behind hard contacts, over all segments [1/s].
    rounding: f64,
    failure: Option<MotionError>,
    /// Multipliers at the point evaluated last, once they were asked for.
    spectrum: Option<Result<Spectrum, NoEigenvalues>>,
    /// Whether flips and Neimark-Sacker points are looked for.
    watches_stability: bool,
    varied: ContinuationParameter,
    /// The orbits followed differ from their mirror images.
    is_asymmetric: bool,
    /// For motions beside the one that was evaluated, once one was asked for.
    beside: Option<Box<Beside>>,
    /// The images of the orbit that was asked for last.
    images: Option<Box<KnownImages>>,
}

impl ShootingProblem {
    /// * `length_per_norm`: arc length of a change of the orbit by its own size, in the unit of what varies.
    pub fn new(
        integrator: ExactIntegrator,
        (period_multiple, segments): (u32, usize),
        scale: StateScale,
        length_per_norm: f64,
    ) -> Self {
        let contacts = integrator.touches().len();
        let mut problem = Self {
            integrator,
            period_multiple,
            segments,
            phase: 0.0,
            scale,
            length_per_norm,
            weights: Vec::new(),
            residual: Vec::new(),
            segment_matrices: Vec::new(),
            products: Vec::new(),
            by_parameter: Vec::new(),
            parameter_sums: Vec::new(),
            matrix: Vec::new(),
            is_condensed: true,
            border: Vec::new(),
            lu: DenseLu::new(),
            touches: vec![0; contacts],
            at_ends: [Vec::new(), Vec::new()],
            touches_lacking: vec![0; contacts],
            jumps_at_cut: false,
            is_short_flight: false,
            rounding: 0.0,
            failure: None,
            spectrum: None,
            watches_stability: false,
            varied: ContinuationParameter::Frequency,
            is_asymmetric: false,
            beside: None,
            images: None,
        };
        problem.set_segments(segments);
        problem
    }

    /// With the first node at this phase [cycles].
    pub fn starting_at(mut self, phase: f64) -> Self {
        self.phase = phase;
        self
    }

    /// Cuts the orbit at another phase [cycles]; the problem must be evaluated again.
    pub fn set_phase(&mut self, phase: f64) {
        self.phase = phase;
    }

    /// Phase of the first node [cycles], from 0 to N.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Makes this parameter the last unknown; the problem must be evaluated again.
    ///
    /// # Errors
    /// [`MotionError::Parameter`] if the system does not have it.
    pub fn vary(&mut self, varied: ContinuationParameter) -> Result<(), MotionError> {
        self.integrator.differentiate_by(varied.parameter())?;
        self.varied = varied;
        Ok(())
    }

    /// Whether orbits are followed that differ from their mirror images: those that do not they meet at
    /// branch points only.
    pub fn is_asymmetric(&self) -> bool {
        self.is_asymmetric
    }

    /// Says that such orbits are followed, or that they are not.
    pub fn set_asymmetric(&mut self, is_asymmetric: bool) {
        self.is_asymmetric = is_asymmetric;
    }

    /// What varies.
    pub fn varied(&self) -> ContinuationParameter {
        self.varied
    }

    /// Excitation frequency of a point [Hz].
    pub fn frequency(&self, point: &[f64]) -> f64 {
        match self.varied {
            ContinuationParameter::Frequency => point[point.len() - 1],
            ContinuationParameter::Other { frequency_hz, .. } => frequency_hz,
        }
    }

    /// Gives the system the parameter of a point.
    ///
    /// # Errors
    /// [`MotionError::Parameter`] if the system cannot have it.
    pub fn move_to(&mut self, point: &[f64]) -> Result<(), MotionError> {
        match self.varied.parameter() {
            Some(parameter) => self.integrator.set_parameter(parameter, point[point.len() - 1]),
            None => Ok(()),
        }
    }

    /// How many hertz of arc length a change of the orbit by its own size counts.
    pub fn length_per_norm(&self) -> f64 {
        self.length_per_norm
    }

    /// Size that the last unknown has at a point, for relative accuracies.
    pub fn parameter_size(&self, point: &[f64]) -> f64 {
        let value = point[point.len() - 1].abs();
        // A parameter may pass zero: then its range, of which a hundredth counts like the orbit, gives its
        // size.
        if self.varied.parameter().is_some() { value.max(100.0 * self.length_per_norm) } else { value }
    }

    /// Cuts the orbit anew; the problem must be evaluated again.
    pub fn set_segments(&mut self, segments: usize) {
        let size = self.node_size();
        let mut identity = vec![0.0; size * size];
        (0..size).for_each(|i| identity[i * size + i] = 1.0);
        // The orbit counts once, whatever the number of nodes.
        let weight = self.length_per_norm * self.length_per_norm / segments as f64;
        self.segments = segments;
        self.weights = (0..segments * size).map(|_| weight).chain([1.0]).collect();
        self.residual = vec![0.0; segments * size];
        self.segment_matrices = vec![vec![0.0; size * size]; segments];
        self.products = vec![identity; segments + 1];
        self.by_parameter = vec![vec![0.0; size]; segments];
        self.parameter_sums = vec![vec![0.0; size]; segments + 1];
    }

    /// Measures states in units these many times as large; the problem must be evaluated again.
    pub fn rescale(&mut self, factors: &[f64]) {
        self.scale.multiply_each(factors);
    }

    /// Size of the orbit at a point relative to the scale: the root of the mean square over the nodes.
    pub fn size(&self, point: &[f64]) -> f64 {
        self.scale.size_of_scaled(point[..self.residual.len()].iter().copied(), self.segments)
    }

    /// Entries of a node, 2n.
    pub fn node_size(&self) -> usize {
        self.scale.values().len()
    }

    /// Number of segments m.
    pub fn segments(&self) -> usize {
        self.segments
    }

    pub fn period_multiple(&self) -> u32 {
        self.period_multiple
    }

    pub fn scale(&self) -> &StateScale {
        &self.scale
    }

    /// The system.
    pub fn system(&self) -> &System {
        self.integrator.system()
    }

    /// Work of the motion.
    pub fn counts(&self) -> ExactCounts {
        self.integrator.counts()
    }

    pub fn integrator(&mut self) -> &mut ExactIntegrator {
        &mut self.integrator
    }

    /// Tolerance of its steps.
    pub fn motion_tolerance(&self) -> f64 {
        self.integrator.settings().tolerance
    }

    /// Gives the integrator back.
    pub fn into_integrator(self) -> ExactIntegrator {
        self.integrator
    }

    /// What went wrong in the last evaluation.
    pub fn failure(&self) -> Option<&MotionError> {
        self.failure.as_ref()
    }

    /// What went wrong in the last evaluation, or else what the path says of it.
    pub fn failure_or(&self, error: PathError) -> OrbitError {
        self.failure.clone().map_or(OrbitError::Path(error), OrbitError::Motion)
    }

    /// Monodromy matrix at the last evaluated point, by rows, in scaled states.
    pub fn monodromy(&self) -> &[f64] {
        &self.products[self.segments]
    }

    /// Floquet multipliers at the last evaluated point.
    pub fn multipliers(&mut self) -> Result<&[[f64; 2]], NoEigenvalues> {
        self.spectrum().map(|spectrum| spectrum.multipliers.as_slice())
    }

    /// They and which of them are on the unit circle as well as they are known.
    pub fn spectrum(&mut self) -> Result<&Spectrum, NoEigenvalues> {
        if self.spectrum.is_none() {
            self.spectrum = Some(self.spectrum_of_products());
        }
        let known = self.spectrum.as_ref().expect("it was just computed");
        known.as_ref().map_err(|error| *error)
    }

    fn spectrum_of_products(&self) -> Result<Spectrum, NoEigenvalues> {
        Spectrum::of(&self.known_matrix())
    }

    /// The monodromy matrix at the last evaluated point, and what is known of it.
    fn known_matrix(&self) -> KnownMatrix<'_> {
        let residual = self.residual.iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
        let rounding = self.scale.relative_rate(self.rounding);
        let motion_tolerance = if self.is_short_flight { 0.0 } else { self.motion_tolerance() };
        let accuracy = Accuracy { motion_tolerance, residual, rounding };
        let segments = self.segment_matrices.iter().map(Vec::as_slice).collect();
        KnownMatrix::of_orbit(self.node_size(), segments, &self.products, &accuracy)
    }

    /// How far a multiplier at the last evaluated point may be from its place on the unit circle; infinite
    /// where the orbit is cut at a touch at which a force sets in with a jump, so that its matrices are those
    /// of no cut.
    pub fn reach_of(&self, multiplier: [f64; 2]) -> f64 {
        if self.jumps_at_cut { f64::INFINITY } else { self.known_matrix().reach_from(multiplier) }
    }

    /// Whether flips and Neimark-Sacker points are looked for.
    pub fn watches_stability(&self) -> bool {
        self.watches_stability
    }

    /// Has flips and Neimark-Sacker points located.
    pub fn watch_stability(&mut self) {
        self.watches_stability = true;
    }

    /// By how much the touches of the segments were put right at the last evaluated point, where the orbit is
    /// cut at a touch: [`touches_lacking`](hammerbeam_motion::exact::touches_lacking) of each contact over
    /// all cuts.
    pub fn touches_lacking(&self) -> &[i32] {
        &self.touches_lacking
    }

    /// Number of touches of each element over the orbit at the last evaluated point.
    pub fn touches(&self) -> &[u32] {
        &self.touches
    }

    /// Segment k at a frequency.
    pub fn stretch(&self, segment: usize, frequency_hz: f64) -> Stretch {
        let period = f64::from(self.period_multiple);
        let phase = |k: usize| self.phase + period * k as f64 / self.segments as f64;
        Stretch { frequency_hz, start: phase(segment), end: phase(segment + 1) }
    }

    /// Point of the path from states and frequency.
    pub fn point(&self, nodes: &[Vec<f64>], frequency_hz: f64) -> Vec<f64> {
        let scaled = nodes.iter().flat_map(|node| node.iter().zip(self.scale.values()).map(|(z, s)| z / s));
        scaled.chain([frequency_hz]).collect()
    }

    /// States from a point of the path.
    pub fn nodes(&self, point: &[f64]) -> Vec<Vec<f64>> {
        let size = self.node_size();
        let nodes = point[..self.segments * size].chunks_exact(size);
        nodes.map(|node| node.iter().zip(self.scale.values()).map(|(x, s)| x * s).collect()).collect()
    }

    /// A node of a point with its part of the tangent there.
    pub fn node_slope(&self, point: &[f64], tangent: &[f64], node: usize) -> NodeSlope {
        let place = node * self.node_size()..(node + 1) * self.node_size();
        NodeSlope { node: point[place.clone()].to_vec(), slope: tangent[place].to_vec() }
    }

    /// A node of a point at the end of a stretch that begins there; the system has the parameter of the point
    /// ([`ShootingProblem::move_to`]).
    ///
    /// * `last_slope`: entry of the tangent that belongs to the last unknown.
    ///
    /// # Errors
    /// [`MotionError`] where the motion cannot be computed.
    pub fn carried(
        &mut self,
        from: &NodeSlope,
        stretch: &Stretch,
        last_slope: f64,
    ) -> Result<NodeSlope, MotionError> {
        let along = Along { scales: self.scale.values(), varied: self.varied, last_slope };
        Ok(from.flown(&mut self.integrator, stretch, along)?.at)
    }
}

#[cfg(test)]
mod tests;
