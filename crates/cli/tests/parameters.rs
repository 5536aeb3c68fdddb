//! Numbers of a study as parameters, every constant of damping of the structure and of stops, and numbers
//! that change the modes: where a branch ends, the study with that value has the same orbit.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{DRIVEN_MASS, Row, Workshop, assert_bad_input, assert_success, number};

/// Two masses with dampers, the second of them beside a stop.
const MASSES: &str = r#"
[structure]
kind = "lumped"
[[structure.mass]]
name = "a"
mass_kg = 1.0
[[structure.mass]]
name = "b"
mass_kg = 0.7
[[structure.spring]]
between = ["a", "ground"]
stiffness_n_m = 900.0
[[structure.spring]]
between = ["a", "b"]
stiffness_n_m = 700.0
[[structure.damper]]
between = ["a", "ground"]
damping_n_s_m = 0.8
[[structure.damper]]
between = ["a", "b"]
damping_n_s_m = 0.5
[damping]
modal_ratio = 0.01
[excitation]
kind = "force"
at = "a"
amplitude_n = 1.0
frequency_hz = [3.7, 3.9]
[[stop]]
name = "wall"
at = "b"
side = "above"
gap_m = 2.0e-3
law = "linear"
stiffness_n_m = 1.0e4
damping_n_s_m = 10.0
[response]
point = "b"
period_multiples = [1]
period_doubling_depth = 0
[continuation]
max_step_hz = 0.05
[search]
frequencies = 1
starts = 2
trials = 0
"#;

/// A shaken beam with a damper that stays fixed in space at its tip.
const BEAM: &str = r#"
[structure]
kind = "beam"
length_m = 0.6
elements = 6
youngs_modulus_pa = 2.1e11
density_kg_m3 = 7800.0
left = "clamped"
right = "free"
[structure.section]
width_m = 0.02
height_m = 0.01
[[structure.point]]
name = "tip"
at_m = 0.6
damper_n_s_m = 0.4
[reduction]
method = "free-interface"
cut_off_hz = 500.0
[damping]
modal_ratio = [0.01, 0.02, 0.01, 0.01, 0.01]
[excitation]
kind = "support-motion"
at = ["left"]
amplitude_m = 1.0e-4
phase_rad = 3.3
frequency_hz = [23.0, 24.0]
[[stop]]
name = "wall"
at = "tip"
side = "above"
gap_m = 4.0e-4
law = "lankarani-nikravesh"
stiffness_n_m15 = 1.0e6
restitution = 0.8
[response]
point = "tip"
period_multiples = [1]
period_doubling_depth = 0
[continuation]
max_step_hz = 0.05
[search]
frequencies = 1
starts = 2
trials = 0
"#;

const RAYLEIGH: (&str, &str) =
    ("modal_ratio = 0.01", "rayleigh = { mass_per_s = 0.3, stiffness_s = 4.0e-4 }");
const HUNT_CROSSLEY: (&str, &str) = (
    "law = \"linear\"\nstiffness_n_m = 1.0e4\ndamping_n_s_m = 10.0",
    "law = \"hunt-crossley\"\nstiffness_n_m15 = 3.0e5\nloss_s_m = 0.6",
);

/// A parameter, the line of the study that gives it, with `{}` for its value, and the value of the study and
/// that at the end of the range.
type Case<'a> = (&'a str, &'a str, [&'a str; 2]);

fn written((_, line, _): Case<'_>, value: &str) -> String {
    line.replace("{}", value)
}

/// Follows branches over parameters, and asks for the motion of the study with the value at the upper end of
/// each, from the state that it has there: it repeats.
fn meet_the_studies_at_their_ends(study: &str, cases: &[Case<'_>], hz: &str) {
    let vary = |&(parameter, _, [low, high]): &Case<'_>| {
        format!(
            "[[vary]]\nparameter = \"{parameter}\"\nrange = [{low}, {high}]\n\
             frequency_hz = {hz}\nsteps = 20\n"
        )
    };
    let workshop = Workshop::exported(&format!("{study}{}", cases.iter().map(vary).collect::<String>()));
    let table = |name: &str| workshop.table(&format!("results/export/{name}"));
    let (branches, ends) = (table("parameter_branches.csv"), table("parameter_ends.csv"));
    for &case in cases {
        let (parameter, _, [value, end]) = case;
        let of_case = |row: &&Row| row["parameter_name"] == parameter;
        let contacts = branches.iter().filter(of_case).filter(|row| number(row, "contacts") > 0.0).count();
        assert!(contacts > 10, "{parameter}: {contacts} rows in contact");
        let given = written(case, value);
        assert_eq!(study.matches(&given).count(), 1, "{given}");
        fs::write(workshop.path("changed.toml"), study.replace(&given, &written(case, end))).unwrap();
        let is_end = |row: &&Row| number(row, "parameter") == end.parse::<f64>().unwrap();
        let at_end: Vec<&Row> = ends.iter().filter(of_case).filter(is_end).collect();
        assert!(!at_end.is_empty(), "{parameter}: {ends:?}");
        for row in at_end {
            // No contact is closed at the phase at which motions begin.
            assert_eq!(number(row, "phase_cycles"), 0.0);
            assert_repeats(&workshop, &row["state"], (parameter, hz));
        }
    }
}

