//! Marginal solutions in whole runs: the words in tables, JSON and figures, the modes that make them, and
//! `verify`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use hammerbeam_orbit::StopReason;
use hammerbeam_results::end::BranchEnd;

use crate::common::{Workshop, assert_success, extensive, number, stdout, stored};

/// One undamped mass about a third of its eigenfrequency, where free vibrations repeat with the motion.
const FREE: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 1.4 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 55.0 }]
[excitation]
kind = "force"
at = "m"
amplitude_n = 2.0
frequency_hz = [0.325, 0.34]
[[stop]]
name = "s"
at = "m"
law = "linear"
stiffness_n_m = 700.0
gap_m = 0.05
side = "above"
[search]
frequencies = 4
starts = 4
trials = 4
[continuation]
max_step_hz = 0.001
"#;

/// Two undamped masses in a range with a stop that is touched, between its resonances.
const CHAIN: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }, { name = "b", mass_kg = 1.0 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 1.0 },
    { between = ["a", "b"], stiffness_n_m = 0.7 },
]
[excitation]
kind = "force"
at = "a"
amplitude_n = 0.1
frequency_hz = [0.05, 0.0765]
[[stop]]
name = "s"
at = "b"
law = "linear"
stiffness_n_m = 5.0
gap_m = 0.25
side = "above"
[search]
frequencies = 0
[continuation]
max_step_hz = 0.0005
"#;

/// A gear pair whose teeth have a damper, on a weak spring that has none.
const GEARS: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "pinion", mass_kg = 1.0 }, { name = "wheel", mass_kg = 2.0 }]
spring = [{ between = ["pinion", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["pinion", "wheel"], damping_n_s_m = 200.0 }]
[excitation]
kind = "force"
at = "pinion"
amplitude_n = 20.0
frequency_hz = [100.0, 120.0]
[[stop]]
name = "teeth"
between = ["pinion", "wheel"]
law = "two-sided"
stiffness_n_m = 4e5
gap_m = 1e-4
"#;

/// A mass at a contact so hard that it lasts for 1e-5 of a period to less than 1e-8.
fn hard_contact(law: &str) -> Workshop {
    Workshop::with(&format!(
        r#"
        [structure]
        kind = "lumped"
        mass = [{{ name = "a", mass_kg = 1.0 }}]
        spring = [{{ between = ["a", "ground"], stiffness_n_m = 100.0 }}]
        [damping]
        modal_ratio = 0.02
        [excitation]
        kind = "force"
        at = "a"
        amplitude_n = 1.0
        frequency_hz = [0.5, 4.0]
        [[stop]]
        name = "stop"
        at = "a"
        {law}
        gap_m = 0.001
        side = "above"
        "#
    ))
}

/// In the limit a Hertz contact is a rigid stop that gives everything back, whose multipliers are exact. The
/// softer ones are near it, and of the others no digit is claimed that rounding has eaten. By default two of
/// five.
#[test]
fn multipliers_of_contacts_that_are_too_hard_for_rounding_are_marginal() {
    let leading = |law: &str| {
        let orbit = hard_contact(law).hammerbeam(&["orbit", "study.toml", "--frequency", "3.9997", "--json"]);
        assert_success(&orbit);
        let document: serde_json::Value = serde_json::from_str(&stdout(&orbit)).unwrap();
        let leading = document["floquet_multipliers"][0][0].as_f64().unwrap();
        (leading, document["stability"].as_str().unwrap().to_owned())
    };
    let (rigid, stability) = leading("law = \"rigid\"\nrestitution = 1");
    assert_eq!(stability, "unstable");
    let all = ["1e18", "1e24", "1e16", "1e20", "1e22"];
    for stiffness in if extensive() { &all[..] } else { &all[..2] } {
        let (hertz, stability) = leading(&format!("law = \"hertz\"\nstiffness_n_m15 = {stiffness}"));
        let is_known = (hertz - rigid).abs() < 0.01 * rigid.abs();
        assert!(is_known || stability == "marginal", "{stiffness}: {hertz}, {stability}, rigid {rigid}");
        match *stiffness {
            "1e16" | "1e18" => assert_eq!(stability, "unstable", "{stiffness}: {hertz}"),
            "1e24" => assert_eq!(stability, "marginal", "{hertz}"),
            _ => {}
        }
    }
}

/// A state a micrometre deep in a hard contact is thrown out at a speed a million times that of the orbit.
/// What Newton's method comes to from there is measured by its own size: there is the stable orbit alone,
/// near that of a rigid stop, and no motion is stored that does not repeat.
#[test]
fn states_deep_in_a_hard_contact_lead_to_no_false_orbits() {
    let study = |law: &str| {
        format!(
            "[structure]\nkind = \"lumped\"\nmass = [{{ name = \"m\", mass_kg = 0.05 }}]\n\
             spring = [{{ between = [\"m\", \"ground\"], stiffness_n_m = 40.0 }}]\n\
             [damping]\nmodal_ratio = 0.04\n[excitation]\nkind = \"force\"\nat = \"m\"\n\
             amplitude_n = 0.25\nfrequency_hz = [5.2, 5.5]\n\
             [[stop]]\nat = \"m\"\n{law}\nside = \"below\"\ngap_m = 3e-3\n"
        )
    };
    let solutions = |law: &str| {
        let workshop = Workshop::with(&study(law));
        let orbit = workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "5.48828125", "--json"]);
        assert_success(&orbit);
        let document: serde_json::Value = serde_json::from_str(&stdout(&orbit)).unwrap();
        document["solutions"].as_array().unwrap().clone()
    };
    let (hard, rigid) =
        (solutions("law = \"hertz\"\nstiffness_n_m15 = 1e14"), solutions("law = \"rigid\"\nrestitution = 1"));
    assert_eq!((hard.len(), rigid.len()), (1, 1), "{hard:?}");
    let speed = |solutions: &[serde_json::Value]| solutions[0]["max_impact_velocity_m_s"].as_f64().unwrap();
    assert!((speed(&hard) / speed(&rigid) - 1.0).abs() < 1e-3, "{hard:?}, {rigid:?}");
}

