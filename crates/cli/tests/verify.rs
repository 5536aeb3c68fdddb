//! `hammerbeam verify`: what a run stores agrees; what was tampered with is found.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{fs, process::Output, sync::OnceLock};

use crate::common::{
    TWO_MASSES, Workshop, assert_bad_input, assert_success, extensive, reported, stderr, stdout,
};
use serde_json::Value;

/// Two masses around their second resonance, with contacts and folds, in steps that make some hundred
/// solutions.
fn results() -> &'static Workshop {
    static RESULTS: OnceLock<Workshop> = OnceLock::new();
    RESULTS.get_or_init(|| {
        let workshop = Workshop::with(&format!("{TWO_MASSES}\n[continuation]\nmax_step_hz = 0.05\n"));
        assert_success(&workshop.compute(&[]));
        workshop
    })
}

/// Some of these solutions: enough to find the one that is changed.
fn few() -> &'static Workshop {
    static FEW: OnceLock<Workshop> = OnceLock::new();
    FEW.get_or_init(|| {
        let narrow = TWO_MASSES.replace("[3.0, 14.0]", "[9.0, 12.0]");
        assert_ne!(narrow, TWO_MASSES);
        let few = "[continuation]\nmax_step_hz = 0.05\n[search]\nfrequencies = 1\nstarts = 1\ntrials = 0\n";
        let workshop = Workshop::with(&format!("{narrow}\n{few}"));
        assert_success(&workshop.compute(&[]));
        workshop
    })
}

/// A copy of these few, tampered with.
fn tampered(statement: &str) -> Workshop {
    let workshop = Workshop::with("");
    fs::create_dir(workshop.path("results")).unwrap();
    let copy = workshop.path("results/results.db");
    fs::copy(few().path("results/results.db"), &copy).unwrap();
    let connection = crate::common::database(copy);
    let changed = connection.execute(statement, []).unwrap();
    assert!(changed > 0, "{statement} changes nothing");
    workshop
}

/// Key of the stored solution in the middle.
fn middle() -> i64 {
    let connection = crate::common::database(few().path("results/results.db"));
    let select = "SELECT id FROM solution ORDER BY id LIMIT 1 OFFSET (SELECT count(*) / 2 FROM solution)";
    connection.query_row(select, [], |row| row.get(0)).unwrap()
}

/// One entry of a blob multiplied, as an SQL literal.
fn blob_with(column: &str, key: i64, index: usize, factor: f64) -> String {
    let connection = crate::common::database(few().path("results/results.db"));
    let select = format!("SELECT {column} FROM solution WHERE id = {key}");
    let mut bytes: Vec<u8> = connection.query_row(&select, [], |row| row.get(0)).unwrap();
    let entry = &mut bytes[8 * index..8 * (index + 1)];
    let value = f64::from_le_bytes(entry.try_into().unwrap());
    entry.copy_from_slice(&(factor * value).to_le_bytes());
    let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("x'{hex}'")
}

fn document(output: &Output) -> Value {
    serde_json::from_str(&stdout(output)).expect("one JSON document")
}

/// A preload that is next to none, and forces of 1e-12 and 1e15 N at a stop without a gap.
#[test]
fn motions_of_any_size_are_confirmed() {
    for (amplitude_n, rest) in
        [("5.0", "preload_n = 1e-9"), ("1e-12", "gap_m = 0.0"), ("1e15", "gap_m = 0.0")]
    {
        let workshop = Workshop::with(&format!(
            r#"
[structure]
kind = "lumped"
mass = [{{ name = "m", mass_kg = 1.0 }}]
spring = [{{ between = ["m", "ground"], stiffness_n_m = 1000.0 }}]
damper = [{{ between = ["m", "ground"], damping_n_s_m = 2.0 }}]
[excitation]
kind = "force"
at = "m"
amplitude_n = {amplitude_n}
frequency_hz = [2.0, 6.5]
[[stop]]
at = "m"
law = "linear"
stiffness_n_m = 4.0e3
{rest}
side = "above"
[search]
frequencies = 1
starts = 1
[continuation]
max_step_hz = 0.05
"#
        ));
        assert_success(&workshop.compute(&[]));
        let document = document(&workshop.hammerbeam(&["verify", "results", "--all", "--json"]));
        assert_eq!(document["agree"], true, "{amplitude_n} N, {rest}: {document}");
    }
}

