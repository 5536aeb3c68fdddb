//! `hammerbeam export`: stored results for other programs.

use hammerbeam_study::{Store, export_csv};
use serde_json::json;

use crate::{
    args::{ExportOptions, Format},
    failure::Failure,
    output::Output,
};

pub fn run(options: &ExportOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let folder = options.out.clone().unwrap_or_else(|| options.results.join("export"));
    let exported = match options.format {
        Format::Csv => export_csv(&store, &folder)?,
    };
    let path = exported.path.display().to_string();
    let events_path = exported.events_path.display().to_string();
    output.give(&json!({ "files": [path, events_path], "rows": exported.rows }), || {
        format!("{path}: {} solutions\n{events_path}: what happens at which of them", exported.rows)
    });
    Ok(())
}
