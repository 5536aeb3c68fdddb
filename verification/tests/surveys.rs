//! Every attractor that an integrator finds which shares nothing with the library is on a branch of a run
//! with the search as it is by default: machines of different kinds, periods 1 to 4
//! ([docs](../../docs/validation/completeness.md)). `HAMMERBEAM_EXTENSIVE=1` looks at all of them, at more
//! frequencies.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use crate::common::extensive;
use hammerbeam_verification::{
    attractors::SimulationEffort, completeness::check, plain::Equations, results::Results,
};

/// The study with the search as it is by default, and periods 1 to 4.
fn asked(text: &str) -> toml::Table {
    let mut study: toml::Table = text.parse().unwrap();
    study.remove("search");
    study.insert("response".into(), "period_multiples = [1, 2, 3, 4]".parse::<toml::Table>().unwrap().into());
    study
}

/// * `frequencies`, `states`: at how many random frequencies motion begins, and at how many states.
fn survey((name, text): (&str, &str), (frequencies, states): (usize, usize)) {
    let study = asked(text);
    let folder = tempfile::tempdir().unwrap();
    let results = Results::of_run(&study.to_string(), folder.path(), 2).unwrap();
    let plain = Equations::read(&study, &results.model).unwrap();
    let effort = SimulationEffort { states, longest: 4, patience: 1200 };
    let report = check(&results, Some(&plain), frequencies, &effort, 5).unwrap();
    assert!(report.attractors() >= frequencies - 1, "{name}: {report:?}");
    assert!(report.missing.is_empty(), "{name}: {report:?}");
}

macro_rules! studies {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../studies/", $name, ".toml")))),*]
    };
}

/// The quick ones first.
const STUDIES: &[(&str, &str)] = studies! {
    "switch" "impact-pair" "snubber-with-loss" "unequal-stops" "preloaded-joint" "symmetric-stops"
    "mass-chain" "gear-pair-with-backlash" "bouncing-mass" "tube-in-a-hole"
};
/// Its highest mode makes short steps.
const BEAM: &[(&str, &str)] = studies! { "weakly-damped-beam" };

#[test]
fn no_attractor_of_an_independent_survey_is_on_no_branch() {
    if !extensive() {
        STUDIES[..2].iter().for_each(|study| survey(*study, (4, 6)));
        return;
    }
    STUDIES.iter().for_each(|study| survey(*study, (12, 12)));
    BEAM.iter().for_each(|study| survey(*study, (4, 6)));
}
