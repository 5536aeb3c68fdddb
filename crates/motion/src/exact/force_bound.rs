//! Bounds on the force of a step between its nodes.
//!
//! The force of a step is a polynomial `F(s)` of degree `m = NODES - 1` in the variable of the step. It lies
//! in the convex hull of its Bernstein coefficients `b_i` over [0, 1], and so does its derivative, with the
//! coefficients `m (b_{i+1} - b_i)`. In time,
//!
//! `dF/dt = F_s / (h c'(s))`,
//!
//! where `c' = 1` in a smooth step, `2 s` in one graded at the touch and `2 (1 - s)` in one graded at the
//! release. A force that sets in with a half-integer power has `F_s(0) = 0`, but its polynomial only nearly
//! so, and the quotient is unbounded at that end. So the value at the end is split off: `F_s(s) = F_s(0) + s
//! Q(s)`, where the coefficients of `Q` follow from those of `F_s` since `s B_j^{m-2} = (j + 1)/(m - 1)
//! B_{j+1}^{m-1}`. The first part changes the force by no more than `|F_s(0)|` over any part of the step, the
//! second no faster than `max |Q|/(2 h)`. Hence, for any two times in the step,
//!
//! `|F(t_2) - F(t_1)| <= rate |t_2 - t_1| + jump`, and `|F - middle| <= range`.
//!
//! To `range` and `jump` the error of the force is added as its expansion tells (`step_error.rs`): its two
//! highest terms.

use super::collocation::{Grading, NODES};

/// Bounds on a force over a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct ForceBound {
    /// Middle of the range in which it lies [N].
    pub middle: f64,
    /// Bound on its distance from the middle [N].
    pub range: f64,
    /// How fast it changes [N/s], apart from
    pub rate: f64,
    /// what it changes in addition, however short the time [N].
    pub jump: f64,
}

impl ForceBound {
    /// Bounds on the force with these nodal values; `tail` is the sum of its two highest coefficients.
    pub fn new(grading: Grading, length: f64, nodal: &[f64; NODES], tail: f64) -> Self {
        let rule = grading.rule();
        let values = rule.bernstein_of_whole(nodal);
        let degree = NODES - 1;
        let slopes: [f64; NODES - 1] = std::array::from_fn(|i| degree as f64 * (values[i + 1] - values[i]));
        let ends = [slopes[0], slopes[degree - 1]];
        let quotient = |i: usize| (degree - 1) as f64 / i as f64;
        let (jump, rate) = match grading {
            Grading::Smooth => (0.0, largest(slopes.into_iter())),
            Grading::Touch => {
                (ends[0].abs(), 0.5 * largest((1..degree).map(|i| (slopes[i] - ends[0]) * quotient(i))))
            }
            Grading::Release => (
                ends[1].abs(),
                0.5 * largest((1..degree).map(|i| (slopes[degree - 1 - i] - ends[1]) * quotient(i))),
            ),
        };
        let error = tail * rule.highest;
        let highest = values.iter().fold(f64::NEG_INFINITY, |highest, value| highest.max(*value));
        let lowest = values.iter().fold(f64::INFINITY, |lowest, value| lowest.min(*value));
        let (middle, range) = (0.5 * (highest + lowest), 0.5 * (highest - lowest) + error);
        Self { middle, range, rate: rate / length, jump: jump + 2.0 * error }
    }

    /// Bound on its magnitude (`whole`), or on its distance from the middle.
    pub fn range_of(&self, whole: bool) -> f64 {
        if whole { self.middle.abs() + self.range } else { self.range }
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of the full degree, on many pairs of places.
    #[test]
    fn no_force_leaves_its_bounds() {
        for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
            let rule = grading.rule();
            for seed in 0..40 {
                let random = |k: usize| (12.9898 * (k + 13 * seed + 1) as f64).sin() * 43.758_545_3 % 1.0;
                // Of the shape of a Hertz force, and rough.
                let shapes = [
                    rule.s.map(|s| s.powi(3) * (1.0 - 0.4 * s) + 1e-3 * random(3) * s.powi(11)),
                    std::array::from_fn(random),
                ];
                for nodal in shapes {
                    let length = 0.3;
                    let bound = ForceBound::new(grading, length, &nodal, 0.0);
                    let at = |i: usize| {
                        let s = i as f64 / 200.0;
                        let force: f64 = rule.lagrange(s).iter().zip(&nodal).map(|(l, f)| l * f).sum();
                        (grading.map(s).0 * length, force)
                    };
                    for i in 0..=200 {
                        let (time, force) = at(i);
                        assert!((force - bound.middle).abs() <= bound.range * (1.0 + 1e-9));
                        for j in (0..i).step_by(7).chain(i.checked_sub(1)) {
                            let (earlier, before) = at(j);
                            let allowed = bound.rate * (time - earlier) + bound.jump;
                            assert!((force - before).abs() <= allowed * (1.0 + 1e-9) + 1e-12, "{grading:?}");
                        }
                    }
                }
            }
        }
    }

    /// `F = sin` over a smooth step of length one: the bounds are not far above 1 and 1.
    #[test]
    fn bounds_of_a_smooth_force_are_sharp() {
        let nodal = Grading::Smooth.rule().s.map(f64::sin);
        let bound = ForceBound::new(Grading::Smooth, 1.0, &nodal, 0.0);
        assert!(
            (0.84..0.86).contains(&bound.range_of(true)) && (0.99..1.02).contains(&bound.rate),
            "{bound:?}"
        );
        assert_eq!(bound.jump, 0.0);
    }

    /// `F = t^1.5` from a touch: the rate is 1.5 at the end, and next to nothing jumps.
    #[test]
    fn a_force_that_sets_in_like_that_of_hertz_has_a_finite_rate() {
        let nodal = Grading::Touch.rule().s.map(|s| s.powi(3));
        let bound = ForceBound::new(Grading::Touch, 1.0, &nodal, 0.0);
        assert!((1.49..1.6).contains(&bound.rate) && bound.jump < 1e-10, "{bound:?}");
    }
}
