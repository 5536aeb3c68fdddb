//! Test functions of the stability of an orbit, from its Floquet multipliers `mu_i`.
//! Equation (P7) of the book, `docs/theory`.
//!
//! Along a smooth arc the multipliers are continuous, and they leave the unit circle in three ways: at +1 (a
//! fold or branch point, which the path itself finds), at -1 (*flip*), and as a complex pair
//! (*Neimark-Sacker*).
//!
//! - Flip: `prod (1 + mu_i)`, which is smooth even where multipliers meet; its sign equals `(-1)^k`, `k` the
//!   number of real `mu_i < -1`.
//! - Fold: the same with `1 - mu_i`, for curves in two parameters.
//! - Neimark-Sacker: `min |1 - |mu|^2|` over the complex pairs, with the sign of `(-1)^k`, `k` the number of
//!   pairs outside. Where a pair outside the circle becomes two real multipliers the sign jumps without a
//!   zero, which is no event ([`one_turns_real`]).
//!
//! A pair that leaves the circle and turns real between two points escapes all three; the path counts how
//! many lie outside ([`outside`]).
//!
//! # Source
//! Kuznetsov, *Elements of Applied Bifurcation Theory* (2004), chapters 4 and 10.

use hammerbeam_path::{Outside, PathEvents, TestValue};

use crate::spectrum::Spectrum;

/// Distance from the unit circle, relative to the largest multiplier where that is beyond 1e6, within which
/// rounding and the tolerance of the motion leave the side open.
const ON_CIRCLE: f64 = 1e-7;

/// How far within the circle the line between two places outside has to come: a pair that keeps beside the
/// circle is not followed in steps below 0.09 rad for that.
const WITHIN: f64 = 1e-3;

/// Share of the way by the circle that is nearly all of it.
const NEARLY: f64 = 0.7;

/// How far from the real axis, as a multiple of what it is beyond the circle, a pair may be that is taken for
/// one that turns real: one beside the circle may have entered it before.
const AT_AXIS: f64 = 2.0;

/// The most that a distance from -1 counts in [`flip`].
pub(crate) const MOST_COUNTED: f64 = 1e3;

/// Vanishes where a multiplier is -1.
pub(crate) fn flip(multipliers: &[[f64; 2]]) -> TestValue {
    // Factors far from zero say nothing, and might overflow.
    let factor = |[re, im]: &[f64; 2]| (1.0 + re).hypot(*im).min(MOST_COUNTED);
    let count = multipliers.iter().filter(|[re, im]| *im == 0.0 && *re < -1.0).count() as u32;
    signed(multipliers.iter().map(factor).product(), count)
}

/// [`flip`] without so many of the multipliers at -1, those known best to be there first.
pub(crate) fn flip_without(spectrum: &Spectrum, left_out: u32) -> TestValue {
    let undecided = count(&spectrum.at_minus_one);
    TestValue { undecided, left_out, ..flip(&without_at_minus_one(spectrum, left_out)) }
}

/// [`neimark_sacker`] without so many of the complex pairs on the circle, those known best to be there first.
pub(crate) fn neimark_sacker_without(spectrum: &Spectrum, left_out: u32) -> TestValue {
    let on = spectrum.on_circle.iter().zip(&spectrum.multipliers);
    let undecided = on.filter(|(on, [_, im])| **on && *im > 0.0).count() as u32;
    TestValue { undecided, left_out, ..neimark_sacker(&without_pairs(spectrum, left_out)) }
}

/// The multipliers without so many of those at -1, those known best to be there first.
pub(crate) fn without_at_minus_one(spectrum: &Spectrum, left_out: u32) -> Vec<[f64; 2]> {
    let from_minus_one = |[re, im]: [f64; 2]| (1.0 + re).hypot(im);
    without(spectrum, (&spectrum.at_minus_one, |_| true), left_out, from_minus_one)
}

