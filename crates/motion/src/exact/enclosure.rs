//! Bounds from below, with proof, on what keeps a closed contact closed all through a step with forces.
//! Equations (C8) and (C9) of the book, `docs/theory`.
//!
//! A closed contact ends where its guard `g = alpha p + beta p'` falls to zero: the penetration p (`alpha =
//! 1`, `beta = 0`), or the pressure of a contact with a damper. At the nodes g is known, and at both ends of
//! the step with its slope. Between the nodes a polynomial through these values may differ from g, and an
//! opening may hide there. This file bounds the difference, for the motion *that is computed*: that of the
//! polynomial forces of the step. What that differs from the exact motion is the error of the step
//! (`step_error.rs`).
//!
//! # The polynomial and its remainder
//! In the variable s of the step, `t = h c(s)`, let P be the polynomial that has the values of g at the nodes
//! `s_k`, its value and slope by the time at both ends, and zero slope by s at the end towards which the step
//! is graded (there `c' = 0`, and g has that too). These are `n = NODES + a + b` conditions, a of them at the
//! start and b at the end: two at a smooth end, three at a graded one; P has the degree `n - 1`.
//!
//! **Theorem 1.** With `w = s^a (1 - s)^b`, `omega = prod (s - s_k)`, `Omega = max |omega|` over [0, 1] and
//! `r_n >= |g^(n)(s)|/n!` for all s in it: `|g - P| <= Omega r_n w`.
//!
//! *Proof.* Each condition is one of Hermite's for the node polynomial `s^a (s - 1)^b omega`, so `g - P` is
//! this times `g^(n)(xi)/n!` for some xi (Davis, Interpolation and Approximation, 1975, theorem 3.5.1). The
//! nodes are those of a Jacobi polynomial with exponents 0 and 1, so `|omega|` is largest at an end (Szegö,
//! Orthogonal Polynomials, 1975, theorem 7.32.1).
//!
//! So `g >= P - Omega r_n w`, a polynomial of degree `n - 1`, and that lies in the convex hull of its
//! Bernstein coefficients `b_i - Omega r_n w_i`. Zeros of g at the ends of the step need no care: there `b_0
//! = g(0)` and `b_1 - b_0` is the slope, without any margin, since the coefficients `w_i` with `i < a` or `i
//! > n - 1 - b` vanish. Nor does it need to be known which of them there are.
//!
//! # The remainder
//! For functions f on [0, 1] and power series `F(x)` let `f << F` say `|f^(j)(s)|/j! <= F_j` for all j and s.
//! Sums and products keep this (Leibniz), and `f' << F'` gives `(j + 1) |f_(j+1)| <= F'_j`. The map has `c'
//! << gamma`, with `gamma = 1` for a smooth step and `2 + 2 x` for a graded one. A force `F_a`, a polynomial
//! of degree `m = NODES - 1` with the Bernstein coefficients `f_i`, has `F_a << phi_a`, `phi_aj = binomial(m,
//! j) max_i |D^j f_i|` with the forward differences D.
//!
//! Block i, `x' = A x + sum_a B_a F_a` with `A^2 = -c A - k` (`block.rs`), has the rate `z/h = sqrt(k) + c`.
//! Its parts `d_1 = h C A x` and `d_2 = h^2 C A^2 x` in the derivatives of the output obey, by `tau = t/h`,
//!
//! `d_1' = d_2 + h^2 sum_a C A B_a F_a`, `d_2' = -h c d_2 - h^2 k d_1 + h^3 sum_a C A^2 B_a F_a`.
//!
//! **Theorem 2.** Let `sigma_a = max(|C A B_a|, |C A^2 B_a| h/z)`, and let D be the series with `D_0 >=
//! |d_1|, |d_2|/z` all over the step and `D' = gamma (z D + h^2 sum_a sigma_a phi_a)`. Then `d_1 << D` and
//! `d_2 << z D`.
//!
//! *Proof.* By s both derivatives have the factor c'. If the claim holds up to the coefficient j, that of
//! `d_1'` is at most that of `gamma (z D + h^2 sigma phi)`, and that of `d_2'` at most that of `gamma ((h c
//! z + h^2 k) D + h^2 z sigma phi)`; since `h c z + h^2 k <= z^2`, that is z times the first.
//!
//! As `D_0` serves what the energy norm E of the block can be in the step, `E(0) + h sum_a |B_a| max |F_a|`,
//! times the output's factors for first and second derivatives. As `C B` vanishes, `r' = c' sum d_1` by s for
//! the whole output, hence `r_n = [gamma sum D]_(n-1)/n` for the displacement and `h r_n = [sum D]_n` for the
//! velocity. In a smooth step with a mode of the amplitude A this is `A z^n/n!`; with `Omega = (NODES!)^2/(2
//! NODES)!`, 4e-7, some 1e-11 A at z = 2.
//!
//! # Loads
//! The part of a load in the output is a known function of the time, q, with a bound on all its derivatives
//! (`majorant.rs`): `|q'| <= v` and `|q^(j)| <= w^(j-2) (w v + g)` from the second on. For an order of the
//! load, with the amplitude A in the output, `v = A w` and `g = 0`.
//!
//! **Theorem 3.** With `z = w h`, `D_0 = h v` and `D' = gamma (z D + h^2 g)`, `d_1 << D` for `d_1 = h q'`.
//!
//! *Proof.* Let `d_j` be the derivative j of q by tau; by s, that of `d_j` is `c' d_(j+1)`. Claim: `d_1 <<
//! D` and, for `j >= 2`, `d_j << z^(j-2) (z D + h^2 g)`. The first coefficients are the bounds. If all hold
//! up to the coefficient i, then `(i + 1) d_(1,i+1)` is at most `[gamma (z D + h^2 g)]_i = (i + 1)
//! D_(i+1)`, and `(i + 1) d_(j,i+1)` at most `[gamma z^(j-1) (z D + h^2 g)]_i = z^(j-1) (i + 1) D_(i+1)`,
//! which is `i + 1` times the coefficient of the claim. Coefficients up to `n + 1` are all that is used, so
//! derivatives up to that suffice.
//!
//! So a part of a load enters like a block, with the constant `h^2 g` as driving series. A constant load on a
//! free body without a damper makes a parabola: `z = 0`, and nothing of it is left in `r_n`.
//!
//! **Theorem 4.** The series of one recurrence with the largest of all z, and with the sums of all `D_0` and
//! of all `sigma phi`, bounds the sum of all D.
//!
//! *Proof.* The recurrence has no negative factor, so a larger z makes no coefficient smaller; with one z for
//! all it is linear, and the series of the sums is the sum of the series.
//!
//! The sums over the blocks are constants of the structure. This bound costs a tenth of the sum of all D; a
//! few times as large, it shows nearly always what that would. Only where it does not the sum is taken.
//!
//! # Round holes
//! The guard of a hole is its reading less the clearance, `(y^2 + z^2)/(2 c) - c/2` (`hole.rs`).
//!
//! **Theorem 5.** Let D be the sums of the series of theorems 2 and 3 for the outputs y and z, and Y and Z
//! the series with `Y_0 = |y(0)| + D_0` and `Y_j = [gamma D]_(j-1)/j`. Then `r_n = [Y Y + Z Z]_n/(2 c)`.
//!
//! *Proof.* By s the derivative of y is `c'` times `sum d_1`, so `y << Y` but for the first coefficient.
//! That bounds y itself, which moves from y(0) by no more than `h max |y'| <= D_0`. Products keep the
//! relation, and `n > 0` leaves the constant out. A parabola in y has no part in `r_n` for y alone; here it
//! has, by its product with what else moves.

