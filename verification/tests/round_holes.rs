//! Round holes on whole orbits and branches.
//!
//! * A rotor of one mass with an unbalance that leans on its stator, against closed forms (below).
//! * A tube that is driven in a plane, against one between two stops.
//! * The same tube driven in both planes, against the general integrator.
//!
//! Synchronous whirl of the radius R turns as a whole, `y + i z = R exp(i (W t - lag))`, so
//!
//! `((k_0 + k - m W^2) R - k c)^2 + (d W R)^2 = F^2`.
//!
//! Beside it `y + i z = (R exp(-i lag) + x) exp(i W t)`, with
//!
//! `x'' + (2 i W + d/m) x' + (k_0/m - W^2 + i W d/m) x + k/m ((1 - c/2R) x + c/2R exp(-2 i lag) x*) = 0`.
//!
//! This is a linear equation with constant coefficients in the turning frame, which is back where it was
//! after a period: its eigenvalues `e` give the Floquet multipliers `exp(e T)`.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::{ObservedSystem, walk_both};
use hammerbeam_motion::{
    Stretch,
    general::{GeneralSettings, advance},
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, find_start, neighbouring_orbit};
use hammerbeam_study::{Model, StudyFile};

const MASS: f64 = 1.5;
const SPRING: f64 = 600.0;
const DAMPER: f64 = 4.0;
const WALL: f64 = 2.5e4;
const GAP: f64 = 1e-3;
const FORCE: f64 = 0.9;

fn built(text: String) -> Model {
    Model::build(&StudyFile::parse("study", text).unwrap_or_else(|error| panic!("{error}"))).unwrap()
}

fn rotor() -> ObservedSystem {
    let mut text = "[structure]\nkind = \"lumped\"\n".to_owned();
    for name in ["y", "z"] {
        text += &format!("[[structure.mass]]\nname = \"{name}\"\nmass_kg = {MASS:?}\n");
        text += &format!(
            "[[structure.spring]]\nbetween = [\"{name}\", \"ground\"]\nstiffness_n_m = {SPRING:?}\n\
             [[structure.damper]]\nbetween = [\"{name}\", \"ground\"]\ndamping_n_s_m = {DAMPER:?}\n"
        );
    }
    text += &format!(
        "[excitation]\nkind = \"force\"\nfrequency_hz = [1.0, 30.0]\nforce = [\n\
         {{ at = \"y\", amplitude_n = {FORCE:?} }},\n\
         {{ at = \"z\", amplitude_n = {FORCE:?}, phase_rad = {:?} }},\n]\n\
         [[stop]]\nname = \"stator\"\nat = [\"y\", \"z\"]\nlaw = \"linear\"\nside = \"around\"\n\
         gap_m = {GAP:?}\nstiffness_n_m = {WALL:?}\n",
        -PI / 2.0
    );
    let model = built(text);
    ObservedSystem { system: model.system, response: model.response }
}

/// Radii of whirls in contact at a circular frequency.
fn radii(w: f64) -> Vec<f64> {
    let (a, d) = (SPRING + WALL - MASS * w * w, DAMPER * w);
    let (square, half, rest) = (a * a + d * d, a * WALL * GAP, (WALL * GAP).powi(2) - FORCE * FORCE);
    let discriminant = half * half - square * rest;
    let root = discriminant.max(0.0).sqrt();
    [(half + root) / square, (half - root) / square].into_iter().filter(|radius| *radius > GAP).collect()
}

type Square = [[f64; 4]; 4];

