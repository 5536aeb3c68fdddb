//! `hammerbeam new`: a commented starter study.

use hammerbeam_study::whole_file::replace;
use serde_json::json;

use crate::{args::NewOptions, failure::Failure, output::Output};

/// The starter study.
const STARTER: &str = include_str!("../starter.toml");

pub fn run(options: &NewOptions, output: Output) -> Result<(), Failure> {
    let folder = &options.folder;
    let path = folder.join("study.toml");
    if path.exists() {
        return Err(Failure::BadInput(format!("{} is already there and is not overwritten", path.display())));
    }
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::BadInput(format!("{} is not a folder", folder.display())));
    }
    replace(&path, STARTER.as_bytes())?;
    let shown = path.display().to_string();
    output.give(&json!({ "study": shown }), || {
        format!(
            "{shown} is written. Next:\n  hammerbeam check {shown}\n  hammerbeam run {shown} --out {}",
            folder.join("results").display()
        )
    })?;
    Ok(())
}
