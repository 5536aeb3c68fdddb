//! Closed forms of linear vibration, along whole branches: a mass on a spring and damper, driven by a force
//! or by the ground; under its own weight; and pressed on a stop that it never leaves.
//!
//! Textbook formulas (Inman, *Engineering Vibration*, chapters 2 and 3). With `W = 2 pi f`, `w^2 = k/m`, `z =
//! c/(2 m w)`, `r = W/w`:
//!
//! | | |
//! |---|---|
//! | force `F cos W t` | `X = F / (k - m W^2 + i c W)` |
//! | ground `U cos W t` | `Y = U (1 + 2 i z r) / (1 - r^2 + 2 i z r)` |
//! | multipliers | `exp(-z w T) exp(+-i w sqrt(1 - z^2) T)` |
//!
//! Stops that are out of reach keep the equations linear. Tolerances are those of an orbit (1e-10 of its
//! norm) with a margin of ten.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{
    ObservedSystem, Walked, element_at, force_at, masses, response_of, shaken, single_mass, walk_both,
};
use approx::assert_abs_diff_eq;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, System, law::LinearStop};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, find_start};
use hammerbeam_structure::{GROUND, ReducedModel};

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 800.0;
const DAMPER: f64 = 4.0;
const FORCE: f64 = 3.0;
/// `w` [rad/s] and `z` of the above.
const OMEGA: f64 = 20.0;
const RATIO: f64 = 0.05;
const TOLERANCE: f64 = 1e-9;

type Complex = [f64; 2];

fn over([a, b]: Complex, [c, d]: Complex) -> Complex {
    let square = c * c + d * d;
    [(a * c + b * d) / square, (b * c - a * d) / square]
}

fn modulus([a, b]: Complex) -> f64 {
    a.hypot(b)
}

/// Amplitude of the response to a force: `F / (k - m W^2 + i c W)`.
fn receptance(stiffness: f64, force: f64, omega: f64) -> Complex {
    over([force, 0.0], [stiffness - MASS * omega * omega, DAMPER * omega])
}

fn out_of_reach() -> Law {
    Law::Linear(LinearStop::with_gap(STIFFNESS, 1e3).unwrap())
}

fn rig(model: ReducedModel, load: &Load, law: Law) -> ObservedSystem {
    let (element, response) = (element_at(&model, "mass", law), response_of(&model, "mass"));
    ObservedSystem { system: System::new(model, load, vec![element]).unwrap(), response }
}

fn forced(law: Law, extra: Option<HarmonicForce>) -> ObservedSystem {
    let model = single_mass(MASS, STIFFNESS, DAMPER, false);
    let forces = std::iter::once(force_at(&model, "mass", 1, FORCE)).chain(extra).collect();
    rig(model, &Load { support: vec![], forces }, law)
}

fn walked(rig: &ObservedSystem) -> Walked {
    walk_both(rig, 2.0, (0.5, 8.0), &OrbitSettings::default())
}

/// Displacement and velocity of the mass at phase 0.
fn at_phase_0(rig: &ObservedSystem, orbit: &PeriodicSolution) -> [f64; 2] {
    [orbit.nodes[0][0] * rig.response.shape[0], orbit.nodes[0][1] * rig.response.shape[0]]
}

/// Multipliers of an oscillator of eigenfrequency `w` with the damper.
fn assert_multipliers(orbit: &PeriodicSolution, omega: f64) {
    let ratio = DAMPER / (2.0 * MASS * omega);
    let period = 1.0 / orbit.frequency_hz;
    let (radius, angle) = ((-ratio * omega * period).exp(), omega * (1.0 - ratio * ratio).sqrt() * period);
    let [re, im] = orbit.floquet_multipliers[0];
    assert_abs_diff_eq!(re, radius * angle.cos(), epsilon = TOLERANCE);
    assert_abs_diff_eq!(im.abs(), (radius * angle.sin()).abs(), epsilon = TOLERANCE);
}

fn assert_without_events(walked: &Walked) {
    assert!(walked.rows.iter().all(|row| !row.events.fold && !row.events.grazing && row.solution.stable()));
    assert_eq!(walked.rows[0].solution.frequency_hz, 0.5);
    assert_eq!(walked.rows[walked.rows.len() - 1].solution.frequency_hz, 8.0);
}

