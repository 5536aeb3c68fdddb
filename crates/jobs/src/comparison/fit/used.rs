//! The points that take part in a fit, and how well they lie on branches.

use hammerbeam_signal::{
    MeasuredQuantity,
    points::{MeasuredKind, MeasuredPoint},
};

use crate::comparison::{Curves, Shift};

/// How well points lie on branches.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// Periodic points that meet a stable branch of their period.
    pub met: usize,
    /// Of those, points within the reach.
    pub within: usize,
    /// Root mean square of the logarithmic differences of all that meet one; 0 without any.
    pub rms: f64,
    /// The same of those within the reach.
    pub rms_within: f64,
}

/// A point that takes part.
#[derive(Debug, Clone, Copy)]
pub(in crate::comparison) struct Used {
    pub frequency_hz: f64,
    pub logarithm: f64,
    pub period: Option<u32>,
}

impl Used {
    pub fn of(point: &MeasuredPoint, quantity: MeasuredQuantity) -> Option<Self> {
        let period = period_of(point.kind)?;
        let logarithm = point.maxima.of(quantity)?.ln();
        Some(Self { frequency_hz: point.frequency_hz, logarithm, period })
    }
}

/// Whether a point takes part in a fit, and the period that its branch must have.
pub(in crate::comparison) fn period_of(kind: MeasuredKind) -> Option<Option<u32>> {
    match kind {
        MeasuredKind::Periodic { period_multiple } => Some(period_multiple),
        MeasuredKind::Unknown => Some(None),
        MeasuredKind::Aperiodic | MeasuredKind::Doubtful => None,
    }
}

/// How well points lie on the branches with a shift.
///
/// * `reach`: logarithm of the ratio up to which a branch explains a point.
pub(in crate::comparison) fn residual(used: &[Used], curves: &Curves, shift: Shift, reach: f64) -> Residual {
    let differences: Vec<f64> = used.iter().filter_map(|point| difference(point, curves, shift)).collect();
    let within: Vec<f64> = differences.iter().copied().filter(|r| r.abs() <= reach).collect();
    let rms = |r: &[f64]| {
        if r.is_empty() { 0.0 } else { (r.iter().map(|r| r * r).sum::<f64>() / r.len() as f64).sqrt() }
    };
    Residual {
        met: differences.len(),
        within: within.len(),
        rms: rms(&differences),
        rms_within: rms(&within),
    }
}

/// Logarithm of the shifted value over that of the nearest stable branch, if the point meets one.
pub(in crate::comparison) fn difference(point: &Used, curves: &Curves, shift: Shift) -> Option<f64> {
    let value = shift.amplitude_factor * point.logarithm.exp();
    let hit = curves.nearest_stable(shift.frequency.apply(point.frequency_hz), point.period, value)?;
    Some((value / hit.value).ln())
}
