//! One stored solution, computed again with the general integrator.

use std::f64::consts::TAU;

use faer::Mat;
use hammerbeam_motion::{
    Stretch, System,
    general::{ElementMaxima, GeneralError, GeneralSettings, Observed, observe, sample},
};
use hammerbeam_orbit::{OrbitMaxima, PeriodicSolution, Response};

use super::spectrum::{Multiplier, norm, spectrum};

/// What the general integrator makes of the stored first node.
#[derive(Debug, Clone)]
pub(super) struct Recomputed {
    /// Largest `|Z_k - z_k| / (1 + |A_k|)` over the nodes, the last of which is the first.
    pub(super) residual: f64,
    /// `G = 1 + max_k |A_k|`.
    pub(super) gain: f64,
    /// `A_m`, in scaled states.
    pub(super) monodromy: Mat<f64>,
    /// Eigenvalues of `A_m`.
    pub(super) multipliers: Vec<Multiplier>,
    pub(super) maxima: OrbitMaxima,
    /// Extrema of the penetrations of all contacts [m].
    pub(super) extrema: Vec<f64>,
    /// Where the motion of an element turns in an impact elsewhere: its number and penetration [m].
    pub(super) kinks: Vec<(usize, f64)>,
    /// Speeds with which contacts closed [m/s].
    pub(super) touches: Vec<f64>,
    /// What the contacts of each element do.
    pub(super) of_elements: Vec<ElementMaxima>,
}

/// Why a stored solution could not be computed again.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Failed {
    Motion(GeneralError),
    /// No node, or nodes of another length.
    Nodes,
    Spectrum,
}

impl std::fmt::Display for Failed {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Motion(error) => error.fmt(formatter),
            Self::Nodes => formatter.write_str("the stored nodes are not states of the system"),
            Self::Spectrum => formatter.write_str("the multipliers were not found"),
        }
    }
}

/// States in each excitation period that give the size of an orbit.
const PER_PERIOD: usize = 8;
/// Tolerance of the steps to them: the size is a measure, not a result.
const SIZE: f64 = 1e-6;

/// Scales of a state: displacements `V / max(w_i, 2 pi f)`, velocities `V`, so that the states of the orbit
/// have the norm 1 in the root mean square.
pub(super) fn scales(system: &System, solution: &PeriodicSolution) -> Result<Vec<f64>, Failed> {
    let size = 2 * system.dof();
    if solution.nodes.is_empty() || solution.nodes.iter().any(|node| node.len() != size) {
        return Err(Failed::Nodes);
    }
    let reference = TAU * solution.frequency_hz;
    let rates = system.model().natural_frequencies.iter().map(|w| w.max(reference));
    let unit: Vec<f64> = rates.map(f64::recip).chain(vec![1.0; system.dof()]).collect();
    let states = states(system, solution)?;
    let squares: f64 = states.iter().map(|state| distance(state, None, &unit).powi(2)).sum();
    let mean = (squares / states.len() as f64).sqrt();
    let velocity = if mean > 0.0 && mean.is_finite() { mean } else { 1.0 };
    Ok(unit.iter().map(|scale| scale * velocity).collect())
}

/// States of an orbit at equal phases, its nodes among them.
fn states(system: &System, solution: &PeriodicSolution) -> Result<Vec<Vec<f64>>, Failed> {
    let (periods, segments) = (solution.period_multiple as usize, solution.nodes.len());
    let parts = (PER_PERIOD * periods).div_ceil(segments);
    let phase = |k: usize| solution.phase + (periods * k) as f64 / (segments * parts) as f64;
    let settings = GeneralSettings::with_tolerance(SIZE).state_only();
    let mut states = Vec::with_capacity(segments * parts);
    for (k, node) in solution.nodes.iter().enumerate() {
        states.push(node.clone());
        if parts > 1 {
            let inner: Vec<f64> = (1..parts).map(|part| phase(k * parts + part)).collect();
            let (start, end) = (phase(k * parts), inner[parts - 2]);
            let stretch = Stretch { frequency_hz: solution.frequency_hz, start, end };
            states.extend(sample(system, &stretch, node, &inner, &settings).map_err(Failed::Motion)?);
        }
    }
    Ok(states)
}

fn distance(a: &[f64], b: Option<&[f64]>, scales: &[f64]) -> f64 {
    let part = |i: usize| (a[i] - b.map_or(0.0, |b| b[i])) / scales[i];
    (0..a.len()).map(|i| part(i).powi(2)).sum::<f64>().sqrt()
}

