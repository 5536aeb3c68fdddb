//! The same physics written another way has the same answers: branches, events, orbits, contacts,
//! multipliers, and verification agrees with every solution.
//!
//! Four relations over the studies of `studies/` on short ranges and the ten of `verification/studies/`. By
//! default quick studies are held against one relation each; `HAMMERBEAM_EXTENSIVE=1` takes all relations of
//! all studies. Tolerances have their reasons in `relations/compare.rs`.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use hammerbeam_verification::relations::{Answers, Limits, Relation, Units, differences};
use toml::{Table, Value};

use crate::common::extensive;

/// Odd factors; smaller ones where a density has to remain that of a material.
fn relations(study: &Table) -> [Relation; 4] {
    let is_beam = study["structure"].as_table().unwrap().contains_key("density_kg_m3");
    let odd = Units { mass: 3.7, length: 0.131, time: 17.3 };
    let units = if is_beam { Units { mass: 0.37, length: 0.631, time: 1.73 } } else { odd };
    [Relation::Units(units), Relation::Shifted(0.137), Relation::Mirrored, Relation::Swapped]
}

/// Holds a study against its relation of the default suite, or against all of them; a longer study has none
/// by default.
fn check(text: &str, by_default: Option<usize>) {
    if by_default.is_none() && !extensive() {
        return;
    }
    let study: Table = text.parse().unwrap();
    let reference = answers(&study, Units::SI);
    assert!(reference.solutions > 10, "{reference:?}");
    for (number, relation) in relations(&study).iter().enumerate() {
        if Some(number) == by_default || extensive() {
            let found = differences(&reference, &answers(&relation.of(&study), relation.units()));
            let in_words: Vec<String> = found.iter().map(ToString::to_string).collect();
            assert!(found.is_empty(), "{relation:?}:\n{}", in_words.join("\n"));
        }
    }
}

fn answers(study: &Table, units: Units) -> Answers {
    let folder = tempfile::tempdir().unwrap();
    Answers::of(study, units, &Limits::default(), folder.path()).unwrap()
}

/// A study over a part of its range, in steps of a hundredth of that, and searched at four frequencies.
fn shortened(text: &str, range_hz: [f64; 2]) -> String {
    let mut study: Table = text.parse().unwrap();
    let excitation = study["excitation"].as_table_mut().unwrap();
    excitation.insert("frequency_hz".into(), range_hz.to_vec().into());
    study.remove("figures");
    let step = (range_hz[1] - range_hz[0]) / 100.0;
    let search: Table = "frequencies = 4\nstarts = 4\ntrials = 4".parse().unwrap();
    study.insert("continuation".into(), Table::from_iter([("max_step_hz".into(), step.into())]).into());
    study.insert("search".into(), Value::Table(search));
    study.to_string()
}

macro_rules! own {
    ($name:ident, $file:literal, $relation:expr) => {
        #[test]
        fn $name() {
            check(include_str!(concat!("../studies/", $file, ".toml")), $relation);
        }
    };
}

macro_rules! part_of {
    ($name:ident, $file:literal, $range:expr, $relation:expr) => {
        #[test]
        fn $name() {
            check(&shortened(include_str!(concat!("../../studies/", $file, ".toml")), $range), $relation);
        }
    };
}

own!(gear_pair_with_backlash, "gear-pair-with-backlash", Some(3));
own!(tube_in_a_hole, "tube-in-a-hole", None);
own!(snubber_with_loss, "snubber-with-loss", Some(0));
own!(switch, "switch", Some(1));
own!(mass_chain, "mass-chain", None);
own!(symmetric_stops, "symmetric-stops", None);
own!(weakly_damped_beam, "weakly-damped-beam", None);
own!(impact_pair, "impact-pair", Some(0));
own!(preloaded_joint, "preloaded-joint", Some(2));
own!(bouncing_mass, "bouncing-mass", Some(1));

part_of!(bilinear_oscillator, "bilinear-oscillator", [0.06, 0.064], Some(0));
part_of!(duffing, "duffing", [0.18, 0.3], Some(2));
part_of!(impact_oscillator, "impact-oscillator", [0.11, 0.2], Some(0));
part_of!(two_masses, "two-masses", [4.0, 6.0], Some(0));
part_of!(beam_between_stops, "beam-between-stops", [8.0, 12.0], None);
part_of!(beam_with_stop_one_dof, "beam-with-stop-one-dof", [30.0, 40.0], None);

/// The answers to a bilinear oscillator do not depend on the size of the force.
#[test]
fn response_of_a_bilinear_oscillator_is_proportional_to_its_force() {
    let text = shortened(include_str!("../../studies/bilinear-oscillator.toml"), [0.06, 0.064]);
    let study: Table = text.parse().unwrap();
    let reference = answers(&study, Units::SI);
    let forces: &[f64] = if extensive() { &[1.1, 0.3, 3.0, 12.5, 1e-3, 1e6] } else { &[1.1] };
    for &force in forces {
        let mut other = study.clone();
        other["excitation"].as_table_mut().unwrap().insert("amplitude_n".into(), force.into());
        // A mass and a spring as they are, and a length in which the force is one.
        let found = differences(&reference, &answers(&other, Units { length: force, ..Units::SI }));
        let in_words: Vec<String> = found.iter().map(ToString::to_string).collect();
        assert!(found.is_empty(), "{force} N:\n{}", in_words.join("\n"));
    }
}