#[test]
fn what_a_run_stores_agrees_in_everything() {
    let output = results().hammerbeam(&["verify", "results", "--all", "--json"]);
    assert_success(&output);
    let document = document(&output);
    assert_eq!(document["agree"], true);
    assert_eq!(document["sampled"], document["stored"]);
    assert!(document["stored"].as_u64().unwrap() > 200);
    for quantity in document["quantities"].as_array().unwrap() {
        assert!(quantity["worst_difference"].as_f64().unwrap() <= quantity["bound"].as_f64().unwrap());
        assert_eq!(quantity["disagree"], 0);
        let name = quantity["quantity"].as_str().unwrap();
        assert!(quantity["compared"].as_u64().unwrap() > 0, "{name} was not compared");
    }
}

#[test]
fn the_result_does_not_depend_on_threads_and_a_seed_chooses_the_sample() {
    let verify = |more: &[&str]| {
        let output =
            results().hammerbeam(&[&["verify", "results", "--sample", "40", "--json"], more].concat());
        assert_success(&output);
        stdout(&output)
    };
    assert_eq!(verify(&["--jobs", "1"]), verify(&["--jobs", "3"]));
    let places = |text: &str| {
        let document: Value = serde_json::from_str(text).unwrap();
        assert_eq!(document["sampled"], 40);
        document["quantities"][0]["frequency_hz"].as_f64()
    };
    assert_ne!(places(&verify(&[])), places(&verify(&["--seed", "1"])));
}

#[test]
fn as_text_it_is_a_table_and_nothing_on_standard_error() {
    let output = results().hammerbeam(&["verify", "results", "--sample", "20"]);
    assert_success(&output);
    let text = stdout(&output);
    assert!(text.contains("20 of") && text.contains("all agree"), "{text}");
    assert!(text.contains("residual") && text.contains("max_abs_displacement_m"), "{text}");
    assert_eq!(reported(&output), "");
}

/// The solution that was tampered with, and no other, disagrees in that quantity.
#[track_caller]
fn assert_found(change: &str, key: i64, quantity: &str) {
    let workshop = tampered(&format!("UPDATE solution SET {change} WHERE id = {key}"));
    let output = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("1 of"), "{}", stderr(&output));
    let document = document(&output);
    assert_eq!((&document["agree"], &document["solutions_disagreeing"]), (&false.into(), &1.into()));
    let found = document["disagreements"].as_array().unwrap();
    assert!(found.iter().any(|entry| entry["quantity"] == quantity), "{found:?}");
    let text = workshop.hammerbeam(&["verify", "results", "--all"]);
    assert_eq!(text.status.code(), Some(3));
    assert!(stdout(&text).contains(&format!("Hz: {quantity}")), "{}", stdout(&text));
}

#[test]
fn a_node_that_was_changed_is_found() {
    let nodes = blob_with("nodes", middle(), 0, 1.0 + 1e-6);
    assert_found(&format!("nodes = {nodes}"), middle(), "residual");
}

#[test]
fn a_multiplier_that_was_changed_is_found() {
    // The real part of one that is not the leading one, so that only the integrator knows.
    let multipliers = blob_with("multipliers", middle(), 4, 1.0 + 1e-6);
    assert_found(&format!("multipliers = {multipliers}"), middle(), "multiplier_modulus");
    assert_found("leading_multiplier_re = leading_multiplier_re + 1e-9", middle(), "multiplier_modulus");
    assert_found("stable = NOT stable", middle(), "multiplier_modulus");
}