/// Follows the motion from the first node over the whole orbit, and compares it with the others on the way.
pub(super) fn recompute(
    (system, response): (&System, &Response),
    solution: &PeriodicSolution,
    scales: &[f64],
    settings: &GeneralSettings,
) -> Result<Recomputed, Failed> {
    let (size, segments) = (scales.len(), solution.nodes.len());
    let response = (response.shape.as_slice(), response.support_ratios.as_slice());
    let mut settings = *settings;
    let (mut state, mut product) = (solution.nodes[0].clone(), Mat::<f64>::identity(size, size));
    let (mut residual, mut largest) = (0.0_f64, 0.0_f64);
    let mut joined: Option<Observed> = None;
    for k in 0..segments {
        let periods = f64::from(solution.period_multiple);
        let phase = |k: usize| solution.phase + periods * k as f64 / segments as f64;
        let stretch = Stretch { frequency_hz: solution.frequency_hz, start: phase(k), end: phase(k + 1) };
        let observed = observe(system, &stretch, &state, response, &settings).map_err(Failed::Motion)?;
        settings.first_step = Some(observed.next_step);
        state.clone_from(&observed.flow.state);
        let matrix = &observed.flow.by_state;
        product = Mat::from_fn(size, size, |i, j| matrix[(i, j)] / scales[i] * scales[j]) * &product;
        let gain = norm(&product);
        let next = &solution.nodes[(k + 1) % segments];
        let observed = with_turns(system, (solution.frequency_hz, phase(k + 1)), next, observed);
        let miss = distance(&state, Some(next), scales);
        residual = residual.max(miss / (1.0 + gain));
        largest = largest.max(gain);
        joined = Some(match joined {
            None => observed,
            Some(earlier) => join(earlier, observed),
        });
    }
    let observed = joined.ok_or(Failed::Nodes)?;
    let multipliers = spectrum(&product).ok_or(Failed::Spectrum)?;
    Ok(Recomputed {
        residual,
        gain: 1.0 + largest,
        monodromy: product,
        multipliers,
        maxima: OrbitMaxima {
            displacement: observed.displacement,
            acceleration: observed.acceleration,
            contact_force: observed.contact_force,
            impact_velocity: observed.impact_velocity,
            impulse: observed.impulse,
            contacts: observed.contacts(),
        },
        extrema: observed.extrema,
        kinks: observed.kinks,
        touches: observed.touches,
        of_elements: observed.of_elements,
    })
}

/// A motion with the extrema of penetrations that lie at its end, where the orbit goes on from its next node:
/// in rounding, the velocities have one sign before that node and the other behind it, and neither stretch
/// has the change of sign. So it is where a motion without damping grazes in phase with its load.
fn with_turns(
    system: &System,
    (frequency_hz, phase): (f64, f64),
    next: &[f64],
    mut observed: Observed,
) -> Observed {
    for (number, element) in system.elements().iter().enumerate() {
        let [r, before, _] = system.contact_motion(number, frequency_hz, phase, &observed.flow.state);
        let [_, behind, _] = system.contact_motion(number, frequency_hz, phase, next);
        if (before > 0.0) == (behind > 0.0) {
            continue;
        }
        for contact in element.law.contacts() {
            let extremum = contact.sign * (r - contact.level);
            observed.extrema.push(extremum);
            observed.of_elements[number].meet(extremum);
        }
    }
    observed
}

fn join(earlier: Observed, later: Observed) -> Observed {
    Observed {
        displacement: earlier.displacement.max(later.displacement),
        acceleration: earlier.acceleration.max(later.acceleration),
        contact_force: earlier.contact_force.max(later.contact_force),
        impact_velocity: earlier.impact_velocity.max(later.impact_velocity),
        impulse: earlier.impulse + later.impulse,
        touches: [earlier.touches, later.touches].concat(),
        impacts: earlier
            .impacts
            .iter()
            .zip(&later.impacts)
            .map(|(a, b)| [a[0] + b[0], a[1] + b[1]])
            .collect(),
        closed_throughout: earlier.closed_throughout & later.closed_throughout,
        extrema: [earlier.extrema, later.extrema].concat(),
        kinks: [earlier.kinks, later.kinks].concat(),
        of_elements: earlier.of_elements.iter().zip(&later.of_elements).map(|(a, b)| a.joined(*b)).collect(),
        ..later
    }
}

/// `sqrt(2n) |A_m(z_0 + e d) - A_m(z_0)| / e` for a change of the first node by `e` in norm, along a
/// direction that has all modes in it: along the worst direction the change is about `sqrt(2n)` times that
/// along any one. The larger one of both signs; that of the one from which a motion can start, where the
/// other leads into a contact of an impact-speed-dependent law.
pub(super) fn sensitivity(
    observed: (&System, &Response),
    solution: &PeriodicSolution,
    scales: &[f64],
    (found, change): (&Recomputed, f64),
    settings: &GeneralSettings,
) -> Result<f64, Failed> {
    let each = change / (scales.len() as f64).sqrt();
    // Beside a border at which the motion changes its kind, the way towards it matters more than the way
    // back.
    let (mut largest, mut one_is_within) = (0.0_f64, false);
    for side in [each, -each] {
        let mut changed = solution.clone();
        for (i, (entry, scale)) in changed.nodes[0].iter_mut().zip(scales).enumerate() {
            *entry += if i % 2 == 0 { side * scale } else { -side * scale };
        }
        let other = match recompute(observed, &changed, scales, settings) {
            Err(Failed::Motion(GeneralError::StartsInContact { .. })) if !one_is_within => {
                one_is_within = true;
                continue;
            }
            other => other?,
        };
        largest = largest.max(norm(&(&other.monodromy - &found.monodromy)));
    }
    Ok(largest / each)
}
