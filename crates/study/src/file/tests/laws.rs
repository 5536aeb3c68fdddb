//! Laws of stops, as they are read and refused.

use super::*;

/// The paper's stop with another law.
fn law_with(keys: &str) -> Result<Study, String> {
    paper_with("law = \"hertz\"", keys)
}

#[test]
fn laws_that_lose_energy_are_read() {
    let read = |keys: &str| law_with(keys).unwrap().stops[0].law.clone();
    let StopLaw::HuntCrossley { loss_s_m, .. } = read("law = \"hunt-crossley\"\nloss_s_m = 0.25") else {
        panic!("not the law of Hunt and Crossley")
    };
    assert_eq!(loss_s_m, 0.25);
    for (word, expected) in [
        ("hunt-crossley", ImpactModel::HuntCrossley),
        ("herbert-mcwhannell", ImpactModel::HerbertMcwhannell),
        ("lee-wang", ImpactModel::LeeWang),
        ("lankarani-nikravesh", ImpactModel::LankaraniNikravesh),
        ("gonthier", ImpactModel::Gonthier),
        ("flores", ImpactModel::Flores),
        ("hu-guo", ImpactModel::HuGuo),
    ] {
        let StopLaw::Restitution { model, restitution, .. } =
            read(&format!("law = \"{word}\"\nrestitution = 0.7"))
        else {
            panic!("{word} is no law with a coefficient of restitution")
        };
        assert_eq!((model, restitution), (expected, 0.7));
    }
}

/// Keys of a law that is missing or misspelt are not called unknown.
#[test]
fn a_stop_without_a_law_is_one_fault() {
    for (law, fault) in [("", "`law` is missing"), ("law = \"herz\"", "did you mean \"hertz\"?")] {
        let message = law_with(law).unwrap_err();
        assert!(message.contains(fault) && !message.contains("unknown key"), "{message}");
    }
}

#[test]
fn laws_that_lose_energy_refuse_what_they_cannot_be() {
    let refused = |keys: &str, words: &[&str]| assert_refused(law_with(keys), words);
    refused("law = \"hunt-crossley\"", &["`loss_s_m` is missing", "`restitution`"]);
    refused("law = \"hunt-crossley\"\nloss_s_m = -1.0", &["`loss_s_m`", "-1", "allowed: 0 to"]);
    refused(
        "law = \"hunt-crossley\"\nloss_s_m = 0.1\nrestitution = 0.9",
        &["`loss_s_m` is given besides `restitution`"],
    );
    refused("law = \"flores\"", &["`restitution` is missing"]);
    for e in ["0.0", "-0.1", "1.01", "70"] {
        refused(&format!("law = \"flores\"\nrestitution = {e}"), &["`restitution`", "to 1"]);
    }
    refused("law = \"hertz\"\nrestitution = 0.9", &["unknown key `restitution`"]);
    refused("law = \"lankarani\"", &["lankarani", "lankarani-nikravesh"]);
    let preloaded = PAPER
        .replace("law = \"hertz\"", "law = \"gonthier\"\nrestitution = 0.9")
        .replace("gap_m = 0.0", "preload_n = 2.0");
    assert_refused(parse(&preloaded), &["`preload_n` is given, but the law needs the speed of each impact"]);
    let damped = |damping: &str| {
        let linear = PAPER
            .replace("law = \"hertz\"", "law = \"linear\"")
            .replace("stiffness_n_m15 = 4.5e9", &format!("stiffness_n_m = 1e5\ndamping_n_s_m = {damping}"));
        parse(&linear)
    };
    assert!(matches!(damped("3.0").unwrap().stops[0].law, StopLaw::Linear { damping_n_s_m: 3.0, .. }));
    assert_refused(damped("-3.0"), &["`damping_n_s_m`", "-3", "allowed: 0 to"]);
}

/// A damper of 0 N s/m, written out or not, is the same study.
#[test]
fn a_linear_stop_without_a_damper_is_the_study_it_was() {
    let linear = |damping: &str| {
        let text = PAPER
            .replace("law = \"hertz\"", "law = \"linear\"")
            .replace("stiffness_n_m15 = 4.5e9", &format!("stiffness_n_m = 1e5\n{damping}"));
        serde_json::to_string(&parse(&text).unwrap().stops).unwrap()
    };
    assert_eq!(linear(""), linear("damping_n_s_m = 0.0"));
    assert!(!linear("").contains("damping"));
}

#[test]
fn a_rigid_stop_is_read_and_refuses_what_it_cannot_be() {
    let rigid =
        |keys: &str| parse(&PAPER.replace("law = \"hertz\"\n", "").replace("stiffness_n_m15 = 4.5e9", keys));
    for e in [0.0, 0.8, 1.0] {
        let study = rigid(&format!("law = \"rigid\"\nrestitution = {e:.1}")).unwrap();
        let StopLaw::Rigid { restitution, .. } = study.stops[0].law else { panic!("not rigid") };
        assert_eq!(restitution, e);
    }
    let refused = |keys: &str, words: &[&str]| assert_refused(rigid(keys), words);
    refused("law = \"rigid\"", &["`restitution` is missing"]);
    for e in ["-0.1", "1.01", "80"] {
        refused(&format!("law = \"rigid\"\nrestitution = {e}"), &["`restitution`", "allowed: 0 to 1"]);
    }
    refused("law = \"rigid\"\nrestitution = \"high\"", &["`restitution`"]);
    refused(
        "law = \"rigid\"\nrestitution = 0.8\nstiffness_n_m15 = 4.5e9",
        &["unknown key `stiffness_n_m15`"],
    );
    // What is offered is what a rigid stop takes: no preload.
    for law in ["rigid", "flores"] {
        let study =
            PAPER.replace("law = \"hertz\"", &format!("law = \"{law}\"\nrestitution = 0.9\nspeed = 1.0"));
        let report = parse(&study).unwrap_err();
        assert!(report.contains("known keys: ") && report.contains("gap_m"), "{report}");
        assert!(!report.contains("preload_n"), "{report}");
    }
    let preloaded = PAPER
        .replace("law = \"hertz\"", "law = \"rigid\"\nrestitution = 0.9")
        .replace("stiffness_n_m15 = 4.5e9", "")
        .replace("gap_m = 0.0", "preload_n = 2.0");
    assert_refused(
        parse(&preloaded),
        &["`preload_n` is given, but a rigid stop has no stiffness to press with"],
    );
}
