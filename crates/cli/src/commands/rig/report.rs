//! The report of a rig, in words.

use std::{fmt::Write, path::Path};

use hammerbeam_jobs::{
    comparison::{Filter, PointOutcome},
    rig::{Filtered, FilteredBranch, FilteredRatio, RigReport},
};
use hammerbeam_results::whole_file::replace;
use serde_json::Value;

use super::signals;
use crate::{
    commands::compare::{estimate, fit_notes, gaps},
    failure::Failure,
};

/// Solutions that a branch has at least to stand in the report on its own.
const SHOWN: usize = 20;

/// Writes `report.md` and `report.json`.
pub fn write(
    folder: &Path,
    found: &RigReport,
    document: &Value,
    files: &mut Vec<String>,
) -> Result<(), Failure> {
    let json = format!("{document:#}\n");
    for (name, text) in [("report.md", markdown(found)), ("report.json", json)] {
        replace(&folder.join(name), text.as_bytes())?;
        files.push(name.to_owned());
    }
    Ok(())
}

/// What the terminal shows.
pub fn text(found: &RigReport, folder: &Path, files: &[String]) -> String {
    let mut lines = vec![format!(
        "{} points of the rig over {} solutions of {}",
        found.points.len(),
        found.solutions,
        found.file.name
    )];
    for (name, curves, comparison) in &found.comparisons {
        lines.push(format!(
            "  {name:<22} frequency factor {}, amplitude factor {}, residual {:.3} -> {:.3}",
            estimate(comparison.fit.frequency, 4),
            estimate(comparison.fit.amplitude, 3),
            comparison.before.rms,
            comparison.after.rms
        ));
        let notes = fit_notes(&comparison.fit).into_iter().chain(gaps(curves.gaps()));
        lines.extend(notes.map(|note| format!("    note: {note}")));
    }
    for (index, filter) in found.filters.iter().enumerate() {
        let all: Vec<&FilteredBranch> = found.filtered.branches.iter().collect();
        let ratio = FilteredBranch::ratio(&all, index, false, true);
        lines.push(format!(
            "  {} Hz lowers maximum accelerations of stable solutions by the factor {:.2} (median), at most \
            {:.2}",
            filter.cut_off_hz, ratio.median, ratio.largest.0
        ));
    }
    lines.push(format!(
        "report.md, report.json and {} more files are in {}",
        files.len() - 2,
        folder.display()
    ));
    lines.join("\n")
}

fn markdown(found: &RigReport) -> String {
    let mut text = format!("# {}: a virtual rig\n\n", found.file.study.title);
    let rig = &found.rig;
    let _ = writeln!(
        text,
        "Swept from {} to {} Hz and back in steps of {} Hz; accelerations behind a low-pass filter of {} \
        Hz, order {}, sampled at {} Hz, with noise of {} m/s² (displacements: {} m), seed {}. \
         Each motion settled for {} excitation periods and was recorded for {}. The branches are {} \
         periodic solutions of `{}`.\n",
        rig.sweep_hz[0],
        rig.sweep_hz[1],
        rig.step_hz,
        rig.low_pass_hz,
        rig.low_pass_order,
        rig.sampling_hz,
        rig.noise_m_s2,
        rig.noise_m,
        rig.seed,
        rig.settling_periods,
        rig.recorded_periods,
        found.solutions,
        found.file.name,
    );
    modes(&mut text, found);
    excitation(&mut text, found);
    comparisons(&mut text, found);
    chaos(&mut text, found);
    signals::report(&mut text, &found.signals);
    filters(&mut text, &found.filters, &found.filtered);
    points(&mut text, found);
    text
}

