//! Tables of a comparison.

use std::path::Path;

use hammerbeam_results::{
    export::{ExportError, Table, header, number, word},
    whole_file::{WriteError, replace},
};
use hammerbeam_signal::{MeasuredQuantity, points::MeasuredPoint};

use super::{Comparison, PointOutcome};

/// Writes every point with its branch.
///
/// * `low_pass_hz`: cut-off of the filter that the branches are behind [Hz], if there is one.
///
/// # Errors
/// The table cannot be written.
pub fn write_points(
    folder: &Path,
    name: &str,
    (comparison, low_pass_hz): (&Comparison, Option<f64>),
) -> Result<(), ExportError> {
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
        number(outcome.verdict.nearest_hz()),
        periods.join("+"),
        number(low_pass_hz),
    ]
}

/// A measured amplitude of the excitation at a frequency: mean and range of what was measured there.
#[derive(Clone, Copy)]
struct Amplitude {
    frequency_hz: f64,
    sum: f64,
    count: u32,
    low: f64,
    high: f64,
}

impl Amplitude {
    fn mean(&self) -> f64 {
        self.sum / f64::from(self.count)
    }
}

/// What was written of the excitation, and what has to be known of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExcitationAmplitudes {
    /// Name of the file.
    pub name: String,
    /// In words, each with its frequency.
    pub notes: Vec<String>,
}

/// Parts by which amplitudes at one frequency may differ, and by which one may lie beside its neighbours, at
/// least.
const SPREAD: f64 = 0.05;
const BESIDE: f64 = 0.1;
/// The same in usual distances from the neighbours.
const UNUSUAL: f64 = 6.0;

/// Writes the measured amplitudes of the excitation as a study file takes them, if there are two at least:
/// means of what was measured at the same frequency.
///
/// # Errors
/// The file cannot be written.
pub fn write_amplitudes(
    folder: &Path,
    points: &[MeasuredPoint],
) -> Result<Option<ExcitationAmplitudes>, WriteError> {
    let all = |wanted: MeasuredQuantity| -> Vec<(f64, f64)> {
        let of = |point: &MeasuredPoint| {
            let (quantity, amplitude) = point.excitation_amplitude()?;
            (quantity == wanted).then_some((point.frequency_hz, amplitude))
        };
        points.iter().filter_map(of).collect()
    };
    let (moved, pushed) = (all(MeasuredQuantity::Displacement), all(MeasuredQuantity::Force));
    let (key, measured) = if moved.is_empty() { ("amplitude_n", pushed) } else { ("amplitude_m", moved) };
    let means = means(measured);
    if means.len() < 2 {
        return Ok(None);
    }
    let mut text =
        format!("# Measured amplitudes of the excitation, for [excitation] of a study file.\n{key} = [\n");
    for amplitude in &means {
        text.push_str(&format!("    [{}, {:.6e}],\n", amplitude.frequency_hz, amplitude.mean()));
    }
    text.push_str("]\n");
    let name = "excitation.toml".to_owned();
    replace(&folder.join(&name), text.as_bytes())?;
    let notes = spread(&means).chain(beside(&means)).collect();
    Ok(Some(ExcitationAmplitudes { name, notes }))
}

/// Amplitudes by rising frequency, those of the same one together.
fn means(mut measured: Vec<(f64, f64)>) -> Vec<Amplitude> {
    measured.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut means: Vec<Amplitude> = Vec::new();
    for (frequency_hz, value) in measured {
        match means.last_mut() {
            // A millionth is what a frequency is read to.
            Some(last) if (frequency_hz - last.frequency_hz).abs() <= 1e-6 * frequency_hz => {
                last.sum += value;
                last.count += 1;
                (last.low, last.high) = (last.low.min(value), last.high.max(value));
            }
            _ => means.push(Amplitude { frequency_hz, sum: value, count: 1, low: value, high: value }),
        }
    }
    means
}

/// Frequencies at which several were measured that are not the same.
fn spread(means: &[Amplitude]) -> impl Iterator<Item = String> {
    let apart = means.iter().filter(|at| at.high - at.low > SPREAD * at.mean());
    apart.map(|at| {
        format!(
            "amplitudes of the excitation at {} Hz go from {:.4e} to {:.4e}; their mean is taken",
            at.frequency_hz, at.low, at.high
        )
    })
}

/// Amplitudes far from the line between their neighbours: by more than a tenth, and by six times the median
/// distance. The farthest is taken out before the next one is looked for, since it affects its neighbours'
/// lines.
fn beside(means: &[Amplitude]) -> impl Iterator<Item = String> {
    let mut left = means.to_vec();
    let mut far = Vec::new();
    while left.len() >= 5 {
        let off = |w: &[Amplitude]| {
            let share = (w[1].frequency_hz - w[0].frequency_hz) / (w[2].frequency_hz - w[0].frequency_hz);
            let line = w[0].mean() + share * (w[2].mean() - w[0].mean());
            (w[1].mean() / line).ln()
        };
        let distances: Vec<f64> = left.windows(3).map(off).collect();
        let mut sorted: Vec<f64> = distances.iter().map(|off| off.abs()).collect();
        sorted.sort_by(f64::total_cmp);
        let limit = BESIDE.max(UNUSUAL * sorted[sorted.len() / 2]);
        let largest = (0..distances.len()).max_by(|&a, &b| distances[a].abs().total_cmp(&distances[b].abs()));
        let Some(index) = largest.filter(|&index| distances[index].abs() > limit) else { break };
        far.push((left.remove(index + 1), distances[index].exp()));
    }
    far.into_iter().map(|(at, ratio)| {
        format!(
            "the amplitude of the excitation at {} Hz, {:.4e}, is {ratio:.3} times what its neighbours say; \
            it is taken as it is",
            at.frequency_hz,
            at.mean()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_far_from_its_neighbours_and_one_that_spreads_are_reported_and_no_others() {
        let smooth = |f: f64| 5e-4 * (1.0 - 1e-4 * f * f);
        let mut measured: Vec<(f64, f64)> = (20..60).map(|f| (f64::from(f), smooth(f64::from(f)))).collect();
        assert_eq!(spread(&means(measured.clone())).chain(beside(&means(measured.clone()))).count(), 0);
        measured[7].1 *= 1.3;
        measured.push((40.0, 0.9 * smooth(40.0)));
        let means = means(measured);
        assert_eq!(means.len(), 40);
        let far: Vec<String> = beside(&means).collect();
        assert!(far.len() == 1 && far[0].contains("at 27 Hz") && far[0].contains("1.3"), "{far:?}");
        let wide: Vec<String> = spread(&means).collect();
        assert!(wide.len() == 1 && wide[0].contains("at 40 Hz"), "{wide:?}");
    }
}