/// The motion of the changed study from a state.
fn assert_repeats(workshop: &Workshop, state: &str, (parameter, hz): (&str, &str)) {
    let initial = format!("--initial={}", state.replace(' ', ","));
    let arguments =
        ["simulate", "changed.toml", "--frequency", hz, &initial, "--periods", "2", "--out", "motion"];
    assert_success(&workshop.hammerbeam(&arguments));
    let section = workshop.table("motion/stroboscopic.csv");
    fs::remove_dir_all(workshop.path("motion")).unwrap();
    let rate = std::f64::consts::TAU * hz.parse::<f64>().unwrap();
    let speed = number(&section[0], "velocity_m_s").hypot(rate * number(&section[0], "displacement_m"));
    for key in ["displacement_m", "velocity_m_s"] {
        let [first, last] = [0, 1].map(|period| number(&section[period], key));
        // Orbits are good to 1e-10, which multipliers of some tens stretch over a period.
        assert!((first - last).abs() < 1e-8 * speed, "{parameter}: {key} {first:e} {last:e}");
    }
}

#[test]
fn dampers_of_masses_and_their_stop_vary() {
    let cases = [
        ("structure.damper.1.damping_n_s_m", "damping_n_s_m = {}\n[[structure.damper]]", ["0.8", "2.5"]),
        ("structure.damper.2.damping_n_s_m", "damping_n_s_m = {}\n[damping]", ["0.5", "1.7"]),
        ("stop.wall.damping_n_s_m", "damping_n_s_m = {}\n[response]", ["10.0", "25.0"]),
        ("damping.modal_ratio", "modal_ratio = {}", ["0.01", "0.03"]),
    ];
    meet_the_studies_at_their_ends(MASSES, &cases, "3.8");
}

#[test]
fn rayleigh_damping_and_the_loss_of_a_contact_vary() {
    let study = MASSES.replace(RAYLEIGH.0, RAYLEIGH.1).replace(HUNT_CROSSLEY.0, HUNT_CROSSLEY.1);
    let cases = [
        ("damping.rayleigh.mass_per_s", "mass_per_s = {},", ["0.3", "1.1"]),
        ("damping.rayleigh.stiffness_s", "stiffness_s = {} }", ["4.0e-4", "1.0e-3"]),
        ("stop.wall.loss_s_m", "loss_s_m = {}\n", ["0.6", "1.5"]),
    ];
    meet_the_studies_at_their_ends(&study, &cases, "3.8");
}

#[test]
fn damping_of_a_shaken_beam_varies() {
    let cases = [
        ("structure.point.tip.damper_n_s_m", "damper_n_s_m = {}\n", ["0.4", "0.9"]),
        ("damping.modal_ratio.2", "modal_ratio = [0.01, {}, 0.01, 0.01, 0.01]", ["0.02", "0.05"]),
        ("stop.wall.restitution", "restitution = {}\n", ["0.8", "0.9"]),
    ];
    meet_the_studies_at_their_ends(BEAM, &cases, "23.5");
}

/// What changes the modes, and with them what the state means: springs and masses, length and stiffness of a
/// beam; of a stop what has no other parameter.
#[test]
fn numbers_that_change_the_modes_vary() {
    let cases = [
        ("structure.spring.2.stiffness_n_m", "stiffness_n_m = {}\n[[structure.damper]]", ["700.0", "850.0"]),
        ("structure.mass.b.mass_kg", "mass_kg = {}\n[[structure.spring]]", ["0.7", "0.8"]),
    ];
    meet_the_studies_at_their_ends(MASSES, &cases, "3.8");
    let cases = [
        ("structure.youngs_modulus_pa", "youngs_modulus_pa = {}\n", ["2.1e11", "2.15e11"]),
        ("structure.section.height_m", "height_m = {}\n", ["0.01", "0.0101"]),
    ];
    // No eigenfrequency is near the cut-off.
    let beam = BEAM
        .replace("cut_off_hz = 500.0", "cut_off_hz = 700.0")
        .replace("[0.01, 0.02, 0.01, 0.01, 0.01]", "0.01");
    meet_the_studies_at_their_ends(&beam, &cases, "23.5");
}

