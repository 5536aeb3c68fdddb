//! Checks a results folder against simulation: `completeness STUDY RESULTS [FREQUENCIES] [STATES] [LONGEST
//! PERIOD] [SEED]`.
#![allow(clippy::print_stdout, reason = "a command")]

use std::{env, fs, path::Path};

use hammerbeam_verification::{
    attractors::Effort,
    completeness::check,
    results::{Failure, Results},
};

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [study, folder, numbers @ ..] = arguments.as_slice() else {
        return Err("a study and its results".into());
    };
    let number = |place: usize, default: usize| numbers.get(place).map_or(Ok(default), |text| text.parse());
    let (frequencies, states, longest, seed) =
        (number(0, 200)?, number(1, 100)?, number(2, 8)?, number(3, 1)?);
    let results = Results::read(&fs::read_to_string(study)?, Path::new(folder))?;
    let effort = Effort { states, longest, patience: 1200 };
    let report = check(&results, frequencies, &effort, seed as u64)?;
    println!("{} branches, {} frequencies", results.branches().len(), report.frequencies);
    println!("{} motions, {} of them did not settle", report.motions, report.restless);
    for (period, found) in report.found.iter().enumerate().skip(1) {
        let missing = report.missing.iter().filter(|attractor| attractor.period() == period).count();
        println!("period {period}: {found} attractors, {missing} on no branch");
    }
    for missing in &report.missing {
        let (period, at) = (missing.period(), missing.frequency_hz);
        println!("missing: period {period} at {at} Hz, {} motions", missing.motions);
    }
    Ok(())
}
