mod beams;
mod laws;
mod loads;

use super::*;

/// The example of the design.
const PAPER: &str = include_str!("../../../../studies/beam-with-stop.toml");

const LUMPED: &str = r#"
[structure]
kind = "lumped"
[[structure.mass]]
name = "a"
mass_kg = 1.0
[[structure.mass]]
name = "b"
mass_kg = 2.0
[[structure.spring]]
between = ["a", "ground"]
stiffness_n_m = 100.0
[[structure.damper]]
between = ["a", "b"]
damping_n_s_m = 0.5
[excitation]
kind = "force"
at = "b"
amplitude_n = 1.0
frequency_hz = [1.0, 2.0]
"#;

fn parse(text: &str) -> Result<Study, String> {
    StudyFile::parse("study.toml", text.to_owned()).map(|file| file.study).map_err(|error| error.to_string())
}

/// The paper's study with one piece of text replaced.
fn paper_with(old: &str, new: &str) -> Result<Study, String> {
    assert!(PAPER.contains(old), "{old} is not in the study");
    parse(&PAPER.replacen(old, new, 1))
}

#[track_caller]
fn assert_refused(study: Result<Study, String>, parts: &[&str]) {
    let message = study.unwrap_err();
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in:\n{message}");
    }
}

#[test]
fn the_paper_is_read_as_it_is_written() {
    let study = parse(PAPER).unwrap();
    let StructureTable::Beam(beam) = &study.structure else { panic!("not a beam") };
    assert_eq!(
        (beam.length_m, beam.elements, beam.left, beam.right),
        (0.2579822, 44, EndSupport::Clamped, EndSupport::Free)
    );
    assert_eq!(beam.spans[0].profile.section.area_m2, 0.0298 * 0.0020);
    assert_eq!((beam.points[0].at_m, beam.points[0].mass_kg), (0.2432157, 0.03756));
    assert_eq!(study.damping, DampingTable::Modal(ModalRatio::Every(0.015)));
    assert_eq!(study.excitation.range_hz(), [19.0, 110.0]);
    assert_eq!(study.excitation.moving_places(), ["left"]);
    let place = Place::At { point: "contact".into(), fixed_to: FixedTo::Support(0) };
    assert_eq!(study.stops[0].place, place);
    assert_eq!(
        study.response,
        ResponseTable { point: "contact".into(), period_multiples: vec![1, 2, 3], period_doubling_depth: 0 }
    );
}

#[test]
fn what_is_not_said_has_its_default() {
    let study = parse(LUMPED).unwrap();
    assert_eq!(study.reduction.method, ReductionMethod::None);
    assert_eq!(study.damping, DampingTable::Modal(ModalRatio::Every(0.0)));
    assert_eq!(
        study.excitation.harmonic().map(|harmonic| (harmonic.order, harmonic.phase_rad)),
        Some((1, 0.0))
    );
    assert_eq!(
        study.response,
        ResponseTable { point: "a".into(), period_multiples: vec![1], period_doubling_depth: 0 }
    );
    assert_eq!(study.continuation.max_step_hz, 0.0002);
    assert_eq!(study.continuation.segments, SegmentChoice::Auto);
}

#[test]
fn an_unknown_key_is_refused_with_the_closest_known_one() {
    assert_refused(
        paper_with("elements = 44", "elemnts = 44"),
        &[
            "unknown key `elemnts` in [structure]",
            "study.toml:13:1",
            "did you mean `elements`?",
            "`elements` is missing",
        ],
    );
}

#[test]
fn unknown_tables_and_keys_in_every_table_are_refused() {
    let added = |place: &str| paper_with(place, &format!("{place}\nwrong_key = 1"));
    for place in [
        "[structure]",
        "[[structure.point]]",
        "[reduction]",
        "[damping]",
        "[excitation]",
        "[[stop]]",
        "[response]",
    ] {
        assert_refused(added(place), &["unknown key `wrong_key`"]);
    }
    assert_refused(
        paper_with("[damping]", "[dampingg]"),
        &["unknown key `dampingg`", "did you mean `damping`?"],
    );
}

#[test]
fn a_missing_key_is_named_with_its_table() {
    assert_refused(
        paper_with("density_kg_m3 = 7800.0", ""),
        &["`density_kg_m3` is missing in [structure]", "[structure]"],
    );
    assert_refused(paper_with("side = \"below\"", ""), &["`side` is missing in [stop[0]]"]);
    // Nothing has to shake a structure: what is let go vibrates freely.
    assert_refused(parse(""), &["`structure` is missing"]);
    let free = parse(LUMPED.split("[excitation]").next().unwrap()).unwrap();
    assert_eq!((&free.excitation, free.excitation.range_hz()), (&Excitation::None, [0.0, 0.0]));
    assert!(!free.canonical().contains("excitation."));
}

