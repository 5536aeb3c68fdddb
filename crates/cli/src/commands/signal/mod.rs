//! `hammerbeam signal`: measured or exported time series.

mod filter;
mod input;
mod spectrum;

use crate::{failure::Failure, output::Output, signal_args::SignalCommand};

pub fn run(command: &SignalCommand, output: Output) -> Result<(), Failure> {
    match command {
        SignalCommand::Filter(options) => filter::run(options, output),
        SignalCommand::Spectrum(options) => spectrum::run(options, output),
    }
}
