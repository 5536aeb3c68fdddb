//! What is known of an event: how closely it was located, which multiplier it belongs to, and in which
//! direction the motion changes there.
//!
//! The direction is the null vector of `A - mu I` (`A` the monodromy matrix, `mu` the multiplier at +1, -1 or
//! on the unit circle), found by inverse iteration. At a branch point it is the tangent of the crossing
//! branch: the vector that `[R_x R_f]` maps to zero besides the tangent `t` of the present branch. There the
//! bordered matrix `[R_x R_f; (W t)^T]` is nearly singular, and its inverse applied to anything points into
//! that direction.

mod event_location;
mod uncertainty;

use hammerbeam_path::{ContinuationPoint, PathProblem, norm, weighed};

use crate::{
    by_rows::shifted,
    floquet_vectors::null_vector,
    shooting::ShootingProblem,
    spectrum::Spectrum,
    stability::{without_at_minus_one, without_pairs},
};
pub use event_location::ContactChange;
pub(crate) use event_location::{Approach, EventLocation};

/// Relative frequency to which an event counts as located.
const SHARP_FREQUENCY: f64 = 1e-8;
/// Distance of the critical multiplier from its place that a located fold, flip or Neimark-Sacker point may
/// have.
pub(crate) const SHARP_MULTIPLIER: f64 = 1e-5;
/// An orbit this close to its mirror image, relative to the orbit, is that: along the direction in which a
/// branch crosses, an orbit is known to the root of the tolerance only.
const MIRRORED: f64 = 1e-3;

/// How well an event was located.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventStatus {
    /// To 1e-8 in frequency, relative, with the multiplier in its place.
    Located,
    /// Only within [`LocatedEvent::uncertainty`], or with a multiplier that jumps over its place (at a corner
    /// of the branch).
    Bracketed,
}

/// What is known of an event, beside the solution at it.
#[derive(Debug, Clone, PartialEq)]
pub struct LocatedEvent {
    /// How well it was located.
    pub status: EventStatus,
    /// Interval of the frequency within which it lies [Hz]; of the parameter that varies, in its unit, where
    /// that is not the frequency.
    pub uncertainty: f64,
    /// The multiplier that is critical, `[re, im]`, the one with positive imaginary part of a pair; none at
    /// mere grazing.
    pub multiplier: Option<[f64; 2]>,
    /// Critical direction of the first node, `[q; q']` and the frequency [Hz], length 2n + 1, of norm one
    /// relative to the orbit; at a Neimark-Sacker point its real part. Empty where there is none.
    pub direction: Vec<f64>,
    /// The contacts that change at grazing: of a symmetric orbit two at once.
    pub contacts: Vec<ContactChange>,
    /// Whether an orbit that is its own mirror image after half its period, `z(t + NT/2) = -z(t)`, loses that
    /// on the crossing branch.
    pub breaks_symmetry: bool,
}

impl LocatedEvent {
    /// The event as it is passed the other way: what appeared vanishes.
    #[must_use]
    pub fn backwards(mut self) -> Self {
        self.contacts.iter_mut().for_each(|change| change.appears = !change.appears);
        self
    }
}

/// Describes the event at the point at which the problem was evaluated last; `None` if nothing happened
/// there. A corner of the path alone is none: the equations have a kink there, the motion has nothing.
pub(crate) fn describe(problem: &mut ShootingProblem, place: EventLocation<'_>) -> Option<LocatedEvent> {
    let events = hammerbeam_path::PathEvents { corner: false, ..place.point.events };
    if !events.any() {
        return None;
    }
    let left_out = place.approach.as_ref().and_then(|approach| approach.test).map_or(0, |test| test.left_out);
    let kept = problem.spectrum().map(|spectrum| kept(spectrum, events, left_out)).unwrap_or_default();
    let (multiplier, off) = critical(events, &kept);
    let size = problem.parameter_size(&place.point.point);
    // The frequency itself is no better than its last digit.
    let uncertainty = place
        .computed
        .unwrap_or_else(|| uncertainty::of_place(problem, &place, (multiplier, off > SHARP_MULTIPLIER)))
        .max(f64::EPSILON * size);
    let sharp = uncertainty <= SHARP_FREQUENCY * size && off <= SHARP_MULTIPLIER;
    let direction = if events.branch_point {
        crossing_direction(problem, place.point)
    } else {
        multiplier.and_then(|multiplier| null_direction(problem, multiplier))
    };
    Some(LocatedEvent {
        status: if sharp { EventStatus::Located } else { EventStatus::Bracketed },
        uncertainty,
        multiplier,
        direction: direction.unwrap_or_default(),
        breaks_symmetry: events.branch_point && is_symmetric(problem, place.point),
        contacts: place.contacts,
    })
}