#[test]
fn a_wrong_type_says_what_was_found_and_what_is_needed() {
    assert_refused(
        paper_with("elements = 44", "elements = \"many\""),
        &["`elements` must be a whole number, found the string \"many\"", "structure.elements"],
    );
    assert_refused(paper_with("elements = 44", "elements = 44.5"), &["found the number 44.5"]);
    assert_refused(
        paper_with("length_m = 0.2579822", "length_m = true"),
        &["must be a number, found the boolean true"],
    );
    assert_refused(
        paper_with("frequency_hz = [19.0, 110.0]", "frequency_hz = 19.0"),
        &["must be a list of 2 numbers"],
    );
}

#[test]
fn numbers_that_are_not_finite_are_refused_everywhere() {
    for number in ["nan", "inf", "-inf", "1e999"] {
        for key in ["density_kg_m3 = 7800.0", "modal_ratio = 0.015", "gap_m = 0.0", "cut_off_hz = 1000.0"] {
            let name = key.split(' ').next().unwrap();
            let study = paper_with(key, &format!("{name} = {number}"));
            assert_refused(study, &[&format!("`{name}` is"), "numbers must be finite"]);
        }
    }
}

#[test]
fn negative_numbers_are_refused_where_they_make_no_sense() {
    for key in [
        "length_m = 0.2579822",
        "density_kg_m3 = 7800.0",
        "mass_kg = 0.03756",
        "cut_off_hz = 1000.0",
        "modal_ratio = 0.015",
        "amplitude_m = 0.5015e-3",
        "stiffness_n_m15 = 4.5e9",
        "gap_m = 0.0",
    ] {
        let name = key.split(' ').next().unwrap();
        assert_refused(
            paper_with(key, &format!("{name} = -1.0")),
            &[&format!("`{name}` is -1"), "allowed: "],
        );
    }
}

#[test]
fn a_modulus_of_210_is_refused_with_a_word_about_units() {
    assert_refused(
        paper_with("youngs_modulus_pa = 2.1e11", "youngs_modulus_pa = 210"),
        &["`youngs_modulus_pa` is 210 Pa", "is the unit Pa?", "210 GPa is 2.1e11 Pa", "study.toml:15:21"],
    );
}

#[test]
fn lengths_in_millimetres_are_refused() {
    assert_refused(paper_with("length_m = 0.2579822", "length_m = 257.9822"), &["it looks like millimetres"]);
    assert_refused(
        paper_with("height_m = 0.0020", "height_m = 2.0"),
        &["allowed: at most half of the length"],
    );
    assert_refused(
        paper_with("density_kg_m3 = 7800.0", "density_kg_m3 = 7.8"),
        &["7.8 g/cm^3 is 7800 kg/m^3"],
    );
}

#[test]
fn a_point_off_the_beam_is_refused() {
    assert_refused(
        paper_with("at_m = 0.2432157", "at_m = 0.2600"),
        &["`at_m` is 0.26 m, which is off the beam", "allowed: 0 to 0.2579822 m"],
    );
}

#[test]
fn references_to_unknown_points_are_refused_with_those_known() {
    let stop = paper_with("at = \"contact\"", "at = \"contakt\"");
    assert_refused(
        stop,
        &["`at` is \"contakt\"", "did you mean \"contact\"?", "allowed: contact, left, right"],
    );
    assert_refused(paper_with("point = \"contact\"", "point = \"tip\""), &["`point` is \"tip\""]);
    assert_refused(paper_with("at = \"left\"", "at = \"middle\""), &["`at` is \"middle\""]);
    assert_refused(paper_with("at = \"left\"", "at = \"right\""), &["the right end of the beam is not held"]);
    assert_refused(paper_with("fixed_to = \"left\"", "fixed_to = \"right\""), &["`fixed_to` is \"right\""]);
}

#[test]
fn an_empty_or_reversed_frequency_range_is_refused() {
    let range = |range: &str| paper_with("[19.0, 110.0]", range);
    assert_refused(
        range("[20.0, 20.0]"),
        &["`frequency_hz` is [20, 20], which is empty", "excitation.frequency_hz"],
    );
    assert_refused(range("[110.0, 19.0]"), &["which is reversed"]);
    assert_refused(range("[0.0, 110.0]"), &["`frequency_hz[0]` is 0 Hz", "allowed: 1e-10 to 1e10 Hz"]);
    assert_refused(range("[19.0]"), &["`frequency_hz` has 1 entries"]);
}