/// The multipliers without so many of the complex pairs on the circle, by the one in the upper half-plane,
/// those known best to be there first.
pub(crate) fn without_pairs(spectrum: &Spectrum, left_out: u32) -> Vec<[f64; 2]> {
    let is_pair = |[_, im]: [f64; 2]| im > 0.0;
    let off_circle = |[re, im]: [f64; 2]| (1.0 - re.hypot(im)).abs();
    without(spectrum, (&spectrum.on_circle, is_pair), left_out, off_circle)
}

/// The multipliers without so many of a kind: those marked first, in the order of their distances.
fn without(
    spectrum: &Spectrum,
    (marked, of_kind): (&[bool], impl Fn([f64; 2]) -> bool),
    left_out: u32,
    distance: impl Fn([f64; 2]) -> f64,
) -> Vec<[f64; 2]> {
    let multipliers = &spectrum.multipliers;
    let mut order: Vec<usize> = (0..multipliers.len()).filter(|&k| of_kind(multipliers[k])).collect();
    let nearness = |k: usize| (!marked[k], distance(multipliers[k]));
    order.sort_by(|&a, &b| {
        let ((a_off, a), (b_off, b)) = (nearness(a), nearness(b));
        a_off.cmp(&b_off).then(a.total_cmp(&b))
    });
    order.truncate(left_out as usize);
    let kept = (0..multipliers.len()).filter(|k| !order.contains(k));
    kept.map(|k| multipliers[k]).collect()
}

fn count(marks: &[bool]) -> u32 {
    marks.iter().filter(|mark| **mark).count() as u32
}

/// Vanishes where a multiplier is +1.
pub(crate) fn fold(multipliers: &[[f64; 2]]) -> TestValue {
    let mirrored: Vec<[f64; 2]> = multipliers.iter().map(|[re, im]| [-re, *im]).collect();
    flip(&mirrored)
}

/// The multiplier that is nearest to +1, and the others.
pub(crate) fn nearest_to_one(multipliers: &[[f64; 2]]) -> Option<([f64; 2], Vec<[f64; 2]>)> {
    let mut others = multipliers.to_vec();
    let nearest = remove_least(&mut others, from_one)?;
    Some((nearest, others))
}

fn from_one([re, im]: &[f64; 2]) -> f64 {
    (re - 1.0).hypot(*im)
}

/// Vanishes where a complex pair lies on the unit circle.
pub(crate) fn neimark_sacker(multipliers: &[[f64; 2]]) -> TestValue {
    let pairs = || multipliers.iter().filter(|[_, im]| *im > 0.0).map(|[re, im]| re * re + im * im);
    let count = pairs().filter(|square| *square > 1.0).count() as u32;
    signed(pairs().map(|square| (1.0 - square).abs()).fold(1.0, f64::min), count)
}

/// [`ON_CIRCLE`] with what that says of large ones.
fn on_circle(multipliers: &[[f64; 2]]) -> f64 {
    let largest = multipliers.iter().map(|[re, im]| re.hypot(*im)).fold(1.0, f64::max);
    ON_CIRCLE * (1e-6 * largest).max(1.0)
}

/// The complex pairs by the one in the upper half-plane, but for those that are on the unit circle to
/// rounding.
pub(crate) fn pairs_off_circle(spectrum: &Spectrum) -> impl Iterator<Item = &[f64; 2]> {
    let margin = on_circle(&spectrum.multipliers);
    let marked = spectrum.multipliers.iter().zip(&spectrum.on_circle);
    let off = marked.filter(move |([re, im], on)| !**on && *im > 0.0 && (re.hypot(*im) - 1.0).abs() > margin);
    off.map(|(multiplier, _)| multiplier)
}

/// How far beyond the unit circle a multiplier lies.
fn beyond([re, im]: [f64; 2]) -> f64 {
    re.hypot(im) - 1.0
}

