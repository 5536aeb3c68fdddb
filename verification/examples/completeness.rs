//! Checks a results folder against simulation: `completeness STUDY RESULTS [FREQUENCIES] [STATES] [LONGEST
//! PERIOD] [SEED] [--plain]`. With `--plain` by the integrator that shares nothing with the library, for
//! lumped structures.
#![allow(clippy::print_stdout, reason = "a command")]

use std::{env, fs, path::Path};

use hammerbeam_verification::{
    attractors::SimulationEffort,
    completeness::check,
    plain::Equations,
    results::{BoxedError, Results},
};

fn main() -> Result<(), BoxedError> {
    let mut arguments: Vec<String> = env::args().skip(1).collect();
    let is_plain = arguments.iter().any(|argument| argument == "--plain");
    arguments.retain(|argument| argument != "--plain");
    let [study, folder, numbers @ ..] = arguments.as_slice() else {
        return Err("a study and its results".into());
    };
    let number = |place: usize, default: usize| numbers.get(place).map_or(Ok(default), |text| text.parse());
    let (frequencies, states, longest, seed) =
        (number(0, 200)?, number(1, 100)?, number(2, 8)?, number(3, 1)?);
    let text = fs::read_to_string(study)?;
    let results = Results::read(&text, Path::new(folder))?;
    let plain = is_plain.then(|| Equations::read(&text.parse()?, &results.model)).transpose()?;
    let effort = SimulationEffort { states, longest, patience: 1200 };
    let report = check(&results, plain.as_ref(), frequencies, &effort, seed as u64)?;
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
