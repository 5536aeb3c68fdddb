//! What is known of an event: how closely it was located, which multiplier it belongs to, and in which
//! direction the motion changes there.
//!
//! With the uncertainty `s` of the place along the path, the tangent's frequency component `t_f` and its
//! change `k` per length, the frequency is uncertain by `s |t_f| + k s^2 / 2`, and by no less than its last
//! digit.
//!
//! A grazing is where the least clearance, penetration or touch speed of the motion vanishes, and that is
//! known no better than the motion, however narrow a bracket of the change of contacts is. So its `s` is no
//! less than `e/|g'|`: g is that quantity relative to what the orbit's scale gives the element, e what is not
//! known of it. With the tolerance of the steps, ten of which a period is given, e is ten tolerances and the
//! response of the orbit to as much of a closure error, with the correction that was still due; `g' = g_1/c`
//! with its value `g_1` at the point before, the chord c away.
//!
//! A grazing of a rigid stop that was computed as a corner (`corner/`) brings its uncertainty along.
//!
//! The direction is the null vector of `A - mu I` (`A` the monodromy matrix, `mu` the multiplier at +1, -1 or
//! on the unit circle), found by inverse iteration. At a branch point it is the tangent of the crossing
//! branch: the vector that `[R_x R_f]` maps to zero besides the tangent `t` of the present branch. There the
//! bordered matrix `[R_x R_f; (W t)^T]` is nearly singular, and its inverse applied to anything points into
//! that direction.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{ContinuationPoint, DenseLu, PathProblem, norm, weighed};

use crate::shooting::ShootingProblem;

/// Relative frequency to which an event counts as located.
const SHARP_FREQUENCY: f64 = 1e-8;
/// Distance of the critical multiplier from its place that a located fold, flip or Neimark-Sacker point may
/// have.
const SHARP_MULTIPLIER: f64 = 1e-5;
/// An orbit this close to its mirror image, relative to the orbit, is that: along the direction in which a
/// branch crosses, an orbit is known to the root of the tolerance only.
const MIRRORED: f64 = 1e-3;
/// Error of the motion over a period, in tolerances of its steps.
const MOTION: f64 = 10.0;
/// So often a matrix that cannot be inverted is shifted; what still cannot be is not finite.
const MOST_SHIFTS: u32 = 8;

/// How well an event was located.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventStatus {
    /// To 1e-8 in frequency, relative, with the multiplier in its place.
    Located,
    /// Only within [`LocatedEvent::uncertainty`], or with a multiplier that jumps over its place (at a corner
    /// of the branch).
    Bracketed,
}

/// A contact that appears or vanishes at grazing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContactChange {
    /// Which one, in the order of the elements and their contacts.
    pub contact: usize,
    /// Whether the orbit has it behind the event, in the direction of the walk.
    pub appears: bool,
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

/// What the walk knows of the points at and before the event.
pub(crate) struct Place<'a> {
    pub point: &'a ContinuationPoint,
    /// Change of the tangent's frequency component per length.
    pub bend: f64,
    /// To this length along the path the place of a corner is known.
    pub at_corners: f64,
    /// The contacts that change there.
    pub contacts: Vec<ContactChange>,
    /// Within which the parameter of a grazing is known that was computed as a corner; `None` where that was
    /// not.
    pub computed: Option<f64>,
    /// The point before, at which contacts came so near to a change; `None` where it is not known.
    pub before: Option<NearChange>,
}

impl<'a> Place<'a> {
    /// A place of which no more is known than itself, and within which the parameter is known, if that was
    /// computed.
    pub fn alone(point: &'a ContinuationPoint, computed: Option<f64>) -> Self {
        Self { point, bend: 0.0, at_corners: 0.0, contacts: Vec::new(), computed, before: None }
    }
}

/// How near the contacts of an orbit came to a change at the point before a grazing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearChange {
    /// Least clearance or penetration of a turn [m].
    pub clearance: f64,
    /// Least squared speed of a touch [m^2/s^2].
    pub squared_speed: f64,
    /// Length of the path from there to the grazing.
    pub chord: f64,
    /// Tolerance of the motion, and the correction that is still due at the grazing, relative to the orbit.
    pub errors: [f64; 2],
    /// Length along the path that a change of the orbit by its own size counts.
    pub unit: f64,
}

