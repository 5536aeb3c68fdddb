//! Contacts that lose energy, from the study file to verified branches.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{Workshop, assert_success, mass_against_a_stop as study, stderr, stdout};
use serde_json::Value;

/// Two masses whose largest contact force moves across the border of two steps of the integrator, where the
/// polynomial of neither gives its place well: it is that of the general integrator.
#[test]
fn a_force_that_is_largest_at_the_border_of_two_steps_is_verified() {
    let one_mass = study("law = \"hu-guo\"\nstiffness_n_m15 = 20.0\nrestitution = 0.7");
    let second = "[[structure.mass]]\nname = \"second\"\nmass_kg = 0.4\n[[structure.spring]]\nbetween = \
    [\"mass\", \"second\"]\nstiffness_n_m = 3.0\n";
    let two_masses = one_mass[..one_mass.find("[[vary]]").unwrap()]
        .replace("[damping]", &format!("{second}[damping]"))
        .replace("stiffness_n_m = 1000.0", "stiffness_n_m = 1.0")
        .replace("modal_ratio = 0.02", "modal_ratio = 0.03")
        .replace("amplitude_n = 5.0", "amplitude_n = 0.3")
        .replace("frequency_hz = [5.2, 6.4]\nphase_rad = -2.2", "frequency_hz = [0.16635, 0.16637]")
        .replace("gap_m = 0.02", "gap_m = 0.5")
        .replace("max_step_hz = 0.01", "max_step_hz = 2e-7")
        .replace("frequencies = 1\nstarts = 1", "frequencies = 3\nstarts = 3");
    let workshop = Workshop::with(&two_masses);
    assert_success(&workshop.compute(&["--jobs", "1"]));
    let verify = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    let document: Value = serde_json::from_str(&stdout(&verify)).unwrap();
    assert_eq!(document["agree"], true, "{document}");
    assert!(document["sampled"].as_u64().unwrap() > 150, "{document}");
}

/// With the phase 0 in the middle of the contact the orbit begins at another phase and is the same.
#[test]
fn an_orbit_in_contact_at_phase_0_is_found() {
    let stop = "law = \"flores\"\nstiffness_n_m15 = 1e4\nrestitution = 0.7";
    let found = ["-2.2", "0.0"].map(|phase| {
        let workshop =
            Workshop::with(&study(stop).replace("phase_rad = -2.2", &format!("phase_rad = {phase}")));
        let orbit = workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "5.1", "--json"]);
        assert_success(&orbit);
        let document: Value = serde_json::from_str(&stdout(&orbit)).unwrap();
        assert!(document["contacts"].as_u64().unwrap() > 0);
        document["max_abs_displacement_m"].as_f64().unwrap()
    });
    // Orbits are accepted at 1e-10.
    assert!((found[0] / found[1] - 1.0).abs() < 1e-8, "{found:?}");
}

/// A contact that passes phase 0 on the branch moves the phase: the run goes to both ends, and `verify`
/// agrees with the stored orbits at their phases.
#[test]
fn a_branch_whose_contact_passes_phase_0_is_followed_and_verified() {
    let stop = "law = \"lankarani-nikravesh\"\nstiffness_n_m15 = 1e4\nrestitution = 0.7";
    let workshop = Workshop::with(&study(stop).replace("phase_rad = -2.2", "phase_rad = 1.0"));
    let run = workshop.compute(&["--jobs", "1"]);
    assert_success(&run);
    assert!(!stdout(&run).contains("stopped early"), "{}", stdout(&run));
    let verify = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    assert_success(&verify);
    let document: Value = serde_json::from_str(&stdout(&verify)).unwrap();
    assert_eq!(document["agree"], true, "{document}");
    assert!(document["sampled"].as_u64().unwrap() > 100, "{document}");
    held_behind_a_filter(&workshop);
}

/// Orbits that are in contact at phase 0 cannot be gone over from there: behind a filter they are gaps, and
/// the others are compared. A filter of forty times the frequency leaves a displacement as it is, within 1 %.
fn held_behind_a_filter(workshop: &Workshop) {
    let mut table = "frequency [Hz],tip [m],kind,period\n".to_owned();
    for row in workshop.csv("results").lines().skip(1).filter(|row| row.contains(",true,")).step_by(10) {
        let fields: Vec<&str> = row.split(',').collect();
        table.push_str(&format!("{},{},periodic,1\n", fields[2], fields[3]));
    }
    std::fs::write(workshop.path("points.csv"), table).unwrap();
    let given = ["--frequency-factor", "1", "--amplitude-factor", "1", "--reach", "1.01", "--json"];
    let of = |arguments: &[&str]| {
        let compared =
            workshop.hammerbeam(&[&["compare", "results", "points.csv"], arguments, &given].concat());
        assert_success(&compared);
        serde_json::from_str::<Value>(&stdout(&compared)).unwrap()["comparisons"][0].clone()
    };
    let (stored, filtered) = (of(&[]), of(&["--low-pass", "240"]));
    let number = |of: &Value, name: &str| of[name].as_u64().unwrap();
    assert_eq!((number(&stored, "gaps"), number(&stored, "no_branch")), (0, 0));
    assert!(number(&filtered, "gaps") > 0, "{filtered}");
    // A point in a gap meets nothing, or the stretch above or below it, which has another size.
    let [explained, none, too_far] =
        ["explained", "no_branch", "too_far"].map(|name| number(&filtered, name));
    assert!(explained > 10 && none > 0, "{filtered}");
    assert_eq!(explained + none + too_far, number(&stored, "explained"), "{filtered}");
}

/// A weight that presses the mass through its gap, and a force that throws it off at every turn if it is
/// strong enough.
fn pressed(amplitude_n: f64) -> Workshop {
    let study = study("law = \"lankarani-nikravesh\"\nstiffness_n_m15 = 1e6\nrestitution = 0.6");
    let vary = study.find("[[vary]]").unwrap();
    let load = "[[load]]\nkind = \"force\"\nat = \"mass\"\namplitude_n = 300.0\norder = 0\n";
    Workshop::with(
        &format!("{}{load}", &study[..vary])
            .replace("amplitude_n = 5.0", &format!("amplitude_n = {amplitude_n:?}"))
            .replace("[5.2, 6.4]", "[15.0, 15.2]"),
    )
}

/// The linear response and the place of rest lie within the contact: a run begins in front of it, and has the
/// orbit that `sweep` settles on from a state far away.
#[test]
fn a_run_begins_in_front_of_a_contact_against_which_a_weight_presses() {
    let workshop = pressed(1000.0);
    assert_success(&workshop.compute(&[]));
    let sweep = ["sweep", "study.toml", "--from", "15.1", "--to", "15.1", "--initial=-0.3,0"];
    let output = workshop.hammerbeam(&[&sweep[..], &["--results", "results", "--json"]].concat());
    assert_success(&output);
    let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let motion = &found["motions"][0];
    assert_eq!((&motion["class"], motion["branch"].is_u64()), (&Value::from("periodic"), true), "{motion}");
}

/// A weak force never opens the contact: the run says why it has nothing.
#[test]
fn a_run_that_finds_nothing_says_why() {
    let output = pressed(1.0).compute(&[]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let reported = stderr(&output);
    assert!(reported.contains("no periodic solution was found between 15 Hz and 15.2 Hz"), "{reported}");
    assert!(reported.contains("wall is closed over the whole motion"), "{reported}");
}
