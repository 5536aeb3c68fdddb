//! Branches over another parameter than the frequency: a response diagram for each piece of the study.

use hammerbeam_figure::{ResponseCurve, ResponseDiagram, ResponsePoint};
use hammerbeam_orbit::Stability;
use hammerbeam_results::{
    Store, StoreError,
    store::{PieceRecord, StoredVariedRow},
};

use super::{
    Album,
    parameter::{axis_label, file_name},
    quantities, settings,
};
use crate::{DrawingError, FigureScale};

/// Draws every `[[vary]]` of the study.
pub fn draw(store: &Store, scale: FigureScale, drawn: &mut impl Album) -> Result<(), DrawingError> {
    for piece in store.pieces()?.into_iter().filter(|piece| !piece.is_curve && !piece.branches.is_empty()) {
        let (curves, frequency_hz) = curves_of(store, &piece)?;
        let title = store.about("title")?;
        let diagram = ResponseDiagram {
            title: format!("{title}, {}", drawn.frequency_unit().words(frequency_hz))
                .trim_start_matches(", ")
                .to_owned(),
            parameter: axis_label(&piece.parameter),
            curves,
            ..ResponseDiagram::default()
        };
        for (word, quantity) in quantities(&diagram.curves) {
            let name = format!("vary_{}_{}_{word}", piece.id, file_name(&piece.parameter));
            drawn.add_unless_empty(&name, diagram.draw_with(&[quantity], &settings(scale, drawn)));
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
        store.each_varied_row::<StoreError>((piece.id, branch.branch), |row| {
            frequency_hz = row.frequency_hz;
            points.push(point(&row));
            Ok(())
        })?;
        curves.push(ResponseCurve { period_multiple: branch.period_multiple, points });
    }
    Ok((curves, frequency_hz))
}

fn point(row: &StoredVariedRow) -> ResponsePoint {
    let has = |event: &str| row.event.split('+').any(|word| word == event);
    ResponsePoint {
        frequency_hz: row.parameter,
        displacement_m: row.numbers[0],
        acceleration_m_s2: row.numbers[1],
        contact_force_n: row.numbers[2],
        impact_velocity_m_s: row.numbers[3],
        stable: row.stability.may_be_stable(),
        marginal: row.stability == Stability::Marginal,
        fold: has("fold"),
        grazing: has("grazing"),
        flip: has("flip"),
        neimark_sacker: has("neimark-sacker"),
        branch_point: has("branch-point"),
    }
}
