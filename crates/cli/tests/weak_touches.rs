//! `hammerbeam verify` along a grazing curve: the penetration stays within rounding of the level there, and
//! how often it crosses it is no property of the motion.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{Workshop, assert_success, stdout};
use serde_json::Value;

/// Two masses that just reach a stop somewhere in the range, at which a force of 2 N makes a hundred points.
const STUDY: &str = r#"
title = "Grazing of a linear motion"

[structure]
kind = "lumped"
mass = [{ name = "frame", mass_kg = 3.0 }, { name = "arm", mass_kg = 0.7 }]
spring = [
    { between = ["frame", "ground"], stiffness_n_m = 900.0 },
    { between = ["frame", "arm"], stiffness_n_m = 400.0 },
]

[damping]
modal_ratio = 0.03

[excitation]
kind = "force"
at = "frame"
amplitude_n = 2.0
frequency_hz = [1.74, 1.8]

[[stop]]
name = "bump"
at = "arm"
law = "hertz"
stiffness_n_m15 = 2.0e5
side = "above"
gap_m = 0.006

[search]
frequencies = 1
starts = 1
trials = 0

[response]
period_multiples = [1]

[continuation]
max_step_hz = 0.01

[[curve]]
of = "grazing"
near_hz = 1.9
parameter = "excitation.amplitude_n"
range = [1.5, 2.6]
"#;

/// In four systems that differ in their rounding alone, of which some see the level crossed twice in a motion
/// that has one extremum there.
#[test]
fn touches_within_rounding_of_the_level_are_no_disagreement() {
    let (mut grazing, mut rows) = (0, 0);
    for factor in [1.0, 1.1, 1.3, 1.7] {
        let scaled = |text: &str, key: &str, value: f64| {
            text.replace(&format!("{key} = {value:?}"), &format!("{key} = {:e}", factor * value))
        };
        // All forces, stiffnesses and masses alike: the motion is the same.
        let study = [("mass_kg", 3.0), ("mass_kg", 0.7), ("stiffness_n_m", 900.0), ("stiffness_n_m", 400.0)];
        let study = study.iter().fold(STUDY.to_owned(), |text, (key, value)| scaled(&text, key, *value));
        let study = scaled(&scaled(&study, "amplitude_n", 2.0), "stiffness_n_m15", 2.0e5);
        let study = study.replace("[1.5, 2.6]", &format!("[{:e}, {:e}]", 1.5 * factor, 2.6 * factor));
        let workshop = Workshop::with(&study);
        assert_success(&workshop.compute(&[]));
        let output = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
        let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert_eq!(document["agree"], true, "{factor}: {:#}", document["disagreements"]);
        let mut quantities = document["quantities"].as_array().unwrap().iter();
        let contacts = quantities.find(|quantity| quantity["quantity"] == "contacts").unwrap();
        grazing += contacts["grazing"].as_u64().unwrap();
        rows += contacts["compared"].as_u64().unwrap();
    }
    assert!(grazing > 0 && rows > 500, "{grazing} of {rows}");
}
