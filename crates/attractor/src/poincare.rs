//! Poincare sections: the states of a motion at a phase of the excitation, or as a contact closes.

use crate::{AttractorError, Simulation};

/// Where a motion is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoincareSection {
    /// Once in every excitation period, at this phase, from 0 to 1 [cycles].
    Stroboscopic {
        /// The phase.
        phase: f64,
    },
    /// Whenever a contact of this element closes.
    Touch {
        /// Number of the local element.
        element: usize,
    },
}

/// A point of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionPoint {
    /// Time since observation of the motion started [s].
    pub time: f64,
    /// Phase of the excitation, 0 to 1 [cycles].
    pub phase: f64,
    /// `[q; q']`, length 2n.
    pub state: Vec<f64>,
    /// Relative velocity with which the contact closes [m/s]; 0 for a stroboscopic section.
    pub impact_velocity: f64,
}

/// Points of a section over so many more periods of a motion, in order of time.
///
/// # Errors
/// The motion cannot be computed; [`AttractorError::Input`]: the phase is not from 0 to 1, or there is no
/// such element.
pub fn poincare(
    simulation: &mut Simulation,
    section: PoincareSection,
    periods: u64,
) -> Result<Vec<SectionPoint>, AttractorError> {
    check(simulation, section)?;
    let mut points = Vec::new();
    for _ in 0..periods {
        match section {
            PoincareSection::Stroboscopic { phase } => {
                let (samples, _) = simulation.period_at(&[phase])?;
                points.extend(samples.into_iter().map(|sample| SectionPoint {
                    time: sample.time,
                    phase: sample.phase,
                    state: sample.state,
                    impact_velocity: 0.0,
                }));
            }
            PoincareSection::Touch { element } => points.extend(touches(simulation, element)?),
        }
    }
    points.sort_by(|a, b| a.time.total_cmp(&b.time));
    Ok(points)
}

fn check(simulation: &Simulation, section: PoincareSection) -> Result<(), AttractorError> {
    match section {
        PoincareSection::Stroboscopic { phase } => {
            crate::error::ensure("the phase", phase, "from 0 to 1", (0.0..=1.0).contains(&phase))
        }
        PoincareSection::Touch { element } => {
            let elements = simulation.system().elements().len();
            let there = element < elements;
            crate::error::ensure("the element", element as f64, "one of the local elements", there)
        }
    }
}

/// Touches of an element in the next period, those that last beyond it included.
fn touches(simulation: &mut Simulation, element: usize) -> Result<Vec<SectionPoint>, AttractorError> {
    let start = simulation.time();
    let (_, contacts) = simulation.period_at(&[])?;
    let duration = simulation.time() - start;
    let all = contacts.into_iter().chain(simulation.unfinished());
    let of_element = all.filter(|record| record.element == element).filter_map(|record| record.begin);
    let point = |touch: hammerbeam_motion::exact::Touchdown| SectionPoint {
        time: touch.time,
        phase: ((touch.time - start) / duration).clamp(0.0, 1.0),
        state: touch.state,
        impact_velocity: touch.velocity,
    };
    Ok(of_element.filter(|touch| touch.time >= start).map(point).collect())
}