fn product(a: &Square, b: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// `exp(A)` by its series, of A over a power of two, squared as often.
fn exponential(a: &Square) -> Square {
    const HALVINGS: i32 = 12;
    let small = a.map(|row| row.map(|entry| entry / 2f64.powi(HALVINGS)));
    let mut sum: Square = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    let mut term = sum;
    for order in 1..20 {
        term = product(&term, &small).map(|row| row.map(|entry| entry / f64::from(order)));
        sum.iter_mut().flatten().zip(term.iter().flatten()).for_each(|(sum, term)| *sum += term);
    }
    (0..HALVINGS).fold(sum, |power, _| product(&power, &power))
}

/// Sum of the Floquet multipliers of a whirl: the trace of `exp(A T)` in the turning frame, with the real and
/// the imaginary part of x and of its velocity as the state.
fn sum_of_multipliers(w: f64, radius: f64) -> f64 {
    let lag = f64::atan2(DAMPER * w * radius, (SPRING + WALL - MASS * w * w) * radius - WALL * GAP);
    let half = 0.5 * GAP / radius;
    let (own, turn) = (SPRING / MASS - w * w + WALL / MASS * (1.0 - half), w * DAMPER / MASS);
    let (mirror, sin, cos) = (WALL / MASS * half, (2.0 * lag).sin(), (2.0 * lag).cos());
    let (loss, gyro) = (DAMPER / MASS, 2.0 * w);
    // `exp(-2 i lag) x*` has the parts `cos a - sin b` and `-sin a - cos b` of `x = a + i b`.
    let rates: Square = [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-own - mirror * cos, turn + mirror * sin, -loss, gyro],
        [-turn + mirror * sin, -own + mirror * cos, -gyro, -loss],
    ];
    let period = exponential(&rates.map(|row| row.map(|entry| entry * TAU / w)));
    (0..4).map(|k| period[k][k]).sum()
}

fn sum_of(solution: &PeriodicSolution) -> f64 {
    solution.floquet_multipliers.iter().map(|multiplier| multiplier[0]).sum()
}

/// From the static lean on the wall up to near the fold at 15.7 Hz, where `d W R` is the whole force. The
/// branch behind it comes to where the rotor leaves the wall all the way round, at 5 Hz.
#[test]
fn branch_of_whirls_in_contact_is_the_closed_form() {
    let rig = rotor();
    let settings = OrbitSettings { max_step: 0.5, ..OrbitSettings::default() };
    let branch = walk_both(&rig, 3.0, (1.5, 14.5), &settings);
    assert!(branch.rows.len() > 25, "{} rows, {:?}", branch.rows.len(), branch.reasons);
    for row in &branch.rows {
        let (solution, w) = (&row.solution, TAU * row.solution.frequency_hz);
        let found = solution.maxima.displacement;
        let nearest = radii(w).into_iter().min_by(|a, b| (a - found).abs().total_cmp(&(b - found).abs()));
        let radius = nearest.unwrap();
        assert!((found / radius - 1.0).abs() < 1e-9, "{w}: {found}, not {radius}");
        let force = WALL * (radius - GAP);
        assert!((solution.maxima.contact_force / force - 1.0).abs() < 1e-6, "{w}: {:?}", solution.maxima);
        assert_eq!(solution.maxima.contacts, 1);
        let expected = sum_of_multipliers(w, radius);
        assert!((sum_of(solution) - expected).abs() < 1e-7, "{w}: {}, not {expected}", sum_of(solution));
    }
}

/// A tube that is clamped, and free in a hole at its tip.
fn tube(planes: u32, excitation: &str, stop: &str) -> ObservedSystem {
    let model = built(format!(
        "[structure]\nkind = \"beam\"\nplanes = {planes}\nlength_m = 0.8\nelements = 20\n\
         section = {{ outer_diameter_m = 0.012, wall_m = 0.001 }}\nyoungs_modulus_pa = 2.0e11\n\
         density_kg_m3 = 7800.0\nadded_mass_kg_m = 0.1\nleft = \"clamped\"\nright = \"free\"\n\
         [[structure.point]]\nname = \"tip\"\nat_m = 0.8\n[reduction]\nmethod = \"free-interface\"\n\
         cut_off_hz = 400.0\n[damping]\nmodal_ratio = 0.02\n[excitation]\nkind = \"force\"\n\
         frequency_hz = [8.0, 40.0]\n{excitation}\n[[stop]]\nname = \"baffle\"\nstiffness_n_m = 4.0e4\n\
         gap_m = 0.5e-3\n{stop}\n"
    ));
    ObservedSystem { system: model.system, response: model.response }
}