fn modes(text: &mut String, found: &RigReport) {
    if found.modes.is_empty() {
        return;
    }
    text.push_str(
        "## Eigenfrequencies and damping, from a free decay without the stop\n\n| mode | measured \
    (Hz) | model (Hz) | model over measured | damping ratio |\n|---|---|---|---|---|\n",
    );
    for mode in &found.modes {
        let number = mode.number.map_or_else(|| "none".to_owned(), |number| number.to_string());
        let model = mode.model_hz.map_or_else(|| "-".to_owned(), |hz| format!("{hz:.3}"));
        let Some(measured) = mode.measured else {
            let _ = writeln!(text, "| {number} | not measured | {model} | - | - |");
            continue;
        };
        let ((hz, half), (ratio, ratio_half)) = (measured.frequency_hz, measured.damping_ratio);
        let over = mode.model_hz.map_or_else(|| "-".to_owned(), |model_hz| format!("{:.4}", model_hz / hz));
        let _ = writeln!(
            text,
            "| {number} | {hz:.3} ± {half:.3} | {model} | {over} | {ratio:.5} ± {ratio_half:.5} |"
        );
    }
    text.push('\n');
}

fn excitation(text: &mut String, found: &RigReport) {
    text.push_str(
        "## Figure 2: acceleration of the table\n\nAll frequencies are in `figure_02.csv`.\n\n| \
    frequency (Hz) | computed (m/s²) | measured (m/s²) | measured over computed |\n|---|---|---|---|\n",
    );
    let up: Vec<_> = found.points.iter().filter(|point| point.direction.word() == "up").collect();
    for point in up.iter().step_by((up.len() / 10).max(1)) {
        let hz = point.point.frequency_hz;
        let computed = found.table_acceleration(hz);
        if let Some((_, measured)) = point.point.excitation {
            let _ =
                writeln!(text, "| {hz:.2} | {computed:.2} | {measured:.2} | {:.3} |", measured / computed);
        }
    }
    text.push('\n');
}

fn comparisons(text: &mut String, found: &RigReport) {
    text.push_str(
        "## Figure 6: measured points over the branches\n\nPoints are shifted by a factor of the frequency \
        and a factor of the value. Residuals are root mean squares of natural logarithms; 0.1 is about 10 \
        %.\n\n\
         | what | frequency factor | amplitude factor | residual before | after | within reach | explained \
         | too far | only unstable branches | no branch | aperiodic | doubtful \
         |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, _, comparison) in &found.comparisons {
        let count = |wanted: &str| comparison.points.iter().filter(|p| p.verdict.word() == wanted).count();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {:.3} ({}) | {:.3} ({}) | {:.3} ({}) | {} | {} | {} | {} | {} | {} |",
            what(name),
            estimate(comparison.fit.frequency, 4),
            estimate(comparison.fit.amplitude, 3),
            comparison.before.rms,
            comparison.before.met,
            comparison.after.rms,
            comparison.after.met,
            comparison.after.rms_within,
            comparison.after.within,
            count("explained"),
            count("too-far"),
            count("only-unstable"),
            count("no-branch"),
            count("aperiodic"),
            count("doubtful"),
        );
    }
    for (name, curves, comparison) in &found.comparisons {
        for note in fit_notes(&comparison.fit).into_iter().chain(gaps(curves.gaps())) {
            let _ = writeln!(text, "\nNote, {}: {note}.", what(name));
        }
    }
    let [right, wrong, doubtful] = found.agreement();
    let _ = writeln!(
        text,
        "\nIn brackets: periodic points that meet a stable branch of their period.\n\n\
         The records show what the states themselves do (known here, unlike on a rig) at {right} points, \
         something else at {wrong}, and leave {doubtful} in doubt.\n",
    );
}

/// Exponents of the aperiodic points, as the paper checks its own.
fn chaos(text: &mut String, found: &RigReport) {
    let chaos = found.chaos();
    if chaos.aperiodic == 0 {
        return;
    }
    let ratio = chaos.median_ratio.map_or_else(String::new, |ratio| {
        format!(" Where both are positive, the record gives {ratio:.2} times that of the motion (median).")
    });
    let _ = writeln!(
        text,
        "## Aperiodic points: largest Lyapunov exponents\n\n\
         Of {} aperiodic points the record has a positive exponent (Wolf) at {}, the motion itself one \
         whose interval of 95 % is above zero at {}, both at {}.{ratio} \
         Each is in `measured.csv`.\n",
        chaos.aperiodic, chaos.by_record, chaos.by_motion, chaos.by_both,
    );
}

fn what(name: &str) -> &str {
    match name {
        "acceleration" => "filtered accelerations over computed ones (the paper's way)",
        "filtered_acceleration" => "filtered accelerations over computed ones behind the same filter",
        other => other,
    }
}

