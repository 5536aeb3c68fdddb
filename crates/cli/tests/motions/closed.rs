//! A contact that a weight keeps closed for good, under an impact-speed-dependent law: no command
//! takes what is left of that for a motion of the system.

use serde_json::Value;

use crate::common::{Workshop, assert_success, stderr, stdout};

/// `side` 1 presses the mass against the stop with twenty times what shakes it, -1 holds it away from it.
fn weighed(side: f64) -> Workshop {
    Workshop::driven_mass(&format!(
        r#"
        frequency_hz = [0.17, 0.19]
        [[load]]
        kind = "force"
        at = "m"
        amplitude_n = {:?}
        order = 0
        [[stop]]
        name = "wall"
        at = "m"
        side = "above"
        gap_m = 0.5
        law = "lankarani-nikravesh"
        stiffness_n_m15 = 20.0
        restitution = 0.7
        "#,
        8.0 * side
    ))
}

const COMMANDS: [&[&str]; 4] = [
    &["lyapunov", "study.toml", "--frequency", "0.18", "--periods", "20"],
    &["sweep", "study.toml", "--step", "0.02"],
    &["sweep", "study.toml", "--step", "0.02", "--starts", "3"],
    &["basins", "study.toml", "--frequency", "0.18", "--x", "q1=-1..0.4", "--y", "v1=-1..1", "--grid", "2"],
];

const REFUSED: &str =
    "wall is closed over the whole settled motion: its law needs to know how fast a contact began";

/// Exit code 1, as there is nothing to give, with the stop by its name; basins report what all of their cells
/// have in common.
#[test]
fn contacts_that_stay_closed_leave_nothing_to_give() {
    let workshop = weighed(1.0);
    for (command, result, reported) in [
        (COMMANDS[0], REFUSED, REFUSED.to_owned()),
        (COMMANDS[1], "no motion could be computed", format!("the sweep up ends at 0.17 Hz: {REFUSED}")),
        (COMMANDS[2], "no motion could be computed", format!("0.17 Hz, start 1: {REFUSED}")),
        (COMMANDS[3], "no motion from any of the 4 cells", "such a contact closed for good".to_owned()),
    ] {
        let output = workshop.hammerbeam(&[command, &["--json"]].concat());
        assert_eq!(output.status.code(), Some(1), "{command:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(&reported), "{command:?}: {}", stderr(&output));
        let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert_eq!(document["error"]["exit_code"], 1);
        let message = document["error"]["message"].as_str().unwrap();
        assert!(message.contains(result), "{command:?}: {message}");
    }
}

/// The same weight the other way: nothing touches, and every command has its result.
#[test]
fn the_same_weight_away_from_the_stop_is_no_reason_to_refuse() {
    let workshop = weighed(-1.0);
    for command in COMMANDS {
        let output = workshop.hammerbeam(command);
        assert_success(&output);
        assert!(!stderr(&output).contains("closed"), "{command:?}: {}", stderr(&output));
    }
}
