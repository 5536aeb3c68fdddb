//! How a motion without a period comes back to where it was.
//!
//! With `D(n)` the mean distance of the states at the start of periods k and `k + n`:
//!
//! - A motion that still settles comes back closer and closer: `D(n)` falls from the first quarter of the
//!   periods to the last, for some n. Where little is left to fall within these periods, it falls by the same
//!   factor from each quarter to the next, for all n alike; on a torus the quarters differ either way.
//! - On a torus the map turns every angle by the same amount, so that the shift of n periods is a turn, and
//!   the shift of `3 n` periods three times that turn. Of many n one turns by little; there `D(3 n)` is about
//!   `3 D(n)`, whatever the shape of the torus and the speed along it, as a short way is gone three times. In
//!   chaos, in bands that are visited in a fixed order as well, the closest n keeps the order of the bands
//!   and says nothing of the place in them: `D(3 n)` is about `D(n)`.
//! - But so does what creeps past an orbit, or towards one whose period is longer than those looked for: it
//!   goes a short way three times, too. What distinguishes it from a torus is that its last states lie at
//!   the end of what was visited: states of the past are behind them, and nothing is ahead. On a torus that
//!   was seen whole the last states fall between earlier ones, with neighbours on opposite sides. On one near
//!   a resonance, of which these periods show but a part, the way of n periods is as long at the end as at
//!   the start, where it grows or falls beside an orbit.

use crate::settle::{REPEATED, distance};

/// Part to which returns may fall on a torus: on the beam's they keep 0.98 and more, a motion that shrinks by
/// `1/N` in a period has 0.5.
const STEADY: f64 = 0.8;
/// Least part by which returns fall from each quarter to the next in a motion that settles slowly, and by how
/// much that part differs between quarters at most.
const LEAST_FALL: f64 = 0.002;
const EVEN: f64 = 2.0;
/// `D(3 n)/D(n)` from which on the shift is a turn: half-way between three and one.
const TURNS: f64 = 2.0;
/// Part of the periods up to which n is looked for,
const PART: usize = 8;
/// and how many at most.
const MOST: usize = 1024;
/// Pairs of states of a mean.
const PAIRS: usize = 512;
/// A neighbour ahead is sought up to so many times the distance of the one behind (three at most where a turn
/// is a golden section of the circle, more where it is nearer to a fraction),
const AHEAD: f64 = 16.0;
/// within a cone of that half angle, as its cosine.
const CONE: f64 = 0.5;
/// By how much the way of n periods may differ between the first quarter and the last on a torus of which a
/// part is seen.
const SAME: f64 = 0.03;
/// Part of the last states that have to lie between earlier ones, and least number of states that are looked
/// at.
const BETWEEN: f64 = 0.5;
const LAST: usize = 16;
/// As many of them are enough.
const MOST_LAST: usize = 64;

/// Whether the returns after some number of periods, up to the longest, come closer and closer, or those
/// after all of them slowly and evenly.
pub(crate) fn settles(states: &[Vec<f64>], scales: &[f64], longest: usize) -> bool {
    let mean = |pairs: &[Vec<f64>], n: usize, apart: fn(&[f64], &[f64], &[f64]) -> f64| {
        let all = pairs.iter().zip(&pairs[n..]).map(|(before, now)| apart(scales, before, now));
        all.sum::<f64>() / (pairs.len() - n) as f64
    };
    let quarter = states.len() / 4;
    let shifts = 1..=longest.min(quarter / 2);
    let falls = shifts.clone().any(|n| {
        let last = mean(&states[states.len() - quarter..], n, distance);
        last < STEADY * mean(&states[..quarter], n, distance)
    });
    let of_quarter = |pairs: &[Vec<f64>]| shifts.clone().map(|n| mean(pairs, n, apart)).sum::<f64>();
    falls || quarter > 0 && falls_evenly(states.chunks_exact(quarter).take(4).map(of_quarter).collect())
}

/// Whether values fall by about the same factor from each to the next.
fn falls_evenly(values: Vec<f64>) -> bool {
    let falls = values.windows(2).map(|pair| 1.0 - pair[1] / pair[0]);
    let (least, most) = falls
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), fall| (least.min(fall), most.max(fall)));
    least >= LEAST_FALL && most <= EVEN * least
}

/// How a motion that does not settle comes back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Returns {
    /// As on a torus.
    Turning,
    /// To within rounding after a number of periods that is longer than those looked for, or it creeps by.
    Creeping,
    /// Neither.
    Elsewhere,
}

/// What the closest of the shifts by up to an eighth of the periods does to the states.
pub(crate) fn returns(states: &[Vec<f64>], scales: &[f64]) -> Returns {
    let most = (states.len() / PART).min(MOST);
    let shift = |n: usize, apart: fn(&[f64], &[f64], &[f64]) -> f64| {
        let count = states.len() - n;
        let step = count.div_ceil(PAIRS);
        let pairs = (0..count).step_by(step).map(|k| apart(scales, &states[k], &states[k + n]));
        pairs.sum::<f64>() / count.div_ceil(step) as f64
    };
    let closest = (1..=most).map(|n| (shift(n, apart), n)).min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((near, n)) = closest else { return Returns::Elsewhere };
    if shift(n, distance) < REPEATED {
        return Returns::Creeping;
    }
    if shift(3 * n, apart) < TURNS * near {
        return Returns::Elsewhere;
    }
    let quarter = states.len() / 4;
    let of_part = |part: &[Vec<f64>]| {
        let ways = part.iter().zip(&part[n..]).map(|(a, b)| apart(scales, a, b));
        ways.sum::<f64>() / (part.len() - n) as f64
    };
    let [first, last] = [&states[..quarter], &states[states.len() - quarter..]].map(of_part);
    let is_even = (last / first - 1.0).abs() <= SAME;
    if is_even || end_between_earlier_ones(states, scales, n) { Returns::Turning } else { Returns::Creeping }
}