#[test]
fn forced_mass_has_the_amplitude_phase_and_multipliers_of_the_textbook() {
    let rig = forced(out_of_reach(), None);
    let branch = walked(&rig);
    assert_without_events(&branch);
    for row in &branch.rows {
        let orbit = &row.solution;
        let omega = TAU * orbit.frequency_hz;
        let [re, im] = receptance(STIFFNESS, FORCE, omega);
        let amplitude = modulus([re, im]);
        let [displacement, velocity] = at_phase_0(&rig, orbit);
        assert_abs_diff_eq!(displacement, re, epsilon = TOLERANCE * amplitude);
        assert_abs_diff_eq!(velocity, -omega * im, epsilon = TOLERANCE * omega * amplitude);
        assert_abs_diff_eq!(orbit.maxima.displacement, amplitude, epsilon = TOLERANCE * amplitude);
        let acceleration = omega * omega * amplitude;
        // An error of the displacement is one of the spring's force.
        let scale = acceleration + OMEGA * OMEGA * amplitude;
        assert_abs_diff_eq!(orbit.maxima.acceleration, acceleration, epsilon = TOLERANCE * scale);
        assert_eq!(orbit.maxima.contacts, 0);
        assert_multipliers(orbit, OMEGA);
    }
}

/// `X = F / (2 k z sqrt(1 - z^2))` at `W = w sqrt(1 - 2 z^2)`.
#[test]
fn resonance_is_at_w_sqrt_1_minus_2_z_squared() {
    let rig = forced(out_of_reach(), None);
    let resonance = OMEGA * (1.0 - 2.0 * RATIO * RATIO).sqrt() / TAU;
    let height = |frequency_hz: f64| {
        let settings = OrbitSettings::default();
        find_start(&rig.system, &rig.response, frequency_hz, 1, &settings).unwrap().maxima.displacement
    };
    let expected = FORCE / (2.0 * STIFFNESS * RATIO * (1.0 - RATIO * RATIO).sqrt());
    assert_abs_diff_eq!(height(resonance), expected, epsilon = TOLERANCE * expected);
    assert!(height(0.999 * resonance) < height(resonance) && height(1.001 * resonance) < height(resonance));
    let top = walked(&rig).peak(0.5, 8.0).solution.frequency_hz;
    assert_abs_diff_eq!(top, resonance, epsilon = 0.01); // Half a step.
}

/// Through spring and damper: `|Y/U|^2 = (1 + (2 z r)^2) / ((1 - r^2)^2 + (2 z r)^2)`.
#[test]
fn ground_motion_is_transmitted_through_spring_and_damper() {
    let amplitude = 1e-3;
    let rig = rig(single_mass(MASS, STIFFNESS, DAMPER, true), &shaken(amplitude), out_of_reach());
    let branch = walked(&rig);
    assert_without_events(&branch);
    for row in &branch.rows {
        let r = TAU * row.solution.frequency_hz / OMEGA;
        let absolute = over([amplitude, 2.0 * RATIO * r * amplitude], [1.0 - r * r, 2.0 * RATIO * r]);
        let [displacement, _] = at_phase_0(&rig, &row.solution);
        let (found, expected) = (row.solution.maxima.displacement, modulus(absolute));
        assert_abs_diff_eq!(found, expected, epsilon = TOLERANCE * expected);
        assert_abs_diff_eq!(
            displacement + amplitude,
            absolute[0],
            epsilon = TOLERANCE * expected.max(amplitude)
        );
        assert_multipliers(&row.solution, OMEGA);
    }
    let isolation = walk_both(&rig, 6.0, (4.6, 8.0), &OrbitSettings::default());
    let isolated = |hz: f64, found: f64| (TAU * hz / OMEGA > f64::sqrt(2.0)) == (found < amplitude);
    let all = branch.rows.iter().chain(&isolation.rows).map(|row| &row.solution);
    all.for_each(|orbit| assert!(isolated(orbit.frequency_hz, orbit.maxima.displacement)));
}

