//! Spans, sections, supports and shear of beams.

use super::*;
use crate::Model;

/// A tube on three supports with a thinner end.
const TUBE: &str = r#"
[structure]
kind = "beam"
elements = 30
section = { outer_diameter_m = 0.025, wall_m = 0.002 }
youngs_modulus_pa = 2.1e11
density_kg_m3 = 7800.0
added_mass_kg_m = 0.35
left = "clamped"
right = "free"
[[structure.span]]
length_m = 0.5
[[structure.span]]
length_m = 0.3
section = { outer_diameter_m = 0.012 }
added_mass_kg_m = 0.0
[[structure.point]]
name = "bearing"
at_m = 0.4
support = "pinned"
[[structure.point]]
name = "tip"
at_m = 0.8
[reduction]
method = "free-interface"
cut_off_hz = 2000.0
[excitation]
kind = "force"
at = "tip"
amplitude_n = 1.0
frequency_hz = [10.0, 100.0]
"#;

fn tube_with(old: &str, new: &str) -> Result<Study, String> {
    assert!(TUBE.contains(old), "{old} is not in the study");
    parse(&TUBE.replacen(old, new, 1))
}

fn beam(study: &Study) -> &BeamTable {
    let StructureTable::Beam(beam) = &study.structure else { panic!("not a beam") };
    beam
}

#[test]
fn spans_take_from_the_structure_what_they_do_not_say() {
    let study = parse(TUBE).unwrap();
    let beam = beam(&study);
    assert_eq!((beam.length_m, beam.spans.len(), beam.borders_m()), (0.8, 2, vec![0.5]));
    let [first, second] = beam.spans[..] else { panic!("two spans") };
    let pi = std::f64::consts::PI;
    let area = pi / 4.0 * (0.025_f64.powi(2) - 0.021_f64.powi(2));
    assert!((first.profile.section.area_m2 / area - 1.0).abs() < 1e-14);
    assert!((second.profile.section.area_m2 / (pi / 4.0 * 0.012_f64.powi(2)) - 1.0).abs() < 1e-14);
    assert_eq!((first.profile.added_mass_kg_m, second.profile.added_mass_kg_m), (0.35, 0.0));
    assert_eq!(second.profile.youngs_modulus_pa, 2.1e11);
    assert_eq!((beam.points[0].support, beam.points[1].support), (EndSupport::Pinned, EndSupport::Free));
    Model::build(&StudyFile::parse("tube.toml", TUBE.to_owned()).unwrap()).unwrap();
}

#[test]
fn one_span_and_a_beam_without_spans_are_the_same_study() {
    let plain = parse(PAPER).unwrap();
    assert!(
        plain.canonical().contains("structure.beam.section.area_m2 = 0.0000596\n"),
        "{}",
        plain.canonical()
    );
    let length = "length_m = 0.2579822 ";
    let of_span = PAPER.replacen(length, "# ", 1).replacen(
        "[[structure.point]]",
        "[[structure.span]]\nlength_m = 0.2579822\n[[structure.point]]",
        1,
    );
    assert_eq!(parse(&of_span).unwrap().identity(), plain.identity());
    for added in ["theory = \"euler-bernoulli\"", "added_mass_kg_m = 0"] {
        let written_out = format!("kind = \"beam\"\n{added}");
        assert_eq!(paper_with("kind = \"beam\"", &written_out).unwrap().identity(), plain.identity());
    }
}

#[test]
fn what_the_frequencies_depend_on_is_part_of_the_identity() {
    let identity = parse(TUBE).unwrap().identity();
    for (old, new) in [
        ("length_m = 0.3", "length_m = 0.31"),
        ("0.002 }", "0.0021 }"),
        ("\"pinned\"", "\"clamped\""),
        ("= 0.35", "= 0.36"),
        ("kind = \"beam\"", "kind = \"beam\"\ntheory = \"timoshenko\"\npoisson_ratio = 0.3"),
    ] {
        assert_ne!(tube_with(old, new).unwrap().identity(), identity, "{new}");
    }
}

