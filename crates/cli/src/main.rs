//! The `hammerbeam` command: flags, terminal text and exit codes around the jobs.

mod args;
mod commands;
mod compare_args;
mod failure;
mod figure_args;
mod initial;
mod input_args;
mod interrupt;
mod kept;
mod matrix_report;
mod memory;
mod motion_args;
mod numbers;
mod output;
mod overlay_args;
mod pace;
mod progress;
mod series;
mod signal_args;
mod ticker;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use hammerbeam_figure::FrequencyUnit;

use args::{Arguments, Command};
use failure::Failure;
use output::Output;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refused) if refused.use_stderr() => refused.exit(),
        Err(help) => return ended(Output::default(), output::give_text(&help.render().ansi().to_string())),
    };
    let frequency_unit = if arguments.angular { FrequencyUnit::RadPerSecond } else { FrequencyUnit::Hertz };
    let output = Output { json: arguments.json, frequency_unit };
    let result = match &arguments.command {
        Command::New(options) => commands::new::run(options, output),
        Command::Check(options) => commands::check::run(options, output),
        Command::Modes(options) => commands::modes::run(options, output),
        Command::Import(options) => commands::import::run(options, output),
        Command::Run(options) => commands::run::run(options, output),
        Command::Orbit(options) => commands::orbit::run(options, output),
        Command::Simulate(options) => commands::simulate::run(options, output),
        Command::Sweep(options) => commands::sweep::run(options, output),
        Command::Lyapunov(options) => commands::lyapunov::run(options, output),
        Command::Basins(options) => commands::basins::run(options, output),
        Command::Update(options) => commands::update::run(options, output),
        Command::Signal(command) => commands::signal::run(command, output),
        Command::Compare(options) => commands::compare::run(options, output),
        Command::Overlay(options) => commands::overlay::run(options, output),
        Command::Rig(options) => commands::rig::run(options, output),
        Command::Figure(options) => commands::figure::run(options, output),
        Command::Export(options) => commands::export::run(options, output),
        Command::Verify(options) => commands::verify::run(options, output),
        Command::Completions(options) => commands::completions::run(options, output),
        Command::Man(options) => commands::man::run(options, output),
    };
    ended(output, result)
}

/// Reports a failure; exit code of the process.
fn ended(output: Output, result: Result<(), Failure>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            output.failure(&failure);
            failure.exit_code()
        }
    }
}