#[test]
fn gap_and_preload_exclude_each_other() {
    assert_refused(
        paper_with("gap_m = 0.0", "gap_m = 0.0\npreload_n = 1.0"),
        &["`gap_m` is given besides `preload_n`"],
    );
    assert!(paper_with("gap_m = 0.0", "preload_n = 1.0").is_ok());
}

#[test]
fn hertz_stiffness_follows_from_two_spheres_instead() {
    let spheres = "radii_m = [0.015, \"flat\"]\nmoduli_pa = [7e10, 7e10]\npoisson_ratios = [0.32, 0.32]";
    assert!(paper_with("stiffness_n_m15 = 4.5e9", spheres).is_ok());
    let both = format!("stiffness_n_m15 = 4.5e9\n{spheres}");
    assert_refused(paper_with("stiffness_n_m15 = 4.5e9", &both), &["`stiffness_n_m15` is given besides"]);
    assert_refused(paper_with("stiffness_n_m15 = 4.5e9", ""), &["`stiffness_n_m15` is missing", "`radii_m`"]);
    assert_refused(
        paper_with("stiffness_n_m15 = 4.5e9", "radii_m = [1.0, 1.0]"),
        &["`moduli_pa` is missing"],
    );
}

#[test]
fn names_are_unique_not_reserved_and_not_empty() {
    let named = |name: &str| paper_with("name = \"contact\"", &format!("name = \"{name}\""));
    assert_refused(named("ground"), &["`name` is \"ground\", which is reserved"]);
    assert_refused(named(" "), &["`name` is empty"]);
    let twice = LUMPED.replacen("name = \"b\"", "name = \"a\"", 1);
    assert_refused(parse(&twice), &["`name` is \"a\", which is already taken"]);
}

#[test]
fn a_support_motion_load_needs_a_moving_support() {
    let load = "[[load]]\nkind = \"support-motion\"\namplitude_m = 1e-3\norder = 2\n";
    assert_refused(parse(&format!("{LUMPED}\n{load}")), &["needs a moving support"]);
    assert!(parse(&format!("{PAPER}\n{load}")).is_ok());
}

#[test]
fn all_faults_are_reported_at_once_in_the_order_of_the_text() {
    let text = PAPER.replacen("elements = 44", "elements = 0", 1).replacen("gap_m = 0.0", "gap_m = -1.0", 1);
    let message = parse(&text).unwrap_err();
    let [first, second] = ["`elements` is 0", "`gap_m` is -1 m"].map(|part| message.find(part).unwrap());
    assert!(first < second);
}

#[test]
fn text_that_is_not_toml_is_refused_with_its_line() {
    assert_refused(parse("title = \n"), &["not TOML", "study.toml:1:"]);
    assert_refused(parse("title = \"a\"\ntitle = \"b\"\n"), &["not TOML", "duplicate key"]);
}

#[test]
fn depth_and_search_out_of_their_ranges_are_refused() {
    assert_refused(paper_with("period_doubling_depth = 0", "period_doubling_depth = 11"), &["0 to 10"]);
    for (key, value) in [
        ("frequencies", "-1"),
        ("starts", "0.5"),
        ("settling_periods", "0"),
        ("trials", "-1"),
        ("unstable_starts", "\"no\""),
    ] {
        let table = format!("[search]\n{key} = {value}\n");
        assert_refused(paper_with("[search]\ntrials = 0 ", &format!("{table}#")), &[key]);
    }
}

const TABLE: &str = "amplitude_m = [[19.0, 0.50e-3], [60.0, 0.45e-3], [110.0, 0.38e-3]]";

#[test]
fn an_amplitude_may_be_a_table_over_the_frequency() {
    let study = paper_with("amplitude_m = 0.5015e-3", TABLE).unwrap();
    let amplitude = study.excitation.harmonic().unwrap().amplitude().unwrap();
    assert_eq!((amplitude.constant(), amplitude.ends()), (None, Some([19.0, 110.0])));
    assert_eq!((amplitude.at(60.0), amplitude.largest()), (0.45e-3, 0.5e-3));
    let other = paper_with("amplitude_m = 0.5015e-3", &TABLE.replace("0.45e-3", "0.46e-3")).unwrap();
    assert_ne!(study.identity(), other.identity(), "the table is part of what the study is");
}

