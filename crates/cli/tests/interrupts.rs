//! Ctrl-C and SIGTERM in the midst of work that takes minutes: answered in a moment, and what is finished is
//! kept.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![cfg(unix)]

use std::{
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::common::{Workshop, assert_success, stderr};

/// Far beyond the second that is promised, for machines under load, and far below what the work would take.
const MOMENT: Duration = Duration::from_secs(15);

/// The beam with little damping.
const LITTLE_DAMPING: &str = include_str!("../../../studies/beam-with-stop-low-damping.toml");

/// One mass against a stop; the text is the rest of the study.
fn against_a_stop(mass_kg: f64, damping_n_s_m: f64, rest: &str) -> Workshop {
    Workshop::with(&format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "mass", mass_kg = {mass_kg:e} }}]
spring = [{{ between = ["mass", "ground"], stiffness_n_m = 1000.0 }}]
damper = [{{ between = ["mass", "ground"], damping_n_s_m = {damping_n_s_m:e} }}]
[excitation]
kind = "force"
at = "mass"
amplitude_n = 5.0
frequency_hz = [2.0, 10.0]
[[stop]]
at = "mass"
law = "linear"
stiffness_n_m = 1.0e4
gap_m = 3.0e-3
side = "above"
{rest}
"#
    ))
}

/// Stops behind the first one.
fn nineteen_further_stops() -> String {
    let of_all = "at = \"mass\"\nlaw = \"linear\"\nstiffness_n_m = 1.0e4\nside = \"above\"";
    (31..50).map(|gap: u32| format!("[[stop]]\n{of_all}\ngap_m = {gap}e-4\n")).collect()
}

/// Ends a command by a signal, after so long; how long it took to answer.
fn ended(child: Child, after: Duration, signal: &str) -> Duration {
    thread::sleep(after);
    let sent = Instant::now();
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
    sent.elapsed()
}

#[test]
fn work_that_takes_minutes_is_left_in_a_moment() {
    let slow = [
        against_a_stop(1.0, 1e15, ""),
        against_a_stop(1e-12, 0.5, ""),
        against_a_stop(1.0, 0.5, "[search]\nsettling_periods = 1000000"),
        against_a_stop(1.0, 0.5, &nineteen_further_stops()),
    ];
    let commands =
        [&["run", "study.toml", "--out", "results"][..], &["orbit", "study.toml", "--frequency", "5"]];
    let mut met = 0;
    for (study, workshop) in slow.iter().enumerate() {
        for (arguments, signal) in commands.into_iter().zip(["-TERM", "-INT"]) {
            let mut child = workshop.spawn(arguments);
            thread::sleep(Duration::from_secs(1));
            // What is done before that is no matter for this test.
            if child.try_wait().unwrap().is_some() {
                continue;
            }
            let answered = ended(child, Duration::ZERO, signal);
            assert!(answered < MOMENT, "study {study}, {arguments:?}: {answered:?}");
            met += 1;
        }
    }
    assert!(met >= 5, "only {met} of 8 commands were still at work");
}

/// The first one waits for the piece of work that is at hand, and says so before it ends the process; a
/// second one ends it without a word.
#[test]
fn a_second_signal_ends_at_once_and_keeps_what_was_stored() {
    let workshop = against_a_stop(1.0, 0.5, "[search]\nsettling_periods = 1000000");
    // The first one is answered by a document. Where the piece of work ends between the two it is there: then
    // once more.
    let at_once = (0..8).any(|_| {
        let run = ["run", "study.toml", "--out", "results", "--jobs", "1", "--json"];
        let child = workshop.spawn_into(Stdio::piped(), &run);
        thread::sleep(Duration::from_secs(3));
        for signal in ["-INT", "-TERM"] {
            let _ = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
            thread::sleep(Duration::from_millis(20));
        }
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
        if output.stdout.is_empty() {
            return true;
        }
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(document["error"]["exit_code"], 130, "{document}");
        false
    });
    assert!(at_once, "the second signal was never answered before the first");
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    assert!(!workshop.table("results/export/branches.csv").is_empty());
}

#[test]
fn what_was_stored_before_a_long_computation_is_kept_and_goes_on() {
    let workshop = against_a_stop(1.0, 0.5, "[search]\nsettling_periods = 1000000");
    let run = ["run", "study.toml", "--out", "results", "--jobs", "1"];
    let answered = ended(workshop.spawn(&run), Duration::from_secs(4), "-TERM");
    assert!(answered < MOMENT, "{answered:?}");
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    let rows = || workshop.table("results/export/branches.csv").len();
    let before = rows();
    ended(workshop.spawn(&run), Duration::from_secs(4), "-INT");
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    assert!(rows() >= before, "{} rows, {before} before", rows());
}

/// The beam with little damping at a frequency at which the first solution is there at once, and the search
/// for others goes on for seconds.
#[test]
fn an_interrupted_search_for_orbits_gives_what_it_has_found() {
    let workshop = Workshop::with(LITTLE_DAMPING);
    let orbit = ["orbit", "study.toml", "--frequency", "33.6", "--json"];
    // It may be that nothing is found so early, or that the search has ended by then.
    let gave = (0..6).any(|doublings| {
        let child = workshop.spawn_into(Stdio::piped(), &orbit);
        thread::sleep(Duration::from_millis(400 << doublings));
        let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        if output.status.code() != Some(130) || output.stdout.is_empty() {
            return false;
        }
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        if document.get("error").is_some() {
            return false;
        }
        assert_eq!(document["search_complete"], false, "{document}");
        assert_eq!(document["frequency_hz"], 33.6, "{document}");
        true
    });
    assert!(gave, "no interrupted search gave a solution");
}
