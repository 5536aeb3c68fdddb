//! Every law of a contact from the study file to verified branches: what bends the resonance, where it sets
//! in, and where the energy goes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{collections::HashMap, f64::consts::TAU, fs};

use crate::common::{Workshop, assert_success, extensive, mass_against_a_stop, stdout};
use serde_json::{Value, json};

/// Of the study: the mass is 1 kg.
const STIFFNESS: f64 = 1000.0;
const DAMPING_RATIO: f64 = 0.02;
const FORCE: f64 = 5.0;
const PHASE: f64 = -2.2;
const GAP: f64 = 0.02;
/// Of the rigid stop.
const RIGID_RESTITUTION: f64 = 0.7;
/// Orbits of this frequency touch the stop once.
const TOUCHING_HZ: f64 = 5.5;

const HERTZ: &str = "stiffness_n_m15 = 1e7";

/// The study with a law above the mass.
fn with(law: &str, keys: &str) -> String {
    mass_against_a_stop(&format!("law = \"{law}\"\n{keys}"))
}

/// Nothing is lost. The two-sided stop has its other side out of reach, and what varies there is the force.
#[test]
fn elastic_laws_are_followed_and_verified() {
    followed_and_verified("linear", &with("linear", "stiffness_n_m = 2e4"), false);
    followed_and_verified("hertz", &with("hertz", HERTZ), false);
    let both = with("two-sided", "stiffness_n_m = 2e4\ngap_above_m = 0.02\ngap_below_m = 0.5");
    let study = both.replace("side = \"above\"\ngap_m = 0.02\n", "");
    let varied = study
        .replace("stop.wall.gap_m\"\nrange = [0.015, 0.022]", "excitation.amplitude_n\"\nrange = [4.5, 5.5]");
    assert!(varied != study && study != both);
    followed_and_verified("two-sided", &varied, false);
}

#[test]
fn laws_that_lose_energy_are_followed_and_verified() {
    let damped = "stiffness_n_m = 2e4\ndamping_n_s_m = 15.0";
    followed_and_verified("linear", &with("linear", damped), true);
    let loss = format!("{HERTZ}\nloss_s_m = 0.6");
    followed_and_verified("hunt-crossley", &with("hunt-crossley", &loss), true);
    let restitution = format!("restitution = {RIGID_RESTITUTION}");
    followed_and_verified("rigid", &with("rigid", &restitution), true);
}

#[test]
fn laws_that_remember_their_impact_are_followed_and_verified() {
    let laws = [
        "hunt-crossley",
        "herbert-mcwhannell",
        "lee-wang",
        "lankarani-nikravesh",
        "gonthier",
        "flores",
        "hu-guo",
    ];
    // They are one law with one number of their own, which `energy_loss` holds against each formula.
    let sample = if extensive() { &laws[..] } else { &laws[3..5] };
    for law in sample {
        let restitution = format!("{HERTZ}\nrestitution = 0.7");
        followed_and_verified(law, &with(law, &restitution), true);
    }
}

/// Rows of a table, each a value by its column.
fn rows(text: &str) -> Vec<HashMap<String, String>> {
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let columns: Vec<String> = lines.next().unwrap().collect();
    lines.map(|line| columns.iter().cloned().zip(line).collect()).collect()
}

