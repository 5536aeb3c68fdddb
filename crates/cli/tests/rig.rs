//! The virtual rig of the studies folder, on a coarser sweep, through the whole comparison of the paper's
//! section 4.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{Workshop, assert_success, extensive, stdout};
use serde_json::Value;

const RIG: &str = include_str!("../../../studies/virtual-rig.toml");

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Columns of a table by their titles.
fn column(workshop: &Workshop, file: &str, title: &str) -> Vec<f64> {
    let text = fs::read_to_string(workshop.path("out").join(file)).unwrap();
    let mut lines = text.lines();
    let place = lines.next().unwrap().split(',').position(|found| found == title);
    let place = place.unwrap_or_else(|| panic!("{file} has no column {title}"));
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap_or(f64::NAN)).collect()
}

/// Correlation about the means.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let about = |x: &[f64]| -> Vec<f64> {
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        x.iter().map(|value| value - mean).collect()
    };
    let (a, b) = (about(a), about(b));
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt()
}

/// The signals of figures 7 to 14: index of the figure from 7 on, frequencies [Hz] printed for the measured
/// and the computed signal, with their period between them.
const PRINTED: [(usize, f64, u32, f64); 8] = [
    (0, 31.0, 1, 32.34),
    (1, 31.5, 1, 33.6),
    (2, 33.6, 1, 36.2),
    (3, 34.5, 1, 37.64),
    (4, 50.8, 2, 53.0),
    (5, 61.65, 2, 61.65),
    (6, 63.7, 2, 67.8),
    (7, 66.5, 2, 71.5),
];

/// The signals that are compared.
fn printed() -> Vec<(usize, f64, u32, f64)> {
    let is_of_the_sample = |(figure, ..): &(usize, f64, u32, f64)| extensive() || [3, 5, 7].contains(figure);
    PRINTED.into_iter().filter(is_of_the_sample).collect()
}

/// What makes the rig quicker where the extensive tests are not asked for: motions settle in 60 periods
/// instead of 200, branches start at two frequencies and end after 1500 solutions (which leaves out most of
/// the ten thousand of twice the period between 51 and 55 Hz), and three of the eight signals are compared,
/// of both periods.
fn sampled(study: String) -> String {
    if extensive() {
        return study;
    }
    let signals: Vec<String> =
        printed().iter().map(|(_, hz, period, _)| format!("[{hz}, {period}]")).collect();
    let rig = format!("[rig]\nsettling_periods = 60\nsignals = [{}]", signals.join(", "));
    let search = "unstable_starts = false\nfrequencies = 2\nstarts = 1\nsettling_periods = 64";
    let continuation = "[continuation]\nmax_step_hz = 0.02\nbudget_solutions = 1500";
    assert!(study.contains("\n[rig]\n") && study.contains("\nunstable_starts = false\n"));
    study.replacen("[rig]", &rig, 1).replacen(
        "unstable_starts = false",
        &format!("{search}\n{continuation}"),
        1,
    )
}

/// By default three of the eight signals, and on branches and a sweep that are quicker to compute
/// ([`sampled`]); with `HAMMERBEAM_EXTENSIVE=1` all of it.
#[test]
fn the_virtual_rig_goes_through_section_4_of_the_paper() {
    let study = RIG
        .replace("sweep_hz = [20.0, 70.0]", "sweep_hz = [28.0, 68.0]")
        .replace("step_hz = 0.5", "step_hz = 1.0")
        .replace("frequency_hz = [20.0, 78.0]", "frequency_hz = [28.0, 76.0]")
        .replace("other_low_pass_hz = [1500.0, 3000.0]", "other_low_pass_hz = [1500.0]");
    assert!(
        study.contains("[28.0, 68.0]")
            && study.contains("[28.0, 76.0]")
            && study.contains("step_hz = 1.0")
            && study.contains("[1500.0]")
    );
    let workshop = Workshop::with(&sampled(study));
    let output = workshop.hammerbeam(&["rig", "study.toml", "--out", "out", "--json"]);
    assert_success(&output);
    let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
    eigenfrequencies_and_table(&workshop, &found);
    shift_and_factor(&found);
    classification(&workshop, &found);
    signals(&workshop, &found);
    filters(&found);
}

/// The rig is built for 17.2, 128.9 and 378.9 Hz and a damping of 0.003; its table falls 23 % behind at 70
/// Hz. The decay shows it, within its intervals of 95 % (widened by a half: three of them at once).
fn eigenfrequencies_and_table(workshop: &Workshop, found: &Value) {
    let modes = found["eigenfrequencies"].as_array().unwrap();
    // Up to 0.6 of 850 Hz; a mode that fades too fast is reported as not measured.
    assert_eq!(modes.len(), 3, "{modes:?}");
    let mut shown = 0;
    for (index, (mode, hz)) in modes.iter().zip([17.2, 128.9, 378.9]).enumerate() {
        assert_eq!(mode["mode"], index + 1);
        assert!((number(&mode["rig_hz"]) / hz - 1.0).abs() < 1e-3, "{mode}");
        if !mode["measured_hz"].is_null() {
            let half = 1.5 * number(&mode["measured_half_width_hz"]) + 1e-3;
            assert!((number(&mode["measured_hz"]) - hz).abs() < half, "{mode}");
            shown += 1;
        }
    }
    assert!(shown >= 2, "{modes:?}");
    assert!((number(&modes[0]["measured_damping_ratio"]) - 0.003).abs() < 1e-4, "{}", modes[0]);
    let (hz, ratio) = (
        column(workshop, "figure_02.csv", "frequency_hz"),
        column(workshop, "figure_02.csv", "measured_over_computed"),
    );
    // Of the table in the study: 0.428/0.5015 at 60 Hz.
    let at_60 = hz.iter().position(|hz| *hz == 60.0).unwrap();
    assert!((ratio[at_60] - 0.428 / 0.5015).abs() < 2e-3, "{}", ratio[at_60]);
}

