//! `hammerbeam figure`: pictures of everything in a results folder.

use hammerbeam_results::Store;
use hammerbeam_study::{Model, StudyFile};
use serde_json::json;

use super::run::threads;
use crate::{
    args::{FigureFormat, FigureKind, FigureOptions},
    failure::Failure,
    figures::{self, Drawn, Files, Wishes, orbit},
    interrupt::Interrupt,
    output::Output,
};

pub fn run(options: &FigureOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let snapshot = store.snapshot()?;
    let file = StudyFile::parse("study.toml", store.about("study")?)?;
    let model = Model::build(&file)?;
    let folder = options.out.as_deref().unwrap_or(&options.results);
    if wishes(options, &file).kinds.contains(&FigureKind::Orbits) {
        orbit::refuse_unknown(store.folder(), &file, &options.orbit)?;
    }
    let mut drawn = Drawn::into(folder)?.on(threads(options.jobs), Interrupt::listen(output)?);
    drawn.frequency_unit = output.frequency_unit;
    drawn.resolution = options.resolution;
    drawn.formats = FigureFormat::ALL.into_iter().filter(|format| options.format.contains(format)).collect();
    let wishes = wishes(options, &file);
    figures::draw(&store, (&file, &model), &wishes, &mut drawn)?;
    drop(snapshot);
    let Files { names: files, refused, lacking } = drawn.finish()?;
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

/// What the options ask for: of what they do not name, everything.
fn wishes(options: &FigureOptions, file: &StudyFile) -> Wishes {
    let all = Wishes::of(file);
    Wishes {
        kinds: if options.kind.is_empty() { all.kinds } else { options.kind.clone() },
        scale: options.scale,
        orbits: if options.orbit.is_empty() { all.orbits } else { options.orbit.clone() },
        low_pass_hz: options.low_pass.or(all.low_pass_hz),
    }
}
