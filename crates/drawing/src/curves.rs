//! Curves of bifurcations in the frequency and another parameter.

use hammerbeam_figure::{Bifurcation, BifurcationCurve, BifurcationCurvePoint, CurveDiagram};
use hammerbeam_orbit::{BranchEventKind, EventSet};
use hammerbeam_results::{
    Store, StoreError,
    store::{PieceKind, PieceRecord},
};
use hammerbeam_study::file::CurveOf;

use crate::{
    Album, DrawingError,
    parameter::{file_name, parameter_axis},
};

/// Draws the curves of bifurcations, one figure for each parameter that they are over.
pub fn draw(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    let pieces: Vec<PieceRecord> =
        store.pieces()?.into_iter().filter(|piece| piece.kind.is_curve()).collect();
    let mut parameters: Vec<&str> = pieces.iter().map(|piece| piece.parameter.as_str()).collect();
    parameters.sort_unstable();
    parameters.dedup();
    for parameter in parameters {
        let mut curves = Vec::new();
        for piece in pieces.iter().filter(|piece| piece.parameter == parameter) {
            curves.extend(curves_of(store, piece)?);
        }
        if curves.iter().all(|curve| curve.points.is_empty()) {
            continue;
        }
        let (title, parameter_axis) = (store.about("title")?, parameter_axis(parameter));
        let diagram = CurveDiagram { title, parameter: parameter_axis, curves };
        drawn.add(&format!("curves_{}", file_name(parameter)), diagram.draw(&drawn.wide()));
    }
    Ok(())
}

fn curves_of(store: &Store, piece: &PieceRecord) -> Result<Vec<BifurcationCurve>, StoreError> {
    let mut curves = Vec::new();
    for branch in &piece.branches {
        let bifurcation = match piece.kind {
            PieceKind::Curve(CurveOf::Flip) => Bifurcation::Flip,
            PieceKind::Curve(CurveOf::NeimarkSacker) => Bifurcation::NeimarkSacker,
            PieceKind::Curve(CurveOf::Grazing) => Bifurcation::Grazing,
            PieceKind::Curve(CurveOf::Fold) | PieceKind::Vary => Bifurcation::Fold,
        };
        let mut points = Vec::new();
        store.each_row::<StoreError>(branch, |row| {
            points.push(BifurcationCurvePoint {
                parameter: row.parameter,
                frequency_hz: row.frequency_hz,
                name: codimension_two(row.events),
            });
            Ok(())
        })?;
        curves.push(BifurcationCurve { bifurcation, period_multiple: branch.period_multiple, points });
    }
    Ok(curves)
}

/// Names of the points of codimension two among the events of a row.
fn codimension_two(events: EventSet) -> String {
    let name = |kind: BranchEventKind| match kind {
        BranchEventKind::Cusp => Some("cusp"),
        BranchEventKind::FoldFlip => Some("fold–flip"),
        BranchEventKind::FoldNeimarkSacker => Some("fold–Neimark-Sacker"),
        BranchEventKind::FlipNeimarkSacker => Some("flip–Neimark-Sacker"),
        BranchEventKind::DoubleNeimarkSacker => Some("double Neimark-Sacker"),
        BranchEventKind::DegenerateFlip => Some("degenerate flip"),
        BranchEventKind::DegenerateBranchPoint => Some("degenerate branch point"),
        BranchEventKind::DegenerateNeimarkSacker => Some("degenerate Neimark-Sacker"),
        BranchEventKind::GrazingFold => Some("grazing–fold"),
        BranchEventKind::GrazingFlip => Some("grazing–flip"),
        BranchEventKind::GrazingNeimarkSacker => Some("grazing–Neimark-Sacker"),
        BranchEventKind::DoubleGrazing => Some("double grazing"),
        BranchEventKind::DegenerateGrazing => Some("degenerate grazing"),
        BranchEventKind::Resonance11 => Some("1:1"),
        BranchEventKind::Resonance12 => Some("1:2"),
        BranchEventKind::Resonance13 => Some("1:3"),
        BranchEventKind::Resonance14 => Some("1:4"),
        _ => None,
    };
    events.kinds().filter_map(name).collect::<Vec<_>>().join(", ")
}