/// Whether complex pairs of multipliers cross the unit circle both ways between two neighbouring points,
/// given by those in the upper half-plane, so that as many lie outside behind as before: one leaves and
/// another one enters, or one that is outside at both points is inside half-way, as the line between them
/// shows. They are matched by their distances, the nearest two first.
pub(crate) fn pairs_cross_both_ways(before: &[[f64; 2]], behind: &[[f64; 2]]) -> bool {
    // Either way one lies outside on each side; pairing all of two hundred modes takes as long as the motion.
    if [before, behind].iter().any(|side| side.iter().all(|pair| beyond(*pair) <= ON_CIRCLE)) {
        return false;
    }
    let (mut leaves, mut enters) = (false, false);
    for (from, to) in nearest_first(before, behind) {
        let outside = beyond(from) > ON_CIRCLE && beyond(to) > ON_CIRCLE;
        if outside && beyond(nearest_to_zero(from, to)) < -WITHIN {
            return true;
        }
        leaves |= beyond(from) < -ON_CIRCLE && beyond(to) > ON_CIRCLE;
        enters |= beyond(from) > ON_CIRCLE && beyond(to) < -ON_CIRCLE;
    }
    leaves && enters
}

/// Whether there is one complex pair of multipliers more outside the unit circle at one of two neighbouring
/// points than at the other, which is nearer to the real axis than by [`AT_AXIS`] of what it is beyond the
/// circle, and none of those on the same side at both has touched it. They are matched by their distances,
/// the nearest two first. One has touched it if it has gone nearly as far as by the circle.
///
/// * `before`, `behind`: the pairs by those in the upper half-plane.
pub(crate) fn one_turns_real(before: &[[f64; 2]], behind: &[[f64; 2]]) -> bool {
    let keeps_away = |&(from, to): &([f64; 2], [f64; 2])| {
        let way = (to[0] - from[0]).hypot(to[1] - from[1]);
        way < NEARLY * (beyond(from).abs() + beyond(to).abs())
    };
    let on_side = |outside: bool| {
        let of = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
            all.iter().copied().filter(|pair| (beyond(*pair) > 0.0) == outside).collect()
        };
        [of(before), of(behind)]
    };
    let ([from, to], [inside_from, inside_to]) = (on_side(true), on_side(false));
    let (outside, inside) = (nearest_first(&from, &to), nearest_first(&inside_from, &inside_to));
    let has_no_other = |pair: &&[f64; 2]| outside.iter().all(|(a, b)| a != *pair && b != *pair);
    let mut alone = from.iter().chain(&to).filter(has_no_other);
    let is_at_axis = alone.next().is_some_and(|pair| pair[1] < AT_AXIS * beyond(*pair));
    is_at_axis && alone.next().is_none() && outside.iter().chain(&inside).all(keeps_away)
}

/// The point nearest to zero of the line between two.
fn nearest_to_zero(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0] * way[0] + way[1] * way[1];
    let share = -(from[0] * way[0] + from[1] * way[1]) / length.max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    [from[0] + share * way[0], from[1] + share * way[1]]
}

/// Each of the first kind with one of the second, those nearest to each other first.
fn nearest_first(left: &[[f64; 2]], right: &[[f64; 2]]) -> Vec<([f64; 2], [f64; 2])> {
    let distance = |(a, b): (usize, usize)| (left[a][0] - right[b][0]).hypot(left[a][1] - right[b][1]);
    let places = (0..left.len()).flat_map(|a| (0..right.len()).map(move |b| (a, b)));
    let mut places: Vec<(f64, usize, usize)> = places.map(|(a, b)| (distance((a, b)), a, b)).collect();
    places.sort_by(|one, other| one.0.total_cmp(&other.0));
    let (mut left_is_free, mut right_is_free) = (vec![true; left.len()], vec![true; right.len()]);
    let mut pairs = Vec::new();
    for (_, a, b) in places {
        if left_is_free[a] && right_is_free[b] {
            (left_is_free[a], right_is_free[b]) = (false, false);
            pairs.push((left[a], right[b]));
        }
    }
    pairs
}