/// Whether most of the last states, one of each place that n periods come back to, have earlier states on
/// opposite sides.
fn end_between_earlier_ones(states: &[Vec<f64>], scales: &[f64], n: usize) -> bool {
    let n = n.max(LAST).min(states.len());
    let lies_between = |k: usize| {
        let ways = states[..k].iter().map(|earlier| -> Vec<f64> {
            earlier.iter().zip(&states[k]).zip(scales).map(|((a, b), scale)| (a - b) / scale).collect()
        });
        let ways: Vec<(f64, Vec<f64>)> =
            ways.map(|way| (way.iter().map(|x| x * x).sum::<f64>().sqrt(), way)).collect();
        let Some((near, behind)) = ways.iter().min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        let is_ahead = |(far, way): &(f64, Vec<f64>)| {
            let along: f64 = way.iter().zip(behind).map(|(a, b)| a * b).sum();
            *far <= AHEAD * near && along <= -CONE * near * far
        };
        ways.iter().any(is_ahead)
    };
    let last = (states.len() - n..states.len()).step_by(n.div_ceil(MOST_LAST));
    let count = last.len();
    let between = last.filter(|k| lies_between(*k)).count();
    between as f64 >= BETWEEN * count as f64
}

/// Distance of two states in the scales: relative to the states, which may be near zero, a few of them would
/// dominate the means.
fn apart(scales: &[f64], a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).zip(scales).map(|((a, b), scale)| ((a - b) / scale).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// States on a torus of some angles, each turned by its part of a circle in a period, bent by its second
    /// harmonic.
    fn torus(rotations: &[f64]) -> Vec<Vec<f64>> {
        let state = |k: usize| {
            let angles = rotations.iter().map(|rotation| TAU * rotation * k as f64);
            angles.flat_map(|x| [x.cos() + 0.3 * (2.0 * x).cos(), x.sin()]).collect()
        };
        (0..1000).map(state).collect()
    }

    #[test]
    fn tori_of_one_and_two_angles_turn() {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        for rotations in [vec![golden], vec![2f64.sqrt() / 1000.0], vec![golden, 2f64.sqrt() - 1.0]] {
            let found = returns(&torus(&rotations), &vec![1.0; 2 * rotations.len()]);
            assert_eq!(found, Returns::Turning, "{rotations:?}");
        }
    }

    /// Towards an orbit of 36 points and away from one, on one side and from side to side, and at rest on it:
    /// none of it turns.
    #[test]
    fn what_creeps_past_an_orbit_of_long_period_does_not_turn() {
        for rate in [-3e-3, -1e-3, -1e-4, -1e-5, 1e-5, 1e-4, 1e-3] {
            for (side, start) in [(1.0, 1e-1), (-1.0, 1e-1), (1.0, 1e-4), (-1.0, 1e-4), (1.0, 0.0)] {
                let state = |k: usize| {
                    let off = start * f64::powi(side, k as i32) * (rate * k as f64).exp();
                    let place = |j: usize| ((j * j) as f64).cos();
                    vec![2.0 + place(k % 36) + 0.3 * off, place(k % 36 + 50) - 0.7 * off]
                };
                let states: Vec<Vec<f64>> = (0..8000).map(state).collect();
                let found = returns(&states, &[1.0; 2]);
                assert_ne!(found, Returns::Turning, "{rate} {side} {start}");
                assert!(start > 0.0 || found == Returns::Creeping);
            }
        }
    }

    #[test]
    fn spirals_settle_however_slowly_and_tori_do_not() {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        for rotation in [golden, 0.36, 2f64.sqrt() / 50.0, 0.2501] {
            for decay in [1e-3, 1e-4, 1.5e-5] {
                let spiral = |k: usize| {
                    let (angle, size) = (TAU * rotation * k as f64, (-decay * k as f64).exp());
                    vec![2.0 + size * angle.cos(), size * angle.sin()]
                };
                let states: Vec<Vec<f64>> = (0..1000).map(spiral).collect();
                assert!(settles(&states, &[1.0; 2], 64), "{rotation}, {decay}");
            }
        }
        for first in 1..200 {
            let rotation = golden / f64::from(first);
            let rotations = if first % 2 == 0 { vec![rotation] } else { vec![rotation, 2f64.sqrt() - 1.0] };
            let settling = settles(&torus(&rotations), &vec![1.0; 2 * rotations.len()], 64);
            assert!(!settling || first > 100, "{rotations:?}");
        }
    }

    /// `x' = 1 - a x^2` in many bands, in four, where two merge into one, and in one.
    #[test]
    fn bands_of_chaos_do_not_turn() {
        for a in [1.4012, 1.4072, 1.45, 1.543_689, 1.9] {
            let mut x = 0.3;
            let state = |_| {
                x = 1.0 - a * x * x;
                vec![x]
            };
            let states: Vec<Vec<f64>> = (0..1000).map(state).collect();
            assert_ne!(returns(&states, &[1.0]), Returns::Turning, "{a}");
        }
    }
}
