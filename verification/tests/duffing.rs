//! The hardening Duffing oscillator `x'' + 2 z x' + x + a x^3 = F cos W t`: its folds by two other means.
//!
//! * harmonic balance with the orders 0 to 25, own continuation and fold finding: folds to all digits that an
//!   orbit has.
//! * harmonic balance with the first order, in closed form: folds to the second order of a weak nonlinearity.
//! * Brennan, Kovacic, Carrella and Waters, J. Sound Vib. 318 (2008), 1250-1261: the same for light damping:
//!   jump-down and jump-up.
//!
//! No publication was found that prints fold frequencies to more digits than its formulas give.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use crate::common::{ObservedSystem, element_at, force_at, response_of, single_mass, walk_both};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use hammerbeam_motion::{Law, Load, System, law::PowerSpring};
use hammerbeam_orbit::OrbitSettings;

/// `z`, `a` and `F`.
#[derive(Debug, Clone, Copy)]
struct Duffing {
    damping: f64,
    cubic: f64,
    force: f64,
}

impl Duffing {
    fn rig(self) -> ObservedSystem {
        let model = single_mass(1.0, 1.0, 2.0 * self.damping, false);
        let spring = element_at(&model, "mass", Law::Power(PowerSpring::cubic(self.cubic).unwrap()));
        let load = Load { support: vec![], forces: vec![force_at(&model, "mass", 1, self.force)] };
        let response = response_of(&model, "mass");
        ObservedSystem { system: System::new(model, &load, vec![spring]).unwrap(), response }
    }

    /// Circular frequencies and amplitudes of the folds, ascending, by the walk along the branch.
    fn folds(self, range: (f64, f64), step: f64) -> Vec<[f64; 2]> {
        let settings = OrbitSettings { max_step: step / TAU, ..OrbitSettings::default() };
        let range_hz = (range.0 / TAU, range.1 / TAU);
        let branch = walk_both(&self.rig(), 0.5 * (range_hz.0 + range_hz.1), range_hz, &settings);
        let rows = branch.rows.iter().filter(|row| row.events.fold).map(|row| &row.solution);
        let mut folds: Vec<[f64; 2]> =
            rows.map(|solution| [TAU * solution.frequency_hz, solution.maxima.displacement]).collect();
        folds.sort_by(|a, b| a[0].total_cmp(&b[0]));
        folds
    }
}

/// Harmonic balance: `x = c_0 + sum c_k cos k t + s_k sin k t`, the cubic force by sampling, exact for that
/// many samples.
mod harmonic_balance {
    use super::{Duffing, TAU};

    const ORDERS: usize = 25;
    /// Coefficients, then the circular frequency.
    pub const UNKNOWNS: usize = 2 * ORDERS + 1;
    const SAMPLES: usize = 4 * ORDERS + 4;

    /// Value of basis function j at sample k: cosines at odd places, sines at even ones.
    fn basis(j: usize, k: usize) -> f64 {
        let angle = TAU * (j.div_ceil(2) * k % SAMPLES) as f64 / SAMPLES as f64;
        if j % 2 == 1 || j == 0 { angle.cos() } else { angle.sin() }
    }

    fn weight(j: usize) -> f64 {
        if j == 0 { 1.0 / SAMPLES as f64 } else { 2.0 / SAMPLES as f64 }
    }

    /// Residual and, by rows, its derivatives by the coefficients and the frequency.
    pub fn equations(duffing: Duffing, point: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let omega = point[UNKNOWNS];
        let table: Vec<Vec<f64>> =
            (0..UNKNOWNS).map(|j| (0..SAMPLES).map(|k| basis(j, k)).collect()).collect();
        let x: Vec<f64> = (0..SAMPLES).map(|k| (0..UNKNOWNS).map(|j| point[j] * table[j][k]).sum()).collect();
        let project = |i: usize, f: &dyn Fn(usize) -> f64| {
            weight(i) * (0..SAMPLES).map(|k| f(k) * table[i][k]).sum::<f64>()
        };
        let mut residual = vec![0.0; UNKNOWNS];
        let mut matrix = vec![vec![0.0; UNKNOWNS + 1]; UNKNOWNS];
        for i in 0..UNKNOWNS {
            let order = i.div_ceil(2) as f64;
            // The partner in x': d/dt of c cos + s sin has the cosine part k W s and the sine part -k W c.
            let (partner, sign) = if i % 2 == 1 { (i + 1, 1.0) } else { (i.saturating_sub(1), -1.0) };
            let diagonal = 1.0 - (order * omega).powi(2);
            residual[i] = diagonal * point[i] + project(i, &|k| duffing.cubic * x[k].powi(3));
            for j in 0..UNKNOWNS {
                matrix[i][j] = project(i, &|k| 3.0 * duffing.cubic * x[k] * x[k] * table[j][k]);
            }
            matrix[i][i] += diagonal;
            matrix[i][UNKNOWNS] = -2.0 * order * order * omega * point[i];
            if i > 0 {
                let coupling = 2.0 * duffing.damping * order * sign;
                residual[i] += coupling * omega * point[partner];
                matrix[i][partner] += coupling * omega;
                matrix[i][UNKNOWNS] += coupling * point[partner];
            }
        }
        residual[1] -= duffing.force;
        (residual, matrix)
    }

