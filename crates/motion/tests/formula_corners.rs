//! Formulas with corners: a force that has no power series where a motion passes, against closed forms.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_testkit::{laws::formula, systems::oscillator};

/// `x'' = -k x - g(x, x')` without a load.
fn integrator(stiffness: f64, text: &str) -> ExactIntegrator {
    let (system, _) = oscillator(stiffness, 0.0, (0.0, 0.0), formula(text));
    ExactIntegrator::new(system, ExactSettings { tolerance: 1e-11 }).unwrap()
}

fn until(end: f64) -> Stretch {
    Stretch { frequency_hz: 1.0, start: 0.0, end }
}

/// Where a half swing of `x'' = -x - c x' |x'|` from rest at `a > 0` ends, at `-b`: with
/// `w = x'^2`, `dw/dx = 2 c w - 2 x` on the way, so `(1 - 2 c b) e^(2 c b) = (1 + 2 c a) e^(-2 c a)`.
fn next_turn(c: f64, a: f64) -> f64 {
    let left = (1.0 + 2.0 * c * a) * (-2.0 * c * a).exp();
    let (mut low, mut high) = (0.0, a);
    for _ in 0..200 {
        let b = 0.5 * (low + high);
        if (1.0 - 2.0 * c * b) * (2.0 * c * b).exp() > left { low = b } else { high = b }
    }
    0.5 * (low + high)
}

/// Quadratic damping, whose force has a corner in its slope wherever the velocity changes its sign.
#[test]
fn quadratic_damping_keeps_its_first_integral() {
    let c = 0.3;
    let mut integrator = integrator(1.0, &format!("{c}*v*abs(v)"));
    for end in [1.7, 4.4, 10.3, 31.9, 75.1] {
        let [x, v] = integrator.advance(&until(end), &[1.0, 0.0]).unwrap()[..] else { panic!() };
        let (mut turn, mut sign, mut least) = (1.0, 1.0, f64::INFINITY);
        for _ in 0..40 {
            // On this half swing, looked at so that it goes down from `turn`.
            let [y, falling] = [sign * x, -sign * v];
            let part = |y: f64| (y / c + 0.5 / (c * c)) * (-2.0 * c * y).exp();
            let square = (part(y) - part(turn)) * (2.0 * c * y).exp();
            if falling > 0.0 && y < turn {
                least = f64::min(least, (square - v * v).abs());
            }
            (turn, sign) = (next_turn(c, turn), -sign);
        }
        assert!(least < 1e-10, "after {end}: off by {least:.1e}");
    }
}

/// Two stiffnesses, one on each side: the force itself has a corner. A period of the motion from rest at 1 is
/// `pi/w1 + pi/w2`, and over it nothing is left but what a change of the amplitude, or of the phase, is: the
/// map is the identity.
#[test]
fn a_slope_that_jumps_at_zero_is_followed_with_its_sensitivities() {
    let [above, below] = [1.5_f64.sqrt(), 0.5_f64.sqrt()];
    let period = PI / above + PI / below;
    let mut integrator = integrator(1.0, "0.5*abs(x)");
    for periods in 1..=3 {
        let flow = integrator.flow(&until(f64::from(periods) * period), &[1.0, 0.0]).unwrap();
        let off = (flow.state[0] - 1.0).abs().max(flow.state[1].abs());
        assert!(off < 2e-10, "after {periods} periods: off by {off:.1e}");
        for row in 0..2 {
            for column in 0..2 {
                let expected = if row == column { 1.0 } else { 0.0 };
                let found = flow.by_state[(row, column)];
                let off = (found - expected).abs();
                // A slope that jumps by as much as itself is known for as long as the steps around it last.
                assert!(off < 4e-9 * f64::from(periods), "after {periods} periods: {row} {column} {off:.1e}");
            }
        }
    }
    // A quarter of the way: through the corner, then w2.
    let end = 0.5 * PI / above + 0.7;
    let [x, v] = integrator.advance(&until(end), &[1.0, 0.0]).unwrap()[..] else { panic!() };
    let speed = above / below;
    let off = [x + speed * (0.7 * below).sin(), v + above * (0.7 * below).cos()];
    assert!(off[0].abs().max(off[1].abs()) < 1e-10, "{off:?}");
}

/// Corners cost short steps, but not very many: some tens each.
#[test]
fn corners_take_a_bounded_number_of_steps() {
    for (text, most) in [("0.3*v*abs(v)", 40), ("0.5*abs(x)", 60), ("0.3*x*abs(x)", 40)] {
        let mut integrator = integrator(1.0, text);
        integrator.advance(&until(12.0), &[1.0, 0.0]).unwrap();
        // Not quite two periods, two corners in each.
        let solves = integrator.counts().solves / 4;
        assert!(solves < most, "{text}: {solves} solves a corner");
    }
}
