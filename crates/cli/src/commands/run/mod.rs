//! `hammerbeam run`: everything a study asks for, into one results folder, or into one for each of a family.

mod family;
mod summary;

use hammerbeam_jobs::PreparedStudy;

use crate::{args::RunOptions, failure::Failure, interrupt::Interrupt, output::Output};
use summary::run_into;

pub fn run(options: &RunOptions, output: Output) -> Result<(), Failure> {
    if !options.vary_set.is_empty() {
        return family::run(options, output);
    }
    let file = options.study.read()?;
    file.forced()?;
    let study = PreparedStudy::new(file)?;
    let interrupt = Interrupt::listen(output)?;
    let summary = run_into(&options.out, &study, options, (output, &interrupt))?;
    output.give(&summary.report, || summary.text())
}