#[test]
fn faults_of_spans_and_sections_stand_at_their_keys() {
    assert_refused(
        tube_with("length_m = 0.5", ""),
        &["`length_m` is missing in [structure.span[0]]", "study.toml:11"],
    );
    assert_refused(
        tube_with("elements = 30", "elements = 30\nlength_m = 0.8"),
        &["`length_m` is given for a beam of several spans", "study.toml:5"],
    );
    assert_refused(
        tube_with("youngs_modulus_pa = 2.1e11\n", ""),
        &["`youngs_modulus_pa` is missing in [structure.span[0]]", "[structure.span[1]]"],
    );
    assert_refused(
        tube_with("wall_m = 0.002", "wall_m = 0.0125"),
        &["`wall_m` is 0.0125 m", "less than 0.0125 m, half of the diameter", "study.toml:5"],
    );
    assert_refused(
        tube_with("{ outer_diameter_m = 0.012 }", "{ outer_diameter_m = 0.012, width_m = 0.01 }"),
        &["`section` is a mix of the accepted forms", "a tube"],
    );
    assert_refused(
        tube_with("{ outer_diameter_m = 0.012 }", "{ outer_diameter_m = 12 }"),
        &["`outer_diameter_m` is 12 m", "it looks like millimetres"],
    );
    assert_refused(
        tube_with("\"pinned\"", "\"pined\""),
        &["`support` is \"pined\"", "did you mean \"pinned\"?"],
    );
    assert_refused(
        tube_with("at_m = 0.4", "at_m = 0.50001"),
        &["points \"end of span 1\" and \"bearing\" are"],
    );
    let held = TUBE.replacen("at = \"tip\"", "at = \"bearing\"", 1);
    let fault = Model::build(&StudyFile::parse("tube.toml", held).unwrap()).unwrap_err().to_string();
    assert!(fault.contains("a force at \"bearing\" does nothing"), "{fault}");
}

#[test]
fn shear_needs_the_poisson_ratio_and_a_form_or_its_coefficient() {
    let thick = |added: &str| tube_with("kind = \"beam\"", &format!("kind = \"beam\"\n{added}"));
    let study = thick("theory = \"timoshenko\"\npoisson_ratio = 0.3").unwrap();
    // A tube with a bore of 0.84: between a thin tube's 0.531 and a circle's 0.886.
    let coefficients: Vec<f64> =
        beam(&study).spans.iter().map(|span| span.profile.section.shear_coefficient.unwrap()).collect();
    assert!(coefficients[0] > 0.531 && coefficients[0] < 0.55, "{coefficients:?}");
    assert!((coefficients[1] - 7.8 / 8.8).abs() < 1e-12, "{coefficients:?}");
    assert_refused(thick("theory = \"timoshenko\""), &["`poisson_ratio` is missing in [structure.span[0]]"]);
    assert_refused(
        thick("poisson_ratio = 0.3"),
        &["`poisson_ratio` is given for a beam without shear", "theory = \"timoshenko\""],
    );
    let general = |coefficient: &str| {
        let text = TUBE.replacen(
            "kind = \"beam\"",
            "kind = \"beam\"\ntheory = \"timoshenko\"\npoisson_ratio = 0.3",
            1,
        );
        let section = format!("{{ area_m2 = 1e-4, second_moment_m4 = 1e-9{coefficient} }}");
        parse(&text.replacen("{ outer_diameter_m = 0.012 }", &section, 1))
    };
    assert_refused(general(""), &["`shear_coefficient` is missing in [structure.span[1].section]"]);
    assert_refused(general(", shear_coefficient = 85"), &["`shear_coefficient` is 85", "0.01 to 1"]);
    let study = general(", shear_coefficient = 0.85").unwrap();
    assert_eq!(beam(&study).spans[1].profile.section.shear_coefficient, Some(0.85));
    assert_refused(
        thick("theory = \"bernoulli\""),
        &["`theory` is \"bernoulli\"", "euler-bernoulli, timoshenko"],
    );
}

/// Lengths of spans and walls are numbers of the model, with their units.
#[test]
fn spans_and_tubes_take_quantities_and_are_numbers() {
    let text = TUBE
        .replace("wall_m = 0.002", "wall = \"2 mm\"")
        .replace("added_mass_kg_m = 0.35", "added_mass = \"0.35 kg/m\"");
    assert_eq!(parse(&text).unwrap().identity(), parse(TUBE).unwrap().identity());
    let value = |key: &str| crate::number::number_named(&text, key).unwrap().map(|number| number.value);
    assert_eq!(value("structure.span.2.length_m"), Some(0.3));
    assert_eq!(value("structure.section.wall_m"), Some(0.002));
    assert_eq!(value("structure.added_mass_kg_m"), Some(0.35));
}
