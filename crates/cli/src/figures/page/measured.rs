//! Measured points of the comparisons that a results folder holds.

use std::path::Path;

use hammerbeam_figure::{MeasuredMotion, PageMeasured, PageMeasuredPoint, Quantity as Drawing, plain_number};
use hammerbeam_signal::Quantity;

use super::Drawn;
use crate::commands::compare::{StoredComparison, StoredPoint, stored};

/// The points of every comparison; one whose table cannot be read is named with the reason.
pub fn series(folder: &Path, drawn: &mut Drawn<'_>) -> Vec<PageMeasured> {
    let mut all = Vec::new();
    for comparison in stored(folder) {
        match comparison {
            Ok(comparison) => all.extend(one(comparison)),
            Err(error) => drawn.refuse("measured points on the page", format!("{error:#}")),
        }
    }
    all
}

fn one(comparison: StoredComparison) -> Option<PageMeasured> {
    let quantity = match comparison.quantity {
        Quantity::Displacement => Drawing::Displacement,
        Quantity::Acceleration => Drawing::Acceleration,
        Quantity::Force => Drawing::ContactForce,
        _ => return None,
    };
    let note = comparison.low_pass_hz.map_or_else(String::new, |cut_off| {
        let cut_off = plain_number(cut_off);
        format!("They were compared with branches behind a low-pass filter of {cut_off} Hz; those drawn here are not.")
    });
    let points = comparison.points.into_iter().map(point).collect();
    Some(PageMeasured { name: comparison.name.to_owned(), quantity, note, points })
}

fn point(point: StoredPoint) -> PageMeasuredPoint {
    PageMeasuredPoint {
        motion: match point.kind.as_str() {
            "periodic" => MeasuredMotion::Periodic,
            "aperiodic" => MeasuredMotion::Aperiodic,
            _ => MeasuredMotion::Unknown,
        },
        origin: point.origin,
        period_multiple: point.period_multiple,
        measured: point.measured,
        shifted: point.shifted,
        verdict: point.verdict,
    }
}
