//! How a motion without a period comes back to where it was.
//!
//! With `D(n)` the mean distance of the states at the start of periods k and `k + n`:
//!
//! - A motion that still settles comes back closer and closer: `D(n)` falls from the first quarter of the periods to the last, for some n.
//! - On a torus the map turns every angle by the same amount, so that the shift of n periods is a turn, and that of `3 n` periods three times that turn. Of many n one turns by little; there
//!   `D(3 n)` is about `3 D(n)`, whatever the shape of the torus and the speed along it, as a short way is gone three times. In chaos, in bands that are visited in a fixed order as well, the closest n
//!   keeps the order of the bands and says nothing of the place in them: `D(3 n)` is about `D(n)`.

use crate::settle::distance;

/// Part to which returns may fall on a torus: those of the beam's keep 0.98 and more, a motion that shrinks by `1/N` in a period has 0.5.
const STEADY: f64 = 0.8;
/// `D(3 n)/D(n)` from which on the shift is a turn: half-way between three and one.
const TURNS: f64 = 2.0;
/// Part of the periods up to which n is looked for,
const PART: usize = 8;
/// and how many at most.
const MOST: usize = 1024;
/// Pairs of states of a mean.
const PAIRS: usize = 512;

/// Whether the returns after some number of periods, up to the longest, come closer and closer.
pub(crate) fn settles(states: &[Vec<f64>], scales: &[f64], longest: usize) -> bool {
    let mean = |pairs: &[Vec<f64>], n: usize| {
        let all = pairs.iter().zip(&pairs[n..]).map(|(before, now)| distance(scales, before, now));
        all.sum::<f64>() / (pairs.len() - n) as f64
    };
    let quarter = states.len() / 4;
    (1..=longest.min(quarter / 2)).any(|n| {
        let last = mean(&states[states.len() - quarter..], n);
        last < STEADY * mean(&states[..quarter], n)
    })
}

/// Whether the closest of the shifts by up to an eighth of the periods turns the states as a torus is turned.
pub(crate) fn turns(states: &[Vec<f64>], scales: &[f64]) -> bool {
    let most = (states.len() / PART).min(MOST);
    let shift = |n: usize| {
        let count = states.len() - n;
        let step = count.div_ceil(PAIRS);
        let pairs = (0..count).step_by(step).map(|k| apart(scales, &states[k], &states[k + n]));
        pairs.sum::<f64>() / count.div_ceil(step) as f64
    };
    let closest = (1..=most).map(|n| (shift(n), n)).min_by(|a, b| a.0.total_cmp(&b.0));
    closest.is_some_and(|(near, n)| shift(3 * n) >= TURNS * near)
}

/// Distance of two states in the scales: relative to states, which may be near zero, means would be those of few.
fn apart(scales: &[f64], a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).zip(scales).map(|((a, b), scale)| ((a - b) / scale).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// States on a torus of some angles, each turned by its part of a circle in a period, bent by its second harmonic.
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
            assert!(turns(&torus(&rotations), &vec![1.0; 2 * rotations.len()]), "{rotations:?}");
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
            assert!(!turns(&states, &[1.0]), "{a}");
        }
    }
}
