//! Free oscillators whose force is a formula: van der Pol's limit cycle and the swing of a pendulum.
//!
//! `x'' + mu (x^2 - 1) x' + x = 0` has a limit cycle of the period `2 pi/w` and the amplitude A,
//!
//! `w = 1 - mu^2/16 + 17 mu^4/3072 + 35 mu^6/884736 - 678899 mu^8/5096079360 + ...`,
//! `A = 2 + mu^2/96 - 1033 mu^4/552960 + ...`
//!
//! (Andersen and Geer, SIAM J. Appl. Math. 42 (1982), 678-693); at `mu = 1` the period is
//! 6.6632868593231301897 (Amore, Boyd and Fernandez, J. Math. Phys. 59 (2018), 012702, by long series).

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};
use hammerbeam_study::{Model, StudyFile};

/// A mass of 1 kg, on a spring of so much to the ground, with a formula.
fn oscillator(stiffness: f64, formula: &str) -> ExactIntegrator {
    let spring =
        format!("spring = [{{ between = [\"mass\", \"ground\"], stiffness_n_m = {stiffness:.1} }}]\n");
    let spring = if stiffness > 0.0 { spring.as_str() } else { "" };
    let text = format!(
        "[structure]\nkind = \"lumped\"\nmass = [{{ name = \"mass\", mass_kg = 1.0 }}]\n{spring}\
         [[stop]]\nat = \"mass\"\nlaw = \"formula\"\n{formula}\n"
    );
    let file = StudyFile::parse("study.toml", text).unwrap_or_else(|error| panic!("{error}"));
    let system = Model::build(&file).unwrap_or_else(|error| panic!("{error}")).system;
    ExactIntegrator::new(system, ExactSettings { tolerance: 1e-13 }).unwrap()
}

fn van_der_pol(mu: f64) -> ExactIntegrator {
    oscillator(1.0, &format!("formula = \"mu*(x^2 - 1)*v\"\nconstants = {{ mu = {mu} }}"))
}

fn after(integrator: &mut ExactIntegrator, state: &[f64], time: f64) -> Vec<f64> {
    integrator.advance(&Stretch { frequency_hz: 1.0, start: 0.0, end: time }, state).unwrap()
}

/// The first time near a guess at which an entry of the state vanishes, with the state there.
///
/// * `entry`: 0 for the displacement, 1 for the velocity.
fn zero(integrator: &mut ExactIntegrator, state: &[f64], entry: usize, guess: f64) -> (f64, Vec<f64>) {
    let (mut time, step) = (guess, 1e-4);
    for _ in 0..8 {
        let [here, behind] = [time, time + step].map(|time| after(integrator, state, time)[entry]);
        time -= here * step / (behind - here);
    }
    (time, after(integrator, state, time))
}

/// Period and amplitude of the limit cycle.
fn limit_cycle(mu: f64, periods: f64) -> (f64, f64) {
    let mut integrator = van_der_pol(mu);
    let near = after(&mut integrator, &[2.0, 0.0], periods * TAU);
    // To the next turn, from which one period leads to the next.
    let (mut time, mut state) = (0.0, near);
    while time == 0.0 || state[0] < 0.0 {
        let guess = (1..200).map(|k| 0.05 * f64::from(k)).find(|time| {
            let [before, behind] = [time - 0.05, *time].map(|t| after(&mut integrator, &state, t + 1e-3)[1]);
            before > 0.0 && behind <= 0.0
        });
        (time, state) = zero(&mut integrator, &state, 1, guess.unwrap());
    }
    let (period, end) = zero(&mut integrator, &state, 1, TAU * (1.0 + mu * mu / 16.0));
    (period, end[0])
}

