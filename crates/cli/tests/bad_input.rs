//! Bad input: exit code 2, a message with line and key, and nothing written.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{BEAM, TWO_MASSES, Workshop, assert_bad_input, assert_success, stderr, stdout};

/// Every command that reads a study refuses it in the same words, and the folder stays as it was.
#[track_caller]
fn assert_refused(workshop: &Workshop, parts: &[&str]) {
    let before = workshop.listing();
    for arguments in [
        &["check", "study.toml"][..],
        &["modes", "study.toml"],
        &["run", "study.toml", "--out", "results"],
        &["orbit", "study.toml", "--frequency", "30"],
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), parts);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

/// The beam with one piece of text replaced is refused at the line of the replacement.
#[track_caller]
fn assert_beam_refused(old: &str, new: &str, parts: &[&str]) {
    let line = BEAM[..BEAM.find(old).unwrap()].matches('\n').count() + 1;
    let place = format!("study.toml:{line}:");
    assert_refused(&Workshop::changed(BEAM, old, new), &[&[place.as_str()], parts].concat());
}

#[test]
fn unknown_key() {
    let parts = ["unknown key `elemnts`", "structure.elemnts", "did you mean `elements`?"];
    assert_beam_refused("elements = 44", "elemnts = 44", &parts);
}

#[test]
fn missing_key() {
    let workshop = Workshop::changed(BEAM, "density_kg_m3 = 7800.0\n", "");
    let table = BEAM[..BEAM.find("[structure]").unwrap()].matches('\n').count() + 1;
    let place = format!("study.toml:{table}:1");
    assert_refused(&workshop, &[&place, "`density_kg_m3` is missing in [structure]"]);
}

#[test]
fn wrong_type() {
    let parts = ["`length_m` must be a number, found the string \"long\"", "structure.length_m"];
    assert_beam_refused("length_m = 0.2579822", "length_m = \"long\"", &parts);
}

#[test]
fn not_a_number() {
    let parts = ["`modal_ratio` is NaN", "damping.modal_ratio", "numbers must be finite"];
    assert_beam_refused("modal_ratio = 0.015", "modal_ratio = nan", &parts);
}

#[test]
fn infinite_value() {
    let parts = ["`amplitude_m` is inf m", "excitation.amplitude_m", "numbers must be finite"];
    assert_beam_refused("amplitude_m = 0.5015e-3", "amplitude_m = inf", &parts);
}

#[test]
fn negative_value_where_it_makes_no_sense() {
    let parts = ["`mass_kg` is -0.03756 kg", "structure.point[0].mass_kg", "allowed: 0 to"];
    assert_beam_refused("mass_kg = 0.03756", "mass_kg = -0.03756", &parts);
}

#[test]
fn negative_gap() {
    let parts = ["`gap_m` is -0.001 m", "stop[0].gap_m", "`preload_n`"];
    assert_beam_refused("gap_m = 0.0", "gap_m = -1e-3", &parts);
}

#[test]
fn youngs_modulus_of_210() {
    let parts = ["`youngs_modulus_pa` is 210 Pa", "is the unit Pa?", "210 GPa is 2.1e11 Pa"];
    assert_beam_refused("youngs_modulus_pa = 2.1e11", "youngs_modulus_pa = 210", &parts);
}

#[test]
fn point_off_the_beam() {
    let parts =
        ["`at_m` is 0.3 m, which is off the beam", "structure.point[0].at_m", "allowed: 0 to 0.2579822 m"];
    assert_beam_refused("at_m = 0.2432157", "at_m = 0.3", &parts);
}

#[test]
fn stop_at_an_unknown_point() {
    let parts = ["`at` is \"contakt\"", "stop[0].at", "did you mean \"contact\"?"];
    assert_beam_refused("at = \"contact\"", "at = \"contakt\"", &parts);
}

#[test]
fn empty_frequency_range() {
    let parts = ["`frequency_hz` is [19, 19], which is empty", "excitation.frequency_hz"];
    assert_beam_refused("[19.0, 110.0]", "[19.0, 19.0]", &parts);
}

