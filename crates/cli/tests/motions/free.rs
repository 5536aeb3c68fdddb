//! A study without `[excitation]`: free vibration.
//!
//! A damped mass, `m y'' + c y' + k y = 0`, moves as `y = exp(-d t) (Y cos(w t) + (V + d Y)/w sin(w t))`
//! with `d = c/(2 m)`, `w^2 = k/m - d^2`. Let go in front of a stop without gap it strikes it first when this
//! is zero. From a rigid stop it comes back `pi/w` later, with `e exp(-d pi/w)` of the speed; with an elastic
//! one each contact is half a period of the mass on both springs, each flight half a period on the first.

use std::f64::consts::PI;

use super::{column, document, table};
use crate::common::{Workshop, assert_bad_input, assert_success, stdout};

const STUDY: &str = include_str!("../../../../studies/free-decay.toml");
const MASS: f64 = 2.0;
const DAMPER: f64 = 1.6;
const SPRING: f64 = 800.0;
const LET_GO: [&str; 4] = ["simulate", "study.toml", "--initial", "mass.y=-0.01"];

/// `d` and `w` of the mass on that spring.
fn decay(spring: f64) -> (f64, f64) {
    let d = DAMPER / (2.0 * MASS);
    (d, (spring / MASS - d * d).sqrt())
}

fn without_stop() -> String {
    STUDY.split("[[stop]]").next().unwrap().to_owned()
}

fn simulated(study: &str, options: &[&str]) -> Workshop {
    let workshop = Workshop::with(study);
    assert_success(&workshop.hammerbeam(&[&LET_GO[..], options, &["--out", "out"]].concat()));
    workshop
}

#[test]
fn a_damped_mass_decays_as_its_closed_form() {
    let workshop = simulated(&without_stop(), &["--duration", "3", "--sampling", "64"]);
    let samples = table(&workshop, "out/samples.csv");
    let (d, w) = decay(SPRING);
    let times = column(&samples, "time_s");
    assert_eq!(times.len(), 3 * 64);
    for (k, (time, y)) in times.iter().zip(column(&samples, "displacement_m")).enumerate() {
        assert!((time - k as f64 / 64.0).abs() <= 1e-15 * k as f64, "{time}");
        let exact = -0.01 * (-d * time).exp() * ((w * time).cos() + d / w * (w * time).sin());
        assert!((y - exact).abs() < 1e-13, "{y} instead of {exact} at {time} s");
    }
}

#[test]
fn impacts_on_a_rigid_stop_come_half_a_period_apart_and_lose_their_share() {
    let workshop = simulated(STUDY, &["--duration", "4"]);
    let contacts = table(&workshop, "out/contacts.csv");
    let (d, w) = decay(SPRING);
    // tan(w t) = -w/d.
    let first = (PI - (w / d).atan()) / w;
    let speed = 0.01 * (w + d * d / w) * (-d * first).exp() * (w * first).sin();
    let times = column(&contacts, "begin_s");
    assert_eq!(times.len(), 1 + ((4.0 - first) * w / PI) as usize);
    for (n, (time, found)) in times.iter().zip(column(&contacts, "impact_velocity_m_s")).enumerate() {
        let n = n as f64;
        assert!((time - first - n * PI / w).abs() < 1e-11, "impact {n} at {time} s");
        let exact = speed * (0.8 * (-d * PI / w).exp()).powf(n);
        assert!((found / exact - 1.0).abs() < 1e-9, "impact {n}: {found} instead of {exact} m/s");
    }
}

#[test]
fn contacts_with_an_elastic_stop_last_half_a_period_of_both_springs() {
    let elastic =
        STUDY.replace("law = \"rigid\"\nrestitution = 0.8", "law = \"linear\"\nstiffness_n_m = 2e4");
    let workshop = simulated(&elastic, &["--duration", "2"]);
    let contacts = table(&workshop, "out/contacts.csv");
    let ((d, w), (_, pressed)) = (decay(SPRING), decay(SPRING + 2e4));
    let first = (PI - (w / d).atan()) / w;
    let ends = column(&contacts, "end_s");
    assert!(ends.len() > 10);
    for (n, (begin, end)) in column(&contacts, "begin_s").into_iter().zip(ends).enumerate() {
        let exact = first + n as f64 * (PI / w + PI / pressed);
        // The steps in contact are as close as 1e-12 of the motion.
        assert!((begin - exact).abs() < 1e-9 && (end - begin - PI / pressed).abs() < 1e-9, "{begin} {end}");
    }
}

/// However the duration is written down, the motion is the same.
#[test]
fn the_motion_does_not_depend_on_the_sampling() {
    let state = |sampling: &str| {
        let workshop = Workshop::with(STUDY);
        let options = ["--duration", "2", "--sampling", sampling, "--json"];
        let found = document(&workshop, &[&LET_GO[..], &options].concat());
        assert_eq!(found["time_s"], 2.0);
        let state = found["final_modal_state"].as_array().unwrap().clone();
        state.iter().map(|entry| entry.as_f64().unwrap()).collect::<Vec<_>>()
    };
    for (one, other) in state("100").into_iter().zip(state("4096")) {
        assert!((one - other).abs() < 1e-12, "{one} {other}");
    }
}

