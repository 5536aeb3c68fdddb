//! Orbits that are followed as parameters change.

use hammerbeam_orbit::{
    OrbitMaxima, OrbitSettings, PeriodicSolution, SurveyEffort, neighbouring_orbit, survey,
};

use crate::{Model, file::Study, orbit_solver};

use super::{
    candidate::CandidateError,
    data::{Datum, Maximum, MeasuredOrbit, Observation, UpdateData},
};

/// How orbits of one study are looked for.
#[derive(Debug, Clone)]
pub(super) struct Orbits {
    settings: OrbitSettings,
    effort: SurveyEffort,
}

impl Orbits {
    pub fn new(study: &Study) -> Self {
        let usual = SurveyEffort::default();
        Self {
            settings: orbit_solver::settings(&study.continuation),
            effort: SurveyEffort {
                starts: study.search.starts as usize,
                settling: study.search.settling_periods as usize,
                ..usual
            },
        }
    }

    /// The stable orbit at each measured response that is nearest to its data.
    pub fn seek(&self, model: &Model, data: &UpdateData) -> Result<Vec<PeriodicSolution>, CandidateError> {
        let of = |(index, measured): (usize, &MeasuredOrbit)| {
            let found = self.all_stable(model, measured)?;
            let distance = |orbit: &PeriodicSolution| distance(orbit, index, &data.data);
            let nearest = found.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            nearest.ok_or(CandidateError::NoResponse {
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
        let found =
            survey(&model.system, &model.response, frequency_hz, &multiples, &self.effort, &self.settings);
        let mut found = found.map_err(|source| CandidateError::Orbit { frequency_hz, source })?;
        found.retain(PeriodicSolution::stable);
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

/// A maximum of an orbit.
pub(super) fn maximum(maxima: &OrbitMaxima, of: Maximum) -> f64 {
    match of {
        Maximum::Displacement => maxima.displacement,
        Maximum::Acceleration => maxima.acceleration,
        Maximum::ContactForce => maxima.contact_force,
        Maximum::ImpactVelocity => maxima.impact_velocity,
    }
}

/// Sum of squares of an orbit's residuals in the logarithms of its maxima, so that a wrong level of the whole model does not decide.
fn distance(orbit: &PeriodicSolution, index: usize, data: &[Datum]) -> f64 {
    let square = |datum: &Datum| match datum.observation {
        Observation::Response(response) if response.orbit == index => {
            let found = maximum(&orbit.maxima, response.of);
            Some((found / datum.value).ln().powi(2))
        }
        _ => None,
    };
    data.iter().filter_map(square).sum()
}