/// The grazing of a linear motion over its spring and its mass: `F/((k - m w^2)^2 + (c w)^2)^(1/2)` is the
/// gap at every row of the curve.
#[test]
fn a_grazing_moves_with_spring_and_mass_as_the_closed_form_says() {
    let curves =
        [("spring.1.stiffness_n_m", [0.8, 1.3]), ("mass.m.mass_kg", [0.8, 1.2])].map(|(key, range)| {
            format!(
                "[[curve]]\nof = \"grazing\"\nnear_hz = 0.24\nparameter = \"structure.{key}\"\nrange = \
        {range:?}\n"
            )
        });
    let stop = "[[stop]]\nname = \"stop\"\nat = \"m\"\nlaw = \"linear\"\nstiffness_n_m = 30.0\ngap_m = \
    0.3\nside = \"above\"\n";
    let rest = "[response]\npoint = \"m\"\nperiod_multiples = [1]\nperiod_doubling_depth = \
    0\n[search]\nfrequencies = 2\ntrials = 0\n";
    let workshop = Workshop::exported(&format!(
        "{DRIVEN_MASS}frequency_hz = [0.15, 0.4]\n{stop}{rest}{}",
        curves.concat()
    ));
    let found = workshop.table("results/export/curves.csv");
    for (key, ends) in
        [("structure.spring.1.stiffness_n_m", [0.8, 1.3]), ("structure.mass.m.mass_kg", [0.8, 1.2])]
    {
        let of_curve: Vec<&Row> = found.iter().filter(|row| row["parameter_name"] == key).collect();
        assert!(of_curve.len() > 20 && of_curve.len() < 1000, "{key}: {} rows", of_curve.len());
        let values: Vec<f64> = of_curve.iter().map(|row| number(row, "parameter")).collect();
        assert!(ends.iter().all(|end| values.contains(end)), "{key}: {values:?}");
        for (row, value) in of_curve.iter().zip(values) {
            let (stiffness, mass) = if key.contains("spring") { (value, 1.0) } else { (1.0, value) };
            let w = std::f64::consts::TAU * number(row, "frequency_hz");
            let amplitude = 0.4 / (stiffness - mass * w * w).hypot(0.04 * w);
            assert!((amplitude / 0.3 - 1.0).abs() < 1e-8, "{key} {value}: {amplitude}");
        }
    }
}

/// `F/((k - m w^2)^2 + (c w)^2)^(1/2)` at every row of a branch without contact.
#[test]
fn the_amplitude_of_a_linear_oscillator_follows_its_damper() {
    let rest = "frequency_hz = [0.14, 0.16]\n[response]\npoint = \"m\"\nperiod_multiples = \
    [1]\n[search]\nfrequencies = 1\ntrials = 0\n[[vary]]\nparameter \
    = \"structure.damper.1.damping_n_s_m\"\nrange = [0.01, 0.5]\nfrequency_hz = 0.15\n";
    let workshop = Workshop::exported(&format!("{DRIVEN_MASS}{rest}"));
    let found = workshop.table("results/export/parameter_branches.csv");
    assert!(found.len() > 20);
    let w = std::f64::consts::TAU * 0.15;
    for row in found {
        let expected = 0.4 / (1.0 - w * w).hypot(number(&row, "parameter") * w);
        let amplitude = number(&row, "max_abs_displacement_m");
        assert!((amplitude / expected - 1.0).abs() < 1e-9, "{amplitude} {expected}");
    }
}

#[test]
fn parameters_that_are_not_there_are_refused() {
    let refused = |study: &str, parameter: &str, range: &str, parts: &[&str]| {
        let vary = format!("[[vary]]\nparameter = \"{parameter}\"\nrange = {range}\nfrequency_hz = 3.8\n");
        let workshop = Workshop::with(&format!("{study}{vary}"));
        assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), parts);
    };
    let unknown = "not a parameter of this study";
    refused(
        MASSES,
        "structure.damper.3.damping_n_s_m",
        "[0.1, 1.0]",
        &[unknown, "structure.damper.2.damping_n_s_m"],
    );
    let known = ["did you mean \"structure.spring.2.stiffness_n_m\"?", "structure.mass.a.mass_kg"];
    refused(MASSES, "structure.spring.2.stifness_n_m", "[0.1, 1.0]", &[&[unknown], &known[..]].concat());
    // The first mass is named like the number of the second.
    let twice = MASSES.replace("\"a\"", "\"2\"");
    refused(&twice, "structure.mass.2.mass_kg", "[0.5, 2.0]", &["names 2 numbers of this study"]);
    refused(MASSES, "search.starts", "[1.0, 3.0]", &[unknown]);
    refused(MASSES, "structure.mass.a.mass_kg", "[-1.0, 2.0]", &["`range`", "zero"]);
    refused(MASSES, "structure.mass.a.mass_kg", "[0.0, 2.0]", &["mass_kg", "0"]);
    refused(MASSES, "structure.mass.a.mass_kg", "[1.5, 2.0]", &["`range`", "the study has"]);
    refused(MASSES, "damping.modal_ratio.1", "[0.0, 0.1]", &[unknown, "damping.modal_ratio"]);
    refused(MASSES, "damping.rayleigh.mass_per_s", "[0.0, 0.1]", &[unknown]);
    refused(MASSES, "stop.wall.loss_s_m", "[0.1, 0.9]", &[unknown, "stop.wall.damping_n_s_m"]);
    refused(MASSES, "structure.damper.1.damping_n_s_m", "[-1.0, 1.0]", &["`range[0]`", "allowed"]);
    refused(MASSES, "stop.wall.damping_n_s_m", "[0.0, 20.0]", &["wall", "more than 0 to be varied"]);
    let undamped = MASSES.replace("\ndamping_n_s_m = 10.0", "");
    refused(&undamped, "stop.wall.damping_n_s_m", "[1.0, 20.0]", &[unknown]);
}