#[test]
fn maxima_that_were_changed_are_found() {
    for (column, relative) in [
        ("max_abs_displacement_m", 1e-6),
        ("max_abs_acceleration_m_s2", 1e-5),
        ("max_contact_force_n", 1e-4),
        ("max_impact_velocity_m_s", 1e-5),
        ("impulse_n_s", 1e-5),
    ] {
        assert_found(&format!("{column} = {column} * (1 + {relative:.6})"), middle(), column);
    }
    assert_found("contacts = contacts + 1", middle(), "contacts");
}

#[test]
fn a_fold_that_is_none_is_found() {
    assert_found("event = 1", middle(), "events");
}

/// A weight on a damped stop that it leaves for an instant: the touch is as weak as the flight is low, the
/// contact as deep as ever.
#[test]
fn touches_of_a_deep_contact_that_just_opens_agree() {
    let workshop = Workshop::with(
        r#"
        [structure]
        kind = "lumped"
        mass = [{ name = "m", mass_kg = 2.0 }]
        spring = [{ between = ["m", "ground"], stiffness_n_m = 50.0 }]
        damper = [{ between = ["m", "ground"], damping_n_s_m = 2.0 }]
        [excitation]
        kind = "support-motion"
        at = "ground"
        amplitude_m = 1.0e-3
        frequency_hz = [12.8, 13.0]
        [[load]]
        kind = "gravity"
        acceleration_m_s2 = -9.81
        [[stop]]
        at = "m"
        law = "linear"
        stiffness_n_m = 4.0e4
        damping_n_s_m = 20.0
        gap_m = 0.0
        side = "below"
        [response]
        period_multiples = [1]
        [continuation]
        max_step_hz = 0.001
        [search]
        frequencies = 1
        starts = 1
        trials = 0
        "#,
    );
    assert_success(&workshop.compute(&[]));
    let weak: Vec<f64> =
        impact_velocities(&workshop.csv("results")).into_iter().filter(|v| *v < 2e-4).collect();
    assert!(weak.len() > 2, "no weak touches: {weak:?}");
    let output = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    let document = document(&output);
    let quantities = document["quantities"].as_array().unwrap();
    let velocity = quantities.iter().find(|q| q["quantity"] == "max_impact_velocity_m_s").unwrap();
    assert_eq!(velocity["disagree"], 0, "{document:#}");
}

/// A spring that is just touched beside a rigid stop that is struck hard: what the spring pushes with is
/// known as badly as its own shallow contact, and not as well as the other's.
#[test]
fn the_force_of_a_contact_is_judged_by_its_own_depth() {
    let workshop = Workshop::driven_mass(
        r#"
        frequency_hz = [0.165, 0.168]
        [[stop]]
        name = "grazed"
        at = "m"
        law = "hertz"
        stiffness_n_m15 = 40.0
        side = "below"
        gap_m = 0.6
        [[stop]]
        name = "struck"
        at = "m"
        law = "rigid"
        restitution = 0.66
        side = "above"
        gap_m = 0.5
        [response]
        period_multiples = [1]
        [search]
        frequencies = 2
        [continuation]
        max_step_hz = 0.0005
        "#,
    );
    assert_success(&workshop.compute(&[]));
    let weak = values(&workshop.csv("results"), "max_contact_force_n").into_iter().filter(|f| *f < 1e-8);
    assert!(weak.count() > 2, "the spring is not just touched");
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
    // A force as strong as usual that is wrong by a millionth is found.
    let connection = crate::common::database(workshop.path("results/results.db"));
    let wrong = "UPDATE solution SET max_contact_force_n = max_contact_force_n * 1.000001 \
        WHERE max_contact_force_n = (SELECT max(max_contact_force_n) FROM solution)";
    assert!(connection.execute(wrong, []).unwrap() > 0);
    let found = workshop.hammerbeam(&["verify", "results", "--all"]);
    assert_eq!(found.status.code(), Some(3), "{}", stdout(&found));
}

