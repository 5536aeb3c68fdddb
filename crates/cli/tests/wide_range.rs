//! Ranges over many decades, and what cannot be resolved in them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{COMPUTE, Workshop, assert_success, number, stderr};

/// The mass of the other tests, and a stop that it reaches about its resonance only.
fn study(high: &str) -> String {
    format!(
        "frequency_hz = [0.01, {high}]\n[[stop]]\nat = \"m\"\nside = \"above\"\n\
         law = \"linear\"\nstiffness_n_m = 10.0\ngap_m = 5.0\n\
         [search]\nfrequencies = 3\nstarts = 1\n[continuation]\nbudget_solutions = 20000\n"
    )
}

/// Up to six million times the eigenfrequency: amplitude `F/sqrt((1 - w^2)^2 + c^2 w^2)` where the stop is
/// not reached.
#[test]
fn a_range_over_eight_decades_has_one_branch_from_end_to_end() {
    let workshop = Workshop::driven_mass(&study("1e6"));
    assert_success(&workshop.compute(&[]));
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    for end in workshop.table("results/export/ends.csv") {
        assert_eq!((&end["branch"][..], &end["end"][..]), ("1", "range-end"));
    }
    let rows = workshop.table("results/export/branches.csv");
    for row in rows.iter().filter(|row| number(row, "contacts") == 0.0) {
        let w = std::f64::consts::TAU * number(row, "frequency_hz");
        let expected = 0.4 / (1.0 - w * w).hypot(0.04 * w);
        let share = number(row, "max_abs_displacement_m") / expected;
        // Displacements are small beside velocities, in which orbits are measured, by the frequency over that
        // at the start; and a point is within 1e-10 of a hundredth of the range from the path.
        let (off, damping) = (1.0 - w * w, 0.04 * 0.04);
        let by_rate = (2.0 * off.abs() + damping) * w / (off * off + damping * w * w);
        let by_path = std::f64::consts::TAU * 1e-12 * 1e6 * by_rate;
        assert!((share - 1.0).abs() < 1e-9 * (1.0 + w) + by_path, "{share} at {w} rad/s");
    }
}

#[test]
fn a_range_beyond_what_can_be_resolved_is_refused() {
    let tried = |command: &[&str], high: &str| {
        let output = Workshop::driven_mass(&study(high)).hammerbeam(command);
        (output.status.code(), stderr(&output))
    };
    for command in [&["check", "study.toml"][..], &COMPUTE] {
        let (code, reported) = tried(command, "1e10");
        // Ten million times sqrt(k/m)/(2 pi).
        assert!(
            code == Some(2) && reported.contains("reaches 1e10 Hz") && reported.contains("up to 1.592e6 Hz"),
            "{reported}"
        );
    }
    assert_eq!(tried(&["check", "study.toml"], "1.59e6"), (Some(0), String::new()));
}
