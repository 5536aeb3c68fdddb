//! The rows of the page of keys have the keys that the readers ask for, no more and no fewer.

use std::collections::BTreeSet;

use hammerbeam_motion::law::DESCRIPTIONS;

use super::{StudyError, StudyFile, key_tables, stop_keys};

const BEAM: &str = include_str!("../../../../studies/beam-between-stops.toml");
const LUMPED: &str = include_str!("../../../../studies/two-masses.toml");

/// Where the studies are said to be: matrices are beside them.
const BESIDE_MATRICES: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/tutorials/calculix/study.toml");
const MATRICES: &str = r#"
[structure]
kind = "matrices"
stiffness = "plate.sti"
mass = "plate.mas"
damping = "plate.mas"
nodes = "plate.inp"
[structure.rest]
[reduction]
method = "none"
"#;

/// Keys that a reader names as known when it meets an unknown one.
fn known(study: &str) -> Vec<String> {
    let Err(StudyError::Invalid(report)) = StudyFile::parse(BESIDE_MATRICES, study.to_owned()) else {
        panic!("the unknown key was accepted in\n{study}");
    };
    let help = report.problems.iter().flat_map(|problem| &problem.help);
    let mut lists = help.filter_map(|help| help.strip_prefix("known keys: "));
    let list = lists.next().unwrap_or_else(|| panic!("no unknown key in\n{study}\n{report}"));
    list.split(", ").map(str::to_owned).collect()
}

/// A study with an unknown key behind a line.
fn behind(study: &str, line: &str) -> String {
    assert!(study.contains(line), "{line} is not in\n{study}");
    study.replacen(line, &format!("{line}\nwrong_key = 1"), 1)
}

/// A study with a further table that has an unknown key.
fn with(table: &str, keys: &str) -> String {
    format!("{BEAM}\n{table}\n{keys}\nwrong_key = 1\n")
}

fn beams() -> Vec<(&'static str, String)> {
    let section = "section = { width_m = 0.02, height_m = 0.003 }";
    let timoshenko = BEAM.replace("elements = 40", "elements = 40\ntheory = \"timoshenko\"");
    let of_section =
        |study: &str, keys: &str| study.replace(section, &format!("section = {{ {keys}, wrong_key = 1 }}"));
    let span = "[[structure.span]]\nlength_m = 0.5\nwrong_key = 1\n\n[[structure.point]]";
    let spans = timoshenko.replace("length_m = 0.5\n", "").replacen("[[structure.point]]", span, 1);
    vec![
        ("structure of kind beam", behind(&timoshenko, "[structure]")),
        ("structure.section", of_section(BEAM, "width_m = 0.02, height_m = 0.003")),
        ("structure.section", of_section(BEAM, "outer_diameter_m = 0.02")),
        ("structure.section", of_section(&timoshenko, "area_m2 = 6e-5, second_moment_m4 = 4e-11")),
        ("structure.span", spans),
        ("structure.point of a beam", behind(BEAM, "[[structure.point]]")),
    ]
}

fn other_structures() -> Vec<(&'static str, String)> {
    let damper = "[[structure.damper]]\nbetween = [\"first\", \"second\"]\ndamping_n_s_m = 1.0\n";
    let damped = format!("{LUMPED}\n{damper}");
    let rest = |table: &str| MATRICES.replace("[structure.rest]", &format!("{table}\nwrong_key = 1"));
    let files = "[[structure.component]]\nname = \"plate\"\nstiffness = \"plate.sti\"\nmass = \"plate.mas\"";
    let components = rest(files).replacen("stiffness = \"plate.sti\"\nmass = \"plate.mas\"\n", "", 1);
    let components = components.replacen("damping = \"plate.mas\"\n", "", 1);
    vec![
        ("structure of kind lumped", behind(LUMPED, "[structure]")),
        ("structure.mass", behind(LUMPED, "[[structure.mass]]")),
        ("structure.spring", behind(LUMPED, "[[structure.spring]]")),
        ("structure.damper", behind(&damped, "[[structure.damper]]")),
        ("structure of kind matrices", behind(&MATRICES.replace("[structure.rest]\n", ""), "[structure]")),
        ("structure of kind matrices", behind(&components.replace("\nwrong_key = 1", ""), "[structure]")),
        ("structure.component", components),
        (
            "structure.point of matrices",
            rest("[[structure.point]]\nname = \"a\"\nnode = 1\ndirection = \"z\""),
        ),
        ("structure.point of matrices", rest("[[structure.point]]\nname = \"a\"\nlabel = \"a\"")),
        ("structure.point of matrices", rest("[[structure.point]]\nname = \"a\"\nrow = 1")),
        (
            "structure.support",
            rest("[[structure.support]]\nname = \"a\"\neverything = true\ndirection = \"z\""),
        ),
        ("structure.fixed", rest("[[structure.fixed]]\nnodes = [1]")),
    ]
}