#[test]
fn reversed_frequency_range() {
    let parts = ["`frequency_hz` is [110, 19], which is reversed", "[low, high] with low < high"];
    assert_beam_refused("[19.0, 110.0]", "[110.0, 19.0]", &parts);
}

#[test]
fn cut_off_below_the_first_mode() {
    let parts = ["the cut-off frequency is 10 Hz", "reduction.cut_off_hz", "allowed: more than 30.5"];
    assert_beam_refused("cut_off_hz = 1000.0", "cut_off_hz = 10.0", &parts);
}

#[test]
fn text_that_is_not_toml() {
    assert_beam_refused("title = ", "title ", &["not TOML"]);
}

#[test]
fn study_that_is_not_there() {
    let workshop = Workshop::with("");
    assert_bad_input(
        &workshop.hammerbeam(&["check", "nowhere.toml"]),
        &["cannot read the study nowhere.toml"],
    );
}

#[test]
fn flags_out_of_range() {
    let workshop = Workshop::with(TWO_MASSES);
    for arguments in [
        &["orbit", "study.toml", "--frequency", "-3"][..],
        &["orbit", "study.toml", "--frequency", "nan"],
        &["orbit", "study.toml", "--frequency", "30", "--period-multiple", "0"],
        &["run", "study.toml", "--out", "results", "--jobs", "0"],
        &["run", "study.toml"],
        &["export", "results", "--format", "xls"],
        &["juggle"],
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), &["error: "]);
    }
}

/// A mass with a damper, which nothing brings back.
const FREE: &str = "[structure]\nkind = \"lumped\"\nmass = [{ name = \"m\", mass_kg = 1.0 }]\n\
    damper = [{ between = [\"m\", \"ground\"], damping_n_s_m = 0.5 }]\n\
    [excitation]\nkind = \"force\"\nat = \"m\"\namplitude_n = 1.0\nfrequency_hz = [1.0, 1.1]\n";
const STOP_ABOVE: &str = "[[stop]]\nname = \"s\"\nat = \"m\"\nlaw = \"linear\"\nstiffness_n_m = 1e3\ngap_m \
= 1.0\nside = \"above\"\n";

#[test]
fn a_structure_that_nothing_holds_has_no_isolated_solutions() {
    let workshop = Workshop::with(FREE);
    let parts = ["nothing holds the rigid-body motion (m 1.000), at 0 Hz", "families"];
    let before = workshop.listing();
    assert_bad_input(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]), &parts);
    assert_bad_input(&workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "1"]), &parts);
    assert_eq!(workshop.listing(), before, "something was written");
    let check = workshop.hammerbeam(&["check", "study.toml", "--json"]);
    assert_success(&check);
    assert!(stderr(&check).contains(parts[0]), "{}", stderr(&check));
    let document: serde_json::Value = serde_json::from_str(&stdout(&check)).unwrap();
    assert_eq!(document["drifts"][0]["motion"]["m"], 1.0);
    assert_eq!(document["drifts"][0]["held_by_stops"], false);
}

#[test]
fn a_structure_that_only_stops_hold_is_warned_of() {
    let workshop = Workshop::with(&format!("{FREE}{STOP_ABOVE}"));
    let check = workshop.hammerbeam(&["check", "study.toml"]);
    assert_success(&check);
    assert!(stderr(&check).contains("warning: only stops that can open hold"), "{}", stderr(&check));
}

/// A study of so many masses in a row, with so many stops at a point that is not there.
fn large_study(masses: usize, stops: usize) -> String {
    let mass = |k: usize| format!("{{ name = \"m{k}\", mass_kg = 1.0 }}");
    let all: Vec<String> = (0..masses).map(mass).collect();
    let mut text = format!("[structure]\nkind = \"lumped\"\nmass = [{}]\n", all.join(", "));
    text += "[excitation]\nkind = \"force\"\nat = \"m0\"\namplitude_n = 1.0\nfrequency_hz = [0.01, 0.1]\n";
    (0..stops).for_each(|_| text += "[[stop]]\nat = \"nowhere\"\nlaw = \"linear\"\nstiffness_n_m = -1.0\n");
    text
}

