//! Branches beside the borders of contacts: where one grazes, and where one splits in two.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{Workshop, assert_success, stderr, stdout};

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

/// A column of an exported table.
fn column<'t>(table: &'t str, title: &str) -> Vec<&'t str> {
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let place = rows.next().unwrap().iter().position(|name| *name == title).unwrap();
    rows.map(|row| row[place]).collect()
}

/// At the touch the force of the damper sets in with a jump, and with it a multiplier passes +1 without
/// having been there: the fold is a corner.
#[test]
fn a_fold_at_the_touch_of_a_damper_agrees_and_one_beside_it_does_not() {
    let stop = "law = \"linear\"\nstiffness_n_m = 20.0\ndamping_n_s_m = 0.5\ngap_m = 0.5";
    let workshop = two_masses("[0.129, 0.132]", "3e-5", stop);
    assert_success(&workshop.compute(&[]));
    let connection = crate::common::database(workshop.path("results/results.db"));
    let corner = "SELECT id FROM solution WHERE event & 1 AND event & 16";
    let corner: i64 = connection.query_row(corner, [], |row| row.get(0)).expect("no fold at a grazing");
    let verify = || workshop.hammerbeam(&["verify", "results", "--all"]);
    assert_success(&verify());
    // Neither is the row before it a fold, nor any where nothing touches.
    for other in [corner - 1, corner - 20] {
        let claim = |sign: char| {
            let claim = format!("UPDATE solution SET event = event {sign} 1 WHERE id = {other}");
            assert_eq!(connection.execute(&claim, []).unwrap(), 1);
        };
        claim('+');
        let found = verify();
        assert_eq!(found.status.code(), Some(3), "{}", stdout(&found));
        claim('-');
    }
}

/// A contact that begins the more slowly the nearer its branch comes to the border: multipliers of 1e6, and
/// states that are rounded by more than what still changes.
#[test]
fn a_branch_ends_before_the_border_at_which_its_contact_splits_in_some_hundred_solutions() {
    let stop = "law = \"flores\"\nrestitution = 0.7\nstiffness_n_m15 = 20.0\ngap_m = 0.5";
    let workshop = two_masses("[0.1, 0.3]", "4e-4", stop);
    let output = workshop.compute(&[]);
    assert_success(&output);
    let text = stdout(&output);
    assert!(text.contains("s opens and is pressed on again at once"), "{text}{}", stderr(&output));
    let table = workshop.csv("results");
    let multipliers = column(&table, "leading_multiplier_re");
    let multipliers = multipliers.iter().map(|value| value.parse::<f64>().unwrap());
    let beside = multipliers.filter(|multiplier| multiplier.abs() > 1e5).count();
    assert!((1..1000).contains(&beside), "{beside} solutions beside the border");
}

/// Where the contact of a preloaded sphere begins to open, a step may begin just before the place at which it
/// turns: neither the opening nor the corner of the stiffness, `sqrt(p)`, may get lost in front of the first
/// node of that step, nor behind the last one of the step before. (At the usual 1e-9 one row still disagrees
/// by 1.1e-9.)
#[test]
fn multipliers_agree_where_a_preloaded_contact_begins_to_open() {
    let stop = "law = \"hertz\"\nstiffness_n_m15 = 20.0\npreload_n = 0.2";
    let workshop = two_masses("[0.137, 0.138]", "1e-5", stop);
    assert_success(&workshop.compute(&[]));
    assert!(workshop.csv("results").contains("grazing"), "the contact does not begin to open");
    let found = workshop.hammerbeam(&["verify", "results", "--all", "--tolerance", "1e-8"]);
    assert_eq!(found.status.code(), Some(0), "{}", stdout(&found));
}

/// One mass beside stops, driven.
fn one_mass(spring: &str, drive: &str, stops: &str, max_step: &str) -> Workshop {
    Workshop::with(&format!(
        r#"
        [structure]
        kind = "lumped"
        mass = [{{ name = "m", mass_kg = 1.0 }}]
        spring = [{{ between = ["m", "ground"], stiffness_n_m = {spring} }}]
        [damping]
        modal_ratio = 0.05
        [excitation]
        kind = "force"
        at = "m"
        {drive}
        [search]
        frequencies = 4
        starts = 2
        trials = 0
        unstable_starts = false
        [continuation]
        max_step_hz = {max_step}
        {stops}
        "#
    ))
}

