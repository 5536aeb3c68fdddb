//! The response diagram with the measured points over it, shifted as the comparison has it: figure 6 of the
//! paper.

use hammerbeam_figure::{
    MeasuredMark, MeasuredMotion, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity as Drawing,
    ResponseSettings,
};
use hammerbeam_jobs::comparison::{BranchCurve, ComparedQuantity, CurvePoint, PointOutcome};
use hammerbeam_signal::{MeasuredQuantity, points::MeasuredKind};
use hammerbeam_study::StudyFile;

use crate::{Album, Drawn};

/// Draws a comparison, if its quantity has a response diagram.
pub fn draw_compared(file: &StudyFile, compared: &ComparedQuantity, name: &str, drawn: &mut Drawn<'_>) {
    let quantity = compared.comparison.quantity;
    let drawing = match quantity {
        MeasuredQuantity::Displacement => Drawing::Displacement,
        MeasuredQuantity::Acceleration => Drawing::Acceleration,
        _ => return,
    };
    let diagram = ResponseDiagram {
        title: compared
            .point
            .as_ref()
            .map_or_else(|| file.study.title.clone(), |point| format!("{}, at {point}", file.study.title)),
        curves: compared.curves.branches().iter().map(|branch| curve(branch, quantity)).collect(),
        frequency_range_hz: Some(compared.range_hz.into()),
        measured: compared.comparison.points.iter().map(|point| mark(point, quantity)).collect(),
        ..ResponseDiagram::default()
    };
    let figure = diagram
        .draw_with(&[drawing], &ResponseSettings { style: drawn.wide(), ..ResponseSettings::default() });
    drawn.add(&format!("compare_{}", name.trim_start_matches("compare_")), figure);
}

fn curve(branch: &BranchCurve, quantity: MeasuredQuantity) -> ResponseCurve {
    let point = |point: &CurvePoint| ResponsePoint {
        frequency_hz: point.frequency_hz,
        displacement_m: if quantity == MeasuredQuantity::Displacement { point.value } else { f64::NAN },
        acceleration_m_s2: if quantity == MeasuredQuantity::Acceleration { point.value } else { f64::NAN },
        stable: point.stable,
        ..ResponsePoint::default()
    };
    ResponseCurve {
        period_multiple: branch.period_multiple,
        points: branch.points.iter().map(point).collect(),
    }
}

/// A shifted point.
fn mark(outcome: &PointOutcome, quantity: MeasuredQuantity) -> MeasuredMark {
    let value = |wanted: MeasuredQuantity| (quantity == wanted).then_some(outcome.shifted_value);
    MeasuredMark {
        frequency_hz: outcome.shifted_hz,
        displacement_m: value(MeasuredQuantity::Displacement),
        acceleration_m_s2: value(MeasuredQuantity::Acceleration),
        motion: match outcome.point.kind {
            MeasuredKind::Periodic { .. } => MeasuredMotion::Periodic,
            MeasuredKind::Aperiodic => MeasuredMotion::Aperiodic,
            MeasuredKind::Doubtful | MeasuredKind::Unknown => MeasuredMotion::Unknown,
        },
    }
}