fn excitations() -> Vec<(&'static str, String)> {
    let shaken = "kind = \"support-motion\"\nat = \"left\"\namplitude_m = 0.2e-3\n";
    let excited = |keys: &str| BEAM.replace(shaken, keys);
    let supports = "kind = \"support-motion\"\n\
                    support = [{ at = \"left\", amplitude_m = 1e-3 }, \
                    { at = \"tip\", amplitude_m = 1e-3 }]\n";
    let force = "kind = \"force\"\nat = \"tip\"\namplitude_n = 1.0\n";
    let forces = "kind = \"force\"\nforce = [{ at = \"tip\", amplitude_n = 1.0 }]\n";
    let wrong = |keys: &str| keys.replacen("1e-3 }", "1e-3, wrong_key = 1 }", 1);
    let pair = "between = [\"tip\", \"right\"]\nunbalance_mass_kg = 1.0\neccentricity_m = 0.1\n";
    let load = |keys: &str| with("[[load]]", keys);
    let moved = "[[load]]\nkind = \"support-motion\"\nat = \"left\"\namplitude_m = 1e-3\norder = 2\n";
    vec![
        ("excitation", behind(BEAM, "[excitation]")),
        ("excitation", behind(&excited(supports), "[excitation]")),
        ("excitation", behind(&excited(force), "[excitation]")),
        ("excitation", behind(&excited(&format!("kind = \"force\"\n{pair}")), "[excitation]")),
        ("excitation", behind(&excited(forces), "[excitation]")),
        ("excitation.support", excited(&wrong(supports))),
        ("excitation.force", excited(&forces.replace("1.0 }", "1.0, wrong_key = 1 }"))),
        (
            "excitation.force",
            behind(
                &format!("{}\n[[excitation.force]]\n{pair}", excited("kind = \"force\"\n")),
                "eccentricity_m = 0.1",
            ),
        ),
        ("load", load("kind = \"gravity\"\nacceleration_m_s2 = 1.0")),
        ("load", load("kind = \"force\"\nat = \"tip\"\namplitude_n = 1.0\norder = 1")),
        ("load", load(&format!("kind = \"force\"\n{pair}order = 1"))),
        ("load", load("kind = \"support-motion\"\namplitude_m = 1e-3\norder = 2")),
        ("load", behind(&format!("{}\n{moved}", excited(supports)), "order = 2")),
    ]
}

fn stops() -> Vec<(&'static str, String)> {
    let stop = |law: &str| with("[[stop]]", &format!("at = \"tip\"\nlaw = \"{law}\""));
    let mut stops: Vec<(&str, String)> =
        DESCRIPTIONS.iter().map(|described| ("stop", stop(described.name))).collect();
    let further = [
        ("at = \"tip\"", "law = \"hunt-crossley\"\nrestitution = 0.5"),
        ("at = \"tip\"", "law = \"hertz\"\nradii_m = [1.0, 1.0]"),
        ("between = [\"tip\", \"right\"]", "law = \"linear\"\npreload_n = 1.0"),
    ];
    stops.extend(further.map(|(place, law)| ("stop", with("[[stop]]", &format!("{place}\n{law}")))));
    stops
}

fn settings() -> Vec<(&'static str, String)> {
    let damped = "[damping]\nrayleigh = { mass_per_s = 0.1, stiffness_s = 0.0, wrong_key = 1 }";
    let output = |keys: &str| with("[[output]]", keys);
    vec![
        ("top level", format!("wrong_key = 1\n{BEAM}")),
        ("reduction", behind(BEAM, "[reduction]")),
        ("damping", behind(BEAM, "[damping]")),
        ("damping.rayleigh", BEAM.replace("[damping]\nmodal_ratio = 0.02", damped)),
        ("response", behind(BEAM, "[response]")),
        ("output", output("at = \"tip\"")),
        ("output", output("")),
        ("search", with("[search]", "")),
        ("continuation", with("[continuation]", "")),
        ("vary", with("[[vary]]", "")),
        ("curve", with("[[curve]]", "")),
        ("figures", with("[figures]", "")),
        ("figures.orbit", with("[[figures.orbit]]", "")),
        ("rig", with("[rig]", "")),
    ]
}

#[test]
fn rows_of_keys_are_what_the_readers_ask_for() {
    let studies = [beams(), other_structures(), excitations(), stops(), settings()].concat();
    for table in key_tables().iter().filter(|table| table.name != "stop by its law") {
        let of_table = studies.iter().filter(|(name, _)| *name == table.name);
        let asked: BTreeSet<String> = of_table.flat_map(|(_, study)| known(study)).collect();
        let mut rows: BTreeSet<String> = table.rows.iter().map(|row| row.name.clone()).collect();
        if table.name == "stop" {
            rows.extend(stop_keys::rows_of_laws().into_iter().map(|row| row.name));
        }
        assert_eq!(rows, asked, "{}", table.name);
    }
}

#[test]
fn every_row_says_what_its_key_means_and_no_row_stands_twice() {
    for table in key_tables() {
        let mut names = BTreeSet::new();
        for row in &table.rows {
            let place = format!("`{}` of {}", row.name, table.name);
            let cells = [&row.allowed, &row.default, &row.meaning];
            assert!(cells.iter().all(|cell| !cell.is_empty() && !cell.contains('|')), "{place}: {row:?}");
            let is_new = names.insert((&row.name, &row.of));
            assert!(is_new, "{place} stands twice");
        }
    }
}