    /// Solves by Gaussian elimination with row exchanges.
    pub fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
        let n = right.len();
        for column in 0..n {
            let larger = |&i: &usize, &j: &usize| matrix[i][column].abs().total_cmp(&matrix[j][column].abs());
            let pivot = (column..n).max_by(larger).unwrap();
            matrix.swap(column, pivot);
            right.swap(column, pivot);
            let source = matrix[column].clone();
            for row in column + 1..n {
                let factor = matrix[row][column] / source[column];
                matrix[row].iter_mut().zip(&source).skip(column).for_each(|(t, s)| *t -= factor * s);
                right[row] -= factor * right[column];
            }
        }
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n).map(|j| matrix[row][j] * right[j]).sum();
            right[row] = (right[row] - known) / matrix[row][row];
        }
        right
    }

    /// Newton's method in the plane through `point` normal to `tangent`; the point found and the tangent
    /// there.
    pub fn correct(duffing: Duffing, mut point: Vec<f64>, tangent: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let guess = point.clone();
        for _ in 0..12 {
            let (mut residual, mut matrix) = equations(duffing, &point);
            matrix.push(tangent.to_vec());
            residual.push(tangent.iter().zip(point.iter().zip(&guess)).map(|(t, (p, g))| t * (p - g)).sum());
            let update = solve(matrix, residual);
            point.iter_mut().zip(&update).for_each(|(p, u)| *p -= u);
        }
        let (_, mut matrix) = equations(duffing, &point);
        matrix.push(tangent.to_vec());
        let mut next = vec![0.0; UNKNOWNS + 1];
        next[UNKNOWNS] = 1.0;
        let next = solve(matrix, next);
        let length = next.iter().map(|t| t * t).sum::<f64>().sqrt();
        (point, next.iter().map(|t| t / length).collect())
    }

    /// Folds `[W, max |x|]` met on the way up from a low frequency.
    pub fn folds(duffing: Duffing, (low, high): (f64, f64), step: f64) -> Vec<[f64; 2]> {
        let mut tangent = vec![0.0; UNKNOWNS + 1];
        tangent[UNKNOWNS] = 1.0;
        let mut guess = vec![0.0; UNKNOWNS + 1];
        guess[UNKNOWNS] = low;
        let (mut point, mut tangent) = correct(duffing, guess, &tangent);
        let mut found = Vec::new();
        while point[UNKNOWNS] < high {
            let along = |length: f64| {
                let guess = point.iter().zip(&tangent).map(|(p, t)| p + length * t).collect();
                correct(duffing, guess, &tangent)
            };
            let next = along(step);
            if tangent[UNKNOWNS] * next.1[UNKNOWNS] < 0.0 {
                let (mut inside, mut outside) = (0.0, step);
                for _ in 0..50 {
                    let middle = 0.5 * (inside + outside);
                    let beyond = along(middle).1[UNKNOWNS] * tangent[UNKNOWNS] < 0.0;
                    if beyond { outside = middle } else { inside = middle }
                }
                let fold = along(0.5 * (inside + outside)).0;
                found.push([fold[UNKNOWNS], amplitude(&fold)]);
            }
            (point, tangent) = next;
        }
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        found
    }

    /// `max |x|` of the sum of harmonics: by Newton's method on its derivative from the largest of some
    /// values.
    fn amplitude(point: &[f64]) -> f64 {
        let at = |t: f64| {
            let mut jet = [point[0], 0.0, 0.0];
            for order in 1..=ORDERS {
                let (k, c, s) = (order as f64, point[2 * order - 1], point[2 * order]);
                let (sin, cos) = (k * t).sin_cos();
                jet[0] += c * cos + s * sin;
                jet[1] += k * (s * cos - c * sin);
                jet[2] -= k * k * (c * cos + s * sin);
            }
            jet
        };
        let angle = |k: usize| TAU * k as f64 / 720.0;
        let largest =
            (0..720).max_by(|&a, &b| at(angle(a))[0].abs().total_cmp(&at(angle(b))[0].abs())).unwrap();
        let mut t = angle(largest);
        for _ in 0..6 {
            let jet = at(t);
            t -= jet[1] / jet[2];
        }
        at(t)[0].abs()
    }
}

/// Both codes find the same folds with the same amplitudes.
fn assert_folds_of_harmonic_balance(duffing: Duffing, range: (f64, f64)) {
    let expected = harmonic_balance::folds(duffing, range, 0.05);
    let found = duffing.folds(range, 0.01);
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    assert!(!found.is_empty());
    for (found, expected) in found.iter().zip(&expected) {
        // A fold's frequency is stationary along the branch: it is known far better than its amplitude.
        assert_relative_eq!(found[0], expected[0], max_relative = 1e-9);
        assert_relative_eq!(found[1], expected[1], max_relative = 1e-6);
    }
}

