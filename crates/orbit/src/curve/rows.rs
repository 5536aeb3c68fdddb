//! A row of a curve: what is stored of the orbit at a point of the path, and what happens there.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{PathEvents, PathProblem};

use super::{
    row::{CurveEvents, CurveKind, CurveRow},
    shooting::CurveOrbit,
    walk::CurveWalk,
};
use crate::{OrbitError, PeriodicSolution, spectrum::Spectrum};

impl CurveWalk {
    /// Whether the contacts that are counted hold those that graze: then a change of their number says
    /// nothing of another one.
    fn counts_its_own_touch(&self) -> bool {
        matches!(self.kind, CurveKind::Grazing { .. }) && self.problem.shooting.passing.is_none()
    }

    /// The row of the present point; the condition is adapted to it.
    pub(super) fn row(&mut self) -> Result<CurveRow, OrbitError> {
        let current = self.follower.current().clone();
        self.row_at(&current.point, current.events, current.correction_norm)
    }

    /// The row of a point of the curve, at which it is adapted.
    ///
    /// * `error`: of the point, relative to the orbit.
    pub(super) fn row_at(
        &mut self,
        point: &[f64],
        events: PathEvents,
        error: f64,
    ) -> Result<CurveRow, OrbitError> {
        let place = self.problem.place(point);
        if self.problem.evaluate(point).is_err() {
            let failure = self.problem.failure().cloned();
            let none = OrbitError::NoEvent { frequency_hz: place.frequency_hz };
            return Err(failure.map_or(none, OrbitError::Motion));
        }
        self.grazing_distance = self.problem.shooting.grazing_distance;
        let residual = self.problem.residual().iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
        let zeros = events.zeros;
        let mut events = CurveEvents::of(self.kind, events, &self.problem.other_multipliers());
        if self.counts_its_own_touch() && events.double_grazing {
            (events.double_grazing, events.grazing) = (false, true);
        }
        let shooting = &mut self.problem.shooting;
        let Spectrum { multipliers, on_circle, .. } = shooting.spectrum(residual)?;
        self.problem.renew(zeros);
        let shooting = &mut self.problem.shooting;
        let scales = shooting.scale.values().to_vec();
        let nodes: Vec<Vec<f64>> = place
            .nodes
            .chunks_exact(scales.len())
            .map(|node| node.iter().zip(&scales).map(|(x, s)| x * s).collect())
            .collect();
        let stretches: Vec<Stretch> =
            (0..shooting.count).map(|k| shooting.stretch(k, place.frequency_hz, place.phase)).collect();
        let has_phase = self.problem.condition.has_phase();
        if has_phase {
            shooting.fit_passing(place.frequency_hz, place.phase, &nodes[0])?;
        }
        let maxima = shooting.observe(&stretches, &nodes)?;
        let nodes = if has_phase { self.nodes_from_start(&place, &nodes)? } else { nodes };
        let solution = PeriodicSolution {
            frequency_hz: place.frequency_hz,
            period_multiple: self.problem.shooting.period_multiple,
            phase: self.problem.cut_phase,
            nodes,
            floquet_multipliers: multipliers,
            on_circle,
            residual,
            error_estimate: error,
            maxima,
        };
        let phase = has_phase.then_some(place.phase);
        Ok(CurveRow { parameter: place.value, solution, phase, events })
    }

    /// Nodes at equal phases, from the phase of the start on, of the orbit that is cut elsewhere: each from
    /// the node before it.
    fn nodes_from_start(
        &mut self,
        place: &CurveOrbit,
        nodes: &[Vec<f64>],
    ) -> Result<Vec<Vec<f64>>, OrbitError> {
        let cut_phase = self.problem.cut_phase;
        let shooting = &mut self.problem.shooting;
        let cycles = f64::from(shooting.period_multiple);
        let length = cycles / nodes.len() as f64;
        let node = |k: usize| {
            let behind = (cut_phase + k as f64 * length - place.phase).rem_euclid(cycles);
            let from = ((behind / length) as usize).min(nodes.len() - 1);
            let [start, end] = [from as f64 * length, behind].map(|offset| place.phase + offset);
            let stretch = Stretch { frequency_hz: place.frequency_hz, start, end };
            Ok(shooting.advance(stretch, place.phase, &nodes[from])?)
        };
        (0..nodes.len()).map(node).collect()
    }
}
