//! `hammerbeam new`: a commented starter study.

use std::io;

use hammerbeam_results::whole_file::create;
use serde_json::json;

use crate::{args::NewOptions, failure::Failure, output::Output};

/// The starter study.
const STARTER: &str = include_str!("../starter.toml");

pub fn run(options: &NewOptions, output: Output) -> Result<(), Failure> {
    let folder = &options.folder;
    let path = folder.join("study.toml");
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::BadInput(format!("{} is not a folder", folder.display())));
    }
    create(&path, STARTER.as_bytes()).map_err(|error| match error.source.kind() {
        io::ErrorKind::AlreadyExists => {
            Failure::BadInput(format!("{} is already there and is not overwritten", path.display()))
        }
        _ => error.into(),
    })?;
    let shown = path.display().to_string();
    output.give(&json!({ "study": shown }), || {
        format!(
            "{shown} is written. Next:\n  hammerbeam check {shown}\n  hammerbeam run {shown} --out {}",
            folder.join("results").display()
        )
    })?;
    Ok(())
}