/// The rows of `[[vary]]` branches, once they are exported.
fn parameter_rows(workshop: &Workshop) -> Vec<HashMap<String, String>> {
    rows(&fs::read_to_string(workshop.path("exported/parameter_branches.csv")).unwrap())
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

fn followed_and_verified(law: &str, study: &str, loses: bool) {
    let workshop = Workshop::with(study);
    let run = workshop.compute(&["--jobs", "1"]);
    assert_success(&run);
    assert!(!stdout(&run).contains("stopped early"), "{law}: {}", stdout(&run));
    let solutions = rows(&workshop.csv("results"));
    the_resonance_is_bent(law, &solutions);
    the_contact_begins_in_closed_form(law, &workshop);
    the_parameter_goes_from_end_to_end(law, &workshop);
    the_energy_is_balanced(law, &workshop, loses);
    let verify = workshop.hammerbeam(&["verify", "results", "--all", "--json"]);
    assert_success(&verify);
    let document: Value = serde_json::from_str(&stdout(&verify)).unwrap();
    assert_eq!((&document["agree"], &document["disagreements"]), (&true.into(), &json!([])), "{law}");
    let all = solutions.len() + parameter_rows(&workshop).len();
    assert_eq!((&document["sampled"], &document["stored"]), (&all.into(), &all.into()), "{law}");
}

/// The motions that touch from 5.2 to 6.4 Hz, all of them stable; and those that do not, which are stable and
/// become, at the touch and the fold beside it, unstable ones that do: one change.
fn the_resonance_is_bent(law: &str, solutions: &[HashMap<String, String>]) {
    let of = |branch: &str| solutions.iter().filter(|row| row["branch"] == branch).collect::<Vec<_>>();
    let stable = |branch: &str| of(branch).iter().map(|row| row["stable"] == "true").collect::<Vec<_>>();
    let (mixed, touching) = (stable("1"), stable("2"));
    assert_eq!(mixed.len() + touching.len(), solutions.len(), "{law}: two branches");
    assert!(touching.len() > 100 && touching.iter().all(|stable| *stable), "{law}");
    let unstable = mixed.iter().filter(|stable| !**stable).count();
    assert!(unstable > 50 && mixed.len() - unstable > 50, "{law}: {unstable} of {}", mixed.len());
    assert_eq!(mixed.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1, "{law}");
    for row in of("1") {
        let touches = number(row, "contacts") > 0.0;
        assert!(touches == (number(row, "max_contact_force_n") > 0.0) || law == "rigid", "{law}: {row:?}");
        // In front of the stop, and beyond it by no more than a contact is pressed in.
        assert!(touches || number(row, "max_abs_displacement_m") <= GAP * (1.0 + 1e-9), "{law}: {row:?}");
    }
    let ends = |branch| {
        of(branch)
            .iter()
            .map(|row| number(row, "frequency_hz"))
            .fold([f64::MAX, 0.0], |[low, high], f| [f.min(low), f.max(high)])
    };
    assert_eq!((ends("2"), ends("1")[1]), ([5.2, 6.4], 6.4), "{law}");
}

/// Where the motion without contacts reaches the stop: `|F/(k - W^2 + i c W)| = gap`, above the resonance. A
/// fold is beside it, where an orbit in contact has a multiplier at +1.
fn the_contact_begins_in_closed_form(law: &str, workshop: &Workshop) {
    let k = STIFFNESS * (1.0 - 2.0 * DAMPING_RATIO.powi(2));
    let square = k + (k * k - STIFFNESS.powi(2) + (FORCE / GAP).powi(2)).sqrt();
    let grazing_hz = square.sqrt() / TAU;
    let events = rows(&fs::read_to_string(workshop.path("exported/events.csv")).unwrap());
    let of = |kind: &str| {
        let found: Vec<_> =
            events.iter().filter(|row| row["event"].split('+').any(|name| name == kind)).collect();
        assert_eq!(found.len(), 1, "{law}, {kind}: {events:?}");
        found[0].clone()
    };
    let (grazing, fold) = (of("grazing"), of("fold"));
    let off = (number(&grazing, "frequency_hz") - grazing_hz).abs();
    assert!(grazing["contact_change"].contains('1'), "{law}: {grazing:?}");
    if law == "rigid" {
        // The fold is the grazing itself, where a multiplier jumps from within the circle to infinity.
        assert!(off <= number(&grazing, "uncertainty_hz"), "{law}: {off:e} {grazing:?}");
        assert!(number(&grazing, "uncertainty_hz") < 1e-5);
        return;
    }
    // Located is within 1e-8 of the frequency.
    assert_eq!((&*grazing["status"], &*fold["status"]), ("located", "located"), "{law}");
    assert!(off < 1e-8 * grazing_hz, "{law}: {off:e} from {grazing_hz} Hz");
    let [re, im] = ["multiplier_re", "multiplier_im"].map(|name| number(&fold, name));
    assert!((re - 1.0).hypot(im) < 1e-6, "{law}: {re} {im}");
    assert!(number(&fold, "frequency_hz") < grazing_hz, "{law}: {fold:?}");
}

/// At 5.9 Hz there are three orbits, and so many branches over what varies, each to both ends of its range.
fn the_parameter_goes_from_end_to_end(law: &str, workshop: &Workshop) {
    let found = parameter_rows(workshop);
    let ends = if law == "two-sided" { [4.5, 5.5] } else { [0.015, 0.022] };
    let mut reached: HashMap<&str, [f64; 2]> = HashMap::new();
    for row in &found {
        let value = number(row, "parameter");
        let known = reached.entry(&row["branch"]).or_insert([value; 2]);
        *known = [known[0].min(value), known[1].max(value)];
    }
    assert_eq!(reached.len(), 3, "{law}");
    assert!(reached.values().all(|reached| *reached == ends), "{law}: {reached:?}");
}

/// Over a period of an orbit that touches once: the excitation's work is what the damper takes and what the
/// contact loses.
fn the_energy_is_balanced(law: &str, workshop: &Workshop, loses: bool) {
    let frequency = TOUCHING_HZ.to_string();
    let simulate = ["simulate", "study.toml", "--frequency", &frequency, "--periods", "1", "--out", "motion"];
    let from = ["--initial", "branch:2", "--results", "results", "--samples-per-period", "20000"];
    assert_success(&workshop.hammerbeam(&[&simulate[..], &from].concat()));
    let read = |name: &str| rows(&fs::read_to_string(workshop.path("motion").join(name)).unwrap());
    let (samples, contacts) = (read("samples.csv"), read("contacts.csv"));
    assert_eq!(contacts.len(), 1, "{law}: {contacts:?}");
    let lost = number(&contacts[0], "energy_lost_j");
    let damping = 2.0 * DAMPING_RATIO * STIFFNESS.sqrt();
    let (mut work, mut damped) = (0.0, 0.0);
    // The motion repeats: the sum over evenly spaced samples is the trapezoidal rule.
    let step = 1.0 / (TOUCHING_HZ * samples.len() as f64);
    for sample in &samples {
        let velocity = number(sample, "velocity_m_s");
        let force = FORCE * (TAU * number(sample, "phase_cycles") + PHASE).cos();
        work += step * force * velocity;
        damped += step * damping * velocity * velocity;
    }
    let off = (work - damped - lost).abs() / work;
    if law == "rigid" {
        let speed = number(&contacts[0], "impact_velocity_m_s");
        let of_impact = 0.5 * (1.0 - RIGID_RESTITUTION.powi(2)) * speed * speed;
        assert!((lost / of_impact - 1.0).abs() < 1e-9, "{lost} {of_impact}");
        // The velocity jumps between two samples: that is a step's worth of the force and of the damper.
        let jump = step * (1.0 + RIGID_RESTITUTION) * speed * (FORCE + damping * speed);
        assert!(off * work < jump, "{law}: {off:e} of {work}");
        return;
    }
    // Samples within a contact are good to 1e-7 of the velocity.
    assert!(off < 1e-7, "{law}: {work} against {damped} and {lost}");
    if loses {
        assert!(lost > 0.01 * work, "{law}: {lost} of {work}");
    } else {
        assert!(lost.abs() < 1e-8 * work, "{law}: {lost} of {work}");
    }
}
