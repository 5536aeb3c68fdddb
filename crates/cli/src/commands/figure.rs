//! `hammerbeam figure`: pictures of everything in a results folder.

use hammerbeam_study::{Store, StudyFile};
use serde_json::json;

use crate::{
    args::{FigureKind, FigureOptions},
    failure::Failure,
    figures::{self, Drawn},
    output::Output,
};

pub fn run(options: &FigureOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let snapshot = store.snapshot()?;
    let file = StudyFile::parse("study.toml", store.about("study")?)?;
    let folder = options.out.as_deref().unwrap_or(&options.results);
    let mut drawn = Drawn::into(folder)?;
    let kinds = if options.kind.is_empty() { FigureKind::ALL.as_slice() } else { &options.kind };
    for kind in FigureKind::ALL.into_iter().filter(|kind| kinds.contains(kind)) {
        figures::draw_kind(&store, &file, (kind, options.scale), &mut drawn)?;
    }
    drop(snapshot);
    drawn.tell_refused();
    let Drawn { files, refused, .. } = drawn;
    if files.is_empty() {
        let results = options.results.display();
        return Err(Failure::NoResult(format!("{results} holds nothing of what was asked for to draw")));
    }
    let refused: Vec<_> =
        refused.iter().map(|(name, reason)| json!({ "figure": name, "reason": reason })).collect();
    output.give(&json!({ "folder": folder, "files": files, "not_drawn": refused }), || {
        format!("{} files in {}:\n{}", files.len(), folder.display(), files.join("\n"))
    });
    Ok(())
}
