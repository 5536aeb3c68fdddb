//! The response diagram with the measured points over it, shifted as the comparison has it: figure 6 of the
//! paper.

use hammerbeam_figure::{
    MeasuredMark, MeasuredMotion, Quantity as Drawing, ResponseCurve, ResponseDiagram, ResponsePoint,
    ResponseSettings,
};
use hammerbeam_jobs::comparison::{BranchCurve, ComparedQuantity, CurvePoint, PointOutcome};
use hammerbeam_signal::{Quantity, points::Kind};
use hammerbeam_study::StudyFile;

use crate::{Album, Drawn};

/// Draws a comparison, if its quantity has a response diagram.
pub fn draw_compared(file: &StudyFile, compared: &ComparedQuantity, name: &str, drawn: &mut Drawn<'_>) {
    let quantity = compared.comparison.quantity;
    let drawing = match quantity {
        Quantity::Displacement => Drawing::Displacement,
        Quantity::Acceleration => Drawing::Acceleration,
        _ => return,
    };
    let diagram = ResponseDiagram {
        title: compared
            .point
            .as_ref()
            .map_or_else(|| file.study.title.clone(), |point| format!("{}, at {point}", file.study.title)),
        parameter: String::new(),
        curves: compared.curves.branches().iter().map(|branch| curve(branch, quantity)).collect(),
        frequency_range_hz: Some(compared.range_hz.into()),
        chaotic_ranges_hz: Vec::new(),
        measured: compared.comparison.points.iter().map(|point| mark(point, quantity)).collect(),
    };
    let figure = diagram
        .draw_with(&[drawing], &ResponseSettings { style: drawn.wide(), ..ResponseSettings::default() });
    drawn.add(&format!("compare_{}", name.trim_start_matches("compare_")), figure);
}

fn curve(branch: &BranchCurve, quantity: Quantity) -> ResponseCurve {
    let point = |point: &CurvePoint| ResponsePoint {
        frequency_hz: point.frequency_hz,
        displacement_m: if quantity == Quantity::Displacement { point.value } else { f64::NAN },
        acceleration_m_s2: if quantity == Quantity::Acceleration { point.value } else { f64::NAN },
        stable: point.stable,
        ..ResponsePoint::default()
    };
    ResponseCurve {
        period_multiple: branch.period_multiple,
        points: branch.points.iter().map(point).collect(),
    }
}

/// A shifted point.
fn mark(outcome: &PointOutcome, quantity: Quantity) -> MeasuredMark {
    let value = |wanted: Quantity| (quantity == wanted).then_some(outcome.shifted_value);
    MeasuredMark {
        frequency_hz: outcome.shifted_hz,
        displacement_m: value(Quantity::Displacement),
        acceleration_m_s2: value(Quantity::Acceleration),
        motion: match outcome.point.kind {
            Kind::Periodic { .. } => MeasuredMotion::Periodic,
            Kind::Aperiodic => MeasuredMotion::Aperiodic,
            Kind::Doubtful | Kind::Unknown => MeasuredMotion::Unknown,
        },
    }
}
