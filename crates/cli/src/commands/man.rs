//! `hammerbeam man`: manual pages, one for the command and one for each of its commands.

use std::path::Path;

use clap::{Command, CommandFactory};
use clap_mangen::Man;
use hammerbeam_results::whole_file::replace;
use serde_json::json;

use crate::{
    args::{Arguments, ManOptions},
    failure::Failure,
    output::{Output, give_text},
};

/// A manual page with the name of its file.
struct Page {
    file: String,
    text: Vec<u8>,
}

pub fn run(options: &ManOptions, output: Output) -> Result<(), Failure> {
    let mut command = Arguments::command();
    command.build();
    let pages = pages(&command)?;
    if let Some(folder) = &options.out {
        return write(&pages, folder, output);
    }
    let first = pages.first().map_or_else(Default::default, |page| String::from_utf8_lossy(&page.text));
    if output.json {
        return output.give(&json!({ "page": first }), String::new);
    }
    give_text(&first)
}

fn write(pages: &[Page], folder: &Path, output: Output) -> Result<(), Failure> {
    for page in pages {
        replace(&folder.join(&page.file), &page.text)?;
    }
    let files: Vec<&str> = pages.iter().map(|page| page.file.as_str()).collect();
    let document = json!({ "folder": folder.display().to_string(), "files": files });
    output.give(&document, || format!("{} pages in {}", pages.len(), folder.display()))
}

/// The page of a command, then those of its commands.
fn pages(command: &Command) -> Result<Vec<Page>, Failure> {
    let man = Man::new(command.clone());
    let mut text = Vec::new();
    man.render(&mut text).map_err(|error| Failure::NoResult(format!("a page cannot be made: {error}")))?;
    let mut all = vec![Page { file: man.get_filename(), text }];
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        all.extend(pages(below)?);
    }
    Ok(all)
}
