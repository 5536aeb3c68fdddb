//! Motions beside the one that was evaluated, by an integrator of their own, since the other one holds what
//! was evaluated last. They give the distance of an orbit from orbits of shorter period, or from symmetric
//! ones, where its nodes do not, as no two of them lie so far apart; and its start some periods later.

use hammerbeam_motion::{
    Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};

use hammerbeam_path::{Image, Node};

use crate::ContinuationParameter;

/// The images of one orbit.
#[derive(Debug)]
pub(super) struct KnownImages {
    pub of: Node,
    pub phase: f64,
    /// By their numbers, from 1 on.
    pub images: Vec<Option<Image>>,
}

/// Orbits whose distance is kept: a trial is the next current point.
const KEPT: usize = 8;

/// Where an orbit starts, and in which units.
#[derive(Debug, Clone, Copy)]
pub(super) struct OrbitStart<'a> {
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

/// Orbits that are special cases of the orbits of a walk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Simpler {
    /// Orbits of shorter period.
    Shorter,
    /// Orbits that are their own mirror images.
    Symmetric,
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
    from: Simpler,
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

    /// Distance of the state with which an orbit begins from where it comes, by its motion; infinite where
    /// that cannot be computed.
    ///
    /// - From orbits of shorter period: the norm of `Z(z_0) - z_0` after k excitation periods, the least one
    ///   over the proper divisors k of N.
    /// - From symmetric ones: the norm of `Z(z_0) + z_0` after N/2 periods.
    pub fn distance(&mut self, start: OrbitStart<'_>, from: Simpler) -> f64 {
        let parameter = start.parameter.map_or(0.0, |(_, value)| value);
        let place = [start.phase, start.frequency_hz, parameter];
        let is_same =
            |known: &&Known| known.from == from && known.place == place && known.scaled == start.scaled;
        if let Some(known) = self.known.iter().find(is_same) {
            return known.distance;
        }
        let distance = self.after_periods(start, from).unwrap_or(f64::INFINITY);
        self.known.drain(..self.known.len().saturating_sub(KEPT - 1));
        self.known.push(Known { from, scaled: start.scaled.to_vec(), place, distance });
        distance
    }

    fn after_periods(&mut self, start: OrbitStart<'_>, from: Simpler) -> Result<f64, MotionError> {
        let OrbitStart { scaled, scales, phase, frequency_hz, period_multiple, parameter } = start;
        if let Some((parameter, value)) = parameter {
            self.integrator.set_parameter(parameter, value)?;
        }
        let mut state: Vec<f64> = scaled.iter().zip(scales).map(|(x, s)| x * s).collect();
        let off = |state: &[f64], sign: f64| {
            let off = scaled.iter().zip(state).zip(scales).map(|((x, z), s)| sign * z / s - x);
            off.map(|off| off * off).sum::<f64>().sqrt()
        };
        if from == Simpler::Symmetric {
            let end = phase + 0.5 * f64::from(period_multiple);
            let stretch = Stretch { frequency_hz, start: phase, end };
            return Ok(off(&self.integrator.advance(&stretch, &state)?, -1.0));
        }
        let mut least = f64::INFINITY;
        for period in 1..period_multiple {
            let start = phase + f64::from(period - 1);
            let stretch = Stretch { frequency_hz, start, end: start + 1.0 };
            state = self.integrator.advance(&stretch, &state)?;
            if period_multiple.is_multiple_of(period) {
                least = least.min(off(&state, 1.0));
            }
        }
        Ok(least)
    }
}
