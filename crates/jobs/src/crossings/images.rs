//! Mirror images of branches, which follow from a symmetry without computing.
//!
//! Where `q(t) -> -q(t + T/2)` takes motions to motions, the image of a branch is one, with the same
//! frequencies, maxima, multipliers and events. It is the branch itself where its orbits are symmetric, or
//! where the branch comes through a symmetric orbit to the images of its own; else it is another one, which a
//! run may have met, or not.

use hammerbeam_attractor::{distance, state_scales};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings};
use hammerbeam_orbit::{PeriodicSolution, mirror_image, states_at_phase};
use hammerbeam_study::Model;

/// Distance of a motion from an orbit of a branch, relative to it, up to which they are the same.
pub(super) const SAME: f64 = 1e-4;

/// Where the mirror image of a branch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MirrorImage {
    /// The branch is its own image.
    Itself,
    /// Another branch holds it.
    Branch(u32),
    /// No branch holds it: it is given by this one.
    Given,
}

/// An orbit and its states at phase 0.
pub(super) struct Placed {
    pub branch: u32,
    pub states: Vec<Vec<f64>>,
}

/// Adds the images that none of the orbits at a frequency is, under the numbers of the branches that they are
/// images of.
pub(super) fn add_to(orbits: &mut Vec<(u32, PeriodicSolution)>, model: &Model) {
    let Some(mut integrator) = integrator(model) else { return };
    let mut states =
        |orbit: &PeriodicSolution| states_at_phase(&mut integrator, orbit, 0.0).unwrap_or_default();
    let mut placed: Vec<Placed> =
        orbits.iter().map(|(branch, orbit)| Placed { branch: *branch, states: states(orbit) }).collect();
    for (branch, orbit) in orbits.clone() {
        let Some((image, image_states)) = image_of(&orbit, model, &mut states) else { continue };
        if holder(&placed, &image_states, model, orbit.frequency_hz).is_none() {
            orbits.push((branch, image));
            placed.push(Placed { branch, states: image_states });
        }
    }
}

/// The image of an orbit and its states at phase 0, where it begins as other orbits do unless impacts let it
/// begin elsewhere.
fn image_of(
    orbit: &PeriodicSolution,
    model: &Model,
    states: &mut impl FnMut(&PeriodicSolution) -> Vec<Vec<f64>>,
) -> Option<(PeriodicSolution, Vec<Vec<f64>>)> {
    let image = mirror_image(orbit);
    let there = states(&image);
    let first = there.first()?.clone();
    let stays = model.system.remembers_impacts() || model.system.has_rigid_stops();
    let started = if stays { image } else { PeriodicSolution { phase: 0.0, nodes: vec![first], ..image } };
    Some((started, there))
}

/// The branch of which an orbit has one of these states.
pub(super) fn holder(
    placed: &[Placed],
    states: &[Vec<f64>],
    model: &Model,
    frequency_hz: f64,
) -> Option<u32> {
    let scales = state_scales(&model.system, frequency_hz);
    let same = |known: &&Placed| {
        known.states.len() == states.len()
            && known.states.iter().any(|a| states.iter().any(|b| distance(&scales, b, a) < SAME))
    };
    placed.iter().find(same).map(|known| known.branch)
}

pub(super) fn integrator(model: &Model) -> Option<ExactIntegrator> {
    ExactIntegrator::new(model.system.clone(), ExactSettings::default()).ok()
}
