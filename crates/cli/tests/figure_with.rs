//! Response diagrams of several results folders over one another.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{fs, path::Path};

use crate::common::{Workshop, assert_bad_input, assert_success, short_run, short_study};

/// Colour of the branches, and those of the first and second folder behind them.
const OWN: &str = "#23276a";
const BEHIND: [&str; 2] = ["#7d7d7d", "#045bc5"];
const FAMILY: [&str; 2] =
    ["family/structure.mass.first.mass_kg=1.0", "family/structure.mass.first.mass_kg=1.1"];

/// The paths of lines of a colour and a width, without those of the legend, which are straight.
fn paths(svg: &Path, (colour, width): (&str, &str)) -> Vec<String> {
    let text = fs::read_to_string(svg).unwrap();
    let group = format!("<g fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"");
    let groups = text.split(&group).skip(1).filter_map(|rest| rest.split("</g>").next());
    let paths = groups.flat_map(|group| group.split("<path d=\"").skip(1));
    let data = paths.filter_map(|path| path.split('"').next()).map(str::to_owned);
    data.filter(|data| data.len() > 60).collect()
}

fn family() -> Workshop {
    let workshop = Workshop::with(&short_study());
    let values = "structure.mass.first.mass_kg=1.0,1.1";
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "family", "--vary-set", values]));
    workshop
}

/// Results over themselves: the thin lines go where the branches go.
#[test]
fn lines_behind_are_the_branches_of_their_folder() {
    let workshop = short_run();
    let drawn = ["figure", "results", "--with", "results", "--kind", "response", "--out", "drawn"];
    assert_success(&workshop.hammerbeam(&drawn));
    let svg = workshop.path("drawn/response_displacement.svg");
    let own = paths(&svg, (OWN, "0.9"));
    assert!(!own.is_empty());
    assert_eq!(paths(&svg, (BEHIND[0], "0.54")), own);
}

#[test]
fn folders_of_a_family_are_drawn_over_one_another_with_their_names() {
    let workshop = family();
    let [first, second] = FAMILY;
    let alone = |folder: &str, out: &str| {
        assert_success(&workshop.hammerbeam(&["figure", folder, "--kind", "response", "--out", out]));
    };
    alone(first, "first");
    let with = ["figure", first, "--with", second, "--with", first, "--kind", "response", "--out", "both"];
    assert_success(&workshop.hammerbeam(&with));
    let svg = workshop.path("both/response_displacement.svg");
    let text = fs::read_to_string(&svg).unwrap();
    assert!(text.contains("structure.mass.first.mass_kg=1.1"), "the legend has its name");
    // The first folder comes twice, and is told apart by its whole path.
    assert!(text.contains(first), "the legend has its name");
    let [behind, again] = BEHIND.map(|colour| paths(&svg, (colour, "0.54")));
    assert!(!behind.is_empty() && behind != again);
    assert_eq!(again, paths(&svg, (OWN, "0.9")));
    // Both lie within one pair of axes, so that the one alone is drawn in others.
    assert_ne!(paths(&workshop.path("first/response_displacement.svg"), (OWN, "0.9")), again);
    let again = workshop.hammerbeam(&[&with[..8], &["--out", "again"]].concat());
    assert_success(&again);
    assert_eq!(fs::read(workshop.path("again/response_displacement.svg")).unwrap(), fs::read(&svg).unwrap());
}

#[test]
fn folders_that_do_not_belong_together_are_refused() {
    let workshop = family();
    let [first, second] = FAMILY;
    let message = [first, "holds results of", "--with", second];
    assert_bad_input(&workshop.hammerbeam(&["figure", "family"]), &message);
    let study = short_study();
    let other = |out: &str, changes: [(&str, &str); 2]| {
        assert!(changes.iter().all(|(from, _)| study.contains(from)));
        let changed = changes.iter().fold(study.clone(), |text, (from, to)| text.replacen(from, to, 1));
        fs::write(workshop.path("other.toml"), changed).unwrap();
        assert_success(&workshop.hammerbeam(&["run", "other.toml", "--out", out]));
        workshop.hammerbeam(&["figure", first, "--with", out, "--out", "drawn"])
    };
    let said = ["point", "response point is second instead of first"];
    assert_bad_input(
        &other("point", [("point = \"first\"", "point = \"second\""), ("title", "title")]),
        &said,
    );
    let forced = [
        ("kind = \"support-motion\"\nat = \"ground\"", "kind = \"force\"\nat = \"first\""),
        ("amplitude_m = 0.5e-3", "amplitude_n = 0.5"),
    ];
    let said = ["forced", "excited by forces instead of moving supports"];
    assert_bad_input(&other("forced", forced), &said);
    assert!(!workshop.path("drawn").exists(), "nothing is drawn before");
    let kind = ["figure", first, "--with", second, "--kind", "structure"];
    assert_bad_input(&workshop.hammerbeam(&kind), &["--with lays response diagrams"]);
    let nowhere = workshop.hammerbeam(&["figure", first, "--with", "nowhere"]);
    assert_bad_input(&nowhere, &["there are no results in nowhere"]);
}
