//! Forces on several points, pairs, unbalance, tables and accelerations, and what is wrong with them.

use super::*;
use crate::Model;

const FORCES: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }, { name = "b", mass_kg = 2.0 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 100.0 },
    { between = ["a", "b"], stiffness_n_m = 100.0 },
]
[excitation]
kind = "force"
frequency_hz = [1.0, 2.0]
[[excitation.force]]
at = "a"
amplitude_n = 1.0
[[excitation.force]]
between = ["a", "b"]
amplitude = "2 mN"
phase = "90 deg"
[[excitation.force]]
at = "b"
unbalance_mass = "5 g"
eccentricity = "2 mm"
[[load]]
kind = "force"
at = "b"
amplitude_n = [[0.5, 1.0], [2.5, 2.0]]
order = 2
"#;

const SHAKEN: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }]
spring = [{ between = ["a", "ground"], stiffness_n_m = 100.0 }]
[excitation]
kind = "support-motion"
at = "ground"
amplitude_m_s2 = 3.0
frequency_hz = [1.0, 2.0]
[[load]]
kind = "support-motion"
amplitude_m = 1e-3
order = 2
"#;

fn with(study: &str, old: &str, new: &str) -> Result<Study, String> {
    assert!(study.contains(old), "{old} is not in the study");
    let file =
        StudyFile::parse("study.toml", study.replacen(old, new, 1)).map_err(|error| error.to_string())?;
    Model::build(&file).map_err(|error| error.to_string())?;
    Ok(file.study)
}

#[test]
fn forces_have_places_sizes_and_phases_of_their_own() {
    let study = with(FORCES, "[structure]", "[structure]").unwrap();
    let Some(ExcitationKind::Forces { forces }) = study.excitation.harmonic().map(|h| &h.kind) else {
        panic!("no forces")
    };
    assert_eq!(forces[0].place, ForcePlace::At("a".into()));
    assert_eq!(forces[1].place, ForcePlace::Between(["a".into(), "b".into()]));
    assert_eq!((forces[1].size.constant(), forces[1].phase_rad), (Some(0.002), std::f64::consts::FRAC_PI_2));
    assert_eq!(forces[2].size, ForceSize::Unbalance { mass_kg: 0.005, eccentricity_m: 0.002 });
    assert_eq!(study.force_points().collect::<Vec<_>>(), ["a", "a", "b", "b", "b"]);
    assert!(matches!(&study.loads[0], LoadTable::ActingForce { order: 2, .. }));
}

/// What was a study before is the same study still.
#[test]
fn one_force_with_an_amplitude_is_what_it_was() {
    let canonical = parse(LUMPED).unwrap().canonical();
    for line in ["excitation.kind.force.at = \"b\"", "excitation.kind.force.amplitude_n = 1.0"] {
        assert!(canonical.lines().any(|written| written == line), "{line} is not in\n{canonical}");
    }
    let constant = "[[load]]\nkind = \"force\"\nat = \"a\"\namplitude_n = -2.0\norder = 0\n";
    let study = parse(&format!("{LUMPED}{constant}")).unwrap();
    assert!(matches!(study.loads[0], LoadTable::Force { amplitude_n: -2.0, order: 0, .. }));
}

#[test]
fn faults_of_forces_stand_at_their_keys() {
    assert_refused(
        with(FORCES, "at = \"a\"\n", "at = \"a\"\nbetween = [\"a\", \"b\"]\n"),
        &["`between` is given, and `at`, too", "excitation.force[0].between"],
    );
    assert_refused(with(FORCES, "[\"a\", \"b\"]\namp", "[\"a\", \"a\"]\namp"), &["names \"a\" twice"]);
    assert_refused(
        with(FORCES, "kind = \"force\"\nfreq", "kind = \"force\"\nphase_rad = 1.0\nfreq"),
        &["`phase_rad` is given besides `force`"],
    );
    assert_refused(
        with(FORCES, "eccentricity = \"2 mm\"\n", ""),
        &["`eccentricity_m` is missing in [excitation.force[2]]"],
    );
    assert_refused(
        with(FORCES, "eccentricity = \"2 mm\"\n", "eccentricity = \"2 mm\"\namplitude_n = 1\n"),
        &["`amplitude_n` is given for an unbalance"],
    );
    assert_refused(
        with(FORCES, "eccentricity = \"2 mm\"", "eccentricity = \"2 mN\""),
        &["`eccentricity` has to be a number with a unit that fits m"],
    );
    assert_refused(
        with(FORCES, "[[0.5, 1.0]", "[[1.5, 1.0]"),
        &["`amplitude_n` is given from 1.5 to 2.5 Hz", "a table that covers `frequency_hz`", "load[0]"],
    );
    assert_refused(
        with(FORCES, "order = 2", "order = 0"),
        &["the amplitude of a constant depends on the frequency"],
    );
    assert_refused(with(FORCES, "amplitude_n = 1.0", "amplitude_n = -1.0"), &["`amplitude_n` is -1 N"]);
}

#[test]
fn acceleration_stands_in_place_of_displacement() {
    let study = with(SHAKEN, "= 3.0", "= 3.0").unwrap();
    let harmonic = study.excitation.harmonic().unwrap();
    assert!(matches!(&harmonic.kind, ExcitationKind::SupportAcceleration { .. }));
    assert_eq!(harmonic.amplitude(), Some(&Amplitude::Constant(3.0)));
    assert_eq!(study.excitation.moving_places(), ["ground"]);
    assert!(matches!(study.loads[0], LoadTable::SupportMotion { order: 2, .. }));
    let of_load = with(SHAKEN, "amplitude_m = 1e-3", "amplitude = \"0.2 m/s^2\"").unwrap();
    assert!(matches!(
        &of_load.loads[0],
        LoadTable::DrivenSupport { motion: SupportDrive::Acceleration(_), .. }
    ));
    assert_refused(
        with(SHAKEN, "= 3.0", "= 3.0\namplitude_m = 1e-3"),
        &["`amplitude_m_s2` is given, and `amplitude_m`, too"],
    );
    assert_refused(with(SHAKEN, "= 3.0", "= -3.0"), &["`amplitude_m_s2` is -3 m/s^2"]);
    assert_refused(
        with(SHAKEN, "= 3.0", "= [[1.2, 3.0], [2.0, 4.0]]"),
        &["`amplitude_m_s2` is given from 1.2 to 2 Hz"],
    );
}

/// The level of the acceleration varies like an amplitude, and those of forces by their key paths.
#[test]
fn sizes_vary() {
    let vary = |key: &str, range: &str| {
        format!("[[vary]]\nparameter = \"{key}\"\nrange = {range}\nfrequency_hz = 1.5\n")
    };
    let shaken = SHAKEN.split("[[load]]").next().unwrap();
    let study = format!("{shaken}{}", vary("excitation.amplitude_m_s2", "[1.0, 5.0]"));
    let file = StudyFile::parse("study.toml", study).unwrap();
    let model = Model::build(&file).unwrap();
    let parameter = model.parameter(&file.study, &file.study.varies[0].parameter).unwrap();
    assert_eq!(parameter.in_study(1.0), 3.0);
    for (key, range) in [
        ("excitation.force.1.amplitude_n", "[0.5, 2.0]"),
        ("excitation.force.3.eccentricity_m", "[1e-3, 1e-2]"),
    ] {
        let file = StudyFile::parse("study.toml", format!("{FORCES}{}", vary(key, range))).unwrap();
        Model::build(&file).unwrap();
    }
}