/// Whether the complex pair nearest to the unit circle is nearer to the real axis, or is there already:
/// [`neimark_sacker`] jumps there, since the pair becomes two real multipliers, and does not vanish.
pub(crate) fn pair_turns_real(multipliers: &[[f64; 2]]) -> bool {
    let off_circle = |[re, im]: &[f64; 2]| (1.0 - re.hypot(*im)).abs();
    let pairs = multipliers.iter().filter(|[_, im]| *im > 0.0);
    let nearest = pairs.min_by(|a, b| off_circle(a).total_cmp(&off_circle(b)));
    nearest.is_none_or(|pair| pair[1] < off_circle(pair))
}

/// Whether the multiplier nearest to +1 is one of a complex pair. At a branch point it is real: beside one
/// this is the pair that becomes real there, as well as it is known, and does not cross the circle elsewhere.
pub(crate) fn pair_is_nearest_to_one(multipliers: &[[f64; 2]]) -> bool {
    let nearest = multipliers.iter().min_by(|a, b| from_one(a).total_cmp(&from_one(b)));
    nearest.is_some_and(|[_, im]| *im != 0.0)
}

/// How many multipliers lie outside the circle, without those that are critical at these events of a path
/// with the test functions [`flip`] and [`neimark_sacker`] in this order.
pub(crate) fn outside(spectrum: &Spectrum, events: PathEvents) -> Outside {
    let multipliers = &spectrum.multipliers;
    let margin = on_circle(multipliers);
    // Those on the circle as well as they are known are so by the margin, too.
    let marked = multipliers.iter().zip(&spectrum.on_circle);
    let mut left: Vec<[f64; 2]> =
        marked.map(|(multiplier, on)| if *on { onto_circle(*multiplier) } else { *multiplier }).collect();
    let off_circle =
        |[re, im]: &[f64; 2]| if *im == 0.0 { f64::INFINITY } else { (re.hypot(*im) - 1.0).abs() };
    if events.fold || events.branch_point {
        remove_least(&mut left, from_one);
    }
    if events.zeros & 1 != 0 {
        remove_least(&mut left, |[re, im]| (re + 1.0).hypot(*im));
    }
    if events.zeros & 2 != 0 {
        remove_least(&mut left, off_circle);
        remove_least(&mut left, off_circle);
    }
    let critical = (multipliers.len() - left.len()) as u32;
    let beyond = |least: f64| left.iter().filter(|[re, im]| re.hypot(*im) > least).count() as u32;
    Outside { least: beyond(1.0 + margin), most: beyond(1.0 - margin) + critical, critical }
}

/// The point of the unit circle beside a multiplier.
fn onto_circle([re, im]: [f64; 2]) -> [f64; 2] {
    let modulus = re.hypot(im);
    [re / modulus, im / modulus]
}

/// Removes the multiplier with the least distance; `None` of none.
fn remove_least(multipliers: &mut Vec<[f64; 2]>, distance: impl Fn(&[f64; 2]) -> f64) -> Option<[f64; 2]> {
    let numbered = multipliers.iter().enumerate();
    let (index, _) = numbered.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    Some(multipliers.remove(index))
}