/// The paper shifts by 6 % and by a factor of six to seven, which it lays to the filter.
fn shift_and_factor(found: &Value) {
    let comparison = |name: &str| {
        let all = found["comparisons"].as_array().unwrap();
        all.iter().find(|one| one["name"] == name).unwrap_or_else(|| panic!("{name}")).clone()
    };
    let (plain, filtered) = (comparison("acceleration"), comparison("filtered_acceleration"));
    for one in [&plain, &filtered, &comparison("displacement")] {
        let factor = number(&one["frequency_factor"]["value"]);
        assert!((1.03..1.09).contains(&factor), "{}: {factor}", one["name"]);
        let residual = |which: &str| number(&one[which]["log_rms"]);
        let within = |which: &str| number(&one[which]["within_reach"]);
        assert!(within("residual_after") > within("residual_before"), "{one}");
        // What the fit makes small is not the residual over all that meet a branch, but the sum in which
        // points far off are constants: behind the filter, where amplitudes hardly differ, that residual
        // rises in this coarse sweep.
        if one["name"] != "filtered_acceleration" {
            assert!(residual("residual_after") < 0.8 * residual("residual_before"), "{}", one["name"]);
        }
        assert!(number(&one["explained"]) > 2.0 * number(&one["too_far"]), "{}", one["name"]);
    }
    assert!(number(&plain["residual_before"]["log_rms"]) > 2.0, "accelerations are far off before");
    let by_filter =
        number(&plain["amplitude_factor"]["value"]) / number(&filtered["amplitude_factor"]["value"]);
    assert!((5.5..8.0).contains(&by_filter), "{by_filter}");
}

/// Each point has its verdict, and records agree with the states.
fn classification(workshop: &Workshop, found: &Value) {
    let points = number(&found["sweep"]["points"]);
    assert_eq!(points, 82.0);
    let right = number(&found["classification"]["as_the_states"]);
    assert!(right > 0.85 * points, "{right} of {points}");
    for name in ["figure_06_points.csv", "points_filtered_acceleration.csv", "points_displacement.csv"] {
        let text = fs::read_to_string(workshop.path("out").join(name)).unwrap();
        let mut lines = text.lines();
        let verdict = lines.next().unwrap().split(',').position(|title| title == "verdict").unwrap();
        let words = ["explained", "too-far", "only-unstable", "no-branch", "aperiodic", "doubtful"];
        assert!(lines.clone().all(|line| words.contains(&line.split(',').nth(verdict).unwrap())), "{name}");
        assert_eq!(lines.count(), 82, "{name}");
    }
    // "Most of the aperiodic signals are chaotic signals": by the motion itself.
    let chaos = &found["chaos"];
    assert!(number(&chaos["aperiodic"]) >= 5.0, "{chaos}");
    assert!(2.0 * number(&chaos["positive_exponent_of_the_motion"]) > number(&chaos["aperiodic"]), "{chaos}");
    let exponents = column(workshop, "measured.csv", "largest_exponent_per_s");
    let reported = exponents.iter().filter(|value| value.is_finite() && **value > 0.0).count();
    assert_eq!(reported as f64, number(&chaos["positive_exponent_of_the_record"]));
}

/// Figures 7 to 14: the paper's periods, and histories that are alike.
fn signals(workshop: &Workshop, found: &Value) {
    let printed = printed();
    let signals = found["signals"].as_array().unwrap();
    assert_eq!(signals.len(), printed.len());
    for (place, (signal, &(figure, measured_hz, period, computed_hz))) in
        signals.iter().zip(&printed).enumerate()
    {
        assert_eq!(number(&signal["measured_hz"]), measured_hz);
        assert_eq!(signal["measured_as"], format!("periodic, {period}"), "{signal}");
        let computed = &signal["computed"];
        // The pair of figure 12 is printed with one frequency, probably by mistake; the paper's pairs are 4
        // to 9 % apart.
        if figure != 5 {
            assert!((number(&computed["frequency_hz"]) / computed_hz - 1.0).abs() < 0.035, "{signal}");
        }
        assert!((1.03..1.10).contains(&number(&computed["over_measured"])), "{signal}");
        let file = format!("figure_{:02}.csv", place + 7);
        let (a, b) = (
            column(workshop, &file, "measured_acceleration_m_s2"),
            column(workshop, &file, "computed_filtered_acceleration_m_s2"),
        );
        assert_eq!(a.len(), 512 * period as usize);
        let said = number(&computed["correlation"]);
        assert!((correlation(&a, &b) - said).abs() < 1e-6 && said > 0.75, "{file}: {said}");
    }
    // The dip of figure 10 is the eleventh superharmonic of the third mode.
    let tenth = printed.iter().position(|(figure, ..)| *figure == 3).unwrap();
    assert!((number(&signals[tenth]["computed"]["frequency_hz"]) * 11.0 / 414.31 - 1.0).abs() < 0.005);
}

/// What 850 Hz leave, and 1500 Hz; displacements are not touched.
fn filters(found: &Value) {
    let median = |filter: usize, what: &str| number(&found["filters"][filter][what]["median"]);
    assert!((6.0..7.2).contains(&median(0, "acceleration_stable")), "{}", found["filters"][0]);
    assert!((3.3..4.2).contains(&median(1, "acceleration_stable")), "{}", found["filters"][1]);
    for filter in 0..2 {
        assert!(number(&found["filters"][filter]["displacement_all"]["largest"]) < 1.001);
    }
}
