//! Branches over another parameter than the frequency: a response diagram for each piece of the study.

use hammerbeam_figure::{ResponseCurve, ResponseDiagram};
use hammerbeam_results::{Store, StoreError, store::PieceRecord};
use hammerbeam_study::StudyFile;

use crate::{
    Album, DrawingError, FigureSelection,
    branches::point,
    outputs::shown_outputs,
    parameter::{file_name, parameter_axis},
    response::{quantities, settings},
};

/// Draws every `[[vary]]` of the study.
pub fn draw(
    store: &Store,
    file: &StudyFile,
    selection: &FigureSelection,
    drawn: &mut impl Album,
) -> Result<(), DrawingError> {
    let shown = shown_outputs(store, file)?;
    for piece in
        store.pieces()?.into_iter().filter(|piece| !piece.kind.is_curve() && !piece.branches.is_empty())
    {
        let (curves, frequency_hz) = curves_of(store, &piece)?;
        let title = store.about("title")?;
        let diagram = ResponseDiagram {
            title: format!("{title}, {}", drawn.frequency_unit().words(frequency_hz))
                .trim_start_matches(", ")
                .to_owned(),
            parameter: Some(parameter_axis(&piece.parameter)),
            curves,
            ..ResponseDiagram::default()
        };
        let detail = selection.detail_over(Some(&piece.parameter));
        let settings = settings(selection.scale, detail, drawn);
        for (word, quantity) in quantities(&diagram.curves) {
            let name = format!("vary_{}_{}_{word}", piece.place, file_name(&piece.parameter));
            drawn.add_unless_empty(&name, diagram.draw_with(&[quantity], &settings));
        }
        for shown in &shown {
            let place = format!("vary_{}_{}", piece.place, file_name(&piece.parameter));
            let name = format!("{place}_output_{}", shown.file_name());
            let figure = shown.draw(store, &piece.branches, &diagram, &settings)?;
            drawn.add_unless_empty(&name, figure);
        }
    }
    Ok(())
}

/// The branches of a piece, and the frequency that they are all at.
fn curves_of(store: &Store, piece: &PieceRecord) -> Result<(Vec<ResponseCurve>, f64), StoreError> {
    let mut curves = Vec::new();
    let mut frequency_hz = f64::NAN;
    for branch in &piece.branches {
        let mut points = Vec::new();
        store.each_row::<StoreError>(branch, |row| {
            frequency_hz = row.frequency_hz;
            points.push(point(&row));
            Ok(())
        })?;
        curves.push(ResponseCurve { period_multiple: branch.period_multiple, points });
    }
    Ok((curves, frequency_hz))
}
