//! How far a point is from orbits of shorter period where its nodes do not tell: where no two of them lie whole
//! excitation periods apart, as in one segment. Then the motion from the first node tells.
//!
//! An integrator of its own follows it, since the other one holds what was evaluated last.

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, MotionError},
};

use super::ShootingProblem;

/// Points whose distance is kept: a trial is the next current point.
const KEPT: usize = 4;

/// Motions beside the one that was evaluated.
#[derive(Debug)]
pub(super) struct Beside {
    integrator: ExactIntegrator,
    /// Points at their phase and their distances, the latest last.
    known: Vec<(f64, Vec<f64>, f64)>,
}

impl ShootingProblem {
    /// Root of the sum of squares of `Z(z_0) - z_0` after k excitation periods, the least one over the proper
    /// divisors k of N; infinite where the motion cannot be computed.
    pub(super) fn distance_by_motion(&mut self, point: &[f64]) -> f64 {
        let phase = self.phase;
        let is_same = |known: &(f64, Vec<f64>, f64)| known.0 == phase && known.1 == point;
        let known = self.beside.iter().flat_map(|beside| &beside.known).find(|known| is_same(known));
        if let Some((.., distance)) = known {
            return *distance;
        }
        let distance = self.distance_after_periods(point).unwrap_or(f64::INFINITY);
        if let Some(Beside { known, .. }) = self.beside.as_deref_mut() {
            known.drain(..known.len().saturating_sub(KEPT - 1));
            known.push((phase, point.to_vec(), distance));
        }
        distance
    }

    fn distance_after_periods(&mut self, point: &[f64]) -> Result<f64, MotionError> {
        if self.beside.is_none() {
            let integrator = ExactIntegrator::new(self.system().clone(), self.integrator.settings())?;
            self.beside = Some(Box::new(Beside { integrator, known: Vec::new() }));
        }
        let (frequency_hz, start) = (self.frequency(point), self.phase);
        let (scales, parameter) = (self.scale.values(), self.varied.parameter());
        let Some(Beside { integrator, .. }) = self.beside.as_deref_mut() else { return Ok(f64::INFINITY) };
        if let Some(parameter) = parameter {
            integrator.set_parameter(parameter, point[point.len() - 1])?;
        }
        let first: Vec<f64> = point.iter().zip(scales).map(|(x, s)| x * s).collect();
        let (mut state, mut least) = (first, f64::INFINITY);
        for period in 1..self.period_multiple {
            let begin = start + f64::from(period - 1);
            state = integrator.advance(&Stretch { frequency_hz, start: begin, end: begin + 1.0 }, &state)?;
            if self.period_multiple.is_multiple_of(period) {
                let off = point.iter().zip(&state).zip(scales).map(|((x, z), s)| z / s - x);
                least = least.min(off.map(|off| off * off).sum::<f64>().sqrt());
            }
        }
        Ok(self.hertz_per_norm * least)
    }
}
