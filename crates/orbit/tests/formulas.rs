//! Periodic orbits of oscillators whose force is a formula: against the law that it writes out, and against
//! an integration of its own.

use crate::common::independent::{Case, oscillator, together};
use hammerbeam_motion::{
    Law,
    law::{Degree, Formula, PowerSpring},
};
use hammerbeam_orbit::{BranchRow, BranchWalk, OrbitSettings, Side, find_start};
use std::f64::consts::TAU;

fn formula(text: &str) -> Law {
    Law::Formula(Formula::new(text, &[]).unwrap())
}

fn rows(case: &Case, range_hz: (f64, f64), start_hz: f64) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(range_hz);
    let start = find_start(&case.0, &case.1, start_hz, 1, &settings).unwrap();
    let mut rows = Vec::new();
    let mut walk = BranchWalk::new(&case.0, &case.1, &start, Side::Up, range_hz, &settings).unwrap();
    while walk.step(&mut rows).unwrap().is_none() {}
    rows
}

/// A hardening oscillator over its resonance, with both folds: the same rows from `k x^3` and from the
/// formula, to what a solution is known to.
#[test]
fn a_formula_gives_the_branch_of_the_law_that_it_writes_out() {
    let of = |law: Law| rows(&together(&[oscillator(1.0, 0.1, 0.3, law)]), (0.1, 0.35), 0.11);
    let cubic = of(Law::Power(PowerSpring::new(1.0, Degree::Cubic).unwrap()));
    let formula = of(formula("x^3"));
    assert_eq!(cubic.len(), formula.len());
    for (a, b) in cubic.iter().zip(&formula) {
        let (a, b) = (&a.solution, &b.solution);
        assert!((a.frequency_hz / b.frequency_hz - 1.0).abs() < 1e-10);
        for (a, b) in a.nodes[0].iter().zip(&b.nodes[0]) {
            assert!((a - b).abs() < 1e-10, "{a} {b}");
        }
    }
    let events = |rows: &[BranchRow]| rows.iter().map(|row| row.events.label()).collect::<Vec<_>>();
    assert_eq!(events(&cubic), events(&formula));
    assert_eq!(events(&cubic).iter().filter(|label| label.contains("fold")).count(), 2);
}

/// A van der Pol oscillator that its force has locked: state and multipliers against the method of Runge and
/// Kutta, with the variational equations written out.
#[test]
fn the_locked_van_der_pol_oscillator_is_that_of_an_integration_of_its_own() {
    let (mu, amplitude) = (0.3, 1.0);
    let case = together(&[oscillator(1.0, 0.0, amplitude, formula("0.3*(x^2 - 1)*v"))]);
    let found = rows(&case, (0.15, 0.17), 0.151);
    assert!(found.len() > 10);
    for row in found.iter().step_by(found.len() / 5) {
        let frequency = TAU * row.solution.frequency_hz;
        let rates = |t: f64, z: [f64; 6]| {
            let [x, v, ..] = z;
            let accelerated =
                |x: f64, v: f64| -x - mu * (x * x - 1.0) * v + amplitude * (frequency * t).cos();
            let column = |dx: f64, dv: f64| -(1.0 + 2.0 * mu * x * v) * dx - mu * (x * x - 1.0) * dv;
            [v, accelerated(x, v), z[3], column(z[2], z[3]), z[5], column(z[4], z[5])]
        };
        let start = &row.solution.nodes[0];
        let mut z = [start[0], start[1], 1.0, 0.0, 0.0, 1.0];
        let steps = 4000;
        let h = TAU / frequency / f64::from(steps);
        for k in 0..steps {
            let t = f64::from(k) * h;
            let moved = |by: [f64; 6], share: f64| std::array::from_fn(|i| z[i] + share * h * by[i]);
            let a = rates(t, z);
            let b = rates(t + 0.5 * h, moved(a, 0.5));
            let c = rates(t + 0.5 * h, moved(b, 0.5));
            let d = rates(t + h, moved(c, 1.0));
            z = std::array::from_fn(|i| z[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        // Four thousand steps of fourth order leave 1e-11.
        assert!((z[0] - start[0]).abs() < 1e-9 && (z[1] - start[1]).abs() < 1e-9, "{z:?} {start:?}");
        let (trace, determinant) = (z[2] + z[5], z[2] * z[5] - z[3] * z[4]);
        let [a, b] = [0, 1].map(|k: usize| row.solution.floquet_multipliers[k]);
        let (sum, product) = (a[0] + b[0], a[0] * b[0] - a[1] * b[1]);
        assert!((sum - trace).abs() < 1e-8 && (product - determinant).abs() < 1e-8, "{a:?} {b:?}");
    }
}
