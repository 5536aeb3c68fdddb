//! Laws of stops, as they are read and refused.

use hammerbeam_motion::{
    Law, LawConstant,
    law::{LawIdentity, LawRest, LawSides, LawValues, RestitutionModel},
};

use super::*;

/// The paper's stop with another law.
fn law_with(keys: &str) -> Result<Study, String> {
    paper_with("law = \"hertz\"", keys)
}

#[test]
fn laws_that_lose_energy_are_read() {
    let read = |keys: &str| law_with(keys).unwrap().stops[0].law.clone();
    let damped = read("law = \"hunt-crossley\"\nloss_s_m = 0.25");
    assert_eq!(damped.description().identity, LawIdentity::Named("hunt-crossley"));
    assert_eq!(damped.number("loss_s_m"), Some(0.25));
    for (word, expected) in [
        ("hunt-crossley", RestitutionModel::HuntCrossley),
        ("herbert-mcwhannell", RestitutionModel::HerbertMcWhannell),
        ("lee-wang", RestitutionModel::LeeWang),
        ("lankarani-nikravesh", RestitutionModel::LankaraniNikravesh),
        ("gonthier", RestitutionModel::Gonthier),
        ("flores", RestitutionModel::Flores),
        ("hu-guo", RestitutionModel::HuGuo),
    ] {
        let law = read(&format!("law = \"{word}\"\nrestitution = 0.7"));
        assert_eq!(law.description().identity, LawIdentity::Model { family: "restitution", model: word });
        let LawSides::One { build, .. } = law.description().sides else { panic!("{word} is not one-sided") };
        let built = build(LawValues(law.values()), LawRest::Level(0.0)).unwrap();
        let Law::Restitution(stop) = &built[0].law else {
            panic!("{word} is no law with a coefficient of restitution")
        };
        let restitution = built[0].law.constant(LawConstant::Restitution);
        assert_eq!((stop.model(), restitution), (expected, Some(0.7)));
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
    let linear = damped("3.0").unwrap().stops[0].law.clone();
    assert_eq!((linear.description().name, linear.number("damping_n_s_m")), ("linear", Some(3.0)));
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
        let law = &study.stops[0].law;
        assert_eq!((law.description().name, law.number("restitution")), ("rigid", Some(e)));
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

#[test]
fn a_stop_of_two_slopes_is_read_and_refuses_what_it_cannot_be() {
    let two_slopes = |keys: &str| {
        let keys = format!("law = \"two-slopes\"\nstiffness_n_m = 1e5\n{keys}");
        parse(&PAPER.replace("law = \"hertz\"\n", "").replace("stiffness_n_m15 = 4.5e9", &keys))
    };
    let study = two_slopes("second_gap_m = 1e-4\nsecond_stiffness_n_m = 4e5").unwrap();
    let law = &study.stops[0].law;
    let numbers = ["stiffness_n_m", "second_gap_m", "second_stiffness_n_m"].map(|key| law.number(key));
    assert_eq!(numbers, [Some(1e5), Some(1e-4), Some(4e5)]);
    assert_eq!(law.gap_m(), Some(0.0));
    let canonical = study.canonical();
    for line in ["second_gap_m = 0.0001", "second_stiffness_n_m = 400000.0", "stiffness_n_m = 100000.0"] {
        assert!(canonical.contains(&format!("stops[0].law.two-slopes.{line}")), "{canonical}");
    }
    let refused = |keys: &str, words: &[&str]| assert_refused(two_slopes(keys), words);
    refused("second_stiffness_n_m = 4e5", &["`second_gap_m` is missing"]);
    refused("second_gap_m = 1e-4", &["`second_stiffness_n_m` is missing"]);
    refused(
        "second_gap_m = 0.0\nsecond_stiffness_n_m = 1.0",
        &["`second_gap_m` is 0 m", "more than 0 to 1e6 m"],
    );
    refused(
        "second_gap_m = 1.0\nsecond_stiffness_n_m = -1.0",
        &["`second_stiffness_n_m`", "-1", "more than 0"],
    );
}

/// What the identity of a study had of each law before they were described in one place, written down from
/// the fields of that time: folders of results go on.
#[test]
fn the_identity_of_each_law_is_what_it_was() {
    let identity = |keys: &str| {
        let text = PAPER.replace("law = \"hertz\"\n", "").replace("stiffness_n_m15 = 4.5e9", keys);
        let stops =
            |text: &str| serde_json::to_value(&parse(text).unwrap().stops[0].law).unwrap().to_string();
        stops(&text)
    };
    let one_sided = r#""approach":{"gap":{"gap_m":0.0,"measured":"undeformed"}}"#;
    for (keys, name, before, after) in [
        ("law = \"hertz\"\nstiffness_n_m15 = 2.5", "hertz", "", r#""stiffness":{"given":2.5}"#),
        (
            "law = \"linear\"\nstiffness_n_m = 2.5\ndamping_n_s_m = 0.5",
            "linear",
            r#","damping_n_s_m":0.5"#,
            r#""stiffness_n_m":2.5"#,
        ),
        (
            "law = \"hunt-crossley\"\nstiffness_n_m15 = 2.5\nloss_s_m = 0.0",
            "hunt-crossley",
            r#","loss_s_m":0.0"#,
            r#""stiffness":{"given":2.5}"#,
        ),
        (
            "law = \"flores\"\nstiffness_n_m15 = 2.5\nrestitution = 0.5",
            "restitution",
            r#","model":"flores","restitution":0.5"#,
            r#""stiffness":{"given":2.5}"#,
        ),
        ("law = \"rigid\"\nrestitution = 0.5", "rigid", r#","restitution":0.5"#, ""),
    ] {
        let after = if after.is_empty() { String::new() } else { format!(",{after}") };
        let expected = format!(r#"{{"{name}":{{{one_sided}{before},"side":"below"{after}}}}}"#);
        assert_eq!(identity(keys), expected, "{name}");
    }
    let without = PAPER.replace("side = \"below\"\n", "").replace("gap_m = 0.0\n", "");
    let always = |keys: &str| {
        let text = without.replace("law = \"hertz\"\n", "").replace("stiffness_n_m15 = 4.5e9", keys);
        serde_json::to_value(&parse(&text).unwrap().stops[0].law).unwrap().to_string()
    };
    assert_eq!(
        always("law = \"cubic\"\nstiffness_n_m = -2.5\nstiffness_n_m3 = 4.5"),
        r#"{"cubic":{"stiffness_n_m":-2.5,"stiffness_n_m3":4.5}}"#
    );
    let gaps = r#""gap_above_m":0.5,"gap_below_m":0.0,"gap_measured":"undeformed""#;
    assert_eq!(
        always("law = \"two-sided\"\nstiffness_n_m = 2.5\ngap_above_m = 0.5"),
        format!(r#"{{"two-sided":{{{gaps},"stiffness_n_m":2.5}}}}"#)
    );
    assert_eq!(
        always("law = \"formula\"\nformula = \"k*x\"\nconstants = { k = 2.5 }"),
        r#"{"formula":{"constants":{"k":2.5},"formula":"k*x"}}"#
    );
}