#[test]
fn the_limit_cycle_of_van_der_pol_has_the_period_and_amplitude_of_its_series() {
    for mu in [0.1, 0.2] {
        // Motions come to it like `exp(-mu t)`.
        let (period, amplitude) = limit_cycle(mu, 6.0 / mu);
        let m = mu * mu;
        let w = 1.0 - m / 16.0 + 17.0 * m * m / 3072.0 + 35.0 * m.powi(3) / 884_736.0
            - 678_899.0 * m.powi(4) / 5_096_079_360.0;
        // The next term is of the order `1e-4 mu^10`.
        assert!((period * w / TAU - 1.0).abs() < 1e-11, "{mu}: {period} {}", TAU / w);
        let series = 2.0 + m / 96.0 - 1033.0 * m * m / 552_960.0;
        assert!((amplitude - series).abs() < 1e-4 * m.powi(3) + 1e-11, "{mu}: {amplitude} {series}");
    }
}

#[test]
fn the_limit_cycle_of_van_der_pol_at_mu_1_has_the_period_6_66328685932313() {
    let (period, _) = limit_cycle(1.0, 10.0);
    assert!((period - 6.663_286_859_323_13).abs() < 2e-12, "{period}");
}

/// `x'' + 4 sin x = 0` swings up to an angle a with the period `pi/M(1, cos(a/2))`, M the
/// arithmetic-geometric mean, after Gauss. At the bottom its speed is `4 sin(a/2)`.
#[test]
fn a_pendulum_swings_with_the_period_of_gauss() {
    let mut integrator = oscillator(0.0, "formula = \"4*sin(x)\"");
    for angle in [0.1, 1.0, 2.5, 3.1_f64] {
        let (mut a, mut b) = (1.0, (0.5 * angle).cos());
        for _ in 0..10 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let speed = 4.0 * (0.5 * angle).sin();
        let end = after(&mut integrator, &[0.0, speed], 0.5 * TAU / a);
        // Near the top an error grows like `exp(2 t)`.
        let bound = 1e-11 * (2.0 * 0.5 * TAU / a).exp().min(1e3);
        assert!(end[0].abs() < bound && (end[1] - speed).abs() < bound, "{angle}: {end:?}");
    }
}

/// Where a formula ends in nothing finite, so does the motion, with the time.
#[test]
fn a_motion_ends_where_its_force_is_not_finite() {
    // Without damping it would swing to `x = -1`, and the logarithm ends at -1/2.
    let mut integrator = oscillator(1.0, "formula = \"0.01*ln(0.5 + x)\"");
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 10.0 };
    let error = integrator.advance(&stretch, &[1.0, 0.0]).unwrap_err();
    // cos t = -1/2 at 2.09 s, a little later with a weak force that pulls back.
    let MotionError::NoForce { time, displacement, .. } = error else { panic!("{error}") };
    assert!((2.05..2.15).contains(&time) && (displacement + 0.5).abs() < 1e-6, "{error}");
}

/// `x'' = -x + x^3` from rest at `a = 3/2` is infinite after `int dx / sqrt((x^4 - a^4)/2 - x^2 + a^2)` from
/// a to infinity.
#[test]
fn a_motion_over_a_spring_that_softens_escapes_when_its_integral_says() {
    let mut integrator = oscillator(1.0, "formula = \"-x^3\"");
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 10.0 };
    let error = integrator.advance(&stretch, &[1.5, 0.0]).unwrap_err();
    let MotionError::Escapes { time, displacement, .. } = error else { panic!("{error}") };
    assert!(displacement.abs() > 1e6, "{error}");
    assert!((time - 1.442_211_386_4).abs() < 1e-6, "{error}");
}

/// A motion that turns close to where its force ends goes on: what a trial step finds beyond is no motion.
#[test]
fn a_motion_that_turns_short_of_where_its_force_ends_goes_on() {
    // `x'' = -x - 0.01 ln(1 + x)` keeps `x'^2/2 + x^2/2 + 0.01 ((1 + x) ln(1 + x) - x)`.
    let energy = |x: f64, v: f64| 0.5 * (v * v + x * x) + 0.01 * ((1.0 + x) * (1.0 + x).ln() - x);
    let mut integrator = oscillator(1.0, "formula = \"0.01*ln(1 + x)\"");
    for begin in [0.9, 0.98, 0.99] {
        let end = after(&mut integrator, &[begin, 0.0], 50.0);
        let (before, after) = (energy(begin, 0.0), energy(end[0], end[1]));
        assert!((after / before - 1.0).abs() < 1e-9, "{begin}: {before} {after}");
    }
}