const AROUND: &str = "at = [\"tip.y\", \"tip.z\"]\nlaw = \"linear\"\nside = \"around\"";

fn orbit(rig: &ObservedSystem, frequency_hz: f64) -> PeriodicSolution {
    find_start(&rig.system, &rig.response, frequency_hz, 1, &OrbitSettings::default()).unwrap()
}

#[test]
fn orbits_in_a_plane_are_those_between_two_stops() {
    let between = tube(1, "at = \"tip\"\namplitude_n = 1.5", "at = \"tip\"\nlaw = \"two-sided\"");
    let around = tube(2, "at = \"tip.y\"\namplitude_n = 1.5", AROUND);
    for frequency_hz in [15.0, 24.0, 33.0] {
        // Which of several orbits a search meets is up to it: the same one is asked for.
        let plain = orbit(&between, frequency_hz);
        let nodes = plain.nodes.iter().map(|node| node.iter().flat_map(|entry| [*entry, 0.0]).collect());
        let near = PeriodicSolution { nodes: nodes.collect(), ..plain.clone() };
        let settings = OrbitSettings::default();
        let round = neighbouring_orbit(&around.system, &around.response, &near, &settings).unwrap().unwrap();
        assert_eq!(plain.maxima.contacts, round.maxima.contacts);
        assert!(plain.maxima.contacts >= 2, "{:?}", plain.maxima);
        let pairs = [
            (plain.maxima.displacement, round.maxima.displacement),
            (plain.maxima.acceleration, round.maxima.acceleration),
            (plain.maxima.contact_force, round.maxima.contact_force),
            (plain.maxima.impact_velocity, round.maxima.impact_velocity),
        ];
        for (plain, round) in pairs {
            assert!((plain / round - 1.0).abs() < 1e-6, "{frequency_hz}: {plain}, {round}");
        }
        // Those of the plane are among those of both.
        for own in &plain.floquet_multipliers {
            let distance = |other: &[f64; 2]| (own[0] - other[0]).hypot(own[1] - other[1]);
            let nearest = round.floquet_multipliers.iter().map(distance).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{frequency_hz}: {own:?}, {:?}", round.floquet_multipliers);
        }
    }
}

/// A load that turns on an ellipse.
#[test]
fn orbits_out_of_a_plane_are_those_of_the_general_integrator() {
    let excitation = format!(
        "force = [\n{{ at = \"tip.y\", amplitude_n = 1.5 }},\n\
         {{ at = \"tip.z\", amplitude_n = 0.9, phase_rad = {:?} }},\n]",
        -1.2
    );
    let rig = tube(2, &excitation, AROUND);
    let mut touched = 0;
    for frequency_hz in [13.0, 20.0, 31.0] {
        let solution = orbit(&rig, frequency_hz);
        touched += solution.maxima.contacts;
        let state = &solution.nodes[0];
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let period = advance(&rig.system, &stretch, state, &GeneralSettings::with_tolerance(1e-12)).unwrap();
        let n = rig.system.dof();
        let rates = &rig.system.model().natural_frequencies;
        let scale = |i: usize| if i < n { rates[i] } else { 1.0 };
        let size = (0..2 * n).map(|i| (state[i] * scale(i)).abs()).fold(0.0, f64::max);
        let off =
            (0..2 * n).map(|i| ((period.flow.state[i] - state[i]) * scale(i)).abs()).fold(0.0, f64::max);
        assert!(off < 1e-8 * size, "{frequency_hz}: {off:e} of {size:e}");
        let trace: f64 = (0..2 * n).map(|i| period.flow.by_state[(i, i)]).sum();
        assert!((sum_of(&solution) - trace).abs() < 1e-6, "{frequency_hz}: {}, {trace}", sum_of(&solution));
    }
    assert!(touched >= 3, "{touched}");
}
