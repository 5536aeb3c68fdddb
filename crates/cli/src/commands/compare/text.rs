//! A comparison in words.

use hammerbeam_jobs::{
    comparison::{
        CompareReport, ComparedQuantity, Filter, Fit, FitEstimate, Origin, PointOutcome, Residual, Verdict,
    },
    counted,
};
use hammerbeam_signal::MeasuredQuantity;

/// Unexplained points that are listed; all are in the table.
const LISTED: usize = 20;

/// * `has_own_folder`: whether the tables are elsewhere than in the results.
pub fn text(report: &CompareReport, has_own_folder: bool) -> String {
    let points = counted(report.measured.points.len() as u64, "measured point");
    let mut lines = vec![format!("{points} over {}", report.results.display())];
    if let Some(Filter { order, cut_off_hz }) = report.filter {
        lines.push(format!("branches behind a low-pass filter of {cut_off_hz} Hz, order {order}"));
    }
    report.compared.iter().for_each(|one| lines.extend(comparison(one, &report.point)));
    lines.extend(report.measured.findings.iter().map(|(file, finding)| format!("note: {file}: {finding}")));
    lines.push(format!("in {}: {}", report.folder.display(), report.files.join(", ")));
    if !has_own_folder {
        let results = report.results.display();
        lines.push(format!("hammerbeam figure {results} --kind page lays these points over its page"));
    }
    lines.extend(report.excitation_notes.iter().map(|note| format!("note: {note}")));
    lines.join("\n")
}

/// * `point`: where the sensor is; a contact force is at no point of the response.
fn comparison(compared: &ComparedQuantity, point: &str) -> Vec<String> {
    let comparison = &compared.comparison;
    let (fit, quantity) = (&comparison.fit, comparison.quantity);
    let count = |wanted: &str| comparison.points.iter().filter(|p| p.verdict.word() == wanted).count();
    let frequency = if fit.offset { "frequency offset (Hz)" } else { "frequency factor" };
    let place = match quantity {
        MeasuredQuantity::Force => " of the contacts".to_owned(),
        _ => format!(" at {point}"),
    };
    let mut lines = vec![
        format!("\n{} [{}]{place}", quantity.word(), quantity.symbol()),
        format!("  {frequency:<22} {}", estimate(fit.frequency, 6)),
        format!("  {:<22} {}", "amplitude factor", estimate(fit.amplitude, 6)),
        format!("  residual before         {}", residual(comparison.before)),
        format!("  residual after          {}", residual(comparison.after)),
        format!(
            "  explained {}, too far {}, only unstable branches {}, no branch {}{}; aperiodic {}, doubtful \
            {}",
            count("explained"),
            count("too-far"),
            count("only-unstable"),
            count("no-branch"),
            if quantity == MeasuredQuantity::Force {
                format!(", no contact {}", count("no-contact"))
            } else {
                String::new()
            },
            count("aperiodic"),
            count("doubtful")
        ),
    ];
    let notes = fit_notes(fit).into_iter().chain(gaps(compared.curves.gaps())).chain(beyond(compared));
    lines.extend(notes.map(|note| format!("  note: {note}")));
    let unexplained: Vec<&PointOutcome> =
        comparison.points.iter().filter(|point| point.verdict.is_unexplained()).collect();
    lines.extend(unexplained.iter().take(LISTED).map(|point| unexplained_text(point)));
    if unexplained.len() > LISTED {
        lines.push(format!("  ... and {} more", unexplained.len() - LISTED));
    }
    lines
}

/// What has to be known of a fit: numbers that are no minimum, or hardly separated, and another minimum.
pub fn fit_notes(fit: &Fit) -> Vec<String> {
    let frequency = if fit.offset { "frequency offset" } else { "frequency factor" };
    let at_end = |(name, estimate): (&str, FitEstimate)| {
        let (low, high) = estimate.ends()?;
        Some(format!(
            "the {name} is at an end of what is tried, {low} to {high}, beyond which the sum of squares may \
            fall: this is no minimum and has no standard error, and all else is for this value; give the \
            true one if it lies out there"
        ))
    };
    let mut notes: Vec<String> = [(frequency, fit.frequency), ("amplitude factor", fit.amplitude)]
        .into_iter()
        .filter_map(at_end)
        .collect();
    if fit.correlation.is_some_and(|value| value.abs() > 0.95 || !value.is_finite()) {
        notes.push("the points hardly separate shift and factor".to_owned());
    }
    notes.extend(second_minimum(fit));
    notes
}

