//! `hammerbeam completions`: what a shell needs to complete commands and flags.

use clap::CommandFactory;
use serde_json::json;

use crate::{
    args::{Arguments, CompletionsOptions},
    failure::Failure,
    output::{Output, give_text},
};

pub fn run(options: &CompletionsOptions, output: Output) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Arguments::command(), "hammerbeam", &mut script);
    let script = String::from_utf8_lossy(&script);
    if output.json {
        let document = json!({ "shell": options.shell.to_string(), "script": script });
        return output.give(&document, String::new);
    }
    // As it is: a shell reads it, not a terminal.
    give_text(&script)
}
