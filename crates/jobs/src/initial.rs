//! The state at which a motion begins.

use std::path::Path;

use hammerbeam_attractor::{SectionMap, SystemMap};
use hammerbeam_motion::Stretch;
use hammerbeam_orbit::states_at_phase;
use hammerbeam_study::PointStart;

use crate::{InitialStateError, JobError, PreparedStudy, StoredBranches};

/// What is meant by the state at which a motion begins, at phase 0.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialState {
    /// At rest: all modal coordinates and velocities are 0.
    Rest,
    /// On the periodic motion without contacts.
    Linear,
    /// Modal displacements and velocities `[q; q']`.
    Modal(Vec<f64>),
    /// Points that move as given, and everything else as little as possible.
    Points(Vec<PointStart>),
    /// On the orbit in which a stored branch crosses the frequency: a stable one where there are several.
    Branch(u32),
}

impl InitialState {
    /// The modal state that is meant: one in front of every rigid stop, and in no contact whose law depends
    /// on the speed of its impact.
    ///
    /// * `map`: of the system at the frequency.
    /// * `results`: folder whose branches are meant.
    ///
    /// # Errors
    /// [`JobError::Initial`], [`JobError::Store`].
    pub fn at(
        &self,
        map: &mut SystemMap,
        study: &PreparedStudy,
        results: Option<&Path>,
    ) -> Result<Vec<f64>, JobError> {
        let branches = results.map(|folder| StoredBranches::open(folder, &study.file)).transpose()?;
        let state = self.meant(map, study, branches.as_ref())?;
        map.check_in_front_of_stops(&state).map_err(|source| {
            let is_forced = study.file.study.excitation.harmonic().is_some();
            let frequency_hz = is_forced.then(|| map.frequency_hz());
            InitialStateError::NotInFront { frequency_hz, source }
        })?;
        Ok(state)
    }

    fn meant(
        &self,
        map: &mut SystemMap,
        study: &PreparedStudy,
        branches: Option<&StoredBranches>,
    ) -> Result<Vec<f64>, JobError> {
        let expected = map.dimension();
        match self {
            Self::Rest => Ok(vec![0.0; expected]),
            Self::Linear => {
                let stretch = Stretch { frequency_hz: map.frequency_hz(), start: 0.0, end: 1.0 };
                Ok(map.integrator().steady_state(&stretch))
            }
            Self::Modal(state) if state.len() == expected => Ok(state.clone()),
            Self::Modal(state) => Err(InitialStateError::Length { found: state.len(), expected }.into()),
            Self::Points(starts) => {
                let state = study.model.state_of_points(map.frequency_hz(), starts);
                Ok(state.map_err(InitialStateError::Points)?)
            }
            Self::Branch(number) => of_branch(*number, map, study, branches),
        }
    }
}

/// The state at phase 0 of the orbit in which a branch crosses the frequency.
fn of_branch(
    branch: u32,
    map: &mut SystemMap,
    study: &PreparedStudy,
    branches: Option<&StoredBranches>,
) -> Result<Vec<f64>, JobError> {
    let frequency_hz = map.frequency_hz();
    let branches = branches.ok_or(InitialStateError::NoResults)?;
    let known: Vec<u32> = branches.branches().iter().map(|branch| branch.record.id).collect();
    if !known.contains(&branch) {
        return Err(InitialStateError::NoSuchBranch { last: known.last().copied() }.into());
    }
    let mut orbits = branches.crossings(&study.model, frequency_hz, |record| record.id == branch)?;
    orbits.sort_by_key(|(_, orbit)| !orbit.may_be_stable());
    let (_, orbit) =
        orbits.into_iter().next().ok_or(InitialStateError::NoCrossing { branch, frequency_hz })?;
    let mut states = states_at_phase(map.integrator(), &orbit, 0.0).map_err(InitialStateError::Orbit)?;
    Ok(states.swap_remove(0))
}
