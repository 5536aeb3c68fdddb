//! Motions beside the one that was evaluated last, which an integrator of its own follows: how far an orbit is
//! from those of shorter period, and how it is seen some periods later (`images.rs`), where its nodes do not
//! tell, since no two of them lie whole excitation periods apart, as in one segment.

use hammerbeam_motion::{
    Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};

use hammerbeam_path::DenseLu;

use super::{
    carried::{Along, NodeSlope},
    flows::{identity, multiply},
};
use crate::ContinuationParameter;

/// Orbits whose distance is kept: a trial is the next current point.
const KEPT: usize = 4;

/// Where an orbit begins, and in which units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beginning<'a> {
    /// Its first node in these units.
    pub scaled: &'a [f64],
    pub scales: &'a [f64],
    /// Phase of that node [cycles].
    pub phase: f64,
    pub frequency_hz: f64,
    pub period_multiple: u32,
    /// What varies besides the frequency, and its value.
    pub parameter: Option<(Parameter, f64)>,
}

/// Motions beside the one that was evaluated.
#[derive(Debug)]
pub(super) struct Beside {
    integrator: ExactIntegrator,
    known: Vec<Known>,
}

/// The distance of an orbit that was asked for.
#[derive(Debug)]
struct Known {
    scaled: Vec<f64>,
    /// Phase, frequency and parameter.
    place: [f64; 3],
    distance: f64,
}

impl Beside {
    pub fn new(system: &System, settings: ExactSettings) -> Result<Self, MotionError> {
        Ok(Self { integrator: ExactIntegrator::new(system.clone(), settings)?, known: Vec::new() })
    }

    /// With derivatives by what varies, which has its value at this point.
    ///
    /// # Errors
    /// [`MotionError::Parameter`] if the system cannot have it.
    pub fn integrator_at(
        &mut self,
        varied: ContinuationParameter,
        point: &[f64],
    ) -> Result<&mut ExactIntegrator, MotionError> {
        if let Some(parameter) = varied.parameter() {
            self.integrator.differentiate_by(Some(parameter))?;
            self.integrator.set_parameter(parameter, point[point.len() - 1])?;
        }
        Ok(&mut self.integrator)
    }

    /// Distance from an orbit of k excitation periods, the least one over the proper divisors k of N; infinite
    /// where the motion cannot be computed.
    ///
    /// With the state `Z` and its derivative `G` after k periods it is the length of `Z - z_0` or, where that
    /// is less, of Newton's correction `(G - I)^-1 (Z - z_0)`: beside grazing impacts motions part so fast
    /// that `Z - z_0` is large for a `z_0` that is the state of such an orbit to rounding.
    pub fn distance(&mut self, begin: Beginning<'_>) -> f64 {
        let parameter = begin.parameter.map_or(0.0, |(_, value)| value);
        let place = [begin.phase, begin.frequency_hz, parameter];
        let is_same = |known: &&Known| known.place == place && known.scaled == begin.scaled;
        if let Some(known) = self.known.iter().find(is_same) {
            return known.distance;
        }
        let distance = self.after_periods(begin).unwrap_or(f64::INFINITY);
        self.known.drain(..self.known.len().saturating_sub(KEPT - 1));
        self.known.push(Known { scaled: begin.scaled.to_vec(), place, distance });
        distance
    }

    fn after_periods(&mut self, begin: Beginning<'_>) -> Result<f64, MotionError> {
        let Beginning { scaled, scales, phase, frequency_hz, period_multiple, parameter } = begin;
        if let Some((parameter, value)) = parameter {
            self.integrator.set_parameter(parameter, value)?;
        }
        let along = Along { scales, varied: ContinuationParameter::Frequency, last_slope: 0.0 };
        let size = scales.len();
        let mut at = NodeSlope { node: scaled.to_vec(), slope: vec![0.0; size] };
        let mut product = identity(size);
        let mut least = f64::INFINITY;
        for period in 1..=period_multiple / 2 {
            let start = phase + f64::from(period - 1);
            let stretch = Stretch { frequency_hz, start, end: start + 1.0 };
            let carried = at.carried(&mut self.integrator, &stretch, along)?;
            let before = std::mem::replace(&mut product, vec![0.0; size * size]);
            multiply(size, &carried.matrix, &before, &mut product);
            at = carried.at;
            if period_multiple.is_multiple_of(period) {
                let off: Vec<f64> = at.node.iter().zip(scaled).map(|(z, x)| z - x).collect();
                least = least.min(length(&off)).min(length_of_correction(&product, off));
            }
        }
        Ok(least)
    }
}

/// Euclidean norm.
pub(super) fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Length of `(G - I)^-1 off`; infinite where there is none.
fn length_of_correction(matrix: &[f64], mut off: Vec<f64>) -> f64 {
    let size = off.len();
    let mut less_one = matrix.to_vec();
    (0..size).for_each(|i| less_one[i * size + i] -= 1.0);
    let mut lu = DenseLu::new();
    if lu.factorise(size, &less_one).is_err() {
        return f64::INFINITY;
    }
    lu.solve(&mut off);
    length(&off)
}
