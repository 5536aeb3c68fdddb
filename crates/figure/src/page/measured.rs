//! Measured points in the response diagram.

use serde_json::{Value, json};

use crate::response_diagram::{MeasuredMotion, ResponseQuantity};

/// Measured points of one quantity, as the result of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct PageMeasured {
    /// Description of their source.
    pub name: String,
    /// The measured quantity.
    pub quantity: ResponseQuantity,
    /// Note on the comparison of points and branches; may be empty.
    pub note: String,
    /// The points.
    pub points: Vec<PageMeasuredPoint>,
}

/// A measured point.
#[derive(Debug, Clone, PartialEq)]
pub struct PageMeasuredPoint {
    /// Its line or record.
    pub origin: String,
    /// Kind of the motion.
    pub motion: MeasuredMotion,
    /// Motion period over excitation period, if it is periodic and that is known.
    pub period_multiple: Option<u32>,
    /// Excitation frequency (Hz) and largest value (SI), as measured.
    pub measured: (f64, f64),
    /// The same after the shift of the comparison.
    pub shifted: (f64, f64),
    /// Result of the comparison in words.
    pub verdict: String,
}

/// A series in the format of the script.
pub(super) fn series(series: &PageMeasured) -> Value {
    let point = |point: &PageMeasuredPoint| {
        json!({
            "origin": point.origin,
            "motion": word(point.motion),
            "period": point.period_multiple,
            "measured": point.measured,
            "shifted": point.shifted,
            "verdict": point.verdict,
        })
    };
    json!({
        "name": series.name,
        "quantity": quantity(series.quantity),
        "note": series.note,
        "points": series.points.iter().map(point).collect::<Vec<_>>(),
    })
}

fn quantity(quantity: ResponseQuantity) -> &'static str {
    match quantity {
        ResponseQuantity::Displacement => "displacement",
        ResponseQuantity::Acceleration => "acceleration",
        ResponseQuantity::ContactForce => "force",
        ResponseQuantity::ImpactVelocity => "velocity",
        ResponseQuantity::Output => "output",
    }
}

fn word(motion: MeasuredMotion) -> &'static str {
    match motion {
        MeasuredMotion::Periodic => "periodic",
        MeasuredMotion::Aperiodic => "aperiodic",
        MeasuredMotion::Unknown => "unknown",
    }
}