/// Describes the event at the point at which the problem was evaluated last; `None` if nothing happened
/// there. A corner of the path alone is none: the equations have a kink there, the motion has nothing.
pub(crate) fn describe(problem: &mut ShootingProblem, place: Place<'_>) -> Option<LocatedEvent> {
    let events = hammerbeam_path::PathEvents { corner: false, ..place.point.events };
    if !events.any() {
        return None;
    }
    let (multiplier, off) = critical(events, problem.multipliers().unwrap_or_default());
    let size = problem.parameter_size(&place.point.point);
    let uncertainty = match place.computed {
        Some(uncertainty) => uncertainty.max(f64::EPSILON * size),
        None => {
            let of_motion = if events.signature_change { of_motion(problem, &place) } else { 0.0 };
            uncertainty(&place, size, (off > SHARP_MULTIPLIER, of_motion))
        }
    };
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

/// Interval of the frequency, of this size, within which the event lies.
fn uncertainty(place: &Place<'_>, size: f64, (jumps, of_motion): (bool, f64)) -> f64 {
    // A multiplier jumps over its place at corners only.
    let at_corner = if jumps { place.at_corners } else { 0.0 };
    let along = place.point.uncertainty.max(at_corner).max(of_motion);
    let slope = place.point.tangent_parameter().abs();
    // The frequency itself is no better than its last digit.
    (along * slope + 0.5 * place.bend * along * along).max(f64::EPSILON * size)
}

/// Arc length within which a grazing lies as the motion is known, see the head of the file; 0 where nothing
/// is known of the point before.
fn of_motion(problem: &mut ShootingProblem, place: &Place<'_>) -> f64 {
    let Some(before) = place.before else { return 0.0 };
    let [displacement, speed] = contact_scale(problem);
    // What appears was a clearance or a penetration before, what vanishes a touch.
    let appears = place.contacts.iter().any(|change| change.appears);
    let vanishes = place.contacts.iter().any(|change| !change.appears);
    let of_turn = if appears { before.clearance / displacement } else { f64::INFINITY };
    let of_touch = if vanishes { before.squared_speed / (speed * speed) } else { f64::INFINITY };
    let nearness = of_turn.min(of_touch);
    if !(nearness > 0.0 && nearness.is_finite()) {
        return 0.0;
    }
    let closed = response_to_closure(problem, place.point).unwrap_or(0.0) / before.unit;
    let [tolerance, due] = before.errors;
    let unknown = MOTION * tolerance * (1.0 + closed) + due;
    (unknown * before.chord / nearness).min(before.chord)
}

/// Largest displacement and speed that the scale of the orbit gives an element.
fn contact_scale(problem: &ShootingProblem) -> [f64; 2] {
    let (scales, n) = (problem.scale().values(), problem.node_size() / 2);
    [&scales[..n], &scales[n..]].map(|scales| {
        let of_shape =
            |shape: &[f64]| shape.iter().zip(scales).map(|(phi, scale)| (phi * scale).abs()).sum::<f64>();
        problem.system().elements().iter().map(|element| of_shape(&element.shape)).fold(0.0, f64::max)
    })
}

/// Largest length by which a closure error of one moves the orbit, as two of them show.
fn response_to_closure(problem: &mut ShootingProblem, point: &ContinuationPoint) -> Option<f64> {
    let weights = problem.weights().to_vec();
    problem.factorise(&weighed(&weights, &point.tangent)).ok()?;
    let last = weights.len() - 1;
    let response = |sign: f64| {
        let mut vector: Vec<f64> = (0..weights.len()).map(|i| sign.powi(i as i32)).collect();
        vector[last] = 0.0;
        problem.solve(&mut vector);
        norm(&weights, &vector)
    };
    Some(response(1.0).max(response(-1.0)))
}

/// Whether an orbit of an odd number of periods is its own mirror image: after half of them the excitation
/// has changed its sign, and the state has.
fn is_symmetric(problem: &mut ShootingProblem, point: &ContinuationPoint) -> bool {
    if problem.period_multiple().is_multiple_of(2) {
        return false;
    }
    let (frequency_hz, start) = (problem.frequency(&point.point), problem.phase());
    let end = start + 0.5 * f64::from(problem.period_multiple());
    let state = problem.nodes(&point.point).swap_remove(0);
    let Ok(half) = problem.integrator().advance(&Stretch { frequency_hz, start, end }, &state) else {
        return false;
    };
    let mirrored: Vec<f64> = half.iter().map(|value| -value).collect();
    problem.scale().distance(&mirrored, &state) < MIRRORED
}

/// The contacts of which one orbit has more or fewer than the one before.
pub(crate) fn contact_changes(before: &[u32], after: &[u32]) -> Vec<ContactChange> {
    let counts = before.iter().zip(after).enumerate().filter(|(_, (before, after))| before != after);
    counts.map(|(contact, (before, after))| ContactChange { contact, appears: after > before }).collect()
}

/// Null vector of `A - mu I`, of the real part of `mu` and with its frequency zero, in states.
fn null_direction(problem: &ShootingProblem, [re, im]: [f64; 2]) -> Option<Vec<f64>> {
    let n = problem.node_size();
    let monodromy = problem.monodromy();
    // `[A - a I, b I; -b I, A - a I]` for a complex multiplier, which holds real and imaginary part apart.
    let blocks = if im == 0.0 { 1 } else { 2 };
    let width = blocks * n;
    let mut matrix = vec![0.0; width * width];
    for block in 0..blocks {
        for i in 0..n {
            let row = &mut matrix[(block * n + i) * width..(block * n + i + 1) * width];
            row[block * n..(block + 1) * n].copy_from_slice(&monodromy[i * n..(i + 1) * n]);
            row[block * n + i] -= re;
            if blocks == 2 {
                row[(1 - block) * n + i] = if block == 0 { im } else { -im };
            }
        }
    }
    let vector = null_vector(width, matrix)?;
    let largest = vector[..n].iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let scaled = vector[..n].iter().zip(problem.scale().values());
    let direction: Vec<f64> = scaled.map(|(v, scale)| v * scale * largest.signum()).chain([0.0]).collect();
    direction.iter().all(|value| value.is_finite()).then_some(direction)
}

/// Null vector of a matrix that is singular to rounding, by inverse iteration, of length one; `None` if the
/// matrix is not finite.
fn null_vector(width: usize, mut matrix: Vec<f64>) -> Option<Vec<f64>> {
    let largest = matrix.iter().fold(1.0_f64, |largest, entry| largest.max(entry.abs()));
    let mut lu = DenseLu::new();
    let mut shifts = 0;
    while lu.factorise(width, &matrix).is_err() {
        if shifts == MOST_SHIFTS {
            return None;
        }
        // Singular to the last bit: an inverse needs it a little off, by what the largest entries do not
        // round away.
        (0..width).for_each(|i| matrix[i * width + i] += 1e-14 * largest);
        shifts += 1;
    }
    let mut vector = vec![1.0; width];
    for _ in 0..3 {
        lu.solve(&mut vector);
        let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|v| *v /= length);
    }
    Some(vector)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// `[3 s, s; 6 s, 2 s]` has the null vector `(1, -3)`; for a large s a shift by 1e-14 would be rounded
    /// away.
    #[test]
    fn null_vector_of_an_exactly_singular_matrix_of_large_entries_is_found() {
        for size in [1e-3, 1.0, 4096.0, 1e9] {
            let vector =
                null_vector(2, vec![3.0 * size, size, 6.0 * size, 2.0 * size]).expect("it is finite");
            assert!((vector[1] / vector[0] + 3.0).abs() < 1e-9, "{vector:?} at {size}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_no_null_vector() {
        assert_eq!(null_vector(2, vec![f64::NAN, 1.0, 1.0, 1.0]), None);
    }
}
