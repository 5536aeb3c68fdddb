//! Plastic stops, which give nothing back: branches get on across the grazing of one that sticks elsewhere.
use crate::{
    common::{Workshop, assert_success, number},
    corners::{WHOLE, assert_whole, grazings, one_mass},
};

/// A mass between a stop that gives nothing back and one that does: it leaves the first one without speed,
/// which is no turn of its flight at the level of the stop. Taken as one, it held steps up to 1e-5 of the
/// longest.
const PLASTIC: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 0.719 }]
spring = [{ between = ["a", "ground"], stiffness_n_m = 1971.0 }]
[damping]
modal_ratio = 0.01
[excitation]
kind = "force"
at = "a"
amplitude_n = 2.04
frequency_hz = [2.9, 18.3]
[[stop]]
name = "plastic"
at = "a"
law = "rigid"
restitution = 0
gap_m = 0.00105
side = "above"
[[stop]]
name = "elastic"
at = "a"
law = "rigid"
restitution = 0.7
gap_m = 0.00514
side = "below"
[continuation]
max_step_hz = 0.0257
[search]
frequencies = 8
starts = 4
trials = 4
"#;

/// Two masses at a plastic stop, which sticks and is grazed later in the same period. Beside 4.11608 Hz it is
/// left with hardly any speed.
fn left_without_speed([low, high]: [f64; 2], longest_step: f64, searches: u32) -> String {
    format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "a", mass_kg = 0.360607 }}, {{ name = "b", mass_kg = 1.59979 }}]
spring = [
    {{ between = ["a", "ground"], stiffness_n_m = 984.172 }},
    {{ between = ["b", "a"], stiffness_n_m = 1346.13 }},
]
[damping]
modal_ratio = 0.04
[excitation]
kind = "force"
at = "b"
amplitude_n = 2.64051
frequency_hz = [{low}, {high}]
[[stop]]
name = "s0"
at = "a"
law = "rigid"
restitution = 0
gap_m = 0.000440634
side = "above"
[search]
frequencies = {searches}
starts = {searches}
trials = {searches}
[continuation]
max_step_hz = {longest_step}
"#
    )
}

/// Three masses of which one is between two plastic stops. It leaves one of them as it grazes the other.
const TWO_PLASTIC: &str = r#"
[structure]
kind = "lumped"
mass = [
    { name = "a", mass_kg = 2.20463 },
    { name = "b", mass_kg = 2.1851 },
    { name = "c", mass_kg = 2.01868 },
]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 958.481 },
    { between = ["b", "a"], stiffness_n_m = 1724.59 },
    { between = ["c", "b"], stiffness_n_m = 460.814 },
]
[damping]
modal_ratio = 0.04
[excitation]
kind = "force"
at = "c"
amplitude_n = 3.31365
frequency_hz = [0.538581, 3.38537]
[[stop]]
name = "upper"
at = "a"
law = "rigid"
restitution = 0
gap_m = 0.0056864
side = "above"
[[stop]]
name = "lower"
at = "a"
law = "rigid"
restitution = 0
gap_m = 0.00679542
side = "below"
[search]
frequencies = 2
starts = 4
trials = 4
[continuation]
max_step_hz = 0.00474464
"#;

#[test]
fn a_branch_at_a_plastic_stop_gets_on() {
    let workshop = Workshop::exported(PLASTIC);
    assert_whole(&workshop, (2.9, 18.3), WHOLE);
    let rows = workshop.table("results/export/branches.csv");
    // The range is 600 of the longest steps.
    assert!(rows.len() < 4000, "{} solutions", rows.len());
    assert!(rows.iter().any(|row| number(row, "max_impact_velocity_m_s") > 0.0));
}

/// An impact on a plastic stop that does not stick is a contact beside one that does.
#[test]
fn a_branch_goes_on_across_the_grazing_of_a_plastic_stop_that_sticks_elsewhere() {
    let workshop = Workshop::exported(&left_without_speed([1.01081, 6.35364], 0.00890472, 4));
    assert_whole(&workshop, (1.01081, 6.35364), WHOLE);
    let rows = workshop.table("results/export/branches.csv");
    let contacts = |wanted: f64| rows.iter().any(|row| number(row, "contacts") == wanted);
    assert!(contacts(1.0) && contacts(2.0));
}

/// What a stop lets go is no turn before it: taken for one, it was to graze together with the other stop.
#[test]
fn a_branch_goes_on_across_a_grazing_beside_which_another_plastic_stop_lets_go() {
    let workshop = Workshop::exported(TWO_PLASTIC);
    assert_whole(&workshop, (0.538581, 3.38537), WHOLE);
    assert_eq!(workshop.table("results/export/ends.csv").len(), 2);
}

/// The general integrator met it again with each step, and each brief hop was a slow touch: what is left of
/// its speed is rounding, which let steps shrink.
#[test]
fn solutions_at_a_stop_that_is_left_without_speed_are_verified() {
    let beside = left_without_speed([4.11607, 4.1161], 2e-7, 1);
    let workshop = Workshop::exported(&beside);
    let rows = workshop.table("results/export/branches.csv").len();
    assert!((100..400).contains(&rows), "{rows}");
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
}

/// A stop that gives nothing back is struck before it is pressed on: the mass hops, and comes again. The
/// shorter hop says less well when; it was counted now and then, on either stop for itself.
#[test]
fn both_plastic_stops_are_struck_once_more_from_one_grazing_on() {
    let study =
        one_mass([0.9, 320.0, 0.02, 2.5], [1.62, 1.64], "restitution = 0\nside = \"both\"\ngap_m = 0.006");
    let workshop = Workshop::exported(&study);
    assert_whole(&workshop, (1.62, 1.64), WHOLE);
    let (grazings, rows) = (grazings(&workshop), workshop.table("results/export/branches.csv"));
    assert!(!grazings.is_empty() && grazings.iter().all(|hz| (hz / grazings[0] - 1.0).abs() < 1e-12));
    let contacts = |wanted: f64| rows.iter().filter(|row| number(row, "contacts") == wanted).count();
    assert!(contacts(3.0) <= 1 && contacts(2.0) + contacts(4.0) + contacts(3.0) == rows.len());
}
