//! Structures that rest on their stop at phase 0, in a state that is thousands of times smaller than their
//! orbit.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_orbit::BranchEventKind;

use crate::common::{Workshop, assert_success, stdout, stored};

/// 1 kg on 100 N/m, critically damped, pressed with 2 N against a stiff stop; the force of 10 N presses it on
/// at phase 0.
fn study(phase_rad: f64, tolerance: f64) -> Workshop {
    Workshop::with(&format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "m", mass_kg = 1.0 }}]
spring = [{{ between = ["m", "ground"], stiffness_n_m = 100.0 }}]
[damping]
modal_ratio = 1.0
[excitation]
kind = "force"
at = "m"
amplitude_n = 10.0
phase_rad = {phase_rad}
frequency_hz = [0.58, 0.61]
[[stop]]
at = "m"
law = "hertz"
stiffness_n_m15 = 1.0e6
preload_n = 2.0
side = "above"
[search]
frequencies = 4
trials = 0
[continuation]
max_step_hz = 5e-4
budget_solutions = 2000
tolerance = {tolerance:e}
"#
    ))
}

/// Solutions that a run stores, every one of which is computed again and agrees: a residual of 1e-9 of the
/// orbit is several millionths of the state at phase 0.
fn verified(phase_rad: f64, tolerance: f64) -> u64 {
    let workshop = study(phase_rad, tolerance);
    let run = workshop.compute(&["--json"]);
    assert_success(&run);
    let output = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    assert_success(&output);
    let document: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    document["stored"].as_u64().unwrap()
}

/// Where the structure rests at phase 0 and, half a period later, where it flies.
#[test]
fn solutions_agree_whatever_the_phase_at_which_the_structure_rests() {
    for phase_rad in [0.0, std::f64::consts::PI] {
        assert!(verified(phase_rad, 1e-10) >= 60);
    }
}

/// Five thousandths of a hertz are sixty steps; relative to the state at phase 0 a tolerance of 1e-12 of the
/// orbit is below rounding, and the walk would make thousands of solutions.
#[test]
fn a_close_tolerance_does_not_keep_a_walk_from_its_way() {
    let (loose, close) = (verified(0.0, 1e-10), verified(0.0, 1e-12));
    assert!(close < 2 * loose, "{close}, {loose}");
}

/// A tip that rests on its seat is driven open. Where it opens its displacement grows from zero like a power
/// of the distance: beside a motion a million times as large no row need tell its digits. With the tip at
/// rest the blade is an oscillator, and the seat presses until it moves by 0.35/2500 m: at 220.6 Hz.
#[test]
fn a_seat_that_opens_takes_few_rows_and_is_a_contact_up_to_there_and_beyond() {
    let workshop = Workshop::with(
        r#"
[structure]
kind = "lumped"
mass = [{ name = "blade", mass_kg = 0.004 }, { name = "tip", mass_kg = 0.0015 }]
spring = [
    { between = ["blade", "ground"], stiffness_n_m = 900.0 },
    { between = ["blade", "tip"], stiffness_n_m = 2500.0 },
]
[damping]
modal_ratio = 0.02
[excitation]
kind = "force"
at = "blade"
amplitude_n = 0.6
frequency_hz = [219.0, 222.0]
[[load]]
kind = "force"
at = "tip"
amplitude_n = -0.35
order = 0
[[stop]]
at = "tip"
law = "rigid"
restitution = 0.55
side = "below"
gap_m = 0.0
[search]
frequencies = 1
trials = 0
[continuation]
max_step_hz = 0.01
"#,
    );
    let run = workshop.compute(&[]);
    assert_success(&run);
    let (_, branches) = stored(&workshop);
    let rows: Vec<_> =
        branches.branches().iter().flat_map(|branch| &branch.rows).map(|placed| &placed.row).collect();
    let opens: Vec<_> = rows.iter().filter(|row| row.events.has(BranchEventKind::Grazing)).collect();
    assert_eq!(opens.len(), 1);
    assert!((opens[0].frequency_hz - 220.6).abs() < 0.05, "{}", opens[0].frequency_hz);
    let beside = rows.iter().filter(|row| (row.frequency_hz - opens[0].frequency_hz).abs() < 0.02).count();
    assert!(beside < 200, "{beside} rows");
    assert!(rows.iter().all(|row| row.maxima.contacts >= 1));
}
