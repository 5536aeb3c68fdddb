//! Branches over another parameter than the frequency, behind those over the frequency.

use hammerbeam_figure::{Page, PageBranch, PageParameter, PageSolution};
use hammerbeam_orbit::Stability;
use hammerbeam_results::{
    Store, StoreError,
    store::{PieceRecord, StoredVariedRow},
};

use crate::parameter::axis_label;

/// Adds the branches of every `[[vary]]` of the study, with their leading multipliers.
///
/// Their numbers go on from those of the branches over the frequency.
pub fn add(store: &Store, page: &mut Page) -> Result<(), StoreError> {
    let mut id = page.branches.iter().map(|branch| branch.id).max().unwrap_or(0);
    for piece in store.pieces()?.into_iter().filter(|piece| !piece.is_curve) {
        let over = page.parameters.len() as u32 + 1;
        let mut branches = branches(store, &piece)?;
        branches.retain(|branch| !branch.solutions.is_empty());
        let Some(first) = branches.first().and_then(|branch| branch.solutions.first()) else { continue };
        let (title, unit) = named(&piece.parameter);
        page.parameters.push(PageParameter { title, unit, frequency_hz: first.frequency_hz });
        for branch in branches {
            id += 1;
            for solution in &branch.solutions {
                let [re, im] = solution.leading_multiplier;
                let pair = [[re, im], [re, -im]];
                page.multipliers.push(if im == 0.0 { &pair[..1] } else { &pair });
            }
            page.branches.push(PageBranch { id, over, ..branch });
        }
    }
    Ok(())
}

fn branches(store: &Store, piece: &PieceRecord) -> Result<Vec<PageBranch>, StoreError> {
    let branch = |branch: u32, period_multiple: u32| {
        let mut solutions = Vec::new();
        store.each_varied_row::<StoreError>((piece.id, branch), |row| {
            solutions.push(solution(&row));
            Ok(())
        })?;
        Ok(PageBranch { period_multiple, solutions, ..PageBranch::default() })
    };
    piece.branches.iter().map(|record| branch(record.branch, record.period_multiple)).collect()
}

fn solution(row: &StoredVariedRow) -> PageSolution {
    let has = |event: &str| row.event.split('+').any(|word| word == event);
    PageSolution {
        frequency_hz: row.frequency_hz,
        parameter: row.parameter,
        displacement_m: row.numbers[0],
        acceleration_m_s2: row.numbers[1],
        force_n: row.numbers[2],
        impact_velocity_m_s: row.numbers[3],
        energy_j: f64::NAN,
        contacts: row.contacts,
        leading_multiplier: [row.numbers[5], row.numbers[6]],
        stable: row.stability.may_be_stable(),
        marginal: row.stability == Stability::Marginal,
        fold: has("fold"),
        flip: has("flip"),
        neimark_sacker: has("neimark-sacker"),
        branch_point: has("branch-point"),
        grazing: has("grazing"),
    }
}

/// What a parameter is, and its unit.
fn named(parameter: &str) -> (String, String) {
    let label = axis_label(parameter);
    let parts = label.strip_suffix(')').and_then(|label| label.rsplit_once(" ("));
    parts.map_or((label.clone(), String::new()), |(title, unit)| {
        (title.to_owned(), unit.trim_matches('–').to_owned())
    })
}
