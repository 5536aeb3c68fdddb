//! `hammerbeam export`: stored results for other programs.

use std::path::{Path, PathBuf};

use hammerbeam_jobs::{
    Observer, PreparedStudy,
    chosen_orbits::{OrbitChoice, chosen_orbits, orbit_tables},
};
use hammerbeam_results::{
    Store,
    arrays::{TableFormat, all_tables, write_tables},
    export_csv, export_states,
    whole_file::{ensure_written, subfolder},
};
use serde_json::json;

use crate::{args::ExportOptions, failure::Failure, interrupt::Interrupt, output::Output, watch::Watch};

/// What was written.
struct Written {
    /// The files.
    files: Vec<PathBuf>,
    /// What is said of the first of them.
    words: Vec<&'static str>,
    /// Solutions on branches over the frequency.
    rows: u64,
}

pub fn run(options: &ExportOptions, output: Output) -> Result<(), Failure> {
    let interrupt = Interrupt::listen(output)?;
    match export(options, output, &interrupt) {
        // Whatever reading says of being left.
        Err(_) if interrupt.raised() => Err(Failure::Interrupted(
            "interrupted; tables that were finished are kept, and nothing is left of the others".to_owned(),
        )),
        exported => exported,
    }
}

fn export(options: &ExportOptions, output: Output, interrupt: &Interrupt) -> Result<(), Failure> {
    let mut store = Store::open(&options.results)?;
    let asked = interrupt.clone();
    store.read_unless(move || asked.raised())?;
    // What is read ends in a moment, and files are written to their end.
    interrupt.is_in_order();
    let folder = match &options.out {
        Some(folder) => folder.clone(),
        None => subfolder(&options.results, "export")?,
    };
    let mut written = match options.format.into() {
        TableFormat::Csv => csv(&store, &folder, options.states)?,
        other => columns(&store, &folder, (other, options.states))?,
    };
    written.files.extend(orbits(options, &store, &folder, interrupt)?);
    ensure_written(Path::new(""), &written.files)?;
    let files: Vec<String> = written.files.iter().map(|path| path.display().to_string()).collect();
    output.give(&json!({ "files": files, "rows": written.rows }), || {
        let said = |(place, file): (usize, &String)| match written.words.get(place) {
            Some(words) if place == 0 => format!("{file}: {} {words}", written.rows),
            Some(words) => format!("{file}: {words}"),
            None => file.clone(),
        };
        files.iter().enumerate().map(said).collect::<Vec<_>>().join("\n")
    })?;
    Ok(())
}

fn csv(store: &Store, folder: &Path, with_states: bool) -> Result<Written, Failure> {
    let exported = export_csv(store, folder)?;
    let mut files = vec![exported.path, exported.events_path, exported.ends_path];
    files.extend(exported.varied_paths.into_iter().chain(exported.output_paths));
    files.extend(exported.motion_paths);
    if with_states {
        files.extend(export_states(store, folder)?);
    }
    let words =
        vec!["solutions", "what happens at which of them", "how branches ended, and the states there"];
    Ok(Written { files, words, rows: exported.rows })
}

fn columns(
    store: &Store,
    folder: &Path,
    (format, with_states): (TableFormat, bool),
) -> Result<Written, Failure> {
    let tables = all_tables(store, with_states)?;
    let rows = tables.first().map_or(0, |branches| branches.rows() as u64);
    Ok(Written { files: write_tables(&tables, folder, ("results", format))?, words: vec!["solutions"], rows })
}

/// The orbits that are asked for, if there are such.
fn orbits(
    options: &ExportOptions,
    store: &Store,
    folder: &Path,
    interrupt: &Interrupt,
) -> Result<Vec<PathBuf>, Failure> {
    if options.frequency.is_empty() && options.event.is_empty() {
        return Ok(Vec::new());
    }
    let study = PreparedStudy::of_store(store)?;
    let choice = OrbitChoice {
        branches: options.branch.clone(),
        frequencies_hz: options.frequency.clone(),
        events: options.event.clone(),
    };
    let found = chosen_orbits(&study, &options.results, &choice)?;
    if found.is_empty() {
        return Err(Failure::NoResult("no stored orbit fits what is asked for".to_owned()));
    }
    let mut watch = Watch::new(interrupt.clone());
    let tables = orbit_tables(&study.model, &found, options.samples as usize, &mut watch);
    watch.finishing();
    Ok(write_tables(&tables?, folder, ("orbits", options.format.into()))?)
}