#[test]
fn check_and_modes_take_it_and_the_document_has_no_frequency() {
    let workshop = Workshop::with(STUDY);
    let understood = workshop.hammerbeam(&["check", "study.toml"]);
    assert_success(&understood);
    assert!(stdout(&understood).contains("excitation   none; `simulate` follows the free vibration"));
    assert_success(&workshop.hammerbeam(&["modes", "study.toml", "--out", "drawn"]));
    assert!(document(&workshop, &["check", "study.toml", "--json"])["frequency_hz"].is_null());
    let found = document(&workshop, &[&LET_GO[..], &["--duration", "1", "--json"]].concat());
    assert!(["frequency_hz", "periods", "transient_periods"].iter().all(|key| found[*key].is_null()));
    // A hundred samples in a period of the lowest eigenfrequency, whole intervals of them.
    assert!((found["sampling_hz"].as_f64().unwrap() / (100.0 * 20.0 / (2.0 * PI)) - 1.0).abs() < 1e-12);
    assert_eq!(found["samples"], 320);
}

#[test]
fn what_needs_a_frequency_refuses_it_in_one_sentence() {
    let workshop = Workshop::with(STUDY);
    let part = "study.toml has no [excitation]: without a frequency there are no periodic responses";
    for command in [
        &["run", "study.toml", "--out", "out", "--no-figures"][..],
        &["orbit", "study.toml", "--frequency", "3"],
        &["sweep", "study.toml"],
        &["lyapunov", "study.toml", "--frequency", "3"],
        &["basins", "study.toml", "--frequency", "3", "--x", "q1=-1..1", "--y", "v1=-1..1"],
    ] {
        assert_bad_input(&workshop.hammerbeam(command), &[part]);
        assert!(!workshop.path("out").exists(), "something was written");
    }
    for (options, part) in [
        (&[][..], "--duration is missing: the study has no [excitation], so no period to count"),
        (
            &["--duration", "1", "--frequency", "3"],
            "--frequency: the study has no [excitation], so no period",
        ),
        (&["--periods", "3"], "--periods: the study has no [excitation], so no period"),
        (&["--duration", "0"], "must be a number of seconds"),
        (&["--duration", "1e9", "--sampling", "1e9"], "--duration holds 1e18 samples, must be 4e9 at most"),
    ] {
        assert_bad_input(&workshop.hammerbeam(&[&LET_GO[..], options].concat()), &[part]);
    }
}

#[test]
fn what_counts_in_periods_is_refused_in_the_study_itself() {
    for (added, part) in [
        (
            "[[load]]\nkind = \"force\"\nat = \"mass\"\namplitude_n = 1.0\norder = 1\n",
            "`order` is a multiple of",
        ),
        ("[[load]]\nkind = \"support-motion\"\namplitude_m = 1.0\norder = 1\n", "needs a moving support"),
        (
            "[[vary]]\nparameter = \"stop.wall.gap_m\"\nrange = [0.0, 1.0]\nfrequency_hz = 1.0\n",
            "`vary` needs a frequency, and there is no [excitation]",
        ),
    ] {
        let workshop = Workshop::with(&format!("{STUDY}\n{added}"));
        assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), &[part]);
    }
}

/// The mass rests at `-m g/k` under its weight; a duration of a forced study is rounded up to whole periods.
#[test]
fn constant_loads_stay_and_a_duration_counts_periods_where_there_are_some() {
    let weight = "[[load]]\nkind = \"gravity\"\nacceleration_m_s2 = -9.81\n";
    let workshop = Workshop::with(&format!("{}\n{weight}", without_stop()));
    let arguments = ["simulate", "study.toml", "--initial", "linear", "--duration", "1", "--json"];
    let found = document(&workshop, &arguments);
    let lowest = found["max_abs_sampled_displacement_m"].as_f64().unwrap();
    assert!((lowest - MASS * 9.81 / SPRING).abs() < 1e-15, "{lowest}");
    let forced = Workshop::driven_mass("frequency_hz = [0.1, 0.4]\n");
    let arguments = ["simulate", "study.toml", "--frequency", "0.3", "--duration", "10.1", "--json"];
    assert_eq!(document(&forced, &arguments)["periods"], 4);
    assert_bad_input(&forced.hammerbeam(&["simulate", "study.toml"]), &["--frequency is missing"]);
}

#[test]
fn a_finished_motion_is_read_again_with_the_same_bytes() {
    let options = ["--duration", "1"];
    let workshop = simulated(STUDY, &options);
    let tables = || {
        let mut files = workshop.listing();
        files.retain(|(path, _)| path.extension().is_some_and(|extension| extension == "csv"));
        files
    };
    let before = tables();
    assert_eq!(before.len(), 3);
    assert_success(&workshop.hammerbeam(&[&LET_GO[..], &options, &["--out", "out"]].concat()));
    assert!(tables() == before);
    assert_success(&workshop.hammerbeam(&["figure", "out"]));
    assert_success(&workshop.hammerbeam(&["export", "out", "--format", "csv"]));
}