/// That branches have gaps.
pub fn gaps(gaps: usize) -> Option<String> {
    (gaps > 0)
        .then(|| counted(gaps as u64, "solution"))
        .map(|lost| format!("{lost} of the branches could not be gone over: there are gaps there"))
}

/// That points are shifted beyond the range of the study.
fn beyond(compared: &ComparedQuantity) -> Option<String> {
    let [low, high] = compared.range_hz;
    let beyond = compared.beyond();
    (beyond > 0).then(|| {
        format!(
            "{} shifted beyond the range of the study, {low} to {high} Hz, where nothing is computed or \
            drawn",
            counted(beyond as u64, "point")
        )
    })
}

/// That another shift fits about as well.
fn second_minimum(fit: &Fit) -> Option<String> {
    let second = fit.second?;
    let shift = if fit.offset {
        format!("a frequency offset of {:.4} Hz", second.frequency)
    } else {
        format!("a frequency factor of {:.5}", second.frequency)
    };
    let end = if second.at_end { ", at an end of what is tried" } else { "" };
    Some(format!(
        "{shift} with an amplitude factor of {:.4}{end} fits about as well: its sum of squares is {:.3} \
        times that of the best, points that fit neither left out; it goes by {}, the best by {}",
        second.amplitude,
        second.cost_ratio,
        counted(second.points as u64, "point"),
        fit.points
    ))
}

/// A number and where it comes from.
pub fn estimate(estimate: FitEstimate, digits: usize) -> String {
    let value = estimate.value;
    match estimate.origin {
        Origin::Given => format!("{value:.digits$} (given)"),
        Origin::Minimum { standard_error } => format!("{value:.digits$} ± {standard_error:.digits$}"),
        Origin::AtEnd { .. } => format!("{value:.digits$} (at an end of what is tried)"),
    }
}

fn residual(residual: Residual) -> String {
    format!(
        "{:.4} over {}; {} of them within the reach, {:.4}",
        residual.rms,
        counted(residual.met as u64, "point"),
        residual.within,
        residual.rms_within
    )
}

fn unexplained_text(outcome: &PointOutcome) -> String {
    let period = outcome.point.kind.period_multiple().map_or_else(String::new, |n| format!(" of period {n}"));
    let why = match (outcome.verdict, outcome.nearest) {
        (Verdict::OnlyUnstable { .. } | Verdict::NoBranch { .. } | Verdict::NoContact { .. }, _) => {
            let there = match outcome.verdict {
                Verdict::OnlyUnstable { .. } => format!("branches{period} are unstable there"),
                Verdict::NoContact { .. } => {
                    format!("branches{period} are without contact there, their force is 0")
                }
                _ => format!("no branch{period} is there"),
            };
            match outcome.verdict.nearest_hz() {
                Some(hz) if matches!(outcome.verdict, Verdict::NoContact { .. }) => {
                    format!("{there}; the nearest stable one with contact is at {hz:.4} Hz")
                }
                None if matches!(outcome.verdict, Verdict::NoContact { .. }) => {
                    format!("{there}, and none has contact anywhere")
                }
                Some(hz) => format!("{there}; the nearest stable one is at {hz:.4} Hz"),
                None => format!("{there}, and none is stable anywhere"),
            }
        }
        (_, Some(nearest)) => format!(
            "{:.3} times the nearest stable branch{period}, number {}",
            nearest.difference.exp(),
            nearest.hit.branch
        ),
        _ => String::new(),
    };
    format!(
        "  unexplained: {} at {:.4} Hz ({:.4} Hz shifted): {why}",
        outcome.point.origin, outcome.point.frequency_hz, outcome.shifted_hz
    )
}