/// Neither a list that is too long to be computed with nor thousands of faults take longer than a sentence.
#[test]
fn very_long_lists_are_refused_and_of_very_many_faults_the_first_hundred_are_shown() {
    for (text, expected) in [
        (large_study(20_000, 0), ["`mass` has 20000 entries", "at most 1000 tables"]),
        (large_study(1, 20_000), ["`stop` has 20000 entries", "at most 1000 tables"]),
        (large_study(1, 900), ["and", "more"]),
        (
            format!("title = \"{}\"\n", "x".repeat(100_000)),
            ["`title` is 100000 bytes long", "at most 1000 bytes"],
        ),
        // Every start of a number with a unit is tried, and every edit of an unknown word.
        (
            large_study(1, 0).replace("mass_kg", &format!("mass = \"{}x\", mass_kg", "1".repeat(300_000))),
            ["`mass`", "unit"],
        ),
        (format!("{} = 1\n", "k".repeat(2_000_000)), ["unknown key", "known keys"]),
        ((0..200_000).map(|k| format!("k{k} = 1\n")).collect(), ["unknown key `k0`", "and 199"]),
    ] {
        let workshop = Workshop::with(&text);
        let begun = std::time::Instant::now();
        let output = workshop.hammerbeam(&["check", "study.toml"]);
        assert_bad_input(&output, &expected);
        assert!(output.stderr.len() < 300_000, "{} bytes", output.stderr.len());
        assert!(begun.elapsed().as_secs() < 20, "{expected:?}: {:?}", begun.elapsed());
    }
}

/// A structure within the limits is checked, though every stop is closed in thought: work like the fourth
/// power of the masses took minutes here.
#[test]
fn hundreds_of_masses_are_checked() {
    let spring = |k: usize| format!("{{ between = [\"m{k}\", \"m{}\"], stiffness_n_m = 9.87 }}", k + 1);
    let springs: Vec<String> = (0..399).map(spring).collect();
    let held = "{ between = [\"m399\", \"ground\"], stiffness_n_m = 9.87 }";
    let stop =
        "[[stop]]\nat = \"m0\"\nlaw = \"linear\"\nstiffness_n_m = 1.0\nside = \"above\"\ngap_m = 0.1\n";
    let all =
        format!("spring = [{}, {held}]\n[damping]\nmodal_ratio = 0.01\n[excitation]", springs.join(", "));
    let workshop = Workshop::with(&(large_study(400, 0).replace("[excitation]", &all) + stop));
    assert_success(&workshop.hammerbeam(&["check", "study.toml"]));
}

/// Texts that a terminal would obey, or that would end a row of a table.
#[test]
fn titles_and_names_with_control_characters_are_refused() {
    for (text, code) in [
        ("\\u001b[31mred", "U+001B"),
        ("a\\rb", "U+000D"),
        ("a\\nb", "U+000A"),
        ("\u{202e}b", "U+202E"),
        ("a\u{200b}b", "U+200B"),
        ("a\u{feff}b", "U+FEFF"),
        ("\u{e0041}b", "U+E0041"),
    ] {
        let workshop = Workshop::changed(TWO_MASSES, "title = \"", &format!("title = \"{text}"));
        let sentence = format!("`title` has the control character {code}");
        let output = workshop.hammerbeam(&["check", "study.toml"]);
        assert_bad_input(&output, &[&sentence]);
        let text = String::from_utf8(output.stderr).unwrap();
        let unseen = ['\u{1b}', '\r', '\u{202e}', '\u{200b}', '\u{feff}', '\u{e0041}'];
        assert!(!text.contains(unseen), "{text:?}");
    }
}

/// What is no file of a study, or none that ends.
#[cfg(target_os = "linux")]
#[test]
fn a_file_without_end_is_refused() {
    let workshop = Workshop::with(TWO_MASSES);
    let sentence = "it is no regular file";
    assert_bad_input(&workshop.hammerbeam(&["check", "/dev/zero"]), &[sentence]);
    assert_bad_input(&workshop.hammerbeam(&["signal", "spectrum", "/dev/zero"]), &[sentence]);
}

