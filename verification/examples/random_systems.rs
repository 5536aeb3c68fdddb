//! Random systems in two systems of units: `random_systems FIRST COUNT [SOLUTIONS]`. One line for each
//! system, and one for each difference between its answers in the one and in the other units, or with the
//! independent integrator. `random_systems SEED` prints the study of a seed, `random_systems SEED 0` the same
//! in the other units.
#![allow(clippy::print_stdout, reason = "a command")]

use std::{env, time::Instant};

use hammerbeam_verification::{
    attractors::Random,
    random_study::random_study,
    relations::{Answers, AnswersError, Limits, Units, differences},
    results::BoxedError,
};

fn main() -> Result<(), BoxedError> {
    let mut numbers = env::args().skip(1).map(|text| text.parse::<u64>());
    let first = numbers.next().ok_or("the first seed and how many")??;
    let Some(count) = numbers.next().transpose()? else {
        print!("{}", random_study(first));
        return Ok(());
    };
    if count == 0 {
        print!("{}", random_units(first).rescaled(&random_study(first).parse()?));
        return Ok(());
    }
    let solutions = numbers.next().transpose()?.unwrap_or(20_000);
    let limits = Limits { solutions, ..Limits::default() };
    let (mut same, mut different, mut left) = (0, 0, 0);
    for seed in first..first + count {
        let begun = Instant::now();
        let units = random_units(seed);
        let study: toml::Table = random_study(seed).parse()?;
        let pair = answers(&study, Units::SI, &limits)
            .and_then(|there| Ok((there, answers(&units.rescaled(&study), units, &limits)?)));
        let seconds = begun.elapsed().as_secs_f64();
        match pair {
            Ok((study, other)) => {
                let found = differences(&study, &other);
                let (branches, rows, events) = (study.branches.len(), study.solutions, study.events.len());
                let count = found.len();
                println!(
                    "{seed}: {branches} branches, {rows} rows, {events} events, {count} differences, \
                    {seconds:.1} s"
                );
                found.iter().for_each(|difference| println!("{seed}:   {difference}"));
                if found.is_empty() { same += 1 } else { different += 1 }
            }
            Err(error) => {
                println!("{seed}: not compared, {error}, {seconds:.1} s");
                left += 1;
            }
        }
    }
    println!("{same} the same, {different} with differences, {left} not compared");
    Ok(())
}

fn answers(study: &toml::Table, units: Units, limits: &Limits) -> Result<Answers, AnswersError> {
    let folder = tempfile::tempdir().map_err(BoxedError::from)?;
    Answers::of(study, units, limits, folder.path())
}

/// Mass and length up to a thousand times larger or smaller, times up to thirty: accelerations stay within
/// what a study file may have.
fn random_units(seed: u64) -> Units {
    let mut random = Random::new(seed ^ 0x5EED);
    (0..8).for_each(|_| _ = random.part());
    let mut factor = |powers: f64| 10.0_f64.powf(powers * (2.0 * random.part() - 1.0));
    Units { mass: factor(3.0), length: factor(3.0), time: factor(1.5) }
}
