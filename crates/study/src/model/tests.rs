use approx::assert_relative_eq;

use super::*;

const PAPER: &str = include_str!("../../../../studies/beam-with-stop.toml");

fn build(text: &str) -> Result<Model, StudyError> {
    Model::build(&StudyFile::parse("study.toml", text.to_owned())?)
}

fn paper_with(old: &str, new: &str) -> Result<Model, StudyError> {
    assert!(PAPER.contains(old), "{old} is not in the study");
    build(&PAPER.replacen(old, new, 1))
}

#[track_caller]
fn assert_refused(model: Result<Model, StudyError>, parts: &[&str]) {
    let message = model.map(|_| ()).unwrap_err().to_string();
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in:\n{message}");
    }
}

const GRAVITY: &str = "[[load]]\nkind = \"gravity\"\nacceleration_m_s2 = -9.81\n";

#[test]
fn the_paper_has_six_modes_and_a_riding_stop_below() {
    let model = build(PAPER).unwrap();
    assert_eq!(model.system.dof(), 6);
    let element = &model.system.elements()[0];
    assert!(model.response.shape[0] > 0.0 && element.shape[0] == -model.response.shape[0]);
    assert_relative_eq!(element.support_ratios[0], 0.0, epsilon = 1e-12);
    assert_relative_eq!(model.response.support_ratios[0], 1.0, epsilon = 1e-12);
    assert_relative_eq!(model.tables.reduced_hz[0], 17.495, max_relative = 1e-4);
}

#[test]
fn a_stop_fixed_in_space_feels_the_support_motion() {
    let model = paper_with("fixed_to = \"left\"", "fixed_to = \"space\"").unwrap();
    assert_relative_eq!(model.system.elements()[0].support_ratios[0], -1.0, epsilon = 1e-12);
}

#[test]
fn a_gap_measured_at_rest_moves_with_the_sag() {
    let text =
        format!("{PAPER}\n{GRAVITY}").replacen("gap_m = 0.0", "gap_m = 0.0\ngap_measured = \"at-rest\"", 1);
    let model = build(&text).unwrap();
    let level = model.system.elements()[0].law.contacts()[0].level;
    assert_relative_eq!(level, 0.98e-3, max_relative = 5e-3); // printed with two digits in the design
}

#[test]
fn a_cut_off_below_the_first_mode_is_refused_at_its_key() {
    assert_refused(
        paper_with("cut_off_hz = 1000.0", "cut_off_hz = 5.0"),
        &["the cut-off frequency is 5 Hz", "reduction.cut_off_hz", "allowed: more than 30.5"],
    );
}

#[test]
fn what_a_faulty_stop_hid_is_reported_with_it() {
    let vary = |parameter: &str| {
        format!("[[vary]]\nparameter = \"{parameter}\"\nrange = [1.0, 2.0]\nfrequency_hz = 30.0\n")
    };
    let text =
        PAPER.replacen("side = \"below\"", "", 1).replacen("cut_off_hz = 1000.0", "cut_off_hz = 5.0", 1);
    let wrong = ["stop.1.stifness", "stop.2.gap_m", "stop.gap_m"];
    let varied = wrong.into_iter().chain(["stop.1.stiffness_n_m15", "stop.1.gap_m", "stop.1.restitution"]);
    let text = varied.fold(text, |text, parameter| format!("{text}\n{}", vary(parameter)));
    let read = StudyFile::parse("study.toml", text).map_err(with_structure_fault);
    let Err(StudyError::Invalid(report)) = read else { panic!("{read:?}") };
    let found: Vec<&str> = report.problems.iter().map(|problem| problem.message.as_str()).collect();
    assert_eq!(found.len(), 5, "{found:#?}");
    assert!(found[0].contains("the cut-off frequency is 5 Hz"), "{found:#?}");
    assert!(found[1].contains("`side` is missing"), "{found:#?}");
    for (message, wrong) in found[2..].iter().zip(wrong) {
        assert!(message.contains(wrong), "{message}");
    }
}

#[test]
fn one_damping_ratio_per_mode_is_needed() {
    let ratios = |list: &str| paper_with("modal_ratio = 0.015", &format!("modal_ratio = {list}"));
    assert!(ratios("[0.01, 0.01, 0.01, 0.01, 0.01, 0.01]").is_ok());
    assert_refused(ratios("[0.01, 0.02]"), &["2 modal damping ratios", "damping.modal_ratio", "a list of 6"]);
}

