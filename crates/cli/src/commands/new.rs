//! `hammerbeam new`: a commented starter study.

use std::{
    fs,
    io::{self, Write},
    path::Path,
};

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
    // The user named the folder.
    let refused = |what: &str, path: &Path, error: io::Error| {
        Failure::BadInput(format!("cannot {what} {}: {error}", path.display()))
    };
    fs::create_dir_all(folder).map_err(|error| refused("make", folder, error))?;
    let file = fs::File::create_new(&path);
    file.and_then(|mut file| file.write_all(STARTER.as_bytes()))
        .map_err(|error| refused("write", &path, error))?;
    let shown = path.display().to_string();
    output.give(&json!({ "study": shown }), || {
        format!(
            "{shown} is written. Next:\n  hammerbeam check {shown}\n  hammerbeam run {shown} --out {}",
            folder.join("results").display()
        )
    })?;
    Ok(())
}