#[test]
fn marginal_solutions_have_their_word_in_every_table_and_verify_agrees() {
    let workshop = Workshop::exported(CHAIN);
    let rows = workshop.table("results/export/branches.csv");
    let marginal = rows.iter().filter(|row| row["stable"] == "marginal").count();
    assert!(marginal > 30, "{marginal} of {}", rows.len());
    assert!(rows.iter().all(|row| ["marginal", "false"].contains(&row["stable"].as_str())));
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
    let run = workshop.hammerbeam(&["run", "study.toml", "--out", "results", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
    let branches = document["branches"].as_array().unwrap();
    let counted: u64 = branches.iter().map(|branch| branch["marginal_solutions"].as_u64().unwrap()).sum();
    assert_eq!(counted, marginal as u64);
    assert_eq!(document["undamped_modes"].as_array().unwrap().len(), 2);
    let summary = stdout(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let mode = stored(&workshop).0.undamped_modes()[0].to_string();
    let told = summary.lines().filter(|line| line.contains(&mode)).count();
    assert!(told == 1 && summary.contains("modal_ratio"), "{summary}");
    let figure = fs::read_to_string(workshop.path("results/response_displacement.svg")).unwrap();
    assert!(figure.contains("marginal dotted"), "the description names them");
}

/// At a third of the eigenfrequency free vibrations of every phase touch the stop with nothing. Branches with
/// a contact end there, and no fold is made of rounding on the way.
#[test]
fn a_branch_that_comes_to_free_vibrations_ends_there() {
    let workshop = Workshop::exported(FREE);
    let third = (55.0_f64 / 1.4).sqrt() / std::f64::consts::TAU / 3.0;
    let (_, branches) = stored(&workshop);
    let sides = branches.branches().iter().flat_map(|branch| [&branch.record.up, &branch.record.down]);
    let mut free = 0;
    for side in sides {
        match side.end.as_ref().unwrap() {
            BranchEnd::Walk(StopReason::FreeVibration { place: frequency_hz, mode }) => {
                assert!((frequency_hz - third).abs() < 1e-9 * third && mode.number == 1, "{mode:?}");
                free += 1;
            }
            BranchEnd::Walk(StopReason::RangeEnd { .. }) => {}
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(free, 2);
    let run = workshop.hammerbeam(&["run", "study.toml", "--out", "results", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
    let branches = document["branches"].as_array().unwrap();
    assert!(branches.iter().all(|branch| branch["folds"].as_u64() == Some(0)), "{document}");
}

#[test]
fn figures_without_marginal_solutions_do_not_speak_of_them() {
    let damped = CHAIN.replacen("[excitation]", "[damping]\nmodal_ratio = 0.05\n[excitation]", 1);
    let workshop = Workshop::exported(&damped);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let figure = fs::read_to_string(workshop.path("results/response_displacement.svg")).unwrap();
    assert!(!figure.contains("marginal"), "no legend entry, and nothing in the description");
}

#[test]
fn modes_without_damping_are_named_with_what_to_do_before_anything_runs() {
    let (text, document) = checked(FREE);
    let modes = document["undamped_modes"].as_array().unwrap();
    assert_eq!((modes.len(), modes[0]["mode"].as_u64()), (1, Some(1)), "{document}");
    let hz = (55.0_f64 / 1.4).sqrt() / std::f64::consts::TAU;
    assert!((modes[0]["frequency_hz"].as_f64().unwrap() / hz - 1.0).abs() < 1e-12, "{document}");
    // What to do is told in words alone.
    assert!(text.contains("mode 1 at 0.998 Hz has no damping") && text.contains("modal_ratio"), "{text}");
    let damped = FREE.replacen("[excitation]", "[damping]\nmodal_ratio = 0.01\n[excitation]", 1);
    let (text, document) = checked(&damped);
    assert!(document["undamped_modes"].as_array().unwrap().is_empty(), "{document}");
    assert!(!text.contains("has no damping"), "{text}");
}

/// What `check` says of a study, in words and as a document.
fn checked(study: &str) -> (String, serde_json::Value) {
    let workshop = Workshop::with(study);
    let text = workshop.hammerbeam(&["check", "study.toml"]);
    assert_success(&text);
    let document = workshop.hammerbeam(&["check", "study.toml", "--json"]);
    (stdout(&text), serde_json::from_str(&stdout(&document)).unwrap())
}

/// Both gears together, 3 kg on 1 N/m: `sqrt(1/3)/(2 pi)` Hz.
#[test]
fn a_mode_that_is_undamped_while_teeth_are_closed_is_named_with_its_frequency() {
    let check = |study: &str| {
        let (text, document) = checked(study);
        (text, document["undamped_in_contact"].clone())
    };
    let (text, found) = check(GEARS);
    let hz = (1.0_f64 / 3.0).sqrt() / std::f64::consts::TAU;
    assert_eq!(found.as_array().unwrap().len(), 1, "{found}");
    assert!((found[0]["frequency_hz"].as_f64().unwrap() / hz - 1.0).abs() < 1e-9, "{found}");
    assert_eq!(found[0]["stops"], serde_json::json!(["teeth"]));
    assert!((found[0]["motion"]["wheel"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{found}");
    assert!(text.contains("with \"teeth\" closed") && text.contains("modal_ratio"), "{text}");
    let damped = |damping: f64| {
        let damper =
            format!("damper = [{{ between = [\"pinion\", \"ground\"], damping_n_s_m = {damping} }}, ");
        GEARS.replacen("damper = [", &damper, 1)
    };
    let (text, found) = check(&damped(0.1));
    assert!(found.as_array().unwrap().is_empty() && !text.contains("undamped"), "{text}");
    // A ratio of 3e-9; in a period of the excitation, a 200th of that of the mode, it takes off 3e-11.
    let (_, found) = check(&damped(1e-8));
    assert_eq!(found.as_array().unwrap().len(), 1, "{found}");
}

/// Teeth that stay closed leave the mode of both gears without damping: its pair is on the circle by rounding
/// outside or inside.
#[test]
fn gears_on_an_undamped_spring_are_marginal_and_make_no_neimark_sacker_points() {
    let few = "frequency_hz = [40.0, 60.0]\n[search]\nfrequencies = 0\n[continuation]\nmax_step_hz = 0.1\n";
    let workshop = Workshop::exported(&GEARS.replace("frequency_hz = [100.0, 120.0]\n", few));
    let rows = workshop.table("results/export/branches.csv");
    assert!(rows.len() > 150 && rows.iter().all(|row| row["stable"] == "marginal"), "{} rows", rows.len());
    assert_eq!(workshop.table("results/export/events.csv").len(), 0);
    let run = workshop.compute(&["--json"]);
    let document: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
    let named = document["undamped_in_contact"].as_array().unwrap();
    assert_eq!(named.len(), 1, "{document}");
}

/// A stop that holds all that moves leaves no mode to be named.
#[test]
fn one_mass_with_a_stop_has_no_mode_in_contact() {
    let workshop = Workshop::driven_mass(
        "frequency_hz = [0.1, 0.2]\n[[stop]]\nat = \"m\"\nside = \"above\"\n\
         law = \"linear\"\nstiffness_n_m = 1.0\n",
    );
    let check = workshop.hammerbeam(&["check", "study.toml"]);
    assert_success(&check);
    assert!(!stdout(&check).contains("undamped"), "{}", stdout(&check));
}

/// A mass on a spring that nothing damps, at a stop that gives everything back: the determinant of its
/// monodromy matrix is one. Its pair of multipliers slides along the circle to -1 and becomes real there,
/// which is a flip alone.
#[test]
fn a_pair_that_becomes_real_at_a_flip_is_no_neimark_sacker_point() {
    let workshop = Workshop::exported(
        r#"
        [structure]
        kind = "lumped"
        mass = [{ name = "m", mass_kg = 1.2 }]
        spring = [{ between = ["m", "ground"], stiffness_n_m = 900.0 }]
        [excitation]
        kind = "force"
        at = "m"
        amplitude_n = 5.0
        frequency_hz = [4.5, 4.7]
        [[stop]]
        at = "m"
        law = "rigid"
        restitution = 1.0
        gap_m = 0.004
        side = "above"
        [continuation]
        max_step_hz = 0.02
        [search]
        frequencies = 4
        starts = 3
        trials = 3
        "#,
    );
    let events = workshop.table("results/export/events.csv");
    let count = |kind: &str| events.iter().filter(|event| event["event"] == kind).count();
    assert_eq!((count("flip"), count("neimark-sacker")), (1, 0));
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
}

/// Two undamped masses at a stop: a motion that is not the same backwards in time leaves one that is, at
/// 2.0229 and at 2.0260 Hz. Beside these points errors of a motion move its frequency more than the branch.
#[test]
fn the_frequency_turns_once_where_a_motion_leaves_one_that_is_the_same_backwards() {
    let workshop = Workshop::exported(
        r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.3 }, { name = "b", mass_kg = 0.6 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 240.0 },
    { between = ["b", "a"], stiffness_n_m = 510.0 },
]
[excitation]
kind = "force"
at = "a"
amplitude_n = 0.9
frequency_hz = [1.9, 2.1]
[[stop]]
at = "b"
law = "linear"
stiffness_n_m = 3300.0
gap_m = 0.007
side = "above"
[search]
frequencies = 4
starts = 4
trials = 4
[continuation]
max_step_hz = 0.01
"#,
    );
    let events = workshop.table("results/export/events.csv");
    let mut folds: Vec<(&str, f64)> = events
        .iter()
        .filter(|event| event["event"].contains("fold"))
        .map(|event| (event["branch"].as_str(), number(event, "frequency_hz")))
        .collect();
    folds.sort_by(|a, b| a.0.cmp(b.0).then(a.1.total_cmp(&b.1)));
    // The branch begins at one of the two; where is a matter of rounding.
    let ends_at = |place: f64| folds.iter().any(|(_, frequency)| (frequency - place).abs() < 1e-6);
    assert!(ends_at(2.022852) || ends_at(2.025993), "{folds:?}");
    let apart = |pair: &[(&str, f64)]| pair[0].0 != pair[1].0 || pair[1].1 - pair[0].1 > 1e-6;
    assert!(folds.windows(2).all(apart), "{folds:?}");
}
