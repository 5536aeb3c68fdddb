//! `hammerbeam figure`: pictures of everything in a results folder.

use std::path::Path;

use hammerbeam_drawing::{
    DrawSettings, DrawnFiles, FigureFormat, FigureKind, FigureSelection, draw, draw_into, ensure_alike,
    ensure_details, orbit::no_branch_crosses,
};
use hammerbeam_figure::plain_number;
use hammerbeam_jobs::{PreparedStudy, StoredBranches, pool::threads};
use hammerbeam_results::{Store, StoreError};
use hammerbeam_study::{StudyFile, file::DrawnOrbit};
use serde_json::json;

use crate::{
    failure::Failure, figure_args::FigureOptions, interrupt::Interrupt, output::Output, watch::Watch,
};

pub fn run(options: &FigureOptions, output: Output) -> Result<(), Failure> {
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let store = Store::open(&options.results).map_err(|error| of_family(&options.results, error))?;
    let snapshot = store.snapshot()?;
    let PreparedStudy { file, model } = PreparedStudy::of_store(&store)?;
    let folder = options.out.as_deref().unwrap_or(&options.results);
    let selection = selection(options, &file);
    if !selection.with.is_empty() && !selection.kinds.contains(&FigureKind::Response) {
        return Err(Failure::BadInput(
            "--with lays response diagrams over one another, and --kind leaves them out".to_owned(),
        ));
    }
    if let Some(detail) = selection.details.iter().find(|detail| !selection.kinds.contains(&detail.kind())) {
        return Err(Failure::BadInput(format!(
            "--detail {detail} is a part of diagrams that --kind leaves out"
        )));
    }
    ensure_alike(&selection, &file)?;
    ensure_details(&store, &selection)?;
    if selection.kinds.contains(&FigureKind::Orbits) {
        refuse_unknown(store.folder(), &file, &options.orbit)?;
    }
    let formats: Vec<FigureFormat> = options.format.iter().map(|name| (*name).into()).collect();
    let settings = DrawSettings {
        threads: threads(options.jobs),
        resolution: options.resolution,
        frequency_unit: output.frequency_unit,
        formats: FigureFormat::ALL.into_iter().filter(|format| formats.contains(format)).collect(),
    };
    let drawn = draw_into::<Failure>(folder, settings, &mut watch, |drawn| {
        Ok(draw(&store, (&file, &model), &selection, drawn)?)
    });
    drop(snapshot);
    let DrawnFiles { names: files, refused, lacking } = drawn?;
    if files.is_empty() {
        let results = options.results.display();
        return Err(Failure::NoResult(format!("{results} holds nothing of what was asked for to draw")));
    }
    let refused: Vec<_> =
        refused.iter().map(|(name, reason)| json!({ "figure": name, "reason": reason })).collect();
    let document =
        json!({ "folder": folder, "files": files, "not_drawn": refused, "characters_not_in_font": lacking });
    output.give(&document, || {
        format!("{} files in {}:\n{}", files.len(), folder.display(), files.join("\n"))
    })?;
    Ok(())
}

/// A folder without results that holds those of a family: how to draw them.
fn of_family(folder: &Path, error: StoreError) -> Failure {
    let has_none = matches!(error, StoreError::NoResults { .. });
    let failure = Failure::from(error);
    let members = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut members: Vec<String> = members
        .filter(|member| has_none && member.is_dir() && Store::open(member).is_ok())
        .map(|member| member.display().to_string())
        .collect();
    members.sort_unstable();
    match (&failure, members.as_slice()) {
        (Failure::BadInput(message), [first, others @ ..]) => {
            let with: String = others.iter().map(|other| format!(" --with {other}")).collect();
            Failure::BadInput(format!(
                "{message}; it holds results of {}: draw them over one another with `hammerbeam figure \
                {first}{with}`",
                members.join(", ")
            ))
        }
        _ => failure,
    }
}

/// What the options ask for: of what they do not name, everything.
fn selection(options: &FigureOptions, file: &StudyFile) -> FigureSelection {
    let all = FigureSelection::of(file);
    let kinds: Vec<FigureKind> = options.kind.iter().map(|name| (*name).into()).collect();
    FigureSelection {
        kinds: if kinds.is_empty() { all.kinds } else { kinds },
        scale: options.scale.into(),
        details: options.detail.clone(),
        with: options.with.clone(),
        orbits: if options.orbit.is_empty() { all.orbits } else { options.orbit.clone() },
        low_pass_hz: options.low_pass.or(all.low_pass_hz),
    }
}

/// Refuses an orbit that the user asks for where no stored branch has one.
fn refuse_unknown(folder: &Path, file: &StudyFile, orbits: &[DrawnOrbit]) -> Result<(), Failure> {
    if orbits.is_empty() {
        return Ok(());
    }
    let branches = StoredBranches::open(folder, file)?;
    for &DrawnOrbit { frequency_hz, period_multiple } in orbits {
        let ranges = branches.ranges(|record| record.period_multiple == period_multiple);
        if !ranges.iter().any(|(low, high)| (*low..=*high).contains(&frequency_hz)) {
            let low = ranges.iter().map(|range| range.0).fold(f64::INFINITY, f64::min);
            let high = ranges.iter().map(|range| range.1).fold(0.0, f64::max);
            let there = match ranges.len() {
                0 => "there is no such branch".to_owned(),
                _ => format!("they lie between {} and {} Hz", plain_number(low), plain_number(high)),
            };
            let missing = no_branch_crosses(period_multiple, frequency_hz);
            return Err(Failure::BadInput(format!("--orbit: {missing}; {there}")));
        }
    }
    Ok(())
}
