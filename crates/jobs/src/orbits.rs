//! All periodic solutions at one frequency.

use hammerbeam_orbit::{FoundOrbits, OrbitError, PeriodicSolution};
use serde::{Serialize, Serializer};

use crate::{JobError, Observer, OrbitSolver, OrbitWaveform, PreparedStudy, orbit_waveform};

/// The periodic solutions at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitsReport {
    /// The solutions; the first one is the one that the search has come to first.
    pub orbits: Vec<PeriodicSolution>,
    /// Why the search is not complete.
    pub incomplete: Option<OrbitError>,
    /// Names of the figures that were drawn of them.
    pub figures: Option<Vec<String>>,
    /// The motion of each over its period, where it was asked for.
    pub waveforms: Vec<OrbitWaveform>,
}

/// Samples of a motion in an excitation period.
const SAMPLES: usize = 256;

impl OrbitsReport {
    /// Whether the search was interrupted; what it had found by then is here.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        self.incomplete == Some(OrbitError::Interrupted)
    }

    /// Computes the motion of each solution over its period, 256 samples in an excitation period.
    ///
    /// # Errors
    /// [`JobError::Motion`]: a motion cannot be computed again.
    pub fn add_waveforms(&mut self, study: &PreparedStudy) -> Result<(), JobError> {
        let each = self.orbits.iter().map(|orbit| orbit_waveform(&study.model, orbit, SAMPLES));
        self.waveforms = each.collect::<Result<_, _>>()?;
        Ok(())
    }
}

/// Finds all periodic solutions of a period at a frequency. An interrupted search gives what it has found.
///
/// # Errors
/// [`JobError`]: nothing could be looked for; [`JobError::Interrupted`] before anything was found.
pub fn orbits(
    study: &PreparedStudy,
    frequency_hz: f64,
    period_multiple: u32,
    observer: &mut dyn Observer,
) -> Result<OrbitsReport, JobError> {
    study.file.forced()?;
    study.check_held(observer)?;
    study.warn_of_many_modes(observer);
    let solver = OrbitSolver::new(&study.model, &study.file.study);
    let found = solver.find_orbits(frequency_hz, period_multiple, &mut || observer.interrupted());
    let FoundOrbits { orbits, incomplete } = found.map_err(|message| JobError::NoSearch { message })?;
    let report = OrbitsReport { orbits, incomplete, figures: None, waveforms: Vec::new() };
    if report.is_interrupted() && report.orbits.is_empty() {
        return Err(JobError::Interrupted { done: 0, part_s: None });
    }
    Ok(report)
}

/// A solution in few numbers.
#[derive(Serialize)]
struct OrbitDocument<'a> {
    frequency_hz: f64,
    period_multiple: u32,
    max_abs_displacement_m: f64,
    max_abs_acceleration_m_s2: f64,
    max_contact_force_n: f64,
    max_impact_velocity_m_s: f64,
    impulse_n_s: f64,
    contacts: u32,
    phase_cycles: f64,
    state: &'a [f64],
    floquet_multipliers: &'a [[f64; 2]],
    stable: bool,
    stability: &'static str,
    residual: f64,
    error_estimate: f64,
}

impl<'a> From<&'a PeriodicSolution> for OrbitDocument<'a> {
    fn from(solution: &'a PeriodicSolution) -> Self {
        let maxima = &solution.maxima;
        Self {
            frequency_hz: solution.frequency_hz,
            period_multiple: solution.period_multiple,
            max_abs_displacement_m: maxima.displacement,
            max_abs_acceleration_m_s2: maxima.acceleration,
            max_contact_force_n: maxima.contact_force,
            max_impact_velocity_m_s: maxima.impact_velocity,
            impulse_n_s: maxima.impulse,
            contacts: maxima.contacts,
            phase_cycles: solution.phase,
            state: &solution.nodes[0],
            floquet_multipliers: &solution.floquet_multipliers,
            stable: solution.stable(),
            stability: solution.stability().word(),
            residual: solution.residual,
            error_estimate: solution.error_estimate,
        }
    }
}

/// A solution with its motion over the period.
#[derive(Serialize)]
struct WholeOrbit<'a> {
    #[serde(flatten)]
    orbit: OrbitDocument<'a>,
    waveform: &'a OrbitWaveform,
}

/// The first solution, with the others beside it; all of them in one list where their motions are known.
impl Serialize for OrbitsReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Document<'a> {
            #[serde(flatten)]
            first: Option<OrbitDocument<'a>>,
            search_complete: bool,
            others: Vec<OrbitDocument<'a>>,
            #[serde(skip_serializing_if = "Vec::is_empty")]
            solutions: Vec<WholeOrbit<'a>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            figures: Option<&'a [String]>,
        }
        let whole = self.orbits.iter().zip(&self.waveforms);
        let mut all = self.orbits.iter().map(OrbitDocument::from);
        let document = Document {
            first: all.next(),
            others: all.collect(),
            solutions: whole.map(|(orbit, waveform)| WholeOrbit { orbit: orbit.into(), waveform }).collect(),
            search_complete: self.incomplete.is_none(),
            figures: self.figures.as_deref(),
        };
        document.serialize(serializer)
    }
}
