//! How closely the place of an event is known.
//!
//! With the uncertainty `s` of the place along the path, the tangent's frequency component `t_f` and its
//! change `k` per length, the frequency is uncertain by `s |t_f| + k s^2 / 2`. A search for the place leaves
//! a bracket of it. But what is searched for is known no better than the motion, however narrow the bracket
//! is. With the tolerance t of the steps, ten of which a period is given:
//!
//! * A grazing is where the least clearance, penetration or touch speed of the motion vanishes. Its `s` is no
//!   less than `e/|g'|`: g is that quantity relative to what the orbit's scale gives the element, e what is
//!   not known of it, `10 t` and the response of the orbit to as much of a closure error, with the correction
//!   that was still due; `g' = g_1/c` with its value `g_1` at the point before, the chord c away.
//! * A flip or Neimark-Sacker point is where a multiplier reaches -1 or the unit circle. The monodromy
//!   matrix is known to an error ([`known_matrix`](crate::known_matrix)), with which the multiplier may lie
//!   as far off as that moves it, by `d`; `d` counts also how far the search left it from its place. The test
//!   function `g` of these points is a product of factors, of which the critical one goes with the
//!   multiplier: `s` is no less than `d |dg/dm| c/|g_1|`. A factor below d, as of a pair that meets there,
//!   counts as d.
//! * A branch point is where a real multiplier reaches +1. With the product g of `1 - m` over all
//!   multipliers, for which the point before is asked, the frequency is uncertain by
//!   `d |dg/dm| |f_1 - f|/|g_1|` on the branch that is left, and by twice that on an arm of a pitchfork,
//!   along which the frequency is stationary: there `1 - m` goes with the frequency twice as quickly. Twice
//!   it is for both.
//! * At a fold a real multiplier reaches +1, too. With the same product g it is `s` that is no less than
//!   `d |dg/dm| c/|g_1|`, but at a corner, where the multiplier jumps. The frequency is stationary there; it
//!   moves with the motion besides, by `10 t` times the response of the frequency to a closure error.
//!
//! A grazing of a rigid stop that was computed as a corner (`corner/`) brings its uncertainty along.

use hammerbeam_path::{PathProblem, norm, weighed};

use super::event_location::{Approach, EventLocation};
use crate::{
    shooting::ShootingProblem,
    stability::{MOST_COUNTED, nearest_to_one, without_at_minus_one},
};

/// Error of the motion over a period, in tolerances of its steps.
const MOTION: f64 = 10.0;
/// On an arm of a pitchfork the multiplier goes with the frequency so many times as quickly as on the branch
/// from which the arm leaves.
const ARM: f64 = 2.0;

/// Interval of the frequency, or of what varies, within which an event lies.
///
/// * `multiplier`: that which makes it, and whether it does not lie in its place.
pub(super) fn of_place(
    problem: &mut ShootingProblem,
    place: &EventLocation<'_>,
    (multiplier, jumps): (Option<[f64; 2]>, bool),
) -> f64 {
    // A multiplier jumps over its place at corners only.
    let at_corner = if jumps { place.at_corners } else { 0.0 };
    let (mut along, mut itself) = (place.point.uncertainty.max(at_corner), 0.0);
    if let Some(approach) = &place.approach {
        let events = place.point.events;
        if events.branch_point && !events.signature_change {
            itself = of_branch_point(problem, place, approach);
        }
        if events.signature_change {
            along = along.max(of_contacts(problem, place, approach));
        }
        if let Some(multiplier) = multiplier.filter(|_| events.zeros != 0 && !jumps) {
            along = along.max(of_multiplier(problem, approach, (events.zeros, multiplier)));
        }
        if events.fold && !events.branch_point && !events.signature_change {
            if !events.corner {
                along = along.max(of_unit_multiplier(problem, place, approach, approach.chord));
            }
            let [tolerance, _] = approach.errors;
            let moved = response_to_closure(problem, place);
            itself = moved.map_or(approach.chord, |moved| MOTION * tolerance * moved.parameter);
        }
    }
    let bend = place.approach.as_ref().map_or(0.0, |approach| approach.bend);
    along * place.point.tangent_parameter().abs() + 0.5 * bend * along * along + itself
}

