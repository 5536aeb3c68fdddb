//! Supports that move differently, with impacts, against the same physics without any moving support.
//!
//! Two masses hang between two walls, with springs, dampers and a stop on the right wall. In the frame of
//! that wall it stands still, the left wall moves by `u_a - u_b`, which is the force `k_1 u + c_1 u'` on the
//! first mass, and every mass feels `-m u_b''`: forces on masses and a stop that is fixed in space, no
//! support at all. Motions of both agree, `y = z + u_b`, to the tolerance of the integrators.

use std::f64::consts::TAU;

use hammerbeam_motion::{
    PointMotion, Stretch,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe},
};
use hammerbeam_study::{Model, PointStart, PointStartKind, StudyFile};

const FREQUENCY_HZ: f64 = 2.1;
const STIFFNESS: [f64; 3] = [300.0, 200.0, 500.0];
const DAMPING: [f64; 3] = [0.7, 0.3, 1.1];
const MASS: [f64; 2] = [2.0, 1.5];
/// Amplitude and phase of the walls.
const LEFT: [f64; 2] = [2e-3, 0.4];
const RIGHT: [f64; 2] = [1.3e-3, -1.1];

const LAWS: [&str; 3] = [
    "law = \"hunt-crossley\"\nstiffness_n_m15 = 3.0e6\nloss_s_m = 0.4\n",
    "law = \"rigid\"\nrestitution = 0.6\n",
    "law = \"linear\"\nstiffness_n_m = 2.0e4\ndamping_n_s_m = 1.5\n",
];

/// The springs and dampers between these walls.
fn links([left, right]: [&str; 2]) -> String {
    let ends = [[left, "first"], ["first", "second"], ["second", right]];
    let mut text = String::new();
    for (k, [a, b]) in ends.iter().enumerate() {
        let (stiffness, damping) = (STIFFNESS[k], DAMPING[k]);
        text += &format!("[[structure.spring]]\nbetween = [\"{a}\", \"{b}\"]\nstiffness_n_m = {stiffness}\n");
        text += &format!("[[structure.damper]]\nbetween = [\"{a}\", \"{b}\"]\ndamping_n_s_m = {damping}\n");
    }
    text
}

fn built(text: String) -> Model {
    Model::build(&StudyFile::parse("study", text).unwrap_or_else(|error| panic!("{error}"))).unwrap()
}

fn masses(walls: &[&str]) -> String {
    let mut text = "[structure]\nkind = \"lumped\"\n".to_owned();
    let moving = [("first", MASS[0]), ("second", MASS[1])];
    for (name, mass) in moving.into_iter().chain(walls.iter().map(|wall| (*wall, 1.0))) {
        text += &format!("[[structure.mass]]\nname = \"{name}\"\nmass_kg = {mass:?}\n");
    }
    text
}

fn stop(carrier: &str, law: &str) -> String {
    format!("[[stop]]\nat = \"second\"\nfixed_to = \"{carrier}\"\nside = \"above\"\ngap_m = 1.0e-3\n{law}")
}

fn with_walls(law: &str) -> Model {
    let [a, p] = LEFT;
    let [b, q] = RIGHT;
    built(format!(
        "{}{}[excitation]\nkind = \"support-motion\"\nfrequency_hz = [1.0, 3.0]\nsupport = [\n\
         {{ at = \"wall a\", amplitude_m = {a:?}, phase_rad = {p:?} }},\n\
         {{ at = \"wall b\", amplitude_m = {b:?}, phase_rad = {q:?} }},\n]\n{}",
        masses(&["wall a", "wall b"]),
        links(["wall a", "wall b"]),
        stop("wall b", law)
    ))
}

/// Cosine and sine part of a motion `A cos(w t + p)`, and of its first two derivatives.
fn parts([amplitude, phase]: [f64; 2]) -> [[f64; 2]; 3] {
    let (sin, cos) = phase.sin_cos();
    let (c, s, w) = (amplitude * cos, -amplitude * sin, TAU * FREQUENCY_HZ);
    [[c, s], [w * s, -w * c], [-w * w * c, -w * w * s]]
}

