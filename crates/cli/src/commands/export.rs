//! `hammerbeam export`: stored results for other programs.

use hammerbeam_results::{Store, export_csv, export_states, whole_file::subfolder};
use serde_json::json;

use crate::{
    args::{ExportOptions, Format},
    failure::Failure,
    output::Output,
};

pub fn run(options: &ExportOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let folder = match &options.out {
        Some(folder) => folder.clone(),
        None => subfolder(&options.results, "export")?,
    };
    let exported = match options.format {
        Format::Csv => export_csv(&store, &folder)?,
    };
    let states = options.states.then(|| export_states(&store, &folder)).transpose()?;
    let path = exported.path.display().to_string();
    let events_path = exported.events_path.display().to_string();
    let ends_path = exported.ends_path.display().to_string();
    let varied: Vec<String> = exported
        .varied_paths
        .iter()
        .chain(&exported.motion_paths)
        .chain(states.iter().flatten())
        .map(|path| path.display().to_string())
        .collect();
    let mut files = vec![path.clone(), events_path.clone(), ends_path.clone()];
    files.extend(varied.iter().cloned());
    output.give(&json!({ "files": files, "rows": exported.rows }), || {
        let first = format!(
            "{path}: {} solutions\n{events_path}: what happens at which of them\n{ends_path}: how branches ended, and the states there",
            exported.rows
        );
        std::iter::once(first).chain(varied).collect::<Vec<_>>().join("\n")
    })?;
    Ok(())
}
