//! Crowded parts of diagrams that are drawn again, larger.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{fs, sync::LazyLock};

use crate::common::{RUN, Workshop, assert_bad_input, assert_success};

/// A linear oscillator over frequency and amplitude.
fn linear_run() -> Workshop {
    static DONE: LazyLock<Workshop> = LazyLock::new(|| {
        let workshop = Workshop::driven_mass(
            "frequency_hz = [0.10, 0.12]\n[search]\nfrequencies = 1\nstarts = 1\ntrials = 0\n[continuation]\n\
            max_step_hz = 0.002\n[[vary]]\nparameter = \"excitation.amplitude_n\"\nrange = [0.2, 0.6]\n\
            frequency_hz = 0.11\n",
        );
        assert_success(&workshop.hammerbeam(&RUN));
        workshop
    });
    DONE.copied()
}

/// Numbers along the axes of a figure.
fn has_tick(svg: &str, tick: &str) -> bool {
    svg.contains(&format!(">{tick}<"))
}

#[test]
fn each_axis_has_its_detail() {
    let workshop = linear_run();
    let details = ["--detail", "0.11:0.112", "--detail", "excitation.amplitude_n=0.31:0.32"];
    let drawn = [&["figure", "results", "--format", "svg", "--out", "drawn"][..], &details].concat();
    assert_success(&workshop.hammerbeam(&drawn));
    let svg = |name: &str| fs::read_to_string(workshop.path(name)).unwrap();
    let (frequency, amplitude) =
        (svg("drawn/response_displacement.svg"), svg("drawn/vary_1_excitation_amplitude_n_displacement.svg"));
    assert_eq!(frequency.matches(">Excitation frequency (Hz)<").count(), 2);
    assert!(has_tick(&frequency, "0.1110") && has_tick(&frequency, "0.116"));
    assert_eq!(amplitude.matches(">Excitation amplitude (N)<").count(), 2);
    assert!(has_tick(&amplitude, "0.315") && has_tick(&amplitude, "0.45"));
}

#[test]
fn details_that_no_diagram_shows_are_refused() {
    let workshop = linear_run();
    let refused = |details: &[&str], parts: &[&str]| {
        let drawn = [&["figure", "results", "--out", "refused"][..], details].concat();
        assert_bad_input(&workshop.hammerbeam(&drawn), parts);
        assert!(!workshop.path("refused").exists());
    };
    refused(&["--detail", "84:93"], &["--detail 84:93: no solution is inside", "0.1 to 0.12 over the freq"]);
    refused(
        &["--detail", "excitation.amplitude_n=0.7:0.8"],
        &["no solution is inside; there are some from 0.2 to 0.6 over excitation.amplitude_n"],
    );
    refused(
        &["--detail", "stop.wall.gap_m=0:1"],
        &["no branch over stop.wall.gap_m; there are branches over excitation.amplitude_n"],
    );
    refused(&["--detail", "0.1:0.11", "--detail", "0.1:0.12"], &["the same axis has another detail already"]);
    refused(&["--detail", "0.1:0.11", "--kind", "vary"], &["--kind leaves its diagrams out"]);
    for wrong in ["0.2:0.1", "0:1", "excitation.amplitude_n=0.3", "excitation.amplitude_n=0.3:nan"] {
        refused(&["--detail", wrong], &["two frequencies in hertz, the lower one first", wrong]);
    }
}