/// Under a weight the mass sags by `m g / k`; the gap is that of the undeformed structure. While it does not
/// touch, `max |y|` is sag plus amplitude; it grazes where `|X(W)| = gap - sag`, and no contact is found
/// below.
#[test]
fn sagging_mass_reaches_its_stop_at_the_frequency_of_the_closed_form() {
    let (sag, gap) = (MASS * 9.81 / STIFFNESS, 0.030);
    let stop = Law::Linear(LinearStop::with_gap(1e5, gap).unwrap());
    let model = single_mass(MASS, STIFFNESS, DAMPER, false);
    let weight = HarmonicForce {
        shape: model.uniform_acceleration.clone(),
        harmonic: Harmonic { order: 0, amplitude: 9.81, phase: 0.0 },
    };
    let rig = forced(stop, Some(weight));
    let branch =
        walk_both(&rig, 0.6, (0.5, 2.0), &OrbitSettings { max_step: 0.01, ..OrbitSettings::default() });
    // |X|^2 = F^2 / ((k - m s)^2 + c^2 s) with s = W^2: a quadratic in s, whose smaller root is met first.
    let (a, b) = (MASS * MASS, DAMPER * DAMPER - 2.0 * STIFFNESS * MASS);
    let c = STIFFNESS * STIFFNESS - (FORCE / (gap - sag)).powi(2);
    let expected = ((-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt() / TAU;
    let grazing = branch.rows.iter().position(|row| row.events.grazing).unwrap();
    assert_abs_diff_eq!(branch.rows[grazing].solution.frequency_hz, expected, epsilon = 1e-8);
    for row in &branch.rows[..grazing] {
        let amplitude = modulus(receptance(STIFFNESS, FORCE, TAU * row.solution.frequency_hz));
        assert_eq!(row.solution.maxima.contacts, 0);
        assert_abs_diff_eq!(row.solution.maxima.displacement, sag + amplitude, epsilon = TOLERANCE * sag);
        assert_multipliers(&row.solution, OMEGA);
    }
    assert_eq!(branch.rows[grazing + 1].solution.maxima.contacts, 1);
}

/// A stop that presses with 120 N stays closed: the branch is that of the stiffness `k + s`, about `-P/(k +
/// s)`, with the force `P k/(k + s)` on average, so an impulse of `P k T/(k + s)` a period.
#[test]
fn preloaded_stop_that_never_opens_only_adds_its_stiffness() {
    let (stop, preload) = (1200.0, 120.0);
    let rig = forced(Law::Linear(LinearStop::with_preload(stop, preload).unwrap()), None);
    let branch = walked(&rig);
    assert_without_events(&branch);
    let (together, mean) = (STIFFNESS + stop, preload / (STIFFNESS + stop));
    for row in &branch.rows {
        let omega = TAU * row.solution.frequency_hz;
        let [re, im] = receptance(together, FORCE, omega);
        let [displacement, velocity] = at_phase_0(&rig, &row.solution);
        assert_abs_diff_eq!(displacement, re - mean, epsilon = TOLERANCE * mean);
        assert_abs_diff_eq!(velocity, -omega * im, epsilon = TOLERANCE * OMEGA * mean);
        let impulse = mean * STIFFNESS / row.solution.frequency_hz;
        assert_abs_diff_eq!(row.solution.maxima.impulse, impulse, epsilon = TOLERANCE * impulse);
        assert_eq!(row.solution.maxima.contacts, 1);
        assert_multipliers(&row.solution, (together / MASS).sqrt());
    }
}

/// Two masses in series on a spring each: at the anti-resonance `W^2 = k_2/m_2` the driven one hardly moves,
/// `F / (i c W)`-like small.
#[test]
fn absorber_stills_the_driven_mass_at_its_own_frequency() {
    let (k2, m2, c2) = (50.0, 0.5, 0.01);
    let model = masses(
        &[("mass", MASS), ("absorber", m2)],
        &[("mass", GROUND, STIFFNESS), ("mass", "absorber", k2)],
        &[("mass", GROUND, DAMPER), ("mass", "absorber", c2)],
        false,
    );
    let load = Load { support: vec![], forces: vec![force_at(&model, "mass", 1, FORCE)] };
    let rig = rig(model, &load, out_of_reach());
    let omega = (k2 / m2).sqrt();
    let orbit = find_start(&rig.system, &rig.response, omega / TAU, 1, &OrbitSettings::default()).unwrap();
    // Eliminate the absorber: its dynamic stiffness seen by the mass is D m2 W^2 / (m2 W^2 - D), D = k2 + i
    // c2 W.
    let inertia = m2 * omega * omega;
    let link = [k2, c2 * omega];
    let seen = over([-link[0] * inertia, -link[1] * inertia], [link[0] - inertia, link[1]]);
    let direct = [STIFFNESS - MASS * omega * omega, DAMPER * omega];
    let expected = modulus(over([FORCE, 0.0], [direct[0] + seen[0], direct[1] + seen[1]]));
    assert_abs_diff_eq!(orbit.maxima.displacement, expected, epsilon = TOLERANCE * FORCE / STIFFNESS);
    assert!(expected < 0.05 * FORCE / STIFFNESS);
}