mod remainder;

#[cfg(test)]
mod tests;

use std::sync::OnceLock;

use faer::{Mat, linalg::solvers::DenseSolveCore};

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::Jet,
    event::Event,
    lanes::add_products,
    run::Run,
};
use remainder::BINOMIALS;
pub(super) use remainder::InCommon;

/// Most conditions on the polynomial, n, raised to a multiple of four.
const MOST: usize = NODES + 8;
/// Values that go into it: at the nodes, then value and slope at the start and at the end.
const GIVEN: usize = NODES + 4;
/// What rounding of the matrices that make the polynomials is, as one of the nodal values, relative to the
/// largest.
const MATRIX_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Halvings after which a polynomial that is not shown to be positive counts as doubtful.
const HALVINGS: u32 = 6;

/// Constants of the polynomial for one grading.
#[derive(Debug)]
struct Hermite {
    /// `n`.
    count: usize,
    /// Bernstein coefficients that each of what is given adds, zero from `n` on; slopes are by `t/h`.
    added: [[f64; MOST]; GIVEN],
    /// Sum of the magnitudes of the factors of the nodal values in each coefficient.
    amplified: [f64; MOST],
    /// `Omega w_i`.
    margin: [f64; MOST],
}

/// A guard as the solved step gives it.
#[derive(Debug, Clone, Copy)]
struct Guard {
    /// At the nodes.
    nodal: [f64; NODES],
    /// Values at start and end.
    values: [f64; 2],
    /// Slopes by the time there.
    slopes: [f64; 2],
    /// `alpha` and `beta`.
    parts: [f64; 2],
    /// What rounding leaves undecided of the nodal values.
    rounding: f64,
}