/// A stop with a damper, where its touch sets in with a jump: the located grazing has a touch or has none,
/// and one branch has an orbit that is cut at its touch. By default in longer steps.
#[test]
fn touches_of_a_damper_that_graze_or_lie_at_the_cut_agree() {
    for damping in [3.0, 12.0] {
        let stop = format!(
            "[[stop]]\nname = \"stop\"\nat = \"m\"\nlaw = \"linear\"\nstiffness_n_m = 100.0\ndamping_n_s_m \
            = {damping:?}\ngap_m = 0.3\nside = \"above\"\n"
        );
        let rest = "[response]\npoint = \"m\"\nperiod_multiples = [1]\nperiod_doubling_depth = 0\n\
            [search]\nfrequencies = 2\nstarts = 2\ntrials = 1\n";
        let step = if extensive() { 6e-5 } else { 3e-4 };
        let rest = format!("{rest}[continuation]\nmax_step_hz = {step}\n");
        let workshop = Workshop::driven_mass(&format!("frequency_hz = [0.1, 0.4]\n{stop}{rest}"));
        assert_success(&workshop.compute(&[]));
        let output = workshop.hammerbeam(&["verify", "results", "--all"]);
        assert!(output.status.success(), "{damping}:\n{}", stdout(&output));
    }
}

/// The impact velocities of a table that are not zero [m/s].
fn impact_velocities(table: &str) -> Vec<f64> {
    values(table, "max_impact_velocity_m_s")
}

/// A column of a table, without zeros.
fn values(table: &str, name: &str) -> Vec<f64> {
    let place = table.lines().next().unwrap().split(',').position(|title| title == name).unwrap();
    let values = table.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap());
    values.filter(|v: &f64| *v > 0.0).collect()
}

#[test]
fn a_folder_without_solutions_is_exit_code_1() {
    let workshop = tampered("DELETE FROM solution");
    let connection = crate::common::database(workshop.path("results/results.db"));
    connection.execute("UPDATE walk SET solutions = 0", []).unwrap();
    drop(connection);
    let output = workshop.hammerbeam(&["verify", "results", "--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert_eq!(document(&output)["error"]["exit_code"], 1);
}

#[test]
fn bad_input_is_exit_code_2() {
    let workshop = Workshop::with("");
    assert_bad_input(&workshop.hammerbeam(&["verify", "nowhere"]), &["there are no results in nowhere"]);
    fs::create_dir(workshop.path("empty")).unwrap();
    assert_bad_input(&workshop.hammerbeam(&["verify", "empty"]), &["there are no results in empty"]);
    assert_bad_input(&results().hammerbeam(&["verify", "results", "--tolerance", "0"]), &["--tolerance"]);
    assert_bad_input(&results().hammerbeam(&["verify", "results", "--sample", "0"]), &["--sample"]);
    assert_bad_input(&results().hammerbeam(&["verify", "results", "--bogus"]), &["--bogus"]);
}

/// A row of a branch over a parameter that was tampered with is found, and named by its piece.
#[test]
fn a_changed_row_of_a_branch_over_a_parameter_is_found() {
    let workshop =
        Workshop::with(&crate::common::mass_against_a_stop("law = \"linear\"\nstiffness_n_m = 5000.0"));
    assert_success(&workshop.compute(&[]));
    let verify = ["verify", "results", "--all", "--json"];
    let agree = document(&workshop.hammerbeam(&verify));
    assert_eq!(agree["agree"], true, "{agree}");
    let database = crate::common::database(workshop.path("results/results.db"));
    let last = "(SELECT max(id) FROM solution)";
    let change = format!("UPDATE solution SET contacts = contacts + 1 WHERE id = {last}");
    assert_eq!(database.execute(&change, []).unwrap(), 1);
    drop(database);
    let output = workshop.hammerbeam(&verify);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let document = document(&output);
    assert_eq!(document["stored"], agree["stored"]);
    let found = &document["disagreements"][0];
    assert_eq!((&found["quantity"], &found["piece"]), (&"contacts".into(), &1.into()));
    assert!(found["parameter"].as_f64().is_some_and(|gap| (0.015..=0.022).contains(&gap)), "{found}");
}