#[test]
fn tables_of_amplitudes_that_make_no_sense_are_refused() {
    for (table, part) in [
        ("[[19.0, 0.5e-3]]", "needs two points"),
        ("[[19.0, 0.5e-3], [19.0, 0.4e-3], [110.0, 0.4e-3]]", "frequencies must rise"),
        (
            "[[20.0, 0.5e-3], [110.0, 0.4e-3]]",
            "given from 20 to 110 Hz, the excitation runs from 19 to 110 Hz",
        ),
        ("[[19.0, 0.5e-3], [110.0, 0.0]]", "is 0"),
        ("[[19.0, 0.5e-3], [110.0]]", "has 1 entries"),
        ("[[19.0, 0.5e-3], 3.0]", "must be a list"),
        ("\"shaker.csv\"", "must be a number"),
        ("[[19.0, 0.5], [110.0, 0.4]]", "at most 0.2579822 m"),
    ] {
        let study = paper_with("amplitude_m = 0.5015e-3", &format!("amplitude_m = {table}"));
        let message = match study {
            Err(message) => message,
            // Lengths are compared with the beam when the model is built.
            Ok(_) => {
                let text = PAPER.replacen("amplitude_m = 0.5015e-3", &format!("amplitude_m = {table}"), 1);
                let file = StudyFile::parse("study.toml", text).unwrap();
                crate::Model::build(&file).unwrap_err().to_string()
            }
        };
        assert!(message.contains(part), "{table}: {message}");
    }
}

/// The same text but for units: not a digit of the study differs.
#[test]
fn a_quantity_with_its_unit_is_the_number_that_one_would_write() {
    let mut text = PAPER.to_owned();
    for (old, new) in [
        ("length_m = 0.2579822 ", "length = \"257.9822 mm\" "),
        ("youngs_modulus_pa = 2.1e11", "youngs_modulus = \"210 GPa\""),
        ("frequency_hz = [19.0, 110.0]", "frequency = [\"19 Hz\", \"0.11 kHz\"]"),
        ("stiffness_n_m15 = 4.5e9", "stiffness = \"4.5e9 N/m^1.5\""),
    ] {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    assert_eq!(parse(&text).unwrap(), parse(PAPER).unwrap());
}

#[test]
fn a_quantity_of_another_dimension_is_refused_with_the_unit_that_fits() {
    let frequency = |text: &str| parse(&LUMPED.replacen("frequency_hz = [1.0, 2.0]", text, 1));
    let rad = frequency("frequency = [\"6.283185307179586 rad/s\", \"2 Hz\"]").unwrap();
    assert_eq!(rad.excitation.range_hz(), [1.0, 2.0]);
    assert_refused(
        frequency("frequency = \"3 kg\""),
        &["`frequency` has to be a number with a unit that fits Hz", "`frequency = \"1 Hz\"`"],
    );
    assert_refused(
        frequency("frequency = [\"1 Hz\", \"2 s\"]"),
        &["must be a number with a unit that fits Hz, found the string \"2 s\""],
    );
    assert_refused(
        frequency("frequency = [\"1 Hz\", \"2 Hz\"]\nfrequency_hz = [1.0, 2.0]"),
        &["`frequency` is given, and `frequency_hz`, too"],
    );
    assert_refused(frequency("frequency_hz = [\"1 Hz\", 2.0]"), &["must be a number, found"]);
}

#[test]
fn a_text_that_is_no_quantity_or_one_of_another_dimension_is_one_fault() {
    for text in ["nan mm", "inf mm", "5 furlongs", "mm", "3 N"] {
        let changed = PAPER.replacen("amplitude_m = 0.5015e-3", &format!("amplitude = \"{text}\""), 1);
        let Err(StudyError::Invalid(report)) = StudyFile::parse("study.toml", changed) else {
            panic!("{text} is taken")
        };
        let messages: Vec<&str> = report.problems.iter().map(|problem| &problem.message[..]).collect();
        assert_eq!(messages, ["`amplitude` has to be a number with a unit that fits m"], "{text}");
    }
}

/// A number that is written with its unit varies by the name of its key, and is written with its unit again.
#[test]
fn a_quantity_with_its_unit_is_a_parameter() {
    let text = LUMPED.replacen("mass_kg = 2.0", "mass = \"2000 g\"", 1);
    let number = crate::number::number_named(&text, "structure.mass.b.mass_kg").unwrap().unwrap();
    assert_eq!(number.value, 2.0);
    let changed = crate::number::replaced(&text, &[number], &[2.5]);
    assert!(changed.contains("mass = \"2.5 kg\""), "{changed}");
    let StructureTable::Lumped(lumped) = parse(&changed).unwrap().structure else { panic!("not lumped") };
    assert_eq!(lumped.masses[1].mass_kg, 2.5);
}