/// Arc length within which a grazing lies.
fn of_contacts(problem: &mut ShootingProblem, place: &EventLocation<'_>, approach: &Approach) -> f64 {
    let Some([clearance, squared_speed]) = approach.near else { return 0.0 };
    let [displacement, speed] = contact_scale(problem);
    // What appears was a clearance or a penetration before, what vanishes a touch.
    let appears = place.contacts.iter().any(|change| change.appears);
    let vanishes = place.contacts.iter().any(|change| !change.appears);
    let of_turn = if appears { clearance / displacement } else { f64::INFINITY };
    let of_touch = if vanishes { squared_speed / (speed * speed) } else { f64::INFINITY };
    let nearness = of_turn.min(of_touch);
    if !(nearness > 0.0 && nearness.is_finite()) {
        return 0.0;
    }
    let closed = response_to_closure(problem, place).map_or(0.0, |moved| moved.all) / approach.unit;
    let [tolerance, due] = approach.errors;
    let unknown = MOTION * tolerance * (1.0 + closed) + due;
    (unknown * approach.chord / nearness).min(approach.chord)
}

/// Arc length within which a flip or Neimark-Sacker point with this multiplier lies.
fn of_multiplier(
    problem: &mut ShootingProblem,
    approach: &Approach,
    (zeros, multiplier): (u32, [f64; 2]),
) -> f64 {
    let Some(test) = approach.test else { return approach.chord };
    let [re, im] = multiplier;
    let off = problem.reach_of(multiplier) + (1.0 - re.hypot(im)).abs();
    // Of a pair the function is `1 - |m|^2`.
    let is_flip = zeros & 1 != 0;
    let change = match problem.spectrum() {
        Ok(spectrum) if is_flip => distances(&without_at_minus_one(spectrum, test.left_out + 1), -1.0, off),
        Ok(_) => 2.0,
        Err(_) => return approach.chord,
    };
    share_of(approach, off * change, test.value)
}

/// Interval of the frequency within which a branch point lies.
fn of_branch_point(problem: &mut ShootingProblem, place: &EventLocation<'_>, approach: &Approach) -> f64 {
    let before = approach.before.as_ref().and_then(|before| before.last());
    before.map_or(approach.chord, |before| {
        let way = (before - place.point.parameter()).abs();
        of_unit_multiplier(problem, place, approach, ARM * way)
    })
}

/// The part of a way from the point before within which a multiplier is +1, by the motion at both points.
fn of_unit_multiplier(
    problem: &mut ShootingProblem,
    place: &EventLocation<'_>,
    approach: &Approach,
    way: f64,
) -> f64 {
    let nearest = problem.spectrum().ok().and_then(|spectrum| nearest_to_one(&spectrum.multipliers));
    let (Some(before), Some((multiplier, others))) = (&approach.before, nearest) else {
        return approach.chord;
    };
    let off = problem.reach_of(multiplier) + (1.0 - multiplier[0]).hypot(multiplier[1]);
    let test = problem.evaluate(before).ok().and_then(|()| {
        let spectrum = problem.spectrum().ok()?;
        Some(distances(&spectrum.multipliers, 1.0, 0.0))
    });
    // The motion at the event is asked for next.
    let returned = problem.evaluate(&place.point.point);
    match test {
        Some(test) if returned.is_ok() => {
            let slope = way / test.max(f64::MIN_POSITIVE);
            (off * distances(&others, 1.0, off) * slope).min(approach.chord)
        }
        _ => approach.chord,
    }
}

/// Product of the distances of multipliers from a place, each no less than this, and no more than test
/// functions count.
fn distances(multipliers: &[[f64; 2]], place: f64, least: f64) -> f64 {
    multipliers.iter().map(|[re, im]| (re - place).hypot(*im).max(least).min(MOST_COUNTED)).product()
}

/// The part of the chord over which a test function with this value at its start changes by so much.
fn share_of(approach: &Approach, change: f64, test: f64) -> f64 {
    (change * approach.chord / test.abs().max(f64::MIN_POSITIVE)).min(approach.chord)
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

/// By what closure errors of the size of the orbit move it.
struct Moved {
    /// Length along and across the path.
    all: f64,
    /// The frequency, or what varies.
    parameter: f64,
}

/// The largest of what two closure errors move.
fn response_to_closure(problem: &mut ShootingProblem, place: &EventLocation<'_>) -> Option<Moved> {
    let weights = problem.weights().to_vec();
    problem.factorise(&weighed(&weights, &place.point.tangent)).ok()?;
    let last = weights.len() - 1;
    let responses = [1.0_f64, -1.0].map(|sign| {
        let mut vector: Vec<f64> = (0..weights.len()).map(|i| sign.powi(i as i32)).collect();
        vector[last] = 0.0;
        problem.solve(&mut vector);
        [norm(&weights, &vector), vector[last].abs()]
    });
    let largest = |what: usize| responses[0][what].max(responses[1][what]);
    Some(Moved { all: largest(0), parameter: largest(1) })
}
