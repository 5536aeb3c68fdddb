//! Stored branches as curves of response diagrams.

use hammerbeam_figure::{ResponseCurve, ResponsePoint};
use hammerbeam_orbit::{BranchEventKind, Stability};
use hammerbeam_results::{Store, StoreError, row::Row};

/// The branches of a store.
pub fn curves(store: &Store) -> Result<Vec<ResponseCurve>, StoreError> {
    let mut curves = Vec::new();
    for branch in store.branches()? {
        let mut points = Vec::new();
        store.each_row::<StoreError>(&branch, |row| {
            points.push(point(&row));
            Ok(())
        })?;
        curves.push(ResponseCurve { period_multiple: branch.period_multiple, points });
    }
    Ok(curves)
}

/// A row as a point of a response diagram, over what varies.
pub fn point(row: &Row) -> ResponsePoint {
    let has = |kind| row.events.has(kind);
    ResponsePoint {
        frequency_hz: row.parameter,
        displacement_m: row.maxima.displacement,
        acceleration_m_s2: row.maxima.acceleration,
        contact_force_n: row.maxima.contact_force,
        impact_velocity_m_s: row.maxima.impact_velocity,
        output: f64::NAN,
        stable: row.stability.may_be_stable(),
        marginal: row.stability == Stability::Marginal,
        fold: has(BranchEventKind::Fold),
        grazing: has(BranchEventKind::Grazing),
        flip: has(BranchEventKind::Flip),
        neimark_sacker: has(BranchEventKind::NeimarkSacker),
        branch_point: has(BranchEventKind::BranchPoint),
    }
}