#[test]
fn an_amplitude_beyond_the_length_of_the_beam_is_in_the_wrong_unit() {
    assert_refused(
        paper_with("amplitude_m = 0.5015e-3", "amplitude_m = 0.5015"),
        &["`amplitude_m` is 0.5015 m", "0.2579822 m, the length of the beam"],
    );
}

#[test]
fn a_stop_at_a_held_point_cannot_act() {
    assert_refused(paper_with("at = \"contact\"", "at = \"left\""), &["the stop cannot act", "stop[0]"]);
}

#[test]
fn rigid_stops_that_leave_no_room_are_refused() {
    let mass = "[structure]\nkind = \"lumped\"\nmass = [{ name = \"m\", mass_kg = 1.0 }]\n\
        [excitation]\nkind = \"force\"\nat = \"m\"\namplitude_n = 1.0\nfrequency_hz = [1.0, 2.0]\n";
    let stop = |law: &str, side: &str, gap: f64| {
        format!("[[stop]]\nat = \"m\"\n{law}\nside = \"{side}\"\ngap_m = {gap}\n")
    };
    let (rigid, soft) = ("law = \"rigid\"\nrestitution = 0.5", "law = \"linear\"\nstiffness_n_m = 9.0");
    let refused = build(&format!("{mass}{}", stop(rigid, "both", 0.0)));
    assert_refused(refused, &["its point cannot move", "\"stop 1 (above)\"", "stop[0]"]);
    let apart = [stop(rigid, "above", 0.0), stop(rigid, "below", 0.0)].concat();
    assert_refused(build(&format!("{mass}{apart}")), &["its point cannot move", "\"stop 1\"", "stop[1]"]);
    let vary = "[[vary]]\nparameter = \"stop.1.gap_m\"\nrange = [0.0, 1.0]\nfrequency_hz = 1.5\n";
    let to_none = format!("{mass}{}{vary}", stop(rigid, "both", 0.5));
    assert_refused(build(&to_none), &["its point cannot move", "vary[0]"]);
    let roomy = [stop(rigid, "above", 0.0), stop(rigid, "below", 1e-3)].concat();
    for stops in [roomy, stop(rigid, "both", 1e-9), stop(soft, "both", 0.0)] {
        assert!(build(&format!("{mass}{stops}")).is_ok(), "{stops}");
    }
}

#[test]
fn a_force_on_a_held_point_is_refused() {
    let load = "[[load]]\nkind = \"force\"\nat = \"left\"\namplitude_n = 1.0\norder = 2\n";
    assert_refused(build(&format!("{PAPER}\n{load}")), &["a force at \"left\" does nothing", "load[0].at"]);
}

#[test]
fn a_stop_on_a_support_that_stands_still_is_fixed_in_space() {
    let fixed_to = |name: &str| {
        let text = PAPER.replacen("right = \"free\"", "right = \"pinned\"", 1);
        build(&text.replacen("fixed_to = \"left\"", &format!("fixed_to = \"{name}\""), 1)).unwrap()
    };
    assert_eq!(fixed_to("right").system.elements(), fixed_to("space").system.elements());
    assert_ne!(fixed_to("left").system.elements(), fixed_to("space").system.elements());
}

/// Whatever is done to a study, the answer is a model or at least one fault, and never a panic.
#[test]
fn a_spoilt_study_always_has_a_fault() {
    let junk =
        ["", "-1", "0", "1e400", "99999999999999999999", "\"word\"", "[]", "[1, \"a\"]", "{}", "true", "nan"];
    for study in [PAPER, include_str!("../../../../studies/two-masses.toml")] {
        for line in study.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let key = line.split('=').next().unwrap();
            let spoilt = junk.map(|value| format!("{key}= {value}"));
            for new in spoilt.iter().map(String::as_str).chain([""]) {
                match build(&study.replacen(line, new, 1)) {
                    Err(StudyError::Invalid(report)) => assert!(!report.problems.is_empty(), "{new}"),
                    Err(other) => panic!("{other}"),
                    Ok(_) => {}
                }
            }
        }
    }
}

#[test]
fn a_lumped_structure_is_not_reduced() {
    let text = include_str!("../../../../studies/duffing.toml");
    let text = format!("{text}\n[reduction]\nmethod = \"free-interface\"\ncut_off_hz = 10.0\n");
    assert_refused(build(&text), &["a lumped structure is not reduced", "reduction.method"]);
}

