//! Where a follower is: the point accepted last, and what is known of the path there.

use crate::{
    corrector::Candidate,
    error::PathStop,
    point::{ContinuationPoint, PathEvents},
    predictor::{History, MOST_EARLIER_NODES, Node},
    product::{norm, scale},
};

/// Where a follower is, as plain data; nothing of it changes while a step is tried.
#[derive(Debug, Clone, PartialEq)]
pub struct PathState {
    /// The point accepted last.
    pub current: ContinuationPoint,
    /// The start, against which a closed path is recognised.
    pub start: ContinuationPoint,
    /// The last points of the present smooth arc, for the predictor; the first is the base of the next step.
    pub history: History,
    /// Most earlier points for the predictor of the next step: as many as would have served the last one
    /// best.
    pub most_earlier: usize,
    /// Length of the next step.
    pub step_length: f64,
    /// Sign of `det [R_x R_λ; (W t)ᵀ]` with the tangent in the direction of travel.
    pub orientation: f64,
    /// Sign that `t_λ` has after `current`; it settles the doubt at a fold, where `t_λ` is rounding.
    pub parameter_sign: f64,
    /// Least and most number of multipliers outside the unit circle behind `current`; `None` if nothing is
    /// known of them.
    pub outside: Option<(u32, u32)>,
    /// Units of the unknowns now, relative to the units at the start: unknown `i` has number `i` modulo their
    /// number.
    pub units: Vec<f64>,
    /// A change of signature is known to lie within this distance ahead; zero if none is known.
    pub change_ahead: f64,
    /// Why the branch ended, if it did.
    pub stop: Option<PathStop>,
}

impl PathState {
    /// At a start whose tangent points in the direction of travel.
    pub(crate) fn at_start(start: ContinuationPoint, node: &Node, step_length: f64) -> Self {
        let mut history = History::new(start.point.len());
        history.push(node);
        Self {
            start: start.clone(),
            history,
            most_earlier: MOST_EARLIER_NODES,
            step_length,
            orientation: start.orientation,
            parameter_sign: if start.tangent_parameter() < 0.0 { -1.0 } else { 1.0 },
            outside: None,
            units: vec![1.0],
            change_ahead: 0.0,
            stop: None,
            current: start,
        }
    }

    /// Whether the start has the present unknowns, so that a path that comes back to it is seen to close.
    #[must_use]
    pub fn has_start(&self) -> bool {
        self.start.parameter().is_finite()
    }

    /// A point as it is in the units of the start.
    #[must_use]
    pub fn in_first_units(&self, point: &ContinuationPoint) -> ContinuationPoint {
        in_units_of(point, &self.units)
    }

    /// A point that is given in the units of the start, in the present ones.
    #[must_use]
    pub fn in_present_units(&self, point: &ContinuationPoint) -> ContinuationPoint {
        in_units_of(point, &inverses(&self.units))
    }

    /// The base of the next step.
    pub(crate) fn base(&self) -> &Node {
        self.history.base()
    }

    /// Makes a candidate the present point.
    pub(crate) fn arrive(
        &mut self,
        trial: &Candidate,
        arc_length: f64,
        (events, uncertainty): (PathEvents, f64),
    ) {
        let current = &mut self.current;
        current.point.copy_from_slice(&trial.point);
        current.tangent.copy_from_slice(&trial.node.tangent);
        current.arc_length = arc_length;
        current.signature = trial.signature;
        current.orientation = self.orientation;
        current.log_determinant = trial.log_determinant;
        current.correction_norm = trial.correction_norm;
        current.residual_norm = trial.residual_norm;
        current.events = events;
        current.uncertainty = uncertainty;
    }

    /// Goes on in units of the unknowns that are `factors` times as large
    /// ([`rescale`](crate::Follower::rescale)).
    ///
    /// Tolerances, steps and the distance of sheets are lengths, measured in units of the unknowns that fit
    /// the start. Where the unknowns grow or shrink by orders of magnitude, a problem may change their units,
    /// and its equations with them: `x' = C⁻¹ x`, `R' = C⁻¹ R` with the factors on the diagonal of C, the
    /// parameter and the weights as they are. A unit tangent `t` then has the length `ρ = ‖[C⁻¹ t_x; t_λ]‖`
    /// and becomes `[C⁻¹ t_x; t_λ]/ρ`; a step along it keeps its end if its length is multiplied by `ρ`. The
    /// vector `N` of the minors of `[R_x R_λ]`, which is `D t`, changes like a point, so that `D' = ρ D`: no
    /// sign changes. The memory stays in the first units.
    pub(crate) fn rescale(&mut self, factors: &[f64], weights: &[f64], shortest_step: f64) {
        debug_assert!(self.units.len() == 1 || self.units.len() == factors.len(), "as many as before");
        let inverse = inverses(factors);
        self.units =
            factors.iter().zip(self.units.iter().cycle()).map(|(factor, unit)| factor * unit).collect();
        for node in &mut self.history.nodes {
            multiply(&mut node.point, &inverse);
            renormalise(&mut node.tangent, weights, &inverse);
        }
        for point in [&mut self.current, &mut self.start] {
            multiply(&mut point.point, &inverse);
            let length = renormalise(&mut point.tangent, weights, &inverse);
            point.log_determinant += length.ln();
        }
        // A step may be tried along the tangent of the present point.
        let mut tangent = self.current.tangent.clone();
        let grown = 1.0 / renormalise(&mut tangent, weights, factors);
        self.step_length = (self.step_length * grown).max(shortest_step);
        self.change_ahead *= grown;
    }
}

/// Unknowns of a point in units in which they are so many times as large, taken over and over; the parameter,
/// which comes last, stays.
fn multiply(values: &mut [f64], by: &[f64]) {
    let last = values.len() - 1;
    values[..last].iter_mut().zip(by.iter().cycle()).for_each(|(value, by)| *value *= by);
}

fn inverses(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| value.recip()).collect()
}

/// Point and tangent in units in which they are so many times as large.
fn in_units_of(point: &ContinuationPoint, units: &[f64]) -> ContinuationPoint {
    let of = |values: &[f64]| in_units(values, units);
    ContinuationPoint { point: of(&point.point), tangent: of(&point.tangent), ..point.clone() }
}

/// [`multiply`] for a copy.
pub(crate) fn in_units(values: &[f64], units: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    multiply(&mut values, units);
    values
}

/// Length in the new units, which becomes one.
fn renormalise(tangent: &mut [f64], weights: &[f64], by: &[f64]) -> f64 {
    multiply(tangent, by);
    let length = norm(weights, tangent);
    if length > 0.0 {
        scale(tangent, 1.0 / length);
    }
    length
}
