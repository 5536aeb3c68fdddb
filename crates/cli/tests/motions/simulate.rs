//! `simulate`: samples, contacts, sections, initial states.

use super::{DUFFING, column, document, table};
use crate::common::{BEAM, Workshop, assert_bad_input, assert_success};

#[test]
fn simulate_writes_samples_contacts_and_a_section() {
    let workshop = Workshop::with(BEAM);
    let arguments =
        ["simulate", "study.toml", "--frequency", "36", "--periods", "5", "--transient-periods", "300"];
    let more = ["--samples-per-period", "100", "--section-phase", "0.33", "--out", "motion", "--json"];
    let document = document(&workshop, &[&arguments[..], &more].concat());
    assert_eq!(document["samples"], 500);
    let contacts = document["contacts"].as_u64().unwrap();
    assert_eq!(document["contact_list"].as_array().unwrap().len() as u64, contacts);
    assert!((document["time_s"].as_f64().unwrap() - 5.0 / 36.0).abs() < 1e-12);
    let samples = table(&workshop, "motion/samples.csv");
    assert_eq!(samples.len(), 501);
    let times = column(&samples, "time_s");
    assert!((times[100] - 1.0 / 36.0).abs() < 1e-12);
    // The motion has settled to a harmonic one: the first and the last period agree.
    let displacements = column(&samples, "displacement_m");
    assert!((displacements[3] - displacements[403]).abs() < 1e-8 * displacements[3].abs());
    let rows = table(&workshop, "motion/contacts.csv");
    assert_eq!(rows.len() as u64, contacts + 1);
    let peak = column(&rows, "peak_force_n").into_iter().fold(0.0, f64::max);
    assert_eq!(document["max_contact_force_n"].as_f64().unwrap(), peak);
    let section = table(&workshop, "motion/stroboscopic.csv");
    assert_eq!(section.len(), 6);
    assert!(column(&section, "phase_cycles").iter().all(|phase| *phase == 0.33));
    assert_eq!(section[0].len(), 4 + 12);
}

/// A given state, and the same state as the orbit of a stored branch, which repeats.
#[test]
fn simulate_begins_where_it_is_told() {
    let workshop = Workshop::changed(DUFFING, "[0.08, 0.5]", "[0.08, 0.3]");
    assert_success(&workshop.compute(&[]));
    let start = ["simulate", "study.toml", "--frequency", "0.2", "--periods", "3", "--json", "--initial"];
    let of = |initial: &[&str]| document(&workshop, &[&start[..], initial].concat());
    let orbit = of(&["branch:1", "--results", "results"]);
    let state: Vec<f64> =
        orbit["final_modal_state"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let again = of(&[&format!("{:e},{:e}", state[0], state[1])]);
    for (k, entry) in state.iter().enumerate() {
        let other = again["final_modal_state"][k].as_f64().unwrap();
        assert!((entry - other).abs() < 1e-7, "after three more periods: {entry} {other}");
    }
    // Both ends of the branch, which are those of the range, belong to it.
    for end_hz in ["0.08", "0.3"] {
        let at_end = ["simulate", "study.toml", "--frequency", end_hz, "--periods", "1", "--json"];
        let found =
            document(&workshop, &[&at_end[..], &["--initial", "branch:1", "--results", "results"]].concat());
        assert!(found["max_abs_sampled_displacement_m"].as_f64().unwrap() > 0.0);
    }
    let linear = of(&["linear"]);
    assert!(linear["max_abs_sampled_displacement_m"].as_f64().unwrap() > 0.0);
}

/// A period is held in memory as a whole, whether it is kept or not: sixty masses in a row.
#[test]
fn samples_that_do_not_fit_into_memory_are_refused() {
    let masses: Vec<String> = (1..=60).map(|k| format!("{{ name = \"m{k}\", mass_kg = 1.0 }}")).collect();
    let spring = |k: u32| {
        let next = if k < 60 { format!("m{}", k + 1) } else { "ground".to_owned() };
        format!("{{ between = [\"m{k}\", \"{next}\"], stiffness_n_m = 1.0 }}")
    };
    let springs: Vec<String> = (1..=60).map(spring).collect();
    let study = format!(
        "[structure]\nkind = \"lumped\"\nmass = [{}]\nspring = [{}]\n[damping]\nmodal_ratio = \
        0.02\n[excitation]\nkind = \"force\"\nat = \"m1\"\namplitude_n = 0.4\nfrequency_hz = [0.1, 0.2]\n",
        masses.join(", "),
        springs.join(", ")
    );
    let workshop = Workshop::with(&study);
    let before = workshop.listing();
    let motion = ["simulate", "study.toml", "--frequency", "0.1", "--samples-per-period", "1000000"];
    for more in [&["--periods", "1"][..], &["--periods", "1", "--out", "out"]] {
        let message =
            ["is 131000000 numbers in a period, must be 100000000 at most; allowed: 1 to 763358 samples"];
        assert_bad_input(&workshop.hammerbeam(&[&motion[..], more].concat()), &message);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}
