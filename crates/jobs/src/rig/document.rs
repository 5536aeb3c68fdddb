//! A rig as a document.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{FilteredBranch, FilteredRatio, RigMode, RigReport, signal_document};
use crate::comparison::{Filter, comparison_document};

impl Serialize for RigReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        document(self).serialize(serializer)
    }
}

fn document(found: &RigReport) -> Value {
    let comparisons: Vec<Value> = found
        .comparisons
        .iter()
        .map(|(name, curves, comparison)| {
            let mut document = comparison_document(comparison);
            document["name"] = json!(name);
            document["gaps"] = json!(curves.gaps());
            document
        })
        .collect();
    let [right, wrong, doubtful] = found.agreement();
    let chaos = found.chaos();
    json!({
        "study": found.file.name,
        "title": found.file.study.title,
        "solutions": found.solutions,
        "eigenfrequencies": found.modes.iter().map(mode).collect::<Vec<_>>(),
        "sweep": {
            "from_hz": found.rig.sweep_hz[0],
            "to_hz": found.rig.sweep_hz[1],
            "step_hz": found.rig.step_hz,
            "low_pass_hz": found.rig.low_pass_hz,
            "low_pass_order": found.rig.low_pass_order,
            "sampling_hz": found.rig.sampling_hz,
            "noise_m_s2": found.rig.noise_m_s2,
            "noise_m": found.rig.noise_m,
            "seed": found.rig.seed,
            "points": found.points.len(),
            "begun_anew": found.points.iter().filter(|point| point.begun_anew).count(),
            "max_displacement_m": found.largest_displacement(),
        },
        "classification": { "as_the_states": right, "not_as_the_states": wrong, "doubtful": doubtful },
        "chaos": {
            "aperiodic": chaos.aperiodic,
            "positive_exponent_of_the_record": chaos.by_record,
            "positive_exponent_of_the_motion": chaos.by_motion,
            "both": chaos.by_both,
            "median_record_over_motion": chaos.median_ratio,
        },
        "comparisons": comparisons,
        "signals": found.signals.iter().enumerate().map(signal_document).collect::<Vec<_>>(),
        "filters": filters(found),
    })
}

/// What is not measured, or no mode, is null.
fn mode(mode: &RigMode) -> Value {
    let measured = mode.measured;
    json!({
        "mode": mode.number,
        "measured_hz": measured.map(|of| of.frequency_hz.0),
        "measured_half_width_hz": measured.map(|of| of.frequency_hz.1),
        "measured_damping_ratio": measured.map(|of| of.damping_ratio.0),
        "measured_damping_ratio_half_width": measured.map(|of| of.damping_ratio.1),
        "model_hz": mode.model_hz,
        "rig_hz": mode.rig_hz,
    })
}

fn filters(found: &RigReport) -> Vec<Value> {
    let one = |(index, filter): (usize, &Filter)| {
        let all: Vec<&FilteredBranch> = found.filtered.branches.iter().collect();
        let branch = |branch: &&FilteredBranch| {
            json!({
                "branch": branch.branch,
                "period_multiple": branch.period_multiple,
                "acceleration": ratio(FilteredBranch::ratio(&[branch], index, false, false)),
                "displacement": ratio(FilteredBranch::ratio(&[branch], index, true, false)),
            })
        };
        json!({
            "cut_off_hz": filter.cut_off_hz,
            "order": filter.order,
            "gaps": found.filtered.gaps,
            "acceleration_stable": ratio(FilteredBranch::ratio(&all, index, false, true)),
            "acceleration_all": ratio(FilteredBranch::ratio(&all, index, false, false)),
            "displacement_stable": ratio(FilteredBranch::ratio(&all, index, true, true)),
            "displacement_all": ratio(FilteredBranch::ratio(&all, index, true, false)),
            "branches": all.iter().map(branch).collect::<Vec<_>>(),
        })
    };
    found.filters.iter().enumerate().map(one).collect()
}

fn ratio(ratio: FilteredRatio) -> Value {
    json!({
        "solutions": ratio.solutions,
        "median": ratio.median,
        "largest": ratio.largest.0,
        "largest_at_hz": ratio.largest.1,
        "smallest": ratio.smallest.0,
        "smallest_at_hz": ratio.smallest.1,
    })
}