fn with_forces(law: &str) -> Model {
    let (left, right) = (parts(LEFT), parts(RIGHT));
    let relative = |k: usize, part: usize| left[k][part] - right[k][part];
    let force = |mass: usize, part: usize| {
        let inertia = -MASS[mass] * right[2][part];
        let spring = STIFFNESS[0] * relative(0, part) + DAMPING[0] * relative(1, part);
        if mass == 0 { inertia + spring } else { inertia }
    };
    let polar = |mass: usize| {
        let (c, s) = (force(mass, 0), force(mass, 1));
        (c.hypot(s), (-s).atan2(c))
    };
    let ((first, p), (second, q)) = (polar(0), polar(1));
    built(format!(
        "{}{}[excitation]\nkind = \"force\"\nat = \"first\"\namplitude_n = {first:?}\nphase_rad = {p:?}\n\
         frequency_hz = [1.0, 3.0]\n[[load]]\nkind = \"force\"\nat = \"second\"\namplitude_n = {second:?}\n\
         order = 1\nphase_rad = {q:?}\n{}",
        masses(&[]),
        links(["ground", "ground"]),
        stop("space", law)
    ))
}

/// The state at phase 0 in which the masses have these displacements and velocities less those of a frame.
fn state(model: &Model, motion: [[f64; 2]; 2], frame: [f64; 2]) -> Vec<f64> {
    let kinds = [PointStartKind::Displacement, PointStartKind::Velocity];
    let start = |point: &str, mass: usize, k: usize| PointStart {
        point: point.to_owned(),
        kind: kinds[k],
        value: motion[mass][k] - frame[k],
    };
    let starts: Vec<PointStart> =
        (0..2).flat_map(|k| [start("first", 0, k), start("second", 1, k)]).collect();
    model.state_of_points(FREQUENCY_HZ, &starts).unwrap()
}

fn motion(model: &Model, state: &[f64], frame: [f64; 2]) -> [[f64; 2]; 2] {
    ["first", "second"].map(|name| {
        let point = model.system.model().point(name).unwrap();
        let moved = PointMotion::of(&model.system, FREQUENCY_HZ, &point.shape, &point.support_ratios);
        let [y, v, _] = moved.at(0.0, state, &[]);
        [y + frame[0], v + frame[1]]
    })
}

#[test]
fn a_stop_on_a_wall_of_its_own_motion_is_a_stop_at_rest_in_the_frame_of_that_wall() {
    let right = parts(RIGHT);
    let frame = [right[0][0], right[1][0]];
    for law in LAWS {
        let (walls, forces) = (with_walls(law), with_forces(law));
        let mut present = [[1e-3, 0.02], [-0.5e-3, 0.0]];
        let settings = ExactSettings { tolerance: 1e-12 };
        let mut exact = [&walls, &forces].map(|m| ExactIntegrator::new(m.system.clone(), settings).unwrap());
        let mut impacts = 0;
        for period in 0..6 {
            let stretch = Stretch { frequency_hz: FREQUENCY_HZ, start: 0.0, end: 1.0 };
            let states = [state(&walls, present, [0.0; 2]), state(&forces, present, frame)];
            let ends = [0, 1].map(|k| exact[k].flow(&stretch, &states[k]).unwrap());
            impacts += exact[0].trace(&stretch, &states[0], &[]).unwrap().contacts.len();
            let found = motion(&walls, &ends[0].state, [0.0; 2]);
            let expected = motion(&forces, &ends[1].state, frame);
            for (a, b) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!((a - b).abs() < 1e-9, "{law} period {period}: {found:?} {expected:?}");
            }
            // Multipliers are those of the same physics, too.
            let determinant = |flow: &hammerbeam_motion::Flow| flow.by_state.determinant();
            let [a, b] = [determinant(&ends[0]), determinant(&ends[1])];
            assert!((a - b).abs() < 1e-6 * b.abs().max(1e-3), "{law} period {period}: {a} {b}");
            let response = walls.system.model().point("second").unwrap();
            let watched = (response.shape.as_slice(), response.support_ratios.as_slice());
            let general = GeneralSettings::with_tolerance(1e-12);
            let second = observe(&walls.system, &stretch, &states[0], watched, &general).unwrap().flow;
            let size = ends[0].by_frequency.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            for (a, b) in ends[0].by_frequency.iter().zip(&second.by_frequency) {
                assert!((a - b).abs() < 1e-6 * size, "{law} period {period}: {a} {b}");
            }
            present = found;
        }
        assert!(impacts >= 4, "{law}: {impacts}");
    }
}
