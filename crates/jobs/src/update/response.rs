//! Orbits that are followed as parameters change.

use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, SurveyEffort, Wanted, neighbouring_orbit, survey};
use hammerbeam_study::{Model, file::Study};

use crate::{comparison::history::history, orbit_solver};

use super::{
    candidate::CandidateError,
    data::{Datum, Maximum, MeasuredDatum, MeasuredOrbit, UpdateData},
};

/// How orbits of one study are looked for.
#[derive(Debug, Clone)]
pub(super) struct Orbits {
    settings: OrbitSettings,
    effort: SurveyEffort,
}

impl Orbits {
    pub fn new(study: &Study) -> Self {
        Self {
            settings: orbit_solver::settings(&study.continuation),
            effort: orbit_solver::effort(&study.search, Wanted::Any),
        }
    }

    /// The stable orbit at each measured response that is nearest to its data.
    pub fn seek(&self, model: &Model, data: &UpdateData) -> Result<Vec<PeriodicSolution>, CandidateError> {
        let of = |(index, measured): (usize, &MeasuredOrbit)| {
            let found = self.all_stable(model, measured)?;
            let mut nearest: Option<(f64, PeriodicSolution)> = None;
            for orbit in found {
                let distance = distance(model, &orbit, index, &data.data)?;
                if nearest.as_ref().is_none_or(|(best, _)| distance < *best) {
                    nearest = Some((distance, orbit));
                }
            }
            nearest.map(|(_, orbit)| orbit).ok_or(CandidateError::NoResponse {
                frequency_hz: measured.frequency_hz,
                period_multiple: measured.period_multiple,
            })
        };
        data.orbits.iter().enumerate().map(of).collect()
    }

    fn all_stable(
        &self,
        model: &Model,
        measured: &MeasuredOrbit,
    ) -> Result<Vec<PeriodicSolution>, CandidateError> {
        let frequency_hz = measured.frequency_hz;
        let multiples = [measured.period_multiple];
        let (system, response) = (&model.system, &model.response);
        let found =
            survey(system, response, frequency_hz, &multiples, &self.effort, &self.settings, &mut || false);
        let found = found.map_err(|source| CandidateError::Orbit { frequency_hz, source })?;
        let mut found = found.found.orbits;
        found.retain(PeriodicSolution::may_be_stable);
        Ok(found)
    }

    /// The orbits of a model from those of a model beside it.
    pub fn follow(
        &self,
        model: &Model,
        near: &[PeriodicSolution],
    ) -> Result<Vec<PeriodicSolution>, CandidateError> {
        let of = |orbit: &PeriodicSolution| {
            let frequency_hz = orbit.frequency_hz;
            let found = neighbouring_orbit(&model.system, &model.response, orbit, &self.settings);
            found
                .map_err(|source| CandidateError::Orbit { frequency_hz, source })?
                .ok_or(CandidateError::ResponseLost { frequency_hz })
        };
        near.iter().map(of).collect()
    }
}

/// Samples of an orbit in an excitation period, of which its largest velocity is read.
const SAMPLES: usize = 2048;

/// A maximum of an orbit.
pub(super) fn maximum(model: &Model, orbit: &PeriodicSolution, of: Maximum) -> Result<f64, CandidateError> {
    let maxima = &orbit.maxima;
    Ok(match of {
        Maximum::Velocity => largest_velocity(model, orbit)?,
        Maximum::Displacement => maxima.displacement,
        Maximum::Acceleration => maxima.acceleration,
        Maximum::ContactForce => maxima.contact_force,
        Maximum::ImpactVelocity => maxima.impact_velocity,
    })
}

/// Largest absolute velocity of the response point: of samples, and between them by a parabola, whose error
/// is of the fourth order where the velocity is smooth.
fn largest_velocity(model: &Model, orbit: &PeriodicSolution) -> Result<f64, CandidateError> {
    let frequency_hz = orbit.frequency_hz;
    let history = history(model, orbit, SAMPLES);
    let velocity = history.map_err(|source| CandidateError::MotionHistory { frequency_hz, source })?.velocity;
    let size = |k: usize| velocity[k % velocity.len()].abs();
    let top = (0..velocity.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0);
    let (before, here, after) = (size(top + velocity.len() - 1), size(top), size(top + 1));
    let bend = before - 2.0 * here + after;
    // A jump at a rigid stop has no parabola: the top would lie beyond a sample.
    let place = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    Ok(if place.abs() <= 0.5 { here - 0.25 * (before - after) * place } else { here })
}

/// Sum of squares of an orbit's residuals in the logarithms of its maxima, so that a wrong level of the whole
/// model does not decide.
fn distance(
    model: &Model,
    orbit: &PeriodicSolution,
    index: usize,
    data: &[Datum],
) -> Result<f64, CandidateError> {
    let square = |datum: &Datum| match datum.observation {
        MeasuredDatum::Response(response) if response.orbit == index => {
            let found = maximum(model, orbit, response.of);
            Some(found.map(|found| (found / datum.value).ln().powi(2)))
        }
        _ => None,
    };
    data.iter().filter_map(square).sum()
}
