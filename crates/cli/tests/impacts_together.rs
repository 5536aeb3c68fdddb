//! Two rigid stops struck at one instant: a branch ends there if both strike the same body, since the motion
//! depends on which comes first, and goes on if they do not.
use hammerbeam_orbit::StopReason;
use hammerbeam_results::end::BranchEnd;

use crate::{
    common::{Row, Workshop, assert_success, number, stored},
    corners::{WHOLE, assert_whole, ends},
};

/// A mass that strikes both the one that carries it and a stop.
const ON_ONE_BODY: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.26 }, { name = "b", mass_kg = 0.613 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 90.39 },
    { between = ["b", "a"], stiffness_n_m = 345.97 },
]
[damping]
modal_ratio = 0.00364
[excitation]
kind = "support-motion"
at = "ground"
amplitude_m = 0.01
frequency_hz = [1.55, 1.65]
[[stop]]
name = "between"
between = ["a", "b"]
law = "rigid"
restitution = 0.479
gap_m = 0.00014392
side = "above"
[[stop]]
name = "below"
at = "b"
law = "rigid"
restitution = 0.613
gap_m = 0.021296
side = "below"
[search]
frequencies = 4
starts = 4
trials = 4
[continuation]
max_step_hz = 0.0027424
"#;

/// Two masses on one support, each with its own stop. At 0.17 Hz the first one strikes earlier, at 0.23 Hz
/// the second.
const ON_TWO_BODIES: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }, { name = "b", mass_kg = 1.0 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 1.0 },
    { between = ["b", "ground"], stiffness_n_m = 1.5 },
]
damper = [
    { between = ["a", "ground"], damping_n_s_m = 0.1 },
    { between = ["b", "ground"], damping_n_s_m = 0.6 },
]
[excitation]
kind = "support-motion"
at = "ground"
amplitude_m = 0.5
frequency_hz = [0.165, 0.24]
[[stop]]
name = "first"
at = "a"
law = "rigid"
restitution = 0.6
gap_m = 1.0
side = "above"
[[stop]]
name = "second"
at = "b"
law = "rigid"
restitution = 0.6
gap_m = 0.55
side = "above"
[search]
frequencies = 2
starts = 2
trials = 2
[continuation]
max_step_hz = 0.001
"#;

/// The waveforms of all orbits at a frequency, with so many samples a period.
fn waveforms(workshop: &Workshop, frequency_hz: f64, samples: u32) -> Vec<Row> {
    let (frequency, samples) = (frequency_hz.to_string(), samples.to_string());
    let options = ["export", "--format", "csv", "--frequency", &frequency, "--samples", &samples, "results"];
    assert_success(&workshop.hammerbeam(&options));
    workshop.table("results/export/waveforms.csv")
}

/// At the phase that the end names both gaps are closed, by the waveforms of the last orbits.
#[test]
fn a_branch_ends_where_one_body_strikes_two_stops_at_one_instant() {
    let workshop = Workshop::exported(ON_ONE_BODY);
    let (_, branches) = stored(&workshop);
    let mut early = ends(&branches);
    early.retain(|(_, end)| !end.is_complete());
    assert!(!early.is_empty());
    for (_, end) in &early {
        let BranchEnd::Walk(StopReason::ImpactsTogether { place: frequency_hz, elements, phase }) = end
        else {
            panic!("{end:?}");
        };
        assert_eq!(elements, "between and below");
        let rows = waveforms(&workshop, *frequency_hz, 4000);
        // Half a sample at the speeds of these motions, some 1 m/s.
        let near = |row: &&Row| {
            let apart = number(row, "phase_cycles") - phase;
            (apart - apart.round()).abs() < 2.5e-4
        };
        let closed = |row: &&Row| {
            let [a, b, ground] =
                ["a", "b", "ground"].map(|name| number(row, &format!("{name}_displacement_m")));
            (a - b - 1.4392e-4).abs() < 3e-5 && (b - ground + 0.021_296).abs() < 1e-4
        };
        assert!(rows.iter().filter(near).any(|row| closed(&row)), "{frequency_hz} Hz at {phase}");
    }
}

/// The sample before which the velocity of a mass falls most.
fn strikes(rows: &[Row], mass: &str) -> f64 {
    let velocity = |row: &Row| number(row, &format!("{mass}_velocity_m_s"));
    let falls = rows.windows(2).map(|pair| (velocity(&pair[0]) - velocity(&pair[1]), &pair[1]));
    let hardest = falls.max_by(|one, other| one.0.total_cmp(&other.0)).unwrap();
    number(hardest.1, "phase_cycles")
}

#[test]
fn a_branch_goes_on_where_two_bodies_strike_their_stops_at_one_instant() {
    let workshop = Workshop::exported(ON_TWO_BODIES);
    assert_whole(&workshop, (0.165, 0.24), WHOLE);
    let first_leads = [0.17, 0.23].map(|frequency_hz| {
        let rows = waveforms(&workshop, frequency_hz, 1000);
        let rows: Vec<Row> = rows.into_iter().filter(|row| row["orbit"] == "1").collect();
        strikes(&rows, "a") < strikes(&rows, "b")
    });
    assert_eq!(first_leads, [true, false]);
}
