//! A stored row as a solution of the page.

use hammerbeam_figure::PageSolution;
use hammerbeam_orbit::{BranchEventKind, Stability};
use hammerbeam_results::row::Row;

/// The row; its energy is not known from it.
pub(super) fn solution(row: &Row) -> PageSolution {
    let has = |kind| row.events.has(kind);
    PageSolution {
        frequency_hz: row.frequency_hz,
        parameter: row.parameter,
        energy_j: f64::NAN,
        displacement_m: row.maxima.displacement,
        acceleration_m_s2: row.maxima.acceleration,
        force_n: row.maxima.contact_force,
        impact_velocity_m_s: row.maxima.impact_velocity,
        contacts: row.maxima.contacts,
        leading_multiplier: row.leading_multiplier,
        stable: row.stability.may_be_stable(),
        marginal: row.stability == Stability::Marginal,
        fold: has(BranchEventKind::Fold),
        flip: has(BranchEventKind::Flip),
        neimark_sacker: has(BranchEventKind::NeimarkSacker),
        branch_point: has(BranchEventKind::BranchPoint),
        grazing: has(BranchEventKind::Grazing),
    }
}
