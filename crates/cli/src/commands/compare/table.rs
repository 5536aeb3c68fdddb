//! Tables of a comparison.

use std::{fs, path::Path};

use anyhow::Context;
use hammerbeam_signal::{Quantity, points::MeasuredPoint};
use hammerbeam_study::{
    comparison::{Comparison, PointOutcome, Verdict},
    export::{Table, header, number, word},
};

use crate::failure::Failure;

/// Writes every point with its branch.
///
/// * `low_pass_hz`: cut-off of the filter that the branches are behind, if there is one.
pub fn write_points(
    folder: &Path,
    name: &str,
    (comparison, low_pass_hz): (&Comparison, Option<f64>),
) -> Result<(), Failure> {
    let unit = comparison.quantity.key();
    let value = |what: &str| format!("{what}_{}_{unit}", comparison.quantity.word());
    let mut titles = header(&["origin", "kind", "period_multiple", "frequency_hz", "shifted_frequency_hz"]);
    titles.extend([value("measured"), value("shifted")]);
    titles.extend(header(&["verdict", "branch", "branch_period_multiple", "branch_stable", "row"]));
    titles.push(value("branch"));
    titles.extend(header(&["log_difference", "nearest_stable_hz", "stable_periods_there", "low_pass_hz"]));
    let mut table = Table::begin(folder, name, &titles)?;
    for point in &comparison.points {
        table.row(&row(point, low_pass_hz))?;
    }
    table.finish()?;
    Ok(())
}

fn row(outcome: &PointOutcome, low_pass_hz: Option<f64>) -> Vec<String> {
    let optional = |value: Option<String>| value.unwrap_or_default();
    let hit = outcome.nearest.map(|nearest| nearest.hit);
    let nearest_hz = match outcome.verdict {
        Verdict::NoBranch { nearest_hz } => nearest_hz,
        _ => None,
    };
    let periods: Vec<String> = outcome.stable_periods.iter().map(u32::to_string).collect();
    vec![
        word(&outcome.point.origin),
        outcome.point.kind.word().to_owned(),
        optional(outcome.point.kind.period_multiple().map(|period| period.to_string())),
        number(outcome.point.frequency_hz),
        number(outcome.shifted_hz),
        number(outcome.value),
        number(outcome.shifted_value),
        outcome.verdict.word().to_owned(),
        optional(hit.map(|hit| hit.branch.to_string())),
        optional(hit.map(|hit| hit.period_multiple.to_string())),
        optional(hit.map(|hit| hit.stable.to_string())),
        optional(hit.map(|hit| hit.row.to_string())),
        number(hit.map(|hit| hit.value)),
        number(outcome.nearest.map(|nearest| nearest.difference)),
        number(nearest_hz),
        periods.join("+"),
        number(low_pass_hz),
    ]
}

/// Writes the measured amplitudes of the excitation as a study file takes them, if there are two at least: means of what was measured at the same frequency.
///
/// # Returns
/// Name of the file.
pub fn write_amplitudes(folder: &Path, points: &[MeasuredPoint]) -> Result<Option<String>, Failure> {
    let all = |wanted: Quantity| -> Vec<(f64, f64)> {
        let of = |point: &MeasuredPoint| {
            let (quantity, amplitude) = point.excitation_amplitude()?;
            (quantity == wanted).then_some((point.frequency_hz, amplitude))
        };
        points.iter().filter_map(of).collect()
    };
    let (moved, pushed) = (all(Quantity::Displacement), all(Quantity::Force));
    let (key, mut amplitudes) =
        if moved.is_empty() { ("amplitude_n", pushed) } else { ("amplitude_m", moved) };
    amplitudes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut means: Vec<(f64, f64, u32)> = Vec::new();
    for (frequency_hz, amplitude) in amplitudes {
        match means.last_mut() {
            // A millionth is what a frequency is read to.
            Some((at, sum, count)) if (frequency_hz - *at).abs() <= 1e-6 * frequency_hz => {
                *sum += amplitude;
                *count += 1;
            }
            _ => means.push((frequency_hz, amplitude, 1)),
        }
    }
    if means.len() < 2 {
        return Ok(None);
    }
    let mut text =
        format!("# Measured amplitudes of the excitation, for [excitation] of a study file.\n{key} = [\n");
    for (frequency_hz, sum, count) in means {
        text.push_str(&format!("    [{frequency_hz}, {:.6e}],\n", sum / f64::from(count)));
    }
    text.push_str("]\n");
    let name = "excitation.toml";
    fs::write(folder.join(name), text).with_context(|| format!("cannot write {name}"))?;
    Ok(Some(name.to_owned()))
}