impl Hermite {
    fn of(grading: Grading) -> &'static Self {
        static ALL: OnceLock<[Hermite; 3]> = OnceLock::new();
        let all = ALL.get_or_init(|| [Grading::Smooth, Grading::Touch, Grading::Release].map(Hermite::new));
        match grading {
            Grading::Smooth => &all[0],
            Grading::Touch => &all[1],
            Grading::Release => &all[2],
        }
    }

    fn new(grading: Grading) -> Self {
        let nodes = &grading.rule().s;
        let (a, b) = match grading {
            Grading::Smooth => (2, 2),
            Grading::Touch => (3, 2),
            Grading::Release => (2, 3),
        };
        let (count, degree) = (NODES + a + b, NODES + a + b - 1);
        let binomial = |i: usize| (0..i).map(|m| (degree - m) as f64 / (m + 1) as f64).product::<f64>();
        // The conditions on the coefficients, those with something given first: a polynomial has the
        // derivatives `b_0`, `degree (b_1 - b_0)`, `degree (degree - 1)/2 (b_2 - 2 b_1 + b_0)` over the
        // factorial at its start; where `t = h s^2` the last one is the slope by `t/h`. The same backwards at
        // its end.
        let mut conditions = Mat::<f64>::zeros(count, count);
        for (k, &s) in nodes.iter().enumerate() {
            for i in 0..count {
                conditions[(k, i)] = binomial(i) * s.powi(i as i32) * (1.0 - s).powi((degree - i) as i32);
            }
        }
        let mut row = GIVEN;
        for (end, order) in [a, b].into_iter().enumerate() {
            let at = |i: usize| if end == 0 { i } else { degree - i };
            let inwards = if end == 0 { 1.0 } else { -1.0 };
            let (value, slope) = (NODES + 2 * end, NODES + 2 * end + 1);
            conditions[(value, at(0))] = 1.0;
            if order == 2 {
                let by_time = inwards * degree as f64 / grading.map(end as f64).1;
                conditions[(slope, at(0))] = -by_time;
                conditions[(slope, at(1))] = by_time;
                continue;
            }
            let second = inwards * binomial(2);
            for (i, factor) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                conditions[(slope, at(i))] = factor * second;
            }
            conditions[(row, at(0))] = -1.0;
            conditions[(row, at(1))] = 1.0;
            row += 1;
        }
        let inverse = conditions.partial_piv_lu().inverse();
        // What the conditions at one end alone fix is exactly that.
        let is_fixed_without = |i: usize, j: usize| {
            let (of_start, of_end) = (NODES..NODES + 2, NODES + 2..GIVEN);
            i < a && !of_start.contains(&j) || i + b >= count && !of_end.contains(&j)
        };
        let mut added = [[0.0; MOST]; GIVEN];
        let mut amplified = [0.0; MOST];
        for (j, column) in added.iter_mut().enumerate() {
            for i in (0..count).filter(|&i| !is_fixed_without(i, j)) {
                column[i] = inverse[(i, j)];
                if j < NODES {
                    amplified[i] += inverse[(i, j)].abs();
                }
            }
        }
        let largest = |s: f64| nodes.iter().map(|s_k| (s - s_k).abs()).product::<f64>();
        let omega = largest(0.0).max(largest(1.0));
        // `s^a (1 - s)^b` of the degree `a + b`, raised: `binomial(NODES - 1, i - a)/binomial(degree, i)`.
        let margin = std::array::from_fn(|i| {
            let inside = i >= a && i - a < NODES;
            if inside { omega * BINOMIALS[i - a] / binomial(i) } else { 0.0 }
        });
        Self { count, added, amplified, margin }
    }

    /// Bernstein coefficients of a polynomial below the guard, whose remainder is that times the margin; what
    /// is behind them means nothing.
    fn lower(&self, guard: &Guard, length: f64, remainder: f64) -> [f64; MOST] {
        let mut given = [0.0; GIVEN];
        given[..NODES].copy_from_slice(&guard.nodal);
        for end in 0..2 {
            given[NODES + 2 * end] = guard.values[end];
            given[NODES + 2 * end + 1] = guard.slopes[end] * length;
        }
        let mut lower = [0.0; MOST];
        for ((lower, margin), amplified) in lower.iter_mut().zip(&self.margin).zip(&self.amplified) {
            *lower = -(margin * remainder + amplified * guard.rounding);
        }
        add_products(&mut lower, self.added.as_flattened(), MOST, |_| given.iter().copied());
        lower
    }
}

