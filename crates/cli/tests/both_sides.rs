//! Stops on both sides: each side is a one-sided stop.
//!
//! A free mass m between two of them flies with its speed from one to the other. With a spring k and a damper
//! c a contact is `m p'' + c p' + k p = 0` from `p = 0` until it would pull, where `p'' = 0`: with `d = c/(2
//! m)`, `w^2 = k/m - d^2`, `tan a = d/w` this is the time `t = (pi - 2 a)/w`. The speed is `exp(-d t)` of
//! what it was then, and the penetration `c/k` times that, so that the flight takes longer by `c/k`. A rigid
//! stop leaves `e` of the speed.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{f64::consts::PI, fs};

use crate::common::{Workshop, assert_bad_input, assert_success, stdout};

const FREE_MASS: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "mass", mass_kg = 0.5 }]
[[stop]]
name = "frame"
at = "mass"
"#;
const GAP: f64 = 0.01;

/// Begin, end, impact velocity, element of each contact of a mass that sets out from the middle with 1 m/s.
fn contacts(stop: &str) -> Vec<(f64, f64, f64, String)> {
    let workshop = Workshop::with(&format!("{FREE_MASS}{stop}"));
    let motion = ["simulate", "study.toml", "--initial", "mass.v=1", "--duration", "0.2"];
    assert_success(&workshop.hammerbeam(&[&motion[..], &["--out", "out"]].concat()));
    let text = fs::read_to_string(workshop.path("out/contacts.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| cells[column].parse().unwrap_or(f64::NAN);
        (number(1), number(2), number(4), cells[0].to_owned())
    };
    text.lines().skip(1).map(row).collect()
}

fn flies_from_side_to_side(stop: &str, [above, below]: [f64; 2], (length, kept, late): (f64, f64, f64)) {
    let (mut time, mut speed) = (above, 1.0);
    let found = contacts(stop);
    assert!(found.len() > 3, "{found:?}");
    for (n, (begin, end, velocity, name)) in found.into_iter().enumerate() {
        let side = if n % 2 == 0 { "above" } else { "below" };
        assert_eq!(name, format!("frame__{side}_"));
        assert!((begin - time).abs() < 1e-9, "contact {n} at {begin} s instead of {time} s");
        assert!((velocity / speed - 1.0).abs() < 1e-9, "contact {n} with {velocity} instead of {speed} m/s");
        assert!(end.is_nan() || (end - begin - length).abs() < 1e-9, "contact {n} for {} s", end - begin);
        speed *= kept;
        time += length + late + (above + below) / speed;
    }
}

#[test]
fn a_free_mass_between_damped_stops_is_as_its_closed_form() {
    let (d, w) = (10.0 / (2.0 * 0.5), (2e4_f64 / 0.5 - 100.0).sqrt());
    let length = (PI - 2.0 * (d / w).atan()) / w;
    let contact = (length, (-d * length).exp(), 10.0 / 2e4);
    let keys = "stiffness_n_m = 2e4\ndamping_n_s_m = 10.0\n";
    let both = format!("law = \"linear\"\nside = \"both\"\n{keys}gap_m = {GAP}\n");
    flies_from_side_to_side(&both, [GAP; 2], contact);
    let gaps = format!("law = \"two-sided\"\n{keys}gap_above_m = {GAP}\ngap_below_m = 0.004\n");
    flies_from_side_to_side(&gaps, [GAP, 0.004], contact);
}

#[test]
fn a_free_mass_between_rigid_stops_keeps_its_part_of_the_speed() {
    let both = format!("law = \"rigid\"\nside = \"both\"\nrestitution = 0.9\ngap_m = {GAP}\n");
    flies_from_side_to_side(&both, [GAP; 2], (0.0, 0.9, 0.0));
}

/// Shaken, so that both sides are touched.
fn shaken(stops: &str) -> String {
    format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "mass", mass_kg = 1.0 }}]
spring = [{{ between = ["mass", "ground"], stiffness_n_m = 1000.0 }}]
[damping]
modal_ratio = 0.02
[excitation]
kind = "force"
at = "mass"
amplitude_n = 5.0
frequency_hz = [5.5, 6.0]
{stops}
[search]
frequencies = 1
starts = 1
trials = 0
[continuation]
max_step_hz = 0.01
"#
    )
}

fn run(study: &str) -> (Workshop, String) {
    let workshop = Workshop::with(study);
    assert_success(&workshop.compute(&["--jobs", "1"]));
    let table = workshop.csv("results");
    (workshop, table)
}