fn filters(text: &mut String, filters: &[Filter], filtered: &Filtered) {
    text.push_str(
        "## What filters leave of the computed maxima\n\nRatio of the maximum without the filter \
    to that behind it. Every solution is in `figure_06_branches.csv`.\n\n| cut-off (Hz) | solutions | \
    accelerations: median | largest | smallest | displacements: median | largest \
    |\n|---|---|---|---|---|---|---|\n",
    );
    let all: Vec<&FilteredBranch> = filtered.branches.iter().collect();
    for (index, filter) in filters.iter().enumerate() {
        for (stable, name) in [(true, "stable"), (false, "all")] {
            let acceleration = FilteredBranch::ratio(&all, index, false, stable);
            let displacement = FilteredBranch::ratio(&all, index, true, stable);
            let _ = writeln!(
                text,
                "| {} | {} {name} | {} | {:.4} | {:.4} |",
                filter.cut_off_hz,
                acceleration.solutions,
                ratio(acceleration),
                displacement.median,
                displacement.largest.0,
            );
        }
    }
    if let Some(note) = gaps(filtered.gaps) {
        let _ = writeln!(text, "\nNote: {note}; they are in no ratio.");
    }
    let _ = writeln!(
        text,
        "\nBy branches, {} Hz, stable and unstable solutions:\n\n| branch | period | solutions | \
        accelerations: median | largest | smallest | displacements: median |\n|---|---|---|---|---|---|---|",
        filters[0].cut_off_hz
    );
    for branch in filtered.branches.iter().filter(|branch| branch.points.len() >= SHOWN) {
        let acceleration = FilteredBranch::ratio(&[branch], 0, false, false);
        let displacement = FilteredBranch::ratio(&[branch], 0, true, false);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.4} |",
            branch.branch,
            branch.period_multiple,
            acceleration.solutions,
            ratio(acceleration),
            displacement.median
        );
    }
    text.push('\n');
}

fn ratio(ratio: FilteredRatio) -> String {
    format!(
        "{:.2} | {:.2} at {:.2} Hz | {:.2} at {:.2} Hz",
        ratio.median, ratio.largest.0, ratio.largest.1, ratio.smallest.0, ratio.smallest.1
    )
}

fn points(text: &mut String, found: &RigReport) {
    text.push_str(
        "## Each point, filtered accelerations over computed ones\n\n| point | kind | period | of \
    the states | measured (m/s²) | shifted (Hz) | shifted (m/s²) | verdict | branch | difference \
    |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let Some((_, _, comparison)) = found.comparisons.first() else { return };
    for (point, outcome) in found.points.iter().zip(&comparison.points) {
        let period = |period: Option<u32>| period.map_or_else(|| "-".to_owned(), |n| n.to_string());
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.0} | {:.3} | {:.0} | {} |",
            outcome.point.origin,
            outcome.point.kind.word(),
            period(outcome.point.kind.period_multiple()),
            period(point.period_of_states),
            outcome.value,
            outcome.shifted_hz,
            outcome.shifted_value,
            verdict(outcome),
        );
    }
}

fn verdict(outcome: &PointOutcome) -> String {
    let nearest = outcome.nearest.map_or_else(
        || "- | -".to_owned(),
        |nearest| format!("{} | {:+.3}", nearest.hit.branch, nearest.difference),
    );
    let word = outcome.verdict.word();
    match outcome.verdict.nearest_hz() {
        Some(hz) => format!("{word}, a stable one at {hz:.2} Hz | {nearest}"),
        None => format!("{word} | {nearest}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_that_cannot_be_gone_over_are_told_beside_the_ratios() {
        let filter = Filter { order: 4, cut_off_hz: 850.0 };
        let of = |gaps: usize| {
            let mut text = String::new();
            filters(&mut text, &[filter], &Filtered { branches: Vec::new(), gaps });
            text
        };
        let note = "Note: 3 solutions of the branches could not be gone over: there are gaps there; they \
        are in no ratio.";
        assert!(of(3).contains(note), "{}", of(3));
        assert!(!of(0).contains("gone over"), "{}", of(0));
    }
}