fn signed(magnitude: f64, count: u32) -> TestValue {
    TestValue::sign_change(if count.is_multiple_of(2) { magnitude } else { -magnitude }, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flip_function_vanishes_at_minus_one_and_counts_beyond_it() {
        assert_eq!(flip(&[[-1.0, 0.0], [0.5, 0.0]]).value, 0.0);
        let beyond = flip(&[[-3.0, 0.0], [0.5, 0.0]]);
        assert_eq!((beyond.value, beyond.count), (-3.0, 1));
        assert_eq!(fold(&[[3.0, 0.0], [0.5, 0.0]]), TestValue::sign_change(-1.0, 1));
        // A pair that meets at -1 + 0i touches zero from above on both sides.
        assert_eq!(flip(&[[-1.5, 0.0], [-1.5, 0.0]]), TestValue::sign_change(0.25, 2));
        assert!(flip(&[[-1.5, 0.1], [-1.5, -0.1]]).value > 0.25);
    }

    #[test]
    fn pairs_that_cross_the_circle_both_ways_are_distinguished_from_one_that_turns() {
        let (outside, inside) = ([-0.198, 1.003], [0.35, 0.77]);
        assert!(pairs_cross_both_ways(&[outside, inside], &[[0.06, 0.85], [0.326, 0.974]]));
        // The nearest to the first one is the second one before, which is nearer to another.
        assert!(pairs_cross_both_ways(&[[0.06, 0.84], [0.326, 0.974]], &[outside, [0.35, 0.765]]));
        assert!(!pairs_cross_both_ways(&[outside, inside], &[[0.06, 1.05], [0.326, 0.9]]));
        assert!(!pairs_cross_both_ways(&[outside], &[[0.06, 0.85]]), "the count shows that one");
        assert!(!pairs_cross_both_ways(&[], &[[0.06, 0.85], [0.326, 0.974]]));
        // Outside at both ends, by the inside.
        assert!(pairs_cross_both_ways(&[[0.77, 0.72]], &[[-0.653, 0.8785]]));
        assert!(!pairs_cross_both_ways(&[[0.77, 0.72]], &[[0.6, 0.86]]), "outside all the way");
        let beside = |angle: f64| [[1.00001 * angle.cos(), 1.00001 * angle.sin()]];
        assert!(!pairs_cross_both_ways(&beside(0.5), &beside(0.58)), "along the circle");
        // On the circle to rounding, as at the last event.
        assert!(!pairs_cross_both_ways(&[[0.6, 0.8 + 1e-9], inside], &[[0.5, 0.7], [0.326, 0.974]]));
    }

    #[test]
    fn one_pair_turns_real_if_the_others_keep_away_from_the_circle() {
        let (inside, outside, turning) = ([0.5, 0.3], [0.9, 1.2], [-3.0, 0.8]);
        assert!(one_turns_real(&[inside, outside, turning], &[[0.92, 1.18], [0.52, 0.33]]));
        assert!(one_turns_real(&[inside], &[turning, [0.52, 0.33]]), "it turns complex");
        assert!(one_turns_real(&[inside, [0.1, 0.2], turning], &[inside]), "another one does so inside");
        assert!(
            one_turns_real(&[inside, turning], &[inside, [0.1, 0.2]]),
            "another one turns complex inside"
        );
        assert!(!one_turns_real(&[inside, turning], &[[0.5, -0.3]]), "it may have been outside");
        assert!(!one_turns_real(&[[0.9, 1.2], turning], &[[-0.9, 1.2]]), "it may have been inside");
        assert!(!one_turns_real(&[inside, outside], &[outside]), "the one that lacks is inside");
        assert!(!one_turns_real(&[[-1.0, 0.06]], &[]), "it is beside the circle");
        assert!(!one_turns_real(&[outside, turning], &[]), "two of them");
        assert!(!one_turns_real(&[outside], &[[0.92, 1.18]]), "none");
    }

    #[test]
    fn the_neimark_sacker_function_vanishes_for_a_pair_on_the_circle_only() {
        let on = neimark_sacker(&[[0.6, 0.8], [0.6, -0.8]]).value;
        assert!(on.abs() < 1e-15, "{on}");
        assert_eq!(neimark_sacker(&[[0.0, 2.0], [0.0, -2.0]]), TestValue::sign_change(-1.0, 1));
        assert!(pair_turns_real(&[[1.016, 5e-4], [1.016, -5e-4], [0.2, 0.0]]));
        assert!(!pair_turns_real(&[[0.9999, 0.0141], [0.9999, -0.0141], [0.01, 0.0]]));
        assert!(pair_turns_real(&[[4.0, 0.0], [0.25, 0.0]]), "it is real");
        assert!(pair_is_nearest_to_one(&[[1.015, 0.018], [1.015, -0.018], [0.24, 0.0]]));
        assert!(!pair_is_nearest_to_one(&[[0.6, 0.8], [0.6, -0.8], [1.001, 0.0]]));
        // A real pair with product one is a neutral saddle, which is no bifurcation.
        assert_eq!(neimark_sacker(&[[4.0, 0.0], [0.25, 0.0]]), TestValue::sign_change(1.0, 0));
    }
}
