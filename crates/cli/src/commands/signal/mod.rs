//! `hammerbeam signal`: measured or exported time series.

mod chain;
mod classify;
mod decrement;
mod envelope;
mod filter;
mod input;
mod lyapunov;
mod spectrum;

pub use chain::quantity;
pub use classify::word;
pub use input::{Input, open};

use crate::{failure::Failure, output::Output, signal_args::SignalCommand};

pub fn run(command: &SignalCommand, output: Output) -> Result<(), Failure> {
    match command {
        SignalCommand::Filter(options) => filter::run(options, output),
        SignalCommand::Spectrum(options) => spectrum::run(options, output),
        SignalCommand::Decrement(options) => decrement::run(options, output),
        SignalCommand::Classify(options) => classify::run(options, output),
        SignalCommand::Lyapunov(options) => lyapunov::run(options, output),
        SignalCommand::Envelope(options) => envelope::run(options, output),
        SignalCommand::Chain(options) => chain::run(options, output),
    }
}