impl ExactIntegrator {
    /// Whether the guard of the a-th active element, which falls to zero at `event`, is proved to stay above
    /// what rounding and the location of events leave undecided, all through the solved step.
    pub(super) fn stays_above(&self, run: &Run, (a, event): (usize, Event), at_end: Option<Event>) -> bool {
        let Some(guard) = self.guard_of(run, a, event) else { return false };
        let hermite = Hermite::of(self.step.grading());
        let located = if at_end == Some(event) { guard.values[1].abs() } else { 0.0 };
        let floor = -self.rounding_of(run, event) - located;
        let is_shown_by = |remainder: f64, halvings: u32| {
            let lower = hermite.lower(&guard, self.step.length, remainder);
            is_above(&lower[..hermite.count], floor, halvings)
        };
        let element = event.element();
        if let Some(hole) = self.laws[element].round_hole() {
            return is_shown_by(self.reading_remainder(run, element, hole), HALVINGS);
        }
        is_shown_by(self.common_remainder(run, element, guard.parts), 0)
            || is_shown_by(self.remainder(run, element, guard.parts), HALVINGS)
    }

    fn guard_of(&self, run: &Run, a: usize, event: Event) -> Option<Guard> {
        let element = event.element();
        let contact = self.closed_contact(run, element)?;
        let nodal = self.nodal_distance(run, a, event)?;
        let mut ends = [run.start[element].jet, self.free_element_jet_at_step_end(run, element)];
        let (parts, offset) = match (event, self.laws[element].pressure()) {
            (Event::Part(_), Some(pressure)) => {
                self.add_forces_at_ends(element, &mut ends);
                ([pressure.displacement, pressure.velocity], pressure.offset)
            }
            _ => ([1.0, 0.0], 0.0),
        };
        let sign = contact.sign;
        let value =
            |jet: &Jet| offset + sign * (parts[0] * (jet.value - contact.level) + parts[1] * jet.slope);
        let slope = |jet: &Jet| sign * (parts[0] * jet.slope + parts[1] * jet.curvature);
        let largest = nodal.iter().fold(0.0_f64, |largest, g| largest.max(g.abs()));
        let start = run.start[element];
        let rounding = parts[0] * start.margin + parts[1] * 8.0 * f64::EPSILON * start.velocity;
        let rounding = rounding + (self.full_precision() + MATRIX_ROUNDING) * largest;
        let rounding = rounding + self.unsolved_of_reading(a);
        let [first, last] = &ends;
        let (values, slopes) = ([value(first), value(last)], [slope(first), slope(last)]);
        Some(Guard { nodal, values, slopes, parts, rounding })
    }

    /// What Newton's method leaves of the reading of a hole whose first direction is the a-th active element,
    /// from what it leaves of the displacements; 0 of other elements, of which it is a part of their guard.
    fn unsolved_of_reading(&self, a: usize) -> f64 {
        let Some(hole) = self.laws[self.step.active[a]].round_hole() else { return 0.0 };
        let largest = |a: usize| {
            let nodes = &self.step.displacement[a * NODES..(a + 1) * NODES];
            nodes.iter().fold(0.0_f64, |largest, r| largest.max(r.abs()))
        };
        let distance = largest(a).hypot(largest(a + 1));
        4.0 * self.full_precision() * distance * distance / hole.clearance()
    }

    /// Adds what the polynomials of the forces are at the ends of the step to the second derivatives of an
    /// output there.
    fn add_forces_at_ends(&self, output: usize, ends: &mut [Jet; 2]) {
        let rule = self.step.grading().rule();
        for (force, &active) in self.step.force.as_chunks::<NODES>().0.iter().zip(&self.step.active) {
            let coefficients = rule.bernstein_of_whole(force);
            ends[0].curvature += self.mobility[output][active] * coefficients[0];
            ends[1].curvature += self.mobility[output][active] * coefficients[NODES - 1];
        }
    }
}

/// Whether a polynomial is nowhere below `floor` in [0, 1], as so many halvings of its Bernstein coefficients
/// show.
fn is_above(coefficients: &[f64], floor: f64, halvings: u32) -> bool {
    if coefficients.iter().all(|b| *b >= floor) {
        return true;
    }
    let last = coefficients.len() - 1;
    if halvings == 0 || !(coefficients[0] >= floor && coefficients[last] >= floor) {
        return false;
    }
    let (mut left, mut right) = ([0.0; MOST], [0.0; MOST]);
    right[..=last].copy_from_slice(coefficients);
    left[0] = right[0];
    for level in 1..=last {
        for i in 0..=last - level {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
        left[level] = right[0];
    }
    is_above(&left[..=last], floor, halvings - 1) && is_above(&right[..=last], floor, halvings - 1)
}
