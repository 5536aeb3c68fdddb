//! What `--initial` refuses, command by command.

use super::{IMPACT_OSCILLATOR, remembering};
use crate::common::{Workshop, assert_bad_input, short_run, stderr};

/// Behind a rigid stop, or within a contact of an impact-speed-dependent law; of `simulate` see `refused.rs`.
#[test]
fn lyapunov_and_sweep_refuse_states_in_which_no_motion_begins() {
    let rigid = Workshop::with(IMPACT_OSCILLATOR);
    let memory = Workshop::with(&remembering());
    for (workshop, initial, part) in [
        (
            &rigid,
            "1.5,0",
            "--initial 1.5,0, at 0.3 Hz: the state lies 5.000e-1 m behind the rigid stop \"stop\"",
        ),
        (&memory, "0.1,0", "the state lies 1.000e-1 m within the contact of \"stop\""),
    ] {
        for command in [
            &["lyapunov", "study.toml", "--frequency", "0.3"][..],
            &["sweep", "study.toml", "--from", "0.3", "--to", "0.4"],
        ] {
            let arguments = [command, &["--initial", initial, "--out", "out"]].concat();
            assert_bad_input(&workshop.hammerbeam(&arguments), &[part]);
            assert!(!workshop.path("out").exists(), "something was written");
        }
    }
}

/// The run has one branch, which ends at 14 Hz.
#[test]
fn branches_that_are_not_there_are_refused_by_every_command() {
    let workshop = short_run();
    let before = workshop.listing();
    for command in [
        &["simulate", "study.toml", "--frequency", "15"][..],
        &["lyapunov", "study.toml", "--frequency", "15"],
        &["sweep", "study.toml", "--from", "15", "--to", "16"],
    ] {
        let of = |branch: &str| {
            workshop.hammerbeam(&[command, &["--initial", branch, "--results", "results"]].concat())
        };
        for branch in ["branch:2", "branch:0", "branch:x", "branch:"] {
            let name = &branch["branch:".len()..];
            let part = format!("--initial: there is no branch {name:?}; allowed: 1 to 1");
            assert_bad_input(&of(branch), &[&part]);
        }
        let output = of("branch:1");
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(stderr(&output).contains("branch 1 does not cross 15 Hz"), "{}", stderr(&output));
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

/// Without a load a mass on a spring moves as `y = Y cos(w t) + (V/w) sin(w t)`, `w^2 = 25/s^2`; until it
/// meets its stop.
#[test]
fn a_motion_starts_from_displacements_and_velocities_of_points() {
    let study = "[structure]\nkind = \"lumped\"\nmass = [{ name = \"ball\", mass_kg = 4.0 }]\n\
        spring = [{ between = [\"ball\", \"ground\"], stiffness_n_m = 100.0 }]\n\
        [excitation]\nkind = \"force\"\nat = \"ball\"\namplitude_n = 1e-12\nfrequency_hz = [0.5, 2.0]\n\
        [response]\npoint = \"ball\"\n";
    let workshop = Workshop::with(study);
    let start = ["--initial", "ball.y=0.01,ball.v=-0.2", "--periods", "1", "--samples-per-period", "4"];
    let simulate = ["simulate", "study.toml", "--frequency", "1", "--out", "out"];
    crate::common::assert_success(&workshop.hammerbeam(&[&simulate[..], &start].concat()));
    let samples = super::table(&workshop, "out/samples.csv");
    let displacements = super::column(&samples, "displacement_m");
    for (k, found) in displacements.into_iter().enumerate() {
        let (sin, cos) = (5.0 * 0.25 * k as f64).sin_cos();
        let expected = 0.01 * cos - 0.2 / 5.0 * sin;
        assert!((found - expected).abs() < 1e-11, "{k}: {found} instead of {expected}");
    }
    for (initial, part) in [
        ("balls.y=1", "\"balls\" is not a point of this structure; there are ball, ground"),
        ("ball.x=1", "allowed: POINT.y=METRES and POINT.v=METRES_PER_SECOND"),
        ("ball.y=1,ball.v=1,ball.y=1", "--initial: ball.y is given twice; allowed: once"),
        ("ground.y=1e-3", "point \"ground\" cannot move by 0.001 there: the others leave it 0"),
    ] {
        let output =
            workshop.hammerbeam(&["simulate", "study.toml", "--frequency", "1", "--initial", initial]);
        assert_bad_input(&output, &[part]);
    }
}