#[test]
fn both_sides_are_two_stops_and_the_general_integrator_agrees() {
    for (law, sides) in [
        ("linear", "stiffness_n_m = 2e4\ndamping_n_s_m = 15.0"),
        ("hunt-crossley", "stiffness_n_m15 = 1e6\nloss_s_m = 0.6"),
        ("flores", "stiffness_n_m15 = 1e6\nrestitution = 0.7"),
    ] {
        let one = |name: &str, side: &str| {
            let place = format!("name = \"{name}\"\nat = \"mass\"\nside = \"{side}\"\ngap_m = 0.02");
            format!("[[stop]]\nlaw = \"{law}\"\n{place}\n{sides}\n")
        };
        let (workshop, both) = run(&shaken(&one("wall", "both")));
        let two = [one("wall (above)", "above"), one("wall (below)", "below")].concat();
        let (_, apart) = run(&shaken(&two));
        assert!(both.lines().count() > 50 && both == apart, "{law}");
        assert_success(&workshop.hammerbeam(&["verify", "results", "--sample", "60"]));
    }
}

/// Without a damper a two-sided stop is one law; with next to none its orbits are next to those.
#[test]
fn a_damper_that_does_nothing_leaves_a_two_sided_stop_as_it_is() {
    let stop = |damper: &str| {
        shaken(&format!(
            "[[stop]]\nlaw = \"two-sided\"\nat = \"mass\"\nstiffness_n_m = 2e4\ngap_m = 0.02\n{damper}\n"
        ))
    };
    let orbit = |study: &str| {
        let workshop = Workshop::with(study);
        let found = workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "5.8", "--json"]);
        assert_success(&found);
        let document: serde_json::Value = serde_json::from_str(&stdout(&found)).unwrap();
        document["max_abs_displacement_m"].as_f64().unwrap()
    };
    let (without, with) = (orbit(&stop("")), orbit(&stop("damping_n_s_m = 1e-9")));
    assert!((with / without - 1.0).abs() < 1e-10, "{with} {without}");
}

#[test]
fn what_both_sides_share_varies_for_both() {
    let stop = "[[stop]]\nname = \"wall\"\nlaw = \"linear\"\nat = \"mass\"\nside = \"both\"\n\
        stiffness_n_m = 2e4\ndamping_n_s_m = 15.0\ngap_m = 0.02\n";
    let vary = |parameter: &str| {
        format!(
            "[[vary]]\nparameter = \"{parameter}\"\nrange = [0.0195, 0.0205]\n\
             frequency_hz = 5.8\nsteps = 100\n"
        )
    };
    let names = ["stop.wall.gap_m", "stop.wall (above).gap_m"];
    let (workshop, _) = run(&shaken(&format!("{stop}{}", names.map(vary).concat())));
    let text = fs::read_to_string(workshop.path("exported/parameter_branches.csv")).unwrap();
    let columns: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let of = |name: &str| columns.iter().position(|column| *column == name).unwrap();
    let (named, value, force) = (of("parameter_name"), of("parameter"), of("max_contact_force_n"));
    let lines: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let reached = |parameter: &str| {
        let rows = lines.iter().filter(|cells| cells[named] == parameter);
        rows.map(|cells| [value, force].map(|column| cells[column].parse::<f64>().unwrap()))
            .collect::<Vec<_>>()
    };
    let at_end = |rows: &[[f64; 2]]| {
        let ends = rows.iter().fold([1.0, 0.0_f64], |[low, high], [gap, _]| [gap.min(low), gap.max(high)]);
        assert_eq!(ends, [0.0195, 0.0205]);
        rows.iter().find(|[gap, _]| *gap == 0.0205).unwrap()[1]
    };
    let [both, one] = names.map(|name| at_end(&reached(name)));
    let set = Workshop::with(&shaken(&stop.replace("gap_m = 0.02", "gap_m = 0.0205")));
    let found = set.hammerbeam(&["orbit", "study.toml", "--frequency", "5.8", "--json"]);
    assert_success(&found);
    let document: serde_json::Value = serde_json::from_str(&stdout(&found)).unwrap();
    let force = document["max_contact_force_n"].as_f64().unwrap();
    assert!((both / force - 1.0).abs() < 1e-8, "{both} {force}");
    assert!((one / force - 1.0).abs() > 1e-4, "{one} {force}");
}

#[test]
fn a_side_with_the_name_of_another_stop_is_refused() {
    let stop = |name: &str, side: &str| {
        let keys = "law = \"rigid\"\nat = \"mass\"\nrestitution = 0.5";
        format!("[[stop]]\nname = \"{name}\"\nside = \"{side}\"\n{keys}\n")
    };
    let workshop = Workshop::with(&shaken(&[stop("a (below)", "below"), stop("a", "both")].concat()));
    let part = "a side of stop \"a\" is \"a (below)\", a name that is taken";
    assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), &[part]);
}
