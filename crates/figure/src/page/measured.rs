//! Measured points over the response diagram.

use serde_json::{Value, json};

use crate::{MeasuredMotion, Quantity};

/// Measured points of one quantity, as a comparison left them.
#[derive(Debug, Clone, PartialEq)]
pub struct PageMeasured {
    /// Where they are from, in words.
    pub name: String,
    /// What was measured.
    pub quantity: Quantity,
    /// What a reader has to know before points and branches are compared; empty for nothing.
    pub note: String,
    /// The points.
    pub points: Vec<PageMeasuredPoint>,
}

/// A measured point.
#[derive(Debug, Clone, PartialEq)]
pub struct PageMeasuredPoint {
    /// Which line or record it is.
    pub origin: String,
    /// Kind of the motion.
    pub motion: MeasuredMotion,
    /// Its period over that of the excitation, if it is periodic and that is known.
    pub period_multiple: Option<u32>,
    /// Excitation frequency (Hz) and largest value (SI), as measured.
    pub measured: (f64, f64),
    /// The same, shifted as the comparison has it.
    pub shifted: (f64, f64),
    /// What the comparison says of it, in words.
    pub verdict: String,
}

/// A series as the script reads it.
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

fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Displacement => "displacement",
        Quantity::Acceleration => "acceleration",
        Quantity::ContactForce => "force",
        Quantity::ImpactVelocity => "velocity",
    }
}

fn word(motion: MeasuredMotion) -> &'static str {
    match motion {
        MeasuredMotion::Periodic => "periodic",
        MeasuredMotion::Aperiodic => "aperiodic",
        MeasuredMotion::Unknown => "unknown",
    }
}