fn beam_without_reduction() -> String {
    let [from, to] = ["[reduction]", "[damping]"].map(|table| BEAM.find(table).unwrap());
    format!("{}{}", &BEAM[..from], &BEAM[to..])
}

/// A part that is missing, or wrong, hides nothing of what can be judged without it.
#[test]
fn all_faults_are_reported_in_one_pass() {
    let crowded = beam_without_reduction().replace("elements = 44", "elements = 1");
    let study = crowded.replacen("amplitude_m = 0.5015e-3", "amplitude_m = 2", 1);
    let vary = "[[vary]]\nparameter = \"stop.1.gap_m\"\nrange = [2, 1]\nfrequency_hz = 20";
    assert_refused(
        &Workshop::with(&format!("{study}\n{vary}\n")),
        &[
            "`reduction` is missing",
            "the beam has 1 elements",
            "`amplitude_m` is 2 m",
            "`range` is [2, 1], which is reversed",
        ],
    );
}

/// A word that is none hides nothing of what depends on it: what was probably meant is looked at. Nor does a
/// fault of the structure hide that its reduction is missing.
#[test]
fn what_depends_on_a_wrong_word_is_reported_with_it() {
    let study = beam_without_reduction()
        .replace("left = \"clamped\"", "left = \"fixed\"")
        .replace("law = \"hertz\"", "law = \"herz\"")
        .replace("gap_m = 0.0", "gap_m = -1.0")
        .replace("side = \"below\"", "side = \"over\"");
    assert_refused(
        &Workshop::with(&study),
        &[
            "did you mean \"clamped\"?",
            "`reduction` is missing",
            "`law` is \"herz\"",
            "`gap_m` is -1",
            "`side` is \"over\"",
        ],
    );
    let kind = BEAM.replace("kind = \"beam\"", "kind = \"beem\"").replace("elements = 44", "elements = 1");
    assert_refused(&Workshop::with(&kind), &["`kind` is \"beem\"", "the beam has 1 elements"]);
}

/// What varies is looked for in the tables that could be read; in the others nothing is said of it.
#[test]
fn names_of_parameters_are_judged_beside_faults_of_other_tables() {
    let study = BEAM.replacen("modal_ratio = 0.015", "modal_ratio = -1", 1);
    let vary = |parameter: &str| {
        format!("[[vary]]\nparameter = \"{parameter}\"\nrange = [2, 1]\nfrequency_hz = 20\n")
    };
    let workshop = Workshop::with(&format!(
        "{study}\n{}{}{}",
        vary("stop.1.gap_mm"),
        vary("damping.rayleigh.stiffness_s"),
        vary("nonsense")
    ));
    let parts = [
        "`modal_ratio` is -1",
        "`parameter` is \"stop.1.gap_mm\"",
        "did you mean \"stop.1.gap_m\"?",
        "`parameter` is \"nonsense\"",
        "which is reversed",
    ];
    assert_refused(&workshop, &parts);
    let reported = stderr(&workshop.hammerbeam(&["check", "study.toml"]));
    assert!(!reported.contains("`parameter` is \"damping"), "{reported}");
}

/// A rig is a study of its own, and `check` looks at it as well.
#[test]
fn check_tells_what_is_wrong_with_a_rig() {
    let rig = "[rig]\nsweep_hz = [20, 70]\n[rig.changes.damping]\nmodal_ratio = -1.0\n";
    let workshop = Workshop::with(&format!("{BEAM}\n{rig}"));
    assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), &["[rig.changes]", "modal_ratio"]);
}