/// The multipliers without those that stay at the place of an event.
fn kept(spectrum: &Spectrum, events: hammerbeam_path::PathEvents, left_out: u32) -> Vec<[f64; 2]> {
    match events.zeros {
        0 => spectrum.multipliers.clone(),
        zeros if zeros & 1 != 0 => without_at_minus_one(spectrum, left_out),
        _ => without_pairs(spectrum, left_out),
    }
}

/// The multiplier that makes an event, and its distance from its place, squared at a mere branch point; none
/// at mere grazing.
fn critical(events: hammerbeam_path::PathEvents, multipliers: &[[f64; 2]]) -> (Option<[f64; 2]>, f64) {
    let distance: fn(&[f64; 2]) -> f64 = if events.zeros & 1 != 0 {
        |[re, im]| (1.0 + re).hypot(*im)
    } else if events.zeros & 2 != 0 {
        |[re, im]| if *im > 0.0 { (1.0 - re.hypot(*im)).abs() } else { f64::INFINITY }
    } else if events.fold || events.branch_point {
        |[re, im]| (1.0 - re).hypot(*im)
    } else {
        return (None, 0.0);
    };
    let nearest = multipliers.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let off = nearest.map_or(f64::INFINITY, distance);
    // A branch point is known to the root of the tolerance, and its multiplier no better.
    (nearest.copied(), if events.zeros == 0 && events.branch_point { off * off } else { off })
}

/// Whether an orbit is its own mirror image.
fn is_symmetric(problem: &mut ShootingProblem, point: &ContinuationPoint) -> bool {
    let mirrored = MIRRORED * problem.length_per_norm();
    problem.has_symmetric_orbits() && problem.distance_to_symmetric(&point.point) < mirrored
}

/// The contacts of which one orbit has more or fewer than the one before.
pub(crate) fn contact_changes(before: &[u32], after: &[u32]) -> Vec<ContactChange> {
    let counts = before.iter().zip(after).enumerate().filter(|(_, (before, after))| before != after);
    counts.map(|(contact, (before, after))| ContactChange { contact, appears: after > before }).collect()
}

/// Null vector of `A - mu I`, of the real part of `mu` and with its frequency zero, in states.
fn null_direction(problem: &ShootingProblem, place: [f64; 2]) -> Option<Vec<f64>> {
    let n = problem.node_size();
    let matrix = shifted(n, problem.monodromy(), place);
    let vector = null_vector(matrix.len().isqrt(), matrix)?;
    let largest = vector[..n].iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let scaled = vector[..n].iter().zip(problem.scale().values());
    let direction: Vec<f64> = scaled.map(|(v, scale)| v * scale * largest.signum()).chain([0.0]).collect();
    direction.iter().all(|value| value.is_finite()).then_some(direction)
}

/// Direction in which the other branch leaves a branch point, orthogonal to the present one.
fn crossing_direction(problem: &mut ShootingProblem, point: &ContinuationPoint) -> Option<Vec<f64>> {
    let weights = problem.weights().to_vec();
    problem.factorise(&weighed(&weights, &point.tangent)).ok()?;
    let last = weights.len() - 1;
    let mut vector = vec![1.0; weights.len()];
    for _ in 0..3 {
        vector[last] = 0.0;
        problem.solve(&mut vector);
        let length = norm(&weights, &vector);
        vector.iter_mut().for_each(|v| *v /= length);
    }
    let first = vector[..problem.node_size()].iter().zip(problem.scale().values());
    let direction: Vec<f64> = first.map(|(v, scale)| v * scale).chain([vector[last]]).collect();
    direction.iter().all(|value| value.is_finite()).then_some(direction)
}
