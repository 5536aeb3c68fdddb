//! Branches beside the borders of contacts: where one grazes, and where one splits in two.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::{Workshop, assert_success, stderr, stdout};
use rusqlite::Connection;

/// Two masses, the first of them driven and beside a stop.
fn two_masses(frequencies: &str, max_step: &str, stop: &str) -> Workshop {
    Workshop::with(&format!(
        r#"
        [structure]
        kind = "lumped"
        mass = [{{ name = "m1", mass_kg = 1.0 }}, {{ name = "m2", mass_kg = 0.4 }}]
        spring = [
            {{ between = ["m1", "ground"], stiffness_n_m = 1.0 }},
            {{ between = ["m1", "m2"], stiffness_n_m = 3.0 }},
        ]
        [damping]
        modal_ratio = 0.03
        [excitation]
        kind = "force"
        at = "m1"
        amplitude_n = 0.3
        frequency_hz = {frequencies}
        [[stop]]
        name = "s"
        at = "m1"
        side = "above"
        {stop}
        [search]
        frequencies = 8
        starts = 3
        trials = 0
        unstable_starts = false
        [response]
        period_multiples = [1, 2]
        [continuation]
        max_step_hz = {max_step}
        "#
    ))
}

/// At the touch the force of the damper sets in with a jump, and with it a multiplier passes +1 without having been there: the fold is a corner.
#[test]
fn a_fold_at_the_touch_of_a_damper_agrees_and_one_beside_it_does_not() {
    let stop = "law = \"linear\"\nstiffness_n_m = 20.0\ndamping_n_s_m = 0.5\ngap_m = 0.5";
    let workshop = two_masses("[0.129, 0.132]", "1e-5", stop);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let connection = Connection::open(workshop.path("results/results.db")).unwrap();
    let corner = "SELECT id FROM solution WHERE events & 1 AND events & 16";
    let corner: i64 = connection.query_row(corner, [], |row| row.get(0)).expect("no fold at a grazing");
    let verify = || workshop.hammerbeam(&["verify", "results", "--all"]);
    assert_success(&verify());
    // Neither is the row before it a fold, nor any where nothing touches.
    for other in [corner - 1, corner - 20] {
        let claim = |sign: char| {
            let claim = format!("UPDATE solution SET events = events {sign} 1 WHERE id = {other}");
            assert_eq!(connection.execute(&claim, []).unwrap(), 1);
        };
        claim('+');
        let found = verify();
        assert_eq!(found.status.code(), Some(3), "{}", stdout(&found));
        claim('-');
    }
}

/// A contact that begins the more slowly the nearer its branch comes to the border: multipliers of 1e7, and states that are rounded by more than what still changes.
#[test]
fn a_branch_ends_before_the_border_at_which_its_contact_splits_in_some_hundred_solutions() {
    let stop = "law = \"flores\"\nrestitution = 0.7\nstiffness_n_m15 = 20.0\ngap_m = 0.5";
    let workshop = two_masses("[0.1, 0.3]", "4e-4", stop);
    let output = workshop.hammerbeam(&["run", "study.toml", "--out", "results"]);
    assert_success(&output);
    let text = stdout(&output);
    assert!(text.contains("s opens and is pressed on again at once"), "{text}{}", stderr(&output));
    let table = workshop.csv("results");
    let place =
        table.lines().next().unwrap().split(',').position(|title| title == "leading_multiplier_re").unwrap();
    let multipliers =
        table.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse::<f64>().unwrap());
    let beside = multipliers.filter(|multiplier| multiplier.abs() > 1e6).count();
    assert!((1..1000).contains(&beside), "{beside} solutions beside the border");
}

/// Where the contact of a preloaded sphere begins to open, a step may begin just before the place at which it turns: neither the opening nor the corner of the stiffness, `sqrt(p)`, may get lost in front of
/// the first node of that step. (At the usual 1e-9 one row still disagrees by 1.1e-9.)
#[test]
fn multipliers_agree_where_a_preloaded_contact_begins_to_open() {
    let stop = "law = \"hertz\"\nstiffness_n_m15 = 20.0\npreload_n = 0.2";
    let workshop = two_masses("[0.137, 0.138]", "1e-5", stop);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    assert!(workshop.csv("results").contains("grazing"), "the contact does not begin to open");
    let found = workshop.hammerbeam(&["verify", "results", "--all", "--tolerance", "1e-8"]);
    assert_eq!(found.status.code(), Some(0), "{}", stdout(&found));
}
