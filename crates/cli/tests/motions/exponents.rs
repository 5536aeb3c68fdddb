//! `lyapunov`: exponents of one motion and of a series.

use super::{DUFFING, column, document, table};
use crate::common::{BEAM, Workshop, stdout};

#[test]
fn lyapunov_tells_exponents_their_sum_and_their_convergence() {
    let workshop = Workshop::with(BEAM);
    let arguments =
        ["lyapunov", "study.toml", "--frequency", "53", "--periods", "300", "--out", "out", "--json"];
    let document = document(&workshop, &arguments);
    let exponents = document["exponents_per_s"].as_array().unwrap();
    assert_eq!(exponents.len(), 12);
    assert_eq!(document["half_widths_per_s"].as_array().unwrap().len(), 12);
    assert_eq!(document["largest_exponent"], "positive");
    let number = |key: &str| document[key].as_f64().unwrap();
    assert!((number("sum_per_s") / number("divergence_per_s") - 1.0).abs() < 1e-6);
    assert!(number("zero_one_k") > 0.8);
    assert!(number("kaplan_yorke_dimension") > 1.0);
    assert_eq!(table(&workshop, "out/exponents.csv").len(), 13);
    assert_eq!(table(&workshop, "out/spectra.csv").len(), 2);
    assert_eq!(table(&workshop, "out/section.csv").len(), 301);
    let convergence = table(&workshop, "out/convergence.csv");
    assert_eq!(convergence.len() - 1, document["convergence"].as_array().unwrap().len());
    let last = *column(&convergence, "exponent_1_per_s").last().unwrap();
    assert!((last / exponents[0].as_f64().unwrap() - 1.0).abs() < 1e-12, "summed in another order");
}

#[test]
fn exponents_over_a_series_of_frequencies_are_those_of_each() {
    let workshop = Workshop::with(DUFFING);
    let of = |more: &[&str]| {
        let words = ["lyapunov", "study.toml", "--periods", "100", "--json", "--frequency"];
        document(&workshop, &[&words[..], more].concat())
    };
    let series = of(&["0.1", "--to", "0.3", "--step", "0.1"]);
    let spectra = series["spectra"].as_array().unwrap();
    assert_eq!(spectra.len(), 3);
    for (spectrum, frequency_hz) in spectra.iter().zip(["0.1", "0.2", "0.3"]) {
        assert_eq!(spectrum["exponents_per_s"], of(&[frequency_hz])["exponents_per_s"], "{frequency_hz}");
    }
}

/// What the help says of `--to`: above the first frequency, or the same.
#[test]
fn a_series_may_be_of_one_frequency_and_the_help_says_so() {
    let workshop = Workshop::with(DUFFING);
    for (command, options) in [
        ("lyapunov", &["--frequency", "0.1", "--to", "0.1", "--periods", "20"][..]),
        ("sweep", &["--from", "0.1", "--to", "0.1"]),
    ] {
        let help = workshop.hammerbeam(&[command, "--help"]);
        let words = stdout(&help).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("above the first, or the same for that one alone"), "{words}");
        let document = document(&workshop, &[&[command, "study.toml", "--json"], options].concat());
        let rows = document.get("motions").or(document.get("spectra")).unwrap();
        assert_eq!(rows.as_array().unwrap().len(), 1);
        assert_eq!(rows[0]["frequency_hz"], 0.1);
    }
}

/// The examples with published exponents (Sprott 2003, appendix A), averaged over a fiftieth of what their
/// first lines ask for.
#[test]
fn exponents_of_the_chaotic_examples_are_the_published_ones() {
    let examples = [
        (include_str!("../../../../studies/ueda.toml"), [0.1034, -0.1534]),
        (include_str!("../../../../studies/two-wells.toml"), [0.1572, -0.4072]),
    ];
    for (study, published) in examples {
        let workshop = Workshop::with(study);
        let words = [
            "lyapunov",
            "study.toml",
            "--frequency",
            "1 rad/s",
            "--periods",
            "2000",
            "--json",
            "--out",
            "out",
        ];
        let document = document(&workshop, &words);
        for (index, published) in published.into_iter().enumerate() {
            let value = document["exponents_per_s"][index].as_f64().unwrap();
            let half_width = document["half_widths_per_s"][index].as_f64().unwrap();
            assert!((value - published).abs() < 2.0 * half_width, "{value} +- {half_width}, {published}");
            assert!(half_width < 0.02, "{half_width}");
        }
    }
}
