//! Checks relations between the answers to a study: `relations STUDY...`.
#![allow(clippy::print_stdout, reason = "a command")]

use std::{env, fs};

use hammerbeam_verification::{
    relations::{Answers, Limits, Relation, Units, differences},
    results::BoxedError,
};

const RELATIONS: [Relation; 4] = [
    Relation::Units(Units { mass: 3.7, length: 0.131, time: 17.3 }),
    Relation::Shifted(0.137),
    Relation::Mirrored,
    Relation::Swapped,
];

fn main() -> Result<(), BoxedError> {
    for path in env::args().skip(1) {
        let study = fs::read_to_string(&path)?.parse()?;
        let answers = |relation: Option<&Relation>| {
            let (study, units) = relation.map_or((toml::Table::clone(&study), Units::SI), |relation| {
                (relation.of(&study), relation.units())
            });
            let folder = tempfile::tempdir()?;
            Ok::<_, BoxedError>(Answers::of(&study, units, &Limits::default(), folder.path())?)
        };
        let reference = answers(None)?;
        println!(
            "{path}: {} branches, {} solutions, {} events",
            reference.branches.len(),
            reference.solutions,
            reference.events.len()
        );
        for relation in &RELATIONS {
            for difference in differences(&reference, &answers(Some(relation))?) {
                println!("  {relation:?}: {difference}");
            }
        }
    }
    Ok(())
}