/// The words of other programs, keys without their unit, and a section in no form that is known.
#[test]
fn what_was_probably_meant_is_suggested() {
    let study = BEAM
        .replace("left = \"clamped\"", "left = \"fixed\"")
        .replace("density_kg_m3", "density")
        .replace("length_m = 0.2579822", "length_mm = 257.9822")
        .replace("modal_ratio = 0.015", "ratio = 0.015")
        .replace("width_m = 0.0298, height_m = 0.0020", "diameter_m = 0.01");
    assert_refused(
        &Workshop::with(&study),
        &[
            "did you mean \"clamped\"?",
            "did you mean `density_kg_m3`?",
            "did you mean `length_m`?",
            "did you mean `modal_ratio`?",
            "allowed: { width_m, height_m } of a rectangle, { outer_diameter_m } of a rod, { outer_",
        ],
    );
}

/// Whatever is wrong with the section as a whole, what it may be is reported in full.
#[test]
fn every_form_of_a_section_is_told_where_it_is_in_none() {
    let section = "section = { width_m = 0.0298, height_m = 0.0020 }";
    for (form, fault) in [
        ("", "`section` is missing in [structure]"),
        ("section = \"30 mm x 2 mm\"", "`section` must be a table, found the string"),
        ("section = { width = \"30 mm\", area_m2 = 6e-5 }", "`section` is a mix of the accepted forms"),
        ("section = { diameter = \"10 mm\" }", "`section` has none of the accepted forms"),
        ("section = { width = \"30 mm\" }", "`height_m` is missing in [structure.section]"),
    ] {
        let output = Workshop::changed(BEAM, section, form).hammerbeam(&["check", "study.toml"]);
        let forms = "allowed: { width_m, height_m } of a rectangle, { outer_diameter_m } of a rod, { outer_";
        let with_units = "{ width = \"30 mm\", height = \"2 mm\" }, or { area = \"60 mm^2\", \
            second_moment = \"20 mm^4\" }";
        assert_bad_input(&output, &[fault, forms, with_units]);
        let message = stderr(&output);
        assert!(!message.contains("unknown key `width"), "{message}");
    }
}

/// One of a thing, and a gap that someone wrote with a sign.
#[test]
fn check_counts_one_as_one_and_gives_nothing_no_sign() {
    let workshop = Workshop::driven_mass(
        "frequency_hz = [0.1, 0.2]\n[[stop]]\nname = \"wall\"\nat = \"m\"\nlaw = \"linear\"\n\
         side = \"above\"\nstiffness_n_m = 1.0\ngap_m = -0.0\n",
    );
    let shown = stdout(&workshop.hammerbeam(&["check", "study.toml"]));
    for part in ["1 spring, 1 damper\n", "none, 1 mode\n", "gap 0 m"] {
        assert!(shown.contains(part), "\"{part}\" is missing in\n{shown}");
    }
}

/// A cantilever of a tenth of a millimetre: `E b h^3/12` is 2.67e-13 N m^2.
#[test]
fn check_shows_damping_and_small_numbers_with_their_digits() {
    let study = "[structure]\nkind = \"beam\"\nlength_m = 1e-4\nelements = 10\n\
        section = { width_m = 2e-5, height_m = 1e-6 }\nyoungs_modulus_pa = 1.6e11\ndensity_kg_m3 = 2330\n\
        left = \"clamped\"\nright = \"free\"\n[reduction]\nmethod = \"truncation\"\ncut_off_hz = 3e6\n\
        [excitation]\nkind = \"force\"\nat = \"right\"\namplitude_n = 1e-7\nfrequency_hz = [1e5, 2e5]\n\
        [response]\npoint = \"right\"\n";
    let shown = stdout(&Workshop::with(study).hammerbeam(&["check", "study.toml"]));
    for part in ["EI 2.66666667e-13 N m^2", "4.66e-8 kg/m", "damping      none", "amplitude 100 nN"] {
        assert!(shown.contains(part), "\"{part}\" is missing in\n{shown}");
    }
    let damped = study.replace("[excitation]", "[damping]\nmodal_ratio = 0.02\n[excitation]");
    let shown = stdout(&Workshop::with(&damped).hammerbeam(&["check", "study.toml"]));
    assert!(shown.contains("damping      ratio 0.02 of every mode"), "{shown}");
}