#[test]
fn folds_of_a_moderate_spring_are_those_of_harmonic_balance() {
    assert_folds_of_harmonic_balance(Duffing { damping: 0.05, cubic: 1.0, force: 0.2 }, (0.7, 2.0));
}

#[test]
fn folds_of_a_lightly_damped_spring_are_those_of_harmonic_balance() {
    assert_folds_of_harmonic_balance(Duffing { damping: 0.02, cubic: 1.0, force: 0.1 }, (0.8, 2.2));
}

#[test]
fn folds_of_a_softening_spring_are_those_of_harmonic_balance() {
    assert_folds_of_harmonic_balance(Duffing { damping: 0.05, cubic: -0.1, force: 0.15 }, (0.6, 1.3));
}

/// Folds of `A^2 ((1 - W^2 + 3/4 a A^2)^2 + (2 z W)^2) = F^2`, the first-order harmonic balance: where its
/// derivative by `A^2` vanishes too.
///
/// With `u = 3/4 a A^2` that is `(1 - s + u)(1 - s + 3 u) + 4 z^2 s = 0` for `s = W^2`: two values of s for
/// each u, and F decides u.
fn first_order_folds(Duffing { damping, cubic, force }: Duffing) -> [f64; 2] {
    let square = |u: f64, branch: f64| {
        // s^2 + s (4 z^2 - 2 - 4 u) + (1 + u)(1 + 3 u) = 0.
        let (half, constant) = (1.0 + 2.0 * u - 2.0 * damping * damping, (1.0 + u) * (1.0 + 3.0 * u));
        half + branch * (half * half - constant).max(0.0).sqrt()
    };
    let excess = |u: f64, branch: f64| {
        let s = square(u, branch);
        u / (0.75 * cubic) * ((1.0 - s + u).powi(2) + 4.0 * damping * damping * s) - force * force
    };
    // The square root is real from here on: (u - 2 z^2)^2 = 4 z^2 (1 + u) or so.
    let least = {
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..200 {
            let u = 0.5 * (low + high);
            let half: f64 = 1.0 + 2.0 * u - 2.0 * damping * damping;
            if half * half < (1.0 + u) * (1.0 + 3.0 * u) { low = u } else { high = u }
        }
        high
    };
    [1.0, -1.0].map(|branch| {
        let (mut low, mut high) = (least, 10.0);
        for _ in 0..200 {
            let u = 0.5 * (low + high);
            if excess(u, branch) < 0.0 { low = u } else { high = u }
        }
        square(low, branch).sqrt()
    })
}

/// With damping, force and cubic term all of the size e, the first order is off by `e^2`.
#[test]
fn first_order_harmonic_balance_is_off_by_the_square_of_the_nonlinearity() {
    let deviations = [0.004, 0.002, 0.001].map(|e| {
        let duffing = Duffing { damping: 0.1 * e, cubic: e, force: 0.5 * e };
        let found = duffing.folds((1.0 - e, 1.0 + 6.0 * e), 0.05 * e);
        assert_eq!(found.len(), 2, "{found:?}");
        let mut expected = first_order_folds(duffing);
        expected.sort_by(f64::total_cmp);
        [found[0][0] - expected[0], found[1][0] - expected[1]]
    });
    for pair in deviations.windows(2) {
        for fold in 0..2 {
            assert_abs_diff_eq!((pair[0][fold] / pair[1][fold]).log2(), 2.0, epsilon = 0.08);
        }
    }
}

/// Jump-down at `W^2 = (1 + sqrt(1 + 3 a F^2/(4 z^2)))/2` and jump-up at `W = 1 + (3/2)^(4/3) (a
/// F^2)^(1/3)/2`, for light damping and a weak nonlinearity: here `a F^2 = 1e-6` and `z = 0.001`. The damping
/// left out of the jump-up is `(z/(W - 1))^2`, 1.4 %, of `W - 1`; the third harmonic left out of the
/// jump-down is `3/256 (a x^2)^2 = 5e-4` with `a x^2 = 4/3 (W^2 - 1)`.
#[test]
fn jump_frequencies_are_those_of_brennan_and_others() {
    let duffing = Duffing { damping: 0.001, cubic: 0.01, force: 0.01 };
    let strength = duffing.cubic * duffing.force * duffing.force;
    let folds = duffing.folds((0.98, 1.12), 2e-3);
    assert_eq!(folds.len(), 2);
    let up = 1.0 + 0.5 * 1.5_f64.powf(4.0 / 3.0) * strength.cbrt();
    let down = (0.5 * (1.0 + (1.0 + 0.75 * strength / duffing.damping.powi(2)).sqrt())).sqrt();
    assert_relative_eq!(folds[0][0] - 1.0, up - 1.0, max_relative = 0.03);
    assert_abs_diff_eq!(folds[1][0], down, epsilon = 6e-4);
}