#[test]
fn every_published_study_builds() {
    for text in [
        include_str!("../../../../studies/bilinear-oscillator.toml"),
        include_str!("../../../../studies/duffing.toml"),
        include_str!("../../../../studies/two-masses.toml"),
        include_str!("../../../../studies/beam-between-stops.toml"),
    ] {
        let model = build(text).unwrap_or_else(|error| panic!("{error}"));
        assert!(!model.system.elements().is_empty());
    }
}

/// A two-sided stop whose lower spring the sag has passed is the sum of two one-sided ones.
#[test]
fn a_two_sided_stop_pushed_past_one_spring_keeps_its_force() {
    let mut text = include_str!("../../../../studies/two-masses.toml").to_owned();
    text.push_str("\n[[load]]\nkind = \"force\"\nat = \"first\"\namplitude_n = -1.0\norder = 0\n");
    text.push_str("[[stop]]\nat = \"first\"\nlaw = \"two-sided\"\nstiffness_n_m = 10.0\ngap_m = 1e-9\n");
    text.push_str("gap_measured = \"at-rest\"\n");
    let model = build(&text).unwrap();
    let elements = &model.system.elements()[model.system.elements().len() - 2..];
    assert_eq!(elements[1].shape, elements[0].shape.iter().map(|entry| -entry).collect::<Vec<_>>());
    let levels: Vec<f64> = elements.iter().map(|element| element.law.contacts()[0].level).collect();
    assert_relative_eq!(levels[0] + levels[1], 2e-9, max_relative = 1e-6);
    assert!(levels[0] < 0.0 && levels[1] > 0.0);
}

/// A free-free beam, the gap of whose left end is a parameter of the test.
fn floating(stops: &str) -> Model {
    let text = format!(
        "[structure]\nkind = \"beam\"\nlength_m = 0.6\nelements = 6\nsection = \
        {{ width_m = 0.02, height_m = 0.003 }}\n\
         youngs_modulus_pa = 7.0e10\ndensity_kg_m3 = 2700.0\nleft = \"free\"\nright = \"free\"\n\
         [[structure.point]]\nname = \"middle\"\nat_m = 0.3\n[reduction]\nmethod \
         = \"none\"\n[damping]\nmodal_ratio = 0.02\n\
         [excitation]\nkind = \"force\"\nat = \"middle\"\namplitude_n = 0.3\nfrequency_hz = [5.0, \
         60.0]\n{stops}"
    );
    build(&text).unwrap()
}

const HELD_LEFT: &str = "[[stop]]\nat = \"left\"\nlaw = \"two-sided\"\nstiffness_n_m = 2.0e3\ngap_m = \
0.0\nfixed_to = \"space\"\n";

/// Displacement of a point in a drift, relative to the largest.
fn moved(drift: &Drift, name: &str) -> f64 {
    drift.motion.iter().find(|(point, _)| point == name).map_or(0.0, |(_, size)| *size)
}

#[test]
fn a_beam_held_at_one_end_turns_about_it() {
    let drifts = floating(HELD_LEFT).drifts();
    assert_eq!(drifts.len(), 1);
    assert!(!drifts[0].held_by_stops);
    for (name, expected) in [("left", 0.0), ("middle", 0.5), ("right", 1.0)] {
        assert_relative_eq!(moved(&drifts[0], name), expected, epsilon = 1e-6);
    }
}

#[test]
fn a_stop_that_can_open_holds_a_drift_while_it_is_closed() {
    let below = "[[stop]]\nat = \"right\"\nlaw = \"linear\"\nstiffness_n_m = 2.0e3\ngap_m = 1e-3\nside \
    = \"below\"\nfixed_to = \"space\"\n";
    let drifts = floating(&format!("{HELD_LEFT}{below}")).drifts();
    assert_eq!(drifts.len(), 1);
    assert!(drifts[0].held_by_stops && (moved(&drifts[0], "right") - 1.0).abs() < 1e-12);
    let both = floating(below).drifts();
    assert_eq!(both.iter().map(|drift| drift.held_by_stops).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn a_structure_on_springs_does_not_drift() {
    assert_eq!(build(PAPER).unwrap().drifts(), []);
    let right = HELD_LEFT.replace("\"left\"", "\"right\"");
    assert_eq!(floating(&format!("{HELD_LEFT}{right}")).drifts(), []);
}