/// Beside the border two sheets of orbits lie close to one another, with one contact and with two: the walks
/// on both end there, and none falls onto the other, which looked like a flip.
#[test]
fn a_branch_does_not_fall_onto_the_other_sheet_beside_a_splitting() {
    let study = r#"
        [structure]
        kind = "lumped"
        mass = [{ name = "m0", mass_kg = 1.0 }, { name = "m1", mass_kg = 1.637 }]
        spring = [
            { between = ["m0", "ground"], stiffness_n_m = 7785.1 },
            { between = ["m1", "m0"], stiffness_n_m = 5551.5 },
        ]
        [damping]
        modal_ratio = 0.2
        [excitation]
        kind = "force"
        at = "m1"
        amplitude_n = 5.001
        frequency_hz = [3.3, 3.6]
        [[stop]]
        name = "s"
        at = "m1"
        side = "above"
        law = "hunt-crossley"
        restitution = 0.5
        stiffness_n_m15 = 1.6738e6
        gap_m = 0.00079885
        [search]
        frequencies = 4
        starts = 2
        trials = 0
        unstable_starts = false
        [continuation]
        max_step_hz = 0.01
        "#;
    let workshop = Workshop::with(study);
    let output = workshop.compute(&[]);
    assert_success(&output);
    let text = stdout(&output);
    assert_eq!(text.matches("s opens and is pressed on again at once").count(), 2, "{text}");
    // Where rows crowd beside the border, multipliers are good to 1.1e-9; those of the other sheet would be
    // off by far more.
    let found = workshop.hammerbeam(&["verify", "results", "--all", "--tolerance", "2e-9"]);
    assert_success(&found);
    // On no sheet does the number of contacts change.
    let table = workshop.csv("results");
    let mut sheets: Vec<_> = column(&table, "branch").into_iter().zip(column(&table, "contacts")).collect();
    sheets.sort();
    sheets.dedup();
    let contacts: Vec<&str> = sheets.iter().map(|(_, contacts)| *contacts).collect();
    assert!(contacts == ["1", "2"] || contacts == ["2", "1"], "{sheets:?}");
}

/// A stop that takes almost all that an impact has stops pressing before it opens, and is pressed on again:
/// it is closed throughout, and nothing grazes where that begins.
#[test]
fn a_contact_that_presses_no_more_for_a_while_is_closed_all_the_time() {
    let stop = "[[stop]]\nname = \"s\"\nat = \"m\"\nside = \"above\"\nlaw = \"hunt-crossley\"\npreload_n = \
    3.7033\nstiffness_n_m15 = 3.9506e5\nloss_s_m = 54.22";
    let drive = "amplitude_n = 1.472\nfrequency_hz = [10.0, 24.0]";
    let workshop = one_mass("5564.1", drive, stop, "0.1");
    assert_success(&workshop.compute(&[]));
    let table = workshop.csv("results");
    assert!(column(&table, "contacts").iter().all(|contacts| *contacts == "1"), "{table}");
    assert!(!table.contains("grazing"));
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
}

/// A contact whose law begins at the level of a rigid stop has the force that rounding of the level gives it,
/// or none.
#[test]
fn a_force_that_rounding_makes_is_none() {
    let stop = |law: &str| {
        format!("[[stop]]\nat = \"m\"\nside = \"below\"\ngap_m = 0.0\nrestitution = 0.3\n{law}\n")
    };
    let stops = stop("law = \"flores\"\nstiffness_n_m15 = 2.1688e7") + &stop("law = \"rigid\"");
    let workshop = one_mass("3298.1", "amplitude_n = 6.139\nfrequency_hz = [9.0, 9.6]", &stops, "0.01");
    assert_success(&workshop.compute(&[]));
    assert_success(&workshop.hammerbeam(&["verify", "results", "--all"]));
}
