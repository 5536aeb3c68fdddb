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
    refused(
        &["--detail", "84:93"],
        &["84:93", "no stored solution is inside; over the frequency there are some from 0.1 to 0.12"],
    );
    refused(&["--detail", "excitation.frequency_hz=84:93"], &["no stored solution is inside"]);
    refused(
        &["--detail", "excitation.amplitude_n=0.7:0.8"],
        &["no stored solution is inside; over excitation.amplitude_n there are some from 0.2 to 0.6"],
    );
    refused(&["--detail", "excitation.amplitude_n=-5:3"], &["these are all solutions", "from 0.2 to 0.6"]);
    refused(
        &["--detail", "stop.wall.gap_m=0:1"],
        &["no branch over stop.wall.gap_m; there are branches over excitation.amplitude_n"],
    );
    refused(
        &["--detail", "0.1:0.11", "--detail", "0.1:0.115"],
        &["the same axis has another detail already"],
    );
    refused(&["--detail", "0.1:0.11", "--kind", "vary"], &["--detail 0.1:0.11", "--kind leaves out"]);
    for wrong in
        ["0.2:0.1", "0:1", "=0.1:0.11", "excitation.amplitude_n=0.3", "excitation.amplitude_n=0.3:nan"]
    {
        refused(&["--detail", wrong], &["two frequencies in hertz, the lower one first", wrong]);
    }
}

/// Of two pieces over one parameter one has nothing there: its figure is whole.
#[test]
fn figures_with_nothing_in_the_detail_are_drawn_without_it() {
    let vary = |low: f64, high: f64| {
        format!(
            "[[vary]]\nparameter = \"excitation.amplitude_n\"\nrange = [{low}, {high}]\nfrequency_hz = 0.11\n"
        )
    };
    let workshop = Workshop::driven_mass(&format!(
        "frequency_hz = [0.10, 0.12]\n[search]\nfrequencies = 1\nstarts = 1\ntrials = 0\n{}{}",
        vary(0.2, 0.6),
        vary(0.3, 0.4)
    ));
    assert_success(&workshop.hammerbeam(&RUN));
    let drawn = ["figure", "results", "--format", "svg", "--detail", "excitation.amplitude_n=0.5:0.55"];
    assert_success(&workshop.hammerbeam(&[&drawn[..], &["--out", "drawn"]].concat()));
    let panels = |piece: u32| {
        let name = format!("drawn/vary_{piece}_excitation_amplitude_n_displacement.svg");
        let svg = fs::read_to_string(workshop.path(&name)).unwrap();
        svg.matches(">Excitation amplitude (N)<").count()
    };
    assert_eq!([panels(1), panels(2)], [2, 1]);
}

/// Folders that are laid over one another have one axis, and solutions of any of them are in a detail.
#[test]
fn a_detail_may_lie_where_only_other_results_are() {
    let workshop = linear_run();
    let set = ["--set", "excitation.frequency_hz=[0.115, 0.13]", "--out", "wider"];
    assert_success(&workshop.hammerbeam(&[&["run", "study.toml"][..], &set].concat()));
    let detail = ["figure", "results", "--kind", "response", "--detail", "0.125:0.128", "--out", "drawn"];
    assert_bad_input(&workshop.hammerbeam(&detail), &["no stored solution is inside"]);
    assert_success(&workshop.hammerbeam(&[&detail[..], &["--with", "wider"]].concat()));
}

/// A row that is gone costs the figures that need it, whether or not they have a detail.
#[test]
fn a_missing_solution_costs_no_other_figure() {
    let workshop = linear_run();
    let database = crate::common::database(workshop.path("results/results.db"));
    assert!(database.execute("DELETE FROM solution WHERE (id & 4294967295) = 3", []).unwrap() > 0);
    database.close().unwrap();
    let drawn = ["figure", "results", "--out", "drawn", "--format", "svg", "--detail", "0.105:0.11"];
    assert_success(&workshop.hammerbeam(&drawn));
    assert!(workshop.path("drawn/structure.svg").exists());
}
